"""Roadside: reasons for slow driving that lie in the road: turns, lines, limits, the trip's end."""

import math

from msgspec.structs import replace

from planner.record.trace import PlanTrace
from sim.roads.network import angle_between
from sim.scene import EGO
from xavi_dialogue.domain.answers import MotionCause
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.explain.causes.vehicles.course import lines
from xavi_dialogue.explain.history.motion import Motion
from xavi_dialogue.explain.history.nearing import junctions_ahead, to_destination
from xavi_dialogue.explain.history.ride import Ride, planned
from xavi_dialogue.explain.history.traffic_lights import rule_at

BRAKING = 1.5  # [m/s2] deceleration of slowing down early and gently
CLOSE = 5.0  # [m] below which a place counts as reached
MARGIN = 12.0  # [m] before a place at which slowing down for it is complete
AGAIN = 6.0  # [s] after a standstill in which a vehicle is still setting off
STANDING = 0.3  # [m/s] below which a vehicle stands
SLACK = 0.5  # [m/s] by which a speed may exceed the limit

PICKED_UP = 2.0  # [m/s] above the lowest speed, from which a motion is faster again
BENDING = 2.5  # [s] after slowing down in which a bend explains it
SLOWER = 1.0  # [m/s] minimum by which a bend is driven through more slowly
BEND = math.radians(10.0)  # [rad] minimum turn of our heading in a bend

#: Actions that end in a standstill: reasons for a lower speed (`PACES`) do not explain them.
HALTS = frozenset(("stop", "stand", "wait", "give-way"))
PACES = frozenset(("turn", "bend", "roundabout", "limit"))
TURNS = ("exit-left", "exit-right", "continue-next-exit")


def road_causes(ride: Ride, trace: PlanTrace, deed: Episode) -> tuple[MotionCause, ...]:
    """Return what in the road explains an episode; the cause "plan" if nothing does."""
    if deed.action == "speed-up":
        return speeding_up(ride, deed)
    junction = [_from_here(ride, deed, cause) for cause in _junction(trace, deed)]
    junction = [] if junction and _beyond_slowest(ride, trace, deed) else junction
    found = [*_destination(ride, trace, deed), *junction, *_lower_limit(ride, deed)]
    found = found[:2] or _bend(ride, trace, deed)
    if deed.action in HALTS:
        found = [cause for cause in found if cause.kind not in PACES]
    return tuple(found) or (MotionCause("plan"),)


def speeding_up(ride: Ride, deed: Episode) -> tuple[MotionCause, ...]:
    """Return why the ego sped up: it set off, or was below the limit; else the cause "plan"."""
    found = []
    motion = ride.motion(EGO)
    stood = [t for t, v in zip(motion.time, motion.speed, strict=True) if v < STANDING]
    if any(deed.begin - AGAIN <= t <= deed.begin + AGAIN for t in stood):
        found.append(MotionCause("starting"))
    known = [limit_at(ride, t) for t in (deed.begin, ride.now if deed.end is None else deed.end)]
    limit = max((one for one in known if one is not None), default=None)
    if limit is not None and deed.speed_from is not None and deed.speed_from < limit:
        found.append(MotionCause("limit", value=limit))
    return tuple(found) or (MotionCause("plan"),)


def limit_at(ride: Ride, time: float) -> float | None:
    """Return the limit [m/s] where the ego was at a time; None if no record has it."""
    trace = ride.at(time)
    if trace is None or trace.road is None:
        return None
    place = trace.road.places.get(EGO)
    return None if place is None else place.limit


def setting_off(ride: Ride, time: float, vehicle: int = EGO) -> bool:
    """Check whether a vehicle stood shortly before a time [s] and is speeding up then."""
    motion = ride.motion(vehicle).until(time)
    if motion.trend != "speeding-up":
        return False
    pairs = zip(motion.time, motion.speed, strict=True)
    return any(v < STANDING for t, v in pairs if t >= time - AGAIN)


def _destination(ride: Ride, trace: PlanTrace, deed: Episode) -> list[MotionCause]:
    arrived = [e.sim_time for e in ride.events if e.kind == "arrived"]
    if any(time <= (deed.end or ride.now) + 1.0 for time in arrived):
        return [MotionCause("destination")]
    if trace.road is None or trace.road.distance is None:
        return []
    if trace.road.distance > _reach(deed):
        return []
    time = ride.now if deed.end is None else deed.begin
    return [MotionCause("destination", value=to_destination(ride, time))]


def _drawn(ride: Ride, trace: PlanTrace, deed: Episode) -> tuple[PlanTrace, Motion] | None:
    """Return the last decision in an episode that recorded the line of a rollout, and that line."""
    known = [t for t in ride.traces if deed.begin - 1.0 <= t.sim_time < trace.sim_time]
    for decided in (trace, *reversed(known)):
        motion = next(iter(lines(decided).values()), None)
        if motion is not None:
            return decided, motion
    return None


def _beyond_slowest(ride: Ride, trace: PlanTrace, deed: Episode) -> bool:
    """Check whether the planned motion is slowest well before the next junction, then faster."""
    found = _drawn(ride, trace, deed)
    if trace.under_way is not None and trace.under_way.action in TURNS:
        return False
    if found is None or found[0].road is None or not found[0].road.route:
        return False
    distance = found[0].road.route[0].distance
    low = _slowest(found[1], distance)
    return low is not None and low < distance - MARGIN


def bends_first(ride: Ride, since: float) -> bool:
    """Check whether the line that was planned at a time [s] slows into a bend before a junction."""
    known = [t for t in ride.traces if since - 1.0 <= t.sim_time <= since + 1.0]
    drawn = ((t, next(iter(lines(t).values()), None)) for t in known)
    trace, motion = next(((t, m) for t, m in drawn if m is not None), (None, None))
    if trace is None or motion is None or trace.road is None or not trace.road.route:
        return False
    place = trace.road.places.get(EGO)
    if place is not None and place.in_junction:
        return False
    way = 0.0
    for k, heading in enumerate(motion.heading):
        way += math.dist(motion.position[max(k - 1, 0)], motion.position[k])
        if way > trace.road.route[0].distance - MARGIN:
            return False
        if abs(angle_between(heading, motion.heading[0])) >= BEND:
            return motion.speed[k] < motion.speed[0] - SLOWER
    return False


def _slowest(motion: Motion, distance: float) -> float | None:
    """Return how far on [m] a motion is slowest before it is faster again.

    None: that is not within a distance [m].
    """
    way, lowest, at = 0.0, math.inf, 0.0
    for k, speed in enumerate(motion.speed):
        way += math.dist(motion.position[max(k - 1, 0)], motion.position[k])
        if way > distance:
            return None
        if speed < lowest:
            lowest, at = speed, way
        elif speed > lowest + PICKED_UP:
            return at
    return None


def _bend(ride: Ride, trace: PlanTrace, deed: Episode) -> list[MotionCause]:
    """Return a bend of the road that was driven through after slowing down, or is planned to be."""
    end = ride.now if deed.end is None else deed.end
    drawn = _drawn(ride, trace, deed)
    for motion in (ride.motion(EGO), *(() if drawn is None else drawn[1:])):
        headings = [motion.heading[k] for k in motion.within(deed.begin, end + BENDING)]
        turned = [angle_between(heading, headings[0]) for heading in headings]
        if max(map(abs, turned), default=0.0) >= BEND:
            return [MotionCause("bend")]
    return []


def _lower_limit(ride: Ride, deed: Episode) -> list[MotionCause]:
    """Return a limit that came to be lower than the speed that was driven."""
    end = ride.now if deed.end is None else deed.end
    before, after = limit_at(ride, deed.begin - 1.0), limit_at(ride, end + 1.0)
    if before is None or after is None or deed.speed_from is None:
        return []
    lower = after < before and deed.speed_from > after + SLACK
    return [MotionCause("limit", value=after)] if lower else []


def _junction(trace: PlanTrace, deed: Episode) -> list[MotionCause]:
    """Return the junction that the ego was in or came to, and what it had to do there."""
    if trace.road is None:
        return [MotionCause("turn")] if is_turning(trace) else []
    place = trace.road.places.get(EGO)
    if place is not None and (place.in_junction or place.roundabout):
        if place.roundabout:
            return [MotionCause("roundabout")]
        return [MotionCause("turn")] if is_turning(trace) else []
    step = next(iter(trace.road.route), None)
    if step is None or step.distance > _reach(deed):
        return []
    found = []
    if step.kind == "roundabout":
        found.append(MotionCause("roundabout", value=step.distance))
    elif step.turn != "exit-straight":
        found.append(MotionCause("turn", value=step.distance))
    rule = rule_at(trace.road, step)
    if rule != "priority":
        found.append(MotionCause("give-way-line", value=step.distance))
    if rule == "give-way":
        found.reverse()
    return found


def _from_here(ride: Ride, deed: Episode, cause: MotionCause) -> MotionCause:
    """Return a reason at a junction ahead, with its distance now; with none once it is reached."""
    route = junctions_ahead(ride, ride.now)
    if deed.end is not None or not route or route[0].distance < CLOSE:
        return replace(cause, value=None)
    if cause.value is None:
        return cause
    passed = route[0].distance > cause.value + CLOSE
    return replace(cause, value=None if passed else route[0].distance)


def is_turning(trace: PlanTrace) -> bool:
    """Check whether a turn is under way or comes next."""
    first = (
        trace.under_way.action if trace.under_way is not None else next(iter(planned(trace)), "")
    )
    return first in TURNS


def _reach(deed: Episode) -> float:
    """Return how far [m] ahead the reason for slowing down in an episode may lie."""
    speed = deed.speed_from if deed.speed_from is not None else 10.0
    return speed * speed / (2.0 * BRAKING) + MARGIN
