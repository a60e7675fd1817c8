"""Beliefs: what the decisions of a ride expected of another vehicle."""

from planner.record.trace import PlanTrace
from xavi_dialogue.domain.facts import Belief, Expectation
from xavi_dialogue.domain.terms import Event
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.facts.actions import SIDES, covered, somebody
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.motion import EPSILON, foretold, steps
from xavi_dialogue.explain.history.ride import prediction


def belief(states: States, vehicle: int, at: float) -> Belief | None:
    """Return what was believed of a vehicle at the last decision up to a time [s] that knew it."""
    k = states.ride.index(at)
    while k is not None and k >= 0:
        trace = states.ride.traces[k]
        if prediction(trace, vehicle) is not None:
            return of_trace(states, trace, vehicle)
        k -= 1
    return None


def over(states: States, vehicle: int, begin: float, end: float) -> tuple[Belief, ...]:
    """Return what was believed of a vehicle at each decision of an interval [s], oldest first."""
    found = (
        of_trace(states, trace, vehicle)
        for trace in states.ride.traces
        if begin - EPSILON <= trace.sim_time <= end + EPSILON
    )
    return tuple(one for one in found if one is not None)


def of_trace(states: States, trace: PlanTrace, vehicle: int) -> Belief | None:
    """Return what a decision believed of a vehicle, likeliest first, by sequence of actions."""
    return states.memo(("belief", id(trace), vehicle), lambda: _belief(trace, vehicle))


def _belief(trace: PlanTrace, vehicle: int) -> Belief | None:
    known = prediction(trace, vehicle)
    if known is None:
        return None
    found: dict[tuple[ActionName, ...], float] = {}
    edges: dict[tuple[ActionName, ...], tuple[float, str | None]] = {}
    for goal in known.goals:
        for way in goal.trajectories:
            chance = goal.probability * way.probability
            actions = steps(goal, way)
            found[actions] = found.get(actions, 0.0) + chance
            if chance > edges.get(actions, (-1.0, None))[0]:
                edges[actions] = (chance, goal.edge)
    ranked = sorted(found.items(), key=lambda item: -item[1])
    expected = tuple(
        Expectation(actions, min(chance, 1.0), edges[actions][1]) for actions, chance in ranked
    )
    return Belief(vehicle, trace.sim_time, expected)


def probability(states: States, event: Event, at: float) -> float | None:
    """Return the probability of a vehicle's event for the last decision up to a time [s]."""
    who = somebody(event.actor)
    if who is None or len(who) != 1:
        return None
    (vehicle,) = who
    k = states.ride.index(at)
    known = None if k is None else prediction(states.ride.traces[k], vehicle)
    if known is None:
        return None
    covering = covered(frozenset((event.action,)))
    actions = frozenset(action for action in covering if _side_fits(action, event))
    chances = [
        goal.probability * way.probability
        for goal in known.goals
        for way in goal.trajectories
        if any(foretold(goal, way, action) for action in actions)
    ]
    return min(sum(chances), 1.0)


def _side_fits(action: ActionName, event: Event) -> bool:
    side = SIDES.get(action)
    return event.side is None or side is None or side == event.side
