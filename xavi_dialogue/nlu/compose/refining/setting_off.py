"""Setting off: "why so slow off the line?" asks why we did not go at once."""

from collections.abc import Callable
from dataclasses import replace
from typing import Final, TypeAlias

from xavi_dialogue.domain.meaning import Question, Why
from xavi_dialogue.domain.terms import (
    Compares,
    Ego,
    Event,
    Feature,
    Happens,
    Is,
    Measured,
    Not,
    Proposition,
    Relative,
    Within,
)
from xavi_dialogue.nlu.compose.clauses.clause import Clause

Propose: TypeAlias = Callable[[Clause], Proposition | None]

WENT: Final = Not(Happens(Event("go", Ego(), time=Within(None), tense="past")))
#: Verbs of being under way: with none of these alone does one set off.
_ROLLING: Final = frozenset(("go", "drive", "move", "travel", "roll", "run"))


def set_off_late(clause: Clause, question: Question, propose: Propose) -> Question | None:
    """Read why something took us long, or was slow, as why we did not go, where that is said."""
    match question:
        case Why(
            Compares(
                Measured("duration", Ego(), time=Relative("during" | "after", Event("turn-colour")))
            )
            | Is("slow", Ego(), Event("go"))
        ):
            return Why(WENT)
        case Why(
            Compares(Measured("duration", Ego()), "more", None)
            | Is("slow", Ego())
            | Happens(Event("go", Ego(), manner=("slowly",)))
        ):
            return Why(WENT) if _sets_off(clause, propose) else None
    return None


def _sets_off(clause: Clause, propose: Propose) -> bool:
    """Say whether a clause is of setting off: "to get going", "off the line", "set off"."""
    if (governed := clause.infinitive or clause.gerund) is not None:
        return _goes(propose(replace(governed, subject=Ego())))
    if any(c.key == "from" and isinstance(c.sem, Feature) for c in clause.complements):
        return True
    if clause.verb is None or (clause.verb.key in _ROLLING and not clause.particles):
        return False
    return _goes(propose(replace(clause, subject=Ego(), manner=[], adjectives=[])))


def _goes(deed: Proposition | None) -> bool:
    return isinstance(deed, Happens) and deed.event.action == "go"
