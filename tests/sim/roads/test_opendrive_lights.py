"""Lights and signs of maps in OpenDRIVE."""

from pathlib import Path

import pytest

from planner.manoeuvres.actions import Situation, expand
from planner.motion.tracks import lanes_at
from planner.roads.routes import Refusal
from planner.roads.trajectory import Roads
from sim.roads.netfile import read_network
from sim.scene import LightState, Signal
from sim.setup.scenario import Scenario, load
from sim.sumo import Simulation
from tests.sim.folders import copy_of, edit

SIGNAL = (
    '<signals><signal id="{id}" s="{s}" t="1.6" orientation="{facing}" dynamic="{dynamic}"'
    ' zOffset="3" country="OpenDRIVE" type="{kind}" subtype="-1" value="-1"/></signals>'
)
PRIORITY = '[priority]\n"-1" = 10\n"-3" = 10\n'
EGOS = "2"  # the edge that the ego starts on, against its road


@pytest.fixture
def bend(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the shipped map's folder, and a cache of its own."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return copy_of("bend", tmp_path)


def post(folder: Path, road: str, kind: str, *, facing: str = "-", s: float = 1.0) -> None:
    """Put a signal beside a road, for those who drive along it (+) or against it (-)."""
    dynamic = "yes" if kind.startswith("1000") else "no"
    signal = SIGNAL.format(id=f"s{road}", s=s, facing=facing, kind=kind, dynamic=dynamic)
    head, mark, rest = (folder / "bend.xodr").read_text().partition(f'id="{road}" junction="-1">')
    assert mark
    changed = head + mark + rest.replace("</road>", f"{signal}</road>", 1)
    (folder / "bend.xodr").write_text(changed)


def controls(scenario: Scenario) -> dict[str, bool]:
    """Whether lights control the ways that begin at each edge into the junction."""
    network = read_network(scenario.network)
    return {
        network.lanes[link.from_lane].edge: isinstance(link.control, Signal)
        for link in network.links
    }


@pytest.mark.parametrize("priority", [True, False])
def test_a_light_of_the_map_controls_the_car(bend: Path, priority: bool) -> None:
    if not priority:
        edit(bend / "scenario.toml", PRIORITY, "")
    post(bend, EGOS, "1000001")
    scenario = load(bend)
    assert scenario.warnings == ()
    assert all(controls(scenario).values())
    roads = Roads(read_network(scenario.network))
    with Simulation(scenario) as simulation:
        scene = simulation.scene()
    ego = scene.ego
    here = lanes_at(roads, ego.position, ego.heading)[0]
    at = Situation(0.0, ego.position, ego.heading, ego.speed, 0.0, here)
    plan = expand(roads, at, "exit-straight", None, 150.0)
    if isinstance(plan, Refusal):
        plan = expand(roads, at, "continue", None, 150.0)
    assert not isinstance(plan, Refusal), plan.reason
    (ahead,) = plan.obey_lights
    light = scene.light(ahead.signal)
    assert light is not None
    assert light.state in (LightState.RED, LightState.GREEN, LightState.GREEN_YIELD)


def test_a_map_without_lights_has_none(bend: Path) -> None:
    scenario = load(bend)
    assert not any(controls(scenario).values())
    assert scenario.warnings == ()


@pytest.mark.parametrize(
    ("kind", "facing"),
    [("1000001", "+"), ("1000099", "-")],  # it faces away from the junction; unknown to netconvert
)
def test_a_light_that_holds_nobody_is_warned_of(bend: Path, kind: str, facing: str) -> None:
    post(bend, EGOS, kind, facing=facing)
    scenario = load(bend)
    assert not any(controls(scenario).values())
    (warning,) = scenario.warnings
    assert warning.startswith("traffic light 's2' of road '2' was lost")


@pytest.mark.parametrize("kind", ["205", "206"])
def test_who_has_a_sign_gives_way(bend: Path, kind: str) -> None:
    edit(bend / "scenario.toml", PRIORITY, "")
    text = (bend / "bend.xodr").read_text()
    kept = [line for line in text.splitlines() if "<priority" not in line]
    (bend / "bend.xodr").write_text("\n".join(kept))
    post(bend, "3", kind, facing="+", s=149.0)
    scenario = load(bend)
    assert scenario.warnings == ()
    assert not any(controls(scenario).values())
    links = read_network(scenario.network).links
    assert all(link.yields_to for link in links if link.from_lane == "-3_0")
    assert not any(link.yields_to for link in links if link.from_lane == "-1_0")
