"""What vehicles truly did, read off scenes, and how it is compared with what was expected."""

import json
import math

import msgspec
import pytest

from benchmarks.prediction.approach import approaches, track_at
from benchmarks.prediction.displacement import METHODS, Error
from benchmarks.prediction.foretold import Foretold
from benchmarks.prediction.goal_scores import FLOOR
from benchmarks.prediction.recognise import Task, Watched, tasks, watch
from benchmarks.prediction.recognise_report import report
from benchmarks.prediction.ride_scenes import MEMORY
from benchmarks.prediction.stories import Story, likely, manoeuvre
from planner.prediction.goals import Goal
from planner.prediction.recognise import Belief
from planner.record.events import Event
from planner.record.trace import Action, EgoGoal
from planner.roads.trajectory import Roads
from sim.roads.network import Network, point_at
from sim.scene import Scene, VehicleState
from sim.setup import scenario
from xavi_dialogue.vehicle.episode import network_of

SPEED = 10.0  # [m/s]
VIEW = 100.0  # [m]
STEP = 0.2  # [s]
EGO = VehicleState((0.0, 0.0), 0.0, 0.0, 0.0, 4.8, 1.8)


@pytest.fixture(scope="module")
def network() -> Network:
    return network_of(scenario.load("s1"))


def way(network: Network, start: str, *edges: str) -> list[str]:
    """The lanes from a lane on along edges, through the junctions between them."""
    lanes = [start]
    for edge in edges:
        [link] = [k for k in network.links_from(lanes[-1]) if network.lanes[k.to_lane].edge == edge]
        lanes += [*link.via, link.to_lane]
    return lanes


def driven(network: Network, lanes: list[str], until: float = math.inf) -> list[Scene]:
    """Vehicle 1 along lanes at a steady speed, up to a distance [m] from the start."""
    scenes, gone = [], 0.0
    while True:
        rest, place = gone, None
        for name in lanes:
            if rest < network.lanes[name].length:
                place = point_at(network.lanes[name].centreline, rest)
                break
            rest -= network.lanes[name].length
        if place is None or gone > until:
            return scenes
        state = VehicleState(place[0], place[1], SPEED, 0.0, 4.8, 1.8)
        scenes.append(Scene(round(len(scenes) * STEP, 3), {0: EGO, 1: state}))
        gone += SPEED * STEP


@pytest.mark.parametrize("road", ["exit_s", "main_out"])
def test_the_road_that_a_vehicle_took_is_read_off_its_way(network: Network, road: str) -> None:
    scenes = driven(network, way(network, "main_in_0", road))
    [found] = approaches(Roads(network), scenes, VIEW)
    length = network.lanes["main_in_0"].length
    assert (found.vehicle, found.truth) == (1, road)
    assert found.first * SPEED * STEP == pytest.approx(length - VIEW, abs=SPEED * STEP)
    assert found.last * SPEED * STEP > length
    edges = {goal.target.edge for goal in found.choices if goal.target is not None}
    assert {"exit_s", "main_out"} <= edges


def test_who_goes_out_of_view_before_it_chose_tells_nothing(network: Network) -> None:
    lanes = way(network, "main_in_0", "exit_s")
    scenes = driven(network, lanes, until=network.lanes["main_in_0"].length - 5.0)
    assert approaches(Roads(network), scenes, VIEW) == ()


def test_who_was_hidden_for_a_while_is_watched_anew(network: Network) -> None:
    scenes = driven(network, way(network, "main_in_0", "exit_s"))
    [whole] = approaches(Roads(network), scenes, VIEW)
    gap = whole.first + 5
    scenes[gap] = Scene(scenes[gap].time, {0: EGO})
    [later] = approaches(Roads(network), scenes, VIEW)
    assert (later.first, later.last) == (gap + 1, whole.last)


def test_a_track_begins_where_the_vehicle_came_into_view(network: Network) -> None:
    scenes = driven(network, way(network, "main_in_0", "exit_s"))
    scenes[10] = Scene(scenes[10].time, {0: EGO})
    assert track_at(scenes, 20, 1, MEMORY).elapsed == 9
    assert track_at(scenes, 9, 1, MEMORY).elapsed == 9
    assert track_at(scenes, 20, 1, 4).elapsed == 4


def belief(kind: Action, edge: str | None, probability: float) -> Belief:
    target = None if edge is None else EgoGoal(edge, 1.0, None)
    return Belief(Goal(kind, "", target, 0.5), 1.0, probability, ())


def test_goals_of_one_kind_are_taken_together() -> None:
    beliefs = [belief("exit-left", "a", 0.5), belief("exit-left", "b", 0.3)]
    assert likely(beliefs, "exit-left") == pytest.approx(0.8)
    assert likely(beliefs, "exit-right") == 0


def test_a_manoeuvre_given_up_is_none() -> None:
    events = [
        Event("action-started", 1.0, "change-left", 1),
        Event("action-ended", 2.0, "change-left", 1),
        Event("action-started", 3.0, "change-left", 3),
        Event("action-committed", 3.5, "change-left", 3),
    ]
    assert manoeuvre(events, "change-left") == (3.0, 3.5)
    assert manoeuvre(events[:2], "change-left") == (None, None)


def moment(chances: tuple[float, ...], truth: int, network: str = "s1/0") -> Foretold:
    kinds: tuple[Action, ...] = ("exit-left", "exit-right", "continue")[: len(chances)]
    errors = tuple(Error(method, 2.0, 1.0, 2.0, 1) for method in METHODS)
    family = network.partition("/")[0]
    return Foretold(network, family, 1, "two roads", 1.0, 3.0, chances, kinds, truth, errors)


def test_reports_have_a_part_for_each_set_of_networks() -> None:
    story = Story("s1", 0, 1, "exit-right", 2.5, 3.0, 3.5, True)
    found = report(
        [
            Watched(Task("s1", 0), (moment((0.5, 0.5), 0), moment((0.9, 0.1), 0)), (), story),
            Watched(Task(None, 7), (moment((0.0, 1.0), 0, "network 7/7"),)),
            Watched(Task("s2", 1), error="SumoFailed: no"),
        ]
    )
    [development, held_out] = found.parts
    rows = {row.group: row for row in development.goals}
    assert set(rows) == {"s1", "two roads", "seen 1 to 2 s", "left 2 to 4 s", "all"}
    ours = rows["all"].scores["ours"]
    assert ours.log == pytest.approx(-(math.log(0.5) + math.log(0.9)) / 2.0)
    assert ours.top == pytest.approx(0.75)
    assert held_out.goals[-1].scores["ours"].log == pytest.approx(-math.log(FLOOR))
    lines = [row for row in held_out.lines if row.group == "all"]
    assert [row.method for row in lines] == list(METHODS)
    assert {(row.average, row.final, row.moments) for row in lines} == {(1.0, 2.0, 1)}
    assert [row.networks for row in found.maps] == ["development", "held out"]
    assert [(f.name, f.unit, f.p50) for f in found.figures] == [("s1 known ahead", "s", 1.0)]
    assert found.failed == ("SumoFailed: no\n    s2, seed 1",)
    assert json.loads(msgspec.json.encode(found))["bench"] == "recognise"
    assert "s2, seed 1" in found.table()


def test_rides_are_scenarios_by_seed_and_networks_by_number() -> None:
    found = tasks(["s1"], 2, 3, 100, 1)
    assert [(one.name, one.seed) for one in found[:2]] == [("s1", 0), ("s1", 1)]
    assert [one.seed for one in found[2:]] == [100, 101, 102]
    assert [one.constants for one in found] == [False, False, True, False, False]


@pytest.mark.slow
def test_others_are_watched_the_same_every_time() -> None:
    once = watch(Task("s2", 0))
    assert once.error is None
    assert once == watch(Task("s2", 0))
    assert once.story is not None
    for seen in once.moments:
        assert sum(seen.chances) <= 1.0 + 1e-9
        assert seen.left >= 0.0
    ends = [seen.chances[seen.truth] for seen in once.moments if seen.left < 1.0]
    starts = [seen.chances[seen.truth] for seen in once.moments if seen.left > 4.0]
    assert sum(ends) / len(ends) > sum(starts) / len(starts)


def test_an_approach_that_breaks_is_told() -> None:
    found = watch(Task("nowhere", 1))
    assert found.error is not None
    assert found.error.startswith("ScenarioNotFound")
    assert found.moments == ()


def test_recognition_is_held_against_its_rivals_on_networks_never_used_before() -> None:
    def both(first: float, network: str) -> tuple[Foretold, Foretold]:
        chances = (first, 1.0 - first)
        return moment(chances, 0, network), moment(chances[::-1], 1, network)

    known = Watched(Task("s1", 0), both(0.9, "s1/0"))
    sure = [Watched(Task(None, k), both(0.9, f"network {k}/{k}")) for k in range(4)]
    wrong = [Watched(Task(None, k), both(0.1, f"network {k}/{k}")) for k in range(4)]
    assert report([known, *sure]).targets[0].met
    assert not report([known, *wrong]).targets[0].met
    assert report([known]).targets[0].value is None
