"""Options: what a decision could choose from, and what was expected of each option."""

from collections.abc import Sequence

from msgspec.structs import replace

from planner.record.trace import Action, PlanTrace
from xavi_dialogue.causal.effects import effects
from xavi_dialogue.causal.model import Actions, CausalModel, Intervention, plan_of
from xavi_dialogue.domain.answers import Evidence, Weighing
from xavi_dialogue.domain.facts import OptionValue
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.plans.chances import chances
from xavi_dialogue.explain.causes.plans.contrast import alternatives, factual
from xavi_dialogue.explain.causes.plans.lateness import exceeds
from xavi_dialogue.explain.causes.plans.premise import Premise
from xavi_dialogue.explain.causes.plans.terms import RISK, differences
from xavi_dialogue.explain.causes.vehicles.actions import same
from xavi_dialogue.explain.facts.plans import last_choice
from xavi_dialogue.explain.history.deeds import Deed
from xavi_dialogue.explain.history.ride import Ride, Unanswered, enough, planned

#: Going on, without saying which way.
GOING = frozenset[ActionName](("continue", "go", "move", "keep-lane", "speed-up"))

#: Going on, as decisions call it.
ONWARD = frozenset[Action](("continue", "exit-straight"))


def free(ride: Ride, found: Premise) -> Premise:
    """Find the decision asked about, or the last before it that had a choice."""
    if found.trace.under_way is None:
        return found
    before = [t for t in ride.traces if t.under_way is None and t.sim_time <= found.trace.sim_time]
    deed: Deed | None = found.deed
    return Premise(before[-1], deed) if before else found


def open_at(ride: Ride, found: Premise) -> Premise:
    """Find the decision asked about, or the last before it that had more than one option.

    If none had, it is the last that was free to choose.
    """
    last = free(ride, found)
    if last.node:
        return last
    for trace in reversed(ride.traces):
        late = trace.sim_time > last.trace.sim_time or trace.under_way is not None
        first = planned(trace)[:1]
        if not late and first and alternatives(ride.model(trace), first[0]):
            return last if trace is last.trace else Premise(trace, last.deed)
    return last


def in_force(ride: Ride, at: float) -> Premise:
    """Find the decision in force at a time [s], or the last before it that had a choice.

    Questions about "the decision" that name no action are about this one.
    """
    return open_at(ride, Premise(ride.at(at) or ride.latest, None))


def with_choice(ride: Ride, found: Premise) -> Premise:
    """Find the decision that chose what is under way, with more than one thing to choose from.

    It is the one asked about, or the last before it that chose the same. If none of these had more
    than one option, it is the one asked about.
    """
    found = free(ride, found)
    if found.node or not planned(found.trace):
        return found
    first = planned(found.trace)[0]
    for trace in reversed(ride.traces):
        if trace.sim_time > found.trace.sim_time or trace.under_way is not None:
            continue
        if planned(trace)[:1] != (first,):
            break
        if alternatives(ride.model(trace), first):
            return Premise(trace, found.deed)
    return found


def options_at(ride: Ride, at: float) -> tuple[OptionValue, ...]:
    """List what the last decision with a choice, up to a time [s], could choose from.

    The chosen option comes first.
    """
    trace = last_choice(ride, at)
    return () if trace is None else of_trace(ride, trace)


def of_trace(ride: Ride, trace: PlanTrace) -> tuple[OptionValue, ...]:
    """List what a decision could choose from, the chosen one first, then best first."""
    model, plan = ride.model(trace), planned(trace)
    tried = ((action, model.intervene((action,))) for action in model.options())
    others = [(a, i) for a, i in tried if i is not None and enough(i) and (a,) != plan[:1]]
    try:
        here = factual(model, trace) if plan else None
    except Unanswered:
        here = None
    base = 0.0 if here is None else here.value
    rows = [] if here is None else [_chosen(plan[0], here, base)]
    rows += [_option(model, action, there, here, base) for action, there in others]
    return tuple(sorted(rows, key=lambda row: (not row.chosen, -(row.value or 0.0))))


def risky_onward(ride: Ride) -> OptionValue | None:
    """Return driving straight on, if the latest decision did not choose it for its risk."""
    rows = of_trace(ride, ride.latest) if ride.traces else ()
    onward = (row for row in rows if row.action in ONWARD and not row.chosen)
    return next((row for row in onward if row.collision >= RISK), None)


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
    rows = [_chosen(chosen, here, base)]
    for foil, there in alternatives(model, chosen, node):
        rows.append(_option(model, foil[len(node)], there, here, base))
    return tuple(sorted(rows, key=lambda row: (-(row.value or 0.0), not row.chosen)))


def chosen_over(
    ride: Ride, one: Sequence[ActionName], other: Sequence[ActionName], until: float
) -> tuple[Premise, Actions] | None:
    """Find the last decision up to a time [s] for one of two options and against the other.

    Going on stands for whatever else there was to choose. None if there was no such decision.
    """
    for trace in reversed(ride.traces):
        step = planned(trace)[:1]
        if trace.under_way is not None or trace.sim_time > until or not step:
            continue
        rest = [foil for foil, _ in alternatives(ride.model(trace), step[0])]
        for fact, foil in ((one, other), (other, one)):
            open_to = [way for way in rest if _is_meant(foil, fact, way[0])]
            if open_to and _is_meant(fact, foil, step[0]):
                return Premise(trace, None), open_to[0]
    return None


def _is_meant(names: Sequence[ActionName], beside: Sequence[ActionName], action: Action) -> bool:
    """Check whether a name stands for an option, beside another name."""
    if any(same(name, action) for name in names):
        return True
    return bool(set(names) <= GOING) and not any(same(name, action) for name in beside)


def with_rival(
    ride: Ride, found: Premise, named: Actions = ()
) -> tuple[tuple[OptionValue, ...], Weighing]:
    """Return what a decision chose, the best of the rest or the one named, and how they compare.

    Raises:
        Unanswered: there is too little evidence of what was chosen.
    """
    rows = weighed(ride, found)
    chosen = [row for row in rows if row.chosen]
    others = [row for row in rows if not row.chosen and row.action in (named or (row.action,))]
    if not chosen or not others:
        return rows, "alone"
    model = ride.model(found.trace)
    there = model.intervene((*found.node, others[0].action))
    assert there is not None  # it was valued
    verdict = differences(model, there, factual(model, found.trace)).verdict
    return (*chosen, others[0]), verdict


def _chosen(action: Action, plan: Intervention, value: float) -> OptionValue:
    arrives = plan.likeliest == "done"
    time = plan.expectation("time") if arrives else None
    return _valued(action, plan, value, time=time, delta=None, chosen=True)


def _option(
    model: CausalModel,
    action: Action,
    plan: Intervention,
    here: Intervention | None,
    base: float,
) -> OptionValue:
    """Return the value of an option that was not chosen, relative to the chosen one if known."""
    difference = None if here is None else differences(model, plan, here)
    value = plan.value if difference is None else base - difference.value
    time = delta = None
    if plan.likeliest == "done":
        time = plan.expectation("time")
        known = () if here is None else effects(plan, here)
        delta = next((e.delta for e in known if e.component == "time"), None)
    found = _valued(action, plan, value, time=time, delta=delta, chosen=False)
    found = replace(found, close=difference is not None and difference.verdict == "close")
    if here is None or plan.likeliest != "termination":
        return found
    return replace(found, exceeds=exceeds(model.trace.settings.horizon, plan, here))


def _valued(
    action: Action,
    plan: Intervention,
    value: float,
    *,
    time: float | None,
    delta: float | None,
    chosen: bool,
) -> OptionValue:
    told = chances(plan)
    ends = told.likeliest
    return OptionValue(
        action=action,
        chosen=chosen,
        outcome=ends.name,
        probability=ends.probability,
        time=time,
        delta=delta,
        value=value,
        collision=told.collision,
        collided_with=told.struck,
    )


def situations(found: Premise) -> Evidence:
    """Return how many distinct simulations and situations a decision rests on."""
    trace = found.trace
    distinct = len({rollout.samples for rollout in trace.rollouts})
    simulations = len({(rollout.samples, plan_of(rollout)) for rollout in trace.rollouts})
    return Evidence("tree", simulations, distinct, (trace.trace_id,))
