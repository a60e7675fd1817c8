"""When: what happened, what the ego's plan leads to, and how long that takes."""

from msgspec.structs import replace

from sim.scene import EGO
from xavi_dialogue.causal.model import CausalModel, Intervention
from xavi_dialogue.explain.actions import means
from xavi_dialogue.explain.causes import holding_up
from xavi_dialogue.explain.contrast import evidence, factual
from xavi_dialogue.explain.course import Expected, begins, expected, lines, moves_on
from xavi_dialogue.explain.deeds import did_not_happen, happened
from xavi_dialogue.explain.explanation import Activity, Explanation
from xavi_dialogue.explain.motion import STANDING
from xavi_dialogue.explain.present import of_plan, what, where
from xavi_dialogue.explain.query import Query, QueryAction
from xavi_dialogue.explain.ride import Ride, decline

ARRIVAL = "arrival"  # `Query.event` of whether or when somebody gets to his destination
LIKELY = 0.5  # share of the rollouts from which something is expected
HALTED: tuple[QueryAction, ...] = ("stop", "give-way")


def when(query: Query, ride: Ride) -> Explanation:
    """When something happened or will happen; without an action, when the ego arrives.

    Raises:
        Unanswered: it did not happen and is not expected, or the record does not tell.
    """
    if not query.factual:
        return _arrival(query, ride)
    if query.tense == "past" or ride.ended:
        return _known(query, ride)
    action = query.factual[0]
    motion = ride.motion(EGO)
    standing = bool(motion.speed) and motion.speed[-1] < STANDING
    if action in (*HALTED, "continue") and standing:
        return _waiting(ride)
    deed = happened(ride, action)
    if deed is not None and deed.ended is None:
        return _known(query, ride)
    return _ahead(query, ride, action)


def _arrival(query: Query, ride: Ride) -> Explanation:
    if query.event == ARRIVAL:
        return _arrived(ride)
    if ride.arrived and query.tense != "past":
        return where(query, ride)
    if query.tense == "past" or ride.ended:
        return what(query, ride)
    return of_plan(ride)


def _arrived(ride: Ride) -> Explanation:
    """When the ego arrived; how long that still takes, where it has not.

    Raises:
        Unanswered: the ride ended elsewhere.
    """
    if ride.ended and not ride.arrived:
        raise did_not_happen(ride, ())
    times = [event.sim_time for event in ride.events if event.kind == "arrived"]
    return replace(of_plan(ride), arrival=0.0, moment=times[0]) if times else of_plan(ride)


def _known(query: Query, ride: Ride) -> Explanation:
    found = what(query, ride)
    if found.done and query.tense == "past":
        raise did_not_happen(ride, query.factual or ())
    if found.moment is None:
        raise decline("outside-record", vehicle=EGO)
    return found


def _ahead(query: Query, ride: Ride, action: QueryAction) -> Explanation:
    """When the plan will probably lead to an action.

    Raises:
        Unanswered: it probably will not.
    """
    model, plan = _plan(ride)
    found = expected(model.trace, plan, begins(action, means(action)))
    if found is None or found.share < LIKELY or found.moment < ride.now:
        raise did_not_happen(ride, query.factual or ())
    return _expected(ride, model, plan, found)


def _waiting(ride: Ride) -> Explanation:
    """When the ego, which stands, will drive on, and for whom it waits."""
    model, plan = _plan(ride)
    found = expected(model.trace, plan, moves_on)
    motion = ride.motion(EGO)
    standing = Activity(EGO, ("stop",), None, motion.speed[-1], "standing")
    if found is None or found.share < LIKELY:
        ends = [line.time[-1] for line in lines(model.trace).values() if line.time]
        if not ends:
            raise decline("outside-record", vehicle=EGO)
        least = max(max(ends) - ride.now, 0.0)
        return replace(_bare(ride, model, plan), activity=standing, least=least)
    explained = _expected(ride, model, plan, found)
    waited_for = holding_up(model, plan, (ride.now, max(found.moment, ride.now)))
    return replace(explained, activity=standing, causes=waited_for)


def _expected(ride: Ride, model: CausalModel, plan: Intervention, found: Expected) -> Explanation:
    now = ride.now
    span = (max(found.low, now), max(found.high, now))
    return replace(_bare(ride, model, plan), moment=max(found.moment, now), span=span)


def _bare(ride: Ride, model: CausalModel, plan: Intervention) -> Explanation:
    return Explanation(
        factual=plan.plan,
        counterfactual=(),
        outcome=None,
        effects=(),
        causes=(),
        evidence=evidence(model, ride, plan),
        sim_time=model.trace.sim_time,
    )


def _plan(ride: Ride) -> tuple[CausalModel, Intervention]:
    trace = ride.latest
    model = ride.model(trace)
    return model, factual(model, trace)
