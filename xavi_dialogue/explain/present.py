"""Questions about the ego's own plan and way: what it does and where it goes."""

from msgspec.structs import replace

from sim.scene import EGO
from xavi_dialogue.explain.contrast import arrival, evidence, factual, outcome
from xavi_dialogue.explain.course import begins, expected, lines
from xavi_dialogue.explain.deeds import DRIVING, did_not_happen, happened
from xavi_dialogue.explain.details import Step
from xavi_dialogue.explain.explanation import (
    Activity,
    Destination,
    Evidence,
    Explanation,
)
from xavi_dialogue.explain.motion import LANE_TIME, TURN_TIME
from xavi_dialogue.explain.premise import premise
from xavi_dialogue.explain.query import Query, QueryAction
from xavi_dialogue.explain.ride import Deed, Ride, decline, planned
from xavi_dialogue.explain.slowing import explain_driving
from xavi_dialogue.explain.when import Focus

#: What leads through a junction; on the way there the ego only follows its lane.
CROSSINGS: tuple[QueryAction, ...] = (
    *("exit-left", "exit-right", "exit-straight", "continue-next-exit"),
)
GAP = 1.5  # [s] since the last sample after which nothing is known
#: How long [s] what has begun still goes on; what is not among them has no end of its own.
LASTING: dict[QueryAction, float] = {
    **dict.fromkeys(("change-left", "change-right"), LANE_TIME),
    **dict.fromkeys(("exit-left", "exit-right", "exit-straight"), TURN_TIME),
}


def what(query: Query, ride: Ride) -> Explanation:
    """What the ego did, is doing, or will do; at the time asked about, where there is one."""
    trace = ride.latest
    if ride.ahead is not None and not query.factual:
        return _to_come(ride, ride.ahead)
    driving = tuple(action for action in query.factual or () if action in DRIVING)
    halt = happened(ride, "stop") if "stop" in driving else None
    if halt is not None and query.tense == "past":
        return _halt(query, ride, halt)
    if driving and halt is None:
        driven = explain_driving(ride, driving, query.tense)
        if driven.done and query.tense == "past" and ride.past is None:
            raise did_not_happen(ride, query.factual or ())
        return driven if ride.past is None else _as_seen(driven, driving)
    if query.factual:
        found = premise(ride, query)
        if query.tense == "past" and query.factual == ("exit-straight",) and ride.past is None:
            _check_crossed(ride, query, found.deed)
        actions: tuple[QueryAction, ...] = query.factual
        moment = found.deed.time if found.deed else None
        return _activity(ride, actions, moment, seen=moment if query.tense == "past" else None)
    deed = ride.manoeuvre
    if ride.past is not None:
        return _at(ride, ride.past, deed)
    if query.tense == "past" and deed is not None:
        return _activity(ride, (deed.action,), deed.time, seen=deed.time)
    if ride.arrived:
        return where(query, ride)
    if ride.ended:
        raise did_not_happen(ride, ())
    plan: tuple[QueryAction, ...] = planned(trace) or ("continue",)
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
    if ride.past is not None:
        return _underway(query, ride.back(ride.past.moment))
    goal = ride.latest.goal
    found = of_plan(ride, destination=Destination(EGO, goal.edge))
    return replace(found, arrival=0.0) if ride.arrived else found


def _underway(query: Query, then: Ride) -> Explanation:
    """That the ego was on its way, or there, at an earlier time; what was left of it then is over.

    Raises:
        Unanswered: the record does not go back so far.
    """
    return replace(where(query, then), arrival=0.0 if then.arrived else None)


def _check_crossed(ride: Ride, query: Query, deed: Deed | None) -> None:
    """That going straight on is not just what came after a turn.

    Raises:
        Unanswered: it is.
    """
    turns = [one for one in ride.deeds if one.action in CROSSINGS and one.ended is not None]
    if turns and deed is not None and deed.action == "continue":
        asked, last = query.factual, turns[-1]
        raise decline(
            "did-not-happen",
            vehicle=EGO,
            asked=asked,
            did=False,
            happened=(last.action,),
            time=last.time,
        )


def _halt(query: Query, ride: Ride, deed: Deed) -> Explanation:
    """That the ego stopped, and when it came to stand.

    Raises:
        Unanswered: it is still slowing down for it.
    """
    moment = ride.stood(deed)
    if moment is None and deed.ended is None:
        raise did_not_happen(ride, query.factual or ())
    found = _activity(ride, ("stop",), deed.time if moment is None else moment)
    return replace(found, activity=Activity(EGO, ("stop",), None, None, None))


def _as_seen(found: Explanation, asked: tuple[QueryAction, ...]) -> Explanation:
    """Only that the ego drove as described, at that time; not what it was about besides."""
    activity = Activity(EGO, found.done or asked[:1], None, None, None)
    return replace(found, activity=activity)


def _at(ride: Ride, focus: Focus, deed: Deed | None) -> Explanation:
    """The manoeuvre within a part of the ride, or else what was under way at its moment.

    Raises:
        Unanswered: it is not in the record.
    """
    if deed is not None and not focus.instant and _moved(deed) and focus.meets(*deed.span):
        return _activity(ride, (deed.action,), deed.time, seen=deed.time)
    seen = ride.motion(EGO).until(focus.moment).time
    if not seen or focus.moment - seen[-1] > GAP:
        raise decline("outside-record", vehicle=EGO, time=focus.moment)
    under_way = ride.back(focus.moment).under_way
    actions: tuple[QueryAction, ...] = ()
    if under_way is not None:
        on_the_way = under_way.action in CROSSINGS and under_way.committed is None
        actions = ("continue",) if on_the_way else (under_way.action,)
    found = _activity(ride, actions, focus.moment, seen=focus.moment)
    return replace(found, instant=True)


def _moved(deed: Deed) -> bool:
    """Whether it was more than driving on, or than being about to."""
    if deed.action in ("continue", "stop"):
        return deed.action == "stop"
    return deed.committed is not None or deed.ended is not None


def _to_come(ride: Ride, focus: Focus) -> Explanation:
    """What the plan leads to in some part of the time ahead.

    Raises:
        Unanswered: the plan does not go so far.
    """
    steps = upcoming(ride)
    ends = [line.time[-1] for line in lines(ride.latest).values() if line.time]
    if not ends or focus.start > max(ends):
        raise decline("outside-record", ahead=True)
    moment = focus.moment
    if focus.instant:
        last = next((s for s in reversed(steps) if s.moment <= moment), None)
        over = last is None or moment > last.moment + LASTING.get(last.action, moment)
        actions: tuple[QueryAction, ...] = ("continue",) if last is None or over else (last.action,)
    else:
        inside = [step for step in steps if focus.start <= step.moment <= focus.end]
        actions = tuple(step.action for step in inside)
        moment = inside[0].moment if inside else moment
        if not actions and focus.start > ride.now:
            raise decline("outside-record", ahead=True)
    found = _activity(ride, actions or ("continue",), moment)
    return replace(found, instant=focus.instant)


def upcoming(ride: Ride) -> tuple[Step, ...]:
    """The actions of the latest plan that are still to begin, and when [s] they are expected to."""
    trace = ride.latest
    plan = factual(ride.model(trace), trace)
    begun = ride.under_way
    steps: list[Step] = []
    for action in dict.fromkeys(plan.plan):
        time = expected(trace, plan, begins(action, (action,)))
        if begun is not None and begun.action == action and begun.carried_out:
            done = begun.committed is not None or action != "continue-next-exit"
        else:
            done = False
        if time is not None and not done:
            steps.append(Step(action, max(time.moment, ride.now)))
    return tuple(sorted(steps, key=lambda step: step.moment))


def _activity(
    ride: Ride,
    actions: tuple[QueryAction, ...],
    moment: float | None,
    seen: float | None = None,
) -> Explanation:
    """Actions that are known, with the ego's speed now, or when it was `seen` [s]."""
    trace, motion = ride.latest, ride.motion(EGO)
    motion = motion if seen is None else motion.until(seen)
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
