"""Driving on networks of others: what is found, what is judged, and what is summed up."""

import json
import math
from pathlib import Path

import msgspec
import numpy as np
import pytest
from typer.testing import CliRunner

from benchmarks.drive.monitor import Drive, Ended, Hit
from benchmarks.drive.runs import Decided
from benchmarks.errors import ForeignUnusable
from benchmarks.foreign import pdm
from benchmarks.foreign.conduct import Conduct
from benchmarks.foreign.measure import measure, read
from benchmarks.foreign.report import report
from benchmarks.foreign.rides import NoRide, ride
from benchmarks.foreign.riding import Driven, Ridden, Task, rode
from benchmarks.foreign.rules import Rules
from benchmarks.foreign.sites import Site, sites
from benchmarks.foreign.tally import score, tally
from sim.roads.lanes import Crossing, Lane, Link
from sim.roads.netconvert import generate
from sim.roads.network import Network
from sim.scene import Light, LightState, PersonState, Scene, Signal, VehicleState
from xavi_dialogue.__main__ import app

CARS = frozenset({"passenger"})
LIGHT = Signal("tl", 0)


def lane(name: str, start: float, end: float, *, limit: float = 14.0) -> Lane:
    line, inside = ((start, 0.0), (end, 0.0)), name.startswith(":")
    edge = name.rpartition("_")[0]
    long = end - start
    return Lane(name, edge, 0, 3.5, limit, line, inside, long, long, CARS)


#: A road, a junction with a light and a crossing before it, and a slower road.
ROADS = Network(
    {
        "a_0": lane("a_0", 0.0, 100.0),
        ":j_0_0": lane(":j_0_0", 100.0, 110.0),
        "b_0": lane("b_0", 110.0, 200.0, limit=8.0),
    },
    (Link("j", 0, "a_0", "b_0", (":j_0_0",), "straight", (), (), False, LIGHT),),
    "roads",
    crossings=(
        Crossing(":j_c0_0", "j", 1, ((105.0, -6.0), (105.0, 6.0)), 4.0, ("b",), Signal("tl", 1)),
    ),
)


def car(x: float, y: float = 0.0, speed: float = 7.0, heading: float = 0.0) -> VehicleState:
    return VehicleState((x, y), heading, speed, 0.0, 4.0, 1.8)


def walker(y: float, speed: float = 1.4, heading: float = math.pi / 2) -> PersonState:
    return PersonState((105.0, y), heading, speed, 0.3, 0.5)


def through(
    states: list[LightState], people: list[PersonState] | None = None, people_light: str = "G"
) -> Rules:
    """A drive of the ego over the light's line at 100 m, in steps of 1 m."""
    rules = Rules(ROADS)
    for k, state in enumerate(states):
        crossing = Light(Signal("tl", 1), LightState(people_light), 0.0, change_seen=False)
        lights = (Light(LIGHT, state, 0.0, change_seen=False), crossing)
        walking = dict(enumerate(people or (), 7))
        rules.see(Scene(k / 7.0, {0: car(95.5 + k)}, lights, walking))
    return rules


GREEN, RED, AMBER = LightState.GREEN, LightState.RED, LightState.AMBER


@pytest.mark.parametrize(
    ("states", "reds"),
    [
        ([GREEN] * 25, 0),
        ([RED] * 25, 1),
        ([AMBER] * 25, 0),
        ([RED] * 3 + [GREEN] * 22, 0),  # it was red up to before the line
        ([GREEN] * 8 + [RED] * 17, 0),  # it is red as soon as the line is passed
        ([RED] * 10, 1),  # the drive ends inside the junction
        ([RED] * 4, 0),  # before the line
    ],
)
def test_a_light_is_passed_on_red(states: list[LightState], reds: int) -> None:
    broken = through(states).broken()
    assert len(broken.reds) == reds
    assert broken.lights == (1 if len(states) > 20 else 0)


@pytest.mark.parametrize(
    ("person", "light", "violated"),
    [
        (walker(-1.0), "G", 1),
        (walker(-3.5), "G", 1),  # will be before the ego in two seconds
        (walker(-5.5), "G", 0),  # is too far off for that
        (walker(3.5), "G", 0),  # has passed
        (walker(-3.5, speed=0.0), "G", 0),  # waits
        (walker(-3.5), "r", 0),  # must not go
    ],
)
def test_a_crossing_is_violated_before_those_who_may_go_first(
    person: PersonState, light: str, violated: int
) -> None:
    broken = through([GREEN] * 25, [person], light).broken()
    assert (len(broken.violated), broken.crossings) == (violated, 1)


def test_who_waits_before_a_crossing_violates_nothing() -> None:
    assert through([GREEN] * 7, [walker(-1.0)]).broken().violated == ()


@pytest.mark.parametrize(("speed", "violations"), [(8.4, 0), (9.0, 1), (13.0, 1)])
def test_a_limit_is_violated_once_however_long(speed: float, violations: int) -> None:
    rules = Rules(ROADS)
    for k in range(30):
        rules.see(Scene(0.1 * k, {0: car(120.0 + k, speed=speed)}))
    assert len(rules.broken().limits) == violations


def test_a_limit_is_not_violated_in_a_moment() -> None:
    rules = Rules(ROADS)
    for k in range(4):
        rules.see(Scene(0.1 * k, {0: car(120.0 + k, speed=12.0)}))
    assert rules.broken().limits == ()


@pytest.mark.parametrize(("y", "off"), [(0.0, 0), (0.9, 0), (1.5, 1)])
def test_a_corner_beside_the_road_is_off_it(y: float, off: int) -> None:
    rules = Rules(ROADS)
    for k in range(5):
        rules.see(Scene(0.1 * k, {0: car(50.0 + k, y)}))
    assert len(rules.broken().off_road) == off


def test_the_score_is_that_of_navsim() -> None:
    parts = {"progress": 0.5, "time_to_collision": 1.0, "comfort": 0.0}
    assert pdm.score(collided=False, off_road=False, parts=parts) == pytest.approx(7.5 / 12.0)
    assert pdm.score(collided=True, off_road=False, parts=parts) == 0.0
    assert pdm.score(collided=False, off_road=True, parts=parts) == 0.0


def test_progress_is_compared_when_the_faster_one_arrives() -> None:
    fast, slow = [0.0, 10.0, 20.0], [0.0, 5.0, 10.0, 15.0, 20.0]
    assert pdm.progress(fast, slow) == 1.0
    assert pdm.progress(slow, fast) == 0.5
    assert pdm.progress([0.0, 1.0], [0.0, 2.0]) == 1.0  # nobody has got anywhere
    assert pdm.progress([], fast) == 0.0


def test_steady_driving_is_comfortable_and_an_emergency_is_not() -> None:
    still = np.zeros(80)
    assert pdm.comfortable(still + 10.0, still, still) == 1.0
    braking = np.where(np.arange(80) < 40, 0.0, -7.0)
    assert pdm.comfortable(still + 10.0, braking, still) == 0.5
    turning = np.where(np.arange(80) < 40, 0.0, 0.12 * (np.arange(80) - 40))
    assert pdm.comfortable(still + 10.0, still, turning) == 0.5
    assert pdm.comfortable(np.zeros(0), np.zeros(0), np.zeros(0)) == 1.0


def test_who_is_close_ahead_is_met_in_time_or_not() -> None:
    def share(other: VehicleState, *, off_lane: bool = False) -> float:
        scenes = [Scene(0.1 * k, {0: car(0.0, speed=10.0), 1: other}) for k in range(20)]
        return pdm.in_time(scenes, [off_lane] * 20)

    assert share(car(30.0)) == 1.0
    assert share(car(10.0)) == 0.0  # its rear is 6 m ahead
    assert share(car(10.0, 4.0)) == 1.0
    beside = car(-0.5, 1.7)
    assert (share(beside), share(beside, off_lane=True)) == (1.0, 0.0)


def conduct(**more: object) -> Conduct:
    plain = Conduct(1, (), 0, (), (), (), 1.0, 1.0, (0.0, 10.0, 20.0), 5.0)
    return msgspec.structs.replace(plain, **more)


def driven(ended: Ended = "arrived", time: float = 20.0, **more: object) -> Driven:
    hits = more.pop("hits", ())
    return Driven(Drive(ended, time, hits, 0, 0), conduct(**more))  # type: ignore[arg-type]


def ridden(name: str, seed: int, ours: Driven, sumo: Driven) -> Ridden:
    decisions = (Decided(50.0, 2), Decided(200.0, 20))
    return Ridden(name, seed, "/x.sumocfg?ego=a", (), ours, sumo, None, decisions, 0.5)


def test_rides_are_counted_beside_those_of_sumos_driver() -> None:
    rides = [
        ridden("a", 0, driven(time=24.0, reds=(3.0,)), driven()),
        ridden("a", 1, driven("duration"), driven()),
        ridden("a", 2, driven("collided", hits=(Hit(1, 2.0, True),)), driven("left")),
        Ridden("a", 3, "/x.sumocfg?ego=a", error="SumoFailed: no"),
    ]
    found = tally("a", rides)
    assert (found.rides, found.loaded, found.failed, found.missed) == (4, 4, 1, 1)
    assert (found.ours.arrived, found.sumo.arrived) == (1, 2)
    assert (found.ours.reds, found.ours.lights, found.ours.caused) == (1, 3, 1)
    assert found.time_ratio == 1.2
    assert found.decision_p50 == 125.0
    assert score(rides[2].ours, rides[2].sumo) == 0.0  # type: ignore[arg-type]


def test_a_report_says_what_is_missed_and_how_to_drive_it_again() -> None:
    rides = [
        ridden("a", 0, driven(), driven()),
        ridden("b", 3, driven("duration", reds=(3.0, 9.0)), driven()),
        Ridden("c", 0, error="nobody drives"),
    ]
    found = report(rides, ())
    assert [x.site for x in found.sites] == ["a", "b"]
    assert [(x.name, x.why) for x in found.left_out] == [("c", "nobody drives")]
    assert [(x.site, x.what) for x in found.worst] == [("b", "passed on red at 3.0, 9.0 s")]
    assert found.worst[0].reproduce == "xavi drive --scenario '/x.sumocfg?ego=a' --seed 3"
    missed = {target.name for target in found.targets if not target.met}
    assert missed == {
        "arrived where SUMO's driver does",
        "lights passed on red",
        "decision p99, up to 12 others",
    }
    assert not found.met
    assert json.loads(msgspec.json.encode(found))["bench"] == "foreign"
    assert "nobody drives" in found.table()


def test_networks_are_found_once_with_their_configurations(tmp_path: Path) -> None:
    (tmp_path / "town").mkdir()
    net = tmp_path / "town" / "n.net.xml"
    net.write_text("<net/>")
    (tmp_path / "copy.net.xml").write_text("<net/>")
    (tmp_path / "alone.net.xml").write_text("<net>1</net>")
    for name in ("b", "a"):
        text = '<configuration><input><net-file value="town/n.net.xml"/></input></configuration>'
        (tmp_path / f"{name}.sumocfg").write_text(text)
    (tmp_path / "lost.sumocfg").write_text('<c><net-file value="no.net.xml"/></c>')
    found, left_out = sites(tmp_path)
    assert [(site.name, Path(site.network).name) for site in found] == [
        ("a", "n.net.xml"),
        ("alone", "alone.net.xml"),
    ]
    assert [Path(x).name for x in found[0].configurations] == ["a.sumocfg", "b.sumocfg"]
    assert [(x.name, "is not there" in x.why) for x in left_out] == [("lost", True)]


def test_a_site_of_no_use_says_why(tmp_path: Path) -> None:
    net = tmp_path / "n.net.xml"
    net.write_text("no net")
    with pytest.raises(NoRide, match=r"n\.net\.xml"):
        ride(Site("n", str(net)), 0, tmp_path / "made")


def test_what_is_no_file_of_rides_is_wrong_usage(tmp_path: Path) -> None:
    results = tmp_path / "rides.jsonl"
    assert read(results) == {}
    results.write_text("no\n")
    with pytest.raises(ForeignUnusable, match="remove it"):
        read(results)
    done = CliRunner().invoke(app, ["bench", "foreign", "--networks", str(tmp_path), "--site", "x"])
    assert (done.exit_code, done.stdout) == (2, "")


@pytest.fixture(scope="module")
def town(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a small network that has lights, and no traffic."""
    folder = tmp_path_factory.mktemp("town")
    kind = ("-g", "--grid.number", "2", "--grid.length", "100", "--grid.attach-length", "100")
    generate((*kind, "--default-junction-type", "traffic_light"), folder / "grid.net.xml")
    return folder


@pytest.mark.slow
def test_a_ride_is_driven_twice_and_kept(town: Path) -> None:
    results, notes = town / "rides.jsonl", []
    found = measure([town], [], range(1), results, None, 1, notes.append)
    assert (found.all.rides, found.all.failed, found.all.sumo.arrived) == (1, 0, 1)
    assert found.all.ours.arrived == 1
    assert (found.all.ours.reds, found.all.ours.caused) == (0, 0)
    assert found.all.company is not None
    assert found.all.company > 0.0
    again = measure([town], [], range(1), results, None, 1, notes.append)
    assert again == found
    assert notes[-1].endswith("0 of them still to be driven")


@pytest.mark.slow
def test_the_same_seed_is_the_same_ride(town: Path, tmp_path: Path) -> None:
    (site,), _ = sites(town)
    one, other = (ride(site, 5, tmp_path / name) for name in ("a", "b"))
    assert one.place.partition("?")[2] == other.place.partition("?")[2]
    assert rode(Task(Site("x", str(tmp_path / "none.net.xml")), 0, None)).place is None
