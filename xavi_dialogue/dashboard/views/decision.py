"""Decisions for browsers: in short form as they are taken, and whole on request."""

from planner.record.hidden_record import Phantom
from planner.record.trace import Action, PlanTrace, VehiclePrediction
from sim.roads.network import Network, point_at
from sim.scene import Point
from xavi_dialogue.causal.effects import effects
from xavi_dialogue.causal.model import Actions, CausalModel, Intervention
from xavi_dialogue.dashboard.views.labels import (
    deed,
    goal_words,
    has_lane_change,
    plan_words,
    refusals,
)
from xavi_dialogue.dashboard.views.map import within
from xavi_dialogue.dashboard.views.right_of_way import right_of_way
from xavi_dialogue.dashboard.views.search_tree import branches, rounded
from xavi_dialogue.dashboard.views.trajectories import chance, likeliest, predicted
from xavi_dialogue.dashboard.web.http_documents import (
    Alternative,
    DecisionShown,
    Drive,
    GoalShown,
    ImaginedShown,
    Predicted,
    TimeRange,
    Way,
)
from xavi_dialogue.dashboard.web.websocket_messages import Belief, Decision
from xavi_dialogue.explain.history.ride import enough


def in_short(trace: PlanTrace, before: PlanTrace | None) -> Decision:
    """Return a decision in short form.

    Args:
        trace: the decision.
        before: the decision before it, if it is known.
    """
    return Decision(
        id=trace.trace_id,
        t=trace.sim_time,
        number=trace.decision,
        plan=_plan(trace),
        words=_capital(plan_words(_plan(trace))),
        changed=before is None or _changed(before, trace),
        beliefs=tuple(map(_belief, trace.predictions)),
    )


def whole(trace: PlanTrace, network: Network | None) -> DecisionShown:
    """Return a decision with all that browsers show of it.

    Args:
        trace: the decision.
        network: the roads; None, or others than those of the decision: not known.
    """
    known = network if network is not None and network.hash == trace.network else None
    model = CausalModel(trace)
    here = chosen_plan(model)
    lines = () if here is None else likeliest(trace, here)
    ego = lines[0] if lines else None
    first = _plan(trace)[:1]
    in_lane = has_lane_change((*first, *model.options()))
    return DecisionShown(
        id=trace.trace_id,
        t=trace.sim_time,
        number=trace.decision,
        seed=trace.seed,
        words=_capital(plan_words(_plan(trace))),
        plan=tuple(
            (one.action, deed(one.action, in_lane=in_lane and k == 0), one.value, one.visits)
            for k, one in enumerate(trace.plan)
        ),
        under_way=None if trace.under_way is None else deed(trace.under_way.action),
        goal=None if known is None else _goal(trace, known),
        view_radius=trace.settings.view_radius,
        ego=ego,
        alternatives=_alternatives(model, here, in_lane),
        predictions=tuple(_predicted(trace, one) for one in trace.predictions),
        root=branches(trace),
        refused=_refused(model),
        right_of_way=None if known is None else right_of_way(trace, known, _path(ego)),
        imagined=tuple(_imagined(one) for one in trace.phantoms if within([one.position])),
        rollouts=len(trace.rollouts),
    )


def chosen_plan(model: CausalModel) -> Intervention | None:
    """Return the expected results of the plan, as far as its actions were tried often enough.

    Where none was, of as many as were tried at all; None where there is no plan.
    """
    plan = _plan(model.trace)
    beginnings = (model.intervene(plan[:length]) for length in range(len(plan), 0, -1))
    tried = [found for found in beginnings if found is not None]
    return next((found for found in tried if enough(found)), tried[0] if tried else None)


def expected_arrival(trace: PlanTrace, plan: Intervention) -> float | None:
    """Return the expected time [s] to the goal; None if rollouts did not reach so far."""
    return None if trace.waypoint is not None else rounded(plan.expectation("time"))


def outcome_shares(plan: Intervention) -> dict[str, float]:
    """Return the weighted share of rollouts by outcome; answers trust the rollouts less."""
    return {name: chance(share) for name, share in plan.outcomes.items() if share > 0.0}


def _plan(trace: PlanTrace) -> Actions:
    return tuple(planned.action for planned in trace.plan)


def _path(drive: Drive | None) -> tuple[float, ...] | None:
    return None if drive is None else drive.path


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _changed(before: PlanTrace, trace: PlanTrace) -> bool:
    """Check whether the next action is a new choice, and not just the old plan's next step."""
    old, new = _plan(before), _plan(trace)
    if old[:1] == new[:1]:
        return False
    done = before.under_way is not None and trace.under_way is None
    reached = done or old[:1] == ("continue",)  # "continue" ends by itself
    return not (reached and old[1:2] == new[:1])


def _belief(known: VehiclePrediction) -> Belief:
    """Return the expected goals of a vehicle; goals with the same name are merged."""
    goals: dict[str, float] = {}
    for goal in known.goals:
        words = goal_words(goal)
        goals[words] = goals.get(words, 0.0) + goal.probability
    ranked = sorted(goals.items(), key=lambda item: -item[1])
    return Belief(known.vehicle, tuple((words, chance(share)) for words, share in ranked))


def _predicted(trace: PlanTrace, known: VehiclePrediction) -> Predicted:
    goals = sorted(known.goals, key=lambda goal: -goal.probability)
    return Predicted(
        vehicle=known.vehicle,
        goals=tuple(
            GoalShown(
                kind=goal.kind,
                words=goal_words(goal),
                place=goal.place,
                prior=chance(goal.prior),
                probability=chance(goal.probability),
                ways=tuple(
                    Way(
                        probability=chance(goal.probability * way.probability),
                        line=predicted(trace, way),
                    )
                    for way in sorted(goal.trajectories, key=lambda way: -way.probability)
                ),
            )
            for goal in goals
        ),
    )


def _imagined(one: Phantom) -> ImaginedShown:
    return ImaginedShown(
        position=one.position,
        heading=one.heading,
        probability=chance(one.probability),
        behind=one.behind,
    )


def _alternatives(
    model: CausalModel, here: Intervention | None, in_lane: bool
) -> tuple[Alternative, ...]:
    """Return the first actions: the chosen one, others that were tried, and inapplicable ones."""
    chosen = _plan(model.trace)[:1]
    tried = [(action, model.intervene((action,))) for action in model.options()]
    found = [
        (there.value, _tried(model.trace, action, there, here, in_lane))
        for action, there in tried
        if there is not None and (action,) != chosen
    ]
    first = [] if here is None else [_tried(model.trace, chosen[0], here, None, in_lane)]
    ranked = [one for _, one in sorted(found, key=lambda pair: -pair[0])]
    rest = [
        _untried(action, reason, in_lane)
        for action, reason in (
            *((action, None) for action, there in tried if there is None and (action,) != chosen),
            *_refused(model),
        )
    ]
    return (*first, *ranked, *rest)


def _tried(
    trace: PlanTrace,
    action: Action,
    there: Intervention,
    here: Intervention | None,
    in_lane: bool,
) -> Alternative:
    """Compare an action that was tried with the chosen one; `here` is None for the latter."""
    line = likeliest(trace, there)
    return Alternative(
        action=action,
        words=deed(action, in_lane=in_lane),
        chosen=here is None,
        outcomes=outcome_shares(there),
        time=None if here is None else _later(there, here),
        arrival=expected_arrival(trace, there),
        value=rounded(there.value),
        rollouts=there.draws,
        distinct=len(there.results),
        line=line[0] if line else None,
        reason=None,
    )


def _untried(action: Action, reason: str | None, in_lane: bool) -> Alternative:
    return Alternative(
        action=action,
        words=deed(action, in_lane=in_lane),
        chosen=False,
        outcomes={},
        time=None,
        arrival=None,
        value=None,
        rollouts=0,
        distinct=0,
        line=None,
        reason=reason,
    )


def _later(there: Intervention, here: Intervention) -> TimeRange | None:
    """Return how much later [s] than the plan an action arrives; None if unknown."""
    found = next((effect for effect in effects(there, here) if effect.component == "time"), None)
    if found is None:
        return None
    return TimeRange(
        delta=round(found.delta, 3), low=round(found.low, 3), high=round(found.high, 3)
    )


def _refused(model: CausalModel) -> tuple[tuple[Action, str], ...]:
    absent = model.trace.not_applicable
    refused = ((one.action, one.reason) for one in absent if not one.node)
    return refusals(refused, model.options())


def _goal(trace: PlanTrace, network: Network) -> Point | None:
    """Return the passenger's destination [m]; None if it is not on these roads."""
    lanes = [lane for lane in network.lanes.values() if lane.edge == trace.goal.edge]
    if not lanes:
        return None
    wanted = [lane for lane in lanes if lane.index == trace.goal.lane] or lanes
    middle = wanted[len(wanted) // 2]
    (x, y), _ = point_at(middle.centreline, trace.goal.position)
    return round(x, 2), round(y, 2)
