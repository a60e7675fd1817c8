"""What vehicles truly did, read off scenes, and how it is compared with what was expected."""

import json
import math

import msgspec
import pytest

from planner.events import Event
from planner.goals import Goal
from planner.recognise import Belief
from planner.trace import Action, EgoGoal
from planner.trajectory import Roads
from sim import scenario
from sim.network import Network, point_at
from sim.scene import Scene, VehicleState
from xavi_dialogue.app.bench.approach import Approach, approaches, track_at
from xavi_dialogue.app.bench.recognise import Guess, Seen, Watched, guess, report, watch
from xavi_dialogue.app.bench.recording import MEMORY
from xavi_dialogue.app.bench.stories import Story, likely, manoeuvre
from xavi_dialogue.app.ride import network_of

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
    assert found.nearest in edges
    assert found.sample(10) == found.last
    assert found.first < found.sample(1) < found.sample(5) < found.last


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


def test_a_guess_is_measured_by_what_came_true() -> None:
    beliefs = (belief("exit-left", "a", 0.5), belief("exit-right", "b", 0.5))
    found = guess(beliefs, "b", 2)
    assert (found.probability, found.right) == (0.5, 0.5)
    assert found.entropy == pytest.approx(1.0)
    assert guess(beliefs, "b", 4).entropy == pytest.approx(0.5)
    assert guess(beliefs, "elsewhere", 2) == Guess(0, 0.0, 1.0)
    sure = guess((belief("stop", None, 0.0), belief("exit-left", "a", 1.0)), "a", 2)
    assert sure == Guess(1.0, 1.0, 0.0)


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


def test_reports_take_means_by_scenario_and_over_all() -> None:
    def seen(probability: float) -> Seen:
        none = Guess(0.25, 0.25, 1.0)
        return Seen(1, Guess(probability, 1.0, 0.0), none, none)

    story = Story("s1", 0, 1, "exit-right", 2.5, 3.0, 3.5, True)
    found = report(
        [
            Watched("s1", 0, (seen(0.5), seen(1.0)), story),
            Watched("s2", 0, (seen(0.0),)),
            Watched("s2", 1, error="SumoFailed: no"),
        ]
    )
    rows = {row.scenario: (row.n, row.ours.probability) for row in found.rows}
    assert rows == {"s1": (2, 0.75), "s2": (1, 0.0), "all": (3, 0.5)}
    assert [(f.name, f.unit, f.p50) for f in found.figures] == [("s1 known ahead", "s", 1.0)]
    assert found.failed == ("SumoFailed: no\n    xavi drive --scenario s2 --seed 1",)
    assert json.loads(msgspec.json.encode(found))["bench"] == "recognise"
    assert "xavi drive --scenario s2 --seed 1" in found.table()


@pytest.mark.slow
def test_others_are_watched_the_same_every_time() -> None:
    once = watch(("s2", 0))
    assert once.error is None
    assert once == watch(("s2", 0))
    assert once.seen
    assert {seen.tenth for seen in once.seen} == set(range(1, 11))
    for seen in once.seen:
        assert 0.0 <= seen.ours.probability <= 1.0
        assert 0.0 <= seen.ours.entropy <= 1.0 + 1e-9
    ends = [seen.ours.probability for seen in once.seen if seen.tenth == 10]
    starts = [seen.ours.probability for seen in once.seen if seen.tenth == 1]
    assert sum(ends) > sum(starts)
    assert once.story is not None


def test_an_approach_that_breaks_is_told() -> None:
    found = watch(("nowhere", 1))
    assert found.error is not None
    assert found.error.startswith("ScenarioNotFound")
    assert found.seen == ()


def test_tenths_lie_within_the_approach() -> None:
    approach = Approach(1, 7, 40, (), "a", "a")
    samples = [approach.sample(tenth) for tenth in range(11)]
    assert (samples[0], samples[-1]) == (7, 40)
    assert samples == sorted(samples)
