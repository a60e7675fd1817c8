"""Measures of the trip: distances and times to go and so far, waiting, and delays."""

import itertools
import math

from msgspec.structs import replace

from planner.record.trace import PlanTrace, Rollout
from sim.scene import EGO
from xavi_dialogue.causal.effects import HIGH, LOW
from xavi_dialogue.causal.model import Intervention
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.explain.facts.actions import somebody
from xavi_dialogue.explain.facts.episodes.speeds import speeds
from xavi_dialogue.explain.facts.episodes.waiting import waits
from xavi_dialogue.explain.facts.measures.asked import Asked
from xavi_dialogue.explain.facts.measures.between import to_place
from xavi_dialogue.explain.facts.plans import plan_of
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.nearing import driven
from xavi_dialogue.explain.history.thresholds import STANDING


def distance_to_go(asked: Asked) -> Measure:
    """Return how far it is to the destination."""
    return asked.found(0.0) if _there(asked) else to_place(asked, None)


def distance_driven(asked: Asked) -> Measure:
    """Return how far a vehicle has driven since it was seen first."""
    value = driven(asked.states.motion(asked.vehicle), asked.states.begin, asked.at)
    return asked.found(round(value, 1))


def clock(asked: Asked) -> Measure:
    """Return the time of the ride."""
    return asked.found(asked.at, time=asked.at)


def _arrived(asked: Asked) -> float | None:
    times = [e.sim_time for e in asked.states.ride.events if e.kind == "arrived"]
    return times[0] if times else None


def _there(asked: Asked) -> bool:
    arrived = _arrived(asked)
    return arrived is not None and asked.at >= arrived


def time_to_go(asked: Asked) -> Measure:
    """Return the expected time to the destination; `low` and `high` are the 5 and 95 % points.

    If the plan goes only to a place on the way, the rest of the way counts as driven freely. The
    value is then a lower bound.
    """
    if _there(asked):
        return asked.found(0.0)
    if asked.states.ride.ended:
        return asked.none("not-applicable")
    ride = asked.states.ride.back(asked.at)
    known = plan_of(ride)
    if known is None:
        return _freely(asked)
    model, plan = known
    trace = model.trace
    passed = asked.at - trace.sim_time
    if trace.waypoint is None:
        expected = _quantiles(plan)
        if expected is None:
            return _beyond(asked, trace, plan) or _freely(asked)
        middle, low, high = (round(max(x - passed, 0.0), 1) for x in expected)
        return replace(asked.found(middle, time=asked.at), low=low, high=high)
    return _through_waypoint(asked, trace, plan, passed)


def _quantiles(plan: Intervention) -> tuple[float, float, float] | None:
    """Return the mean, 5 % and 95 % point of the time [s] to the goal."""
    found = sorted((value, weight) for _, weight, value in plan.present("time"))
    mass = sum(weight for _, weight in found)
    if mass < 0.5:
        return None
    points, total = [], 0.0
    wanted = [LOW, HIGH]
    for value, weight in found:
        total += weight / mass
        while wanted and total >= wanted[0] - 1e-9:
            points.append(value)
            wanted.pop(0)
    mean = sum(value * weight for value, weight in found) / mass
    return mean, min(points[0], mean), max(points[-1], mean)


def _through_waypoint(asked: Asked, trace: PlanTrace, plan: Intervention, passed: float) -> Measure:
    """Return the time to the place that the plan goes to, and from there on freely."""
    road = trace.road
    if road is None or road.free_time is None or road.distance is None:
        return asked.none("not-recorded")
    expected = _quantiles(plan)
    lengths = [
        length
        for result in plan.results
        if result.rollout.outcome == "done" and (length := _length(trace, result.rollout))
    ]
    if expected is None or not lengths or road.distance <= 0.0:
        return _beyond(asked, trace, plan) or _freely(asked)
    rest = max(road.distance - sum(lengths) / len(lengths), 0.0) / road.distance
    beyond = road.free_time * rest
    middle, low, high = (round(max(x + beyond - passed, 0.0), 1) for x in expected)
    return replace(asked.found(middle, time=asked.at), low=low, high=high, at_least=True)


def _beyond(asked: Asked, trace: PlanTrace, plan: Intervention) -> Measure | None:
    """Return a lower bound if most rollouts run out of time, as at a red light; else None."""
    if plan.likeliest != "termination":
        return None
    freely = _freely(asked).value or 0.0
    least = round(max(trace.sim_time + trace.settings.horizon - asked.at, freely), 1)
    return replace(asked.found(least, time=asked.at), low=least, at_least=True)


def _length(trace: PlanTrace, rollout: Rollout) -> float | None:
    path = rollout.path
    if path is None and rollout.same_as is not None:
        path = next((r.path for r in trace.rollouts if r.index == rollout.same_as), None)
    if path is None:
        return None
    return sum(math.dist(a, b) for a, b in itertools.pairwise(path))


def _freely(asked: Asked) -> Measure:
    """Return the time to the destination if nobody is in the way, as a lower bound."""
    trace = asked.states.trace(asked.at)
    if trace is None or trace.road is None:
        return asked.none("not-recorded")
    if trace.road.free_time is None:
        return asked.none("no-way")
    left = max(trace.road.free_time - (asked.at - trace.sim_time), 0.0)
    return replace(asked.found(round(left, 1), time=asked.at), at_least=True)


def arrival_time(asked: Asked) -> Measure:
    """Return when we arrived or are expected to."""
    arrived = _arrived(asked)
    if arrived is not None:
        return asked.found(arrived, time=arrived)
    left = time_to_go(asked)
    if left.value is None:
        return replace(left, attribute=asked.attribute)
    low, high = (None if x is None else x + asked.at for x in (left.low, left.high))
    found = asked.found(round(left.value + asked.at, 1), time=asked.at)
    return replace(found, low=low, high=high, at_least=left.at_least)


def waiting_time(asked: Asked) -> Measure:
    """Return how long a vehicle has stood so far; if another is named, how long for that one."""
    states, vehicle, at = asked.states, asked.vehicle, asked.at
    named = None if asked.to is None else somebody(asked.to)
    episodes = waits(states, vehicle) if named else speeds(states, vehicle)
    still = [e for e in episodes if e.standing and e.action not in ("slow-down", "brake")]
    if named is not None:
        still = [e for e in still if (somebody(e.object) or frozenset()) & named]
    spans = [(e.begin, at if e.end is None else min(e.end, at)) for e in still if e.begin <= at]
    value = sum(standing_within(states, vehicle, a, b) for a, b in spans)
    return replace(asked.found(round(value, 1)), count=len(spans))


def standing_within(states: States, vehicle: int, begin: float, end: float) -> float:
    """Return how long [s] a vehicle stood between two times."""
    motion = states.motion(vehicle)
    inside = motion.within(begin, end)
    total = 0.0
    for k in inside:
        if motion.speed[k] < STANDING:
            after = motion.time[k + 1] if k + 1 < len(motion.time) else motion.time[k] + 0.2
            total += min(after, end, motion.time[k] + 0.5) - motion.time[k]
    return total


def _free(states: States, vehicle: int, free: float, index: int) -> float:
    """Return a speed [m/s], or the limit where a vehicle is at a sample if that is lower."""
    place = states.place(vehicle, states.motion(vehicle).time[index])
    return free if place is None else min(free, place.limit)


def _behind(states: States, vehicle: int, free: float, steps: range) -> float:
    """Return how much longer [s] a stretch took than at a speed, or the limit if that is lower."""
    motion, lost = states.motion(vehicle), 0.0
    for k in steps:
        pace = _free(states, vehicle, free, k)
        driven = motion.arc[k + 1] - motion.arc[k]
        lost += motion.time[k + 1] - motion.time[k] - driven / pace
    return lost


def delay(states: States, episode: Episode) -> Measure:
    """Return the time that slowing down or standing cost, compared with free driving.

    It is counted until the earlier speed is reached again, or until now; the value is then a lower
    bound. Free driving is at the earlier speed, or at the limit if that is lower; instead of
    following somebody, it is at the limit.
    """
    who = somebody(episode.actor) or frozenset((EGO,))
    vehicle = min(who)
    motion = states.motion(vehicle)
    first = motion.index(episode.begin)
    asked = Asked(states, "delay", episode.actor, episode.begin)
    if first is None:
        return asked.none("not-recorded")
    place = states.place(vehicle, episode.begin)
    free = max(motion.speed[max(first - 10, 0) : first + 1])
    stood = free < 2.0  # before the episode
    if place is not None and (stood or episode.action == "follow"):
        free = place.limit
    if place is not None:
        free = min(free, place.limit)
    if free < 2.0:
        return asked.none("not-applicable")
    end = first
    over = states.ride.now if episode.end is None else episode.end
    while end + 1 < len(motion.time):
        end += 1
        regained = motion.speed[end] >= 0.95 * _free(states, vehicle, free, end)
        if motion.time[end] >= over and regained:
            break
    lost = max(_behind(states, vehicle, free, range(first, end)), 0.0)
    going_on = motion.speed[end] < 0.95 * _free(states, vehicle, free, end)
    found = asked.found(round(lost, 1), time=episode.begin)
    return replace(found, until=motion.time[end], at_least=going_on)
