"""Waypoints lie on the way that costs least, so that a plan towards one is a plan to the goal."""

from itertools import pairwise

import pytest

from planner.record.trace import EgoGoal
from planner.rollouts.waypoints import cost_left, toll, way, waypoint
from sim.roads.network import Location
from tests.planner.nets import shipped

TOWN = shipped("town")
GOAL = EgoGoal("E1_south_east", 80.0, None)


def cost_along(edges: tuple[str, ...]) -> float:
    """Add up the costs [s] of edges and of the links between them, up to the last edge."""
    network, cost = TOWN.network, 0.0
    for edge, after in pairwise(edges):
        across = [
            sum(toll(TOWN, via).cost for via in x.via)
            for lane in network.edge_lanes(edge)
            for x in network.links_from(lane.id)
            if network.lanes[x.to_lane].edge == after
        ]
        cost += toll(TOWN, network.edge_lanes(edge)[0].id).cost + min(across)
    return cost


@pytest.mark.parametrize("edge", ["west_A3", "A3_B3", "east_E3", "B2_C2", "C2_C1", "B3_C3"])
def test_the_way_to_the_goal_costs_what_is_left(edge: str) -> None:
    lane = TOWN.network.edge_lanes(edge)[0]
    edges = way(TOWN, (lane.id,), GOAL)
    assert edges[-1] == GOAL.edge
    left = cost_left(TOWN, Location(lane.id, 0.0, 0.0), GOAL)
    last = TOWN.network.edge_lanes(GOAL.edge)[0]
    assert cost_along(edges) + GOAL.position / last.speed_limit == pytest.approx(left, abs=1e-3)


def test_of_ways_that_are_as_short_the_one_with_fewer_turns_is_aimed_for() -> None:
    here = Location("west_A3_0", 50.0, 0.0)
    edges = way(TOWN, (here.lane,), GOAL)
    turns = sum(_turns(before, after) for before, after in pairwise(edges))
    aimed = waypoint(TOWN, here, GOAL)
    assert aimed.edge in edges
    assert edges[:3] == ("west_A3", "A3_B3", "B3_C3")
    assert turns < len(edges) - 2


def _turns(before: str, after: str) -> bool:
    network = TOWN.network
    found = [
        x.direction
        for lane in network.edge_lanes(before)
        for x in network.links_from(lane.id)
        if network.lanes[x.to_lane].edge == after
    ]
    return "straight" not in found
