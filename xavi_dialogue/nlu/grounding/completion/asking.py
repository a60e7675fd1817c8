"""Asking: another question word put to what was spoken of: "when?", "which one?", "how sure?"."""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Elliptic,
    HowDecide,
    HowKnow,
    HowLong,
    HowMuch,
    HowSure,
    Identify,
    Question,
    When,
    Where,
    Whether,
    Which,
    Whither,
    Why,
)
from xavi_dialogue.domain.rewriting import first, parts
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Feature,
    Happens,
    Has,
    Is,
    Measured,
    Pronoun,
    Proposition,
    Unsaid,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.grounding.acts.dangers import STATES
from xavi_dialogue.nlu.grounding.completion.amounts import by_how_much, until_when
from xavi_dialogue.nlu.grounding.completion.discussion import (
    affirmed,
    asserted,
    main_event,
    questioned,
)
from xavi_dialogue.nlu.grounding.completion.replacing import with_event, with_thing
from xavi_dialogue.nlu.grounding.completion.supposing import whom_struck
from xavi_dialogue.nlu.grounding.context import Grounder

#: What is done for, to or because of somebody: "for whom?".
FOR_WHOM: Final = frozenset(
    ("wait", "give-way", "let-go", "brake", "stop", "slow-down", "follow", "stand", "swerve",
     "signal", "honk", "flash")
)  # fmt: skip
_ONES: Final = Described(plural=True, definite=False)  # "which ones?"


def _of_our_way(question: Question | None) -> bool:
    """Tell whether it was asked which way we go, or what we do next."""
    if isinstance(question, HowMuch):
        return question.of.attribute in ("turn", "exit-number") and question.extreme is None
    deed = main_event(question)
    ours = deed is not None and deed.actor == Ego() and deed.tense in ("present", "future")
    return ours and first(question, Vehicle) is None


def _danger(question: Question | None, g: Grounder) -> Act | None:
    """Ask whom we may strike, after a question for the risk: of the option it was about, if any."""
    option, state = g.context.discourse.option, first(question, Is)
    about = option is not None and option.action not in FOR_WHOM
    about = about or (state is not None and state.state in STATES)
    hits = (e.action == "collide" and e.tense != "past" for e in parts(question, Event))
    if not about and not any(hits):
        return None
    return Ask(whom_struck(None if option is None else Happens(option)))


def asked(spoken: Elliptic, question: Question | None, g: Grounder) -> Act | None:
    """Put another question word to what was spoken of; None: it cannot be asked of that."""
    match spoken.form:
        case "how-much":
            amount = by_how_much(question, g.context)
            return None if amount is None else Ask(amount)
        case "until":
            end = until_when(question, questioned(g.context))
            return None if end is None else Ask(end)
        case "which":
            return _which(spoken, question, g)
        case "where" if (place := _where(spoken, question)) is not None:
            return place
        case "when" if isinstance(question, HowMuch) and _is_figure(question):
            return None if question.extreme is None else Ask(question)  # its answer tells when
        case "when" if isinstance(question, HowLong):
            return Ask(question)
        case "when" if isinstance(question, Whither) and isinstance(question.actor, Vehicle):
            return Ask(HowKnow())  # the evidence tells since when it is held to be likely
    thing = spoken.thing
    of = asserted(g.context) if spoken.form == "sure" else _put(question, g)
    if spoken.event is not None:
        of = with_event(of, spoken.event)
    if thing is not None and of is not None:
        of = with_thing(of, thing, g.context)
    if of is None:
        return None
    event = first(of, Event)
    match spoken.form:
        case "when":
            return Ask(When(of if first(of, Wanted) is None else affirmed(of)))
        case "where" if event is not None:
            return Ask(Where(event))
        case "how":
            return Ask(HowDecide(of))
        case "sure":
            return Ask(HowSure(of, time=spoken.time))
    return None


def _is_figure(question: HowMuch) -> bool:
    """Tell whether a figure is neither of an event nor of a light."""
    return first(question, Event) is None and not _is_of_light(question)


def _is_of_light(question: Question | None) -> bool:
    """Tell whether it was asked what a light shows."""
    match question:
        case (
            Whether(that=Has(attribute="colour", thing=Feature(kind="light")))
            | HowMuch(of=Measured(attribute="colour", thing=Feature(kind="light")))
        ):
            return True
    return False


def _put(question: Question | None, g: Grounder) -> Proposition | None:
    """Return what a question is about; if it asked what a light shows, what it was said to show."""
    return asserted(g.context) if _is_of_light(question) else questioned(g.context)


def _which(spoken: Elliptic, question: Question | None, g: Grounder) -> Act:
    """Ask which one, or who, is meant, or for whom it was done."""
    thing, event = spoken.thing, main_event(question)
    if thing in (None, _ONES) and isinstance(question, Which):
        return Ask(question)
    if thing is None and isinstance(question, Why) and question.suspect is not None:
        return Ask(replace(question, suspect=None, rival=None, alone=False))  # "who then?"
    open_ = thing is None or (isinstance(thing, Described) and not thing.colour)
    if open_ and (danger := _danger(question, g)) is not None:
        return danger
    named = thing is not None or (isinstance(question, Why) and _named_last(g))
    if not named and event is not None and event.action in FOR_WHOM:
        return Ask(Which(Wanted(), Happens(replace(event, object=Wanted()))))
    return Ask(Identify(thing or Pronoun("it")))


def _named_last(g: Grounder) -> bool:
    """Tell whether "which one?" may be of a vehicle that was named."""
    return isinstance(g.thing(Pronoun("it"), g.window(Unsaid(), "present")), Vehicle)


def _where(spoken: Elliptic, question: Question | None) -> Act | None:
    """Ask where we go, or where a thing is; None: where a deed was."""
    thing = spoken.thing
    if thing is None and _of_our_way(question):
        return Ask(Whither())  # "and then where?"
    if thing is None and main_event(question) is not None:
        return None
    told = isinstance(question, HowMuch) and question.extreme is not None
    if thing is None and question is not None and (told or isinstance(question, Whither)):
        return Ask(question)  # its answer tells where
    return Ask(Where(thing or first(question, Vehicle) or Pronoun("it"), spoken.time))
