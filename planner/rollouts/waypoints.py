"""The cost of the way to the goal, and the place on it that one decision aims for.

Rollouts cannot reach a goal on the other side of town. They aim for a place on the way to it that
costs least; what comes after that place does not matter to the present decision.
"""

import heapq
import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from planner.record.trace import EgoGoal
from planner.roads.classes import CLASSES, roads_of
from planner.roads.routes import remaining, rest_of
from planner.roads.trajectory import Roads
from planner.rollouts.reward import WEIGHTS
from sim.roads.network import Link, Location

AIM = 20.0  # [s] maximum time of free driving to a waypoint
LEAST = 10.0  # [m] minimum distance of a waypoint from the start of its edge


class LaneCost(NamedTuple):
    """The time and cost of driving along a lane if nobody is in the way."""

    time: float  # [s]
    cost: float  # [s] time and the comfort cost of its bends


def toll(roads: Roads, lane: str) -> LaneCost:
    """Return the cost of driving along a lane at the speed that its limit and its bends allow."""
    found = roads.tolls.get(lane)
    if found is None:
        line = roads.line((lane,))
        pace, steps = 0.5 * (line.cap[1:] + line.cap[:-1]), np.diff(line.arc)
        bend = np.abs(0.5 * (line.curvature[1:] + line.curvature[:-1]))
        time = float(np.sum(steps / pace))
        turning = float(np.sum(np.abs(np.diff(line.cap * line.curvature))))
        bending = float(np.sum(bend * steps / pace))
        comfort = WEIGHTS["angular-acceleration"] * turning + WEIGHTS["curvature"] * bending
        found = roads.tolls[lane] = LaneCost(time, time + comfort)
    return found


def waypoint(roads: Roads, here: Location, goal: EgoGoal, aim: float = AIM) -> EgoGoal:
    """Return the goal or, if it is farther, the place that free driving reaches in `aim` [s].

    If no way leads to the goal, return the goal.
    """
    network = roads.network
    ahead = [here.lane, *rest_of(network, here.lane)]
    edge = network.lanes[ahead[-1]].edge
    if network.lanes[ahead[-1]].internal or not math.isfinite(remaining(roads, edge, goal)):
        return goal
    used = sum(toll(roads, lane).time for lane in ahead[:-1])
    used -= here.offset / network.lanes[here.lane].speed_limit
    passed = len(ahead) == 1 and edge == goal.edge and here.offset > goal.position
    while True:
        lane = network.edge_lanes(edge)[0]
        if edge == goal.edge and not passed:
            late = used + goal.position / lane.speed_limit >= aim
            return _at(roads, edge, (aim - used) * lane.speed_limit) if late else goal
        if used + toll(roads, lane.id).time >= aim:
            return _at(roads, edge, (aim - used) * lane.speed_limit)
        used += toll(roads, lane.id).time
        link = next_link(roads, edge, goal)
        if link is None:
            return goal
        used += sum(toll(roads, via).time for via in link.via)
        edge, passed = network.lanes[link.to_lane].edge, False


def way(roads: Roads, lanes: tuple[str, ...], goal: EgoGoal) -> tuple[str, ...]:
    """Return the edges along connected lanes, and from there on the cheapest way to the goal."""
    network = roads.network
    ahead = [lane for lane in lanes if not network.lanes[lane].internal]
    ahead += [lane for lane in rest_of(network, lanes[-1]) if not network.lanes[lane].internal]
    edges = list(dict.fromkeys(network.lanes[lane].edge for lane in ahead))
    if goal.edge in edges:
        return tuple(edges[: edges.index(goal.edge) + 1])
    while edges and edges[-1] != goal.edge and math.isfinite(remaining(roads, edges[-1], goal)):
        link = next_link(roads, edges[-1], goal)
        if link is None:
            break
        edges.append(network.lanes[link.to_lane].edge)
    return tuple(edges)


def time_left(roads: Roads, here: Location, goal: EgoGoal) -> float:
    """Return a lower bound of the time [s] to a goal: the distance at the highest speed limit.

    It is 1e6 if no way leads there.
    """
    network = roads.network
    lane = network.lanes[here.lane]
    if lane.edge == goal.edge:
        return max(goal.position - here.offset, 0.0) / lane.speed_limit
    ahead = rest_of(network, lane.id)
    edge = network.lanes[ahead[-1]].edge if ahead else lane.edge
    distance = 0.0 if edge == goal.edge else network.distance_to(goal.edge).get(edge)
    if distance is None:
        return 1e6
    return (max(lane.length - here.offset, 0.0) + distance + goal.position) / roads.fastest


def cost_left(roads: Roads, here: Location, goal: EgoGoal) -> float:
    """Return the cost [s] of free driving to a goal, comfort included; infinite without a way.

    Unlike `time_left`, it is an estimate and not a bound: it takes account of bends on the way.
    """
    network = roads.network
    lane = network.lanes[here.lane]
    pace = network.edge_lanes(goal.edge)[0].speed_limit
    if lane.edge == goal.edge and here.offset <= goal.position:
        return (goal.position - here.offset) / pace
    ahead = rest_of(network, lane.id)
    edge = network.lanes[ahead[-1]].edge if ahead else lane.edge
    share = max(1.0 - here.offset / lane.length, 0.0)
    cost = share * toll(roads, lane.id).cost + goal.position / pace
    cost += sum(toll(roads, name).cost for name in ahead[:-1])
    if ahead and edge == goal.edge:
        return cost
    cost += toll(roads, ahead[-1]).cost if ahead else 0.0
    return cost + _costs_to(roads, goal.edge).get(edge, math.inf)


def cost_by(
    roads: Roads, here: Location, lanes: tuple[tuple[str, float], ...], goal: EgoGoal
) -> float:
    """Return the cost [s] of free driving along some lanes, and from their end to a goal.

    Args:
        roads: the road network.
        here: where it begins, on the first of the lanes.
        lanes: connected lanes, and how much [m] is driven of each; () for the shortest way.
        goal: the goal to reach.
    """
    if not lanes:
        return cost_left(roads, here, goal)
    known = roads.network.lanes
    driven = sum(part / known[lane].length * toll(roads, lane).cost for lane, part in lanes)
    lane, part = lanes[-1]
    offset = part if len(lanes) > 1 else here.offset + part
    return driven + cost_left(roads, Location(lane, offset, 0.0), goal)


def _costs_to(roads: Roads, edge: str) -> Mapping[str, float]:
    """Return the cost [s] from the end of each edge to the start of one to which a way leads."""
    found = roads.costs.get(edge)
    if found is None:
        found = roads.costs[edge] = _search_back(roads, edge)
    return found


def survey(roads: Roads, goal: EgoGoal) -> None:
    """Compute in advance what the first decision would otherwise compute for the whole network."""
    network = roads.network
    network.distance_to(goal.edge)
    _costs_to(roads, goal.edge)
    for edge in _before(roads):
        toll(roads, network.edge_lanes(edge)[0].id)
    for kind in CLASSES:
        roads_of(roads, kind)
    for known in {roads, *roads.classes.values()}:
        known.network.locate((0.0, 0.0), 0.0)
        known.levels.prepare()


def _before(roads: Roads) -> Mapping[str, Mapping[str, float]]:
    """Return, for each edge, the edges that lead to it, with the cost [s] of the links between."""
    if roads.before is None:
        network, before = roads.network, dict[str, dict[str, float]]()
        for link in network.links:
            start, end = network.lanes[link.from_lane].edge, network.lanes[link.to_lane].edge
            across = sum(toll(roads, lane).cost for lane in link.via)
            known = before.setdefault(end, {})
            known[start] = min(known.get(start, math.inf), across)
        roads.before = before
    return roads.before


def _search_back(roads: Roads, target: str) -> dict[str, float]:
    """Return costs found by Dijkstra against the driving direction; lane changes are free."""
    network, before = roads.network, _before(roads)
    costs: dict[str, float] = {}
    frontier = [(across, start) for start, across in before.get(target, {}).items()]
    heapq.heapify(frontier)
    while frontier:
        cost, edge = heapq.heappop(frontier)
        if edge in costs:
            continue
        costs[edge] = cost
        along = cost + toll(roads, network.edge_lanes(edge)[0].id).cost
        for start, across in before.get(edge, {}).items():
            if start not in costs:
                heapq.heappush(frontier, (along + across, start))
    return costs


def _at(roads: Roads, edge: str, position: float) -> EgoGoal:
    """Return a place on an edge, neither right at its beginning nor beyond its end."""
    length = roads.network.edge_lanes(edge)[0].length
    return EgoGoal(edge, round(min(max(position, LEAST), 0.9 * length), 2), None)


def next_link(roads: Roads, edge: str, goal: EgoGoal) -> Link | None:
    """Return the link from an edge on the way to the goal that costs least.

    Costs are compared to the microsecond, since their last digits differ between processors.
    """
    network = roads.network
    links = [x for lane in network.edge_lanes(edge) for x in network.links_from(lane.id)]
    return min(links, key=lambda link: round(_cost_over(roads, link, goal), 6), default=None)


def _cost_over(roads: Roads, link: Link, goal: EgoGoal) -> float:
    """Return the cost [s] of free driving over a link and on to the start of the goal's edge."""
    network = roads.network
    across = sum(toll(roads, lane).cost for lane in link.via)
    edge = network.lanes[link.to_lane].edge
    if edge == goal.edge:
        return across
    along = toll(roads, network.edge_lanes(edge)[0].id).cost
    return across + along + _costs_to(roads, goal.edge).get(edge, math.inf)
