"""Distances, gaps and closest approach, against plain sampling of outlines."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sim.boxes import corners, overlap
from sim.scene import VehicleState
from tests.explain.facts.scenes import Actor, made, recorded, shifted, straight
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.explain.facts import bodies
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.facts.world import World

STEPS = 40


def outline(state: VehicleState) -> list[tuple[float, float]]:
    """Points all along the edges of a vehicle."""
    four = corners(state)
    return [
        (a[0] + (b[0] - a[0]) * k / STEPS, a[1] + (b[1] - a[1]) * k / STEPS)
        for a, b in zip(four, (*four[1:], four[0]), strict=True)
        for k in range(STEPS)
    ]


def sampled(a: VehicleState, b: VehicleState) -> float:
    """The distance of two bodies by points on their outlines."""
    if overlap(a, b):
        return 0.0
    return min(math.dist(p, q) for p in outline(a) for q in outline(b))


def vehicle(x: float, y: float, heading: float, speed: float = 0.0) -> VehicleState:
    return VehicleState((x, y), heading, speed, 0.0, 4.8, 1.8)


@settings(max_examples=60, deadline=None)
@given(st.floats(-15.0, 15.0), st.floats(-15.0, 15.0), st.floats(-3.1, 3.1), st.floats(-3.1, 3.1))
def test_distance_of_bodies(x: float, y: float, one: float, other: float) -> None:
    a, b = vehicle(0.0, 0.0, one), vehicle(x, y, other)
    assert bodies.distance(a, b) == pytest.approx(sampled(a, b), abs=0.08)
    assert bodies.distance(a, b) == pytest.approx(bodies.distance(b, a), abs=1e-9)
    assert bodies.at_least(a, b) <= bodies.distance(a, b) + 1e-9


def test_time_to_touch_head_on() -> None:
    a, b = vehicle(0.0, 0.0, 0.0, 10.0), vehicle(50.0, 0.0, math.pi, 10.0)
    assert bodies.time_to_touch(a, b) == pytest.approx(2.5, abs=0.11)
    assert bodies.time_to_touch(a, vehicle(50.0, 5.0, math.pi, 10.0)) is None


@pytest.mark.parametrize("name", ["s1-0", "s2-0", "s3-0"])
def test_closest_approach_is_that_of_all_samples(name: str) -> None:
    ride = recorded(name)
    world, states = World(ride), States(ride)
    for other in ride.vehicles:
        found = world.extreme("distance", Ego(), "lowest", 0.0, ride.now, Vehicle(other))
        times = [t for t in ride.motion(other).time if states.visible(other, t)]
        pairs = [(states.state(0, t), states.state(other, t)) for t in times]
        wanted = min(sampled(a, b) for a, b in pairs if a is not None and b is not None)
        assert found.value is not None
        assert found.value <= wanted + 0.01  # between samples it may be less
        assert found.value >= wanted - 1.5
        at = world.measure("distance", Ego(), found.time, Vehicle(other))
        assert at.value == pytest.approx(found.value, abs=0.02)


def test_gap_headway_and_time_to_collision_on_a_straight_lane() -> None:
    ride = made({0: Actor(straight(0.0, 0.0, 12.0)), 1: Actor(straight(50.0, 0.0, 10.0))}, 6.0)
    world = World(ride)
    for time in (2.0, 4.0, 6.0):
        gap = 50.0 - 4.8 - 2.0 * time
        assert world.measure("gap", Ego(), time).value == pytest.approx(gap, abs=0.1)
        assert world.measure("gap", Vehicle(1), time).value == pytest.approx(gap, abs=0.1)
        assert world.measure("headway", Ego(), time, Vehicle(1)).value == pytest.approx(
            gap / 12.0, abs=0.02
        )
        collision = world.measure("time-to-collision", Ego(), time, Vehicle(1))
        assert collision.value == pytest.approx(gap / 2.0, abs=0.1)


def test_who_is_in_the_next_lane_has_no_gap_but_a_distance() -> None:
    ride = made({0: Actor(straight(0.0, 0.0, 12.0)), 1: Actor(straight(20.0, 3.5, 12.0))}, 4.0)
    world = World(ride)
    assert world.measure("gap", Ego(), 4.0, Vehicle(1)).gap == "not-applicable"
    assert world.measure("distance", Ego(), 4.0, Vehicle(1)).value == pytest.approx(
        math.hypot(15.2, 1.7), abs=0.02
    )
    assert world.measure("time-to-collision", Ego(), 4.0, Vehicle(1)).gap == "not-applicable"


def test_the_gap_follows_the_way_round_a_bend() -> None:
    def around(shift: float) -> "Actor":
        def pose(t: float) -> tuple[float, float, float, float]:
            angle = (10.0 * t + shift) / 40.0
            return 40.0 * math.sin(angle), 40.0 * (1.0 - math.cos(angle)), angle, 10.0

        return Actor(pose)

    world = World(made({0: around(0.0), 1: around(30.0)}, 6.0))
    found = world.measure("gap", Ego(), 6.0, Vehicle(1)).value
    assert found == pytest.approx(30.0 - 4.8, abs=0.5)


def test_looks_tell_who_is_where() -> None:
    actors = {
        0: Actor(straight(0.0, 0.0, 10.0), colour="white"),
        1: Actor(straight(30.0, 0.0, 10.0), colour="blue"),
        2: Actor(straight(-20.0, 3.5, 10.0), colour="blue"),
        3: Actor(straight(90.0, 4.0, 10.0, math.pi), kind="truck", colour="red", length=9.0),
        4: Actor(shifted(straight(1.0, -3.5, 10.0), 20.0, 24.0, 3.5), colour="green", until=3.0),
    }
    world = World(made(actors, 8.0, now=3.0))
    looks = {v: world.look(v, 3.0) for v in world.in_view(3.0)}
    assert {v: k.bearing for v, k in looks.items() if k} == {
        1: "ahead",
        2: "behind-left",
        3: "oncoming",
        4: "beside-right",
    }
    assert {v: k.alone for v, k in looks.items() if k} == {1: False, 2: False, 3: True, 4: True}
    later = World(made(actors, 8.0)).look(4, 8.0)
    assert later is not None
    assert (later.in_view, later.seen, later.bearing) == (False, 3.0, "beside-right")
    assert world.look(9, 3.0) is None
