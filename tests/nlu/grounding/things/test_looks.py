"""How well a vehicle fits the words of a description: costs by hand."""

from typing import Any

import pytest
from msgspec.structs import replace

from xavi_dialogue.domain.facts import Look
from xavi_dialogue.nlu.grounding.things.looks import (
    NEARLY,
    WRONG,
    bearing_cost,
    colour_cost,
    kind_cost,
    origin_cost,
    size_cost,
)

PLAIN = Look(3, 5.0, "car", "blue", 4.5, "ahead", 20.0, 20.0, 0.0, 8.0)


def look(**fields: Any) -> Look:
    return replace(PLAIN, **fields)


def at(ahead: float, left: float, bearing: Any = "ahead", *, oncoming: bool = False) -> Look:
    distance = (ahead**2 + left**2) ** 0.5
    return look(ahead=ahead, left=left, distance=distance, bearing=bearing, oncoming=oncoming)


def test_bounds() -> None:
    assert (WRONG, NEARLY) == (1.0, 0.3)


@pytest.mark.parametrize(
    ("wanted", "seen", "cost"),
    [
        ("car", "car", 0.0),
        ("vehicle", "bus", 0.0),
        ("bus", "vehicle", 0.2),
        ("car", "taxi", 0.1),
        ("car", "van", 0.3),
        ("car", "truck", 0.5),
        ("car", "motorcycle", 0.7),
        ("car", "bicycle", 1.0),
        ("truck", "van", 0.3),
        ("truck", "car", 1.0),
        ("van", "car", 0.6),
        ("bus", "truck", 0.6),
        ("bus", "van", 0.5),
        ("taxi", "car", 0.3),
        ("bicycle", "motorcycle", 0.3),
        ("emergency", "van", 0.7),
        ("emergency", "bus", 1.0),
    ],
)
def test_kinds(wanted: Any, seen: Any, cost: float) -> None:
    assert kind_cost(wanted, look(kind=seen)) == cost


@pytest.mark.parametrize(
    ("wanted", "seen", "cost"),
    [
        (None, "blue", 0.0),
        ("blue", "blue", 0.0),
        ("gray", "grey", 0.0),
        ("grey", "gray", 0.0),
        ("violet", "purple", 0.0),
        ("golden", "yellow", 0.4),
        ("dark", "blue", 0.0),
        ("bright", "red", 0.0),
        ("silver", "white", 0.4),
        ("orange", "red", 0.4),
        ("pink", "magenta", 0.4),
        ("red", "blue", 1.0),
        ("grey", "white", 1.0),
        ("red", None, 0.4),
        (None, None, 0.0),
    ],
)
def test_colours(wanted: str | None, seen: str | None, cost: float) -> None:
    assert colour_cost(wanted, look(colour=seen)) == cost


@pytest.mark.parametrize(
    ("kind", "length", "big", "small"),
    [
        ("car", 4.0, 0.9, 0.0),
        ("car", 4.5, 0.9, 0.2),
        ("car", 5.0, 0.9, 0.2),
        ("car", 5.1, 0.4, 0.2),
        ("car", 6.0, 0.0, 0.9),
        ("car", 7.0, 0.0, 0.9),
        ("van", 4.5, 0.4, 0.2),
        ("truck", 5.0, 0.0, 0.9),
        ("bus", 5.0, 0.0, 0.9),
        ("tram", 5.0, 0.0, 0.9),
        ("motorcycle", 4.5, 0.9, 0.0),
    ],
)
def test_sizes(kind: Any, length: float, big: float, small: float) -> None:
    seen = look(kind=kind, length=length)
    assert [size_cost(wanted, seen) for wanted in ("big", "small", None)] == [big, small, 0.0]


@pytest.mark.parametrize(
    ("wanted", "seen", "cost"),
    [
        (None, at(20.0, 0.0), 0.0),
        ("there", at(500.0, 0.0), 0.0),
        ("around", at(79.0, 0.0), 0.0),
        ("around", at(81.0, 0.0), 0.5),
        ("here", at(29.0, 0.0), 0.0),
        ("here", at(31.0, 0.0), 0.4),
        ("far", at(41.0, 0.0), 0.0),
        ("far", at(39.0, 0.0), 0.5),
        ("oncoming", at(20.0, 4.0, oncoming=True), 0.0),
        ("oncoming", at(20.0, 4.0), 1.0),
        # To one side: from 1.5 m on, better from 0.3 of the way ahead on.
        ("left", at(5.0, 1.4), 1.0),
        ("left", at(5.0, 1.6), 0.1),
        ("left", at(6.0, 1.6), 0.3),
        ("left", at(-6.0, 1.6), 0.3),
        ("left", at(50.0, 3.5, "ahead-left"), 0.0),
        ("left", at(5.0, -3.5), 1.0),
        ("right", at(5.0, -1.6), 0.1),
        ("right", at(5.0, 3.5), 1.0),
        # Straight ahead within 2 m; aside up to 45 degrees, and beyond.
        ("ahead", at(20.0, 1.9, "ahead-left"), 0.0),
        ("ahead", at(20.0, 2.1, "ahead-left"), 0.2),
        ("ahead", at(20.0, -19.0, "ahead-right"), 0.2),
        ("ahead", at(20.0, 21.0, "ahead-left"), 0.5),
        ("ahead", at(-1.0, 0.0, "behind"), 1.0),
        ("ahead", at(0.0, 3.0, "beside-left"), 1.0),
        ("ahead", at(2.0, 3.0, "beside-left"), 0.6),
        ("ahead", at(20.0, 0.0, "oncoming"), 0.2),
        ("ahead", at(20.0, 0.0, "crossing-left", oncoming=True), 0.2),
        ("behind", at(-20.0, 0.0, "behind-left"), 0.0),
        ("behind", at(-20.0, 3.0, "behind-left"), 0.2),
        ("behind", at(20.0, 0.0), 1.0),
        ("behind", at(-20.0, 0.0, "behind-left", oncoming=True), 0.3),
        ("beside", at(1.0, 3.5, "beside-left"), 0.0),
        ("beside", at(7.0, 7.0), 0.3),
        ("beside", at(-7.0, -7.0), 0.3),
        ("beside", at(9.0, 3.0), 1.0),
        ("beside", at(3.0, 9.0), 1.0),
        # Both parts of a compound have to fit.
        ("ahead-left", at(20.0, 3.0), 0.3),
        ("ahead-left", at(20.0, 7.0), 0.2),
        ("ahead-left", at(20.0, -7.0), 1.0),
        ("ahead-right", at(20.0, -7.0), 0.2),
        ("behind-left", at(-20.0, 7.0), 0.2),
        ("behind-left", at(20.0, 7.0), 1.0),
        ("beside-right", at(1.0, -3.0), 0.3),
        ("beside-right", at(1.0, 3.0), 1.0),
        ("crossing-left", at(20.0, 7.0), 0.3),
        ("crossing-left", at(20.0, -7.0), 1.0),
    ],
)
def test_bearings(wanted: Any, seen: Look, cost: float) -> None:
    assert bearing_cost(wanted, seen) == pytest.approx(cost)


def test_where_somebody_is_called_to_be_is_where_he_is() -> None:
    for bearing in ("behind-right", "crossing-left", "beside-left"):
        assert bearing_cost(bearing, at(500.0, 0.0, bearing)) == 0.0


@pytest.mark.parametrize(
    ("wanted", "looks", "cost"),
    [
        ("left", (at(20.0, 9.0, "crossing-left"), at(20.0, -9.0)), 0.0),
        ("crossing-right", (at(20.0, -9.0, "crossing-right"),), 0.0),
        ("right", (at(20.0, 9.0, "crossing-left"),), 1.0),
        ("right", (at(20.0, -4.0), at(20.0, -9.0)), 0.1),
        ("ahead", (at(20.0, 30.0, "ahead-left", oncoming=True),), 0.0),
        ("oncoming", (at(-9.0, 3.0), at(20.0, 3.0, oncoming=True)), 0.0),
        ("behind", (at(20.0, 3.0, oncoming=True), at(-9.0, 0.0)), 0.0),
        ("left", (), 1.0),
    ],
)
def test_where_somebody_came_from_is_where_he_was_at_any_time(
    wanted: Any, looks: tuple[Look, ...], cost: float
) -> None:
    assert origin_cost(wanted, looks) == pytest.approx(cost)
