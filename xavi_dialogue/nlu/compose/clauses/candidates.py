"""Candidates: what a clause may say, before it is part of a question or claim."""

from dataclasses import dataclass, field
from typing import Any

from xavi_dialogue.domain.terms import Ego, Feature, Proposition, Thing
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Sem, as_thing
from xavi_dialogue.nlu.compose.clauses.senses import Match


@dataclass(frozen=True, slots=True)
class Special:
    """A predicate with a rule of its own: "know", "cost", "make do"."""

    name: str
    clause: Clause
    match: Match
    content: Proposition | None = None  # the clause that it governs

    @property
    def subject(self) -> Thing:
        """Return the subject; the ego if there is none."""
        return as_thing(self.clause.subject) or Ego()

    @property
    def object(self) -> Sem | None:
        """Return the object."""
        return self.match.object

    @property
    def light(self) -> Feature | None:
        """Return the traffic light at which it happens: "how long did we lose at that light"."""
        at = self.match.phrases.get("at")
        return at if isinstance(at, Feature) and at.kind == "light" else None


@dataclass(frozen=True, slots=True)
class Candidate:
    """One reading of a clause."""

    value: Proposition | Special
    cost: float
    left: tuple[Any, ...] = field(default=())
