"""When: what a question says about time, and the part of the ride that this comes to."""

from collections.abc import Callable, Sequence
from typing import Literal, TypeVar

import msgspec

from xavi_dialogue.explain.query import QueryAction

Relation = Literal["at", "before", "after", "within"]
Landmark = Literal["now", "clock", "start", "end", "junction", "roundabout", "deed", "that"]

ROUNDING = 1e-6  # [s]
Item = TypeVar("Item")


class When(msgspec.Struct, frozen=True, kw_only=True):
    """What the words say, as yet unresolved.

    "Twenty seconds ago" is 20 s before now; "five seconds after you changed lanes" 5 s after a
    deed; "in the last minute" within 60 s before now, "in the next" within 60 s after it. The
    landmark "that" is the time that was spoken of before.
    """

    relation: Relation = "at"
    landmark: Landmark | None = None  # None where only `nth` is said
    seconds: float | None = None  # [s] from the landmark on, or back from it
    rough: bool = False  # the words give no number: "a moment ago", "just now", "earlier"
    ahead: bool = False  # it is to come: "in ten seconds", "at the next junction"
    clock: float | None = None  # [s] time of the ride, where the landmark is that
    until: float | None = None  # [s] time of the ride up to which it lasts
    deeds: tuple[QueryAction, ...] = ()  # any of them, where the landmark is a deed
    actor: str | None = None  # of the deed, as in a Query; None: whoever is asked about
    which: int | None = None  # of several such landmarks; from 1, or from the last one back by -1
    nth: int | None = None  # of the times at which what is asked about happened; the same


class Focus(msgspec.Struct, frozen=True, kw_only=True):
    """The part of a ride that a question is about.

    Of the past it lies within the record; of what is to come, after it.
    """

    start: float  # [s]
    end: float  # [s]
    moment: float  # [s] within it: the instant that is meant, or that stands for all of it
    instant: bool = False  # the words name that instant
    nth: int | None = None  # which of several is meant; None: the last
    counted: bool = False  # the passenger said which
    rough: bool = False  # what lies before it will do as well
    ahead: bool = False  # it is yet to come

    def meets(self, start: float, end: float) -> bool:
        """Whether something from `start` to `end` [s] lies within it, at least in part."""
        if end <= start + ROUNDING or self.end <= self.start + ROUNDING:
            return self.start - ROUNDING <= end and start <= self.end + ROUNDING
        return self.start + ROUNDING < end and start < self.end - ROUNDING


def pick(
    focus: Focus | None, items: Sequence[Item], span: Callable[[Item], tuple[float, float]]
) -> Item | None:
    """The one of several, oldest first, that a question is about; the last where it does not say.

    Args:
        focus: what it says about time, if anything.
        items: what happened, in order.
        span: the start and end [s] of each.
    """
    if focus is None or focus.ahead:
        return items[-1] if items else None
    inside = [item for item in items if focus.meets(*span(item))]
    if not inside and focus.rough:
        inside = [item for item in items if span(item)[1] <= focus.start + ROUNDING][-1:]
    place = -1 if focus.nth is None else focus.nth - 1 if focus.nth > 0 else focus.nth
    return inside[place] if -len(inside) <= place < len(inside) else None


def distance(focus: Focus, start: float, end: float) -> float:
    """How far [s] something from `start` to `end` lies outside a part of the ride."""
    return max(focus.start - end, start - focus.end, 0.0)
