"""Asked: an act in its setting, the input of every explainer.

An explainer is `def name(question: <type of question>, scene: Asked) -> Answer`; it raises
`Unanswered` with a refusal or with the request to plan again.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

from xavi_dialogue.domain.discourse import GroundedAct, Span
from xavi_dialogue.explain.causes.vehicles import when
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.ride import Ride, Unanswered

__all__ = ["LEEWAY", "Asked", "Unanswered"]

LEEWAY = when.LEEWAY  # [s] by which passengers misjudge a moment that they name

Item = TypeVar("Item")


@dataclass(frozen=True, slots=True)
class Asked:
    """An act, the ride and the facts at the moment of asking."""

    ride: Ride
    world: World
    span: Span | None  # the part of the ride that the act is about; None: tense decides
    act: GroundedAct

    @property
    def now(self) -> float:
        """The time of the question [s]."""
        return self.ride.now

    @property
    def past(self) -> Span | None:
        """The part of the ride so far that the act is about; None if nothing says so.

        A part that was only inferred and lasts up to now is the present: None.
        """
        found = when.past(self.span)
        if found is not None and not found.said and found.end >= self.now - when.ROUNDING:
            return None
        return found

    @property
    def moment(self) -> float:
        """The instant that the act is about [s]: the middle of its span, else now."""
        return when.moment_of(self.span, self.now)

    def meets(self, begin: float, end: float | None) -> bool:
        """Check whether something from `begin` to `end` [s] overlaps the span."""
        return when.meets(self.span, begin, end)

    def pick(self, items: Sequence[Item], bounds: Callable[[Item], when.Bounds]) -> Item | None:
        """Choose the one of several items, oldest first, that is asked about: the latest that fits.

        If nothing fits, it is the nearest to a span that was only inferred, and None if the
        passenger said when.
        """
        return when.pick(self.span, items, bounds)
