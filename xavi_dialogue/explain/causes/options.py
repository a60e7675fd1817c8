"""Options: what a decision weighed, and how each came out."""

from collections.abc import Iterable

from msgspec.structs import replace

from planner.trace import Action
from xavi_dialogue.causal.effects import effects
from xavi_dialogue.causal.model import Intervention, plan_of
from xavi_dialogue.domain.answers import Evidence
from xavi_dialogue.domain.facts import OptionValue
from xavi_dialogue.explain.causes.contrast import alternatives, factual, outcome
from xavi_dialogue.explain.causes.premise import Premise
from xavi_dialogue.explain.causes.ranges import table
from xavi_dialogue.explain.causes.terms import differences
from xavi_dialogue.explain.history.deeds import Deed
from xavi_dialogue.explain.history.ride import Ride, planned


def free(ride: Ride, found: Premise) -> Premise:
    """Find the decision asked about, or the last before it that had a choice."""
    if found.trace.under_way is None:
        return found
    before = [t for t in ride.traces if t.under_way is None and t.sim_time <= found.trace.sim_time]
    deed: Deed | None = found.deed
    return Premise(before[-1], deed) if before else found


def weighed(ride: Ride, found: Premise) -> tuple[OptionValue, ...]:
    """List the options of a decision, best first, the chosen one marked.

    Raises:
        Unanswered: there is too little evidence of what was chosen.
    """
    trace, node = found.trace, found.node
    model, plan = ride.model(trace), planned(trace)
    if len(plan) <= len(node):
        return ()
    here = factual(model, trace)
    chosen = plan[len(node)]
    base = trace.plan[0].value if not node else here.value
    rows = [_option(chosen, here, here, base, min(here.outcomes["collision"], 1.0), chosen=True)]
    for foil, there in alternatives(model, chosen, node):
        difference = differences(model, there, here)
        value, risk = base - difference.value, difference.risks[0]
        rows.append(_option(foil[len(node)], there, here, value, risk, chosen=False))
    return tuple(sorted(rows, key=lambda row: (-(row.value or 0.0), not row.chosen)))


def _option(
    action: Action,
    plan: Intervention,
    here: Intervention,
    value: float,
    risk: float,
    *,
    chosen: bool,
) -> OptionValue:
    ends = outcome(plan)
    delta = next((e.delta for e in effects(plan, here) if e.component == "time"), None)
    arrives = ends.name == "done"
    struck = plan.collisions()
    return OptionValue(
        action=action,
        chosen=chosen,
        outcome=ends.name,
        probability=ends.probability,
        time=plan.expectation("time") if arrives else None,
        delta=None if chosen or not arrives else delta,
        value=value,
        collision=risk,
        collided_with=max(struck, key=lambda v: struck[v]) if struck else None,
        model_error=ends.model_error,
    )


def with_model_error(options: Iterable[OptionValue]) -> tuple[OptionValue, ...]:
    """Return options with how far their rollouts are to be trusted."""
    error = table().model_error
    return tuple(
        option if option.outcome == "dead" else replace(option, model_error=error)
        for option in options
    )


def situations(found: Premise) -> Evidence:
    """Tell how many distinct simulations and situations a decision rests on."""
    trace = found.trace
    distinct = len({rollout.samples for rollout in trace.rollouts})
    simulations = len({(rollout.samples, plan_of(rollout)) for rollout in trace.rollouts})
    return Evidence("tree", simulations, distinct, (trace.trace_id,))
