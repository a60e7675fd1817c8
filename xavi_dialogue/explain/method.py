"""How the ego found its plan, and how it will carry it out."""

from xavi_dialogue.causal.effects import effects
from xavi_dialogue.explain.actions import means
from xavi_dialogue.explain.contrast import (
    alternatives,
    arrival,
    evidence,
    factual,
    outcome,
    to_effects,
)
from xavi_dialogue.explain.course import begins, expected
from xavi_dialogue.explain.deeds import DRIVING, did_not_happen, happened
from xavi_dialogue.explain.details import Step
from xavi_dialogue.explain.explanation import Evidence, Explanation
from xavi_dialogue.explain.premise import Premise, premise
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.ride import Ride, Unanswered, planned
from xavi_dialogue.explain.slowing import explain_driving


def how(query: Query, ride: Ride) -> Explanation:
    """How the ego decided, or, of what is to come, how it will go about it.

    Why it slowed down or gave way is how it decided so: it follows from who is in its way.

    Raises:
        Unanswered: what the question names did not happen, or is not planned.
    """
    driving = tuple(action for action in query.factual or () if action in DRIVING)
    if query.tense == "future" and not ride.ended:
        return _steps(query, ride)
    if driving and not ("stop" in driving and happened(ride, "stop")):
        try:
            return explain_driving(ride, driving, query.tense)
        except Unanswered:
            if query.tense == "past":
                raise
    return _comparison(ride, decision(query, ride))


def decision(query: Query, ride: Ride) -> Premise:
    """The decision asked about; about how it decides as a rule, the last that had a choice."""
    try:
        found = premise(ride, query)
    except Unanswered:
        if query.tense == "past":
            raise
        found = Premise(ride.latest, None)
    if found.trace.under_way is None:
        return found
    free = [t for t in ride.traces if t.under_way is None and t.sim_time <= found.trace.sim_time]
    return Premise(free[-1], found.deed) if free else found


def _comparison(ride: Ride, found: Premise) -> Explanation:
    """What was compared at a decision, with the best alternative as the foil; no causes.

    Raises:
        Unanswered: there is too little evidence of what was chosen.
    """
    trace, node = found.trace, found.node
    model, plan = ride.model(trace), planned(trace)
    chosen = plan[len(node) : len(node) + 1]
    here = factual(model, trace)
    others = alternatives(model, chosen[0], node) if chosen else []
    lost = all(one.likeliest == "dead" for one in (here, *(there for _, there in others)))
    foil, there = others[0] if others and not lost else ((), None)
    situations = len({rollout.samples for rollout in trace.rollouts})
    return Explanation(
        factual=here.plan,
        counterfactual=foil,
        outcome=outcome(there or here),
        effects=() if there is None else to_effects(effects(there, here)),
        causes=(),
        evidence=Evidence("tree", len(trace.rollouts), situations, (trace.trace_id,)),
        sim_time=trace.sim_time,
        arrival=arrival(trace, here),
        options=(*chosen, *(a for a in model.options(node) if a not in chosen)),
    )


def _steps(query: Query, ride: Ride) -> Explanation:
    """The actions of the plan that are still to come, with the times at which they begin.

    Raises:
        Unanswered: the question names an action that is not among them.
    """
    trace = ride.latest
    model = ride.model(trace)
    plan = factual(model, trace)
    asked = query.factual or ()
    wanted = {name for action in asked for name in means(action)}
    steps: list[Step] = []
    for action in dict.fromkeys(plan.plan):
        time = expected(trace, plan, begins(action, (action,)))
        if time is not None:
            steps.append(Step(action, max(time.moment, ride.now)))
        if action in wanted:
            break
    if wanted and (not steps or steps[-1].action not in wanted):
        raise did_not_happen(ride, asked)
    return Explanation(
        factual=plan.plan,
        counterfactual=(),
        outcome=None,
        effects=(),
        causes=(),
        evidence=evidence(model, ride, plan),
        sim_time=ride.now,
        arrival=_left(ride, arrival(trace, plan)),
        steps=tuple(steps),
    )


def _left(ride: Ride, time: float | None) -> float | None:
    return None if time is None else max(ride.latest.sim_time + time - ride.now, 0.0)
