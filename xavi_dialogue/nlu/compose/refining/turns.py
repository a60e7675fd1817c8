"""Turns to come: "is this the last turn?", "any more left turns?" ask how many are left."""

from typing import Any, Final, cast

from xavi_dialogue.domain.meaning import HowMany, Question
from xavi_dialogue.domain.terms import Described, Ego, Event, Pronoun, Rank, Wanted
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import SideOf
from xavi_dialogue.nlu.grammar.lexicon import Leaf

TURNS: Final = ("turn", "exit-left", "exit-right")
_SIDED: Final = {"left": "exit-left", "right": "exit-right"}
_REMAINING: Final = ("leave", "remain", "come")


def turns_to_come(action: str) -> HowMany:
    """Ask how many turns are to come, or how many to one side."""
    return HowMany(Event(cast(Any, action), Ego(), tense="future"))


def turns_asked(clause: Clause, question: Question) -> HowMany | None:
    """Read "how many more turns before we arrive?" as of turns, and not of those who turn."""
    match question:
        case HowMany(Described(doing=Event("turn", Wanted()))) if is_plural(clause.verb):
            return turns_to_come("turn")
    return None


def turns_left(clause: Clause) -> HowMany | None:
    """Read whether there are more turns, or whether this is the last, as how many are to come."""
    verb, subject = clause.verb, clause.subject
    if is_plural(verb):
        if isinstance(subject, SideOf):
            return turns_to_come(_SIDED.get(subject.side, "turn"))  # "any more left turns?"
        return turns_to_come("turn") if clause.there or clause.has("have") else None
    if _is_turn(subject):
        governed = clause.infinitive
        last = verb or (None if governed is None else governed.verb)
        remains = last is not None and last.key in _REMAINING
        return turns_to_come(cast(Event, subject).action) if remains else None
    named = next((sem for sem, _ in clause.objects if _is_turn(sem)), None)
    if named is None or not (verb is None or verb.key == "have"):
        return None
    turn = cast(Event, named)
    final = isinstance(subject, Pronoun) and turn.time == Rank(-1)
    ahead = clause.tense != "past" and (clause.there or (verb is not None and subject == Ego()))
    return turns_to_come(turn.action) if final or ahead else None


def is_plural(verb: Leaf | None) -> bool:
    """Say whether what is read as a verb is a noun: "turns", of which there are several."""
    return verb is not None and verb.key == "turn" and verb.form == "third"


def _is_turn(sem: object) -> bool:
    return isinstance(sem, Event) and sem.action in TURNS and isinstance(sem.actor, Ego)
