"""Predictions that were wrong (`explain/history/predicted_roads.py`), and whether they mattered.

One mattered if the same decision, planned again with the vehicle going where it went, chooses
another first action.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

from planner.counterfactuals.whatif import WhatIfError
from planner.record.trace import Action
from sim.scene import EGO
from xavi_dialogue.audit.rides.choices import choice
from xavi_dialogue.audit.rides.naming import name
from xavi_dialogue.audit.values import Mistake
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.explain.causes.plans.margins import value, weighed
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.predicted_roads import Wrong, wrong_predictions
from xavi_dialogue.library.ride import Ride
from xavi_dialogue.service.in_process import NoPlan


@dataclass(frozen=True, slots=True)
class _Weight:
    """What a decision would have been with the truth."""

    mattered: bool | None
    instead: Action | None = None
    gain: float | None = None  # [s]


def mistakes(ride: Ride, known: World) -> tuple[Mistake, ...]:
    """Return the wrong predictions of a ride, by vehicle and then by time."""
    found = sorted(
        wrong_predictions(ride.record.traces), key=lambda one: (one.vehicle, one.trace.decision)
    )
    groups = groupby(found, key=lambda one: (one.vehicle, one.expected.edge, one.truth.edge))
    return tuple(_mistake(ride, known, list(group)) for _, group in groups)


def _mistake(ride: Ride, known: World, wrong: Sequence[Wrong]) -> Mistake:
    weights = [_weight(ride, one) for one in wrong]
    order = sorted(range(len(wrong)), key=lambda k: (-_rank(weights[k]), k))
    worst, weight = wrong[order[0]], weights[order[0]]
    first, vehicle = wrong[0], worst.vehicle
    taken = choice(worst.trace)
    return Mistake(
        vehicle=vehicle,
        who=name(known, vehicle, worst.trace.sim_time),
        begin=first.trace.sim_time,
        end=wrong[-1].trace.sim_time,
        expected=first.expected.place,
        probability=round(max(one.expected.probability for one in wrong), 3),
        came=first.truth.place,
        given=round(min(one.truth.probability for one in wrong), 3),
        came_at=first.came_at,
        mattered=weight.mattered,
        at=worst.trace.sim_time,
        trace_id=worst.trace.trace_id,
        chosen=None if taken is None else taken.chosen,
        instead=weight.instead,
        gain=weight.gain,
    )


def _rank(weight: _Weight) -> float:
    """Return how much a mistake matters; less than 0 if it cannot be told."""
    if weight.mattered is None:
        return -1.0
    return 1.0 + max(weight.gain or 0.0, 0.0) if weight.mattered else 0.0


def _weight(ride: Ride, wrong: Wrong) -> _Weight:
    """Plan a decision again with a vehicle going where it went."""
    trace = wrong.trace
    if choice(trace) is None or EGO not in trace.scene:
        return _Weight(False)  # there was nothing to choose from
    need = NeedRollout(trace.trace_id, vehicle=wrong.vehicle, goal=wrong.truth.edge)
    try:
        again = ride.again(trace, need)
    except (WhatIfError, NoPlan):
        return _Weight(None)
    tried, before, now = weighed(again), trace.plan[0].action, again.plan[:1]
    if not now or now[0].action == before:
        return _Weight(False)
    action = now[0].action
    gain = value(tried[action]) - value(tried[before]) if {action, before} <= set(tried) else None
    return _Weight(True, action, None if gain is None else round(gain, 3))
