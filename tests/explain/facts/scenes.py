"""Rides made by hand for tests of the fact layer: everybody's path as a function of time."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from dataclasses import replace as dataclass_replace
from itertools import pairwise
from pathlib import Path

from msgspec.structs import replace

from planner.record.events import Event
from planner.record.places import LightChange, RoadFacts
from planner.record.trace import PlanTrace, Track
from sim.scene import Scene, VehicleState
from tests.traces import Aim, End, Way, World, trace_of
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride
from xavi_dialogue.storage import ride_file

Pose = tuple[float, float, float, float]  # x [m], y [m], heading [rad], speed [m/s]
Path_ = Callable[[float], Pose]
HISTORY = 10.0  # [s]
RECORDED = Path(__file__).parents[3] / "transcripts" / "rides"


@dataclass(frozen=True)
class Actor:
    """A vehicle of a made ride."""

    path: Path_
    kind: str = "car"
    colour: str | None = "blue"
    length: float = 4.8
    since: float = 0.0  # [s] in view from then
    until: float = math.inf  # [s] and up to then
    hidden: tuple[float, float] | None = None  # [s] known but not seen
    lights: tuple[LightChange, ...] = ()
    aims: tuple[Aim, ...] = field(default=(Aim("continue", 1.0, (Way(("continue",)),)),))


def straight(x: float, y: float, speed: float, heading: float = 0.0) -> Path_:
    """Steady driving from a place on."""
    cos, sin = math.cos(heading), math.sin(heading)
    return lambda t: (x + speed * t * cos, y + speed * t * sin, heading, speed)


def speeds(x: float, y: float, marks: Sequence[tuple[float, float]]) -> Path_:
    """Driving east at speeds that change evenly between (time, speed) marks."""

    def speed(t: float) -> float:
        if t <= marks[0][0]:
            return marks[0][1]
        for (t0, v0), (t1, v1) in pairwise(marks):
            if t <= t1:
                return v0 + (v1 - v0) * (t - t0) / (t1 - t0)
        return marks[-1][1]

    def pose(t: float) -> Pose:
        steps = max(round(t / 0.05), 1)
        way = sum(speed((k + 0.5) * t / steps) for k in range(steps)) * t / steps
        return x + way, y, 0.0, speed(t)

    return pose


def shifted(base: Path_, begin: float, end: float, left: float) -> Path_:
    """The same with a lane change to the left between two times [s]."""

    def pose(t: float) -> Pose:
        x, y, heading, speed = base(t)
        share = min(max((t - begin) / (end - begin), 0.0), 1.0)
        aside = left * (1.0 - math.cos(math.pi * share)) / 2.0
        rate = left * math.pi / (2.0 * (end - begin)) * math.sin(math.pi * share)
        slant = math.atan2(rate, max(speed, 0.1)) if 0.0 < share < 1.0 else 0.0
        return x, y + aside, heading + slant, speed

    return pose


def made(
    actors: Mapping[int, Actor],
    until: float,
    *,
    events: Sequence[Event] = (),
    roads: Callable[[float], RoadFacts | None] = lambda _: None,
    gaps: tuple[tuple[float, float], ...] = (),
    ended: bool = False,
    now: float | None = None,
) -> Ride:
    """A ride with a decision each second."""
    record = Record(
        until if now is None else now,
        tuple(moment(actors, float(t), roads(float(t))) for t in range(int(until) + 1)),
        tuple(events),
        ended,
        gaps=gaps,
    )
    return Ride(record)


def moment(actors: Mapping[int, Actor], time: float, road: RoadFacts | None) -> PlanTrace:
    """One decision of a made ride."""
    here = {v: a for v, a in actors.items() if a.since <= time <= a.until}
    world = World(
        {v: a.aims for v, a in here.items() if v != 0},
        (("continue",), ("stop", "continue")),
        lambda plan, _: (End(time=10.0 if plan[0] == "continue" else 20.0), 1),
    )
    tracks = {v: _track(a, time) for v, a in here.items()}
    trace = trace_of(world, time=time, decision=int(time), history=tracks)
    scene = {v: _state(a, time) for v, a in here.items()}
    unseen = {
        v: a.hidden[0]
        for v, a in here.items()
        if a.hidden is not None and a.hidden[0] < time <= a.hidden[1]
    }
    return replace(trace, scene=scene, unseen=unseen, road=road)


def _track(actor: Actor, time: float) -> Track:
    count = int(round(min(time - actor.since, HISTORY) / 0.2, 6))
    start = round(time - 0.2 * count, 3)
    poses = [actor.path(start + 0.2 * k) for k in range(count + 1)]
    lights = tuple(change for change in actor.lights if change.time <= time)
    return Track(
        start,
        tuple((round(x, 2), round(y, 2)) for x, y, _, _ in poses),
        tuple(round(h, 4) for _, _, h, _ in poses),
        tuple(round(v, 2) for *_, v in poses),
        lights,
    )


def _state(actor: Actor, time: float) -> VehicleState:
    x, y, heading, speed = actor.path(time)
    return VehicleState(
        (round(x, 2), round(y, 2)),
        round(heading, 4),
        round(speed, 2),
        0.0,
        actor.length,
        2.5 if actor.kind == "truck" else 1.8,
        actor.kind,
        actor.colour,
    )


def recorded(name: str, now: float | None = None) -> Ride:
    """A ride as it was recorded."""
    found = ride_file.load((RECORDED / f"{name}.ride.jsonl.gz").read_bytes())
    last = found.traces[-1].sim_time
    end = last if found.ended is None else found.ended
    time = end if now is None else now
    return Ride(Record(time, tuple(found.traces), tuple(found.events), now is None))


def kept(ride: Ride, times: Callable[[float], bool]) -> Ride:
    """The same ride with only the decisions of some times [s]."""
    traces = tuple(t for t in ride.record.traces if times(t.sim_time))
    return Ride(dataclass_replace(ride.record, traces=traces))


def glimpsed(
    ride: Ride, time: float, seen: Mapping[int, VehicleState], now: float | None = None
) -> Ride:
    """The same ride with what was seen after its last decision; it is `time` [s] then."""
    scene = Scene(time, dict(seen))
    record = dataclass_replace(ride.record, scene=scene, now=time if now is None else now)
    return Ride(record)
