"""What the latest scene shows: how fast, how far, where, how many, which colour."""

from contextlib import suppress
from typing import Literal, cast

from msgspec.structs import replace

from planner.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.explain import present, vehicles
from xavi_dialogue.explain.bearings import OPPOSITE, Bearing, bearing, nearest_first
from xavi_dialogue.explain.details import Sight
from xavi_dialogue.explain.expectation import last_seen
from xavi_dialogue.explain.explanation import Evidence, Explanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.ride import ROUNDING, Ride, Unanswered, decline
from xavi_dialogue.explain.vehicles import check_known, vehicle_of
from xavi_dialogue.explain.whereabouts import seen_at, side_of, who_is

ONCOMING = "oncoming"  # `Query.event` of whether a vehicle comes towards us
About = Literal["speed", "distance", "place", "count", "colour"]


def sight(query: Query, ride: Ride) -> Explanation:
    """What is seen of a vehicle, or was when it was seen last.

    Where it is asked where a vehicle is, what is expected of it is added.

    Raises:
        Unanswered: the vehicle is unknown, or its colour cannot be told.
    """
    about = cast(About, "place" if query.event == ONCOMING else query.event)
    vehicle = EGO if query.actor == "ego" else vehicle_of(query)
    if vehicle == EGO and about == "speed" and ride.arrived and ride.past is None:
        return present.where(query, ride)
    if vehicle is None:
        raise decline("ambiguous", vehicle=query.actor)
    if vehicle != EGO:
        check_known(ride, vehicle)
    trace = _seen_in(ride, vehicle)
    found = _explanation(ride, trace, _of(ride, trace, vehicle, about))
    if about == "colour" and (found.sight is None or found.sight.colour is None):
        raise decline("out-of-scope", what="perception")
    if vehicle != EGO:
        found = replace(found, seen=last_seen(ride, vehicle))
    if query.type == "where_goal" and vehicle != EGO:
        with suppress(Unanswered):
            going = vehicles.where(query, ride)
            return replace(found, activity=going.activity, destination=going.destination)
    return found


def nobody(query: Query, ride: Ride) -> Explanation:
    """That there is nobody where it is asked who is there; and who is the nearest.

    Raises:
        Unanswered: somebody is, so that the question is about that vehicle.
    """
    description = query.actor.partition(":")[2]
    moment = ride.now if ride.past is None else ride.past.moment
    trace = seen_at(ride.traces, moment) or ride.latest
    if who_is(description, trace.scene) != ():
        raise decline("ambiguous", vehicle=query.actor)
    others = tuple(n for n, _ in nearest_first(trace.scene) if n not in trace.unseen)
    shown = Sight("nobody", others[0] if others else EGO, place=description, others=others)
    found = _explanation(ride, trace, shown)
    return found if ride.past is None else replace(found, moment=trace.sim_time)


def _seen_in(ride: Ride, vehicle: int) -> PlanTrace:
    """The last decision at which a vehicle was in view; the last of all where it is hidden."""
    hidden = ride.latest.unseen.get(vehicle)
    until = ride.now if hidden is None else hidden
    known = [t for t in ride.traces if vehicle in t.scene and t.sim_time <= until + ROUNDING]
    return known[-1] if known else ride.latest


def _of(ride: Ride, trace: PlanTrace, vehicle: int, about: About) -> Sight:
    state = trace.scene[vehicle]
    others = tuple(sorted(set(trace.scene) - {EGO} - set(trace.unseen)))
    motion = ride.motion(vehicle).until(trace.sim_time)
    shown = Sight(
        about,
        vehicle,
        speed=state.speed,
        trend=motion.trend,
        colour=state.colour,
        others=others,
    )
    if vehicle == EGO:
        return shown
    where = bearing(trace.scene[EGO], state)
    oncoming = abs(where.turn) >= OPPOSITE and where.ahead > 0.0
    return replace(shown, place=side_of(where), oncoming=oncoming, distance=_distance(where))


def _distance(where: Bearing) -> float:
    """How far [m] away a vehicle is: the gap on our line, else from centre to centre."""
    if side_of(where) in ("ahead", "behind"):
        return max(abs(where.ahead) - where.clear, 0.0)
    return where.distance


def _explanation(ride: Ride, trace: PlanTrace, shown: Sight) -> Explanation:
    return Explanation(
        factual=(),
        counterfactual=(),
        outcome=None,
        effects=(),
        causes=(),
        evidence=Evidence("tree", 0, 0, (trace.trace_id,)),
        sim_time=ride.now,
        sight=shown,
    )
