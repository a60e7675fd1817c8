"""Going: the vehicles whose way crossed ours when the ego went, and what they did then."""

from planner.record.events import Event as RideEvent
from planner.record.trace import PlanTrace
from xavi_dialogue.domain.answers import CrossingVehicle
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.ride import Ride, planned

NEXT = 18.0  # [m] within which a vehicle that we gave way to is just passing
APART = 3.0  # [m] by which the distance of a vehicle that goes away has grown
MOVING = 0.5  # [m/s] from which a vehicle is on its way
PASSED = 6.0  # [s] before an action in which we gave way for its sake
LATELY = 4.0  # [s] before an action in which it may have been decided


def bystanders(ride: Ride, world: World, time: float) -> tuple[CrossingVehicle, ...]:
    """Return the vehicles whose way crossed ours at a time [s], with who goes first.

    Those that we have just let go come first.
    """
    trace = ride.at(time)
    found = [] if trace is None else [_one(ride, world, trace, time, v) for v in _met(trace)]
    waits = [e for e in ride.events if e.kind == "gave-way" and e.vehicle is not None]
    let_go = [e for e in waits if time - PASSED <= e.sim_time <= time]
    past = {e.vehicle for e in let_go if e.vehicle is not None and _parts(world, e, time)}
    known = {one.vehicle for one in found}
    others = [e.vehicle for e in let_go if e.vehicle is not None and e.vehicle not in known]
    gone = dict.fromkeys((*others, *(v for v in known if v in past)))
    still = tuple(one for one in found if one.vehicle not in gone)
    return (*(CrossingVehicle(v, first="vehicle", gone=True) for v in gone), *still)


def reckoned_with(ride: Ride, vehicle: int, time: float) -> bool:
    """Check whether a vehicle was in our way in rollouts of going or stopping before a time [s].

    If not, neither depended on what the vehicle did. Without such rollouts, this is not known, and
    the rule of the road stands: the result is True.
    """
    drives = [
        drive
        for trace in ride.traces
        if time - LATELY <= trace.sim_time <= time
        for drive in trace.rollouts
        if drive.actions and drive.actions[0].action in (*planned(trace)[:1], "stop")
    ]
    hit = any(drive.collided_with == vehicle for drive in drives)
    return not drives or hit or any(h.vehicle == vehicle for d in drives for h in d.held_up)


def _parts(world: World, wait: RideEvent, time: float) -> bool:
    """Check whether a vehicle that we gave way to is passing or going away at a time [s]."""
    assert wait.vehicle is not None
    first, last = world.look(wait.vehicle, wait.sim_time), world.look(wait.vehicle, time)
    if first is None or last is None:
        return first is not None
    if last.speed < MOVING:
        return False  # it waits for somebody else
    return last.distance > first.distance + APART or last.distance < NEXT


def _met(trace: PlanTrace) -> tuple[int, ...]:
    return () if trace.road is None else tuple(f.vehicle for f in trace.road.priority)


def _one(ride: Ride, world: World, trace: PlanTrace, time: float, vehicle: int) -> CrossingVehicle:
    facts = () if trace.road is None else trace.road.priority
    first = next(fact.who for fact in facts if fact.vehicle == vehicle)
    look = world.look(vehicle, time)
    motion = ride.motion(vehicle).until(time)
    return CrossingVehicle(vehicle, first, motion.trend, None if look is None else look.distance)
