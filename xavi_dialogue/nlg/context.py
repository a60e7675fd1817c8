"""Context: what the realiser gets besides the answer, and what it returns."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from xavi_dialogue.domain.facts import Look

Style: TypeAlias = Literal["passenger", "paper"]
Detail: TypeAlias = Literal["less", "usual", "more", "simpler"]
#: The look of a vehicle at a time, from a function, or from a table for tests and stored turns.
Looks: TypeAlias = Callable[[int, float], Look | None] | Mapping[tuple[int, float], Look]
#: Causes that were stated: vehicles with what they were expected to do.
Told: TypeAlias = frozenset[tuple[int, tuple[str, ...]]]


@dataclass(frozen=True, slots=True)
class SpeechContext:
    """The situation in which an answer is worded. Equal contexts give equal words."""

    style: Style = "passenger"
    now: float = 0.0  # [s] simulation time
    looks: Looks = field(default_factory=dict)
    named: frozenset[int] = frozenset()  # vehicles that this conversation has named already
    detail: Detail = "usual"
    then: bool = False  # the question named its time, which is in the past
    turn: int = 0  # how many turns were answered before: wording may vary with it
    repeated: bool = False  # the same answer was given to the same question before
    told: Told = frozenset()  # causes that were stated in this conversation
    suggested: frozenset[str] = frozenset()  # questions that recent replies suggested
    max_causes: int = 1
    max_effects: int = 1

    def look(self, vehicle: int, time: float | None = None) -> Look | None:
        """Return how a vehicle looks at a time, by default now."""
        at = self.now if time is None else min(time, self.now)
        if isinstance(self.looks, Mapping):
            found = self.looks.get((vehicle, at))
            return found if found is not None else _nearest(self.looks, vehicle, at)
        return self.looks(vehicle, at)


def _nearest(looks: Mapping[tuple[int, float], Look], vehicle: int, at: float) -> Look | None:
    times = [t for v, t in looks if v == vehicle]
    return looks[vehicle, min(times, key=lambda t: abs(t - at))] if times else None


@dataclass(frozen=True, slots=True)
class Utterance:
    """The words of the car, with what they name and offer."""

    text: str
    mentioned: tuple[int, ...] = ()  # vehicles named in it, in order of first mention
    choices: tuple[str, ...] = ()  # of a clarification, in the order of their numbers
    suggestions: tuple[str, ...] = ()  # questions that can be asked next
