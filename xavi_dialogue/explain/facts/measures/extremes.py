"""Extremes: the highest, lowest, first, last, mean or total value over an interval."""

from collections.abc import Callable, Iterator
from typing import TypeAlias

from msgspec.structs import replace

from sim.scene import EGO
from xavi_dialogue.domain.facts import Gap, Measure
from xavi_dialogue.domain.terms import Thing, Vehicle
from xavi_dialogue.domain.vocabulary import Attribute, Extreme
from xavi_dialogue.explain.facts.approach import closest
from xavi_dialogue.explain.facts.measures.asked import Asked
from xavi_dialogue.explain.facts.measures.driving import jerk_at
from xavi_dialogue.explain.facts.measures.measuring import measure
from xavi_dialogue.explain.facts.measures.trip import standing_within
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.nearing import driven

Span: TypeAlias = tuple[float, float]  # [s]
Series: TypeAlias = Iterator[tuple[float, float]]  # time [s] and value


def extreme(
    states: States,
    attribute: Attribute,
    thing: Thing,
    which: Extreme,
    span: Span,
    to: Thing | None,
) -> Measure:
    """Return the extreme of an attribute over an interval; `time` is when it was reached."""
    begin, end = max(span[0], states.begin), min(span[1], states.ride.now)
    asked = Asked(states, attribute, thing, begin, None if to == thing else to)
    if end < begin - 1e-6:
        late = span[0] > states.ride.now
        return asked.none("in-future" if late else "before-record")
    if attribute == "distance" and which == "lowest":
        found = _closest(asked, begin, end)
        if found is not None:
            return found
    if which == "total":
        return _total(asked, begin, end)
    if which in ("first", "last"):
        return _edge(asked, which, begin, end)
    reader = SERIES.get(attribute, _measured)
    series = list(reader(asked, begin, end))
    if not series:
        return asked.none(_why_not(asked, begin, end))
    return replace(_of(asked, series, which), until=end)


def _why_not(asked: Asked, begin: float, end: float) -> Gap:
    """Return why there is no value in an interval: "not-applicable" before what is not known."""
    gaps = [
        measure(asked.states, asked.attribute, asked.thing, time, asked.to).gap
        for time in (end, (begin + end) / 2.0, begin)
    ]
    known = [gap for gap in gaps if gap is not None]
    return next((gap for gap in known if gap == "not-applicable"), (*known, "not-recorded")[0])


def _of(asked: Asked, series: list[tuple[float, float]], which: Extreme) -> Measure:
    if which == "mean":
        mean = sum(value for _, value in series) / len(series)
        return replace(asked.found(round(mean, 2), time=series[0][0]), extreme="mean")
    sign = 1.0 if which == "highest" else -1.0
    time, value = max(series, key=lambda one: (sign * one[1], -one[0]))
    kind = "highest" if which == "highest" else "lowest"
    found = replace(asked.found(round(value, 2), time=time), extreme=kind)
    if asked.attribute in ("speed", "gap", "headway"):
        there = measure(asked.states, asked.attribute, asked.thing, time, asked.to)
        return replace(found, reference=there.reference, to=there.to or found.to)
    return found


def _edge(asked: Asked, which: Extreme, begin: float, end: float) -> Measure:
    """Return the first or last value in an interval."""
    times = _times(asked, begin, end)
    ordered = times if which == "first" else list(reversed(times))
    for time in (ordered[0], *ordered[1:]) if ordered else ():
        found = measure(asked.states, asked.attribute, asked.thing, time, asked.to)
        if found.gap is None:
            return replace(found, until=end)
    return asked.none(asked.gap() or "not-applicable")


def _total(asked: Asked, begin: float, end: float) -> Measure:
    """Return what adds up over an interval."""
    states, vehicle = asked.states, asked.vehicle
    match asked.attribute:
        case "distance-driven" | "distance":
            value = driven(states.motion(vehicle), begin, end)
        case "waiting-time":
            before = measure(states, "waiting-time", asked.thing, begin, asked.to).value
            after = measure(states, "waiting-time", asked.thing, end, asked.to).value
            value = (after or 0.0) - (before or 0.0)
            if asked.to is None:
                value = standing_within(states, vehicle, begin, end)
        case "time" | "duration":
            value = end - begin
        case "count":
            value = float(sum(_met(states, v, begin, end) for v in states.ride.vehicles))
        case _:
            return asked.none("not-applicable")
    found = asked.found(round(value, 1), time=begin)
    return replace(found, until=end, extreme="total", at_least=states.lost(begin, end))


def _met(states: States, vehicle: int, begin: float, end: float) -> bool:
    """Check whether a vehicle was in view in an interval [s]."""
    return len(states.motion(vehicle).within(begin, end)) > 0


def _closest(asked: Asked, begin: float, end: float) -> Measure | None:
    """Return the closest approach of two bodies; without another one, to any vehicle."""
    others = [asked.other] if asked.other is not None else list(asked.states.ride.vehicles)
    if asked.to is not None and asked.other is None:
        return None
    best: tuple[float, float, int] | None = None
    for other in others:
        found = closest(asked.states, asked.vehicle, other, begin, end)
        if found is not None and (best is None or found.distance < best[0]):
            best = (found.distance, found.time, other)
    if best is None:
        return asked.none("out-of-view")
    value, time, other = best
    found_at = replace(asked.found(round(value, 2), time=time), until=end, extreme="lowest")
    if asked.to is None and asked.vehicle == EGO:
        return replace(found_at, to=Vehicle(other))
    return found_at


def _times(asked: Asked, begin: float, end: float) -> list[float]:
    """Return the moments of the record in an interval; its end if there are none."""
    motion = asked.states.motion(asked.vehicle)
    times = [motion.time[k] for k in motion.within(begin, end)]
    return times or [end]


def _measured(asked: Asked, begin: float, end: float) -> Series:
    """Yield an attribute at each moment at which it has a value."""
    for time in _times(asked, begin, end):
        found = measure(asked.states, asked.attribute, asked.thing, time, asked.to)
        if found.value is not None:
            yield time, found.value


def _speed(asked: Asked, begin: float, end: float) -> Series:
    motion = asked.states.motion(asked.vehicle)
    yield from ((motion.time[k], motion.speed[k]) for k in motion.within(begin, end))


def _rate(sign: float) -> Callable[[Asked, float, float], Series]:
    def read(asked: Asked, begin: float, end: float) -> Series:
        motion = asked.states.motion(asked.vehicle)
        for k in motion.within(begin, end):
            value = motion.rate[k] if sign > 0.0 else max(-motion.rate[k], 0.0)
            yield motion.time[k], value

    return read


def _jerk(asked: Asked, begin: float, end: float) -> Series:
    for time in _times(asked, begin, end):
        value = jerk_at(asked.states, asked.vehicle, time)
        if value is not None:
            yield time, abs(value)


SERIES: dict[Attribute, Callable[[Asked, float, float], Series]] = {
    "speed": _speed,
    "acceleration": _rate(1.0),
    "deceleration": _rate(-1.0),
    "comfort": _rate(-1.0),
    "jerk": _jerk,
}
