"""Decisions: what they could choose from, with outcomes and the terms of the reward."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from planner.record.trace import ACTIONS, OUTCOMES, Action, PlanTrace, RewardTerm, Rollout
from planner.search.comparison import standard_error
from sim.scene import EGO
from xavi_dialogue.causal.effects import HIGH, LOW, quantile
from xavi_dialogue.causal.model import CausalError, CausalModel, Intervention
from xavi_dialogue.dashboard.views.labels import refusals
from xavi_dialogue.explain.causes.plans.chances import chances
from xavi_dialogue.explain.causes.plans.terms import differences
from xavi_dialogue.explain.causes.vehicles.course import brakes, lines
from xavi_dialogue.explain.history.ride import planned
from xavi_dialogue.report.content import Choice, Decided, DecisionRow, Examined
from xavi_dialogue.report.decisions.compared import Weighed, compared, hits, weighed
from xavi_dialogue.report.figures import Figure, Place, Source, rounded
from xavi_dialogue.report.ridden import Ridden
from xavi_dialogue.report.road_users.parties import of_trace

RANGE = "5 to 95 % of the weight, widened to hold the mean"
OF_PLAN = "of the rollouts of the plan, by weight"
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

    def rows(self, plan: Intervention) -> Weighed:
        """Return the rollouts of a plan with their weights."""
        return weighed(self.trace, plan)


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
        value=None if here is None else reward(ground, here),
    )


def chosen_plan(model: CausalModel) -> Intervention | None:
    """Return the results of the plan of a decision, as far as its actions were tried."""
    plan = planned(model.trace)
    try:
        tried = (model.intervene(plan[:length]) for length in range(len(plan), 0, -1))
        return next((found for found in tried if found is not None), None)
    except CausalError:
        return None


def decided(trace: PlanTrace, why: tuple[Examined, ...]) -> Decided:
    """Return a decision in full, with why it is examined."""
    model, plan = CausalModel(trace), planned(trace)
    weights = compared(trace)
    rows = weights or _by_model(model)
    here = model.intervene(plan[:1]) if plan else None
    own = rows.get(plan[0], ()) if plan else ()
    found = [
        _choice(model, action, known, here, own, chosen=(action,) == plan[:1])
        for action, known in rows.items()
    ]
    found.sort(key=lambda one: (not one.chosen, -one.value.value, ACTIONS.index(one.action)))
    return Decided(
        number=trace.decision,
        why=why,
        time=trace.sim_time,
        trace=trace.trace_id,
        plan=plan,
        under_way=None if trace.under_way is None else trace.under_way.action,
        choices=tuple(found),
        ruled_out=dict(
            refusals(((n.action, n.reason) for n in trace.not_applicable if not n.node), rows)
        ),
        costs=trace.reckoned,
        by_weights=bool(weights),
        kept=_kept(Ground(trace), weights, plan[0]) if weights and plan else None,
    )


def _kept(ground: Ground, rows: dict[Action, Weighed], chosen: Action) -> Figure | None:
    """Return the standard error [s] of the comparison with the best option, if that has a lead.

    The planner keeps to what is being driven while the lead is within it. None: the chosen option
    is the best, or the lead is greater.
    """
    values = {action: sum(w * one.reward for one, w in known) for action, known in rows.items()}
    best = max(values, key=lambda action: values[action])
    ours, theirs = rows.get(chosen, ()), rows[best]
    if best == chosen or len(ours) != len(theirs):
        return None
    leads = [b.reward - a.reward for (a, _), (b, _) in zip(ours, theirs, strict=True)]
    error = standard_error([weight for _, weight in ours], leads)
    if values[best] - values[chosen] > error:
        return None
    how = f"standard error of the difference between {chosen} and {best}, by weight"
    return Figure(rounded(error), "s", ground.source("rollouts[*].reward", how))


def _by_model(model: CausalModel) -> dict[Action, Weighed]:
    """Return the same by the causal model, of traces without weights."""
    found: dict[Action, Weighed] = {}
    for action in model.options():
        there = model.intervene((action,))
        if there is not None:
            found[action] = weighed(model.trace, there)
    return found


def _choice(
    model: CausalModel,
    action: Action,
    rows: Weighed,
    here: Intervention | None,
    own: Weighed,
    *,
    chosen: bool,
) -> Choice:
    ground = Ground(model.trace)
    where = "rollouts[*]"
    of = f"of those compared that begin with {action}, by weight"
    shares = {o: sum(w for one, w in rows if one.outcome == o) for o in OUTCOMES}
    there = model.intervene((action,))
    mean = f"mean {of}"
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
                rounded(min(share, 1.0)), "", ground.source(f"{where}.outcome", f"share {of}")
            )
            for outcome, share in shares.items()
            if share > 0.0
        },
        hit={
            vehicle: Figure(
                rounded(share), "", ground.source(f"{where}.collided_with", f"share {of}")
            )
            for vehicle, share in hits(rows).items()
        },
        told=None
        if there is None
        else collision(ground, there, f"of the rollouts that begin with {action}", calibrated=True),
        time=arrival(ground, rows, of),
        braking=hardest(ground, rows, of),
        terms=_terms(ground, rows, of),
        behind=None if chosen else _behind(model, (own, rows), (there, here)),
        samples=len({(one.samples, one.lights, one.phantoms) for one, _ in rows}),
        rollouts=len(rows),
    )


def _terms(ground: Ground, rows: Weighed, of: str) -> dict[RewardTerm, Figure]:
    """Return the expected cost [s] of each term of the reward, largest first."""
    found: dict[RewardTerm, float] = {}
    for one, weight in rows:
        for term, cost in one.terms.items():
            found[term] = found.get(term, 0.0) + weight * cost
    return {
        term: Figure(rounded(cost), "s", ground.source(f"rollouts[*].terms.{term}", f"mean {of}"))
        for term, cost in sorted(found.items(), key=lambda item: -item[1])
    }


def _behind(
    model: CausalModel,
    compared_rows: tuple[Weighed, Weighed],
    plans: tuple[Intervention | None, Intervention | None],
) -> Figure | None:
    """Return by how much [s] the chosen action is better, with the error of the comparison.

    Args:
        model: of the decision.
        compared_rows: the rollouts by which the decision compared the chosen action and this one.
        plans: the same two of the causal model, this one first, for where these do not pair up.
    """
    ours, theirs = compared_rows
    if ours and [_situation(one) for one, _ in ours] == [_situation(one) for one, _ in theirs]:
        leads = [a.reward - b.reward for (a, _), (b, _) in zip(ours, theirs, strict=True)]
        weights = [weight for _, weight in ours]
        value = sum(w * lead for w, lead in zip(weights, leads, strict=True))
        error = standard_error(weights, leads)
        how = "in the same situations"
    else:
        there, here = plans
        if there is None or here is None:
            return None
        known = differences(model, there, here)
        value, error = known.value, known.error
        how = "each by its own samples"
    return Figure(
        rounded(value),
        "s",
        Ground(model.trace).source(
            "rollouts[*].reward",
            f"expected reward of the chosen action minus that of this one, {how}",
        ),
        rounded(value - 2.0 * error),
        rounded(value + 2.0 * error),
        BETWEEN_ERRORS,
    )


def _situation(rollout: Rollout) -> tuple[object, ...]:
    """Return what a rollout drew of the world."""
    return rollout.samples, rollout.lights, rollout.phantoms


def collision(
    ground: Ground,
    plan: Intervention,
    of: str = "of the rollouts of the plan",
    *,
    calibrated: bool = False,
) -> Figure:
    """Return the probability of a collision under a plan, by its rollouts or as answers tell it."""
    share = min(sum(w for one, w in ground.rows(plan) if one.outcome == "collision"), 1.0)
    if calibrated:
        how = f"share {of}, by weight, with the error of the model (ranges.json)"
        return Figure(
            rounded(chances(plan).collision), "", ground.source("rollouts[*].outcome", how)
        )
    low, high = max(share - plan.error, 0.0), min(share + plan.error, 1.0)
    source = ground.source("rollouts[*].outcome", f"share {of}, by weight")
    if rounded(low) == rounded(high):
        return Figure(rounded(share), "", source)
    bound = "bound for what was not sampled, at 95 %"
    return Figure(rounded(share), "", source, rounded(low), rounded(high), bound)


def reward(ground: Ground, plan: Intervention) -> Figure:
    """Return the expected reward [s] of a plan."""
    value = sum(w * one.reward for one, w in ground.rows(plan))
    return Figure(rounded(value), "s", ground.source("rollouts[*].reward", f"mean {OF_PLAN}"))


def hardest(ground: Ground, rows: Weighed, of: str = OF_PLAN) -> Figure | None:
    """Return the hardest braking [m/s2] in rollouts: mean and range."""
    known = lines(ground.trace)

    def braking(one: Rollout) -> float | None:
        line = known.get(one.index)
        return None if line is None else brakes(line)

    return _spread(ground, rows, braking, "m/s2", ("rollouts[*].speed", of))


def arrival(ground: Ground, rows: Weighed, of: str = OF_PLAN) -> Figure | None:
    """Return the time [s] to the goal in the rollouts that reach it: mean and range."""
    field = "rollouts[*].components.time"
    return _spread(ground, rows, lambda one: one.components.get("time"), "s", (field, of))


def _spread(
    ground: Ground,
    rows: Weighed,
    read: Callable[[Rollout], float | None],
    unit: str,
    source: tuple[str, str],
) -> Figure | None:
    """Return the mean of something in rollouts with its range; None where none of them has it.

    Args:
        ground: the decision.
        rows: its rollouts with their weights.
        read: what is read of each.
        unit: of it.
        source: the field, and of which rollouts.
    """
    known = [(value, weight) for one, weight in rows if (value := read(one)) is not None]
    mass = sum(weight for _, weight in known)
    if mass <= 0.0:
        return None
    values, weights = np.array([v for v, _ in known]), np.array([w for _, w in known])
    share, (field, of) = mass / sum(weight for _, weight in rows), source
    part = "" if share > 0.999 else f", the {share:.0%} that have it"
    mean = sum(v * w for v, w in known) / mass
    return Figure(
        rounded(mean),
        unit,
        ground.source(field, f"mean {of}{part}"),
        rounded(min(quantile(values, weights, LOW), mean)),
        rounded(max(quantile(values, weights, HIGH), mean)),
        RANGE,
    )
