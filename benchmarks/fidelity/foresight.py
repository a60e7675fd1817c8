"""The statements of an answer about the foils of a decision."""

import math

import msgspec

from planner.counterfactuals.whatif import replan
from planner.record.trace import Action, Outcome, PlanTrace, Rollout, WhatIf
from planner.roads.trajectory import Roads
from planner.rollouts.waypoints import cost_left
from sim.roads.network import Location
from xavi_dialogue.causal.effects import effects
from xavi_dialogue.causal.model import CausalModel, Intervention
from xavi_dialogue.dialogue.standing import reason_of
from xavi_dialogue.domain.answers import NeedRollout, Reason
from xavi_dialogue.explain.causes.plans.contrast import factual
from xavi_dialogue.explain.causes.vehicles.actions import same
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride, Unanswered

SAMPLED = 0.2  # [s] between the points of a recorded line


class Foreseen(msgspec.Struct, frozen=True):
    """The statement about one foil."""

    outcomes: dict[Outcome, float]  # probabilities; empty if it was declined
    time: float | None = None  # [s] by which the foil is foreseen to arrive later
    low: float | None = None
    high: float | None = None
    declined: Reason | None = None
    plan: tuple[Action, ...] = ()  # the foil with its expected continuation
    extended: float | None = None  # [s] like `time`, to the destination by an estimate of the rest

    @property
    def likeliest(self) -> Outcome | None:
        """The likeliest outcome; None if the foil was declined."""
        return max(self.outcomes, key=lambda o: self.outcomes[o], default=None)


def foresee(trace: PlanTrace, roads: Roads) -> dict[Action, Foreseen]:
    """Return the statements about every foil that applies, by foil."""
    ride = Ride(Record(trace.sim_time, (trace,)))
    fact = trace.plan[0].action
    return {
        foil: _foreseen(trace, roads, foil)
        for foil in ride.model(trace).options()
        if not same(foil, fact)
    }


def _foreseen(
    trace: PlanTrace, roads: Roads, foil: Action, extra: tuple[PlanTrace, ...] = ()
) -> Foreseen:
    ride = Ride(Record(trace.sim_time, (trace,), extra=extra))
    try:
        model, there = ride.evidence(trace, (foil,))
        here = factual(model, trace)
    except Unanswered as unanswered:
        need = unanswered.result
        if isinstance(need, NeedRollout):
            wanted = WhatIf(actions=need.actions, rollouts=need.rollouts)
            again = replan(trace, roads.network, wanted)
            return _foreseen(trace, roads, foil, (*extra, again))
        return Foreseen({}, declined=reason_of(need))
    later = next((e for e in effects(there, here) if e.component == "time"), None)
    found = Foreseen(there.outcomes, plan=there.plan, extended=_extended(model, there, here, roads))
    if later is None:
        return found
    return msgspec.structs.replace(found, time=later.delta, low=later.low, high=later.high)


def _extended(
    model: CausalModel, there: Intervention, here: Intervention, roads: Roads
) -> float | None:
    """Return how much [s] later a foil is at the destination, if rollouts aim for a waypoint."""
    if model.trace.waypoint is None:
        return None
    ours, others = (_arrival(model, plan, roads) for plan in (here, there))
    return None if ours is None or others is None else others - ours


def _arrival(model: CausalModel, plan: Intervention, roads: Roads) -> float | None:
    """Return the mean time [s] to the destination, with free driving from each rollout's end.

    None if, for more than half of the weight, the ego collides, has no way to the destination, or
    its line was not recorded.
    """
    known = {rollout.index: rollout for rollout in model.trace.rollouts}
    total, mass = 0.0, 0.0
    for result, weight in zip(plan.results, plan.weights, strict=True):
        first = result.rollout
        line = first if first.same_as is None else known.get(first.same_as, first)
        time = _to_the_end(model.trace, first, line, roads)
        if time is not None and math.isfinite(time):
            total, mass = total + weight * time, mass + weight
    return total / mass if mass >= 0.5 else None


def _to_the_end(trace: PlanTrace, rollout: Rollout, line: Rollout, roads: Roads) -> float | None:
    """Return the time [s] of one rollout plus that of free driving from its end."""
    taken = rollout.components.get("time")
    if rollout.outcome == "done" and trace.waypoint is not None and taken is not None:
        lane = roads.network.edge_lanes(trace.waypoint.edge)[0]
        return taken + cost_left(roads, Location(lane.id, trace.waypoint.position, 0.0), trace.goal)
    if rollout.outcome == "collision" or not line.path or len(line.path) < 2:
        return None
    (x0, y0), (x1, y1) = line.path[-2:]
    places = roads.network.locate((x1, y1), math.atan2(y1 - y0, x1 - x0))
    if not places:
        return None
    return (len(line.path) - 1) * SAMPLED + cost_left(roads, places[0], trace.goal)
