"""What of the roads the ego cannot see."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim.perception.blind import SPACING, Blind
from sim.perception.buildings import NO_WALLS, Buildings, Walls
from sim.roads.netfile import read_network
from sim.roads.network import point_at
from sim.scene import VehicleState
from sim.setup.scenario import load
from sim.sumo import Simulation

S2 = read_network(load("s2").network)
BLIND = Blind(S2)
PLACES = st.tuples(st.floats(-60.0, 60.0), st.floats(-60.0, 60.0))


def house(x: float, y: float, size: float = 20.0) -> Walls:
    outline = ((x, y), (x + size, y), (x + size, y + size), (x, y + size))
    ego = VehicleState((500.0, 500.0), 0.0, 0.0, 0.0, 4.8, 1.8)
    return Buildings([("building", outline)]).around(ego, 1000.0)


def test_nothing_is_hidden_on_an_open_field() -> None:
    assert BLIND.stretches((0.0, -50.0), 100.0, NO_WALLS) == ()


def test_a_house_at_the_corner_hides_the_road_behind_it() -> None:
    # The ego comes from the south; the house stands south-west of the junction.
    unseen = BLIND.stretches((1.75, -40.0), 120.0, house(-40.0, -40.0, 30.0))
    lanes = {stretch.lane for stretch in unseen}
    assert "west_in_0" in lanes
    assert "east_in_0" not in lanes
    assert "south_in_0" not in lanes
    west = next(stretch for stretch in unseen if stretch.lane == "west_in_0")
    length = S2.lanes["west_in_0"].length
    assert west.end < length - 2.0  # its end at the junction can be seen


@given(eye=PLACES, corner=PLACES)
def test_stretches_agree_with_looking_at_each_place(
    eye: tuple[float, float], corner: tuple[float, float]
) -> None:
    # No line leads through the very corner of the house, where rounding would decide.
    eye = (round(eye[0], 3) + 0.0003, round(eye[1], 3) + 0.0007)
    walls = house(*corner)
    unseen = BLIND.stretches(eye, 100.0, walls)
    for stretch in unseen:
        lane = S2.lanes[stretch.lane]
        assert 0.0 <= stretch.begin < stretch.end <= lane.length + 0.01
        count = max(1, round(lane.length / SPACING))
        inside = [
            lane.length * (k + 0.5) / count
            for k in range(count)
            if stretch.begin < lane.length * (k + 0.5) / count < stretch.end
        ]
        assert inside
        assert all(walls.between(eye, point_at(lane.centreline, s)[0]) for s in inside)


@given(eye=PLACES, points=st.lists(PLACES, min_size=1, max_size=8), corner=PLACES)
def test_many_places_are_told_as_each_is(
    eye: tuple[float, float],
    points: list[tuple[float, float]],
    corner: tuple[float, float],
) -> None:
    walls = house(*corner)
    rounded = [(round(x, 3) + 0.0003, round(y, 3) + 0.0007) for x, y in points]
    found = walls.hide(eye, np.array(rounded))
    assert list(found) == [walls.between(eye, point) for point in rounded]


@pytest.mark.slow
def test_a_lorry_hides_what_is_before_it() -> None:
    with Simulation(load("motorway", 0)) as world:
        scene = world.scene()
    lanes = {stretch.lane for stretch in scene.unseen}
    assert "road_0" in lanes
    lorry = next(x for x in scene.vehicles.values() if x.kind == "truck")
    own = read_network(load("motorway").network).locate(lorry.position, lorry.heading)[0]
    assert any(x.lane == own.lane and x.begin < own.offset < x.end for x in scene.unseen)


@pytest.mark.slow
def test_among_cars_everything_is_seen() -> None:
    with Simulation(load("s1", 0)) as world:
        assert world.scene().unseen == ()


def test_a_stretch_behind_a_lorry_tells_whether_a_building_hides_it_anyway() -> None:
    eye, building = (1.75, -40.0), house(-40.0, -40.0, 30.0)
    lorry = VehicleState((-2.0, -25.0), math.pi / 2.0, 0.0, 0.0, 12.0, 2.5)
    both = building.beside([lorry])
    known = {(x.lane, x.end): x.walled for x in BLIND.stretches(eye, 120.0, both, building)}
    assert set(known.values()) == {True, False}
    alone = BLIND.stretches(eye, 120.0, NO_WALLS.beside([lorry]), NO_WALLS)
    assert alone
    assert not any(stretch.walled for stretch in alone)
    bare = BLIND.stretches(eye, 120.0, both)
    assert [(x.lane, x.begin, x.end) for x in bare] == [
        (x.lane, x.begin, x.end) for x in BLIND.stretches(eye, 120.0, both, building)
    ]
