"""State of affairs: "how are things looking?", "is everything all right?", "can't we go?"."""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Beyond,
    Doing,
    HowDecide,
    Listing,
    Request,
    Summarise,
    WhatIf,
    When,
    Whether,
    Why,
)
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Happens,
    Is,
    Not,
    Pronoun,
    Proposition,
    Related,
    Relative,
    Unknown,
)
from xavi_dialogue.nlu.compose.alternatives.blames import of_one_alone
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.tree import words_of
from xavi_dialogue.nlu.compose.refining.asked import WHEN_WE_GO
from xavi_dialogue.nlu.compose.refining.sounds import of_sounds
from xavi_dialogue.nlu.compose.wh_questions.rating import rating_of
from xavi_dialogue.nlu.grammar.chart import Node

WELL: Final = Ask(Whether(Is("safe", Ego())))
_IN_TIME: Final = Event("stop", manner=("early",), tense="present", modal="could")
#: Words with which it is asked what happens on other rides, too: "is it always this busy?". They
#: do not include "normally", which may also tell how something is done.
_HABITS: Final = frozenset(("always", "usually", "typically", "often"))
_TELLING: Final = frozenset(("state", "give", "name", "specify", "report", "indicate", "provide"))
_THINGS: Final = (
    Described(plural=True, definite=False),
    Pronoun("it"),
    Unknown("everything"),
    Unknown("ride"),
)


def of_affairs(acts: tuple[Act, ...], unit: Node) -> tuple[Act, ...]:
    """Read how things look or go as what we do and whether it is safe."""
    words = words_of(unit)
    acts = tuple(of_one_alone(act, words) for act in acts)
    acts = tuple(map(_when_told, of_sounds(acts, unit)))
    if (rating := rating_of(acts, words)) is not None:
        return rating
    if len(acts) != 1 or not isinstance(acts[0], Ask):
        return acts
    match acts[0].question:
        case HowDecide(
            Related("can-see", thing) | Happens(Event("go", thing, tense="present"))
        ) if thing in _THINGS:
            return Ask(Doing()), WELL
        case HowDecide(Happens(Event("do", Ego(), None, tense="present"))):
            return Ask(Doing()), WELL
        case HowDecide(Happens(Event("do" | "move", Ego(), None, tense="past", modal=None))) if (
            "decide" not in words.split()
        ):
            return (Ask(Summarise()),)  # "so how did you do?", "how was your driving?"
        case HowDecide(Is("wrong", Ego(), tense="past")):
            return (Ask(Listing("wrong-predictions")),)  # "how did you do, any mistakes?"
        case Whether(
            Is("safe" | "better", thing, tense="present")
            | Happens(Event("go", thing, manner=("safely",), tense="present"))
        ) if thing in _THINGS and thing != Pronoun("it"):
            return (WELL,)
        case Whether(that) if (habit := _HABITS & set(words.split())) and _is_present(that):
            ours = isinstance(that, Happens) and that.event.actor == Ego()
            return (Beyond("capability" if ours else "off-topic", min(habit)),)
    return acts


def _when_told(act: Act) -> Act:
    """Read "state when it changed", "give the time at which you stopped" as asking when."""
    match act:
        case Request(
            Event("do", Ego(), Unknown(words=word), time=Relative("during", Event() as then)), False
        ) if word in _TELLING:
            return Ask(When(Happens(then)))
    return act


def _is_present(that: Proposition) -> bool:
    """Check whether a proposition is about the present, and not about what must be."""
    match that:
        case Is(tense=tense) | Related(tense=tense):
            return tense == "present"
        case Happens(event=event):
            return event.tense == "present" and event.modal is None
    return False


def why_not(acts: tuple[Act, ...], unit: Node, clause: Clause) -> tuple[Act, ...]:
    """Read "can't we just go straight?" as the question what keeps us from it.

    "Would we stop short of it?" asks of both of us, so it is no request.
    """
    words = words_of(unit).split()
    match acts:
        case (Request(event, False),) if "have" in words and "we" in words:
            return (Ask(Whether(Happens(replace(event, tense="future", modal="must")))),)
        case (Request(event, False),) if clause.negated and "we" in words and "please" not in words:
            return (Ask(Why(Not(Happens(replace(event, modal="can"))))),)
        case (Request(Event("go", Ego(), time=Relative(anchor=Event("turn-colour"))), False),) if (
            "we" in words and "please" not in words
        ):
            return (Ask(WHEN_WE_GO),)  # "can we go when it turns green?"
        case (Request(event, False),) if "we" in words and _before_others(event):
            able = Happens(replace(event, modal="can"))
            return (Ask(Whether(able)),)  # "could we squeeze through before they cross?"
        case (Request(event, False),) if _of_us_both(words_of(unit)):
            short = _short_of(event)
            return (Ask(short or Whether(Happens(replace(event, modal="would")))),)
    return acts


def _before_others(event: Event) -> bool:
    """Check whether something is to be done before another road user does something."""
    match event.time:
        case Relative(relation="before", anchor=Event(actor=actor)):
            return not isinstance(actor, Ego)
    return False


def _of_us_both(words: str) -> bool:
    """Say whether it is asked what we would do, which nobody asks who wants it done."""
    return "would we" in words and "please" not in words.split()


def _short_of(event: Event) -> WhatIf | None:
    """Read "would we stop short of it?" as whether we could stop if it stood in our way."""
    place = event.where
    if event.action != "stop" or place is None or place.relation != "ahead-of":
        return None
    stands = Event("stop", place.to, where=Related("ahead-of", place.to, Ego()), tense="present")
    return WhatIf(Happens(stands), Whether(Happens(_IN_TIME)))
