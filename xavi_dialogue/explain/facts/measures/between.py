"""Measures between two vehicles, or to a place: gap, headway, distance, time to collision."""

import math

from msgspec.structs import replace

from sim.scene import EGO
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import Destination, Exit, Feature, Junction, Thing, Vehicle
from xavi_dialogue.explain.facts import bodies
from xavi_dialogue.explain.facts.approach import Following, following
from xavi_dialogue.explain.facts.bearings import bearing
from xavi_dialogue.explain.facts.measures.asked import Asked
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.nearing import still_to
from xavi_dialogue.explain.history.thresholds import STALE, TREND_TIME

SOON = 30.0  # [s] maximum time to a collision of two vehicles on one line
STEERED = math.radians(3.0)  # [rad] minimum change of heading of a vehicle that turns


def leader(states: States, vehicle: int, time: float) -> int | None:
    """Return the next vehicle ahead of another on its line, as far as its place is known."""
    found: list[tuple[float, int]] = []
    for other in (EGO, *states.ride.vehicles):
        if other == vehicle or not states.known(other, time):
            continue
        seen = states.offset(vehicle, other, time)
        if seen is None or not seen.same_way or seen.ahead <= 0.0:
            continue
        both = following(states, vehicle, other, time)
        if both is not None and both.behind == vehicle:
            found.append((both.gap, other))
    return min(found)[1] if found else None


def _following(asked: Asked) -> tuple[Following | None, Asked]:
    """Return the two on one line, and the request; without another, it is who is ahead."""
    if asked.other is None and not _is_place(asked.to):
        ahead = leader(asked.states, asked.vehicle, asked.at)
        if ahead is None:
            return None, asked
        to: Thing = Vehicle(ahead)
        asked = Asked(asked.states, asked.attribute, asked.thing, asked.at, to)
    if asked.other is None:
        return None, asked
    return following(asked.states, asked.vehicle, asked.other, asked.at), asked


def gap(asked: Asked) -> Measure:
    """Return the gap along the way, if one vehicle is behind the other."""
    found, asked = _following(asked)
    return asked.none("not-applicable") if found is None else asked.found(round(found.gap, 1))


def headway(asked: Asked) -> Measure:
    """Return the follower's gap as a time; none if it stands. `reference`: the gap [m]."""
    found, asked = _following(asked)
    if found is None:
        return asked.none("not-applicable")
    state = asked.states.state(found.behind, asked.at)
    if state is None or state.speed < 0.5:
        return replace(asked.none("not-applicable"), reference=round(found.gap, 1))
    return replace(asked.found(round(found.gap / state.speed, 2)), reference=round(found.gap, 1))


def distance(asked: Asked) -> Measure:
    """Return the distance between two bodies, or along the road to a place."""
    if _is_place(asked.to) or _is_place(asked.thing):
        return to_place(asked, asked.to if _is_place(asked.to) else asked.thing)
    if asked.other is None:
        return asked.none("not-applicable")
    a = asked.states.state(asked.vehicle, asked.at)
    b = asked.states.state(asked.other, asked.at)
    if a is None or b is None:
        return asked.none("out-of-view")
    return asked.found(round(bodies.distance(a, b), 2))


def to_place(asked: Asked, place: Thing | None) -> Measure:
    """Return how far along the road a place is ahead of the ego."""
    trace = asked.states.trace(asked.at)
    road = None if trace is None else trace.road
    if trace is None or road is None or asked.at - trace.sim_time > 2.0 * STALE:
        return asked.none("not-recorded")
    far = road.distance
    if isinstance(place, Feature):
        return asked.none("not-recorded")  # houses and villages are not on our map
    if isinstance(place, Junction):
        if place.rank is not None and place.rank < 0:
            return asked.none("not-recorded")
        steps = [s for s in road.route if place.form != "roundabout" or s.kind == "roundabout"]
        rank = place.rank or 1
        if len(steps) < rank:
            return asked.none("not-applicable")
        far = steps[rank - 1].distance
    elif isinstance(place, Exit):
        far = road.route[0].distance if road.route else None
    if far is None:
        return asked.none("not-recorded" if isinstance(place, Exit) else "no-way")
    return asked.found(round(max(still_to(asked.states.ride, far, asked.at), 0.0), 1))


def time_to_collision(asked: Asked) -> Measure:
    """Return the time to a collision if both go on as they do; none if they draw apart."""
    if asked.other is None:
        found, asked = _following(asked)
        if found is None:
            return asked.none("not-applicable")
    assert asked.other is not None
    value = time_to_touch(asked.states, asked.vehicle, asked.other, asked.at)
    return asked.none("not-applicable") if value is None else asked.found(round(value, 2))


def time_to_touch(states: States, one: int, other: int, time: float) -> float | None:
    """Return the time [s] to a collision: along the way if one follows the other, else straight on.

    None if they draw apart, or if they are not on one line and one of them is turning.
    """
    a, b = states.state(one, time), states.state(other, time)
    if a is None or b is None:
        return None
    seen = states.offset(one, other, time)
    found = following(states, one, other, time) if seen is not None and seen.same_way else None
    if found is None:
        turning = _turns(states, one, time) or _turns(states, other, time)
        return None if turning else bodies.time_to_touch(a, b)
    behind, ahead = (a, b) if found.behind == one else (b, a)
    closing = behind.speed - ahead.speed
    return found.gap / closing if closing * SOON > found.gap else None


def _turns(states: States, vehicle: int, time: float) -> bool:
    """Check whether the heading of a vehicle changes within TREND_TIME of a time [s]."""
    now = states.state(vehicle, time)
    near = (states.state(vehicle, time + by) for by in (-TREND_TIME, TREND_TIME))
    return now is not None and any(
        abs(math.remainder(one.heading - now.heading, math.tau)) > STEERED
        for one in near
        if one is not None
    )


def place(asked: Asked) -> Measure:
    """Return the word for where a vehicle is, seen from the other one."""
    eye = EGO if asked.other is None else asked.other
    seen = asked.states.offset(eye, asked.vehicle, asked.at)
    if seen is None or asked.vehicle == eye:
        return asked.none("not-applicable" if asked.vehicle == eye else "out-of-view")
    mine, theirs = (asked.states.place(v, asked.time) for v in (eye, asked.vehicle))
    a, b = (asked.states.state(v, asked.at) for v in (eye, asked.vehicle))
    far = None if a is None or b is None else round(bodies.distance(a, b), 1)
    return asked.found(far, bearing(seen, mine, theirs))


def _is_place(thing: Thing | None) -> bool:
    if isinstance(thing, Feature):
        return thing.kind == "building"
    return isinstance(thing, (Destination, Junction, Exit))
