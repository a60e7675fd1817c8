"""Finding the way through the lane graph: which junction comes, and where its links lead.

Directions are those that people would name: where two roads lead straight on, the lesser one
is to the left or to the right; a roundabout is left to the side.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from planner.record.trace import EgoGoal
from planner.roads.trajectory import Roads
from sim.roads.network import Direction, Link, Location, Network, angle_between, point_at

PREVIEW = 15.0  # [m] into a road at which its bearing is taken
TURNING_BACK = 50.0  # [m] that a way with a turn back must be shorter to be taken
ALIKE = 0.35  # [rad] by which two roads straight on may differ in bearing


@dataclass(frozen=True, slots=True)
class Refusal:
    """The reason why an action does not apply: a clause in words."""

    reason: str


@dataclass(frozen=True, slots=True)
class Lead:
    """A link from the end of a lane, with the direction that people would name."""

    link: Link
    direction: Direction  # never turnaround
    turnaround: bool


@dataclass(frozen=True, slots=True)
class LaneEnd:
    """The end of a lane, with the links that it leads to."""

    leads: tuple[Lead, ...]
    joint: Link | None  # by which the road just goes on: no choice, nobody to give way to
    merges: bool  # the lane ends here, but others of its edge lead on


@dataclass(frozen=True, slots=True)
class Approach:
    """The way to the next junction at which there is a choice, or to the end of the road."""

    lanes: tuple[str, ...]  # connected, from the present one on
    distance: float  # [m] to the end of the last of them


def lane_end(roads: Roads, lane: str) -> LaneEnd:
    """Return where a lane leads; of an internal lane, nowhere."""
    found = roads.ends.get(lane)
    if found is None:
        found = roads.ends[lane] = _lane_end(roads.network, lane)
    return found


def direction_of(roads: Roads, link: Link) -> Direction:
    """Return the direction of a link that people would name."""
    leads = lane_end(roads, link.from_lane).leads
    return next(lead.direction for lead in leads if lead.link == link)


def straight_on(roads: Roads, lane: str, goal: EgoGoal | None = None) -> Link | Refusal:
    """Return the link straight on from a lane, if it needs no giving way and no decision.

    Args:
        roads: the road network.
        lane: where it begins.
        goal: of several links, the one that leads there is taken.
    """
    end, network = lane_end(roads, lane), roads.network
    if end.joint is not None:
        return end.joint
    link = toward(roads, lane, "straight", goal)
    if link is None:
        return Refusal("its lane ends" if end.merges else "the lane does not lead straight on")
    ring = network.roundabout(network.lanes[link.to_lane].edge)
    if ring is not None:
        inside = network.lanes[lane].edge in ring
        return Refusal(f"{'an exit of the' if inside else 'a'} roundabout comes first")
    if link.yields_to:
        return Refusal("a junction comes first, where it has to give way")
    return link


def toward(roads: Roads, lane: str, direction: Direction, goal: EgoGoal | None) -> Link | None:
    """Return the link from a lane in a direction; of several, the one nearest to the goal."""
    found = [lead for lead in lane_end(roads, lane).leads if lead.direction == direction]
    if len(found) < 2:
        return found[0].link if found else None

    return min(found, key=lambda lead: _length_by(roads, lead, goal)).link


def _length_by(roads: Roads, lead: Lead, goal: EgoGoal | None) -> tuple[float, bool]:
    """Return the length [m] of the way to a goal by a link, with an extra if it turns back."""
    length = remaining(roads, roads.network.lanes[lead.link.to_lane].edge, goal)
    return length + TURNING_BACK * lead.turnaround, lead.turnaround


def remaining(roads: Roads, edge: str, goal: EgoGoal | None) -> float:
    """Return the way [m] from the start of an edge to that of the goal's edge; 0 without a goal."""
    if goal is None or edge == goal.edge:
        return 0.0
    beyond = roads.network.distance_to(goal.edge).get(edge, math.inf)
    return roads.network.edge_lanes(edge)[0].length + beyond


def approach(roads: Roads, here: Location, reach: float) -> Approach:
    """Follow the road to the next junction with a choice, or until `reach` [m] is exceeded.

    A vehicle inside a junction follows its link first.
    """
    return next(approaches(roads, here, reach))


def approaches(roads: Roads, here: Location, reach: float) -> Iterator[Approach]:
    """Follow the road as `approach` does, then as well by the lanes that begin beside its own.

    Where a lane becomes two, such as the short ones for turning before a junction, it leads to
    either without a lane change.
    """
    begin = (here.lane, *rest_of(roads.network, here.lane))
    distance = sum(roads.network.lanes[lane].length for lane in begin) - here.offset
    return _approaches(roads, begin, distance, reach)


def _approaches(
    roads: Roads, lanes: tuple[str, ...], distance: float, reach: float
) -> Iterator[Approach]:
    network = roads.network
    joint = lane_end(roads, lanes[-1]).joint
    if distance > reach or joint is None or joint.to_lane in lanes:
        yield Approach(lanes, distance)
        return
    edge = network.lanes[joint.to_lane].edge
    beside = (x for x in network.links_from(lanes[-1]) if x != joint)
    for link in (joint, *(x for x in beside if network.lanes[x.to_lane].edge == edge)):
        more = (*link.via, link.to_lane)
        length = sum(network.lanes[lane].length for lane in more)
        yield from _approaches(roads, (*lanes, *more), distance + length, reach)


def link_ahead(
    roads: Roads, here: Location, direction: Direction, view: float, goal: EgoGoal | None = None
) -> Link | Refusal:
    """Return the link in a direction at the junction ahead, or the one that is being driven.

    Args:
        roads: the road network.
        here: where the vehicle is.
        direction: where the link leads.
        view: [m] how far ahead a junction is seen.
        goal: of several such links, the one nearest to it is taken.
    """
    network = roads.network
    inside = network.link_via(here.lane)
    if inside is not None and lane_end(roads, inside.from_lane).joint != inside:
        fits = direction_of(roads, inside) == direction
        return inside if fits else Refusal("it is already inside the junction")
    ahead = approach(roads, here, view)
    last = network.lanes[ahead.lanes[-1]]
    others = () if last.internal else network.edge_lanes(last.edge)
    if ahead.distance > view or not any(network.links_from(lane.id) for lane in others):
        return Refusal("there is no junction in view ahead")
    for way in approaches(roads, here, view):
        link = toward(roads, way.lanes[-1], direction, goal)
        if link is not None:
            return link
    words = "straight on" if direction == "straight" else f"to the {direction}"
    if any(toward(roads, lane.id, direction, goal) for lane in others):
        return Refusal(f"its lane does not lead {words}")
    return Refusal(f"there is no road {words}")


def onward(
    roads: Roads, lanes: tuple[str, ...], reach: float, goal: EgoGoal | None = None
) -> tuple[str, ...]:
    """Extend connected lanes to `reach` [m] in all, as far as the road goes.

    The way goes straight on where that is possible; with a goal, it leads there.
    """
    network = roads.network
    row = [*lanes, *rest_of(network, lanes[-1])]
    total = sum(network.lanes[lane].length for lane in row)
    while total < reach:
        link = _next(roads, row[-1], goal)
        if link is None:
            break
        row += [*link.via, link.to_lane]
        total += sum(network.lanes[lane].length for lane in row[-1 - len(link.via) :])
    return tuple(row)


def rest_of(network: Network, lane: str) -> tuple[str, ...]:
    """Return the lanes from an internal lane to the end of its link; none for any other."""
    link = network.link_via(lane)
    return () if link is None else (*link.via[link.via.index(lane) + 1 :], link.to_lane)


def _next(roads: Roads, lane: str, goal: EgoGoal | None) -> Link | None:
    leads = lane_end(roads, lane).leads
    if not leads:
        return None
    there = goal is not None and roads.network.lanes[lane].edge == goal.edge

    def cost(lead: Lead) -> tuple[float, bool, bool]:
        by = _length_by(roads, lead, None if there else goal)
        return *by, lead.direction != "straight"

    return min(leads, key=cost).link


def _lane_end(network: Network, lane: str) -> LaneEnd:
    links = network.links_from(lane)
    if network.lanes[lane].internal:
        return LaneEnd((), None, False)
    edge = network.lanes[lane].edge
    ring = network.roundabout(edge)
    main = _main(network, links)
    leads = tuple(_lead(network, link, ring, main) for link in links)
    every = [link for other in network.edge_lanes(edge) for link in network.links_from(other.id)]
    return LaneEnd(leads, _joint(network, links, every, ring), not links and bool(every))


def _lead(
    network: Network, link: Link, ring: frozenset[str] | None, main: tuple[str, float]
) -> Lead:
    edge = network.lanes[link.to_lane].edge
    around = link.direction == "turnaround"
    direction = link.direction
    if ring is not None:
        direction = "straight" if edge in ring else way_out(network, ring)
    elif around:
        direction = "left" if bearing(network, link) > 0.0 else "right"
    elif direction == "straight" and edge != main[0]:
        direction = "left" if bearing(network, link) > main[1] else "right"
    return Lead(link, direction, around)


def _joint(
    network: Network, links: tuple[Link, ...], every: list[Link], ring: frozenset[str] | None
) -> Link | None:
    """Return the only way on, where it is no turn at a junction and leads into no roundabout."""
    forward = [link for link in links if link.direction != "turnaround"]
    edges = {network.lanes[x.to_lane].edge for x in every if x.direction != "turnaround"}
    if len(edges) != 1 or not forward or forward[0].yields_to:
        return None
    (edge,) = edges
    if network.roundabout(edge) not in (None, ring):
        return None
    within = ring is not None and edge in ring
    leaving = ring is not None and edge not in ring
    plain = forward[0].direction == "straight" or not forward[0].foes
    return forward[0] if within or (plain and not leaving) else None


def _main(network: Network, links: tuple[Link, ...]) -> tuple[str, float]:
    """Return edge and bearing [rad] of the road that people would call straight on."""
    ahead = [(bearing(network, x), x.to_lane) for x in links if x.direction == "straight"]
    if not ahead:
        return "", 0.0
    least = min(abs(angle) for angle, _ in ahead)
    alike = [(angle, lane) for angle, lane in ahead if abs(angle) <= least + ALIKE]
    angle, lane = min(alike, key=lambda x: (-network.lanes[x[1]].speed_limit, abs(x[0])))
    return network.lanes[lane].edge, angle


def bearing(network: Network, link: Link) -> float:
    """Return the angle [rad] to the left at which a link leads, measured some way into its road."""
    before = network.lanes[link.from_lane]
    (x, y), heading = point_at(before.centreline, before.length)
    beyond = network.lanes[link.to_lane].centreline
    (to_x, to_y), _ = point_at(beyond, PREVIEW)
    return angle_between(math.atan2(to_y - y, to_x - x), heading)


def way_out(network: Network, ring: frozenset[str]) -> Direction:
    """Return the side to which a roundabout is left: where driving is on the right, the right."""
    turned = 0.0
    for lane in network.lanes.values():
        if lane.edge in ring:
            line = lane.centreline
            turned += angle_between(point_at(line, lane.length)[1], point_at(line, 0.0)[1])
    return "right" if turned > 0.0 else "left"
