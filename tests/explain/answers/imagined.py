"""Decisions of which it is written down how each drive ended that was imagined of their plan.

Vehicle 1 may do one thing or another, each with a probability; for each, a drive of ours is given.
"""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

from msgspec.structs import replace

from planner.record.trace import SAMPLE_PERIOD, Action, HeldUp, PlanTrace, TimedAction
from tests.explain.answers.given import NOW
from tests.traces import Aim, End, Way, World, straight_track, trace_of

KINDS: tuple[Action, ...] = ("continue", "exit-right", "exit-left", "stop")


@dataclass(frozen=True)
class Drive:
    """One drive of ours, straight on from where we are."""

    probability: float
    speeds: Sequence[float] = (10.0, 10.0)  # [m/s] every 0.2 s
    end: End = End()  # noqa: RUF009
    held_up: tuple[HeldUp, ...] = ()
    starts: Sequence[float] = ()  # [s] of its actions; () one every 2 s


def decided(
    plan: tuple[Action, ...],
    *drives: Drive,
    time: float = NOW,
    under_way: Action | None = None,
    speed: float = 10.0,
) -> PlanTrace:
    """A decision for a plan, with one drive for each thing that vehicle 1 may do."""
    aims = tuple(
        Aim(kind, drive.probability, (Way((kind,)),))
        for kind, drive in zip(KINDS, drives, strict=False)
    )
    ends = {kind: drive.end for kind, drive in zip(KINDS, drives, strict=False)}
    world = World({1: aims}, (plan,), lambda plan, chosen: (ends[chosen[1][0]], len(plan)))
    history = {0: straight_track(time, 0, speed)}
    found = trace_of(world, time=time, history=history, under_way=under_way)
    rollouts = []
    for rollout in found.rollouts:
        drive = drives[rollout.samples[0].goal]
        steps = (SAMPLE_PERIOD * v for v in drive.speeds[:-1])
        xs = itertools.accumulate(steps, initial=0.0)
        starts = drive.starts or [time + 2.0 * k for k in range(len(plan))]
        timed = tuple(TimedAction(a, t) for a, t in zip(plan, starts, strict=True))
        rollouts.append(
            replace(
                rollout,
                path=tuple((x, 0.0) for x in xs),
                speed=tuple(drive.speeds),
                held_up=drive.held_up,
                actions=timed,
            )
        )
    return replace(found, rollouts=tuple(rollouts))
