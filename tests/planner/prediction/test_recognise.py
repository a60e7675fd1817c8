from collections.abc import Mapping, Sequence

import numpy as np
import pytest

from planner.prediction.goals import STOP_PRIOR, goals_in_view, stopping_time
from planner.prediction.indication import MEANT, SHOWN, WRONG
from planner.prediction.recognise import Belief
from planner.record.trace import Settings, Track
from planner.search.decide import predict
from sim.scene import VehicleState
from tests.planner.worlds import (
    LENGTH,
    VIEW,
    WIDTH,
    Seen,
    before_end,
    changing,
    driven,
    frame,
    link,
    moment,
    roads,
    row,
    situation,
    still,
)

EGO = {
    "s1": still("s1", ("main_in_0",), before_end("s1", "main_in_0", 100.0)),
    "s2": still("s2", ("south_in_0",), before_end("s2", "south_in_0", 50.0)),
}
NAIVE = Settings(recognition=False)


def beliefs(
    name: str, others: Mapping[int, Seen], settings: Settings | None = None
) -> dict[int, tuple[Belief, ...]]:
    return predict(frame(name, settings or Settings()), moment(name, {0: EGO[name], **others}))


def probability(found: Sequence[Belief], kind: str) -> float:
    return sum(belief.probability for belief in found if belief.goal.kind == kind)


def changed(samples: int) -> Seen:
    """A vehicle on the left lane of s1 that began to change right some samples ago."""
    line = changing("s1", "main_in_1", "main_in_0", before_end("s1", "main_in_1", 80.0))
    speeds = [8.0] * samples
    return driven(line, 8.0 * 0.2 * (samples - 1), speeds)


def waiting(standing: float) -> Seen:
    """A vehicle of s2 that came from the west and stands [s] in the junction to turn left."""
    lanes = row("s2", "west_in_0", "left")
    line = roads("s2").line(lanes)
    place = dict(line.lanes)[lanes[2]] - 0.5
    braking = np.linspace(10.0, 0.0, 20).round(2).tolist()
    return driven(line, place, [10.0] * 5 + braking + [0.0] * round(standing / 0.2))


def oncoming(samples: int = 30) -> Seen:
    """A vehicle that comes to the junction of s2 from the east."""
    line = roads("s2").line(row("s2", "east_in_0", "straight"))
    return driven(line, before_end("s2", "east_in_0", 40.0), [12.0] * samples)


def test_the_goals_are_the_exits_in_view_and_stopping() -> None:
    here = situation("s1", "main_in_0", before_end("s1", "main_in_0", 60.0))
    goals = goals_in_view(roads("s1"), (here,), VIEW)
    assert {goal.kind for goal in goals} == {"exit-right", "continue", "exit-left", "stop"}
    assert goals[-1].kind == "stop"
    assert goals[-1].prior == STOP_PRIOR
    assert sum(goal.prior for goal in goals) == pytest.approx(1.0)
    assert {goal.target.edge for goal in goals if goal.target} == {
        link("s1", lane, direction).to_lane.rsplit("_", 1)[0]
        for lane, direction in (
            ("main_in_0", "right"),
            ("main_in_0", "straight"),
            ("main_in_1", "left"),
        )
    }


def test_far_from_a_junction_one_goes_on_or_stops() -> None:
    here = situation("s1", "main_in_0", before_end("s1", "main_in_0", VIEW + 20.0))
    goals = goals_in_view(roads("s1"), (here,), VIEW)
    assert [goal.kind for goal in goals] == ["continue", "stop"]


def test_inside_a_junction_the_way_that_is_driven_is_the_goal() -> None:
    way = link("s2", "west_in_0", "left")
    goals = goals_in_view(roads("s2"), (situation("s2", way.via[-1], 5.0),), VIEW)
    assert [goal.kind for goal in goals] == ["exit-left", "stop"]


def test_the_time_to_stop_somewhere() -> None:
    # From rest over 100 m with 2 m/s2 either way: sqrt(100 / 2) * 2 = 14.14 s.
    assert stopping_time(100.0, 0.0, 50.0, 2.0, 2.0) == pytest.approx(2.0 * 50.0**0.5 * 1.0, 0.01)
    # With a limit of 10 m/s: 5 s up, 5 s down over 50 m in all, 5 s for the rest.
    assert stopping_time(100.0, 0.0, 10.0, 2.0, 2.0) == pytest.approx(15.0)
    # From 10 m/s the braking distance is 25 m and takes 5 s.
    assert stopping_time(25.0, 10.0, 20.0, 2.0, 2.0) == pytest.approx(5.0)


@pytest.mark.parametrize("samples", [1, 3, 8, 15])
@pytest.mark.parametrize("settings", [Settings(), NAIVE])
def test_probabilities_sum_to_one(samples: int, settings: Settings) -> None:
    found = beliefs("s1", {1: changed(samples)}, settings)[1]
    assert sum(belief.probability for belief in found) == pytest.approx(1.0)
    for belief in found:
        assert 0.0 < belief.probability <= 1.0
        assert 0.0 <= belief.likelihood <= 1.0
        assert sum(way.probability for way in belief.trajectories) == pytest.approx(1.0)


def test_of_a_vehicle_seen_once_only_the_lights_speak() -> None:
    found = beliefs("s1", {1: changed(1)})[1]
    likelihoods = {belief.goal.kind: belief.likelihood for belief in found}
    assert likelihoods["continue"] == likelihoods["stop"] == 1.0 - 2.0 * MEANT[False]
    assert likelihoods["exit-right"] == pytest.approx(1.0 - SHOWN[1] - WRONG)
    total = sum(belief.goal.prior * belief.likelihood for belief in found)
    for belief in found:
        known = belief.goal.prior * belief.likelihood / total
        assert belief.probability == pytest.approx(known)


@pytest.mark.parametrize("samples", [1, 5, 15])
def test_without_recognition_goals_keep_their_prior(samples: int) -> None:
    for belief in beliefs("s1", {1: changed(samples)}, NAIVE)[1]:
        assert belief.probability == pytest.approx(belief.goal.prior)


def test_a_change_to_the_right_lane_foretells_the_exit_right() -> None:
    course = [probability(beliefs("s1", {1: changed(n)})[1], "exit-right") for n in (1, 3, 6, 12)]
    assert course[0] < 0.4
    assert max(course) == course[-1]
    assert course[-2] > 0.7


def test_a_lane_change_is_part_of_the_way_that_is_foreseen() -> None:
    (right,) = [b for b in beliefs("s1", {1: changed(4)})[1] if b.goal.kind == "exit-right"]
    assert right.trajectories[0].actions == ("change-right", "exit-right")
    motion = right.trajectories[0].motion
    there = ~np.isnan(motion.position[:, 0])
    south = roads("s1").network.lanes["exit_s_0"].centreline[0]
    assert np.min(np.hypot(*(motion.position[there] - np.array(south)).T)) < 3.0
    assert motion.links == {("J", link("s1", "main_in_0", "right").index)}


@pytest.mark.parametrize("standing", [0.4, 2.0, 4.0])
def test_who_waits_inside_the_junction_turns_left(standing: float) -> None:
    found = beliefs("s2", {1: waiting(standing), 2: oncoming()})[1]
    assert max(found, key=lambda belief: belief.probability).goal.kind == "exit-left"
    assert probability(found, "exit-left") > 0.7


def test_who_waits_to_turn_left_is_foreseen_to_let_the_oncoming_pass() -> None:
    world = moment("s2", {0: EGO["s2"], 1: waiting(2.0), 2: oncoming()}, time=5.0)
    (left,) = [b for b in predict(frame("s2", Settings()), world)[1] if b.goal.kind == "exit-left"]
    for way in left.trajectories:
        first = way.held_up[0]
        assert (first.vehicle, first.how) == (2, "right-of-way")
        assert first.since == 5.0 < first.until
        after = round((first.until - 5.0) / 0.2)
        assert float(np.max(way.motion.speed[: after - 1])) < 2.0


def test_the_ego_is_one_of_those_who_hold_up() -> None:
    line = roads("s1").line(row("s1", "main_in_0", "straight"))
    here = before_end("s1", "main_in_0", 80.0)
    ego = driven(line, here, [4.0] * 10)
    follower = driven(line, here - LENGTH - 12.0, [10.0, 9.5, 9.0, 8.5, 8.0])
    found = predict(frame("s1", Settings()), moment("s1", {0: ego, 1: follower}))[1]
    (onward,) = [belief for belief in found if belief.goal.kind == "continue"]
    assert {(h.vehicle, h.how) for h in onward.trajectories[0].held_up} == {(0, "leader")}


def test_on_a_free_road_nobody_holds_up() -> None:
    ways = [way for belief in beliefs("s1", {1: changed(1)})[1] for way in belief.trajectories]
    assert ways
    assert all(way.held_up == () for way in ways)


def test_standing_inside_a_junction_is_nobodys_goal() -> None:
    assert probability(beliefs("s2", {1: waiting(4.0), 2: oncoming()})[1], "stop") == 0.0


@pytest.mark.parametrize("away", [60.0, 40.0, 25.0, 12.0])
def test_nobody_with_priority_is_foreseen_to_brake_for_the_ego(away: float) -> None:
    line = roads("s2").line(("west_in_0",))
    steady = driven(line, before_end("s2", "west_in_0", away), [9.0] * 20)
    ego = still("s2", ("south_in_0",), before_end("s2", "south_in_0", 15.0), 7.0)
    found = predict(frame("s2", Settings()), moment("s2", {0: ego, 1: steady}))[1]
    (onward,) = [belief for belief in found if belief.goal.kind == "continue"]
    assert onward.probability > 0.02
    motion = onward.trajectories[0].motion
    there = ~np.isnan(motion.position[:, 0])
    assert np.min(motion.speed[there]) >= 9.0


def test_a_goal_is_not_ruled_out_by_who_is_in_the_way() -> None:
    line = roads("s1").line(row("s1", "main_in_0", "straight"))
    here = before_end("s1", "main_in_0", 60.0)
    blocked = driven(line, here, [10.0] * 5)
    parked = driven(line, here + LENGTH + 3.0, [0.0] * 5)
    found = beliefs("s1", {1: blocked, 2: parked})[1]
    assert {belief.goal.kind for belief in found} >= {"continue", "exit-right"}


def test_a_foreseen_motion_begins_where_the_vehicle_is() -> None:
    seen = changed(8)
    for belief in beliefs("s1", {1: seen})[1]:
        for way in belief.trajectories:
            assert way.motion.position[0] == pytest.approx(seen.state.position, abs=0.05)
            assert way.motion.speed[0] == pytest.approx(8.0)
            steps = np.hypot(*np.diff(way.motion.position, axis=0).T)
            assert np.nanmax(steps) < 14.0 * 0.2 + 0.2


def test_a_vehicle_off_the_road_goes_on_as_it_does() -> None:
    place, heading = (-40.0, 60.0), 0.3
    state = VehicleState(place, heading, 2.0, 0.0, LENGTH, WIDTH)
    parked = Seen(state, Track(0.0, (place,), (heading,), (2.0,)))
    (belief,) = beliefs("s1", {1: parked})[1]
    assert (belief.goal.kind, belief.probability) == ("continue", 1.0)
    motion = belief.trajectories[0].motion
    assert np.all(np.isfinite(motion.position))
    assert motion.position[5] == pytest.approx(
        (place[0] + 2.0 * np.cos(heading), place[1] + 2.0 * np.sin(heading))
    )


def test_the_ego_is_not_predicted() -> None:
    assert beliefs("s1", {}) == {}
    assert list(beliefs("s2", {1: waiting(1.0), 2: oncoming()})) == [1, 2]


def test_equal_tracks_give_equal_beliefs() -> None:
    one, other = (beliefs("s1", {1: changed(8)})[1] for _ in range(2))
    assert [belief.probability for belief in one] == [belief.probability for belief in other]


def test_a_queue_dissolves_from_its_head_on() -> None:
    line = roads("s2").line(row("s2", "west_in_0", "straight"))
    end = before_end("s2", "west_in_0", 0.5)
    queue = {k: driven(line, end - 8.0 * (k - 1), [0.0] * 10) for k in (1, 2, 3)}
    # The head means to turn left in front of one that comes towards it, and waits.
    queue[1] = waiting(2.0)
    oncoming = still("s2", ("east_in_0",), before_end("s2", "east_in_0", 40.0), 12.0)
    found = beliefs("s2", {**queue, 4: oncoming})
    leaving = {}
    for vehicle in queue:
        (turning,) = (b for b in found[vehicle] if b.goal.kind == "exit-left")
        leaving[vehicle] = int(np.argmax(turning.trajectories[0].motion.position[:, 0] > -3.0))
    assert 0 < leaving[1] < leaving[2] < leaving[3]
