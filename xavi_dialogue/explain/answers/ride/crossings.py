"""Crossings: whose way met ours at a junction, who came first, and who stood meanwhile."""

import math
from itertools import pairwise

from sim.scene import EGO
from xavi_dialogue.domain.facts import Episode, Look, Somebody
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.expectations.precedence import at_ring, is_apart, on_ring
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.moments import SHORT, Window
from xavi_dialogue.explain.answers.reference.naming import number
from xavi_dialogue.explain.answers.reference.occasions import overlaps

NEAR = 6.0  # [s] before and after a crossing in which giving way belongs to it
MEETING = 2.5  # [m] maximum distance between two paths that meet
MOVING = 0.5  # [m/s] minimum speed of a vehicle that drives along its path
GOING = 1.0  # [m/s] minimum speed at which we count as going


def crossing_now(asked: Asked) -> int | None:
    """Return whose way crosses ours next: the one that we give way to, else the closest."""
    road = asked.world.road(asked.now)
    if road is None:
        return None
    waiting = asked.world.episodes(actor=Ego(), actions=("give-way",))
    given = {number(e.object) for e in waiting if e.end is None}
    found = [
        (fact.vehicle not in given, fact.who != "vehicle", look.distance, fact.vehicle)
        for fact in road.priority
        if (look := asked.world.look(fact.vehicle, asked.now)) is not None and look.in_view
    ]
    return min(found)[-1] if found else None


def meets_ahead(asked: Asked, vehicle: int | None) -> bool:
    """Check whether a vehicle's way may meet ours at a junction that we have not come to."""
    road = asked.world.road(asked.now)
    place = None if road is None else road.places.get(EGO)
    if road is None or place is None or (place.in_junction and not place.roundabout):
        return False
    facts = [fact for fact in road.priority if fact.vehicle == vehicle]
    return any(fact.who == "ego" or not place.roundabout for fact in facts)


def passes_by(asked: Asked, vehicle: int | None) -> bool:
    """Check whether the predicted ways of a vehicle do not meet ours.

    One that comes along a road with priority keeps it, whichever way it is expected to go.
    """
    trace, road = asked.ride.at(asked.now), asked.world.road(asked.now)
    if vehicle is None or trace is None or road is None:
        return False
    owed = any(fact.vehicle == vehicle and fact.who != "ego" for fact in road.priority)
    return (at_ring(road) or not owed) and is_apart(trace, vehicle)


def went_first(
    asked: Asked, vehicle: int | None, near: Window, waited: Episode | None
) -> Somebody | None:
    """Return who was first where the paths meet, else out of the junction; else by who waited."""
    if vehicle is None:
        return None
    order = line_order(asked, vehicle, near)
    if order is not None:
        return Ego() if order[0] < order[1] else Vehicle(vehicle)
    entered = any(near.begin <= t for t in entries(asked))
    inside = _inside(asked, vehicle, near)
    if entered and inside and not any(one for _, one in inside) and _let_us(asked, vehicle, near):
        ours = _inside(asked, EGO, near)  # it lets us go through or out first
        return None if ours[-1][1] and ours[-1][0] >= asked.now - SHORT else Ego()
    if not entered and _left(asked, vehicle, near) is not None:
        return Vehicle(vehicle)
    if entered and on_ring(asked.world.road(asked.now)):  # and it is not ahead of us there
        return Vehicle(vehicle) if passes_by(asked, vehicle) else Ego()
    over = waited is not None and waited.end is not None and waited.standing
    return Vehicle(vehicle) if over else None


def _let_us(asked: Asked, vehicle: int, near: Window) -> bool:
    """Check whether a vehicle stood, or waited for us, in a stretch of the ride."""
    kinds: tuple[ActionName, ...] = ("give-way", "wait", "stop", "stand")
    found = asked.world.episodes(actor=Vehicle(vehicle), actions=kinds)
    return any(overlaps(asked, e, near) for e in found)


def stood(asked: Asked, vehicle: int, near: Window) -> bool:
    """Check whether a vehicle was at a standstill when we came into the junction."""
    entered = [t for t in entries(asked) if near.begin <= t <= near.end]
    speeds = [
        asked.world.measure("speed", Vehicle(vehicle), min(t + 1.0, asked.now)).value
        for t in entered[-1:]
    ]
    return any(speed is not None and speed < MOVING for speed in speeds)


def met_about(asked: Asked, about: Window) -> int | None:
    """Return whose way crossed ours in a stretch of the ride, as it was last.

    It is one that we waited for, else the closest of those who go before us, else of the others.
    """
    found = [
        (trace.sim_time, fact)
        for trace in asked.ride.traces
        if trace.road is not None and about.begin - NEAR <= trace.sim_time <= about.end
        for fact in trace.road.priority
        if fact.who != "depends"
    ]
    last = max((time for time, _ in found), default=None)
    those = {fact.vehicle: fact.who != "vehicle" for time, fact in found if time == last}
    met = {fact.vehicle for _, fact in found}
    waited = [
        number(e.object)
        for e in asked.world.episodes(Ego(), ("give-way",), about.begin - NEAR, about.end)
        if number(e.object) in met
    ]
    if waited or last is None:
        return waited[-1] if waited else None
    looks = {vehicle: asked.world.look(vehicle, last) for vehicle in those}
    return min(those, key=lambda v: (those[v], _far(looks[v]), v))


def _far(look: Look | None) -> float:
    return math.inf if look is None or not look.in_view else look.distance


def line_order(asked: Asked, vehicle: int, near: Window) -> tuple[float, float] | None:
    """Return when [s] we and a vehicle came to where our paths meet; None if they do not."""
    ours, other = asked.ride.motion(EGO), asked.ride.motion(vehicle)
    mine = [k for k in ours.within(near.begin, near.end) if ours.speed[k] > MOVING]
    theirs = [k for k in other.within(near.begin, near.end) if other.speed[k] > MOVING]
    meetings = [
        (math.dist(ours.position[i], other.position[k]), ours.time[i], other.time[k])
        for i in mine
        for k in theirs
    ]
    close = [m for m in meetings if m[0] <= MEETING]
    if not close:
        return None
    _, first, second = min(close, key=lambda m: min(m[1], m[2]))
    return first, second


def _inside(asked: Asked, vehicle: int, near: Window) -> list[tuple[float, bool]]:
    """Return at each decision of a stretch [s] whether a vehicle was inside a junction."""
    found = []
    for trace in asked.ride.traces:
        if trace.road is not None and near.begin <= trace.sim_time <= near.end:
            place = trace.road.places.get(vehicle)
            if place is not None:
                found.append((trace.sim_time, place.in_junction or place.roundabout))
    return found


def _left(asked: Asked, vehicle: int, near: Window) -> float | None:
    """Return when [s] a vehicle was first seen outside of a junction that it was in."""
    pairs = pairwise(_inside(asked, vehicle, near))
    return next((later[0] for before, later in pairs if before[1] and not later[1]), None)


def let_by(asked: Asked, vehicle: int, first: Somebody | None, near: Window, about: Window) -> bool:
    """Check whether a vehicle stood when we went, or stands now that we go."""
    if first is None and about.instant and about.end >= asked.now - 0.1:
        theirs = asked.world.measure("speed", Vehicle(vehicle), asked.now).value
        ours = asked.world.measure("speed", Ego(), asked.now).value
        return theirs is not None and theirs < MOVING and ours is not None and ours > GOING
    return isinstance(first, Ego) and stood(asked, vehicle, near)


def entries(asked: Asked) -> list[float]:
    """Return when [s] we were first seen inside each junction that we crossed so far."""
    inside = _inside(asked, EGO, Window(asked.world.begin, asked.now))
    first = [inside[0][0]] if inside and inside[0][1] else []
    return first + [later[0] for before, later in pairwise(inside) if later[1] and not before[1]]
