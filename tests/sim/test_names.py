"""What vehicles are called and what they look like."""

import pytest

from sim.names import VehicleNames
from sim.perception.appearance import colour_name, kind_of, lights


def test_the_ego_is_0_and_positive_integers_stand() -> None:
    names = VehicleNames("car", ["7", "car", "2"])
    assert [names.of(x) for x in ("car", "2", "7")] == [0, 2, 7]


def test_others_get_the_lowest_number_that_nobody_has() -> None:
    names = VehicleNames("ego", ["ego", "2", "bus", "0", "007"])
    assert [names.of(x) for x in ("bus", "0", "007", "2")] == [1, 3, 4, 2]


def test_long_numbers_are_no_names() -> None:
    names = VehicleNames("ego", ["ego", "1695568168247882", "12345", "1234"])
    assert [names.of(x) for x in ("1695568168247882", "12345", "1234")] == [1, 2, 1234]


def test_an_id_whose_number_was_given_away_gets_another() -> None:
    names = VehicleNames("ego", [])
    assert [names.of(x) for x in ("flow.0", "1", "2", "flow.1")] == [1, 2, 3, 4]


def test_a_name_is_kept() -> None:
    names = VehicleNames("ego", ["ego", "a", "b"])
    assert (names.of("b"), names.of("a"), names.of("b")) == (1, 2, 1)


def test_vehicles_that_appear_together_are_named_in_file_order() -> None:
    names = VehicleNames("ego", ["ego", "z", "a"])
    assert names.in_order(["flow.1", "a", "z", "flow.0"]) == ["z", "a", "flow.0", "flow.1"]


@pytest.mark.parametrize(
    ("rgb", "word"),
    [
        ((255, 255, 255), "white"),
        ((250, 10, 5), "red"),
        ((0, 0, 200), "blue"),
        ((20, 20, 20), "black"),
        ((255, 255, 0), "yellow"),
        ((0, 255, 0), "green"),
        ((120, 130, 125), "grey"),
    ],
)
def test_colours(rgb: tuple[int, int, int], word: str) -> None:
    assert colour_name(*rgb) == word


def test_kinds() -> None:
    kinds = [
        kind_of(x) for x in ("passenger", "taxi", "trailer", "coach", "moped", "bicycle", "tram")
    ]
    assert kinds == ["car", "car", "truck", "bus", "motorcycle", "bicycle", "tram"]
    assert [kind_of("passenger", x) for x in ("passenger", "delivery")] == ["car", "van"]
    assert [kind_of(x, "delivery") for x in ("custom1", "bus")] == ["van", "bus"]
    assert {kind_of(x) for x in ("rail", "ship")} == {"vehicle"}


@pytest.mark.parametrize(
    ("bits", "shown"),
    [
        (0b0000, ()),
        (0b0001, ("right",)),
        (0b1010, ("left", "brake")),
        (0b0100, ("left", "right")),
        (0b10000, ()),
    ],
)
def test_lights(bits: int, shown: tuple[str, ...]) -> None:
    assert lights(bits) == shown
