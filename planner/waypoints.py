"""How far the goal is, and the place on the way to it that one decision aims for.

Rollouts cannot reach a goal on the other side of town. They aim for a place on the shortest way
to it; what comes beyond does not matter to what is decided now.
"""

import math

from planner.routes import remaining, rest_of
from planner.trace import EgoGoal
from planner.trajectory import Roads
from sim.network import Location

AIM = 20.0  # [s] of free driving ahead that a decision aims for at most
LEAST = 10.0  # [m] into a road at which a waypoint lies


def waypoint(roads: Roads, here: Location, goal: EgoGoal, aim: float = AIM) -> EgoGoal:
    """The goal; where it is farther, the place that free driving reaches in `aim` [s].

    Where no way leads to the goal, it is the goal.
    """
    network = roads.network
    ahead = [here.lane, *rest_of(network, here.lane)]
    edge, used = network.lanes[ahead[-1]].edge, -here.offset / network.lanes[here.lane].speed_limit
    for name in ahead[:-1]:
        used += network.lanes[name].length / network.lanes[name].speed_limit
    if network.lanes[ahead[-1]].internal or not math.isfinite(remaining(roads, edge, goal)):
        return goal
    passed = network.lanes[ahead[-1]].edge == goal.edge and len(ahead) == 1
    passed = passed and here.offset > goal.position
    while True:
        lane = network.edge_lanes(edge)[0]
        if edge == goal.edge and not passed:
            late = used + goal.position / lane.speed_limit >= aim
            return _at(roads, edge, (aim - used) * lane.speed_limit) if late else goal
        if used + lane.length / lane.speed_limit >= aim:
            return _at(roads, edge, (aim - used) * lane.speed_limit)
        used += lane.length / lane.speed_limit
        onward = _next_edge(roads, edge, goal)
        if onward is None:
            return goal
        edge, passed = onward, False


def time_left(roads: Roads, here: Location, goal: EgoGoal) -> float:
    """A lower bound of the time [s] to a goal: the distance at the highest speed limit.

    It is 1e6 where no way leads there.
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


def _at(roads: Roads, edge: str, position: float) -> EgoGoal:
    """A place on an edge, neither right at its beginning nor beyond its end."""
    length = roads.network.edge_lanes(edge)[0].length
    return EgoGoal(edge, round(min(max(position, LEAST), 0.9 * length), 2), None)


def _next_edge(roads: Roads, edge: str, goal: EgoGoal) -> str | None:
    """The edge after this one on the shortest way to the goal."""
    network = roads.network
    links = [x for lane in network.edge_lanes(edge) for x in network.links_from(lane.id)]
    edges = dict.fromkeys(network.lanes[link.to_lane].edge for link in links)
    return min(edges, key=lambda onward: remaining(roads, onward, goal), default=None)
