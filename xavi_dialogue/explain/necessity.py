"""Necessity: whether a vehicle that is blamed matters, by planning again without it.

Whoever holds the ego up in the rollouts of a foil may be one of many: without it, the next one
would. So the decision is taken again without the vehicle. It matters where another action is
then chosen, or where what spoke for the choice is largely gone.
"""

import math
from collections.abc import Sequence

from msgspec.structs import replace

from xavi_dialogue.causal.model import CausalModel, Intervention
from xavi_dialogue.explain.explanation import Cause
from xavi_dialogue.explain.ride import Ride, enough, planned

MOST = 3  # causes that are tried, and so at most named
LEAST = 0.5  # [s] of reward that must go with the vehicle ...
SHARE = 0.25  # ... and this part of what the plan was better by than the foil


def proven(
    ride: Ride,
    model: CausalModel,
    causes: Sequence[Cause],
    fact: Intervention,
    foil: Intervention | None = None,
) -> tuple[Cause, ...]:
    """The causes that matter; where none does, the first one, marked as not necessary.

    They are ordered by how much goes with each. Those that cannot be tried are kept, with
    `necessary` left open, and come last.

    Args:
        ride: the record.
        model: of the decision.
        causes: most important first.
        fact: what was decided.
        foil: what was not; None where a way of driving is explained.

    Raises:
        Unanswered: rollouts are needed.
    """
    tried = [_tried(ride, model, cause, fact, foil) for cause in causes[:MOST]]
    kept = [one for one in tried if one[0].necessary is not False]
    kept.sort(key=lambda one: math.inf if one[1] is None else -one[1])
    return tuple(cause for cause, _ in kept or tried[:1])


def _tried(
    ride: Ride, model: CausalModel, cause: Cause, fact: Intervention, foil: Intervention | None
) -> tuple[Cause, float | None]:
    """A cause with what planning again without it shows, and how much [s] goes with it."""
    decision = ride.original(model.trace)
    again = ride.without(decision, cause.vehicle)
    if again is None:
        return cause, None
    changes = planned(again)[:1] != planned(decision)[:1]
    gone = _gone(ride.model(again), fact, foil)
    if gone is None:
        return replace(cause, decision_changes=changes, necessary=changes or None), None
    least = LEAST if foil is None else max(LEAST, SHARE * abs(_merit(fact, foil)))
    necessary = changes or gone >= least
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
