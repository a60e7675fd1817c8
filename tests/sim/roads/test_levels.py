"""Which boxes that overlap on the map are on different levels."""

import math
from dataclasses import replace

import pytest

from sim.roads.bridges import apart
from sim.roads.network import Network
from sim.scene import Point, VehicleState
from tests.planner.nets import drawn, lane, link


def car(x: float, y: float, degrees: float) -> VehicleState:
    """A car with its front at a place."""
    return VehicleState((x, y), math.radians(degrees), 10.0, 0.0, 4.5, 1.8)


EAST = [(0.0, 0.0), (100.0, 0.0)]
NORTH: list[Point] = [(50.0, -50.0), (50.0, 50.0)]


def test_a_bridge_over_a_road_is_on_another_level() -> None:
    network = drawn([lane("east_0", EAST), lane("north_0", NORTH)]).network
    assert apart(network, car(51.0, 0.0, 0.0), car(50.0, 1.0, 90.0))
    assert apart(network, car(50.0, 1.0, 90.0), car(51.0, 0.0, 0.0))


def test_a_body_that_reaches_back_onto_a_bridge_is_on_it() -> None:
    parts = [
        lane("bridge_0", [(50.0, -50.0), (50.0, 1.0)]),
        lane(":joint_0_0", [(50.0, 1.0), (50.0, 1.5)], inside=True),
        lane("ramp_0", [(50.0, 1.5), (50.0, 50.0)]),
    ]
    over = [link("bridge_0", "ramp_0", via=(":joint_0_0",))]
    network = drawn([lane("east_0", EAST), *parts], over).network
    assert apart(network, car(51.0, 0.0, 0.0), car(50.0, 2.5, 90.0))


def test_people_on_the_pavement_of_a_bridge_are_on_another_level() -> None:
    pavement = replace(lane("walk_0", NORTH), permits=frozenset({"pedestrian"}))
    roads = Network({"east_0": lane("east_0", EAST)}, (), "x", other_lanes={"walk_0": pavement})
    for degrees in (90.0, -90.0):
        walker = replace(car(50.0, 0.5, degrees), length=0.3, width=0.5)
        assert apart(roads, car(51.0, 0.0, 0.0), walker)
    assert not apart(roads, car(51.0, 0.0, 0.0), replace(car(45.0, 0.0, 90.0), length=0.3))


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (car(40.0, 0.0, 0.0), car(42.0, 0.0, 0.0)),  # one behind the other
        (car(40.0, 1.0, 0.0), car(40.0, 3.0, 180.0)),  # head on
        (car(99.0, 0.0, 0.0), car(103.0, 2.0, 90.0)),  # where a road ends at another
        (car(99.0, 0.0, 45.0), car(20.0, 30.0, 90.0)),  # on no lane
    ],
)
def test_others_are_on_one_level(one: VehicleState, other: VehicleState) -> None:
    lanes = [
        lane("east_0", EAST),
        lane("west_0", [(100.0, 3.2), (0.0, 3.2)]),
        lane("across_0", [(103.0, -50.0), (103.0, 50.0)]),
    ]
    assert not apart(drawn(lanes).network, one, other)
