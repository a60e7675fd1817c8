"""Distances: those that are asked for in seconds, or that we keep."""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import HowMuch, Question
from xavi_dialogue.domain.terms import Ego, Event, Measured, Relative, Unsaid
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Group, Moment, Sem

_LENGTHS: Final = ("gap", "distance")
_TIMES: Final = ("s", "min", "h")


def distance_asked(clause: Clause, question: Question) -> Question:
    """Ask for the gap, which has both, where a distance is asked for "in metres and in seconds"."""
    match question:
        case HowMuch(
            of=Measured(
                attribute="gap" | "distance",
                time=Relative("during", Event(action="keep-distance", actor=Ego())),
            ) as of,
            extreme=None,
        ):  # "what distance did you keep to him?": what is kept is as it is now
            question = replace(question, of=replace(of, time=Unsaid(), tense="present"))
    match question:
        case HowMuch(of=Measured(attribute="gap" | "distance") as of) if _in_time(clause):
            ours = isinstance(of.thing, Ego) or of.to is not None
            named = of if ours else replace(of, thing=Ego(), to=of.thing)
            return replace(question, of=replace(named, attribute="gap"))
        case HowMuch(of=Measured(attribute="distance-to-go") as of) if _in_time(clause):
            return replace(question, of=replace(of, attribute="time-to-go"))
    return question


def _in_time(clause: Clause) -> bool:
    """Say whether a clause asks for its measure in a unit of time."""
    return any(phrase.key == "in" and _is_time(phrase.sem) for phrase in clause.complements)


def _is_time(sem: Sem | None) -> bool:
    if isinstance(sem, Group):
        return any(_is_time(member) for member in sem.members)
    return isinstance(sem, Moment) and sem.unit in _TIMES and sem.amount is None
