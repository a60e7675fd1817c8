"""The manoeuvre that was under way in a recorded decision, as it was planned.

The trace tells which manoeuvre it was, but not from where it was planned. So it is planned from
every place in the ego's history, and the plan that fits best is taken: the ego has driven along
it, and the rollouts drive on along it. That is exact, except for the rounding of the record, and
except where the manoeuvre began between two samples of the history.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from planner.manoeuvres.actions import ActionPlan, Situation, expand
from planner.motion.forward import Motion
from planner.record.trace import SAMPLE_PERIOD, PlanTrace
from planner.roads.routes import Refusal
from planner.roads.trajectory import Array, Path, Roads, relative
from planner.search.inputs import root_at
from sim.scene import EGO, Point, VehicleState

ASIDE = 0.3  # [m] greatest distance of a line from the path; recorded lines are rounded
CLEARLY = 0.01  # [m] by which a plan must fit better than one made later


def resume(roads: Roads, trace: PlanTrace) -> tuple[ActionPlan, Motion] | Refusal | None:
    """Return the manoeuvre under way, and where on it the ego is; None if there is none."""
    if trace.under_way is None:
        return None
    ego, ahead = trace.scene[EGO], _ahead(trace)
    best: ActionPlan | None = None
    least = ASIDE
    for plan, driven in _plans(roads, trace):
        aside, _ = _beside(plan.path, (*driven, *ahead))
        miss = float(np.max(np.abs(aside)))
        if miss < least - (CLEARLY if best else 0.0):
            best, least = plan, miss
    if best is None:
        return Refusal("where that was planned from is not in the record")
    _, arc = _beside(best.path, (ego.position,))
    return best, Motion(float(arc[0]), ego.speed, ego.acceleration)


def _plans(roads: Roads, trace: PlanTrace) -> Iterator[tuple[ActionPlan, tuple[Point, ...]]]:
    """Yield the manoeuvre as planned from each sample of the history, and the positions since.

    The latest one comes first.
    """
    assert trace.under_way is not None
    action, goal, view = trace.under_way.action, trace.goal, trace.settings.view_radius
    for sample in range(len(trace.history[EGO].speed) - 1, -1, -1):
        here = _situation(roads, trace, sample)
        plan = None if here is None else expand(roads, here, action, goal, view)
        if isinstance(plan, ActionPlan):
            yield plan, trace.history[EGO].position[sample:]


def _situation(roads: Roads, trace: PlanTrace, sample: int) -> Situation | None:
    """Return where the ego was at a sample of its history; None where it was off the road."""
    track, now = trace.history[EGO], trace.scene[EGO]
    state = VehicleState(
        track.position[sample],
        track.heading[sample],
        track.speed[sample],
        0.0,
        now.length,
        now.width,
    )
    return root_at(roads, state, track.start + sample * SAMPLE_PERIOD)


def _ahead(trace: PlanTrace) -> tuple[Point, ...]:
    """Return the line [m] that rollouts drive to the manoeuvre's end; () if none is recorded."""
    for rollout in trace.rollouts:
        if rollout.path and len(rollout.actions) > 1:
            samples = round((rollout.actions[1].start - trace.sim_time) / SAMPLE_PERIOD)
            return rollout.path[: samples + 1]
    return ()


def _beside(path: Path, points: Sequence[Point]) -> tuple[Array, Array]:
    """Return how far [m] to the left of a path points lie, and at which arcs [m] of it."""
    xy = np.array(points)
    offsets = path.points[None, :, :] - xy[:, None, :]
    nearest = np.argmin(np.einsum("ijk,ijk->ij", offsets, offsets), axis=1)
    along, aside = relative(path, nearest, xy[:, 0], xy[:, 1])
    return aside, path.arc[nearest] + along
