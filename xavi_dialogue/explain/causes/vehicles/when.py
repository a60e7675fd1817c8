"""When: which of several things that happened a time span of a question refers to."""

import math
from collections.abc import Callable, Sequence
from typing import TypeVar

from xavi_dialogue.domain.discourse import Span

Item = TypeVar("Item")
Bounds = tuple[float, float | None]  # [s] begin and end; None while it goes on

LEEWAY = 1.5  # [s] by which passengers misjudge a moment that they name
RECENT = 2.0  # [s] after its end in which something still counts as going on
ROUNDING = 1e-6  # [s]


def past(span: Span | None) -> Span | None:
    """Return a span if it is in the past; None for one that is to come."""
    return span if span is not None and not span.ahead else None


def moment_of(span: Span | None, now: float) -> float:
    """Return the instant [s] that a span stands for: its middle; without a past span, now.

    A span that was only inferred and lasts up to now stands for now.
    """
    found = past(span)
    if found is None or (not found.said and found.end >= now - ROUNDING):
        return now
    return (found.begin + found.end) / 2.0


def meets(span: Span | None, begin: float, end: float | None) -> bool:
    """Check whether something overlaps a span; the bounds of a moment are not taken exactly."""
    found = past(span)
    if found is None:
        return True
    near = LEEWAY if _is_moment(found) else 0.0
    last = math.inf if end is None else end
    return begin <= found.end + near + ROUNDING and last >= found.begin - near - ROUNDING


def pick(span: Span | None, items: Sequence[Item], bounds: Callable[[Item], Bounds]) -> Item | None:
    """Choose the one of several items, oldest first, that a span refers to.

    It is the latest that fits; for a moment, the nearest. What only begins as a span ends, or ends
    as it begins, fits if nothing lies within. If nothing fits, it is the nearest to a span that was
    only inferred, and None if the passenger said when.
    """
    found = past(span)
    if found is None or not items:
        return items[-1] if items else None

    def away(item: Item) -> tuple[float, float]:
        begin, end = bounds(item)
        last = math.inf if end is None else end
        return max(found.begin - last, begin - found.end, 0.0), -begin

    inside = [item for item in items if meets(found, *bounds(item))]
    if inside:
        if _is_moment(found):
            return min(inside, key=away)
        within = [item for item in inside if not _touches(found, *bounds(item))]
        return (within or inside)[-1]
    return None if found.said else min(items, key=away)


def _touches(span: Span, begin: float, end: float | None) -> bool:
    """Check whether something that lasts has no more than a bound in common with a span."""
    last = math.inf if end is None else end
    lasts = last - begin > ROUNDING
    return lasts and min(last, span.end) - max(begin, span.begin) <= ROUNDING


def _is_moment(span: Span) -> bool:
    return span.end - span.begin < LEEWAY
