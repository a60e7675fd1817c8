"""Cases: what removing or changing others, lights or hidden areas does to a decision."""

from collections.abc import Iterator, Sequence
from itertools import combinations

from planner.record.light_record import GREENS, LightSupposed
from planner.record.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.causal.holdups import hold_ups
from xavi_dialogue.causal.model import CausalModel, Intervention
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.explain.causes.vehicles.necessity import SOMETIMES
from xavi_dialogue.explain.history.ride import planned
from xavi_dialogue.report.decisions.alternatives import Cases, Holding, Supposed, Tested
from xavi_dialogue.report.decisions.controls import reproduced
from xavi_dialogue.report.decisions.weighed import (
    Ground,
    arrival,
    chosen_plan,
    collision,
    hardest,
    reward,
)
from xavi_dialogue.report.figures import Figure, rounded
from xavi_dialogue.report.ridden import Inquiry, predicted

POSSIBLE = 0.05  # probability from which a goal of another is supposed
SURE = 0.95  # ... and up to which: supposing what is believed anyway shows nothing
GOALS = 3  # of one road user that are supposed
RED, GREEN = "r", "G"


def cases(inquiry: Inquiry, trace: PlanTrace, vehicles: Sequence[int]) -> Cases:
    """Plan a decision again with changes of the world, and compare.

    Args:
        inquiry: the record.
        trace: the decision.
        vehicles: those that are removed, and supposed to act otherwise.
    """
    model = CausalModel(trace)
    here, ground = chosen_plan(model), Ground(trace)
    rows = () if here is None else ground.rows(here)
    return Cases(
        decision=trace.decision,
        time=trace.sim_time,
        plan=planned(trace),
        reward=None if here is None else reward(ground, here),
        collision=None if here is None else collision(ground, here),
        braking=hardest(ground, rows),
        arrival=arrival(ground, rows),
        held=() if here is None else tuple(_held(ground, here)),
        tested=tuple(
            _tested(inquiry, trace, supposed, need)
            for supposed, need in _suppositions(trace, vehicles)
        ),
        reproduced=reproduced(inquiry.ridden, trace),
    )


def _suppositions(
    trace: PlanTrace, vehicles: Sequence[int]
) -> Iterator[tuple[Supposed, NeedRollout]]:
    """Yield what is supposed of a decision, with the request for a plan."""
    here = [vehicle for vehicle in vehicles if vehicle in trace.scene]
    of = trace.trace_id
    for vehicle in here:
        yield Supposed("absent", vehicle), NeedRollout(trace_id=of, removed=vehicle)
        yield from _goals(trace, vehicle)
    everybody = tuple(sorted(set(trace.scene) - {EGO}))
    for pair in combinations(here, 2):
        away = tuple(sorted(pair))
        if away != everybody:
            yield Supposed("pair", pair=away), NeedRollout(trace_id=of, removed=away)
    if len(everybody) > 1:
        yield Supposed("empty"), NeedRollout(trace_id=of, removed=everybody)
    lights = () if trace.road is None else trace.road.lights
    for light in lights[:1]:
        state = RED if light.state in GREENS else GREEN
        places = [light.place]
        if state == GREEN:
            places += [x.place for x in lights[1:] if x.controller == light.controller]
        shown = tuple(LightSupposed(light.controller, place, state) for place in places)
        yield Supposed("light", lights=shown), NeedRollout(trace_id=of, lights=shown)
    if any(one.held_by_hidden for one in trace.rollouts):
        seen = tuple(range(len(trace.phantoms)))
        yield Supposed("in-view", phantoms=seen), NeedRollout(trace_id=of, seen_past=seen)


def _goals(trace: PlanTrace, vehicle: int) -> Iterator[tuple[Supposed, NeedRollout]]:
    """Yield the goals that a road user may have, each as if it were certain."""
    found = predicted(trace, vehicle)
    if found is None or len(found[1].goals) < 2:
        return
    at, known = found
    ranked = sorted(enumerate(known.goals), key=lambda pair: -pair[1].probability)
    for k, goal in ranked[:GOALS]:
        if not POSSIBLE <= goal.probability <= SURE:
            continue
        source = Ground(trace).source(f"predictions[{at}].goals[{k}].probability")
        prior = Figure(goal.probability, "", source)
        supposed = Supposed("goal", vehicle, goal.kind, goal.place, prior=prior)
        wanted = goal.edge or goal.kind
        yield supposed, NeedRollout(trace_id=trace.trace_id, vehicle=vehicle, goal=wanted)


def _tested(inquiry: Inquiry, trace: PlanTrace, supposed: Supposed, need: NeedRollout) -> Tested:
    made = inquiry.plan(need)
    if made is None:
        why = inquiry.reasons[need]
        return Tested(supposed, trace.decision, (), None, None, None, None, None, None, why)
    ground, there = Ground(made, "replan"), chosen_plan(CausalModel(made))
    rows = () if there is None else ground.rows(there)
    return Tested(
        supposed=supposed,
        decision=trace.decision,
        plan=planned(made),
        same=planned(made)[:1] == planned(trace)[:1],
        reward=None if there is None else reward(ground, there),
        collision=None if there is None else collision(ground, there),
        braking=hardest(ground, rows),
        time=arrival(ground, rows),
        trace=made.trace_id,
    )


def _held(ground: Ground, plan: Intervention) -> Iterator[Holding]:
    """Yield who or what holds the car up under a plan, vehicles first."""
    found = [one for one in hold_ups(plan).values() if one.expected >= SOMETIMES]
    where = "rollouts[*].held_up"
    for held in sorted(found, key=lambda one: (-one.expected, one.vehicle)):
        yield Holding(
            vehicle=held.vehicle,
            how=held.how,
            expected=Figure(rounded(held.expected), "s", ground.source(where, "mean by weight")),
            share=Figure(rounded(held.share), "", ground.source(where, "share by weight")),
            speeds=(held.speed_from, held.speed_to),
        )
    for how, name in (("light", "held_by_lights"), ("hidden", "held_by_hidden")):
        lasts = [
            (sum(s.until - s.since for s in getattr(result.rollout, name)), weight)
            for result, weight in zip(plan.results, plan.weights, strict=True)
        ]
        expected = sum(length * weight for length, weight in lasts)
        share = sum(weight for length, weight in lasts if length > 0.0)
        if expected >= SOMETIMES:
            where = f"rollouts[*].{name}"
            yield Holding(
                vehicle=None,
                how="light" if how == "light" else "hidden",
                expected=Figure(rounded(expected), "s", ground.source(where, "mean by weight")),
                share=Figure(rounded(min(share, 1.0)), "", ground.source(where, "share by weight")),
            )
