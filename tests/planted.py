"""Tools to make up decisions and rides: what is told by a rule, and not simulated.

Everything lives on an empty plain on which vehicles drive along straight lines.
"""

import itertools
import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace

import msgspec.structs
import numpy as np

from planner.record.events import Event
from planner.record.trace import SAMPLE_PERIOD, Action, PlanTrace, Rollout, Track, WhatIf
from tests.traces import World, joints, prior, trace_of
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.storage import ride_file
from xavi_dialogue.storage.ride_file import RecordedRide

Actions = tuple[Action, ...]
Pace = Callable[[Actions], tuple[float, ...]]  # [m/s] the ego's speeds in rollouts of a plan

LORRY = 2.5  # [m] how wide a lorry is


@dataclass(frozen=True)
class Seen:
    """One vehicle, along a straight line at a speed that is told at some times, linear between."""

    x: float  # [m] east, at 0 s
    y: float  # [m] north
    speeds: tuple[tuple[float, float], ...]  # [s], [m/s]
    kind: str = "car"
    heading: float = 0.0  # [rad]

    def track(self, time: float) -> Track:
        """The 5 s up to a time [s], or since the ride began."""
        last = round(time / SAMPLE_PERIOD)
        first = max(last - 25, 0)
        known, told = zip(*self.speeds, strict=True)
        speeds = np.interp(np.arange(last + 1) * SAMPLE_PERIOD, known, told)
        far = np.concatenate(([0.0], np.cumsum(SAMPLE_PERIOD * speeds[:-1])))
        along = (math.cos(self.heading), math.sin(self.heading))
        positions = [(self.x + along[0] * f, self.y + along[1] * f) for f in far[first:]]
        return Track(
            round(first * SAMPLE_PERIOD, 3),
            tuple((round(float(x), 3), round(float(y), 3)) for x, y in positions),
            (self.heading,) * len(positions),
            tuple(round(float(speed), 3) for speed in speeds[first:]),
        )


@dataclass(frozen=True)
class Moment:
    """A decision to be made up; vehicle 0 is the car itself."""

    world: World
    seen: Mapping[int, Seen]
    time: float  # [s]
    under_way: Action | None = None
    pace: Pace | None = None

    def without(self, vehicle: int) -> "Moment":
        """The same without a vehicle, with what is best then."""
        aims = {v: known for v, known in self.world.aims.items() if v != vehicle}
        seen = {v: one for v, one in self.seen.items() if v != vehicle}
        other = replace(self.world, aims=aims)
        return replace(self, world=replace(other, plan=best(other)), seen=seen)


def decision(at: Moment, what_if: WhatIf | None = None) -> PlanTrace:
    """The decision of a moment, with each plan tried once in every situation."""
    tracks = {v: one.track(at.time) for v, one in at.seen.items()}
    found = trace_of(
        at.world,
        time=at.time,
        decision=round(at.time),
        history=tracks,
        under_way=at.under_way,
    )
    rollouts = found.rollouts if at.pace is None else tuple(_driven(r, at) for r in found.rollouts)
    kinds = {v: at.seen[v].kind for v in found.scene}
    scene = {
        v: replace(s, kind=kinds[v], width=LORRY if kinds[v] == "truck" else s.width)
        for v, s in found.scene.items()
    }
    return msgspec.structs.replace(found, scene=scene, rollouts=rollouts, what_if=what_if)


def without(at: Moment, vehicle: int) -> tuple[NeedRollout, PlanTrace]:
    """What is asked for, and comes out, where the decision is planned without a vehicle."""
    need = NeedRollout(trace_id=decision(at).trace_id, removed=vehicle)
    return need, decision(at.without(vehicle), WhatIf(removed=vehicle))


def best(world: World) -> Actions:
    """The plan with the highest mean reward."""

    def merit(plan: Actions) -> float:
        return sum(
            prior(world.aims, joint)
            * world.simulate(plan, {v: (world.aims[v][g].kind, w) for v, g, w in joint})[0].reward
            for joint in joints(world.aims)
        )

    return max(world.plans, key=merit)


def ride_of(
    moments: Iterable[Moment],
    events: Iterable[Event],
    now: float,
    again: Mapping[float, Iterable[int]] | None = None,
) -> RecordedRide:
    """A ride, with some decisions planned again without some vehicles: by time [s], which."""
    known = tuple(moments)
    plans = [without(at, v) for at in known for v in (again or {}).get(at.time, ())]
    return RecordedRide(
        "made up",
        0,
        now,
        [decision(at) for at in known],
        list(events),
        whatifs={ride_file.key(need): trace for need, trace in plans},
    )


def _driven(rollout: Rollout, at: Moment) -> Rollout:
    """A rollout with a line along which the ego drives at the given pace."""
    assert at.pace is not None
    speeds = at.pace(tuple(timed.action for timed in rollout.actions))
    xs = itertools.accumulate((SAMPLE_PERIOD * speed for speed in speeds[:-1]), initial=0.0)
    here = at.seen[0].track(at.time).position[-1]
    path = tuple((round(here[0] + x, 3), here[1]) for x in xs)
    return msgspec.structs.replace(rollout, path=path, speed=speeds)
