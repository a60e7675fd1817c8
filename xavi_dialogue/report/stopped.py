"""Stops at a light: when it turned, and how fast one would have had to drive to pass without one.

What follows from distances and times alone: it leaves out traffic ahead, and time to speed up.
"""

import math
from collections.abc import Iterator, Sequence

from planner.record.light_record import GREENS
from planner.record.places import LightAhead
from planner.record.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.report.content import LightSpan
from xavi_dialogue.report.decisions.alternatives import LightStop, Passing
from xavi_dialogue.report.decisions.weighed import Ground
from xavi_dialogue.report.figures import Figure, rounded
from xavi_dialogue.report.ridden import Ridden
from xavi_dialogue.report.road_users.observed import lights
from xavi_dialogue.report.road_users.tracks import Tracks

FASTEST = 60.0  # [m/s] above which no speed is told: the time is all but over


def light_stop(ridden: Ridden, tracks: Tracks, time: float, since: float) -> LightStop | None:
    """Return the light of a stop; None if the decisions before it had none in view.

    Args:
        ridden: the ride.
        tracks: where everybody was.
        time: [s] of the stop.
        since: [s] from which on a decision must have had it in view.
    """
    known = ridden.between(ridden.begin, time)
    last = ridden.between(since, time)
    ahead = next((found for trace in reversed(last) if (found := _next(trace))), None)
    if ahead is None:
        return None
    spans = [
        span
        for span in lights(ridden, (ridden.begin, ridden.end))
        if (span.controller, span.place) == (ahead.controller, ahead.place)
    ]
    turned, again = _turned(spans, time), _again(spans, time)
    return LightStop(
        controller=ahead.controller,
        place=ahead.place,
        turned=turned,
        again=again,
        queue=_queue(known[-1], tracks, time),
        passing=tuple(
            _passing(trace, turned, again)
            for trace in known
            if (there := _next(trace)) is not None
            and (there.controller, there.place) == (ahead.controller, ahead.place)
        ),
    )


def _next(trace: PlanTrace) -> LightAhead | None:
    """Return the next light on the car's way."""
    return None if trace.road is None else next(iter(trace.road.lights), None)


def _turned(spans: Sequence[LightSpan], time: float) -> float | None:
    """Return when [s] the light stopped being green, the last time before the stop."""
    before = [span for span in spans if span.since <= time]
    while before and before[-1].state not in GREENS:
        last = before.pop()
        if before and before[-1].state in GREENS:
            return last.since if last.change_seen else None
    return None


def _again(spans: Sequence[LightSpan], time: float) -> float | None:
    """Return when [s] it was green again."""
    later = (span for span in spans if span.since > time and span.state in GREENS)
    return next((span.since for span in later if span.change_seen), None)


def _passing(trace: PlanTrace, turned: float | None, again: float | None) -> Passing:
    there = _next(trace)
    assert there is not None
    ground = Ground(trace)
    far = Figure(there.distance, "m", ground.source("road.lights[0].distance"))
    place = None if trace.road is None else trace.road.places.get(EGO)

    def mean(until: float | None, what: str) -> Figure | None:
        if until is None or until <= trace.sim_time:
            return None
        value = there.distance / (until - trace.sim_time)
        how = f"divided by the time to {until:g} s, when the light {what}"
        if value > FASTEST:
            return None
        return Figure(rounded(value), "m/s", ground.source("road.lights[0].distance", how))

    return Passing(
        number=trace.decision,
        time=trace.sim_time,
        distance=far,
        speed=Figure(trace.scene[EGO].speed, "m/s", ground.source(f"scene.{EGO}.speed")),
        limit=None
        if place is None
        else Figure(place.limit, "m/s", ground.source(f"road.places.{EGO}.limit")),
        before=mean(turned, "turned") if there.state in GREENS else None,
        after=mean(again, "turned green again"),
    )


def _queue(trace: PlanTrace, tracks: Tracks, time: float) -> tuple[int, ...]:
    """Return who was between the car and the light at a stop, on its road and lane, in order."""
    return tuple(vehicle for _, vehicle in sorted(_ahead(trace, tracks, time)))


def _ahead(trace: PlanTrace, tracks: Tracks, time: float) -> Iterator[tuple[float, int]]:
    road, light = trace.road, _next(trace)
    here = tracks.state(EGO, time)
    if road is None or light is None or here is None or EGO not in road.places:
        return
    ours = road.places[EGO]
    for vehicle, place in road.places.items():
        there = tracks.state(vehicle, time)
        if vehicle == EGO or there is None:
            continue
        if (place.edge, place.lane, place.in_junction) != (ours.edge, ours.lane, False):
            continue
        east, north = (b - a for a, b in zip(here.position, there.position, strict=True))
        way = east * math.cos(here.heading) + north * math.sin(here.heading)
        if 0.0 < way <= light.distance + there.length:
            yield way, vehicle
