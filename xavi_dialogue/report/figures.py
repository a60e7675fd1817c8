"""Figures: numbers of a report, each with its source in the record."""

from typing import Literal

import msgspec

#: What a source lies in: a decision of the ride, an event, a scene, or a decision planned again.
Place = Literal["decision", "event", "scene", "replan", "ride"]


class Source(msgspec.Struct, frozen=True, omit_defaults=True):
    """The place in the record that a figure is read from, or computed from."""

    place: Place
    field: str  # path within it, as docs/trace.md names fields: predictions[0].goals[1].probability
    number: int | None = None  # of the decision, event or scene
    time: float | None = None  # [s] simulation time
    trace: str | None = None  # id of the plan trace
    how: str = ""  # computed by this; "" if it stands there as it is


class Figure(msgspec.Struct, frozen=True, omit_defaults=True):
    """One number with its unit, its source, and its interval where there is one."""

    value: float
    unit: str  # SI; "" of probabilities and counts
    source: Source
    low: float | None = None
    high: float | None = None
    interval: str = ""  # what the interval is


def rounded(value: float, digits: int = 4) -> float:
    """Return a computed number with the digits that a report states."""
    return round(value, digits) + 0.0
