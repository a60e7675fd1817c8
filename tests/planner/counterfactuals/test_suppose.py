"""What would be decided if another vehicle did this or that."""

import math
from dataclasses import replace

import msgspec
import pytest

from planner.counterfactuals.whatif import Inapplicable, WhatIf, replan
from planner.prediction.goals import BEYOND
from planner.record.trace import (
    Action,
    GoalPrediction,
    PlanTrace,
    VehiclePrediction,
    encode,
)
from planner.search.decide import decide
from sim.roads.network import Network
from tests.planner.worlds import (
    QUICK,
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


def cutting_in() -> dict[int, Seen]:
    """S1: vehicle 1 has changed to the ego's lane and slows for its turn to the right."""
    line = changing("s1", "main_in_1", "main_in_0", before_end("s1", "main_in_1", 85.0))
    waits = roads("s1").line(("from_s_0",))
    return {
        0: still("s1", ("main_in_0",), before_end("s1", "main_in_0", 95.0)),
        1: driven(line, 14.0, [8.0 - 0.2 * k for k in range(11)]),
        4: driven(waits, before_end("s1", "from_s_0", 2.0), [0.0] * 8),
    }


@pytest.fixture(scope="module")
def trace() -> PlanTrace:
    return decide(frame("s1", QUICK, seed=1), moment("s1", cutting_in(), time=2.0, number=3)).trace


@pytest.fixture(scope="module")
def network() -> Network:
    return roads("s1").network


def predicted(trace: PlanTrace, vehicle: int) -> VehiclePrediction:
    return next(p for p in trace.predictions if p.vehicle == vehicle)


def sole_goal(trace: PlanTrace, vehicle: int) -> GoalPrediction:
    (goal,) = predicted(trace, vehicle).goals
    assert goal.probability == 1.0
    return goal


def test_no_lane_is_changed_for_a_vehicle_that_goes_on(trace: PlanTrace, network: Network) -> None:
    assert trace.plan[0].action == "change-left"
    again = replan(trace, network, WhatIf(vehicle=1, goal="continue"))
    assert again.plan[0].action == "continue"
    assert again.plan[0].value > trace.plan[0].value


def test_a_supposed_goal_is_certain_and_all_else_stays(trace: PlanTrace, network: Network) -> None:
    asked = WhatIf(vehicle=1, goal="continue")
    again = replan(trace, network, asked)
    before = next(goal for goal in predicted(trace, 1).goals if goal.kind == "continue")
    assert sole_goal(again, 1) == msgspec.structs.replace(before, probability=1.0)
    assert predicted(again, 4) == predicted(trace, 4)
    assert (again.scene, again.history) == (trace.scene, trace.history)
    assert again.what_if == asked
    for rollout in again.rollouts:
        assert rollout.samples[0].goal == 0


def test_a_goal_can_be_named_by_its_edge_or_simply_as_straight_on(
    trace: PlanTrace, network: Network
) -> None:
    named = (
        replan(trace, network, WhatIf(vehicle=1, goal=name))
        for name in ("continue", "main_out", "exit-straight")
    )
    kind, edge, word = (msgspec.structs.replace(again, what_if=None) for again in named)
    assert encode(kind) == encode(edge) == encode(word)


def test_a_goal_that_was_given_up_is_planned_afresh(network: Network) -> None:
    """Vehicle 4 drives as fast as its road allows: that it stops was dropped as improbable."""
    line = roads("s1").line(("from_s_0",))
    hurried = driven(line, before_end("s1", "from_s_0", 50.0), [11.0] * 25)
    sharp = msgspec.structs.replace(QUICK, rationality=6.0)
    given = decide(frame("s1", sharp, seed=5), moment("s1", {**cutting_in(), 4: hurried})).trace
    kinds = {goal.kind for goal in predicted(given, 4).goals}
    assert "stop" not in kinds
    goal = sole_goal(replan(given, network, WhatIf(vehicle=4, goal="stop")), 4)
    assert (goal.kind, goal.edge, goal.likelihood) == ("stop", None, 0.0)
    assert goal.trajectories[0].speed[-1] == 0.0


def test_a_stop_that_comes_last_is_for_good(trace: PlanTrace, network: Network) -> None:
    again = replan(trace, network, WhatIf(vehicle=1, vehicle_actions=("stop",)))
    goal = sole_goal(again, 1)
    (way,) = goal.trajectories
    assert (goal.kind, goal.edge) == ("stop", None)
    assert way.actions == ("stop",)
    assert way.speed[-1] == 0.0
    assert len(way.speed) == 1 + round(trace.settings.horizon / 0.2)
    assert again.plan[0].action == "change-left"


def test_a_stop_is_followed_by_what_is_said(trace: PlanTrace, network: Network) -> None:
    actions: tuple[Action, ...] = ("stop", "continue")
    again = replan(trace, network, WhatIf(vehicle=1, vehicle_actions=actions))
    (way,) = sole_goal(again, 1).trajectories
    assert min(way.speed) == 0.0
    assert way.speed[-1] > 5.0
    assert way.actions == actions


@pytest.mark.parametrize(
    ("actions", "kind", "edge"),
    [
        (("continue",), "continue", "main_out"),
        (("exit-right",), "exit-right", "exit_s"),
        (("change-left", "exit-left"), "exit-left", "exit_n"),
        (("change-left",), "change-left", "main_in"),
    ],
)
def test_supposed_actions_are_driven_to_where_they_lead(
    trace: PlanTrace, network: Network, actions: tuple[Action, ...], kind: Action, edge: str
) -> None:
    again = replan(trace, network, WhatIf(vehicle=1, vehicle_actions=actions))
    goal = sole_goal(again, 1)
    (way,) = goal.trajectories
    assert (goal.kind, goal.edge) == (kind, edge)
    assert (way.actions, way.probability) == (actions, 1.0)
    here = trace.scene[1].position
    assert math.dist(way.path[0], here) < 0.1
    lane = network.edge_lanes(edge)[0].centreline
    start = lane[0] if kind != "change-left" else here
    assert min(math.dist(point, start) for point in way.path) < BEYOND


def test_supposed_actions_and_goal_must_agree(trace: PlanTrace, network: Network) -> None:
    both = WhatIf(vehicle=1, goal="exit-right", vehicle_actions=("exit-right", "stop"))
    goal = sole_goal(replan(trace, network, both), 1)
    assert (goal.kind, goal.trajectories[0].speed[-1]) == ("exit-right", 0.0)
    with pytest.raises(Inapplicable, match="exit-right does not lead to the road straight on"):
        replan(trace, network, WhatIf(vehicle=1, goal="continue", vehicle_actions=("exit-right",)))


@pytest.mark.parametrize(
    ("asked", "why"),
    [
        (WhatIf(vehicle=1, vehicle_actions=("exit-left",)), "its lane does not lead to the left"),
        (WhatIf(vehicle=1, vehicle_actions=("change-right",)), "there is no lane to the right"),
        (
            WhatIf(vehicle=1, vehicle_actions=("exit-right", "exit-left")),
            "exit-left does not apply: there is no junction in view",
        ),
        (WhatIf(vehicle=1, goal="continue-next-exit"), "is none of its goals"),
        (WhatIf(vehicle=1, goal="nowhere"), "nowhere is none of its goals; these are exit-right"),
    ],
)
def test_what_a_vehicle_cannot_do_is_refused(
    trace: PlanTrace, network: Network, asked: WhatIf, why: str
) -> None:
    with pytest.raises(Inapplicable, match=why):
        replan(trace, network, asked)


def test_too_fast_a_turn_is_refused(trace: PlanTrace, network: Network) -> None:
    line = roads("s1").line(row("s1", "main_in_0", "right"))
    fast = driven(line, before_end("s1", "main_in_0", 3.0), [13.0] * 8)
    scene, history = {**trace.scene, 1: fast.state}, {**trace.history, 1: fast.track}
    near = msgspec.structs.replace(trace, scene=scene, history=history)
    with pytest.raises(Inapplicable, match="too fast for the bend"):
        replan(near, network, WhatIf(vehicle=1, vehicle_actions=("exit-right",)))


def test_a_vehicle_off_the_road_does_nothing_that_is_supposed(
    trace: PlanTrace, network: Network
) -> None:
    away = replace(trace.scene[4], position=(1e4, 1e4))
    track = msgspec.structs.replace(trace.history[4], position=((1e4, 1e4),) * 8)
    lost = msgspec.structs.replace(
        trace, scene={**trace.scene, 4: away}, history={**trace.history, 4: track}
    )
    with pytest.raises(Inapplicable, match="it is on no lane"):
        replan(lost, network, WhatIf(vehicle=4, vehicle_actions=("stop",)))
    with pytest.raises(Inapplicable, match="none of its goals; these are continue"):
        replan(lost, network, WhatIf(vehicle=4, goal="stop"))


def test_it_combines_with_a_removed_vehicle_and_forced_actions(
    trace: PlanTrace, network: Network
) -> None:
    asked = WhatIf(("stop",), removed=4, vehicle=1, goal="continue", rollouts=6)
    again = replan(trace, network, asked)
    decided = replan(trace, network, WhatIf(removed=4, vehicle=1, goal="continue"))
    assert again.rollouts[: len(decided.rollouts)] == decided.rollouts
    assert len(again.rollouts) == len(decided.rollouts) + 6
    assert [p.vehicle for p in again.predictions] == [1]
    assert again.plan == decided.plan


def test_the_same_supposition_gives_the_same_bytes(trace: PlanTrace, network: Network) -> None:
    asked = WhatIf(vehicle=1, vehicle_actions=("change-left", "continue"))
    assert encode(replan(trace, network, asked)) == encode(replan(trace, network, asked))
