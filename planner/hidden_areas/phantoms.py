"""Phantoms: imagined road users that may come, with priority, out of a hidden part of the road.

As in goal-oriented planning with factors of occlusion (GOFI: Hanna et al. 2021, Interpretable
Goal Recognition in the Presence of Occluded Factors for Autonomous Vehicles), a phantom has a
probability, is sampled in rollouts, and is recorded.

A hidden stretch matters if a vehicle at its near end could arrive before the ego is across, from
the place where the ego can only just stop. Then the ego drives to the line at no more than READY,
as with a restricted view of a junction (AASHTO 2018, A Policy on Geometric Design of Highways and
Streets, 9.5, case C: approach sight triangles). There it sees more, or it creeps on until it does
(see `planner.hidden_areas.caution`). It stops only for vehicles that it sees.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from planner.kernels.limits import (
    ACCELERATION,
    COMFORT,
    FIRST,
    FOLLOWING,
    HALT,
    OPEN,
    REACTION,
    READY,
)
from planner.motion.tracks import lanes_at
from planner.record.hidden_record import Phantom
from planner.roads.routes import approaches
from planner.roads.sightlines import between, middle
from planner.roads.trajectory import Roads
from planner.traffic_lights.signals import NO_LIGHTS, Lights
from sim.roads.network import Lane, Link, Location, Network, point_at, project
from sim.scene import EGO, Point, Signal, Unseen, VehicleState

#: [1/s] prior rate of vehicles on a lane: 300 an hour, as on a road in a town by day.
PRIOR_RATE = 1.0 / 12.0
LEAST = 0.03  # minimum probability of a phantom
MOST = 4  # maximum number of phantoms
STANDING = 2.0  # [m/s] below which a visible vehicle blocks those behind it
LOOKED_AT = 5.0  # [m] between places of a lane that are tested for being in view
SPACING = 0.5  # [m] between places of a way that are tested
ASIDE = 2.8  # [m] between the middles of two cars with a metre between them
FASTEST = 20.0  # [m/s] speed limit above which vehicles merge at speed, without caution
NOTICE = 3.0  # [s] before braking for a line, from which on hidden areas matter
LOW = ("car", "motorcycle", "bicycle")  # kinds over which the ego can see


@dataclass
class Counts:
    """The numbers of vehicles seen on the edges asked for, and since when these are watched."""

    _since: dict[str, float] = field(default_factory=dict)  # [s] by edge
    _seen: dict[str, set[int]] = field(default_factory=dict)

    def rate(self, edge: str, time: float) -> float:
        """Return the rate [1/s] of vehicles on an edge: the mean of a gamma distribution.

        Before anything is seen it is PRIOR_RATE, as if one had come in 1 / PRIOR_RATE seconds.
        """
        since = self._since.setdefault(edge, time)
        return (1.0 + len(self._seen.get(edge, ()))) / (1.0 / PRIOR_RATE + time - since)

    def note(self, places: Mapping[int, str]) -> None:
        """Count the vehicles that are seen, given their edges by number."""
        for vehicle, edge in places.items():
            if edge in self._since:
                self._seen.setdefault(edge, set()).add(vehicle)


@dataclass(frozen=True, slots=True)
class View:
    """The road users seen and the parts of the road hidden at one instant."""

    roads: Roads
    seen: Mapping[int, VehicleState]  # the ego included
    unseen: tuple[Unseen, ...]
    rate: Callable[[str], float]  # [1/s] of vehicles, by edge
    lights: Lights = NO_LIGHTS  # as they are now

    @property
    def ego(self) -> VehicleState:
        """The car itself."""
        return self.seen[EGO]


@dataclass(frozen=True, slots=True)
class _Nearest:
    """The nearest hidden stretch up a road."""

    lanes: tuple[str, ...]  # from it to the line
    stretch: Unseen
    distance: float  # [m] from its end to the line
    hidden: float  # [m] of the road that is hidden within the reach


def around(view: View, here: Location) -> tuple[Phantom, ...]:
    """Return phantoms at the junction where the ego is or, if there are none, at the next one."""
    network = view.roads.network
    inside = network.link_via(here.lane)
    if inside is not None:
        before = inside.via[: inside.via.index(here.lane)]
        driven = sum(network.lanes[lane].length for lane in before) + here.offset
        found = tuple(one for one in imagined(view, (inside,)) if one.meets[0] > driven)
        if found:
            return found
    return imagined(view, ways_ahead(view.roads, here, view.ego.speed))


def ways_ahead(roads: Roads, here: Location, speed: float) -> tuple[Link, ...]:
    """Return the links of the junction that a vehicle at a speed [m/s] is approaching.

    The speed counts as at least READY, since a vehicle that stands before a line may set off.
    """
    network, reach = roads.network, reach_of(max(speed, READY))
    found: dict[tuple[str, int], Link] = {}
    for ahead in approaches(roads, here, reach):
        last = network.lanes[ahead.lanes[-1]]
        if ahead.distance <= reach and not last.internal:
            for lane in network.edge_lanes(last.edge):
                for link in network.links_from(lane.id):
                    found[link.junction, link.index] = link
    return tuple(found[key] for key in sorted(found))


def reach_of(speed: float) -> float:
    """Return the distance [m] before a line within which hidden areas matter."""
    return speed * (NOTICE + REACTION) + speed * speed / (2.0 * COMFORT)


def imagined(view: View, links: Iterable[Link]) -> tuple[Phantom, ...]:
    """Return phantoms that may come out of hidden areas and would go first.

    Args:
        view: what is seen, and what is hidden.
        links: links of one junction by which the ego may cross it.
    """
    if not view.unseen:
        return ()
    network = view.roads.network
    hidden: dict[str, list[Unseen]] = {}
    for stretch in view.unseen:
        hidden.setdefault(stretch.lane, []).append(stretch)
    found = []
    for theirs, ours in _meetings(network, links, view.lights):
        pace = network.lanes[theirs.from_lane].speed_limit
        needed = max(time_across(network, link, view.ego) for link in ours)
        nearest = _nearest(network, hidden, theirs.from_lane, pace * needed)
        if nearest is not None:
            one = _phantom(view, theirs, ours, nearest, pace * needed)
            if one is not None:
                found.append(one)
    found.sort(key=lambda one: (one.distance / one.speed, one.junction, one.link))
    return tuple(found[:MOST])


def time_across(network: Network, link: Link, ego: VehicleState) -> float:
    """Return the time [s] that the ego takes across, from where it can only just stop."""
    way = sum(network.lanes[lane].length for lane in link.via) + ego.length
    pace = max(ego.speed, READY)
    crossing = (math.sqrt(pace * pace + 2.0 * ACCELERATION * way) - pace) / ACCELERATION
    return REACTION + pace / (2.0 * FOLLOWING) + crossing


def meeting(roads: Roads, mine: Link, theirs: Link) -> float:
    """Return the distance [m] behind its line at which a link meets another of its junction."""
    key = (mine.junction, mine.index, theirs.index)
    found = roads.meetings.get(key)
    if found is None:
        lanes = roads.network.lanes
        way = [lanes[lane].centreline for lane in (*theirs.via, theirs.to_lane)]
        found, begun = 0.0, 0.0
        for lane in (lanes[name] for name in mine.via):
            for k in range(int(lane.length / SPACING) + 1):
                found = begun + k * SPACING
                place, _ = point_at(lane.centreline, k * SPACING)
                if any(_beside(line, place) for line in way):
                    roads.meetings[key] = found
                    return found
            begun += lane.length
        roads.meetings[key] = found
    return found


def _beside(line: tuple[Point, ...], place: Point) -> bool:
    """Check whether a car on a line would come within a metre of one at a place."""
    offset, _, _ = project(line, place)
    nearest, _ = point_at(line, offset)
    return math.dist(nearest, place) < ASIDE


def _meetings(
    network: Network, links: Iterable[Link], lights: Lights
) -> Iterator[tuple[Link, list[Link]]]:
    """Yield, for each lane from which others go first, their link and the ego's yielding links."""
    by_lane: dict[str, dict[int, list[Link]]] = {}
    junction = ""
    for mine in links:
        if not _open(mine, lights):
            continue
        junction = mine.junction
        for index in mine.yields_to:
            theirs = network.junction_links(junction)[index]
            same = network.lanes[theirs.from_lane].edge == network.lanes[mine.from_lane].edge
            pace = network.lanes[theirs.from_lane].speed_limit
            if not same and pace <= FASTEST and _comes(theirs, lights):
                by_lane.setdefault(theirs.from_lane, {}).setdefault(index, []).append(mine)
    for ways in by_lane.values():
        index = max(ways, key=lambda k: (len(ways[k]), _is_straight(network, junction, k), -k))
        yield network.junction_links(junction)[index], ways[index]


def _is_straight(network: Network, junction: str, index: int) -> bool:
    return network.junction_links(junction)[index].direction == "straight"


def _open(link: Link, lights: Lights) -> bool:
    """Check whether the ego must watch for others at a link, given its light."""
    return not isinstance(link.control, Signal) or _shown(link.control, lights) in (OPEN, HALT)


def _comes(link: Link, lights: Lights) -> bool:
    """Check whether a light lets the others come along a link."""
    return not isinstance(link.control, Signal) or _shown(link.control, lights) in (FIRST, OPEN)


def _shown(signal: Signal, lights: Lights) -> int:
    return int(lights.shows(signal, 1)[0])


def _nearest(
    network: Network, hidden: Mapping[str, Sequence[Unseen]], lane: str, reach: float
) -> _Nearest | None:
    """Return the nearest hidden stretch up the road from a line, at most `reach` [m] away."""
    waiting: list[tuple[float, tuple[str, ...]]] = [(0.0, (lane,))]
    best: _Nearest | None = None
    while waiting:
        ahead, row = waiting.pop()
        length = network.lanes[row[0]].length
        stretches = hidden.get(row[0], ())
        if stretches:
            last = max(stretches, key=lambda one: one.end)
            distance = ahead + max(length - last.end, 0.0)
            if distance < (reach if best is None else best.distance):
                parts = _hidden_up(network, hidden, row[0], ahead, reach)
                best = _Nearest(row, last, distance, parts)
        elif ahead + length < (reach if best is None else best.distance):
            further = (x for x in _before(network, row[0]) if x not in row)
            waiting += [(ahead + length, (x, *row)) for x in further]
    return best


def _hidden_up(
    network: Network, hidden: Mapping[str, Sequence[Unseen]], lane: str, ahead: float, reach: float
) -> float:
    """Return the length [m] hidden from a lane upstream, within `reach` [m] of the line."""
    total, passed = 0.0, {lane}
    while True:
        length = network.lanes[lane].length
        for one in hidden.get(lane, ()):
            far = min(ahead + length - one.begin, reach)
            total += max(far - (ahead + length - one.end), 0.0)
        ahead += length
        further = [x for x in _before(network, lane) if x not in passed]
        if ahead >= reach or len(further) != 1:
            return total
        lane = further[0]
        passed.add(lane)


def _before(network: Network, lane: str) -> tuple[str, ...]:
    """Return the lanes that lead onto a lane, lanes in junctions included."""
    inside = network.link_via(lane)
    if inside is not None:
        at = inside.via.index(lane)
        return (inside.via[at - 1] if at else inside.from_lane,)
    into = network.links_to(lane)
    return tuple(dict.fromkeys(x.via[-1] if x.via else x.from_lane for x in into))


def _phantom(
    view: View, theirs: Link, ours: Sequence[Link], nearest: _Nearest, reach: float
) -> Phantom | None:
    """Return the phantom at the near end of a hidden stretch; None if none would come."""
    network, lane = view.roads.network, view.roads.network.lanes[nearest.lanes[0]]
    pace = min(lane.speed_limit, _held_by(view, nearest))
    hidden = min(nearest.hidden, max(reach - nearest.distance, 0.0))
    if pace < STANDING:
        return None
    rate = view.rate(network.lanes[theirs.from_lane].edge)
    probability = 1.0 - math.exp(-rate * hidden / pace)
    if probability < LEAST:
        return None
    place = min(nearest.stretch.end, lane.length)
    (x, y), heading = point_at(lane.centreline, place)
    hiders = _hiders(view, _looked_at(lane, nearest.stretch))
    return Phantom(
        lanes=(*nearest.lanes, *theirs.via, theirs.to_lane),
        begin=nearest.stretch.begin,
        end=place,
        position=(round(x, 2), round(y, 2)),
        heading=round(heading, 4),
        speed=round(pace, 2),
        distance=round(nearest.distance, 2),
        hidden=round(hidden, 2),
        rate=round(rate, 5),
        probability=round(probability, 4),
        junction=theirs.junction,
        link=theirs.index,
        yields=tuple(link.index for link in ours),
        meets=tuple(round(meeting(view.roads, link, theirs), 2) for link in ours),
        behind=next(iter(hiders), None),
        beyond=hiders[1:],
        walled=bool(hiders) and nearest.stretch.walled,
    )


def _looked_at(lane: Lane, stretch: Unseen) -> Point:
    """Return the last tested place of a hidden stretch, half a spacing before its end."""
    count = max(1, round(lane.length / LOOKED_AT))
    return point_at(lane.centreline, stretch.end - lane.length / count / 2.0)[0]


def _held_by(view: View, nearest: _Nearest) -> float:
    """Return the speed [m/s] of the slowest vehicle seen between a hidden stretch and the line."""
    slowest = math.inf
    for name, state in view.seen.items():
        if name == EGO:
            continue
        for at in lanes_at(view.roads, state.position, state.heading):
            ahead = at.lane != nearest.lanes[0] or at.offset > nearest.stretch.end
            if at.lane in nearest.lanes and ahead:
                slowest = min(slowest, state.speed)
    return slowest


def _hiders(view: View, point: Point) -> tuple[int, ...]:
    """Return the vehicles behind which a place is hidden, the nearest first."""
    eye = middle(view.ego)
    tall = {name: x for name, x in view.seen.items() if name != EGO and x.kind not in LOW}
    found = [name for name, state in tall.items() if between(eye, point, state)]
    return tuple(sorted(found, key=lambda name: math.dist(eye, middle(tall[name]))))
