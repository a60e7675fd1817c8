import itertools
import math
from collections.abc import Mapping

import pytest

from planner.record.trace import (
    ACTIONS,
    COMPONENTS,
    ROOM,
    SAMPLE_PERIOD,
    PlanTrace,
    Rollout,
    Settings,
    encode,
)
from planner.record.trace_reading import decode
from planner.search.decide import decide
from tests.planner.worlds import (
    Seen,
    before_end,
    changing,
    driven,
    frame,
    moment,
    roads,
    row,
    still,
)

EGO = {
    "s1": still("s1", ("main_in_0",), before_end("s1", "main_in_0", 95.0)),
    "s2": still("s2", ("south_in_0",), before_end("s2", "south_in_0", 40.0)),
}
CUTS_IN = changing("s1", "main_in_1", "main_in_0", before_end("s1", "main_in_1", 85.0))


def along(name: str, lane: str, away: float, speed: float, samples: int = 10) -> Seen:
    """A vehicle at a distance [m] before the end of a lane, at a steady speed."""
    line = roads(name).line((lane,))
    return driven(line, before_end(name, lane, away), [speed] * samples)


WORLDS: dict[str, tuple[str, dict[int, Seen]]] = {
    "cut in": ("s1", {1: driven(CUTS_IN, 12.0, [8.0] * 8), 2: along("s1", "from_s_0", 20.0, 5.0)}),
    "minor road": (
        "s2",
        {1: along("s2", "west_in_0", 30.0, 9.0), 2: along("s2", "east_in_0", 60.0, 12.0)},
    ),
    "alone": ("s1", {}),
    "queue": ("s1", {3: along("s1", "main_in_0", 65.0, 0.0, samples=30)}),
    "too late to brake": ("s1", {3: along("s1", "main_in_0", 87.0, 0.0)}),
}


def decision(world: str, settings: Settings | None = None, seed: int = 0) -> PlanTrace:
    name, others = WORLDS[world]
    constant = frame(name, settings or Settings(rollouts=60, min_rollouts=10), seed)
    return decide(constant, moment(name, {0: EGO[name], **others}, time=4.0, number=7)).trace


@pytest.fixture(scope="module", params=WORLDS)
def trace(request: pytest.FixtureRequest) -> PlanTrace:
    return decision(request.param)


def line(trace: PlanTrace, rollout: Rollout) -> Rollout:
    """The rollout that holds the path."""
    return rollout if rollout.same_as is None else trace.rollouts[rollout.same_as]


def test_rollouts_are_numbered_and_lines_recorded_once(trace: PlanTrace) -> None:
    assert [rollout.index for rollout in trace.rollouts] == list(range(len(trace.rollouts)))
    recorded = []
    for rollout in trace.rollouts:
        if rollout.same_as is None:
            assert rollout.path is not None
            assert rollout.speed is not None
            recorded.append((rollout.path, rollout.speed))
        else:
            assert rollout.path is rollout.speed is None
            assert rollout.same_as < rollout.index
            assert trace.rollouts[rollout.same_as].same_as is None
    assert len(set(recorded)) == len(recorded)


def test_the_length_of_a_path_is_that_of_the_drive(trace: PlanTrace) -> None:
    for rollout in trace.rollouts:
        where = line(trace, rollout)
        assert where.path is not None
        assert where.speed is not None
        assert len(where.path) == len(where.speed)
        assert where.path[0] == pytest.approx(trace.scene[0].position, abs=0.1)
        lasted = (len(where.path) - 1) * SAMPLE_PERIOD
        assert lasted <= trace.settings.horizon + 1e-6
        if rollout.components["time"] is not None:
            assert lasted - SAMPLE_PERIOD - 0.01 <= rollout.components["time"] <= lasted + 0.01
        starts = [action.start for action in rollout.actions]
        assert starts[0] == trace.sim_time
        assert all(a < b for a, b in itertools.pairwise(starts))
        assert starts[-1] <= trace.sim_time + lasted


def test_components_belong_to_rollouts_that_are_done(trace: PlanTrace) -> None:
    for rollout in trace.rollouts:
        assert tuple(rollout.components) == COMPONENTS
        present = [value is not None for value in rollout.components.values()]
        assert all(present) if rollout.outcome == "done" else not any(present)
        assert math.isfinite(rollout.reward)
        assert all(value is None or value >= 0.0 for value in rollout.components.values())


def test_collisions_name_the_vehicle_and_nothing_else_does(trace: PlanTrace) -> None:
    for rollout in trace.rollouts:
        assert (rollout.collided_with is not None) == (rollout.outcome == "collision")
        assert rollout.collided_with is None or rollout.collided_with in trace.scene


def test_hold_ups_lie_within_the_drive(trace: PlanTrace) -> None:
    for rollout in trace.rollouts:
        path = line(trace, rollout).path
        assert path is not None
        end = trace.sim_time + (len(path) - 1) * SAMPLE_PERIOD
        for stretch in rollout.held_up:
            assert stretch.vehicle in trace.scene
            assert stretch.vehicle != 0
            assert trace.sim_time <= stretch.since < stretch.until <= end + SAMPLE_PERIOD
            assert 0.0 <= stretch.speed_to <= stretch.speed_from


def test_every_reference_leads_somewhere(trace: PlanTrace) -> None:
    predicted = {prediction.vehicle: prediction for prediction in trace.predictions}
    assert sorted(predicted) == [vehicle for vehicle in trace.scene if vehicle != 0]
    prefixes = {()} | {
        tuple(action.action for action in rollout.actions[:k])
        for rollout in trace.rollouts
        for k in range(1, len(rollout.actions) + 1)
    }
    for rollout in trace.rollouts:
        assert [sample.vehicle for sample in rollout.samples] == sorted(predicted)
        for sample in rollout.samples:
            goal = predicted[sample.vehicle].goals[sample.goal]
            assert goal.trajectories[sample.trajectory].probability > 0.0
    assert {entry.node for entry in trace.not_applicable} <= prefixes


def test_predictions_are_distributions(trace: PlanTrace) -> None:
    for prediction in trace.predictions:
        assert sum(goal.probability for goal in prediction.goals) == pytest.approx(1.0, abs=1e-5)
        for goal in prediction.goals:
            total = sum(way.probability for way in goal.trajectories)
            assert total == pytest.approx(1.0, abs=1e-5)
            for way in goal.trajectories:
                assert len(way.path) == len(way.speed) >= 1


def test_each_first_action_is_refused_or_tried_often_enough(trace: PlanTrace) -> None:
    refused = {entry.action for entry in trace.not_applicable if entry.node == ()}
    for action in ACTIONS:
        tried = sum(1 for rollout in trace.rollouts if rollout.actions[0].action == action)
        assert tried == 0 if action in refused else tried >= trace.settings.min_rollouts
    drawn = [rollout for rollout in trace.rollouts if not rollout.forced]
    assert len(drawn) == trace.settings.rollouts


def test_the_plan_is_what_the_search_found_best(trace: PlanTrace) -> None:
    drawn = [rollout for rollout in trace.rollouts if not rollout.forced]
    actions = [tuple(step.action for step in rollout.actions) for rollout in drawn]
    chosen = tuple(step.action for step in trace.plan)
    assert chosen
    for k, step in enumerate(trace.plan, start=1):
        assert step.visits == sum(1 for taken in actions if taken[:k] == chosen[:k])
    if len(chosen) > 1:
        assert trace.plan[-1].value == pytest.approx(
            sum(r.reward for r, taken in zip(drawn, actions, strict=True) if taken == chosen)
            / sum(1 for taken in actions if taken == chosen),
            abs=0.01,
        )


def test_the_first_action_does_best_where_all_are_tried_alike(trace: PlanTrace) -> None:
    tried: dict[str, list[Rollout]] = {}
    for rollout in trace.rollouts:
        assert (rollout.weight is None) or rollout.forced
        if rollout.weight is not None:
            tried.setdefault(rollout.actions[0].action, []).append(rollout)
    samples = [tuple((r.samples, r.weight) for r in found) for found in tried.values()]
    assert len(set(samples)) == 1
    assert sum(weight or 0.0 for _, weight in samples[0]) == pytest.approx(1.0, abs=1e-4)
    means = {a: sum((r.weight or 0.0) * r.reward for r in f) for a, f in tried.items()}
    assert trace.plan[0].value == pytest.approx(max(means.values()), abs=0.01)
    assert means[trace.plan[0].action] == max(means.values())


def test_the_frame_of_the_decision_is_recorded(trace: PlanTrace) -> None:
    assert (trace.sim_time, trace.decision, trace.vehicle, trace.seed) == (4.0, 7, "car", 0)
    assert trace.under_way is None
    assert list(trace.history) == list(trace.scene) == sorted(trace.scene)
    for vehicle, track in trace.history.items():
        assert len(track.position) == len(track.heading) == len(track.speed) >= 1
        assert track.position[-1] == trace.scene[vehicle].position


@pytest.mark.parametrize("world", WORLDS)
def test_the_same_seed_gives_the_same_bytes(world: str) -> None:
    assert encode(decision(world)) == encode(decision(world))


def test_another_seed_draws_other_samples() -> None:
    one, other = (decision("cut in", seed=seed) for seed in (1, 2))
    drawn = [[rollout.samples for rollout in trace.rollouts] for trace in (one, other)]
    assert drawn[0] != drawn[1]
    assert one.predictions == other.predictions


def test_alone_on_the_road_one_goes_on() -> None:
    trace = decision("alone")
    assert trace.predictions == ()
    assert trace.plan[0].action == "continue"
    first = [r for r in trace.rollouts if [a.action for a in r.actions] == ["continue"]]
    assert first
    assert {r.outcome for r in first} == {"done"}
    assert {r.samples for r in trace.rollouts} == {()}
    assert all(r.held_up == () for r in trace.rollouts)


def test_a_queue_ahead_is_not_run_into() -> None:
    trace = decision("queue", Settings())
    assert "collision" not in {r.outcome for r in trace.rollouts}
    assert trace.plan[0].action == "change-left"


def test_what_cannot_be_avoided_is_foreseen() -> None:
    trace = decision("too late to brake")
    going = [r for r in trace.rollouts if r.actions[0].action == "continue"]
    assert {(r.outcome, r.collided_with) for r in going} == {("collision", 3)}


def twelve(name: str) -> Mapping[int, Seen]:
    """Twelve vehicles that have been in view for 10 s, on all roads that lead to the junction."""
    places = {
        "s1": ("main_in_0", "main_in_1", "back_in_0", "from_s_0", "from_n_0"),
        "s2": ("west_in_0", "east_in_0", "north_in_0"),
    }[name]
    seen = {}
    for k in range(12):
        lane = places[k % len(places)]
        ahead = 12.0 * (k // len(places))
        speed = 4.0 + 0.3 * k
        lanes = row(name, lane, ("straight", "right")[k % 2]) if lane != "main_in_1" else (lane,)
        until = before_end(name, lane, 8.0 + ahead)
        seen[k + 1] = driven(roads(name).line(lanes), until, [speed] * 51)
    return seen


@pytest.mark.parametrize("name", ["s1", "s2"])
def test_a_crowd_fits_into_a_trace(name: str) -> None:
    scene = moment(name, {0: EGO[name], **twelve(name)}, time=10.0)
    trace = decide(frame(name, Settings()), scene).trace
    assert len(trace.predictions) == 12
    data = encode(trace)
    assert len(data) <= ROOM
    assert decode(data) == trace
    first = trace.rollouts[0]
    assert first.path is not None  # only the last ones go without
