"""Goals that another vehicle may have: the exits in view, and stopping."""

import math
from dataclasses import dataclass
from typing import TypeAlias

from planner.manoeuvres.plans import Situation
from planner.record.trace import Action, EgoGoal
from planner.roads.roundabouts import Roundabout, roundabout_ahead
from planner.roads.routes import Approach, approach, direction_of, lane_end
from planner.roads.trajectory import Roads
from sim.roads.network import Direction, Link, Location, Network, angle_between, point_at, project

BEYOND = 4.0  # [m] distance of a goal from the start of its exit
STOP_PRIOR = 0.01  # of stopping; the exits share the rest equally


@dataclass(frozen=True, slots=True)
class Goal:
    """One goal of another vehicle."""

    kind: Action  # the macro action that ends at it
    place: str  # in words
    target: EgoGoal | None  # None for stopping
    prior: float


LATER = 20.0  # [m] distance from a roundabout at which the bearing of a road is taken
OPPOSITE = 2.6  # [rad] least angle between the entry road and an exit that leads back
BACK = "the way back"
ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth")

PLACES: dict[Action, str] = {
    "exit-left": "the road to the left",
    "exit-right": "the road to the right",
    "exit-straight": "the road straight on",
    "continue": "the road straight on",
    "stop": "where it comes to a stop",
}
ASIDE = 40.0  # [m] distance from a fork at which the side of a branch is taken
#: Places of roads that branch off beside the one that goes on, where neither is a turn.
BRANCHES: dict[str, str] = {"left": "the exit on the left", "right": "the exit on the right"}


#: The macro action that ends at an exit, the place in words, and where it is.
_Exit: TypeAlias = tuple[Action, str, EgoGoal]


def goals_in_view(roads: Roads, starts: tuple[Situation, ...], view: float) -> tuple[Goal, ...]:
    """Return the goals of a vehicle that may be on one of several lanes, stopping last.

    The goals are the roads that leave the next junction, or the exits of a roundabout. If none is
    in view, the goal is to go on.
    """
    found: dict[str, _Exit] = {}
    for here in starts:
        for way in _exits(roads, here.location, view):
            found.setdefault(way[2].edge, way)
    if not found:
        return (Goal("stop", PLACES["stop"], None, 1.0),)
    share = (1.0 - STOP_PRIOR) / len(found)
    exits = tuple(Goal(kind, place, target, share) for kind, place, target in found.values())
    return (*exits, Goal("stop", PLACES["stop"], None, STOP_PRIOR))


def _exits(roads: Roads, here: Location, view: float) -> list[_Exit]:
    ring = roundabout_ahead(roads, here, view)
    if isinstance(ring, Roundabout):
        return _ring_exits(roads, here, ring)
    network = roads.network
    inside = network.link_via(here.lane)
    if inside is not None and lane_end(roads, inside.from_lane).joint != inside:
        return [_exit(roads, inside, direction_of(roads, inside))]
    ahead = approach(roads, here, view)
    last = network.lanes[ahead.lanes[-1]]
    if all(network.lanes[lane].internal for lane in ahead.lanes):
        return []  # on a lane through a junction that no link for cars uses
    lanes = () if last.internal else network.edge_lanes(last.edge)
    leads = [lead for lane in lanes for lead in lane_end(roads, lane.id).leads]
    if ahead.distance > view or not leads:
        return [_farther(roads, here, ahead, view)]
    forward = [lead for lead in leads if not lead.turnaround] or leads
    off = _branches(network, [lead.link for lead in forward if lead.direction == "straight"])
    found = [_exit(roads, lead.link, lead.direction) for lead in forward]
    return [(kind, off.get(target.edge, place), target) for kind, place, target in found]


def _branches(network: Network, links: list[Link]) -> dict[str, str]:
    """Return names of roads that branch off if several lead straight on: all but the widest."""
    edges = sorted({network.lanes[link.to_lane].edge for link in links})
    if len(edges) < 2:
        return {}
    edges.sort(key=lambda edge: -len(network.edge_lanes(edge)))
    main = network.edge_lanes(edges[0])[0].centreline
    found: dict[str, str] = {}
    for edge in edges[1:]:
        there, _ = point_at(network.edge_lanes(edge)[0].centreline, ASIDE)
        _, aside, _ = project(main, there)
        found[edge] = BRANCHES["left" if aside > 0.0 else "right"]
    return found


def _exit(roads: Roads, link: Link, direction: Direction) -> _Exit:
    kind: Action = "continue"
    if direction == "left":
        kind = "exit-left"
    elif direction == "right":
        kind = "exit-right"
    elif link.yields_to:
        kind = "exit-straight"
    place = BACK if link.direction == "turnaround" else PLACES[kind]
    return kind, place, _beyond(roads, link)


def _beyond(roads: Roads, link: Link) -> EgoGoal:
    target = roads.network.lanes[link.to_lane]
    return EgoGoal(target.edge, min(BEYOND, 0.5 * target.length), None)


def _farther(roads: Roads, here: Location, ahead: Approach, view: float) -> _Exit:
    """Return a goal farther along the road: at the end of the view, or of the known lanes."""
    rest = view + here.offset
    for name in ahead.lanes:
        lane = roads.network.lanes[name]
        if not lane.internal:
            edge, position = lane.edge, min(lane.length - 1.0, rest)
        if rest <= lane.length:
            break
        rest -= lane.length
    if edge == roads.network.lanes[here.lane].edge:
        position = max(position, here.offset)
    return "continue", PLACES["continue"], EgoGoal(edge, max(position, 0.0), None)


def _ring_exits(roads: Roads, here: Location, ring: Roundabout) -> list[_Exit]:
    """Return all exits of a roundabout except for the one that leads back."""
    kind: Action = "exit-right" if ring.side == "right" else "exit-left"
    found = []
    for number, way in enumerate(ring.exits[: len(ORDINALS)]):
        which = "next" if number == 0 and ring.entry is None else ORDINALS[number]
        for link in way.out:
            if ring.entry is None or not _leads_back(roads.network, ring.entry, link):
                found.append((kind, f"the {which} exit of the roundabout", _beyond(roads, link)))
    return found


def _leads_back(network: Network, entry: Link, out: Link) -> bool:
    """Check whether an exit leads back to where the entry came from."""
    before, beyond = network.lanes[entry.from_lane], network.lanes[out.to_lane]
    _, towards = point_at(before.centreline, before.length - LATER)
    (x, y), away = point_at(beyond.centreline, LATER)
    _, aside, _ = project(before.centreline, (x, y))
    return abs(aside) < LATER and abs(angle_between(towards, away)) > OPPOSITE


def stopping_time(distance: float, speed: float, limit: float, up: float, down: float) -> float:
    """Return the shortest time [s] to come to rest after a distance [m].

    Args:
        distance: [m]
        speed: [m/s] at the start.
        limit: [m/s] highest speed.
        up, down: [m/s2] acceleration and braking.
    """
    peak = math.sqrt(max((2.0 * distance * up * down + down * speed**2) / (up + down), 0.0))
    peak = max(min(peak, limit), 1e-3)
    if peak < speed:
        return 2.0 * distance / max(speed, 1e-3)
    used = (peak**2 - speed**2) / (2.0 * up) + peak**2 / (2.0 * down)
    return (peak - speed) / up + peak / down + max(distance - used, 0.0) / peak
