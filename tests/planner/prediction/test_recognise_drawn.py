"""Recognition on roads drawn by hand: what must hold of any track, and values on paper."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.motion.forward import DT
from planner.motion.surroundings import Others, Surroundings
from planner.motion.tracks import Observed, Side
from planner.prediction.goals import Goal
from planner.prediction.onward import trajectories_to
from planner.prediction.recognise import Belief, recognise
from planner.record.trace import EgoGoal, Settings
from planner.roads.trajectory import Roads
from planner.rollouts.rollout import Task
from planner.traffic_lights.signals import DARK
from tests.planner.drives import SIZE, avenue, corner, eastward, seen, turned

CORNER = corner()
STEPS = 150  # 30 s
SEVERAL = settings(max_examples=12, deadline=None, derandomize=True)


def beliefs(
    *tracks: Observed,
    roads: Roads = CORNER,
    planned: Settings | None = None,
    time: float = 40.0,
) -> dict[int, tuple[Belief, ...]]:
    """What is recognised of vehicles; none is the ego."""
    return recognise(roads, tracks, planned or Settings(), time, 0)


def chances(found: Sequence[Belief]) -> dict[str, float]:
    return {belief.goal.kind: belief.probability for belief in found}


def braking(x: float, speed: float, by: float, samples: int, y: float = 0.0) -> Observed:
    """A vehicle that has come to x [m] and to a speed, having slowed down by so much [m/s]."""
    speeds = np.linspace(speed + by, speed, samples).tolist()
    return eastward(x, speeds, y)


@st.composite
def tracks(draw: st.DrawFn) -> Observed:
    """A vehicle before the corner or in it, that has driven at any speed."""
    one = braking(
        draw(st.floats(20.0, 104.0)),
        draw(st.floats(0.0, 13.0)),
        draw(st.floats(-3.0, 3.0)),
        draw(st.integers(1, 20)),
        draw(st.floats(-0.8, 0.8)),
    )
    sides: list[Side] = draw(st.lists(st.sampled_from(["left", "right"]), max_size=1))
    return replace(one, speed=np.maximum(one.speed, 0.0), indicating=frozenset(sides))


@SEVERAL
@given(tracks())
def test_beliefs_are_distributions(track: Observed) -> None:
    found = beliefs(track)[1]
    assert sum(belief.probability for belief in found) == pytest.approx(1.0)
    assert len({belief.goal.place for belief in found}) == len(found)
    for belief in found:
        assert 0.0 < belief.probability <= 1.0
        assert 0.0 < belief.likelihood <= belief.indicators <= 1.0
        assert sum(way.probability for way in belief.trajectories) == pytest.approx(1.0)
        for way in belief.trajectories:
            assert len(way.motion.speed) == len(way.motion.position) == STEPS + 1
            assert way.motion.position[0] == pytest.approx(track.position[-1], abs=0.02)
            assert way.motion.speed[0] == pytest.approx(track.speed[-1])


@SEVERAL
@given(tracks())
def test_goals_are_weighed_by_prior_and_likelihood(track: Observed) -> None:
    first, *others = beliefs(track)[1]
    weight = first.probability / (first.goal.prior * first.likelihood)
    for other in others:
        known = other.goal.prior * other.likelihood
        assert other.probability == pytest.approx(weight * known)
    for belief in beliefs(track, planned=Settings(recognition=False))[1]:
        assert (belief.likelihood, belief.indicators) == (1.0, 1.0)


@SEVERAL
@given(tracks(), st.sampled_from([0.4, 1.3, -2.0]), st.floats(0.0, 500.0))
def test_neither_the_compass_nor_the_clock_matters(
    track: Observed, angle: float, time: float
) -> None:
    points = [turned((x, y), angle) for x, y in track.position.tolist()]
    other = replace(track, position=np.array(points), heading=track.heading + angle)
    one = chances(beliefs(track)[1])
    assert chances(beliefs(other, roads=corner(angle), time=time)[1]) == pytest.approx(
        one, abs=0.01
    )


@SEVERAL
@given(st.permutations([1, 2, 3]), st.floats(3.0, 12.0), st.floats(6.0, 20.0))
def test_the_order_of_vehicles_that_drive_does_not_matter(
    order: list[int], speed: float, gap: float
) -> None:
    row = [replace(eastward(90.0 - gap * k, [speed + k, speed]), vehicle=k) for k in (1, 2, 3)]
    plain = beliefs(*row)
    other = beliefs(*(row[k - 1] for k in order))
    assert list(other) == order
    for vehicle, found in plain.items():
        assert chances(other[vehicle]) == chances(found)


@SEVERAL
@given(tracks(), st.integers(2, 50))
def test_neither_names_nor_who_has_driven_off_matter(track: Observed, name: int) -> None:
    alone = beliefs(track)[1]
    gone = replace(seen([(108.0, -200.0)], [9.0], -0.5 * math.pi), vehicle=77)
    found = beliefs(gone, replace(track, vehicle=name))
    assert list(found) == [77, name]
    assert chances(found[name]) == pytest.approx(chances(alone))
    assert {way.motion.vehicle for b in found[name] for way in b.trajectories} == {name}


def driven_for(found: Sequence[Belief], kind: str) -> float:
    """How well a goal explains what was driven, whatever the indicators say."""
    return sum(b.likelihood / b.indicators for b in found if b.goal.kind == kind)


@SEVERAL
@given(st.floats(12.0, 13.0), st.floats(97.0, 99.0), st.integers(8, 20))
def test_who_is_too_fast_to_turn_does_not_turn(speed: float, x: float, samples: int) -> None:
    # With 12 m/s2 of grip, a bend of 8 m is taken at 9.8 m/s at most.
    found = chances(beliefs(eastward(x, [speed] * samples))[1])
    assert "exit-right" not in found
    assert found["continue"] > 0.9


@SEVERAL
@given(st.floats(90.0, 98.0), st.floats(5.0, 6.0), st.floats(5.0, 7.0))
def test_who_slows_down_to_the_speed_of_the_bend_turns(x: float, speed: float, by: float) -> None:
    found = beliefs(braking(x, speed, by, 16))[1]
    assert driven_for(found, "exit-right") > 3.0 * driven_for(found, "continue")


@SEVERAL
@given(st.floats(2.0, 12.0), st.floats(20.0, 60.0))
def test_what_lies_behind_is_no_goal(speed: float, beyond: float) -> None:
    found = beliefs(eastward(110.0 + beyond, [speed] * 5))[1]
    assert {belief.goal.kind for belief in found} <= {"continue", "stop"}


@pytest.mark.parametrize("steady", [False, True])
def test_a_vehicle_seen_once_has_its_priors(steady: bool) -> None:
    found = beliefs(eastward(20.0, [10.0]), planned=Settings(recognition=not steady))[1]
    assert {b.goal.kind: b.goal.prior for b in found} == {
        "exit-right": 0.495, "continue": 0.495, "stop": 0.01
    }  # fmt: skip


def test_a_goal_without_a_way_or_of_hardly_any_chance_is_none() -> None:
    naive = Settings(recognition=False)
    fast = beliefs(eastward(98.0, [12.5] * 8), planned=naive)[1]
    # Nobody can take the bend; the others share what is left by their priors.
    assert chances(fast) == pytest.approx({"continue": 0.495 / 0.505, "stop": 0.01 / 0.505})
    lit = replace(braking(97.0, 5.3, 6.0, 16), indicating=frozenset[Side]({"right"}))
    assert chances(beliefs(lit)[1]) == {"exit-right": 1.0}


def test_who_has_driven_slowly_for_long_is_not_expected_to_hurry() -> None:
    slow, short = (beliefs(eastward(60.0, [6.0] * n))[1] for n in (16, 15))
    top = [
        max(float(np.max(way.motion.speed)) for b in found for way in b.trajectories)
        for found in (slow, short)
    ]
    assert top == pytest.approx([6.5, 13.0], abs=0.1)


def test_stopping_is_braking_comfortably_and_standing_from_then_on() -> None:
    (stop,) = [b for b in beliefs(eastward(20.0, [8.0] * 3))[1] if b.goal.kind == "stop"]
    (way,) = stop.trajectories
    assert (way.probability, way.actions, way.held_up) == (1.0, ("stop",), ())
    position, speed = way.motion.position, way.motion.speed
    # From 8 m/s at 2 m/s2: 16 m in 4 s; the brakes take a while to grip and to let go.
    assert position[-1].tolist() == pytest.approx([36.0 + 2.0, 0.0], abs=3.0)
    assert speed[19] < 3.0
    assert np.all(np.diff(speed) <= 1e-9)
    assert np.all(speed[50:] < 0.01)
    assert np.ptp(position[60:, 0]) < 0.05
    assert way.motion.heading.tolist() == [0.0] * (STEPS + 1)
    assert way.motion.links == frozenset()
    assert (way.motion.vehicle, way.motion.length, way.motion.width) == (1, *SIZE)


def test_stopping_is_a_goal_before_and_beyond_a_junction_but_not_in_it() -> None:
    found = {x: beliefs(eastward(x, [8.0] * 3))[1] for x in (70.0, 85.0, 105.5)}
    naive = Settings(recognition=False)
    known = {x: set(chances(beliefs(eastward(x, [8.0] * 3), planned=naive)[1])) for x in found}
    assert known == {
        70.0: {"exit-right", "continue", "stop"},
        85.0: {"exit-right", "continue"},
        105.5: {"continue", "stop"},
    }
    (stop,) = [
        b for b in beliefs(eastward(105.5, [8.0]), planned=naive)[1] if b.goal.kind == "stop"
    ]
    assert stop.trajectories[0].motion.links == {("J", 1)}


def on(
    roads: Roads, x: float, speed: float, rationality: float
) -> list[tuple[float, tuple[str, ...]]]:
    """The ways to a place 200 m on, with their probabilities."""
    track = eastward(x, [speed])
    starts = track.situation(roads, -1, 40.0)
    frame = Task(roads, EgoGoal("", 0.0, None), SIZE, 40.0, STEPS, 100.0, yielding=True)
    goal = Goal("continue", "there", EgoGoal("road", x + 200.0, None), 1.0)
    known = Settings(rationality=rationality)
    nobody = Others(Surroundings(roads, DARK, STEPS), ())
    ways = trajectories_to(frame, starts, goal, track, nobody, known)
    return [(way.probability, way.actions) for way in ways]


@pytest.mark.parametrize("rationality", [0.5, 1.0, 1.5])
def test_ways_to_a_goal_share_its_probability_by_their_costs(rationality: float) -> None:
    # Changing lanes costs 3 s.
    other = math.exp(-3.0 * rationality)
    found = on(avenue(limit=10.0), 100.0, 10.0, rationality)
    assert [actions for _, actions in found] == [("continue",), ("change-left", "continue")]
    assert found[0][0] == pytest.approx(1.0 / (1.0 + other), rel=0.01)
    assert found[1][0] == pytest.approx(other / (1.0 + other), rel=0.05)


def test_a_way_that_hardly_anybody_takes_is_dropped() -> None:
    assert on(avenue(limit=10.0), 100.0, 10.0, 1.6) == [(1.0, ("continue",))]


def test_no_way_leads_past_the_end() -> None:
    assert on(avenue(length=200.0), 100.0, 10.0, 1.5) == []


@pytest.mark.parametrize(("behind", "waits"), [(25.0, True), (30.0, True), (60.0, False)])
def test_who_stands_and_cannot_move_out_now_waits(behind: float, waits: bool) -> None:
    roads, track = avenue(), eastward(150.0, [0.0] * 10)
    frame = Task(roads, EgoGoal("", 0.0, None), SIZE, 40.0, STEPS, 100.0, yielding=True)
    surroundings = Surroundings(roads, DARK, STEPS)
    other = surroundings.coast(eastward(150.0 - behind, [12.0] * 10, 3.5, vehicle=2))
    goal = Goal("continue", "there", EgoGoal("road", 250.0, 1), 1.0)
    starts = track.situation(roads, -1, 40.0)
    (way,) = trajectories_to(frame, starts, goal, track, Others(surroundings, (other,)), Settings())
    assert (float(np.max(way.motion.speed)) < 0.1) == waits
    assert bool(np.all(way.motion.position[:, 1] < 0.1)) == waits


def test_a_vehicle_off_the_road_coasts_from_now_on() -> None:
    track = seen([(50.0, 80.0), (51.0, 80.0), (52.0, 80.0)], [5.0] * 3)
    (belief,) = beliefs(track)[1]
    assert belief.goal == Goal("continue", "the road straight on", None, 1.0)
    assert (belief.likelihood, belief.probability, belief.indicators) == (1.0, 1.0, 1.0)
    (way,) = belief.trajectories
    assert (way.probability, way.actions) == (1.0, ("continue",))
    assert way.motion.position[:, 0].tolist() == pytest.approx(
        [52.0 + 5.0 * DT * k for k in range(STEPS + 1)]
    )


def test_within_a_junction_with_no_time_for_anything_one_just_goes_on() -> None:
    (belief,) = beliefs(eastward(101.0, [5.0]), planned=Settings(horizon=1.0))[1]
    assert belief.goal.target is None
    assert (belief.goal.kind, belief.probability) == ("continue", 1.0)
    assert belief.trajectories[0].motion.position[:, 0].tolist() == pytest.approx(
        [101.0 + k for k in range(6)]
    )
