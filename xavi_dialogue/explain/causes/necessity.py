"""Necessity: whether a vehicle that is blamed matters, by planning again without it.

Whoever holds the ego up in the rollouts of a foil may be one of many: without it, the next one
would. So the decision is taken again without the vehicle. It matters where another action is
then chosen, or where what spoke for the choice is largely gone. A vehicle that does not matter is
no cause, and is told apart as cleared.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from msgspec.structs import replace

from planner.trace import PlanTrace
from xavi_dialogue.causal.model import CausalModel, Intervention
from xavi_dialogue.domain.answers import Cause
from xavi_dialogue.explain.causes.course import lines
from xavi_dialogue.explain.history.ride import Ride, enough, planned

MOST = 3  # causes that are tried, and so at most named
LEAST = 0.5  # [s] of reward that must go with the vehicle ...
SHARE = 0.25  # ... and this part of what the plan was better by than the foil
FASTER = 1.0  # [m/s] by which the ego must be faster without a vehicle that makes it slow


@dataclass(frozen=True, slots=True)
class Proven:
    """The causes that matter, and the vehicles that turned out not to."""

    causes: tuple[Cause, ...]
    cleared: tuple[int, ...]


def proven(
    ride: Ride,
    model: CausalModel,
    causes: Sequence[Cause],
    fact: Intervention,
    foil: Intervention | None = None,
    at: float | None = None,
) -> Proven:
    """Keep the causes that matter, ordered by how much goes with each.

    Those that cannot be tried are kept, with `necessary` left open, and come last.

    Args:
        ride: the record.
        model: of the decision.
        causes: most important first.
        fact: what was decided.
        foil: what was not; None where a way of driving is explained.
        at: [s] when the ego was slow, where it is explained why; a vehicle matters as well where
            the ego would be faster at that time without it.

    Raises:
        Unanswered: rollouts are needed.
    """
    tried = [_tried(ride, model, cause, fact, foil, at) for cause in causes[:MOST]]
    kept = [one for one in tried if one[0].necessary is not False]
    kept.sort(key=lambda one: math.inf if one[1] is None else -one[1])
    cleared = tuple(cause.vehicle for cause, _ in tried if cause.necessary is False)
    return Proven(tuple(cause for cause, _ in kept), cleared)


def _tried(
    ride: Ride,
    model: CausalModel,
    cause: Cause,
    fact: Intervention,
    foil: Intervention | None,
    at: float | None,
) -> tuple[Cause, float | None]:
    """A cause with what planning again without it shows, and how much [s] goes with it."""
    decision = ride.original(model.trace)
    again = ride.without(decision, cause.vehicle)
    if again is None:
        return cause, None
    changes = planned(again)[:1] != planned(decision)[:1]
    gone = _gone(ride.model(again), fact, foil)
    matters = changes and (foil is None or planned(again)[:1] == foil.plan[:1])
    if gone is None:
        return replace(cause, decision_changes=changes, necessary=matters or None), None
    least = LEAST if foil is None else max(LEAST, SHARE * abs(_merit(fact, foil)))
    paced = at is not None and _is_faster(ride, model, again, fact, at)
    necessary = matters or gone >= least or paced
    return replace(cause, decision_changes=changes, necessary=necessary), gone


def _gone(other: CausalModel, fact: Intervention, foil: Intervention | None) -> float | None:
    """How much [s] better off the foil is without the vehicle, or the plan where there is none.

    None where too little is known of that.
    """
    here = _again(other, fact)
    if foil is None:
        return None if here is None else here.value - fact.value
    there = _again(other, foil)
    if here is None or there is None:
        return None
    return _merit(fact, foil) - _merit(here, there)


def _is_faster(
    ride: Ride, model: CausalModel, again: PlanTrace, fact: Intervention, at: float
) -> bool:
    """Whether the ego drives markedly faster at a time [s] without the vehicle."""
    there = _again(ride.model(again), fact)
    if there is None:
        return False
    one, other = speed_at(model.trace, fact, at), speed_at(again, there, at)
    return one is not None and other is not None and other - one >= FASTER


def speed_at(trace: PlanTrace, plan: Intervention, at: float) -> float | None:
    """Tell the expected speed [m/s] of the ego at a time under a plan; None: not recorded."""
    known = lines(trace)
    pairs = [
        (weight, line.speed[k])
        for result, weight in zip(plan.results, plan.weights, strict=True)
        if (line := known.get(result.rollout.index)) is not None
        and (k := line.index(at)) is not None
    ]
    mass = sum(weight for weight, _ in pairs)
    return sum(weight * speed for weight, speed in pairs) / mass if mass > 0.0 else None


def _again(other: CausalModel, intervention: Intervention) -> Intervention | None:
    """The same plan, or at least its beginning, where the vehicle is not there."""
    for length in (len(intervention.plan), 1):
        found = other.intervene(intervention.plan[:length])
        if found is not None and enough(found):
            return found
    return None


def _merit(fact: Intervention, foil: Intervention) -> float:
    """By how much [s] the plan is better than the foil."""
    return fact.value - foil.value
