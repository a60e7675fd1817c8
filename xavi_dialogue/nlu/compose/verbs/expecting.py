"""Expecting: "did he do what you expected?", "did it go the way you predicted?"."""

from typing import Final

from xavi_dialogue.domain.meaning import (
    Doing,
    HowKnow,
    Listing,
    Question,
    Where,
    Whether,
    Whither,
    Why,
)
from xavi_dialogue.domain.terms import (
    Back,
    Ego,
    Event,
    Happens,
    Is,
    Not,
    Proposition,
    Thing,
    Unsaid,
    WholeRide,
)
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import as_thing
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of
from xavi_dialogue.nlu.grammar.chart import Node

_ACTING: Final = frozenset({"do", "go", "act", "behave", "move", "turn", "end"})
_BELIEVING: Final = frozenset(
    {"expect", "predict", "think", "forecast", "anticipate", "foresee", "believe", "reckon",
     "assume", "guess", "suppose", "figure"}
)  # fmt: skip


def of_belief(question: Question, asks: str, held: str) -> Question:
    """Ask for the belief within a question: "why do you think he stops", "what did you think ...".

    A past belief of which no time is said is that of the deed under discussion.
    """
    match question:
        case Why(of=of) if asks == "why":
            return HowKnow(of)
        case (
            Doing(actor=actor, time=time)
            | Whither(actor=actor, time=time)
            | Where(of=Event(action="go", actor=actor, time=time))
        ) if held == "thought":
            if actor is not None and not isinstance(actor, Ego):
                return Listing("beliefs", actor, Back() if time == Unsaid() else time)
    return question


def feared(of: Proposition) -> Proposition:
    """Take that somebody may not stop in time for a collision."""
    event = of.content.event if isinstance(of, Not) and isinstance(of.content, Happens) else None
    if event is None or event.action not in ("stop", "brake") or "early" not in event.manner:
        return of
    ours = isinstance(event.actor, Ego)
    whom = event.object if ours else Ego()
    return Happens(Event("collide", event.actor, whom, time=event.time, tense="future"))


def dreaded_hit(of: Proposition | None) -> Thing | None:
    """Give whom we are said to be afraid to hit: our fear is asked about, not a chance."""
    match of:
        case Happens(event=Event(action="collide" | "nearly-collide", actor=Ego(), object=thing)):
            return thing
    return None


def hindsight(clause: Clause) -> Question | None:
    """Read "what would you do differently": what on the ride went other than we thought."""
    ours = isinstance(clause.subject, Ego) and clause.modal in ("would", "could", "should")
    if not ours or clause.infinitive is not None or "differently" not in clause.focus:
        return None
    return Listing("wrong-predictions", time=WholeRide())


def as_expected(unit: Node, clause: Clause) -> Question | None:
    """Ask whether we were right about somebody; None where nothing else is said of a belief."""
    who = as_thing(clause.subject)
    verb = clause.verb
    if verb is None or verb.key not in _ACTING or who is None or isinstance(who, Ego):
        return None
    if (
        clause.tense not in ("past", "perfect")
        or clause.side is not None
        or clause.that is not None
    ):
        return None
    ours = any(
        leaf.category in ("V", "VPAST", "VED") and leaf.key in _BELIEVING and leaf is not verb
        for leaf in leaves_of(unit)
    )
    return Whether(Is("right", who, tense="past")) if ours else None
