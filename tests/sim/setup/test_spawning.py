"""Starts that vary with the seed: where they may be, and how fast."""

import math
import xml.etree.ElementTree as ET
from itertools import pairwise
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim.engine import Engine
from sim.roads.netfile import read_network
from sim.roads.network import Network
from sim.setup.routes import RoutesError, departures, parse
from sim.setup.scenario import load
from sim.setup.spawning import GAP, Spawn, with_spawn

SPAWN = Spawn(10.0, (5.0, 10.0))
S1 = read_network(load("s1").network)
ROOT = parse(load("s1").routes)
FAST = Spawn(10.0, (10.0, 10.0))
WIDE = Spawn(400.0, (10.0, 10.0))
LENGTH = S1.lanes["main_in_0"].stated_length
LIMIT = S1.lanes["main_in_0"].speed_limit
SEEDS = st.integers(0, 1000)


def drawn(
    vehicles: str, spawn: Spawn, seed: int, network: Network = S1
) -> dict[str, dict[str, str]]:
    """The attributes of the vehicles in a route file of s1."""
    root = ET.fromstring(f"<routes>{vehicles}</routes>")
    varied = ET.fromstring(with_spawn(root, spawn, seed, network))
    return {x.get("id", ""): dict(x.attrib) for x in varied if x.tag == "vehicle"}


def vehicle(name: str, place: float, more: str = "", stops: str = "") -> str:
    return (
        f'<vehicle id="{name}" depart="0" departLane="0" departPos="{place}" {more}>'
        f'<route edges="main_in main_out"/>{stops}</vehicle>'
    )


def starts(seed: int) -> dict[str, tuple[float, float]]:
    """Place [m] and speed [m/s] by vehicle."""
    root = ET.fromstring(with_spawn(ROOT, SPAWN, seed, S1))
    return {
        x.get("id", ""): (float(x.get("departPos", "")), float(x.get("departSpeed", "")))
        for x in root.iter("vehicle")
    }


def test_starts_stay_in_their_ranges_and_fill_them() -> None:
    base = {one.id: one.position for one in departures(ROOT)}
    found = [starts(seed) for seed in range(200)]
    for name, place in base.items():
        assert place is not None
        shifts = [draw[name][0] - place for draw in found]
        speeds = [draw[name][1] for draw in found]
        assert -5.0 <= min(shifts) < -4.5
        assert 4.5 < max(shifts) <= 5.0
        assert 5.0 <= min(speeds) < 5.25
        assert 9.75 < max(speeds) <= 10.0


def test_a_seed_gives_one_file_and_vehicles_differ() -> None:
    assert with_spawn(ROOT, SPAWN, 3, S1) == with_spawn(ROOT, SPAWN, 3, S1)
    assert with_spawn(ROOT, SPAWN, 3, S1) != with_spawn(ROOT, SPAWN, 4, S1)
    assert len({speed for _, speed in starts(3).values()}) == 3


def test_drawing_leaves_the_routes_as_they_were() -> None:
    before = ET.tostring(ROOT)
    with_spawn(ROOT, SPAWN, 1, S1)
    assert ET.tostring(ROOT) == before


def test_later_departures_do_not_vary() -> None:
    late = '<trip id="t" from="main_in" to="main_out" depart="4"/>'
    root = ET.fromstring(f"<routes>{vehicle('v', 50.0)}{late}</routes>")
    varied = ET.fromstring(with_spawn(root, SPAWN, 1, S1))
    assert varied.find("trip").attrib == root.find("trip").attrib  # type: ignore[union-attr]
    assert varied.find("vehicle").get("insertionChecks") == "none"  # type: ignore[union-attr]


@given(seed=SEEDS)
def test_a_start_stays_on_its_lane(seed: int) -> None:
    place = float(drawn(vehicle("v", 100.0), WIDE, seed)["v"]["departPos"])
    assert 0.0 <= place <= LENGTH


@given(seed=SEEDS, places=st.lists(st.floats(0.0, 190.0), min_size=2, max_size=5))
def test_nobody_starts_in_another(seed: int, places: list[float]) -> None:
    places.sort()
    apart = [place for k, place in enumerate(places) if k == 0 or place - places[k - 1] > 8.0]
    text = "".join(vehicle(str(k), place) for k, place in enumerate(apart))
    found = drawn(text, SPAWN, seed)
    fronts = sorted(float(x["departPos"]) for x in found.values())
    assert all(b - a >= 5.0 + GAP - 1e-9 for a, b in pairwise(fronts))
    assert [float(found[str(k)]["departPos"]) for k in range(len(apart))] == fronts


def test_vehicles_on_other_lanes_do_not_matter() -> None:
    both = vehicle("a", 50.0) + vehicle("b", 52.0).replace('departLane="0"', 'departLane="1"')
    alone = drawn(vehicle("a", 50.0), SPAWN, 5)["a"]
    assert drawn(both, SPAWN, 5)["a"] == alone


@given(seed=SEEDS)
def test_a_start_lies_before_the_first_stop_and_lets_the_vehicle_stop_there(seed: int) -> None:
    stop = '<stop lane="main_in_0" startPos="55" endPos="60" duration="9"/>'
    found = drawn(vehicle("v", 50.0, 'departSpeed="8"', stop), SPAWN, seed)["v"]
    place, speed = float(found["departPos"]), float(found["departSpeed"])
    assert place <= 60.0
    assert speed <= math.sqrt(2.0 * 3.0 * (60.0 - place)) + 1e-9


@pytest.mark.parametrize(
    ("more", "stops"),
    [
        ('departSpeed="0"', ""),
        ('departSpeed="0.00"', ""),
        ('departSpeed="8"', '<stop lane="main_in_0" startPos="45" endPos="55" duration="9"/>'),
        ('departSpeed="8"', '<stop edge="main_in" endPos="-138" duration="9"/>'),
    ],
)
def test_who_stands_keeps_standing(more: str, stops: str) -> None:
    text = vehicle("v", 50.0, more, stops)
    before = ET.fromstring(text).attrib
    assert drawn(text, SPAWN, 1)["v"] == before
    # It takes nothing from what the others draw.
    assert (
        drawn(text + vehicle("w", 100.0), SPAWN, 1)["w"]
        == drawn(vehicle("w", 100.0), SPAWN, 1)["w"]
    )


def test_speeds_are_those_of_type_and_lane() -> None:
    kinds = '<vType id="slow" maxSpeed="4"/><vType id="hgv" vClass="truck"/>'
    text = kinds + vehicle("a", 50.0, 'type="slow"') + vehicle("b", 100.0, 'type="hgv"')
    found = drawn(text, Spawn(10.0, (30.0, 30.0)), 1)
    assert float(found["a"]["departSpeed"]) == 4.0
    assert float(found["b"]["departSpeed"]) == S1.lanes["main_in_0"].speed_limit


@pytest.mark.parametrize(
    ("kind", "own", "speed"),
    [
        ('speedFactor="0.8" speedDev="0"', "", 0.8 * LIMIT),
        ('speedFactor="normc(0.5,0.1,0.2,2)"', "", 0.5 * LIMIT),
        ('speedFactor="1.3" speedDev="0"', "", LIMIT),
        ('speedDev="0"', 'speedFactor="0.7"', 0.7 * LIMIT),
        ('desiredMaxSpeed="8" speedFactor="0.9" speedDev="0"', "", 0.9 * 8.0),
        ('vClass="bicycle" speedDev="0"', "", 5.55),
        ('vClass="moped" speedDev="0"', "", LIMIT),
        ("", "", LIMIT),
    ],
)
def test_speeds_are_such_as_sumo_admits(kind: str, own: str, speed: float, tmp_path: Path) -> None:
    starting = vehicle("a", 50.0, f'type="t" {own}')
    root = ET.fromstring(f'<routes><vType id="t" {kind}/>{starting}</routes>')
    file = tmp_path / "drawn.rou.xml"
    file.write_bytes(with_spawn(root, Spawn(10.0, (30.0, 30.0)), 1, S1))
    [start] = ET.parse(file).iter("vehicle")
    assert float(start.get("departSpeed", "")) == pytest.approx(speed)
    with Engine() as engine:
        engine.start(["-n", str(load("s1").network), "-r", str(file)], file)
        engine.call(engine.api.simulationStep)
        assert engine.call(engine.api.vehicle.getIDList) == ("a",)


def test_a_place_from_the_end_is_understood() -> None:
    place = float(drawn(vehicle("v", -100.0), SPAWN, 2)["v"]["departPos"])
    assert abs(place - (LENGTH - 100.0)) <= 5.0


def test_a_start_that_is_no_number_cannot_vary() -> None:
    text = vehicle("v", 0.0).replace('departPos="0.0"', 'departPos="base"')
    with pytest.raises(RoutesError, match="'v' has no departPos"):
        drawn(text, SPAWN, 1)
