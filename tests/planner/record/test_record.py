"""What of a decision is recorded, and whom recognition looks at."""

from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np
import pytest

from planner.manoeuvres.actions import Situation
from planner.record.trace import EgoGoal, Sample, Settings, Track
from planner.search.decide import decide, predict, prepare
from planner.search.inputs import Frame, Moment, Root, root_at
from planner.search.recording import numbers, points, rollouts
from planner.search.simulated import Simulated
from sim.roads.network import Location
from sim.scene import VehicleState
from tests.planner.drives import LENGTH, WIDTH, avenue, corner
from tests.planner.nets import on_lane

ROAD, CORNER = avenue(limit=10.0), corner()


@dataclass
class Part:
    """A leg as far as the record needs it."""

    action: str
    first: int
    position: Any
    speed: Any
    collided_with: int | None = None


def simulated(*legs: Part, samples: tuple[Sample, ...] = (), **more: Any) -> Simulated:
    known = {
        "outcome": "done",
        "components": {"time": 4.44444, "jerk": 0.123456, "angular-acceleration": 0.1234567,
                       "curvature": 0.12345678},
        "reward": -5.0,
        "terms": {"time": 4.44444, "effort": 0.55556},
        "held_up": (),
        "held_by_lights": (),
        "held_by_hidden": (),
        "braking": (),
    }  # fmt: skip
    one = Simulated(samples, (), **{**known, **more})
    return replace(one, legs=cast("Any", legs)) if legs else one


def part(action: str, first: int, *xs: float, hit: int | None = None) -> Part:
    return Part(action, first, np.array([(x, 0.04) for x in xs]), np.array(xs) / 10.0, hit)


FIRST = part("change-left", 0, 0.0, 10.04, 20.06)
THEN = part("continue", 2, 20.06, 30.0)


def test_a_line_that_was_driven_before_is_referred_to() -> None:
    ways = [simulated(FIRST, THEN), simulated(FIRST), simulated(FIRST, THEN), simulated(FIRST)]
    found = rollouts(ways, 50.0, 7)
    assert [one.index for one in found] == [7, 8, 9, 10]
    assert [one.same_as for one in found] == [None, None, 7, 8]
    assert found[0].path == ((0.0, 0.0), (10.0, 0.0), (20.1, 0.0), (30.0, 0.0))
    assert found[0].speed == (0.0, 1.0, 2.0, 3.0)
    assert found[1].path == found[0].path[:3]
    assert (found[2].path, found[2].speed) == (None, None)
    assert [(a.action, a.start) for a in found[0].actions] == [
        ("change-left", 50.0), ("continue", 50.4)
    ]  # fmt: skip
    assert [one.index for one in rollouts(ways, 50.0)] == [0, 1, 2, 3]


def test_figures_are_rounded() -> None:
    (one,) = rollouts([simulated(FIRST, weight=0.12345678)], 50.0)
    assert one.components == {
        "time": 4.44, "jerk": 0.1235, "angular-acceleration": 0.12346, "curvature": 0.123457
    }  # fmt: skip
    assert one.terms == {"time": 4.4444, "effort": 0.5556}
    assert one.weight == 0.123457
    (other,) = rollouts([simulated(FIRST, components={"time": None})], 50.0)
    assert (other.components, other.weight) == ({"time": None}, None)
    assert points(np.array([(1.04, -2.06)])) == ((1.0, -2.1),)
    assert numbers(np.array([3.14, 2.96])) == (3.1, 3.0)


def test_the_last_leg_tells_who_was_hit() -> None:
    hit = part("continue", 2, 20.0, hit=9)
    found = rollouts([simulated(FIRST, hit), simulated(FIRST), simulated()], 50.0)
    assert [one.collided_with for one in found] == [9, None, None]
    assert (found[2].path, found[2].speed, found[2].actions) == ((), (), ())


def state(x: float, y: float = 0.0, speed: float = 5.0) -> VehicleState:
    return VehicleState((x, y), 0.0, speed, 0.5, LENGTH, WIDTH)


def track(*places: tuple[float, float], speed: float = 5.0) -> Track:
    count = len(places)
    return Track(40.0, places, (0.0,) * count, (speed,) * count)


def moment(scene: dict[int, VehicleState], **more: Any) -> Moment:
    history = {name: track(one.position, speed=one.speed) for name, one in scene.items()}
    root = Root(on_lane(CORNER, "in_0", scene[0].position[0], scene[0].speed))
    known: dict[str, Any] = {"number": 3, "time": 40.0, "scene": scene, "history": history}
    return Moment(**{**known, "root": root, **more})


def frame(edge: str = "on", position: float = 100.0, **known: Any) -> Frame:
    settings = Settings(rollouts=4, min_rollouts=0, **known)
    return Frame(CORNER, EgoGoal(edge, position, None), settings, 12, "car")


def test_in_a_crowd_the_goals_of_the_nearest_are_recognised() -> None:
    far = {k: state(50.0, 100.0 + 10.0 * ((7 * k) % 20)) for k in range(1, 21)}
    found = predict(frame(), moment({0: state(50.0), **far}))
    nearest = sorted(far, key=lambda k: far[k].position[1])[:16]
    assert list(found) == sorted(nearest)


def test_whose_pace_was_that_of_another_may_want_to_drive_faster() -> None:
    steady = track(*((40.0 + 1.2 * k, 0.0) for k in range(20)), speed=6.0)
    scene = {0: state(10.0), 1: state(62.8, speed=6.0)}
    history = {0: track((10.0, 0.0)), 1: steady}
    top = {}
    for name, unpaced in (("own", frozenset[int]()), ("another's", frozenset({1}))):
        known = predict(frame(), moment(scene, history=history, unpaced=unpaced))[1]
        top[name] = max(float(np.max(w.motion.speed)) for b in known for w in b.trajectories)
    assert top == pytest.approx({"own": 6.5, "another's": 13.0}, abs=0.2)


def test_a_search_is_prepared_for_the_car() -> None:
    known = prepare(
        frame(horizon=25.0, view_radius=80.0, reacting=True), moment({0: state(30.0)}), {}, "/x"
    )
    task = known.task
    assert (task.goal, task.size) == (EgoGoal("on", 100.0, None), (LENGTH, WIDTH))
    assert (task.start, task.horizon, task.view) == (40.0, 125, 80.0)
    assert (task.reacting, task.yielding) == (True, False)
    assert known.seed == "12/3/x"
    assert not prepare(frame(), moment({0: state(30.0)}), {}).task.reacting


def test_a_goal_far_away_is_aimed_at_by_a_place_on_the_way() -> None:
    near, far = (
        decide(frame(position=p), moment({0: state(10.0, speed=13.0)})).trace for p in (90.0, 285.0)
    )
    assert near.waypoint is None
    # 20 s at 13 m/s are 260 m: from 10 m to 270 m, 160 m into the road beyond.
    assert far.waypoint is not None
    assert far.waypoint.edge == "on"
    assert far.waypoint.position == pytest.approx(160.0, abs=1.0)
    assert far.goal == EgoGoal("on", 285.0, None)


def test_a_decision_is_recorded_with_what_it_was_taken_from() -> None:
    scene = {0: state(10.0), 2: state(60.0, speed=8.0), 1: state(90.0, speed=9.0)}
    decision = decide(frame(), moment(scene, unseen={2: 38.5}))
    trace = decision.trace
    assert (trace.sim_time, trace.decision, trace.seed, trace.vehicle) == (40.0, 3, 12, "car")
    assert list(trace.scene) == list(trace.history) == [0, 1, 2]
    assert trace.unseen == {2: 38.5}
    assert trace.under_way is None
    assert trace.network == "drawn"
    assert sorted(known.vehicle for known in trace.predictions) == [1, 2]
    for known in trace.predictions:
        beliefs = decision.beliefs[known.vehicle]
        assert [g.kind for g in known.goals] == [b.goal.kind for b in beliefs]
        for goal, belief in zip(known.goals, beliefs, strict=True):
            assert goal.edge == (belief.goal.target.edge if belief.goal.target else None)
            assert goal.likelihood == round(belief.likelihood, 6)  # to the millionth
            assert goal.probability == round(belief.probability, 6)
            assert goal.indicators == round(belief.indicators, 4)
            for way, other in zip(goal.trajectories, belief.trajectories, strict=True):
                there = ~np.isnan(other.motion.position[:, 0])
                assert len(way.path) == len(way.speed) == int(np.sum(there))
                assert way.path[0] == scene[known.vehicle].position
    assert {tuple(sample.vehicle for sample in r.samples) for r in trace.rollouts} == {(1, 2)}


def test_where_the_car_is_can_be_told_from_its_pose() -> None:
    here = VehicleState((50.0, 0.5), 0.1, 7.0, -0.5, LENGTH, WIDTH)
    aside: Any = pytest.approx(0.5)
    place = Location("road_0", 50.0, aside)
    assert root_at(ROAD, here, 40.0) == Situation(40.0, (50.0, 0.5), 0.1, 7.0, -0.5, place)
    assert root_at(ROAD, replace(here, position=(50.0, 40.0)), 40.0) is None
