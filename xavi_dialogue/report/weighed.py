"""Decisions: what they could choose from, with outcomes and the terms of the reward."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from planner.record.trace import ACTIONS, OUTCOMES, Action, PlanTrace, RewardTerm, Rollout
from sim.scene import EGO
from xavi_dialogue.causal.effects import HIGH, LOW, quantile
from xavi_dialogue.causal.model import CausalError, CausalModel, Intervention
from xavi_dialogue.explain.causes.plans.chances import chances
from xavi_dialogue.explain.causes.plans.terms import differences
from xavi_dialogue.explain.causes.vehicles.course import brakes, lines
from xavi_dialogue.explain.history.motion import EPSILON
from xavi_dialogue.explain.history.ride import planned
from xavi_dialogue.report.content import Choice, Decided, DecisionRow
from xavi_dialogue.report.figures import Figure, Place, Source, rounded
from xavi_dialogue.report.parties import of_trace
from xavi_dialogue.report.ridden import Ridden

Weighed = Sequence[tuple[Rollout, float]]  # rollouts with their weights
RANGE = "5 to 95 % of the weight"
BETWEEN_ERRORS = "two standard errors to either side"


@dataclass(frozen=True, slots=True)
class Ground:
    """Where figures of rollouts come from."""

    trace: PlanTrace
    place: Place = "decision"

    def source(self, field: str, how: str = "") -> Source:
        """Return the source of a field of the trace."""
        found = self.trace
        return Source(self.place, field, found.decision, found.sim_time, found.trace_id, how)


def row(ridden: Ridden, trace: PlanTrace, before: PlanTrace | None) -> DecisionRow:
    """Return a decision in short."""
    here, ground = chosen_plan(CausalModel(trace)), Ground(trace)
    return DecisionRow(
        number=trace.decision,
        time=trace.sim_time,
        trace=trace.trace_id,
        plan=planned(trace),
        under_way=None if trace.under_way is None else trace.under_way.action,
        changed=before is not None and planned(before)[:1] != planned(trace)[:1],
        speed=Figure(trace.scene[EGO].speed, "m/s", of_trace(trace, f"scene.{EGO}.speed")),
        collision=None if here is None else collision(ground, here),
        value=Figure(trace.plan[0].value, "s", of_trace(trace, "plan[0].value"))
        if trace.plan
        else None,
    )


def chosen_plan(model: CausalModel) -> Intervention | None:
    """Return the results of the plan of a decision, as far as its actions were tried."""
    plan = planned(model.trace)
    try:
        tried = (model.intervene(plan[:length]) for length in range(len(plan), 0, -1))
        return next((found for found in tried if found is not None), None)
    except CausalError:
        return None


def decided(trace: PlanTrace) -> Decided:
    """Return a decision in full."""
    model, plan = CausalModel(trace), planned(trace)
    weights = _by_weights(trace)
    rows = weights or _by_model(model)
    here = model.intervene(plan[:1]) if plan else None
    found = [
        _choice(model, action, weighed, here, chosen=(action,) == plan[:1])
        for action, weighed in rows.items()
    ]
    found.sort(key=lambda one: (not one.chosen, -one.value.value, ACTIONS.index(one.action)))
    return Decided(
        number=trace.decision,
        time=trace.sim_time,
        trace=trace.trace_id,
        plan=plan,
        under_way=None if trace.under_way is None else trace.under_way.action,
        choices=tuple(found),
        ruled_out={one.action: one.reason for one in trace.not_applicable if not one.node},
        costs=trace.reckoned,
        by_weights=bool(weights),
    )


def _by_weights(trace: PlanTrace) -> dict[Action, Weighed]:
    """Return the rollouts that the decision compared, by first action, with their weights."""
    found: dict[Action, list[tuple[Rollout, float]]] = {}
    for one in trace.rollouts:
        if one.weight is not None and one.actions:
            found.setdefault(one.actions[0].action, []).append((one, one.weight))
    return dict(found)


def _by_model(model: CausalModel) -> dict[Action, Weighed]:
    """Return the same by the causal model, of traces without weights."""
    found: dict[Action, Weighed] = {}
    for action in model.options():
        there = model.intervene((action,))
        if there is not None:
            found[action] = weighed_by(there)
    return found


def weighed_by(plan: Intervention) -> Weighed:
    """Return the rollouts of an intervention with their weights."""
    return [(r.rollout, w) for r, w in zip(plan.results, plan.weights, strict=True)]


def _choice(
    model: CausalModel, action: Action, rows: Weighed, here: Intervention | None, *, chosen: bool
) -> Choice:
    ground = Ground(model.trace)
    where = f"rollouts[{','.join(str(one.index) for one, _ in rows)}]"
    shares = {o: sum(w for one, w in rows if one.outcome == o) for o in OUTCOMES}
    there = model.intervene((action,))
    mean = "mean by weight"
    return Choice(
        action=action,
        chosen=chosen,
        value=Figure(
            rounded(sum(w * one.reward for one, w in rows)),
            "s",
            ground.source(f"{where}.reward", mean),
        ),
        chances={
            outcome: Figure(
                rounded(min(share, 1.0)), "", ground.source(f"{where}.outcome", "share by weight")
            )
            for outcome, share in shares.items()
            if share > 0.0
        },
        told=None if there is None else collision(ground, there, calibrated=True),
        time=spread(
            ground, rows, lambda one: one.components.get("time"), "s", f"{where}.components.time"
        ),
        braking=hardest(ground, rows, where),
        terms=_terms(ground, rows, where),
        behind=None if chosen or here is None or there is None else _behind(model, there, here),
        samples=len({(one.samples, one.lights, one.phantoms) for one, _ in rows}),
        rollouts=len(rows),
    )


def _terms(ground: Ground, rows: Weighed, where: str) -> dict[RewardTerm, Figure]:
    """Return the expected cost [s] of each term of the reward, largest first."""
    found: dict[RewardTerm, float] = {}
    for one, weight in rows:
        for term, cost in one.terms.items():
            found[term] = found.get(term, 0.0) + weight * cost
    return {
        term: Figure(rounded(cost), "s", ground.source(f"{where}.terms.{term}", "mean by weight"))
        for term, cost in sorted(found.items(), key=lambda item: -item[1])
    }


def _behind(model: CausalModel, there: Intervention, here: Intervention) -> Figure:
    """Return by how much [s] the chosen action is better, with the error of the comparison."""
    known = differences(model, there, here)
    how = "expected reward of the chosen action minus that of this one, by samples of both"
    return Figure(
        rounded(known.value),
        "s",
        Ground(model.trace).source("rollouts[*].terms", how),
        rounded(known.value - 2.0 * known.error),
        rounded(known.value + 2.0 * known.error),
        BETWEEN_ERRORS,
    )


def collision(ground: Ground, plan: Intervention, *, calibrated: bool = False) -> Figure:
    """Return the probability of a collision under a plan, by its rollouts or as answers tell it."""
    share = min(plan.outcomes["collision"], 1.0)
    if calibrated:
        how = "share by weight, with the error of the model (ranges.json)"
        return Figure(
            rounded(chances(plan).collision), "", ground.source("rollouts[*].outcome", how)
        )
    low, high = max(share - plan.error, 0.0), min(share + plan.error, 1.0)
    source = ground.source("rollouts[*].outcome", "share of rollouts of the plan, by weight")
    if plan.error <= EPSILON:
        return Figure(rounded(share), "", source)
    bound = "bound for what was not sampled, at 95 %"
    return Figure(rounded(share), "", source, rounded(low), rounded(high), bound)


def hardest(ground: Ground, rows: Weighed, where: str) -> Figure | None:
    """Return the hardest braking [m/s2] in rollouts: mean and range."""
    known = lines(ground.trace)

    def braking(one: Rollout) -> float | None:
        line = known.get(one.index)
        return None if line is None else brakes(line)

    return spread(ground, rows, braking, "m/s2", f"{where}.speed")


def spread(
    ground: Ground,
    rows: Weighed,
    read: Callable[[Rollout], float | None],
    unit: str,
    field: str,
) -> Figure | None:
    """Return the mean of something in rollouts with its range; None where none of them has it."""
    known = [(value, weight) for one, weight in rows if (value := read(one)) is not None]
    mass = sum(weight for _, weight in known)
    if mass <= 0.0:
        return None
    values, weights = np.array([v for v, _ in known]), np.array([w for _, w in known])
    share = mass / sum(weight for _, weight in rows)
    of = "mean by weight" if share > 0.999 else f"mean by weight of the {share:.0%} that have it"
    return Figure(
        rounded(sum(v * w for v, w in known) / mass),
        unit,
        ground.source(field, of),
        rounded(quantile(values, weights, LOW)),
        rounded(quantile(values, weights, HIGH)),
        RANGE,
    )
