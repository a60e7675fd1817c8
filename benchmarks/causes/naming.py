"""The vehicles named by an answer, and by rivals that compare seconds or metres."""

import math
from collections.abc import Callable, Mapping

from planner.record.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.domain.answers import Answer, ChoiceReason, MotionReason, Refusal
from xavi_dialogue.domain.evidence import Causation


def named_by(found: Answer | Refusal) -> tuple[int, ...]:
    """Return the vehicles that an answer holds as causes."""
    if isinstance(found, MotionReason):
        named = [cause.vehicle for cause in found.causes if cause.vehicle is not None]
    elif isinstance(found, ChoiceReason):
        named = [cause.vehicle for cause in found.contrast.causes]
        if found.ahead is not None and found.ahead.vehicle is not None:
            named.append(found.ahead.vehicle)
    else:
        return ()
    causation = causation_of(found)
    return tuple(sorted({*named, *(() if causation is None else causation.vehicles)}))


def kind_told(found: Answer | Refusal) -> str | None:
    """Return how, by an answer, the action depends on vehicles; None if it does not say."""
    causation = causation_of(found)
    return None if causation is None else causation.kind


def causation_of(found: Answer | Refusal) -> Causation | None:
    """Return the result of planning without vehicles that an answer holds, if any."""
    if isinstance(found, MotionReason):
        return found.causation
    return found.contrast.causation if isinstance(found, ChoiceReason) else None


def longest(trace: PlanTrace) -> tuple[int, ...]:
    """Return the vehicle that holds the ego up longest in the rollouts of a decision."""
    seconds: dict[int, float] = {}
    for rollout in trace.rollouts:
        for held in rollout.held_up:
            seconds[held.vehicle] = seconds.get(held.vehicle, 0.0) + held.until - held.since
    return tuple(sorted(seconds, key=lambda v: (-seconds[v], v))[:1])


def nearest(trace: PlanTrace) -> tuple[int, ...]:
    """Return the vehicle nearest to the ego in a decision."""
    here = trace.scene[EGO].position
    others = [vehicle for vehicle in trace.scene if vehicle != EGO]
    return tuple(sorted(others, key=lambda v: math.dist(trace.scene[v].position, here))[:1])


RIVALS: Mapping[str, Callable[[PlanTrace], tuple[int, ...]]] = {
    "hold-up": longest,
    "nearest": nearest,
}
