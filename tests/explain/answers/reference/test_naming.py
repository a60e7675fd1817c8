"""Whom a term names, and how somebody is seen at a time or first of all."""

from dataclasses import replace as changed
from typing import Any

import pytest
from msgspec.structs import replace

from tests.explain.answers.stated import NOW, decision, look, result, scene
from xavi_dialogue.domain.answers import CannotSay, NoSuchVehicle
from xavi_dialogue.domain.terms import (
    Destination,
    Ego,
    Everyone,
    Nobody,
    Passenger,
    Unknown,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.explain.answers.reference import naming
from xavi_dialogue.explain.answers.reference.asked import Asked

LOOKS = {1: look(1), 2: look(2, kind="truck"), 3: look(3, in_view=False, seen=5.0)}


def seen() -> Asked:
    """Of a car, a truck and a car that is out of view by now."""
    return scene(looks=LOOKS)


@pytest.mark.parametrize(
    ("thing", "number", "us", "nobody"),
    [
        (Vehicle(4), 4, False, False),
        (Vehicles((4, 5)), None, False, False),
        (Ego(), None, True, False),
        (Passenger(), None, True, False),
        (Nobody(), None, False, True),
        (None, None, False, False),
    ],
)
def test_a_term_is_another_vehicle_us_or_nobody(
    thing: Any, number: int | None, us: bool, nobody: bool
) -> None:
    assert naming.number(thing) == number
    assert naming.is_us(thing) is us
    assert naming.nobody(thing) is nobody


@pytest.mark.parametrize(
    ("thing", "who"),
    [
        (Ego(), (Ego(),)),
        (Passenger(), (Ego(),)),
        (Vehicle(0), (Ego(),)),
        (Vehicle(2), (Vehicle(2),)),
        (Vehicles((3, 1)), (Vehicle(3), Vehicle(1))),
        (Everyone(), (Vehicle(1), Vehicle(2))),
        (Everyone("car"), (Vehicle(1), Vehicle(2))),
        (Everyone("truck"), (Vehicle(2),)),
        (Everyone("bus"), ()),
        (Destination(), ()),
        (None, ()),
    ],
)
def test_a_term_stands_for_road_users(thing: Any, who: Any) -> None:
    assert naming.somebodies(seen(), thing, NOW) == who


@pytest.mark.parametrize("thing", [Vehicle(9), Vehicles((1, 9))])
def test_a_number_that_was_never_seen_is_refused_with_who_is_there(thing: Any) -> None:
    found = result(naming.somebodies, seen(), thing, NOW)
    assert isinstance(found, NoSuchVehicle)
    assert (found.thing, found.time) == (Vehicle(9), NOW)
    assert [one.vehicle for one in found.known] == [1, 2]


@pytest.mark.parametrize(
    ("kind", "strict", "kept"),
    [
        ("vehicle", True, (1, 2, 9)),
        ("car", False, (1, 2, 9)),
        ("car", True, (1,)),
        ("truck", False, (2,)),
    ],
)
def test_a_car_may_be_any_vehicle_unless_it_is_meant_strictly(
    kind: Any, strict: bool, kept: tuple[int, ...]
) -> None:
    assert naming.of_kind(seen(), (1, 2, 9), kind, NOW, strict=strict) == kept


def test_those_never_seen_have_no_looks() -> None:
    assert [one.vehicle for one in naming.looks(seen(), (2, 9, 3), NOW)] == [2, 3]
    assert naming.look_of(seen(), Ego(), NOW) is None
    shown = naming.look_of(seen(), Vehicle(2), 7.0)
    assert shown is not None
    assert (shown.vehicle, shown.time) == (2, 7.0)


def test_who_is_not_there_yet_is_given_as_seen_first() -> None:
    def late(time: float) -> Any:
        return replace(look(1), time=time) if time >= 4.0 else None

    asked = scene(looks={1: late}, traces=tuple(decision(t) for t in (2.0, 4.0, 6.0)))

    def when(time: float) -> float:
        found = naming.first_look(asked, 1, time)
        assert found is not None
        return found.time

    assert when(5.0) == 5.0  # it is there
    assert when(0.0) == 4.0
    assert when(2.0) == 4.0
    assert naming.first_look(changed(asked), 2, 0.0) is None


def test_words_that_name_nothing_here_are_refused() -> None:
    assert result(naming.check_sense, Unknown("the moon")) == CannotSay("perception", "the moon")
    assert naming.check_sense(Vehicle(1)) is None  # type: ignore[func-returns-value]
