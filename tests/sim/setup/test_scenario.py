"""Scenario folders: what is read, and what a wrong folder is told."""

import subprocess
import sys
from pathlib import Path

import pytest

from sim.roads import netconvert
from sim.roads.netfile import read_network
from sim.setup.scenario import (
    Goal,
    NeedsMaps,
    ScenarioInvalid,
    ScenarioNotFound,
    available,
    descriptions,
    load,
)
from sim.setup.spawning import Spawn
from tests.sim.folders import copy_of, edit


def test_shipped_scenarios_load_by_name() -> None:
    assert {"s1", "s2"} <= set(available())
    for name in available():
        assert load(name).name == name


def test_scenarios_are_described_without_netconvert(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(sys, "executable", str(tmp_path / "python"))
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    found = descriptions()
    assert tuple(found) == available()
    assert found["s1"] == load("s1").description


def test_what_is_read() -> None:
    scenario = load("s1")
    assert scenario.goal == Goal("main_out", 100.0, None)
    assert scenario.spawn == Spawn(10.0, (5.0, 10.0))
    assert (scenario.step, scenario.duration, scenario.view_radius) == (0.1, 60.0, 150.0)
    assert load("s2").view_radius == 100.0  # the default
    assert (scenario.seed, scenario.ego, scenario.priority) == (0, "ego", {})
    assert scenario.network.is_file()
    assert scenario.routes.is_file()


def test_a_folder_anywhere_loads_by_its_path(tmp_path: Path) -> None:
    folder = copy_of("s1", tmp_path)
    edit(folder / "scenario.toml", "duration = 60.0", "duration = 9\nseed = 7")
    edit(folder / "scenario.toml", "view_radius = 150.0", "view_radius = 50")
    edit(folder / "scenario.toml", "position = 100.0", "position = 40\nlane = 1")
    for path in (folder, str(folder)):
        scenario = load(path)
        assert (scenario.duration, scenario.view_radius, scenario.seed) == (9.0, 50.0, 7)
        assert scenario.goal == Goal("main_out", 40.0, 1)


def test_without_spawn_starts_do_not_vary(tmp_path: Path) -> None:
    folder = copy_of("s1", tmp_path)
    without_spawn(folder)
    assert load(folder).spawn is None


def test_an_unknown_name_lists_those_that_exist() -> None:
    with pytest.raises(ScenarioNotFound, match=r"no scenario 's99'.*s1, s2"):
        load("s99")


def test_a_folder_without_configuration_is_not_found(tmp_path: Path) -> None:
    with pytest.raises(ScenarioNotFound, match=r"scenario\.toml"):
        load(tmp_path)


TOML = [
    ("step = 0.1", "stepp = 0.1", "stepp: unknown key", "known are name"),
    ("step = 0.1", "", "step: missing", "add it: a number"),
    ("step = 0.1", 'step = "0.1"', "step: '0.1' is not a number", "unquoted"),
    ("step = 0.1", "step = true", "step: True is not a number", "finite"),
    ("step = 0.1", "step = nan", "step: nan is not a number", "finite"),
    ("step = 0.1", "step = 0", "step: 0 is out of range", "at least 0.001, at most 1"),
    ("step = 0.1", "step = 0.1\nseed = 1.5", "seed: 1.5 is not a whole number", "from 0"),
    ("step = 0.1", "step = 0.1\nseed = -1", "seed: -1 is not a whole number", "from 0"),
    ("step = 0.1", "step = ", "not TOML", "correct the syntax"),
    ("duration = 60.0", "duration = -1.0", "duration: -1 is out of range", "at least"),
    ('name = "s1"', "name = 1", "name: 1 is not text", "in quotes"),
    ('name = "s1"', 'name = " "', "name: ' ' is not text", "in quotes"),
    ('"s1.net.xml"', '"s9.net.xml"', "network: there is no file", "correct the name"),
    ('"s1.rou.xml"', '"s9.rou.xml"', "routes: there is no file", "correct the name"),
    ('"s1.net.xml"', '"s1.rou.xml"', "network: ", "not a SUMO net"),
    ('ego = "ego"', 'ego = "me"', "ego: s1.rou.xml has no vehicle 'me'", "one of 1, 2, ego"),
    ("[goal]", "[target]", "target: unknown key", "known are"),
    ('edge = "main_out"', "", "goal.edge: missing", "add it"),
    ('"main_out"', '"nowhere"', "goal.edge: there is no edge 'nowhere'", "choose one of back_in"),
    ('"main_out"', '"back_in"', "goal.edge: 'back_in' cannot be reached", "choose one of exit_n"),
    ("position = 100.0", "position = 1e3", "goal.position: 1000 m is beyond", "at most 140.5"),
    ("position = 100.0", "position = -1", "goal.position: -1 is out of range", "at least 0"),
    ("position = 100.0", "position = 1\nlane = 2", "'main_out' has no lane 2", "one of 0, 1"),
    ("position = 100.0", "position = 1\nline = 2", "goal.line: unknown key", "edge, position"),
    ("longitudinal = 10.0", "", "spawn.longitudinal: missing", "add it"),
    ("[5.0, 10.0]", "5.0", "spawn.speed: 5.0 is not a range", "[least, greatest]"),
    ("[5.0, 10.0]", "[10, 5]", "spawn.speed: [10, 5] is not a range", "lower one first"),
    ("[5.0, 10.0]", '["a", 5]', "spawn.speed: 'a' is not a number", "finite"),
    ("step = 0.1", "step = 0.1\npriority = 3", "priority: 3 is not a table", "as [priority]"),
    ("[spawn]", "[priority]\nmain_in = 3\n[spawn]", "priority: only for OpenDRIVE", "remove it"),
]


@pytest.mark.parametrize(("old", "new", "problem", "remedy"), TOML)
def test_a_broken_key(tmp_path: Path, old: str, new: str, problem: str, remedy: str) -> None:
    folder = copy_of("s1", tmp_path)
    edit(folder / "scenario.toml", old, new)
    with pytest.raises(ScenarioInvalid) as caught:
        load(folder)
    message = str(caught.value)
    assert message.startswith(str(folder / "scenario.toml"))
    assert problem in message
    assert remedy in message


ROUTES = [
    ("main_in exit_s", "main_in exit_x", "route of '1': there is no edge 'exit_x'", "choose one"),
    ('departPos="82"', 'departPos="base"', "vehicle '1': departPos is not a number", "0 to 190.5"),
    ('departPos="82"', 'departPos="191"', "vehicle '1': departPos 191 is beyond", "190.5"),
    ('id="ego" type="car" depart="0"', 'id="ego" depart="3"', "the ego departs late", 'depart="0"'),
    ('<route edges="main_in exit_s"/>', "", "vehicle '1': it has no route", "give it <route"),
    (
        'type="turning" depart',
        'type="nix" depart',
        "vehicle '1': there is no type 'nix'",
        "car, pat",
    ),
    ("main_in exit_s", "main_in back_out", "route of '1': no way leads", "one of exit_n, exit_s"),
    ('vehicle id="1"', "vehicle", "a <vehicle> has no id", "correct the route file"),
    ("</routes>", "", "not an XML file", "correct the route file"),
]


@pytest.mark.parametrize(("old", "new", "problem", "remedy"), ROUTES)
def test_a_broken_route_file(tmp_path: Path, old: str, new: str, problem: str, remedy: str) -> None:
    folder = copy_of("s1", tmp_path)
    edit(folder / "s1.rou.xml", old, new)
    with pytest.raises(ScenarioInvalid) as caught:
        load(folder)
    message = str(caught.value)
    assert message.startswith(str(folder / "s1.rou.xml"))
    assert problem in message
    assert remedy in message


def without_spawn(folder: Path) -> None:
    text = (folder / "scenario.toml").read_text()
    (folder / "scenario.toml").write_text(text[: text.index("[spawn]")])


@pytest.mark.parametrize(("place", "problem"), [("195", "beyond"), ("-195", "beyond")])
def test_a_start_beyond_the_edge(tmp_path: Path, place: str, problem: str) -> None:
    """SUMO would put the vehicle somewhere else and say nothing."""
    folder = copy_of("s1", tmp_path)
    without_spawn(folder)
    edit(folder / "s1.rou.xml", 'departPos="82"', f'departPos="{place}"')
    with pytest.raises(ScenarioInvalid, match=rf"'1': departPos {place} is {problem} the end of"):
        load(folder)


@pytest.mark.parametrize("place", ["base", "-5", "190.5"])
def test_a_start_that_does_not_vary_may_be_written_freely(tmp_path: Path, place: str) -> None:
    folder = copy_of("s1", tmp_path)
    without_spawn(folder)
    edit(folder / "s1.rou.xml", 'departPos="82"', f'departPos="{place}"')
    assert load(folder).name == "s1"


def test_the_edges_of_a_trip_need_not_follow_one_another(tmp_path: Path) -> None:
    folder = copy_of("s3", tmp_path)
    trip = '<trip id="8" type="car" depart="4" from="north_in" to="east_out"/></routes>'
    edit(folder / "s3.rou.xml", "</routes>", trip)
    assert load(folder).name == "s3"


@pytest.fixture
def opendrive(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A scenario folder whose network is an OpenDRIVE map of s2."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    folder = copy_of("s2", tmp_path)
    program = Path(sys.executable).parent / "netconvert"
    exported = ("-s", folder / "s2.net.xml", "--opendrive-output", folder / "s2.xodr")
    subprocess.run([program, *exported], check=True, capture_output=True)
    edit(folder / "scenario.toml", "s2.net.xml", "s2.xodr")
    return folder


def opendrive_routes(folder: Path) -> None:
    """Routes and goal by the names that a converted map has: road numbers, signed."""
    network = read_network(netconvert.opendrive_net(folder / "s2.xodr", {}))
    edge = next(x.edge for x in network.lanes.values() if not x.internal and x.length > 80.0)
    (folder / "s2.rou.xml").write_text(
        f'<routes><vehicle id="ego" depart="0" departPos="20"><route edges="{edge}"/></vehicle>'
        "</routes>"
    )
    edit(folder / "scenario.toml", '"east_out"', f'"{edge}"')


def test_an_opendrive_map_is_converted_once(opendrive: Path) -> None:
    opendrive_routes(opendrive)
    scenario = load(opendrive)
    assert scenario.network.name.endswith(".net.xml")
    before = scenario.network.stat().st_mtime_ns
    assert load(opendrive).network.stat().st_mtime_ns == before
    assert len(read_network(scenario.network).links) == 12


def test_priority_changes_the_right_of_way_of_a_converted_map(opendrive: Path) -> None:
    opendrive_routes(opendrive)
    plain = read_network(load(opendrive).network)
    free = next(way for way in plain.links if way.direction == "straight" and not way.yields_to)
    edges = [x.edge for x in plain.lanes.values() if not x.internal]
    minor = plain.lanes[free.from_lane].edge
    rows = "".join(f'"{x}" = {1 if x == minor else 9}\n' for x in dict.fromkeys(edges))
    file = opendrive / "scenario.toml"
    file.write_text(f"{file.read_text()}\n[priority]\n{rows}")
    network = read_network(load(opendrive).network)
    same = next(way for way in network.links if way.from_lane == free.from_lane)
    assert network.hash != plain.hash
    assert any(way.yields_to for way in network.links_from(same.from_lane))


def test_a_priority_for_no_edge_is_refused(opendrive: Path) -> None:
    opendrive_routes(opendrive)
    file = opendrive / "scenario.toml"
    file.write_text(f"{file.read_text()}\n[priority]\nnowhere = 3\n")
    with pytest.raises(ScenarioInvalid, match=r"toml: priority\.nowhere: there is no such edge"):
        load(opendrive)


def test_without_netconvert_the_error_names_the_extra(
    opendrive: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(sys, "executable", str(tmp_path / "python"))
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(NeedsMaps, match=r"network: .*extra `maps`"):
        load(opendrive)


def of_the_package(folder: Path, file: str) -> Path:
    """A folder about a configuration of the package eclipse-sumo."""
    (folder / "scenario.toml").write_text(
        f'name = "mine"\ndescription = "Mine."\nconfiguration = "sumo:{file}"\nego = "a"\n'
    )
    return folder


def test_without_the_package_a_configuration_of_it_names_the_package(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    problem = "tools/a.sumocfg is part of eclipse-sumo, which is not installed"
    with pytest.raises(NeedsMaps, match=rf"configuration: {problem}; run: pip install -U eclipse"):
        load(of_the_package(tmp_path, "tools/a.sumocfg"))


def test_a_configuration_that_the_package_lacks(tmp_path: Path) -> None:
    with pytest.raises(ScenarioInvalid, match=r"installed has no tools/a\.sumocfg; run: pip"):
        load(of_the_package(tmp_path, "tools/a.sumocfg"))


def test_a_map_that_netconvert_refuses(opendrive: Path) -> None:
    (opendrive / "s2.xodr").write_text("<nothing")
    with pytest.raises(ScenarioInvalid, match="network: cannot convert"):
        load(opendrive)


def test_a_goal_behind_the_ego_is_told(tmp_path: Path) -> None:
    folder = copy_of("s1", tmp_path)
    edit(folder / "scenario.toml", 'edge = "main_out"', 'edge = "main_in"')
    edit(folder / "scenario.toml", "position = 100.0", "position = 20")
    with pytest.raises(ScenarioInvalid, match=r"goal\.position: 20 m lies behind the ego"):
        load(folder)


def test_a_car_that_sees_next_to_nothing_is_not_driven(tmp_path: Path) -> None:
    folder = copy_of("s1", tmp_path)
    edit(folder / "scenario.toml", "view_radius = 150.0", "view_radius = 1")
    with pytest.raises(ScenarioInvalid, match="view_radius"):
        load(folder)
