"""How a vehicle is seen, from the ride or in a single scene."""

import math

import pytest

from sim.scene import VehicleState
from tests.explain.facts.scenes import Actor, made, straight
from xavi_dialogue.explain.facts.looks import kind_of, look, look_in
from xavi_dialogue.explain.facts.states import States


def car(x: float, y: float, turn: float = 0.0, speed: float = 0.0, **other: object) -> VehicleState:
    state = VehicleState((x, y), math.radians(turn), speed, 0.0, 4.8, 1.8, "car", "blue")
    fields = {f: getattr(state, f) for f in VehicleState.__slots__}
    return VehicleState(**{**fields, **other})


@pytest.mark.parametrize(
    ("kind", "length", "width", "seen"),
    [
        ("truck", 4.8, 1.9, "van"),
        ("truck", 6.5, 2.16, "van"),  # SUMO's van
        ("truck", 8.5, 2.2, "van"),
        ("truck", 7.1, 2.4, "truck"),  # SUMO's lorry
        ("truck", 6.0, 2.3, "truck"),
        ("van", 4.7, 1.9, "van"),
        ("bus", 6.0, 2.1, "bus"),
        ("car", 6.0, 2.1, "car"),
        ("submarine", 6.0, 2.1, "vehicle"),
    ],
)
def test_what_a_passenger_sees_a_vehicle_to_be(
    kind: str, length: float, width: float, seen: str
) -> None:
    assert kind_of(car(0.0, 0.0, kind=kind, length=length, width=width)) == seen


@pytest.mark.parametrize(
    ("speed", "turn", "bearing"),
    [
        (5.0, 90.0, "crossing-right"),
        (0.4, 90.0, "crossing-right"),
        (0.2, 90.0, "ahead-right"),  # who stands does not come from there
        (0.2, 0.0, "ahead-right"),
        (0.2, 180.0, "oncoming"),
    ],
)
def test_who_stands_does_not_come_from_a_side(speed: float, turn: float, bearing: str) -> None:
    scene = {0: car(0.0, 0.0), 1: car(30.0, -12.0, turn, speed)}
    seen = look_in(scene, 1, 7.0)
    assert seen is not None
    assert seen.bearing == bearing


def test_a_look_in_a_scene() -> None:
    scene = {
        0: car(0.0, 0.0),
        1: car(30.0, 3.0, 0.0, 8.0, colour="red"),
        2: car(60.0, 0.0),
        3: car(-60.0, 0.0),
    }
    seen = look_in(scene, 1, 7.0)
    assert seen is not None
    assert (seen.vehicle, seen.time, seen.kind, seen.colour) == (1, 7.0, "car", "red")
    assert (seen.ahead, seen.left, seen.speed, seen.length) == (30.0, 3.0, 8.0, 4.8)
    assert seen.distance == round(math.hypot(25.2, 1.2), 2)
    assert (seen.bearing, seen.oncoming, seen.alone, seen.in_view) == (
        "ahead-left",
        False,
        True,
        True,
    )
    alike = look_in(scene, 2, 7.0)
    assert alike is not None
    assert not alike.alone
    assert look_in({0: car(0.0, 0.0), 2: car(60.0, 0.0)}, 2, 7.0).alone  # type: ignore[union-attr]
    assert look_in(scene, 0, 7.0) is None
    assert look_in(scene, 4, 7.0) is None
    assert look_in({1: car(0.0, 0.0)}, 1, 7.0) is None


def test_a_look_back_at_who_is_out_of_view() -> None:
    actors = {
        0: Actor(straight(0.0, 0.0, 10.0), colour="white"),
        1: Actor(straight(30.0, 0.0, 9.0), until=3.0),
        2: Actor(straight(-30.0, 0.0, 10.0), kind="truck"),
        3: Actor(straight(-50.0, 0.0, 10.0), since=5.0),
    }
    found = States(made(actors, 8.0))
    before, after = look(found, 1, 2.0), look(found, 1, 8.0)
    assert before is not None
    assert after is not None
    assert (before.ahead, before.in_view, before.seen, before.time) == (28.0, True, None, 2.0)
    assert (after.ahead, after.in_view, after.seen, after.time) == (27.0, False, 3.0, 3.0)
    assert before.alone  # the other blue one is a lorry, or not there yet
    late = look(found, 3, 8.0)
    assert late is not None
    assert late.alone  # the first is gone by then
    assert look(found, 0, 8.0) is None
    assert look(found, 3, 2.0) is None
