"""A ride as it was seen and decided, for checks of statements.

It shares no code with explain or nlg. SI units; times are simulation seconds.
"""

import math
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise

from planner.record.events import Event
from planner.record.places import RoadPlace
from planner.record.trace import PlanTrace
from sim.boxes import corners, overlap
from sim.scene import EGO, Point, VehicleState
from xavi_dialogue.vehicle.episode import Moment, clock

BRAKING = -0.5  # [m/s2]
BREAK = 1.0  # [s] greatest gap between brakings that count as one


@dataclass(frozen=True)
class Ridden:
    """All moments of a ride, including those after a question."""

    moments: Sequence[Moment]
    times: Sequence[float]
    traces: Sequence[PlanTrace]
    events: Sequence[Event]

    def index(self, time: float) -> int:
        return max(0, bisect_right(self.times, time + 1e-6) - 1)

    def state(self, vehicle: int, time: float) -> VehicleState | None:
        """Return a vehicle as seen at a time [s]; None if it is out of view."""
        return self.moments[self.index(time)].scene.vehicles.get(vehicle)

    def span(self, start: float, end: float) -> list[float]:
        """Return the times of the moments of an interval."""
        inside = self.times[self.index(start) : self.index(end) + 1]
        return [time for time in inside if start - 0.11 <= time]

    def known(self, until: float) -> dict[int, VehicleState]:
        """Return all vehicles seen up to a time [s], each as last seen."""
        found: dict[int, VehicleState] = {}
        for moment in self.moments[: self.index(until) + 1]:
            found.update(moment.scene.vehicles)
        return found

    def decided(self, start: float, end: float) -> list[PlanTrace]:
        """Return the decisions of an interval, with the one in force when it begins."""
        before = [trace for trace in self.traces if trace.sim_time <= start + 1e-6]
        within = [trace for trace in self.traces if start + 1e-6 < trace.sim_time <= end + 1e-6]
        return before[-1:] + within

    def place(self, vehicle: int, time: float) -> RoadPlace | None:
        """Return the place of a vehicle on the road, by the decision in force."""
        trace = self.decided(time, time)[-1]
        return None if trace.road is None else trace.road.places.get(vehicle)

    def gap(self, one: int, other: int, time: float) -> float | None:
        """Return the distance [m] between two vehicles; None if one is out of view."""
        a, b = self.state(one, time), self.state(other, time)
        return None if a is None or b is None else apart(a, b)

    def offset(self, eye: int, other: int, time: float) -> tuple[float, float, float] | None:
        """Return how far [m] the centre of `other` is ahead and to the left of that of `eye`.

        The third value is its relative heading [rad]. None if one is out of view.
        """
        a, b = self.state(eye, time), self.state(other, time)
        if a is None or b is None:
            return None
        (ax, ay), (bx, by) = centre(a), centre(b)
        cos, sin = math.cos(a.heading), math.sin(a.heading)
        turn = math.remainder(b.heading - a.heading, math.tau)
        return (
            (bx - ax) * cos + (by - ay) * sin,
            (by - ay) * cos - (bx - ax) * sin,
            turn,
        )

    def brakings(self, until: float, vehicle: int = EGO) -> list[tuple[float, float]]:
        """Return the stretches in which a vehicle slowed down notably, up to a time."""
        found: list[tuple[float, float]] = []
        for time in self.span(0.0, until):
            state = self.state(vehicle, time)
            if state is None or state.acceleration > BRAKING:
                continue
            if found and time - found[-1][1] <= BREAK:
                found[-1] = (found[-1][0], time)
            else:
                found.append((time, time))
        return [(start, end) for start, end in found if end - start > 0.15]

    def turned(self, vehicle: int, start: float, end: float) -> float:
        """Return the range [rad] of a vehicle's heading within an interval."""
        states = [self.state(vehicle, time) for time in self.span(start, end)]
        seen = [state.heading for state in states if state is not None]
        turns = [math.remainder(b - a, math.tau) for a, b in pairwise(seen)]
        headings = list(accumulate(turns, initial=0.0))
        return max(headings) - min(headings)


def ridden(moments: Sequence[Moment]) -> Ridden:
    """Put the moments of a ride in order for checks."""
    traces = [moment.trace for moment in moments if moment.trace is not None]
    events = [event for moment in moments for event in moment.events]
    return Ridden(moments, [clock(moment) for moment in moments], traces, events)


def centre(state: VehicleState) -> Point:
    """Return the centre of a vehicle [m]."""
    x, y = state.position
    half = state.length / 2.0
    return x - half * math.cos(state.heading), y - half * math.sin(state.heading)


def apart(a: VehicleState, b: VehicleState) -> float:
    """Return the distance [m] between two bodies."""
    if overlap(a, b):
        return 0.0
    one, two = corners(a), corners(b)
    return min(
        min(_to_side(p, q, r) for p in one for q, r in zip(two, two[1:] + two[:1], strict=True)),
        min(_to_side(p, q, r) for p in two for q, r in zip(one, one[1:] + one[:1], strict=True)),
    )


def _to_side(p: Point, q: Point, r: Point) -> float:
    dx, dy = r[0] - q[0], r[1] - q[1]
    length = dx * dx + dy * dy
    share = ((p[0] - q[0]) * dx + (p[1] - q[1]) * dy) / length if length else 0.0
    share = min(1.0, max(0.0, share))
    return math.hypot(p[0] - q[0] - share * dx, p[1] - q[1] - share * dy)
