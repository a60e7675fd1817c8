"""SUMO configurations as scenarios: all that SUMO loads, and what cannot be used."""

import gzip
from dataclasses import replace
from pathlib import Path

import pytest

from sim.roads.netconvert import NetconvertMissing
from sim.roads.netfile import read_network
from sim.scene import LightState
from sim.setup import departing, place_text
from sim.setup.scenario import CONFIG, Scenario, ScenarioInvalid, load, with_rider
from sim.setup.source import Added, Departing, FromConfiguration
from sim.setup.tables import TableError
from sim.sumo import Simulation
from tests.sim.crossroads import signalled
from xavi_dialogue.cli.new_scenario import write

pytestmark = pytest.mark.slow

ADDITIONAL = """
<additional>
    <vType id="cab" vClass="taxi" length="4.5" color="red"/>
    <tlLogic id="A0" type="static" programID="mine" offset="0">
        <phase duration="1000" state="rrrrrrrrrrrr"/>
    </tlLogic>
    <poly id="house" type="building.yes" shape="120,110 140,110 140,140 120,140"/>
</additional>
"""
ROUTES = """
<routes>
    <vehicle id="late" type="cab" depart="40"><route edges="left0A0 A0right0"/></vehicle>
    <vehicle id="1695568168247882" depart="0:00:32"><route edges="right0A0 A0left0"/></vehicle>
    <flow id="stream" begin="30" end="90" period="10" from="bottom0A0" to="A0top0"/>
    <route id="down" edges="top0A0 A0bottom0"/>
    <vehicle id="cycle" depart="30" type="DEFAULT_BIKETYPE" route="down"/>
</routes>
"""
MORE = '<routes><trip id="other" depart="30.00" from="left0A0" to="A0top0"/></routes>'


def configured(folder: Path, routes: str = ROUTES, time: str = "") -> Path:
    """A configuration in a folder: gzipped net and routes, types in an additional file."""
    signalled(folder)
    net = folder / "cross.net.xml"
    (folder / "cross.net.xml.gz").write_bytes(gzip.compress(net.read_bytes(), mtime=0))
    net.unlink()
    (folder / "a.rou.xml.gz").write_bytes(gzip.compress(routes.encode(), mtime=0))
    (folder / "b.rou.xml").write_text(MORE)
    (folder / "types.add.xml").write_text(ADDITIONAL)
    file = folder / "cross.sumocfg"
    file.write_text(f"""<configuration>
        <input>
            <net-file value="cross.net.xml.gz"/>
            <route-files value="a.rou.xml.gz,b.rou.xml"/>
            <additional-files value="types.add.xml"/>
        </input>
        <output><tripinfo-output value="trips.xml"/></output>
        <time><begin value="30"/>{time or '<end value="150"/>'}</time>
    </configuration>""")
    return file


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return configured(tmp_path_factory.mktemp("configured"))


def ridden(scenario: Scenario, steps: int) -> tuple[set[int], set[str], set[LightState]]:
    """The names and kinds of the vehicles seen, and the states of the lights."""
    names, kinds, states = set(), set(), set()
    with Simulation(scenario) as world:
        for _ in range(steps):
            scene = world.step(None)
            names |= set(scene.vehicles)
            kinds |= {vehicle.kind for vehicle in scene.vehicles.values()}
            states |= {light.state for light in scene.lights}
    return names, kinds, states


def test_a_vehicle_of_the_configuration_is_the_ego(file: Path) -> None:
    scenario = load(f"{file}?ego=late")
    assert scenario.source == FromConfiguration(Departing("late"), sublane=False)
    assert (scenario.ego, scenario.name, scenario.routes) == ("late", "cross", file)
    assert scenario.network == file.parent / "cross.net.xml.gz"
    assert scenario.goal.edge == "A0right0"
    lane = read_network(scenario.network).lanes["A0right0_0"]
    assert 0.0 < scenario.goal.position < lane.length
    assert (scenario.step, scenario.seed) == (0.1, 23423)
    assert scenario.duration == pytest.approx(150.0 - 41.0, abs=1.1)
    assert scenario.place == f"{file}?ego=late"


def test_all_that_sumo_loads_is_seen(file: Path) -> None:
    names, kinds, states = ridden(load(f"{file}?ego=late"), 250)
    assert kinds == {"car", "bicycle"}
    assert max(names) < 20  # no name of sixteen digits
    assert states == {LightState.RED}  # by the additional file's programme
    assert not (file.parent / "trips.xml").exists()


def test_a_car_is_added(file: Path) -> None:
    scenario = load(f"{file}?from=top0A0&to=A0left0&begin=60")
    assert scenario.source == FromConfiguration(Added("top0A0", "A0left0", 60.0), sublane=False)
    assert (scenario.ego, scenario.goal.edge) == ("ego", "A0left0")
    assert scenario.duration == pytest.approx(150.0 - 60.0, abs=2.0)
    assert load(scenario.place) == scenario
    with Simulation(scenario) as world:
        scene = world.scene()
        assert scene.time == 0.0
        assert scene.ego.position[1] > 250.0  # at the outer end of the northern arm
        assert world._engine.api.simulation.getTime() == pytest.approx(60.0, abs=1.0)


@pytest.mark.parametrize("begin", [147, 170])
def test_a_ride_that_begins_at_the_end_goes_on_beyond_it(file: Path, begin: int) -> None:
    scenario = load(f"{file}?from=top0A0&to=A0left0&begin={begin}")
    assert scenario.duration > 600.0
    told = "cross.sumocfg: it ends at 150 s, but the ride goes on to its destination"
    assert told in scenario.warnings
    with Simulation(scenario) as world:
        assert world.scene().vehicles
        assert world.step(None).time > 0.0


def test_a_car_is_added_at_the_beginning_by_itself(file: Path) -> None:
    with Simulation(load(f"{file}?from=top0A0&to=A0left0", 0)) as world:
        assert world._engine.api.simulation.getTime() == pytest.approx(30.0, abs=3.0)


def test_an_id_that_is_taken_is_not_given_to_the_added_car(tmp_path: Path) -> None:
    routes = ROUTES.replace('id="cycle"', 'id="ego"')
    assert load(f"{configured(tmp_path, routes)}?from=top0A0&to=A0left0").ego == "ego_1"


def test_a_seed_gives_one_ride(file: Path) -> None:
    scenario = load(f"{file}?ego=late")

    def ride(seed: int) -> list[object]:
        with Simulation(replace(scenario, seed=seed)) as world:
            return [world.step(None) for _ in range(60)]

    assert ride(1) == ride(1)
    assert ride(1) != ride(2)


BROKEN = [
    ("", ["does not say who the ego is", "--ego ID", "such as", "other"]),
    ("?ego=nobody", ["no vehicle, trip or flow has the id 'nobody'", "such as", "stream.0"]),
    ("?ego=stream.9", ["no vehicle 'stream.9' departs before 150 s", "such as", "late"]),
    ("?ego=cycle", ["'cycle' is of class 'bicycle'", "--ego-from"]),
    ("?from=top0A0", ["--ego-from alone does not say who the ego is", "--ego-to EDGE"]),
    ("?ego=a&begin=3", ["--begin cannot be given together with --ego"]),
    ("?ego=a&from=A0B0&to=B0C0", ["--ego-from and --ego-to cannot be given together with --ego"]),
    ("?from=A0B0&to=B0C0&begin=inf", ["begin: inf s is later than 604800 s"]),
    ("?from=A0B0&to=B0C0&begin=1e9", ["begin: 1e9 s is later than 604800 s"]),
    ("?from=A0B0&to=B0C0&begin=nan", ["begin: nan s is later than 604800 s"]),
    ("?from=top0A0&to=A0nowhere", ["there is no edge 'A0nowhere' for cars", "A0top0"]),
    ("?from=A0left0&to=A0right0", ["no way for cars leads from 'A0left0' to 'A0right0'"]),
    ("?from=top0A0&to=A0left0&begin=soon", ["begin: 'soon' is not a number"]),
    ("?car=late", ["car: unknown", "known are ego, from, to, begin"]),
    ("?late", ["bad query field", "write ?ego=ID"]),
]


@pytest.mark.parametrize(("wishes", "words"), BROKEN)
def test_wishes_that_cannot_be_met(file: Path, wishes: str, words: list[str]) -> None:
    with pytest.raises(ScenarioInvalid) as caught:
        load(f"{file}{wishes}")
    message = str(caught.value)
    assert message.startswith(str(file))
    assert message.count(str(file)) == 1
    for word in words:
        if word != "such as":
            assert word in message


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("cross.net.xml.gz", "none.net.xml", "none.net.xml"),
        ("types.add.xml", "none.add.xml", "none.add.xml"),
        ("<output>", "<x><osg-view value='1'/></x><output>", "'osg-view' exists.*take it out"),
        ("<output>", "<x><mesosim value='1'/></x><output>", "mesosim: .*remove the option"),
    ],
)
def test_configurations_that_sumo_refuses(
    tmp_path: Path, old: str, new: str, words: str, capfd: pytest.CaptureFixture[str]
) -> None:
    file = configured(tmp_path)
    file.write_text(file.read_text().replace(old, new, 1))
    with pytest.raises(ScenarioInvalid, match=words) as caught:
        load(f"{file}?ego=late")
    assert str(caught.value).startswith(str(file))
    assert capfd.readouterr() == ("", "")


def test_roads_are_not_taken_for_a_configuration(tmp_path: Path) -> None:
    signalled(tmp_path)
    with pytest.raises(ScenarioInvalid, match=r"is a file of roads, and no .*give a \.sumocfg"):
        load(tmp_path / "cross.net.xml")


def test_departures_are_looked_for_in_a_limited_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(departing, "LOOKED", 5.0)
    late = '<routes><trip id="late" depart="90" from="left0A0" to="A0top0"/></routes>'
    file = configured(tmp_path, late)
    (tmp_path / "b.rou.xml").write_text("<routes/>")
    with pytest.raises(ScenarioInvalid, match=r"no car departs within .*--ego-from EDGE"):
        with_rider(str(file))
    assert load(f"{file}?ego=late").ego == "late"


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(ScenarioInvalid, match=r"a\.sumocfg: there is no such file; correct the"):
        load(tmp_path / "a.sumocfg")


def test_what_sumo_says_of_others_before_the_ego_departs_is_not_shown(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    hasty = """<vehicle id="slow" depart="31" departPos="60" departSpeed="0">
        <route edges="bottom0A0 A0top0"/></vehicle>
        <vehicle id="hasty" depart="31" departPos="53" departSpeed="13" insertionChecks="none">
        <route edges="bottom0A0 A0top0"/></vehicle></routes>"""
    talkative = '<verbose value="true"/><end value="150"/>'
    file = configured(tmp_path, ROUTES.replace("</routes>", hasty), talkative)
    with Simulation(load(f"{file}?ego=late", 0)):
        pass
    assert capfd.readouterr() == ("", "")


def test_what_is_not_modelled_is_named(tmp_path: Path) -> None:
    walker = '<person id="p" depart="30"><walk edges="left0A0 A0right0"/></person></routes>'
    file = configured(tmp_path, ROUTES.replace("</routes>", walker))
    stops = '<stop lane="left0A0_0" endPos="80" duration="5"/></vehicle>'
    routes = ROUTES.replace("</vehicle>", stops, 1).replace("</routes>", walker)
    train = '<vType id="line" vClass="rail"/><vType id="cab"'
    (tmp_path / "types.add.xml").write_text(ADDITIONAL.replace('<vType id="cab"', train))
    (tmp_path / "a.rou.xml.gz").write_bytes(gzip.compress(routes.encode(), mtime=0))
    scenario = load(f"{file}?ego=late")
    told = scenario.warnings
    with Simulation(scenario) as world:
        assert world._engine.api.vehicle.getStops("late") == ()
    for words in (
        "steps of 1 s are shortened to 0.1 s",
        "stops of 'late' are not made",
        "trains are seen, and where they go is not foreseen",
    ):
        assert any(words in warning for warning in told)


def test_lanes_that_are_not_as_the_net_says_are_named(tmp_path: Path) -> None:
    file = configured(tmp_path)
    sign = (
        '<variableSpeedSign id="v" lanes="A0right0_0"><step time="0" speed="3"/>'
        "</variableSpeedSign></additional>"
    )
    (tmp_path / "types.add.xml").write_text(ADDITIONAL.replace("</additional>", sign))
    told = load(f"{file}?ego=late").warnings
    limit = "1 lanes ('A0right0_0') have another limit now; the car keeps to that of the net"
    assert f"cross.sumocfg: {limit}" in told


def test_a_folder_may_name_a_configuration(file: Path, tmp_path: Path) -> None:
    loaded = load(f"{file}?from=top0A0&to=A0left0&begin=60")
    target = write(loaded, tmp_path / "mine")
    again = load(tmp_path / "mine")
    assert again.source == loaded.source
    assert (again.goal, again.seed, again.step) == (loaded.goal, loaded.seed, loaded.step)
    assert (again.name, again.place) == ("mine", str(tmp_path / "mine"))
    target.write_text(f'{target.read_text()}[goal]\nedge = "A0left"\nposition = 1.0\n')
    with pytest.raises(ScenarioInvalid, match=r"goal\.edge: there is no edge 'A0left'"):
        load(tmp_path / "mine")
    with pytest.raises(ScenarioInvalid, match="it is there already"):
        write(loaded, tmp_path / "mine")


def test_a_folder_names_a_vehicle_and_changes_the_seed(file: Path) -> None:
    folder = file.parent / "inside"
    target = write(load(f"{file}?ego=late"), folder)
    assert target == folder / CONFIG
    target.write_text(target.read_text().replace("seed = 23423", "seed = 7"))
    again = load(folder)
    assert (again.ego, again.seed) == ("late", 7)


DRAWN = """
<routes>
    <routeDistribution id="somewhere">
        <route id="east" edges="left0A0 A0right0" probability="1"/>
        <route id="north" edges="left0A0 A0top0" probability="1"/>
        <route id="south" edges="left0A0 A0bottom0" probability="1"/>
    </routeDistribution>
    <flow id="before" begin="30" end="90" probability="0.4" route="somewhere"/>
    <flow id="drawn" begin="33" end="90" probability="0.4" route="somewhere"/>
</routes>
"""


def test_the_goal_is_where_the_seed_leads(tmp_path: Path) -> None:
    place = f"{configured(tmp_path, DRAWN)}?ego=drawn.3"
    folder = write(load(place), tmp_path / "written").parent
    goals = set()
    for seed in range(5):
        scenario = load(place, seed)
        with Simulation(scenario) as world:
            route = world._engine.api.vehicle.getRoute("drawn.3")
        assert scenario.goal.edge == route[-1]
        assert (scenario.seed, load(folder, seed).goal) == (seed, scenario.goal)
        goals.add(route[-1])
    assert len(goals) > 1


def test_the_first_car_that_departs_is_chosen(file: Path) -> None:
    place = with_rider(str(file))
    assert place_text.split_place(place)[1]["ego"] in ("other", "stream.0")
    assert with_rider(f"{file}?ego=late") == f"{file}?ego=late"


def test_only_scenarios_of_configurations_become_folders(tmp_path: Path) -> None:
    with pytest.raises(ScenarioInvalid, match="not a SUMO configuration"):
        write(load("s1"), tmp_path / "mine")


@pytest.mark.parametrize(
    ("wishes", "place"),
    [
        ({"ego": "a b&c"}, "x.sumocfg?ego=a+b%26c"),
        ({"from": "a", "to": "b"}, "x.sumocfg?from=a&to=b"),
    ],
)
def test_places_keep_what_was_wished(wishes: dict[str, str], place: str) -> None:
    assert place_text.with_wishes("x.sumocfg", wishes) == place


def test_no_name_of_a_scenario_is_taken_for_a_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "s1").write_text("a file that lies about")
    monkeypatch.chdir(tmp_path)
    assert load("s1").name == "s1"


def test_a_place_within_the_package_is_found(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "tools").mkdir()
    inside = tmp_path / "tools" / "cross.sumocfg"
    inside.write_text("<configuration/>", encoding="utf-8")
    monkeypatch.setattr(place_text, "package_folder", lambda: tmp_path)
    place = "sumo:tools/cross.sumocfg?ego=car.3"
    assert place_text.is_place(place)
    assert place_text.split_place(place) == (inside, {"ego": "car.3"})
    with pytest.raises(TableError, match="there is no such file"):
        place_text.split_place("sumo:tools/none.sumocfg")


def test_a_place_within_the_package_needs_the_package(monkeypatch: pytest.MonkeyPatch) -> None:
    def missing() -> Path:
        raise NetconvertMissing

    monkeypatch.setattr(place_text, "package_folder", missing)
    with pytest.raises(TableError, match="not installed"):
        place_text.split_place("sumo:tools/cross.sumocfg")
