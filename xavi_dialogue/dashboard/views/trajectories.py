"""Trajectories of a decision: those planned for us and predicted for others."""

from collections.abc import Sequence

from planner.record.trace import SAMPLE_PERIOD, PlanTrace, Rollout, TrajectoryPrediction
from xavi_dialogue.causal.mixtures import Mixture
from xavi_dialogue.dashboard.views import map as roads
from xavi_dialogue.dashboard.web.http_documents import Drive

CHANCES = 4  # decimals of probabilities


def likeliest(trace: PlanTrace, plan: Mixture, limit: int = 1) -> tuple[Drive, ...]:
    """Return the likeliest recorded lines of the ego among some results.

    Rollouts that drive the same line to the same end are one.

    Args:
        trace: the decision of the results.
        plan: the results.
        limit: lines at most.
    """
    known = {
        rollout.index: rollout
        for rollout in trace.rollouts
        if rollout.path and rollout.speed and roads.within(rollout.path)
    }
    weights: dict[tuple[int, str, int | None], float] = {}
    for result, weight in zip(plan.results, plan.weights, strict=True):
        rollout = result.rollout
        origin = rollout.index if rollout.path else rollout.same_as
        if origin in known:
            key = (origin, rollout.outcome, rollout.collided_with)
            weights[key] = weights.get(key, 0.0) + weight
    ranked = sorted(weights.items(), key=lambda item: -item[1])[:limit]
    return tuple(
        _drive(trace, known[origin], outcome, chance(weight), struck)
        for (origin, outcome, struck), weight in ranked
    )


def predicted(trace: PlanTrace, way: TrajectoryPrediction) -> Drive | None:
    """Return the predicted line of another vehicle; None if it is not recorded."""
    if not way.path or not roads.within(way.path):
        return None
    return Drive(
        t=trace.sim_time, dt=SAMPLE_PERIOD, path=roads.line(way.path), speed=_speeds(way.speed)
    )


def chance(value: float) -> float:
    """Return a probability, rounded, and kept to at most 1."""
    return round(min(value, 1.0), CHANCES)


def _drive(
    trace: PlanTrace, rollout: Rollout, outcome: str, probability: float, struck: int | None
) -> Drive:
    return Drive(
        t=trace.sim_time,
        dt=SAMPLE_PERIOD,
        path=roads.line(rollout.path or ()),
        speed=_speeds(rollout.speed or ()),
        outcome=outcome,
        probability=probability,
        collided_with=struck,
    )


def _speeds(speeds: Sequence[float]) -> tuple[float, ...]:
    return tuple([round(speed, roads.CENTIMETRES) for speed in speeds])
