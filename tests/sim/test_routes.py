"""Starts that vary with the seed."""

import xml.etree.ElementTree as ET

import pytest

from sim.routes import (
    RoutesError,
    Spawn,
    coloured_types,
    departures,
    mentioned_edges,
    parse,
    with_spawn,
)
from sim.scenario import load

SPAWN = Spawn(10.0, (5.0, 10.0))
ROOT = parse(load("s1").routes)

MIXED = ET.fromstring("""<routes>
  <vType id="cab" color="yellow"/>
  <route id="r" edges="a b"/>
  <vehicle id="v" route="r" depart="0.00" departPos="7"/>
  <trip id="t" from="a" via="b c" to="d" depart="4" color="red" type="cab"/>
  <flow id="f" from="e" to="a" period="5"/>
</routes>""")


def starts(seed: int) -> dict[str, tuple[float, float]]:
    """Place [m] and speed [m/s] by vehicle."""
    root = ET.fromstring(with_spawn(ROOT, SPAWN, seed))
    return {
        vehicle.get("id", ""): (
            float(vehicle.get("departPos", "")),
            float(vehicle.get("departSpeed", "")),
        )
        for vehicle in root.iter("vehicle")
    }


def test_starts_stay_in_their_ranges_and_fill_them() -> None:
    base = {vehicle.id: vehicle.position for vehicle in departures(ROOT)}
    drawn = [starts(seed) for seed in range(200)]
    for vehicle, place in base.items():
        assert place is not None
        shifts = [draw[vehicle][0] - place for draw in drawn]
        speeds = [draw[vehicle][1] for draw in drawn]
        assert -5.0 <= min(shifts) < -4.5
        assert 4.5 < max(shifts) <= 5.0
        assert 5.0 <= min(speeds) < 5.25
        assert 9.75 < max(speeds) <= 10.0


def test_a_seed_gives_one_file_and_vehicles_differ() -> None:
    assert with_spawn(ROOT, SPAWN, 3) == with_spawn(ROOT, SPAWN, 3)
    assert with_spawn(ROOT, SPAWN, 3) != with_spawn(ROOT, SPAWN, 4)
    assert len({speed for _, speed in starts(3).values()}) == 3


def test_drawing_leaves_the_routes_as_they_were() -> None:
    before = ET.tostring(ROOT)
    with_spawn(ROOT, SPAWN, 1)
    assert ET.tostring(ROOT) == before


def test_later_departures_do_not_vary() -> None:
    root = ET.fromstring(with_spawn(MIXED, SPAWN, 1))
    assert root.find("trip").attrib == MIXED.find("trip").attrib  # type: ignore[union-attr]
    assert root.find("vehicle").get("insertionChecks") == "none"  # type: ignore[union-attr]


def test_departures_of_vehicles_and_trips() -> None:
    vehicle, trip = departures(MIXED)
    assert (vehicle.id, vehicle.at_start, vehicle.edges) == ("v", True, ("a", "b"))
    assert (vehicle.position, vehicle.coloured) == (7.0, False)
    assert (trip.id, trip.at_start, trip.edges) == ("t", False, ("a", "b", "c", "d"))
    assert (trip.position, trip.coloured) == (None, True)
    assert coloured_types(MIXED) == {"cab"}


def test_edges_and_who_names_them_first() -> None:
    assert mentioned_edges(MIXED) == {"a": "r", "b": "r", "c": "t", "d": "t", "e": "f"}


def test_a_start_that_is_no_number_cannot_vary() -> None:
    root = ET.fromstring('<routes><vehicle id="v" depart="0" departPos="base"/></routes>')
    with pytest.raises(RoutesError, match="'v' has no departPos"):
        with_spawn(root, SPAWN, 1)
