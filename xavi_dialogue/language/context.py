"""What the realiser is told besides the answer, and what it hands back."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from planner.trace import Action
from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.explain.query import Detail, Query

Style = Literal["passenger", "paper"]
#: Causes that were told: vehicles with what was expected of them.
Told: TypeAlias = frozenset[tuple[int, tuple[str, ...]]]


@dataclass(frozen=True, slots=True)
class VehicleWords:
    """How one vehicle may be spoken of."""

    kind: Literal["car", "truck"] = "car"
    description: str | None = None  # where it is, seen from us: "the car ahead"


@dataclass(frozen=True, slots=True)
class SpeechContext:
    """The situation in which an answer is given. Two equal contexts give equal words."""

    style: Style = "passenger"
    vehicles: Mapping[int, VehicleWords] = field(default_factory=dict)
    named: frozenset[int] = frozenset()  # vehicles that this conversation has named already
    detail: Detail | None = None
    max_causes: int = 1
    max_effects: int = 1
    now: float = 0.0  # [s] simulation time
    done: tuple[Action, ...] = ()  # what we have carried out so far, latest last
    asked: tuple[Query, ...] = ()  # in this conversation so far, oldest first
    closed: tuple[Query, ...] = ()  # that might be suggested, but would be declined now
    turn: int = 0  # earlier turns of the conversation: wording varies with it
    told: Told = frozenset()  # causes that this conversation has been told of; see `told`
    suggested: frozenset[str] = frozenset()  # what was said lately that could be asked
    repeated: bool = False  # the very same was answered to the very same question before


@dataclass(frozen=True, slots=True)
class Utterance:
    """What the car says."""

    text: str
    mentioned: tuple[int, ...] = ()  # vehicles named in it, in order of first mention
    suggestions: tuple[str, ...] = ()  # questions that can be asked next
    choices: tuple[str, ...] = ()  # of a clarification, in the order they are numbered


def told(found: Explanation) -> Told:
    """The causes that an answer from an explanation tells of, for later answers."""
    return frozenset((cause.vehicle, tuple(cause.actions)) for cause in found.causes)
