from dataclasses import replace

import msgspec
import pytest

from planner.counterfactuals.whatif import NotInView, WhatIf, WhatIfError, decide_again, replan
from planner.record.trace import PlanTrace, encode
from planner.search.decide import decide
from sim.roads.network import Network
from tests.planner.worlds import QUICK, before_end, changing, driven, frame, moment, roads, still


@pytest.fixture(scope="module")
def trace() -> PlanTrace:
    """A decision on s1, before which vehicle 1 cuts in, while vehicle 4 waits aside."""
    line = changing("s1", "main_in_1", "main_in_0", before_end("s1", "main_in_1", 85.0))
    waits = roads("s1").line(("from_s_0",))
    scene = {
        0: still("s1", ("main_in_0",), before_end("s1", "main_in_0", 95.0)),
        1: driven(line, 14.0, [5.0] * 8),
        4: driven(waits, before_end("s1", "from_s_0", 2.0), [0.0] * 8),
    }
    return decide(frame("s1", QUICK, seed=5), moment("s1", scene, time=2.0, number=3)).trace


@pytest.fixture(scope="module")
def network() -> Network:
    return roads("s1").network


def test_planning_again_without_a_change_gives_the_same_trace(
    trace: PlanTrace, network: Network
) -> None:
    again = replan(trace, network, WhatIf(rollouts=0))
    assert again.what_if == WhatIf(rollouts=0)
    assert encode(msgspec.structs.replace(again, what_if=None)) == encode(trace)


def test_forced_actions_add_forced_rollouts_and_nothing_else(
    trace: PlanTrace, network: Network
) -> None:
    more = replan(trace, network, WhatIf(("change-left", "exit-left"), rollouts=12))
    assert more.rollouts[: len(trace.rollouts)] == trace.rollouts
    fresh = more.rollouts[len(trace.rollouts) :]
    assert len(fresh) == 12
    for index, rollout in enumerate(fresh, len(trace.rollouts)):
        assert rollout.index == index
        assert rollout.forced
        assert [step.action for step in rollout.actions][:2] == ["change-left", "exit-left"]
        assert rollout.outcome == "dead"
        assert rollout.same_as is None or rollout.same_as >= len(trace.rollouts)
    assert more.plan == trace.plan
    assert more.predictions == trace.predictions
    same = msgspec.structs.replace(
        more, rollouts=trace.rollouts, not_applicable=trace.not_applicable, what_if=None
    )
    assert same == trace


def test_the_same_request_gives_the_same_trace(trace: PlanTrace, network: Network) -> None:
    one, other = (replan(trace, network, WhatIf(("stop",), rollouts=6)) for _ in range(2))
    assert encode(one) == encode(other)


def test_what_does_not_apply_adds_no_rollout_but_its_reason(
    trace: PlanTrace, network: Network
) -> None:
    refused = replan(trace, network, WhatIf(("exit-left",)))
    assert refused.rollouts == trace.rollouts
    reasons = {(e.node, e.action): e.reason for e in refused.not_applicable}
    assert reasons[(), "exit-left"] == "its lane does not lead to the left"
    deep = replan(trace, network, WhatIf(("change-left", "exit-right")))
    assert deep.rollouts == trace.rollouts
    reasons = {(e.node, e.action): e.reason for e in deep.not_applicable}
    assert reasons[("change-left",), "exit-right"] == "its lane does not lead to the right"


def test_a_reason_is_told_once(trace: PlanTrace, network: Network) -> None:
    more = replan(trace, network, WhatIf(("change-left", "continue"), rollouts=5))
    entries = [(e.node, e.action) for e in more.not_applicable]
    assert len(entries) == len(set(entries))


def test_a_removed_vehicle_is_nowhere(trace: PlanTrace, network: Network) -> None:
    without = replan(trace, network, WhatIf(removed=1))
    assert list(without.scene) == list(without.history) == [0, 4]
    assert [prediction.vehicle for prediction in without.predictions] == [4]
    for rollout in without.rollouts:
        assert [sample.vehicle for sample in rollout.samples] == [4]
        assert rollout.collided_with != 1
        assert all(stretch.vehicle != 1 for stretch in rollout.held_up)
    assert without.plan[0].action == "continue"
    assert (without.decision, without.sim_time, without.seed) == (3, 2.0, 5)


def test_the_road_is_that_of_the_scene_that_is_planned_for(
    trace: PlanTrace, network: Network
) -> None:
    more = replan(trace, network, WhatIf(("stop",), rollouts=4))
    assert more.road is not None
    assert more.road == trace.road
    without = replan(trace, network, WhatIf(removed=1))
    assert without.road is not None
    assert set(without.road.places) == set(more.road.places) - {1} == {0, 4}


def test_actions_can_be_forced_where_a_vehicle_is_removed(
    trace: PlanTrace, network: Network
) -> None:
    without = replan(trace, network, WhatIf(removed=1))
    more = replan(trace, network, WhatIf(("stop",), removed=1, rollouts=6))
    assert more.rollouts[: len(without.rollouts)] == without.rollouts
    assert len(more.rollouts) == len(without.rollouts) + 6
    assert more.scene == without.scene
    for rollout in more.rollouts:
        assert [sample.vehicle for sample in rollout.samples] == [4]


def test_who_had_nothing_to_do_with_it_can_be_missed(trace: PlanTrace, network: Network) -> None:
    without = replan(trace, network, WhatIf(removed=4))
    assert without.plan[0].action == trace.plan[0].action


def test_a_trace_of_elsewhere_is_refused(trace: PlanTrace) -> None:
    with pytest.raises(WhatIfError, match="the trace is of network"):
        replan(trace, roads("s2").network, WhatIf())


def test_an_unknown_vehicle_is_refused(trace: PlanTrace, network: Network) -> None:
    for request in (WhatIf(removed=9), WhatIf(vehicle=9, goal="stop")):
        with pytest.raises(NotInView, match="vehicle 9 was not in view"):
            replan(trace, network, request)


def test_the_ego_cannot_be_removed(trace: PlanTrace, network: Network) -> None:
    with pytest.raises(WhatIfError, match="the ego cannot be removed"):
        replan(trace, network, WhatIf(removed=0))


@pytest.mark.parametrize(
    ("request_", "why"),
    [
        (WhatIf(vehicle=0, goal="stop"), "the ego's goal cannot be changed"),
        (WhatIf(vehicle=1), "nothing is supposed of vehicle 1"),
        (WhatIf(goal="stop"), "need a vehicle"),
        (WhatIf(vehicle_actions=("stop",)), "need a vehicle"),
        (WhatIf(removed=1, vehicle=1, goal="stop"), "cannot be removed and act; choose one"),
        (WhatIf(("stop",) * 5), "at most 4 actions"),
        (WhatIf(vehicle=1, vehicle_actions=("continue",) * 5), "at most 4 actions"),
    ],
)
def test_what_makes_no_sense_is_refused(
    trace: PlanTrace, network: Network, request_: WhatIf, why: str
) -> None:
    with pytest.raises(WhatIfError, match=why):
        replan(trace, network, request_)


def test_a_whatif_of_a_whatif_is_refused(trace: PlanTrace, network: Network) -> None:
    without = replan(trace, network, WhatIf(removed=4))
    with pytest.raises(WhatIfError, match="of a what-if itself"):
        replan(without, network, WhatIf(removed=1))


def test_an_ego_off_the_road_is_refused(trace: PlanTrace, network: Network) -> None:
    away = replace(trace.scene[0], position=(1e4, 1e4))
    lost = msgspec.structs.replace(trace, scene={**trace.scene, 0: away})
    with pytest.raises(WhatIfError, match="on no lane"):
        replan(lost, network, WhatIf())


def test_a_goal_that_is_not_in_the_roads_is_refused(trace: PlanTrace, network: Network) -> None:
    elsewhere = msgspec.structs.replace(trace.goal, edge="nowhere")
    lost = msgspec.structs.replace(trace, goal=elsewhere)
    with pytest.raises(WhatIfError, match="the goal is the edge 'nowhere', which is not in the"):
        replan(lost, network, WhatIf(removed=1))
    with pytest.raises(WhatIfError, match="'nowhere'"):
        decide_again(lost, network, lost.settings)


def test_a_record_without_the_history_of_somebody_seen_is_refused(
    trace: PlanTrace, network: Network
) -> None:
    for who, kept in ((0, {}), (1, {0: trace.history[0], 4: trace.history[4]})):
        lost = msgspec.structs.replace(trace, history=kept)
        for request in (WhatIf(removed=4), WhatIf(("stop",))):
            with pytest.raises(WhatIfError, match=f"`history` lacks vehicle {who}, which is in"):
                replan(lost, network, request)


def test_several_vehicles_can_be_removed(trace: PlanTrace, network: Network) -> None:
    without = replan(trace, network, WhatIf(removed=(1, 4)))
    assert set(without.scene) == {0}
    assert WhatIf(removed=(1, 4)).gone == {1, 4}
    assert WhatIf(removed=1).gone == {1}
    assert WhatIf().gone == frozenset()
    with pytest.raises(NotInView):
        replan(trace, network, WhatIf(removed=(1, 9)))
    with pytest.raises(WhatIfError, match="the ego cannot be removed"):
        replan(trace, network, WhatIf(removed=(0, 1)))


def test_those_who_stay_keep_the_probabilities_of_their_goals(
    trace: PlanTrace, network: Network
) -> None:
    without = replan(trace, network, WhatIf(removed=4))
    before, after = (next(p for p in t.predictions if p.vehicle == 1) for t in (trace, without))
    believed = {(g.kind, g.edge): g.probability for g in before.goals}
    assert {(g.kind, g.edge) for g in after.goals} == set(believed)
    for goal in after.goals:
        assert goal.probability == pytest.approx(believed[goal.kind, goal.edge], abs=1e-5)


def test_a_vehicle_may_be_supposed_to_drive_faster(trace: PlanTrace, network: Network) -> None:
    faster = replan(trace, network, WhatIf(vehicle=1, faster=5.0))
    assert faster.scene[1].speed == pytest.approx(trace.scene[1].speed + 5.0)
    assert faster.scene[1].position == trace.scene[1].position
    slower = replan(trace, network, WhatIf(vehicle=1, faster=-50.0))
    assert slower.scene[1].speed == 0.0
    with pytest.raises(WhatIfError, match="need a vehicle"):
        replan(trace, network, WhatIf(faster=5.0))


def queue(gap: float) -> PlanTrace:
    """A decision behind two who drive steadily at 6 m/s, so far apart [m]."""
    line = roads("s1").line(("main_in_0",))
    near = before_end("s1", "main_in_0", 70.0)
    scene = {
        0: still("s1", ("main_in_0",), before_end("s1", "main_in_0", 95.0)),
        1: driven(line, near - 6.0 * 0.2 * 20, [6.0] * 20),
        2: driven(line, near + gap + 5.0 - 6.0 * 0.2 * 20, [6.0] * 20),
    }
    return decide(frame("s1", QUICK, seed=5), moment("s1", scene, time=4.0, number=5)).trace


def fastest(trace: PlanTrace, vehicle: int) -> float:
    """The highest speed [m/s] that a vehicle is expected to reach."""
    known = next(p for p in trace.predictions if p.vehicle == vehicle)
    return max(max(way.speed) for goal in known.goals for way in goal.trajectories)


def test_who_is_held_up_drives_on_where_the_one_ahead_is_taken_away(network: Network) -> None:
    close = queue(7.0)
    assert fastest(close, 1) < 7.5
    assert fastest(replan(close, network, WhatIf(removed=2)), 1) > 8.0
    apart = queue(30.0)  # too far to be held up: it wants to drive so
    assert fastest(replan(apart, network, WhatIf(removed=2)), 1) < 7.5


def test_a_decision_is_taken_again_with_other_settings(trace: PlanTrace, network: Network) -> None:
    assert encode(decide_again(trace, network, trace.settings)) == encode(trace)
    other = msgspec.structs.replace(trace.settings, rollouts=10)
    again = decide_again(trace, network, other)
    assert again.settings == other
    assert sum(not rollout.forced for rollout in again.rollouts) == 10
    assert again.predictions == trace.predictions
