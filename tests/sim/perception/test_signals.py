"""Traffic lights: which links they control, and what of them is seen."""

import math
from pathlib import Path

import pytest

from sim.perception.signals import BEHIND, Signals
from sim.roads.netfile import parse_network, read_network
from sim.roads.network import UNSIGNALLED, Network
from sim.scene import LightState, Signal, VehicleState
from sim.setup.scenario import load
from sim.sumo import Simulation
from tests.sim.crossroads import signalled

EAST = VehicleState((0.0, 0.0), 0.0, 10.0, 0.0, 4.8, 1.8)
A, B = Signal("t", 0), Signal("t", 1)


class Shown:
    """What a controller shows, to be set by the test."""

    def __init__(self, letters: str) -> None:
        self.letters = letters

    def __call__(self, controller: str) -> str:
        assert controller == "t"
        return self.letters


def test_a_light_that_comes_into_view_is_known_to_be_so_at_least_since_then() -> None:
    shown = Shown("rG")
    signals = Signals({A: ((50.0, 0.0),), B: ((55.0, 5.0),)}, shown)
    first, second = signals.look(3.0, EAST, 100.0)
    assert (first.signal, first.state, first.since) == (A, LightState.RED, 3.0)
    assert (second.signal, second.state) == (B, LightState.GREEN)
    assert not first.change_seen
    assert signals.look(4.0, EAST, 100.0) == (first, second)


def test_a_change_that_is_seen_has_its_time() -> None:
    shown = Shown("rr")
    signals = Signals({A: ((50.0, 0.0),), B: ((55.0, 5.0),)}, shown)
    signals.look(3.0, EAST, 100.0)
    shown.letters = "ur"
    amber, red = signals.look(3.5, EAST, 100.0)
    assert (amber.state, amber.since, amber.change_seen) == (LightState.RED_AMBER, 3.5, True)
    assert (red.since, red.change_seen) == (3.0, False)


def test_a_light_that_was_out_of_view_begins_anew() -> None:
    shown = Shown("r")
    signals = Signals({A: ((50.0, 0.0),)}, shown)
    signals.look(0.0, EAST, 100.0)
    assert signals.look(1.0, EAST, 49.0) == ()
    (again,) = signals.look(2.0, EAST, 100.0)
    assert (again.since, again.change_seen) == (2.0, False)


@pytest.mark.parametrize(
    ("place", "seen"),
    [
        ((99.0, 0.0), True),
        ((101.0, 0.0), False),
        ((0.0, 99.0), True),
        ((1.0 - BEHIND, 0.0), True),
        ((-1.0 - BEHIND, 0.0), False),
    ],
)
def test_lights_are_seen_near_and_ahead(place: tuple[float, float], seen: bool) -> None:
    assert bool(Signals({A: (place,)}, Shown("G")).look(0.0, EAST, 100.0)) is seen


@pytest.mark.parametrize("letter", "rRuyYGgsoO")
def test_every_letter_of_sumo_is_a_state(letter: str) -> None:
    (light,) = Signals({A: ((9.0, 0.0),)}, Shown(letter)).look(0.0, EAST, 100.0)
    assert light.state.value in (letter, letter.lower())


def test_a_letter_that_is_no_state_is_refused() -> None:
    with pytest.raises(ValueError, match="'x' is not a state"):
        Signals({A: ((9.0, 0.0),)}, Shown("x")).look(0.0, EAST, 100.0)


@pytest.fixture(scope="module")
def cross(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return signalled(tmp_path_factory.mktemp("cross"))


@pytest.fixture(scope="module")
def network(cross: Path) -> Network:
    return read_network(cross / "cross.net.xml")


def test_the_network_knows_what_controls_a_link(network: Network) -> None:
    inside = [way for way in network.links if way.junction == "A0"]
    assert len(inside) == 12  # three ways from each arm
    for way in inside:
        assert isinstance(way.control, Signal)
        assert way.control.controller == "A0"
        assert network.signalled(way.control) == (way,)
    assert sorted(way.control.index for way in inside if isinstance(way.control, Signal)) == list(
        range(12)
    )
    assert network.signalled(Signal("A0", 99)) == ()


def test_a_controller_far_away_is_not_asked() -> None:
    asked = []
    lines = {
        A: ((50.0, 0.0),),
        Signal("far", 0): ((500.0, 0.0),),
        Signal("far", 1): ((540.0, 0.0),),
    }
    signals = Signals(lines, lambda controller: asked.append(controller) or "GG")
    assert [light.signal for light in signals.look(0.0, EAST, 100.0)] == [A]
    near = VehicleState((440.0, 0.0), 0.0, 10.0, 0.0, 4.8, 1.8)
    assert [x.signal.index for x in signals.look(1.0, near, 100.0)] == [0, 1]
    assert asked == ["t", "far"]


def test_links_without_a_light_are_unsignalled() -> None:
    links = read_network(load("town").network).links
    assert {way.control for way in links} == {UNSIGNALLED}


def test_rail_crossings_are_known(cross: Path) -> None:
    data = (cross / "cross.net.xml").read_bytes()
    assert parse_network(data, "it").rail_crossings == frozenset()
    rail = data.replace(b'id="A0" type="traffic_light"', b'id="A0" type="rail_crossing"')
    assert parse_network(rail, "it").rail_crossings == frozenset({"A0"})


@pytest.mark.slow
def test_the_scene_shows_what_sumo_shows(cross: Path, network: Network) -> None:
    with Simulation(load(cross, 0)) as world:
        scene = world.scene()
        assert scene.lights == ()  # 130 m to go
        while scene.ego.position[0] < network.lanes["left0A0_0"].centreline[-1][0] - 30.0:
            scene = world.step(None)
            letters = world._api.trafficlight.getRedYellowGreenState("A0")
            seen = {x.signal.index: x.state.value for x in scene.lights}
            assert all(letters[index] == state for index, state in seen.items())
        assert len(seen) == 12
        ahead = next(way for way in network.links_from("left0A0_0") if way.direction == "straight")
        assert isinstance(ahead.control, Signal)
        light = scene.light(ahead.control)
        assert light is not None
        assert math.isfinite(light.since)
        assert scene.light(Signal("nowhere", 0)) is None


@pytest.mark.slow
def test_a_light_that_is_switched_off_shows_it(tmp_path: Path) -> None:
    with Simulation(load(signalled(tmp_path))) as world:
        while not world.scene().lights:
            world.step(None)
        world._api.trafficlight.setProgram("A0", "off")
        scene = world.step(None)
    assert {x.state for x in scene.lights} <= {LightState.FLASHING, LightState.OFF}
    assert all(x.change_seen for x in scene.lights)
