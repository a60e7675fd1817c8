import random
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from planner.motion.forward import Motion
from planner.record.trace import ACTIONS, Action, Outcome, Settings
from planner.search.comparison import likeliest
from planner.search.decide import predict, prepare
from planner.search.inputs import Root
from planner.search.mcts import Search
from planner.search.simulated import Simulated
from planner.search.tree import Tree
from tests.planner.worlds import (
    before_end,
    changing,
    driven,
    frame,
    moment,
    plan_of,
    roads,
    row,
    run,
    situation,
    still,
)

FEW = Settings(rollouts=25, min_rollouts=6)
EGO = still("s1", ("main_in_0",), before_end("s1", "main_in_0", 95.0))
LINE = changing("s1", "main_in_1", "main_in_0", before_end("s1", "main_in_1", 85.0))
CUTS_IN = driven(LINE, 12.0, [8.0] * 8)


def search(settings: Settings = FEW, seed: int = 0) -> Search:
    """A search for an ego of s1 before which vehicle 1 changes to its lane."""
    scene = moment("s1", {0: EGO, 1: CUTS_IN})
    constant = frame("s1", settings, seed)
    return prepare(constant, scene, predict(constant, scene))


def ran(settings: Settings = FEW, seed: int = 0) -> Search:
    one = search(settings, seed)
    run(one)
    return one


def visits(tree: Tree) -> dict[str, int]:
    return {action: edge.visits for action, edge in tree.edges[()].items()}


def test_the_budget_is_spent_and_topped_up_where_it_was_thin() -> None:
    one = ran()
    drawn = [rollout for rollout in one.rollouts if not rollout.forced]
    assert len(drawn) == FEW.rollouts
    assert sum(visits(one.tree).values()) == FEW.rollouts
    for action in ACTIONS:
        first = sum(1 for rollout in one.rollouts if rollout.actions[0] == action)
        refused = ((), action) in one.refusals
        assert refused == (first == 0)
        assert refused or first >= FEW.min_rollouts


def test_forced_rollouts_teach_the_search_nothing() -> None:
    thin = ran(Settings(rollouts=25, min_rollouts=0))
    full = ran(Settings(rollouts=25, min_rollouts=25))
    assert thin.tree == full.tree
    assert thin.plan() == full.plan()
    assert len(full.rollouts) > len(thin.rollouts)
    before = full.tree.copy()
    full.force(("stop",), 5)
    assert full.tree == before


def test_forcing_begins_with_the_given_actions() -> None:
    one = search()
    one.force(("change-left", "continue"), 4)
    assert [rollout.actions[:2] for rollout in one.rollouts] == [("change-left", "continue")] * 4
    assert all(rollout.forced for rollout in one.rollouts)


def test_forcing_what_does_not_apply_adds_no_rollout_but_a_reason() -> None:
    one = search()
    one.force(("change-right",), 3)
    assert one.rollouts == []
    assert one.refusals[(), "change-right"] == "there is no lane to the right"


def test_the_same_samples_and_actions_give_the_same_drive() -> None:
    one = ran()
    drives: dict[object, Simulated] = {}
    for rollout in one.rollouts:
        before = drives.setdefault((rollout.samples, rollout.actions), rollout)
        assert (before.reward, before.outcome) == (rollout.reward, rollout.outcome)
    assert len(drives) < len(one.rollouts)


def test_samples_follow_the_beliefs() -> None:
    one = search(Settings(rollouts=300, min_rollouts=0))
    run(one)
    beliefs = one.beliefs[1]
    for index, belief in enumerate(beliefs):
        drawn = sum(not r.forced and r.samples[0].goal == index for r in one.rollouts)
        assert drawn / 300 == pytest.approx(belief.probability, abs=0.08)


def test_nobody_stops_twice_in_a_row() -> None:
    one = search(Settings(rollouts=0, min_rollouts=0))
    one.force(("stop", "stop"), 2)
    assert one.rollouts == []
    assert one.refusals[("stop",), "stop"] == "it is standing already"


def test_beyond_its_depth_a_rollout_drives_on_to_the_goal() -> None:
    one = ran(Settings(rollouts=20, min_rollouts=0, depth=1))
    assert max(len(node) for node in one.tree.edges) == 0  # nothing deeper is learnt
    driven = {(rollout.actions, rollout.outcome) for rollout in one.rollouts}
    assert (("continue",), "done") in driven
    assert (("stop", "continue"), "done") in driven
    assert (("change-left", "continue"), "done") in driven
    assert {outcome for actions, outcome in driven if actions[0] == "exit-right"} == {"dead"}


def test_what_leads_to_the_goal_soonest_is_tried_first() -> None:
    tried = [rollout.actions[0] for rollout in ran(Settings(rollouts=20, depth=1)).rollouts]
    assert tried[0] == "continue"
    assert tried.index("stop") < 6
    assert all(tried.index("continue") < tried.index(other) for other in set(tried) - {"continue"})


def test_only_the_action_under_way_applies_at_the_root() -> None:
    here = situation("s1", "main_in_0", before_end("s1", "main_in_0", 95.0))
    plan = plan_of("s1", here, "change-left", aim=True)
    one = search()
    one.root = Root(here, (plan, Motion(8.0, here.speed, 0.0)))
    run(one)
    assert {rollout.actions[0] for rollout in one.rollouts} == {"change-left"}
    assert one.refusals[(), "continue"] == "another manoeuvre is under way"
    start = plan.path.pose(8.0)[0]
    for rollout in one.rollouts:
        assert rollout.legs[0].position[0] == pytest.approx(start)


def weighed(driven: Sequence[Outcome], other: Sequence[Outcome], losses: Sequence[float]) -> Search:
    """A search in which a stop came to more, by these losses [s], than what is being driven."""
    one = ran()
    assert one.root.driving is None
    one.root = replace(one.root, driving="continue")
    kinds: list[tuple[Action, Sequence[Outcome], list[float]]] = [
        ("continue", driven, [-40.0] * len(losses)),
        ("stop", other, [loss - 40.0 for loss in losses]),
    ]
    one.rollouts = [r for r in one.rollouts if r.weight is None]
    one.compared = {}
    for action, outcomes, rewards in kinds:
        like = next(r for r in one.rollouts if r.actions[0] == action)
        weight = 1.0 / len(rewards)
        one.compared[action] = weight * sum(rewards)
        for outcome, reward in zip(outcomes, rewards, strict=True):
            one.rollouts.append(replace(like, outcome=outcome, reward=reward, weight=weight))
    return one


DONE: tuple[Outcome, ...] = ("done",) * 4


def test_what_is_being_driven_is_kept_unless_something_else_is_clearly_better() -> None:
    wavers = [6.0, -4.0, 5.0, -4.0]  # 0.75 s better, give or take 2.4 s
    one = weighed(DONE, DONE, wavers)
    assert one.plan()[0].action == "continue"
    assert one.plan()[0].value == one.compared["continue"]
    one.root = replace(one.root, driving=None)
    assert one.plan()[0].action == "stop"
    assert weighed(DONE, DONE, [1.0, 0.5, 1.0, 0.5]).plan()[0].action == "stop"


def test_what_is_being_driven_is_not_kept_where_it_is_more_dangerous() -> None:
    losses = [160.0, -20.0, -20.0, -20.0]
    risky: tuple[Outcome, ...] = ("collision", "done", "done", "done")
    assert weighed(risky, DONE, losses).plan()[0].action == "stop"
    assert weighed(risky, risky, losses).plan()[0].action == "continue"


def test_randomness_comes_from_seed_and_decision_alone() -> None:
    assert ran(seed=3).plan() == ran(seed=3).plan()
    samples = {seed: [rollout.samples for rollout in ran(seed=seed).rollouts] for seed in (1, 2)}
    assert samples[1] != samples[2]
    random.seed(1)
    one = [rollout.actions for rollout in ran(seed=1).rollouts]
    random.seed(2)
    assert one == [rollout.actions for rollout in ran(seed=1).rollouts]


FASTER = driven(roads("s1").line(row("s1", "main_in_1")), 70.0, [13.0] * 8)
IN_FRONT = still("s1", ("main_in_0",), 90.0, 7.0)


def moving_left(reacting: bool) -> Simulated:
    """What comes of moving left before a faster vehicle 1 in that lane."""
    settings = Settings(rollouts=0, min_rollouts=0, reacting=reacting)
    scene = moment("s1", {0: IN_FRONT, 1: FASTER})
    constant = frame("s1", settings)
    one = prepare(constant, scene, predict(constant, scene))
    one.force(("change-left",), 1)
    return one.rollouts[0]


def test_a_driver_behind_brakes_for_a_change_of_lanes_where_others_react() -> None:
    blind, seen = moving_left(reacting=False), moving_left(reacting=True)
    assert (blind.outcome, blind.legs[-1].collided_with, blind.braking) == ("collision", 1, ())
    assert (seen.outcome, seen.braking) == ("done", (1,))


def test_what_others_did_in_one_leg_they_go_on_from_in_the_next() -> None:
    first, second = moving_left(reacting=True).legs[:2]
    np.testing.assert_array_equal(
        first.traffic.states[:, : second.first + 1], second.traffic.states[:, : second.first + 1]
    )
    assert first.traffic.braking.tolist() == [True]


def test_weights_of_the_comparison_are_those_of_the_plan() -> None:
    one = ran()
    for action, value in one.compared.items():
        tried = [r for r in one.rollouts if r.weight is not None and r.actions[0] == action]
        assert all(rollout.forced for rollout in tried)
        assert sum(r.weight or 0.0 for r in tried) == pytest.approx(1.0)
        assert sum((r.weight or 0.0) * r.reward for r in tried) == pytest.approx(value)
    exact = dict(likeliest(one.beliefs))
    for rollout in one.rollouts:
        if rollout.weight is not None:
            assert rollout.weight == pytest.approx(exact[rollout.samples], rel=0.02)
    assert one.plan()[0].value == pytest.approx(max(one.compared.values()), abs=1e-3)
