"""The goal of the ego, and checks of whether the ego can reach it.

The only error is TableError.
"""

from dataclasses import dataclass

from sim.roads.network import Network
from sim.setup.checks import edges_of, one_of
from sim.setup.routes import Departure
from sim.setup.tables import Table


@dataclass(frozen=True, slots=True)
class Goal:
    """The place to which the ego is to drive."""

    edge: str
    position: float  # [m] along the edge
    lane: int | None  # None: any lane counts


def check_goal(goal: Goal, top: Table, network: Network, ego: Departure) -> None:
    """Check that the goal lies on the roads, and that the ego can reach it from its start.

    Raises:
        TableError: one of this is not so.
    """
    edges = _edges(goal, top, network)
    start = ego.edges[0]
    if goal.edge != start and start not in network.distance_to(goal.edge):
        problem = f"{goal.edge!r} cannot be reached from {start!r}, where the ego starts"
        raise top.wrong("goal.edge", problem, one_of(_reachable(network, edges, start)))
    behind = goal.edge == start and ego.position is not None and ego.position > goal.position
    if behind and not _leads_back(network, start):
        problem = f"{goal.position:g} m lies behind the ego, which starts at {ego.position:g} m"
        raise top.wrong("goal.position", problem, "set it ahead of the start, or another edge")
    check_place(goal, top, network)


def check_place(goal: Goal, top: Table, network: Network) -> None:
    """Check that the goal lies on the roads.

    Raises:
        TableError: it does not.
    """
    _edges(goal, top, network)
    lanes = network.edge_lanes(goal.edge)
    numbers = [str(lane.index) for lane in lanes]
    if goal.lane is not None and str(goal.lane) not in numbers:
        raise top.wrong("goal.lane", f"{goal.edge!r} has no lane {goal.lane}", one_of(numbers))
    length = min(lane.length for lane in lanes)
    if goal.position > length:
        problem = f"{goal.position:g} m is beyond the end of {goal.edge!r}"
        raise top.wrong("goal.position", problem, f"it must be at most {length:g}")


def _edges(goal: Goal, top: Table, network: Network) -> set[str]:
    """Return the edges for cars, after checking that the goal's edge is one of them."""
    edges = edges_of(network)
    if goal.edge not in edges:
        raise top.wrong("goal.edge", f"there is no edge {goal.edge!r}", one_of(edges))
    return edges


def _leads_back(network: Network, edge: str) -> bool:
    """Check whether a car can come back to an edge after leaving it."""
    links = [link for lane in network.edge_lanes(edge) for link in network.links_from(lane.id)]
    return any(network.lanes[x.to_lane].edge in network.distance_to(edge) for x in links)


def _reachable(network: Network, edges: set[str], start: str) -> list[str]:
    return [edge for edge in sorted(edges) if start in network.distance_to(edge)]
