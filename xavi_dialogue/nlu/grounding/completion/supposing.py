"""Supposing: "and if he had not?", "what if without it?", completed by what was spoken of."""

from typing import Final, TypeGuard

from msgspec.structs import replace

from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Elliptic,
    HowLong,
    HowMuch,
    HowSure,
    Listing,
    Question,
    WhatIf,
    When,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.rewriting import first, rewrite
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Exists,
    Exit,
    Feature,
    Happens,
    Has,
    Is,
    Junction,
    Lane,
    Measured,
    Next,
    Nobody,
    Not,
    Now,
    Pronoun,
    Proposition,
    Related,
    That,
    Thing,
    Unsaid,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.grounding.completion.carrying import carried
from xavi_dialogue.nlu.grounding.completion.discussion import discussed, questioned
from xavi_dialogue.nlu.grounding.context import Grounder

PLACES: Final = (Exit, Junction, Lane)
_UNREAL: Final = Event("do", modal="would")  # "how much time would that save?"
_OUR_COLLISION: Final = Happens(Event("collide", modal="would"))
HALTING: Final = ("stop", "brake", "avoid", "slow-down")


def what_if(spoken: Elliptic, question: Question | None, g: Grounder) -> Act | None:
    """Complete a fragment that supposes something; None where nothing completes it."""
    thing = spoken.thing
    actor: Thing | None = None
    if isinstance(thing, Pronoun | Described | Vehicle):
        actor = g.thing(thing, g.window(Unsaid(), "present"))
    elif thing is not None:
        actor = thing
    if spoken.event is not None and spoken.event.action != "do":
        event = spoken.event if actor is None else replace(spoken.event, actor=actor)
        supposed: Proposition = Happens(event)
        return supposing(Not(supposed) if spoken.negated else supposed, question)
    if isinstance(actor, PLACES):
        return supposing(through(actor, questioned(g.context)), question)
    known = discussed(g.context, actor) if actor is not None else discussed(g.context)
    if known is None:
        if not isinstance(actor, Vehicle):
            return None
        return supposing(Not(Exists(actor)), question)
    supposed = Happens(replace(known, modal=None))
    earlier = question.supposed if isinstance(question, WhatIf) else None
    if spoken.negated or (actor is None and earlier is None):
        supposed = Not(supposed)
    return supposing(supposed, question)


def supposing(supposed: Proposition, question: Question | None) -> Act:
    """Ask of a supposition what was asked of the one before."""
    if isinstance(question, WhatIf):
        return Ask(replace(question, supposed=supposed))
    return Ask(WhatIf(supposed))


def through(place: Thing, of: Proposition | None) -> Proposition:
    """Say that we take an exit, as was said of another, or leave by it."""
    event = first(of, Event)
    if event is not None and isinstance(event.object, type(place)):
        return Happens(replace(event, object=place, actor=Ego()))
    return Happens(Event("leave" if isinstance(place, Exit) else "enter", object=place))


def of_named(spoken: WhatIf) -> WhatIf:
    """Take "it" for the vehicle of the main clause: "would we have hit the van if it went on?"."""
    event, named = first(spoken.supposed, Event), _named_in(spoken.then)
    if event is None or named is None or not isinstance(event.actor, Pronoun):
        return spoken
    if event.actor.form not in ("it", "he", "she"):
        return spoken
    whole = replace(event, actor=named)
    of = rewrite(spoken.supposed, lambda part: whole if part == event else part)
    return replace(spoken, supposed=of)


def of_nobody(spoken: Proposition) -> Proposition:
    """Take that nobody crosses, comes or is behind us for the absence of those who do.

    That nobody is ahead, or in our way, is that the road is free.
    """
    match spoken:
        case Happens(
            event=Event("come", Nobody() as actor, tense=tense, where=Related("oncoming-to"))
        ):
            return of_nobody(Related("oncoming-to", actor, Ego(), tense=tense))
        case Happens(event=Event(action=action, actor=Nobody(described=known)) as event) if (
            action in _MET and event.modal is None
        ):
            those = known or Described(kind="pedestrian" if action == "cross" else "vehicle")
            walking = action == "cross" and those.kind == "pedestrian"
            doing = None if walking else replace(event, actor=Wanted(those.kind))
            those = replace(those, doing=doing, plural=True, definite=walking)
            tense = event.tense
        case Related(relation=relation, thing=Nobody(described=known), tense=tense) if (
            relation not in _IN_OUR_WAY
        ):
            those = known or Described()
            such = replace(spoken, thing=Wanted(those.kind), tense="present")
            those = replace(those, such=such, plural=True, definite=False)
        case _:
            return spoken
    return Not(Exists(those, Unsaid(), tense))


_MET: Final = frozenset(("cross", "come", "approach"))
_IN_OUR_WAY: Final = frozenset(("ahead-of", "in-the-way-of"))


def _named_in(then: Question | None) -> Described | None:
    """Find the vehicle that is described in the question what would follow."""
    event = first(then.that, Event) if isinstance(then, Whether) else None
    things = () if event is None else (event.actor, event.object)
    if any(isinstance(thing, Pronoun) for thing in things):
        return None
    return next((t for t in things if isinstance(t, Described) and t.definite), None)


def subordinate(spoken: Question, g: Grounder) -> Question:
    """Ask "would we have hit it?" of what was supposed in the question before."""
    if isinstance(spoken, WhatIf):
        return carried(spoken, g)
    earlier = _supposed_before(g)
    if _asks_worry(spoken) and not _risk_told(g.context.discourse):
        return replace(spoken, such=_IN_OUR_WAY_NEXT)
    if _asks_whom(spoken):
        g.notes.leaned = g.notes.leaned or earlier is not None
        return whom_struck(earlier)
    if _asks_chance(spoken, g) and isinstance(earlier, Happens):
        g.notes.leaned = True
        return WhatIf(earlier, spoken)
    option = _of_its_time(spoken, earlier, g)
    if earlier is not None and (risk := _risk_of(spoken, g)) is not None:
        g.notes.leaned = True
        return WhatIf(earlier, risk)
    if earlier is None or not (option or _hypothetical(spoken, earlier)):
        return _of_nothing(spoken) if isinstance(spoken, HowMuch) and option else spoken
    earlier = rewrite(earlier, lambda part: Unsaid() if isinstance(part, Now) else part)
    g.notes.leaned = True
    if option:
        return WhatIf(earlier, HowMuch(Measured("delay")))
    if isinstance(spoken, HowSure):
        return WhatIf(earlier, Whether(spoken.of or earlier))
    return WhatIf(earlier, spoken)


def whom_struck(supposed: Proposition | None) -> Question:
    """Ask whom we may strike: by an option, else by what we do."""
    whom = Which(
        Wanted(), Happens(Event("collide", object=Wanted(), tense="present", modal="might"))
    )
    return whom if supposed is None else WhatIf(supposed, whom)


_IN_OUR_WAY_NEXT: Final = Related("in-the-way-of", Wanted(), Ego(), Next(), "future")


def _asks_worry(spoken: Question) -> TypeGuard[Which]:
    """Tell whether it is asked who worries us."""
    return isinstance(spoken, Which) and spoken.such == Is(
        "dangerous", Wanted(), time=Next(), tense="future"
    )


def _risk_told(discourse: Discourse) -> bool:
    """Tell whether the turn before gave the risk of one of our options: of whom we might hit."""
    if discourse.option is None:
        return False
    match discourse.question:
        case Whether(that=Is(state="dangerous" | "safe")):
            return True
        case WhatIf(supposed=supposed, then=then):
            parts = [part for part in (then, supposed) if part is not None]
        case HowSure() | Which() as asked:
            parts = [asked]
        case _:
            return False
    return any(event is not None and event.action == "collide"
               for event in (first(part, Event) for part in parts))  # fmt: skip


def _asks_whom(spoken: Question) -> bool:
    """Tell whether it is asked from whom the danger is: "which car is the danger?"."""
    match spoken:
        case Which(
            such=Is(state="dangerous", thing=Wanted(), event=None, tense="present" | "future")
        ):
            return True
        case Which(such=Related(relation="with", thing=Pronoun(), to=Wanted())):
            return True
        case Which(such=Happens(event=Event("collide", Wanted(), Ego(), modal=modal))):
            return modal in ("would", "might", "could")  # "who might hit us?"
    return False


def _asks_chance(spoken: Question, g: Grounder) -> bool:
    """Tell whether it is asked how likely that is which an option of ours would lead to."""
    if not isinstance(spoken, HowSure) or spoken.of is not None or spoken.changed:
        return False
    match g.context.discourse.question:
        case WhatIf(supposed=Happens(event=Event(actor=Ego()))):
            return True
        case Whether() | Which() | None:
            return g.context.discourse.option is not None
    return False


def _of_its_time(spoken: Question, earlier: Proposition | None, g: Grounder) -> bool:
    """Tell whether it is asked how much time an option, or the absence of somebody, would take."""
    match spoken:
        case HowMuch(of=Measured(event=event)) if event == _UNREAL:
            return True
        case HowMuch(of=Measured(attribute="delay", thing=Pronoun(), event=None)):
            return isinstance(earlier, Not) and isinstance(earlier.content, Exists)
        case HowLong(of=That()):
            return g.context.discourse.decided is not None
    return False


def _risk_of(spoken: Question, g: Grounder) -> HowSure | None:
    """Ask for the risk of what was supposed: "how likely would a crash be?", "what's the danger?".

    What is said of now is of an option too, if one was compared with what we do.
    """
    weighed = g.context.discourse.decided is not None
    match spoken:
        case HowSure(of=Happens(event=Event(action="collide", actor=Ego(), object=None) as event)):
            asked = weighed or event.modal == "would"
        case HowSure(of=Is(state="wrong" | "dangerous", thing=Pronoun(), event=None)):
            asked = True
        case Why(of=Is(state="dangerous", thing=None | Pronoun(), event=None, tense="present")):
            asked = weighed
        case _:
            return None
    return HowSure(_OUR_COLLISION) if asked else None


def _of_nothing(spoken: HowMuch) -> Question:
    """Ask how much time would be saved where nothing was supposed: by the next best option."""
    if spoken.of.attribute == "delay":
        return Listing("rivals")
    return replace(spoken, of=replace(spoken.of, event=None))


def _hypothetical(spoken: Question, earlier: Proposition) -> bool:
    """Tell whether a question is about a world that is only supposed."""
    match spoken:
        case (
            HowSure(of=Happens(event=Event(action="collide", modal="would")))
            | Which(such=Happens(event=Event(action="collide" | "block", modal="would")))
        ):
            return True  # "how sure are you that it would hit us?", "which car would hit us?"
        case (
            Whether(that=Happens(event=event) | Not(content=Happens(event=event)))
            | When(of=Happens(event=event))
        ):
            if first(earlier, Event) == replace(event, modal=None):
                return False
            if event.modal == "would":
                return True
            return event.modal in ("can", "could") and event.action in HALTING
    return False


def _supposed_before(g: Grounder) -> Proposition | None:
    """Give what the question before supposed, or asked whether it could have been done."""
    match g.context.discourse.question:
        case WhatIf(supposed=supposed):
            return supposed
        case Whether(that=Happens(event=Event(modal="could") as event)):
            return _as_option(replace(event, modal=None, tense="perfect"))
    option = g.context.discourse.option
    if option is not None:
        return _as_option(option)
    match g.context.discourse.question:
        case Why(of=Not(content=Happens(event=event))):
            tense = "present" if event.tense == "present" else "perfect"
            return Happens(replace(event, modal=None, tense=tense))
    return None


def _as_option(option: Event) -> Proposition:
    """Take a turn on red for a green light: what it would save is the wait."""
    if is_on_red(option):
        return Has("colour", "green", Feature("light"), tense="past")
    return Happens(option)


def is_on_red(option: Event) -> bool:
    """Tell whether an option is to go on while the light is red."""
    light = option.object
    return isinstance(light, Feature) and light.kind == "light" and light.colour == "red"
