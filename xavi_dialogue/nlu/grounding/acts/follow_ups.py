"""Follow-ups: questions about the option or the decision that the answer before told of."""

from typing import Any, Final, cast, get_args

from msgspec.structs import replace

from xavi_dialogue.domain.discourse import Discourse, Span
from xavi_dialogue.domain.meaning import (
    Compare,
    HowAvoid,
    HowDecide,
    HowKnow,
    HowLong,
    HowMuch,
    HowSure,
    Listing,
    Question,
    WhatIf,
    WhatWouldChange,
    When,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import (
    At,
    AtDecision,
    Compares,
    Described,
    Ego,
    Event,
    Feature,
    Happens,
    Has,
    Is,
    Measured,
    Not,
    Now,
    Pronoun,
    Proposition,
    Related,
    That,
    Unsaid,
    Vehicle,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import Kind
from xavi_dialogue.nlu.grounding.acts.simulations import of_them
from xavi_dialogue.nlu.grounding.completion.discussion import (
    HINDERED,
    affirmed,
    asserted,
    events,
    explained,
    proposition_of,
    wished,
)
from xavi_dialogue.nlu.grounding.completion.listed import of_listed
from xavi_dialogue.nlu.grounding.completion.supposing import is_on_red
from xavi_dialogue.nlu.grounding.context import Grounder

TURNS: Final = ("turn", "exit-left", "exit-right", "exit-straight", "leave")
_CHANGING: Final = ("change-lane", "change-left", "change-right", "overtake")
_MOVES: Final = (*TURNS, *_CHANGING)
_STAYING: Final = ("wait", "keep-lane", "stand")
_BRAKING: Final = ("brake", "slow-down", "stop")
_MISHAPS: Final = ("collide", "nearly-collide")
_SPOKEN_OF: Final = ("it", "that", "they", "them-all")


def _brakes(event: Event) -> bool:
    return isinstance(event.actor, Ego) and event.action in _BRAKING and event.tense == "past"


def followed(spoken: Question, g: Grounder) -> Question:
    """Ask of the option or decision under discussion, where nothing else is said."""
    discourse = g.context.discourse
    asked = discourse.question
    meant = of_them(spoken, g) or of_listed(spoken, g) or _stopping(spoken, g) or _limiting(spoken)
    if (meant := meant or _suspecting(spoken, g)) is not None:
        return meant
    if (option := discourse.option) is not None and is_on_red(option) and _judges_that(spoken):
        g.notes.leaned = True
        return Whether(Happens(replace(option, modal="can")))
    match spoken:
        case HowMuch(of=Measured("deceleration", Ego(), event=None, time=Unsaid()) as of):
            braked = next((e for e in events(discourse, real=True) if _brakes(e)), None)
            if braked is not None:
                g.notes.leaned = True  # "did we just brake? how hard?"
                return HowMuch(replace(of, event=braked, time=braked.time, tense="past"))
        case (
            Whether(that=Is(state="close", thing=Pronoun(form=form), event=None))
            | HowMuch(of=Measured("distance", Pronoun(form=form), to=None | Pronoun("them-all")))
        ) if form in _SPOKEN_OF and _weighs(g.context.discourse, pair=form == "them-all"):
            g.notes.leaned = True
            if discourse.option is None or discourse.decided is None:
                return Listing("rivals")
            return Compare((Happens(discourse.decided), Happens(discourse.option)), "margin")
        case HowMuch(of=Measured("delay", Pronoun(form="it" | "that"), event=None)) if _weighs(
            discourse, pair=False
        ):  # "what does it cost us?" of what was chosen
            g.notes.leaned = True
            return Listing("rivals")
        case WhatWouldChange(of=None | That(), most=True) if discourse.option is not None:
            g.notes.leaned = True
            return replace(spoken, of=Not(Happens(replace(discourse.option, modal=None))))
        case Listing(of="options" | "rivals", time=Unsaid(), event=None):
            if (decided := _decision(discourse)) is not None:
                g.notes.leaned = True
                return replace(spoken, time=At(decided))
        case Whether(that=Is(state="close", thing=Pronoun(form="them-all")) as near):
            return replace(spoken, that=replace(near, thing=Pronoun("it")))
        case HowMuch(of=Measured(attribute="delay", event=Event(action="do")) as of):
            return _saved(of, g)
        case When(of=Is(state="sure", thing=Ego())) | HowLong(of=Is(state="sure", thing=Ego())):
            return HowKnow()  # the evidence tells since when it has been held to be likely
        case HowSure(of=Happens(event=Event(action="do", actor=Ego(), modal=None) as done)):
            done = replace(done, object=None)  # "that decision", "the decision at 40 s"
            timed = isinstance(spoken.time, At | AtDecision)
            return replace(spoken, of=Happens(replace(done, time=spoken.time) if timed else done))
        case HowSure(of=None, changed=True) if (light := _light_spoken_of(asked)) is not None:
            g.notes.leaned = True  # "what colour is it? - when will that change?"
            return When(Happens(Event("turn-colour", light, tense="future")))
        case HowSure(of=None, changed=False) if isinstance(asked, Why) and _is_ours(asked.of):
            g.notes.leaned = True
            return replace(spoken, of=asked.of)
    return spoken


def _light_spoken_of(question: Question | None) -> Feature | None:
    """Return the traffic light that a question is about; None if it is about none."""
    found = first(question, Feature)
    return found if found is not None and found.kind == "light" else None


def _suspecting(spoken: Question, g: Grounder) -> Why | None:
    """Ask of what was told, or of the option under discussion, whether that is the reason."""
    discourse = g.context.discourse
    match spoken:
        case Why(of=of, suspect=Pronoun(form="that" | "this")) if _tells_of_us(discourse.question):
            g.notes.leaned = True  # "is that why you don't?": "that" is what was told
            vague = isinstance(of, That) or getattr(first(of, Event), "action", None) == "do"
            if vague and discourse.option is not None:
                of = Not(Happens(replace(discourse.option, modal=None)))
            return replace(spoken, of=of, suspect=None)
        case Why(of=That(), suspect=suspect) if suspect is not None:
            if discourse.option is not None:
                g.notes.leaned = True
                return replace(spoken, of=Not(Happens(replace(discourse.option, modal=None))))
        case Whether(that=Has("kind", kind, Pronoun("it"), tense="past")) if (
            kind in get_args(Kind) and (reasoned := explained(g.context)) is not None
        ):  # "was it a pedestrian?"
            g.notes.leaned = True
            return Why(reasoned, suspect=Described(cast(Kind, kind)))
    return None


def _judges_that(spoken: Question) -> bool:
    """Tell whether it is asked if "that" is worth it, safe, or better."""
    match spoken:
        case Whether(that=Is(thing=Pronoun(form="it" | "that"), event=None)):
            return True
    return isinstance(spoken, Compare) and spoken.options == (That(),)


def _stopping(spoken: Question, g: Grounder) -> Why | None:
    """Take "what is stopping you?" after a wish for why we do not do as we are asked."""
    if (option := wished(g.context.discourse)) is None:
        return None
    match spoken:
        case Which(Wanted(), Happens(Event("block" | "stop", Wanted(), Ego(), tense="present"))):
            pass
        case Which(Wanted(), Happens(Event("wait", Ego(), Wanted(), tense="present"))):
            pass
        case Which(Wanted(), Related("in-the-way-of", Wanted(), Ego())):
            pass
        case Why(That() | Not(That() | Happens(Event("do", Ego(), Pronoun() | None)))):
            pass
        case HowAvoid(of=None):
            pass
        case _:
            return None
    g.notes.leaned = True
    return Why(Not(Happens(option)))


def _limiting(spoken: Question) -> Which | None:
    """Take "which vehicle slows us down?" for who is in our way now."""
    match spoken:
        case Which(
            such=Compares(
                Measured("delay", Wanted(), event=None, time=Unsaid() | Now(), tense="present"),
                "more",
                None,
            )
        ):
            return Which(Wanted(), Happens(Event("block", Wanted(), Ego(), tense="present")))
    return None


def _decision(discourse: Discourse) -> float | None:
    """Give when [s] the decision was made that the last answer told of; None: it told of none."""
    if discourse.option is not None and isinstance(discourse.option.time, At):
        return discourse.option.time.at
    if isinstance(discourse.question, HowDecide) and discourse.episode is not None:
        begin, end = discourse.episode
        return begin if begin == end else None
    return None


def _saved(of: Measured, g: Grounder) -> Question:
    """Ask what time was saved by what we did and spoke of, else by the last change of lanes.

    Of another choice it is asked what else there was to choose.
    """
    spoken_of = (e for e in events(g.context.discourse, real=True) if e.actor == Ego())
    known = next((e for e in spoken_of if e.action not in HINDERED), None)  # no halt saves time
    if known is None:
        changed = Event("change-lane", tense="perfect")
        done = g.context.holds(changed, g.context.begin, g.context.now)
        return HowMuch(replace(of, event=changed)) if done else Listing("rivals")
    g.notes.leaned = True
    chosen = known.action in (*TURNS, "keep-lane", "continue", "change-plan")
    return Listing("rivals", event=known) if chosen else HowMuch(replace(of, event=known))


def _weighs(discourse: Discourse, *, pair: bool) -> bool:
    """Tell whether what was asked last is about what a decision of ours weighed.

    "Between the two" is about that after a reason for it and after a supposition, too; "it" after
    the reason for what we did not do, where no vehicle was named.
    """
    asked, last = discourse.question, discourse.turn - 1
    named = any(m.turn == last and isinstance(m.thing, Vehicle) for m in discourse.mentions)
    match asked:
        case Listing(of="options" | "rivals" | "decisions") | HowDecide() | WhatWouldChange():
            return True
        case Compare(options=options):
            return all(isinstance(one, Happens) and one.event.actor == Ego() for one in options)
        case HowSure(of=of):
            event = first(of, Event)
            return event is not None and event.actor == Ego() and event.action not in _MISHAPS
        case Why(of=of):
            event = first(of, Event)
            if event is None or event.actor != Ego():
                return False
            return pair or (isinstance(of, Not) and (event.action in _MOVES or not named))
    return pair and isinstance(asked, WhatIf)


def _tells_of_us(asked: Question | None) -> bool:
    """Tell whether the answer to a question gives a reason or figure of ours, of no one named."""
    ours = isinstance(asked, Why | WhatIf | HowMuch | HowSure | Compare)
    return ours and first(asked, Vehicle) is None


def _is_ours(of: Proposition) -> bool:
    """Tell whether it is of a choice of ours that is not told of by its own name."""
    event = first(of, Event)
    told = isinstance(of, Not) or (event is not None and event.action == "stop")
    return told and event is not None and event.actor == Ego()


def compared(spoken: Compare, options: tuple[Any, ...], g: Grounder) -> Compare:
    """Compare what was decided with the option that was told of, where only it is named."""
    _of_decision(spoken, g)
    options = tuple(_option(one, g) for one in options)
    named = [event.action for one in options if (event := first(one, Event)) is not None]
    if {*named} & {*_CHANGING, "change-plan"}:
        options = tuple(_kept(one) for one in options)
    told = g.context.discourse
    if told.option is not None and told.decided is not None and options == (Happens(told.decided),):
        options = (*options, Happens(told.option))
    return replace(spoken, options=options)


def _option(option: Any, g: Grounder) -> Any:
    """Take "that" among what is compared for what was spoken of, and never for its denial."""
    if not isinstance(option, That):
        return _decided(option, g)
    if (told := g.context.discourse.option) is not None:
        g.notes.leaned = True
        return Happens(told)
    known = proposition_of(g.context.discourse.question) or asserted(g.context)
    if known is None:
        return option
    g.notes.leaned = True
    return affirmed(known)


def _kept(option: Any) -> Any:
    """Take "staying" beside "changing" for staying in the lane."""
    match option:
        case Happens(event=Event(action="wait" | "stand", actor=Ego(), object=None) as event):
            return Happens(replace(event, action="keep-lane"))
        case Happens(event=Event(action="change-plan") as event):  # "changing"
            return Happens(replace(event, action="change-lane"))
    return option


def _decided(option: Any, g: Grounder) -> Any:
    """Take "staying" beside an option for what was decided instead of it."""
    discourse = g.context.discourse
    match option:
        case Happens(event=Event(action=action, actor=Ego(), object=None)) if action in _STAYING:
            if discourse.option is not None and discourse.option.action not in _STAYING:
                g.notes.leaned = True
                return Happens(discourse.decided or discourse.option)
    return option


def _of_decision(spoken: Compare, g: Grounder) -> None:
    """Ask what would have been better of the decision that was asked about."""
    discourse, named = g.context.discourse, first(spoken.options, Event)
    past = named is not None and named.tense in ("past", "perfect")
    decided = isinstance(discourse.question, Why | HowSure)
    if past and decided and discourse.episode is not None and g.notes.span is None:
        g.notes.leaned = True
        g.notes.spans(Span(*discourse.episode))
