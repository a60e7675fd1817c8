"""Questions about the ego's own plan and way: what it does and where it goes."""

from msgspec.structs import replace

from sim.scene import EGO
from xavi_dialogue.explain.contrast import arrival, evidence, factual, outcome
from xavi_dialogue.explain.deeds import DRIVING, did_not_happen, happened
from xavi_dialogue.explain.explanation import (
    Activity,
    Destination,
    Evidence,
    Explanation,
)
from xavi_dialogue.explain.premise import premise
from xavi_dialogue.explain.query import Query, QueryAction
from xavi_dialogue.explain.ride import Ride, planned
from xavi_dialogue.explain.slowing import explain_driving


def what(query: Query, ride: Ride) -> Explanation:
    """What the ego did, is doing, or will do."""
    trace = ride.latest
    driving = tuple(action for action in query.factual or () if action in DRIVING)
    if driving and not ("stop" in driving and happened(ride, "stop")):
        return explain_driving(ride, driving, query.tense)
    if query.factual:
        found = premise(ride, query)
        actions: tuple[QueryAction, ...] = query.factual
        moment = found.deed.time if found.deed else None
        return _activity(ride, actions, moment)
    deed = ride.manoeuvre
    if query.tense == "past" and deed is not None:
        return _activity(ride, (deed.action,), deed.time)
    if ride.arrived:
        return where(query, ride)
    if ride.ended:
        raise did_not_happen(ride, ())
    plan: tuple[QueryAction, ...] = planned(trace)
    under_way = ride.under_way
    if under_way is not None and under_way.action == plan[0]:
        begun = under_way.carried_out
        if query.tense == "future" and begun and len(plan) > 1:
            plan = plan[1:]
        elif query.tense == "present" and not begun:
            plan = ("continue", *plan)  # up to the junction it only follows the lane
    return _activity(ride, plan, None)


def where(query: Query, ride: Ride) -> Explanation:
    """Where the ego is going."""
    del query
    goal = ride.latest.goal
    found = of_plan(ride, destination=Destination(EGO, goal.edge))
    return replace(found, arrival=0.0) if ride.arrived else found


def _activity(ride: Ride, actions: tuple[QueryAction, ...], moment: float | None) -> Explanation:
    """Actions that are known, with the ego's speed now."""
    trace, motion = ride.latest, ride.motion(EGO)
    speed = motion.speed[-1] if motion.speed else None
    return Explanation(
        factual=planned(trace),
        counterfactual=(),
        outcome=None,
        effects=(),
        causes=(),
        evidence=Evidence("tree", 0, 0, (trace.trace_id,)),
        activity=Activity(EGO, actions, None, speed, motion.trend),
        sim_time=ride.now,
        moment=moment,
    )


def of_plan(ride: Ride, destination: Destination | None = None) -> Explanation:
    """The latest plan, and how long it probably still takes; at least, where it aims nearer."""
    trace = ride.latest
    model = ride.model(trace)
    plan = factual(model, trace)
    passed = ride.now - trace.sim_time
    ends = outcome(plan)
    expected = arrival(trace, plan) if ends.name == "done" else None
    left = None if expected is None else max(expected - passed, 0.0)
    partly = [time for _, _, time in plan.present("time")] if trace.waypoint is not None else []
    if ends.name == "termination":
        partly = [trace.settings.horizon]
    return Explanation(
        factual=plan.plan,
        counterfactual=(),
        outcome=ends,
        effects=(),
        causes=(),
        evidence=evidence(model, ride, plan),
        sim_time=ride.now,
        arrival=left,
        least=max(min(partly) - passed, 0.0) if partly else None,
        destination=destination,
    )
