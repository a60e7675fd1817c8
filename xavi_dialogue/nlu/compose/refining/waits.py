"""Waits: "what took longer, the light or the people?" asks how long we waited for each."""

from collections.abc import Sequence
from typing import Final

from xavi_dialogue.domain.meaning import Compare, HowLong, Question, Which
from xavi_dialogue.domain.terms import (
    Compares,
    Described,
    Ego,
    Event,
    Feature,
    Measured,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.compose.clauses.clause import Clause

#: Verbs of what takes our time.
_LASTING: Final = frozenset(("take", "cost", "last", "delay", "hold", "keep", "hinder"))


def waits_compared(clause: Clause, found: Sequence[Question]) -> tuple[HowLong, ...]:
    """Return the questions how long we waited for each of those who are compared; () for none."""
    if clause.verb is None or clause.verb.key not in _LASTING or not found:
        return ()
    match found[0]:
        case Compare(options=options, by="size" | "speed" | "time") | Which(
            Wanted(), Compares(Measured("delay", Wanted())), options
        ):
            whom = [one for one in options if isinstance(one, Described | Feature | Vehicle)]
            waits = (Event("wait", Ego(), one, tense="past") for one in whom)
            return tuple(map(HowLong, waits)) if len(whom) > 1 else ()
    return ()
