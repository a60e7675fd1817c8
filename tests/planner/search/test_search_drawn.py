"""The search on roads drawn by hand, with nobody else about."""

import pytest

from planner.record.trace import ACTIONS, Action, EgoGoal, PlannedAction, Settings
from planner.roads.trajectory import Roads
from planner.rollouts.rollout import Task
from planner.search.inputs import Root
from planner.search.mcts import Search
from planner.search.tree import Edge, Tree
from tests.planner.drives import SIZE, avenue, corner
from tests.planner.nets import on_lane
from tests.planner.worlds import run

ROAD, CORNER = avenue(limit=10.0), corner()


def search(
    roads: Roads,
    edge: str,
    position: float,
    x: float,
    *,
    rollouts: int = 12,
    fewest: int = 0,
    depth: int = 4,
    horizon: int = 150,
) -> Search:
    """A search for a vehicle at x [m] and 10 m/s, not run yet."""
    first = next(iter(roads.network.lanes))
    task = Task(roads, EgoGoal(edge, position, None), SIZE, 50.0, horizon, 100.0)
    known = Settings(rollouts=rollouts, min_rollouts=fewest, depth=depth)
    return Search(task, Root(on_lane(roads, first, x, 10.0)), {}, known, "seed")


def ran(one: Search) -> Search:
    run(one)
    return one


@pytest.mark.parametrize(
    ("one", "order"),
    [
        (search(CORNER, "south", 100.0, 60.0), ["exit-right", "stop", "continue"]),
        (search(CORNER, "on", 100.0, 60.0), ["continue", "stop", "exit-right"]),
        # 20 s; 1 s of effort more; stopping leads nowhere by itself.
        (search(ROAD, "road", 300.0, 100.0), ["continue", "change-left", "stop"]),
    ],
)
def test_what_would_lead_to_the_goal_soonest_is_tried_first(one: Search, order: list[str]) -> None:
    run(one)
    assert [rollout.actions[0] for rollout in one.rollouts[: len(order)]] == order
    assert {rollout.actions[0] for rollout in one.rollouts} == set(order)
    assert one.plan()[0].action == order[0]


@pytest.mark.parametrize("depth", [1, 4])
def test_rewards_are_seconds(depth: int) -> None:
    one = ran(search(ROAD, "road", 300.0, 100.0, depth=depth))
    costs = {r.actions: (r.outcome, r.reward, r.terms) for r in one.rollouts}
    outcome, reward, spent = costs[("continue",)]
    assert outcome == "done"
    assert reward == pytest.approx(-20.0)
    assert spent == pytest.approx({"time": 20.0})
    outcome, reward, spent = costs[("change-left", "continue")]
    assert (outcome, spent["effort"]) == ("done", 1.0)
    assert -reward == pytest.approx(sum(spent.values()), abs=6e-4)
    assert spent["time"] == pytest.approx(20.0, abs=0.05)
    assert max(len(node) for node in one.tree.edges) < depth


def test_what_is_left_when_time_is_up_counts() -> None:
    one = ran(search(ROAD, "road", 300.0, 100.0, horizon=25, rollouts=1))
    (rollout,) = one.rollouts
    # 5 s at 10 m/s; then 150 m are left.
    assert rollout.terms == pytest.approx({"time": 5.0, "late": 10.0, "left": 15.0})
    assert (rollout.outcome, rollout.reward) == ("termination", -30.0)
    assert set(rollout.components.values()) == {None}


def test_missing_rollouts_are_forced() -> None:
    plain, topped = (ran(search(CORNER, "on", 100.0, 60.0, fewest=n)) for n in (0, 8))
    for action in ("continue", "stop", "exit-right"):
        tried = [[r for r in s.rollouts if r.actions[0] == action] for s in (plain, topped)]
        assert len(tried[1]) == max(len(tried[0]), 8)
        # Each was compared once: alone on the road there is but one case.
        assert [sum(r.weight is not None for r in part) for part in tried] == [1, 1]
        assert all(r.forced for r in tried[1][len(tried[0]) :])
    assert len(plain.rollouts) == 12 + 3


def test_what_is_forced_is_taken_from_the_root() -> None:
    one = search(CORNER, "on", 100.0, 60.0, rollouts=0)
    one.force(("stop", "exit-right"), 2)
    assert [r.actions for r in one.rollouts] == [("stop", "exit-right")] * 2
    one.force(("continue",), -1)
    one.force(("change-left",), 3)
    assert len(one.rollouts) == 2
    assert one.tree == Tree()


def test_a_single_first_action_is_not_compared() -> None:
    inside = search(CORNER, "south", 100.0, 101.0)
    inside.root = Root(on_lane(CORNER, ":R_0", 1.0, 5.0))
    run(inside)
    assert {r.actions[0] for r in inside.rollouts} == {"exit-right"}
    assert inside.compared == {}
    assert len(inside.rollouts) == 12
    plan = inside.plan()
    assert (plan[0].action, plan[0].visits) == ("exit-right", 12)


@pytest.mark.parametrize(
    ("rollouts", "visits", "first"),
    [
        (100, 4, "continue"),  # a twentieth of the rollouts are 5
        (100, 5, "stop"),
        (199, 9, "stop"),
        (200, 9, "continue"),
        (10, 1, "stop"),
    ],
)
def test_a_plan_needs_some_rollouts(rollouts: int, visits: int, first: str) -> None:
    one = search(ROAD, "road", 300.0, 100.0, rollouts=rollouts)
    one.tree = Tree({(): {"continue": Edge(90, -20.12345), "stop": Edge(visits, -5.00051)}})
    known = {"continue": (-20.123, 90), "stop": (-5.001, visits)}
    assert one.plan() == (PlannedAction(first, *known[first]),)  # type: ignore[arg-type]


def test_the_plan_is_what_did_best_where_all_were_tried_alike() -> None:
    one = search(ROAD, "road", 300.0, 100.0)
    root: dict[Action, Edge] = {"continue": Edge(9, -20.0), "stop": Edge(3, -5.0)}
    then: dict[Action, Edge] = {"stop": Edge(1, -18.0), "change-left": Edge(8, -19.0)}
    one.tree = Tree({(): root, ("continue",): then})
    one.compared = {"stop": -30.0, "continue": -19.98765}
    assert one.plan() == (
        PlannedAction("continue", -19.988, 9),
        PlannedAction("stop", -18.0, 1),
    )


def test_refusals_are_told_in_the_order_of_their_nodes() -> None:
    one = ran(search(CORNER, "on", 100.0, 60.0, rollouts=1))
    told = [(entry.node, entry.action, entry.reason) for entry in one.not_applicable()]
    assert [action for node, action, _ in told if node == ()] == [
        action for action in ACTIONS if action not in ("continue", "stop", "exit-right")
    ]
    assert ((), "change-left", "there is no lane to the left") in told


def test_nobody_brakes_where_nothing_was_driven() -> None:
    one = ran(search(ROAD, "road", 300.0, 100.0, rollouts=1))
    assert one.rollouts[0].braking == ()
    assert one.rollouts[0].held_up == ()
    assert one.rollouts[0].samples == ()
