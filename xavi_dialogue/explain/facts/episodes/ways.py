"""Episodes of the way: lane changes, turns, junctions crossed, roundabouts entered and left."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from planner.record.places import RoadPlace
from planner.record.trace import ON_FOOT, Action
from sim.scene import EGO
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Junction
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.facts.actions import SIDES, named
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.deeds import Deed
from xavi_dialogue.explain.history.motion import Motion, Sighting
from xavi_dialogue.explain.history.predicted_roads import turn_to

LEAST = 0.3  # [m] minimum movement sideways of a lane change that has begun
ASIDE = 1.5  # [s] around a lane change or turn in which places on the road count for it

TURNS: tuple[Action, ...] = ("exit-left", "exit-right")


@dataclass(frozen=True, slots=True)
class Stay:
    """A stretch in which a vehicle was on a roundabout, or inside a junction."""

    begin: float  # [s]
    end: float | None  # [s] None: it still is
    ring: bool
    before: RoadPlace | None
    after: RoadPlace | None


def ways(states: States, vehicle: int) -> list[Episode]:
    """Return the lane changes, turns and roundabouts of a vehicle."""
    return states.memo(("ways", vehicle), lambda: _ways(states, vehicle))


def _ways(states: States, vehicle: int) -> list[Episode]:
    shape = states.shape(vehicle)
    if shape is not None and shape.kind in ON_FOOT:
        return []  # people on foot take no lanes, turns and exits
    stays = list(_stays(states, vehicle))
    found = list(_rings(states, vehicle, stays))
    if vehicle == EGO:
        return found + _own(states, stays)
    rings = [(s.begin, math.inf if s.end is None else s.end) for s in stays if s.ring]
    for sighting in states.motion(vehicle).sightings():
        if sighting.action in ("change-left", "change-right"):
            found += _changed_lane(states, vehicle, sighting, rings)
        elif sighting.action in ("exit-left", "exit-right"):
            found += _turned(states, vehicle, sighting, rings)
    return found + _straight(states, vehicle, stays, found)


def _own(states: States, stays: list[Stay]) -> list[Episode]:
    """Return what the ego carried out, by its own events."""
    found = []
    for deed in states.ride.deeds:
        if deed.action in ("continue", "stop"):
            continue
        begin, end = deed.time, deed.ended
        speeds = _speeds(states.motion(EGO), begin, states.ride.now if end is None else end)
        side = SIDES.get(deed.action)
        place = _crossing(deed, stays)
        found.append(Episode(named(EGO), deed.action, begin, end, None, side, *speeds, place=place))
    return found


def _crossing(deed: Deed, stays: list[Stay]) -> Junction | None:
    """Return the junction at which the ego carried out an action; None for a lane change."""
    if deed.action in ("change-left", "change-right"):
        return None
    begin, end = deed.span
    for stay in stays:
        if (
            stay.ring
            and stay.begin <= end
            and begin <= (math.inf if stay.end is None else stay.end)
        ):
            return Junction("roundabout", time=stay.begin)
    return Junction("junction", time=begin)


def _speeds(motion: Motion, begin: float, end: float) -> tuple[float | None, float | None]:
    first, last = motion.index(begin), motion.index(end)
    return (
        None if first is None else motion.speed[first],
        None if last is None else motion.speed[last],
    )


def _stays(states: States, vehicle: int) -> Iterator[Stay]:
    """Yield when a vehicle was on roundabouts and inside junctions, as the decisions record."""
    inside: tuple[float, bool, RoadPlace | None] | None = None
    last: tuple[float, RoadPlace] | None = None
    for trace in states.ride.traces:
        here = trace.road.places.get(vehicle) if trace.road is not None else None
        if here is None:
            continue
        time = trace.sim_time if last is None else (trace.sim_time + last[0]) / 2.0
        now = here.roundabout or here.in_junction
        if inside is not None and (not now or here.roundabout != inside[1]):
            if not (here.roundabout and not inside[1]):  # the entry of a roundabout is part of it
                yield Stay(inside[0], time, inside[1], inside[2], here)
                inside = None
            else:
                inside = (inside[0], True, inside[2])
        if inside is None and now:
            inside = (time, here.roundabout, None if last is None else last[1])
        last = (trace.sim_time, here)
    if inside is not None and last is not None:
        gone = not states.known(vehicle, states.ride.now) or states.ride.ended
        yield Stay(inside[0], last[0] if gone else None, inside[1], inside[2], None)


def _rings(states: States, vehicle: int, stays: list[Stay]) -> Iterator[Episode]:
    for stay in stays:
        if not stay.ring:
            continue
        place = Junction("roundabout", time=stay.begin)
        here = named(vehicle)
        number, side = _exit_taken(states, stay) if vehicle == EGO else (None, None)
        if stay.before is not None:
            yield Episode(here, "enter", stay.begin, stay.begin, place, place=place, exit=number)
        if stay.end is not None and stay.after is not None:
            yield Episode(here, "leave", stay.end, stay.end, place, side, place=place, exit=number)


def _exit_taken(states: States, stay: Stay) -> tuple[int | None, None]:
    """Return which exit of a roundabout the ego takes or took, by the last route before it."""
    number: int | None = None
    for trace in states.ride.traces:
        if trace.sim_time > (math.inf if stay.end is None else stay.end):
            break
        if trace.sim_time > stay.begin - 4.0 and trace.road is not None:
            here = trace.road.places.get(EGO)
            step = next((s for s in trace.road.route if s.kind == "roundabout"), None)
            if step is not None and here is not None and not here.roundabout:
                number = step.exit
    return number, None


def _changed_lane(
    states: States, vehicle: int, sighting: Sighting, rings: list[tuple[float, float]]
) -> Iterator[Episode]:
    """Yield a lane change, unless the lanes on record say otherwise."""
    if any(a - ASIDE <= sighting.end and sighting.start <= b + ASIDE for a, b in rings):
        return
    motion = states.motion(vehicle)
    begin = _moved_over(motion, sighting)
    before = states.place(vehicle, begin - ASIDE / 2.0)
    after = states.place(vehicle, sighting.end + ASIDE / 2.0)
    sure = False
    if before is not None and after is not None:
        sure = True
        if (before.edge, before.lane) == (after.edge, after.lane):
            return
    speeds = _speeds(motion, begin, sighting.end)
    side = SIDES[sighting.action]
    yield Episode(
        named(vehicle), sighting.action, begin, sighting.end, None, side, *speeds, sure=sure
    )


def _moved_over(motion: Motion, sighting: Sighting) -> float:
    """Return when [s] a vehicle began to move sideways."""
    inside = motion.within(sighting.start, sighting.end)
    first = inside[0]
    (x, y), heading = motion.position[first], motion.heading[first]
    for k in inside:
        dx, dy = motion.position[k][0] - x, motion.position[k][1] - y
        if abs(dy * math.cos(heading) - dx * math.sin(heading)) >= LEAST:
            return motion.time[max(k - 1, first)]
    return sighting.start


def _turned(
    states: States, vehicle: int, sighting: Sighting, rings: list[tuple[float, float]]
) -> Iterator[Episode]:
    """Yield a turn, unless the road itself bends, or it is a roundabout."""
    if any(a - ASIDE <= sighting.end and sighting.start <= b + ASIDE for a, b in rings):
        return
    roads = [
        trace.road.places.get(vehicle)
        for trace in states.ride.traces
        if trace.road is not None and sighting.start - 1.0 <= trace.sim_time <= sighting.end + 1.0
    ]
    known = [place for place in roads if place is not None]
    if known and len({p.edge for p in known}) == 1 and not any(p.in_junction for p in known):
        return
    motion = states.motion(vehicle)
    speeds = _speeds(motion, sighting.start, sighting.end)
    yield Episode(
        named(vehicle),
        sighting.action,
        sighting.start,
        sighting.end,
        None,
        SIDES[sighting.action],
        *speeds,
        place=Junction("junction", time=sighting.start),
        sure=bool(known),
    )


def _straight(
    states: States, vehicle: int, stays: list[Stay], others: list[Episode]
) -> list[Episode]:
    """Return the junctions that a vehicle crossed without a turn."""
    found = []
    for stay in stays:
        end = stay.end
        if stay.ring or end is None or stay.before is None or stay.after is None:
            continue
        turned = any(
            e.action in ("exit-left", "exit-right")
            and e.begin <= end + ASIDE
            and (e.end is None or stay.begin - ASIDE <= e.end)
            for e in others
        )
        if not turned:
            place = Junction("junction", time=stay.begin)
            # However little the road bends, what a goal calls a turn is one.
            kind = turn_to(states.ride.traces, vehicle, stay.after.edge, stay.begin)
            action: ActionName = kind if kind in TURNS else "exit-straight"
            side = SIDES[action]
            found.append(Episode(named(vehicle), action, stay.begin, end, None, side, place=place))
    return found
