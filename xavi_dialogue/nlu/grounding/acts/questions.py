"""Questions: what each sort of question takes for granted, and what it leaves open."""

from collections.abc import Callable
from typing import Any, Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import (
    Changed,
    Compare,
    Doing,
    Fault,
    HowAvoid,
    HowDecide,
    HowKnow,
    HowLong,
    HowMany,
    HowMuch,
    HowSure,
    Identify,
    Listing,
    Peak,
    Question,
    Summarise,
    WhatIf,
    WhatWouldChange,
    When,
    Where,
    Whether,
    Which,
    Whither,
    Why,
)
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import (
    SOMEBODY_ELSE,
    Between,
    Described,
    Ego,
    Event,
    Happens,
    Measured,
    Nobody,
    Now,
    Proposition,
    That,
    Unsaid,
    Vehicle,
    Vehicles,
    WholeRide,
)
from xavi_dialogue.nlu.grounding.acts.measuring import measured, whichever
from xavi_dialogue.nlu.grounding.acts.others import no_cause_sought
from xavi_dialogue.nlu.grounding.acts.propositions import at_moment, inferred, suspect, timed
from xavi_dialogue.nlu.grounding.acts.recasting import recast
from xavi_dialogue.nlu.grounding.completion.discussion import (
    PROPOSITIONS,
    affirmed,
    asserted,
    explained,
    focus_of,
    hindrance,
    interval,
    is_supposed,
    questioned,
    spoken_of,
)
from xavi_dialogue.nlu.grounding.completion.halting import of_whom
from xavi_dialogue.nlu.grounding.context import Grounder, Mode, Window
from xavi_dialogue.nlu.grounding.events import timing
from xavi_dialogue.nlu.grounding.events.timing import believed_last, changed, coming, foreseen, over
from xavi_dialogue.nlu.grounding.events.windows import pointed
from xavi_dialogue.nlu.grounding.things.crowd import counted

_AWAY: Final = frozenset(("go", "move", "head", "disappear"))
UNASKED: Final = 0.2  # cost of taking somebody for the cause where no cause was spoken of


def question(spoken: Question, g: Grounder) -> Question:
    """Ground a question."""
    found: Question = _HANDLERS[type(meant := recast(spoken, g))](meant, g)
    return found


def _why(spoken: Why, g: Grounder) -> Why:
    blames = spoken.suspect is not None and isinstance(spoken.of, That)
    of = g.proposition((blames and explained(g.context)) or spoken.of, "presupposed")
    instead = None if spoken.instead is None else g.proposition(spoken.instead, "supposed")
    event = first(of, Event)
    if spoken.suspect == SOMEBODY_ELSE:
        return replace(spoken, of=of, instead=instead)
    anybody = isinstance(spoken.suspect, Nobody) or spoken.suspect == Described(definite=False)
    blamed = None if anybody else spoken.suspect
    if blamed is not None:
        g.notes.cost += UNASKED * (blames and no_cause_sought(blamed, g.context))
        blamed = suspect(blamed, event, g, _during(event, g))
    rival = None if spoken.rival is None else suspect(spoken.rival, event, g, _during(event, g))
    rival = None if isinstance(rival, Nobody) else rival  # "or because someone was crossing"
    return replace(spoken, of=of, instead=instead, suspect=blamed, rival=rival)


def _during(event: Event | None, g: Grounder) -> Window:
    when = None if event is None else interval(event)
    return g.window(Now(), "present") if when is None else inferred(when, g)


def _what_if(spoken: WhatIf, g: Grounder) -> WhatIf:
    supposed = g.proposition(of_whom(spoken, g), "supposed")
    then = None if spoken.then is None else _supposed_question(spoken.then, g)
    focus = focus_of(supposed, g.context)
    if g.notes.span is None and focus is not None:
        g.notes.spans(inferred(focus, g).span)
    return replace(spoken, supposed=supposed, then=then)


def _supposed_question(spoken: Question, g: Grounder) -> Question:
    match spoken:
        case Whether(that=that):
            return replace(spoken, that=g.proposition(that, "supposed"))
        case When(of=of) | Why(of=of):
            return replace(spoken, of=g.proposition(of, "supposed"))
        case HowMuch(Measured("delay", Ego(), time=Unsaid())) | HowSure(of=None):
            return spoken  # what would happen is at no time of the ride
        case Doing(actor=None, time=Unsaid()):
            return spoken
    return question(spoken, g)


def _whether(spoken: Whether, g: Grounder) -> Whether:
    return replace(spoken, that=g.proposition(spoken.that, "asked"))


def _which(spoken: Which, g: Grounder) -> Which:
    such = None if spoken.such is None else g.proposition(spoken.such, "asked")
    thing = whichever(spoken.thing, such)
    if isinstance(thing, Described) and such is not None:
        thing = replace(thing, plural=True)
    during = _during(first(such, Event), g)
    among = tuple(g.thing(one, during) for one in spoken.among)
    return replace(spoken, thing=g.thing(thing, during), such=such, among=among)


def _identify(spoken: Identify, g: Grounder) -> Identify:
    found = replace(spoken, thing=g.thing(spoken.thing, g.window(Unsaid(), "present")))
    if isinstance(spoken.thing, Described) and spoken.thing.doing is not None:
        g.notes.unclear.clear()  # "who is that walking there?": whoever is nearest
    return found


def _how_much(spoken: HowMuch, g: Grounder) -> HowMuch:
    of = spoken.of
    if spoken.extreme is not None and isinstance(of.time, Unsaid) and of.tense != "present":
        of = replace(of, time=WholeRide())
    return replace(spoken, of=measured(of, g, timed, extreme=spoken.extreme is not None))


def _how_many(spoken: HowMany, g: Grounder) -> HowMany:
    of = spoken.of
    if isinstance(of, Event):
        if isinstance(of.time, Unsaid) and of.tense in ("past", "perfect"):
            of = replace(of, time=WholeRide())
        return replace(spoken, of=g.event(of, "asked"))
    such = counted(of, g.context) if isinstance(of, Described) else None
    done = such is not None and getattr(such.doing, "tense", "present") in ("past", "perfect")
    window = g.window(Unsaid(), "perfect" if done else "present")
    return replace(spoken, of=g.thing(such or of, window), such=such)


def _when(spoken: When, g: Grounder) -> When:
    """Ground when it was: "that" is the last thing told that has been, or is, so."""
    if isinstance(spoken.of, That):
        told = (p for p in g.context.discourse.propositions if isinstance(p, Happens))
        past = next((p for p in told if p.event.modal is None), None)
        if past is not None:
            g.notes.leaned = True
            return replace(spoken, of=past)
    return replace(spoken, of=g.proposition(spoken.of, "presupposed"))


def _how_long(spoken: HowLong, g: Grounder) -> HowLong:
    if not isinstance(spoken.of, Event):
        return replace(spoken, of=g.proposition(spoken.of, "asked"))
    state = spoken.of.action in ("follow", "see")  # looked up moment by moment
    return replace(spoken, of=g.event(spoken.of, "asked" if state else "presupposed"))


_OF_MOMENTS: Final = ("beliefs", "options", "rivals", "vehicles")  # listed as they are at one time


def _where(spoken: Where, g: Grounder) -> Where:
    of = spoken.of
    if isinstance(of, Event):
        if isinstance(of.time, Unsaid):
            of = replace(of, time=spoken.time)
        away = of.action in _AWAY and of.object is None  # nobody need have set off
        free = away or of.tense == "future" or of.modal is not None
        return replace(spoken, of=g.event(of, "asked" if free else "presupposed"), time=Unsaid())
    window = at_moment(spoken.time, "present", g, None)
    return replace(spoken, of=g.thing(of, window), time=window.term)


def _whither(spoken: Whither, g: Grounder) -> Whither:
    window = g.window(spoken.time, "present")
    if window.said:
        g.notes.spans(window.span)
    time = spoken.time if isinstance(spoken.time, Unsaid) else window.term
    return replace(spoken, actor=g.thing(spoken.actor, window), time=time)


def _doing(spoken: Doing, g: Grounder) -> Doing:
    window = timed(spoken.time, spoken.tense, g, None)
    actor = None if spoken.actor is None else g.thing(spoken.actor, window)
    besides = None if spoken.besides is None else g.proposition(spoken.besides, "asked")
    time = window.term
    if spoken.time == Unsaid() and isinstance(time, Between) and time.begin == time.end:
        time = WholeRide()  # what it did, and not how it was at one moment
    return replace(spoken, actor=actor, besides=besides, time=time)


def _compare(spoken: Compare, g: Grounder) -> Compare:
    now = g.window(Unsaid(), "present")
    options = tuple(
        g.proposition(one, "supposed") if isinstance(one, PROPOSITIONS) else g.thing(one, now)
        for one in spoken.options
    )
    flat: list[Any] = []
    for one in options:
        flat += [Vehicle(n) for n in one.numbers] if isinstance(one, Vehicles) else [one]
    return replace(spoken, options=tuple(flat))


def _listing(spoken: Listing, g: Grounder) -> Listing:
    window = over((spoken := timing.seen_then(timing.of_deed(spoken), g)).time, g)
    if spoken.of in _OF_MOMENTS:
        window = pointed(spoken.time, window)
        g.notes.span = window.span
    about = None if spoken.about is None else g.thing(spoken.about, window)
    return replace(spoken, about=about, time=window.term)


def _peak(spoken: Peak, g: Grounder) -> Peak:
    return replace(spoken, time=over(spoken.time, g).term)


def _summarise(spoken: Summarise, g: Grounder) -> Summarise:
    about = spoken.about
    if isinstance(about, Event):
        about = g.event(about, "presupposed")
        when = interval(about)
        window = over(spoken.time, g) if when is None else inferred(when, g)
        return replace(spoken, about=about, time=window.term)
    window = over(spoken.time, g)
    about = None if about is None else g.thing(about, window)
    return replace(spoken, about=about, time=window.term)


def _how_know(spoken: HowKnow, g: Grounder) -> HowKnow:
    return replace(spoken, of=_about(spoken.of, "asked", g))


def _how_sure(spoken: HowSure, g: Grounder) -> HowSure:
    spoken = foreseen(spoken)
    moved = spoken.changed and spoken.of is None
    of = (believed_last(g) if moved else None) or _about(spoken.of, "asked", g)
    if isinstance(spoken.time, Unsaid):
        return replace(spoken, of=of)
    window = at_moment(spoken.time, "past", g, None)
    return replace(spoken, of=coming(of, window, g), time=window.term)


def _how_decide(spoken: HowDecide, g: Grounder) -> HowDecide:
    return replace(spoken, of=spoken.of and g.proposition(spoken.of, "presupposed"))


def _deed(spoken: Any, g: Grounder) -> Any:
    if spoken.of is not None:
        return replace(spoken, of=g.proposition(spoken.of, "presupposed"))
    decision = isinstance(spoken, WhatWouldChange) and not spoken.most  # else that in force
    known = (spoken_of if decision else questioned)(g.context)
    if known is None or (getattr(spoken, "most", False) and is_supposed(known, g.context)):
        return spoken
    g.notes.leaned = True
    _span_of(known, g)
    return replace(spoken, of=affirmed(known))


def _about(of: Proposition | None, mode: Mode, g: Grounder) -> Proposition | None:
    if of is not None:
        return g.proposition(of, mode)
    known = asserted(g.context)
    if known is None or not (g.context.discourse.propositions or g.context.discourse.question):
        return None
    g.notes.leaned = True
    _span_of(known, g)
    return known


def _span_of(known: Proposition, g: Grounder) -> None:
    event = first(known, Event)
    when = None if event is None else interval(event)
    if when is not None:
        g.notes.spans(inferred(when, g).span)


def _fault(spoken: Fault, g: Grounder) -> Fault:
    of = spoken.of
    if of is not None:
        of = g.proposition(of, "presupposed")
    elif g.context.discourse.question is not None or g.context.discourse.episode is not None:
        hindered = hindrance(g.context)
        of = questioned(g.context) if hindered is None else Happens(hindered)
        imagined = first(of, Event)
        if imagined is not None and imagined.modal == "would":
            of = None
        g.notes.leaned = of is not None or g.notes.leaned
        if of is not None:
            _span_of(of, g)
    event = first(of, Event)
    blamed = spoken.suspect
    if blamed is not None:
        blamed = suspect(blamed, event or Event("happen", actor=Ego()), g, _during(event, g))
    return replace(spoken, of=of, suspect=blamed)


_HANDLERS: Final[dict[type, Callable[[Any, Grounder], Any]]] = {
    Why: _why,
    WhatIf: _what_if,
    Whether: _whether,
    Which: _which,
    Identify: _identify,
    HowMuch: _how_much,
    HowMany: _how_many,
    When: _when,
    HowLong: _how_long,
    Where: _where,
    Whither: _whither,
    Doing: _doing,
    Compare: _compare,
    Listing: _listing,
    Peak: _peak,
    Changed: changed,
    Summarise: _summarise,
    HowKnow: _how_know,
    HowSure: _how_sure,
    HowDecide: _how_decide,
    WhatWouldChange: _deed,
    HowAvoid: _deed,
    Fault: _fault,
}
