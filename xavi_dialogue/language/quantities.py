"""Quantities: numbers with their units, rounded and spelt out as a passenger would say them."""

import math
from dataclasses import dataclass
from typing import Literal

KMH = 3.6  # [km/h] per [m/s]
MINUTES = 100.0  # [s] from which a time is told in minutes
HOUR = 3600.0  # [s] beyond which no time is counted
KILOMETRE = 1000.0  # [m] nor a distance
FASTEST = 300  # [km/h] nor a speed
MANY = 10_000  # nor anything else
ROUNDING = 1e-6  # [s]
LATEST = 100 * HOUR  # [s] of a ride


@dataclass(frozen=True, slots=True)
class Quantity:
    """A number with its unit, to be rounded and spelt out."""

    value: float
    unit: Literal["s", "m", "km/h", "probability", "clock", "count"]


@dataclass(frozen=True, slots=True)
class Span:
    """From one quantity to another of the same unit."""

    low: Quantity
    high: Quantity


def quantity(amount: Quantity) -> str:
    """A quantity in words, rounded as a passenger would say it.

    Seconds to a half below 3 s and to a whole above, minutes from 100 s; metres to a whole below
    20 m, to 5 m below 100 m and to 10 m above; speeds to 1 km/h, probabilities to 5 % but never to
    certainty, times of the ride as minutes and full seconds, as clocks do. What is too large to be
    of use is only said to be more than something.
    """
    value = amount.value
    match amount.unit:
        case "s":
            return _seconds(abs(value))
        case "m":
            return _metres(abs(value))
        case "km/h":
            speed = min(value * KMH, 2.0 * FASTEST)
            return f"over {FASTEST} km/h" if speed > FASTEST else f"{nearest(speed)} km/h"
        case "clock":
            return _clock(value)
        case "count":
            return str(nearest(value)) if value <= MANY else f"over {MANY}"
    percent = 5 * nearest(value * 20)
    if percent >= 100:
        return "over 95 %"
    if percent <= 0:
        return "under 5 %"
    return f"{percent} %"


def bare(amount: Quantity) -> str:
    """The number alone, for where its unit follows later: "from 42 to 13 km/h"."""
    if amount.unit == "s":
        return f"{_round_seconds(abs(amount.value)):g}"
    return quantity(amount).removesuffix(" %").removesuffix(" km/h")


def span(amounts: Span, joint: str) -> str:
    """Both ends, with their unit once where it is the same: "2 to 4 seconds".

    Args:
        amounts: the two ends.
        joint: the word between them.
    """
    low, high = quantity(amounts.low), quantity(amounts.high)
    if amounts.low.unit == "s" and abs(amounts.high.value) < MINUTES:
        low = bare(amounts.low)
    elif low.endswith(" minutes") and high.endswith(" minutes"):
        low = low.removesuffix(" minutes")
    return f"{low} {joint} {high}"


def nearest(value: float) -> int:
    """The nearest whole number, halves upwards."""
    return math.floor(value + 0.5)


def _seconds(value: float) -> str:
    if value > HOUR:
        return "more than an hour"
    if value >= MINUTES:
        return f"{nearest(value / 60)} minutes"
    rounded = _round_seconds(value)
    if rounded == 0.5:
        return "half a second"
    return "1 second" if rounded == 1 else f"{rounded:g} seconds"


def _round_seconds(value: float) -> float:
    return nearest(value) if value >= 3 else nearest(value * 2) / 2


def _metres(value: float) -> str:
    if value > KILOMETRE:
        return "more than a kilometre"
    if value < 0.5:
        return "less than a metre"
    step = 1 if value < 20.0 else 5 if value < 100.0 else 10
    rounded = step * nearest(value / step)
    return "1 metre" if rounded == 1 else f"{rounded} metres"


def _clock(value: float) -> str:
    if value > LATEST:
        return f"over {nearest(LATEST / HOUR)} hours"
    whole = math.floor(value + ROUNDING)
    minutes, seconds = divmod(whole, 60)
    if whole <= HOUR:
        return f"{minutes}:{seconds:02d}"
    return f"{minutes // 60}:{minutes % 60:02d}:{seconds:02d}"
