"""Several search trees for one decision: shared rollouts, joined trees, and the same result."""

import pickle
from collections.abc import Sequence

import msgspec
import pytest

from planner.errors import TraceError
from planner.record import trace as plan_trace
from planner.record import trace_reading
from planner.record.trace import PlanTrace, Settings
from planner.search.decide import decide, grown, predict, searched
from planner.search.inputs import Moment
from planner.search.tree import Tree
from planner.search.trees import GrownTree, share
from tests.planner.worlds import before_end, changing, driven, frame, moment, still

THREE = Settings(rollouts=40, min_rollouts=8, trees=3)
LINE = changing("s1", "main_in_1", "main_in_0", before_end("s1", "main_in_1", 85.0))
SCENE = moment(
    "s1",
    {
        0: still("s1", ("main_in_0",), before_end("s1", "main_in_0", 95.0)),
        1: driven(LINE, 12.0, [8.0] * 8),
    },
)
FRAME = frame("s1", THREE)


class Apart:
    """Grows trees as another process would: from what was sent, and sends them back."""

    def __init__(self, *lost: int) -> None:
        self.lost = lost
        self.asked: list[int] = []

    def __call__(self, here: Moment) -> Sequence["Apart.Pending"]:
        sent = pickle.dumps(here)
        return [self.Pending(self, sent, tree) for tree in (1, 2)]

    class Pending:
        def __init__(self, apart: "Apart", sent: bytes, tree: int) -> None:
            self.apart, self.sent, self.tree = apart, sent, tree

        def __call__(self) -> GrownTree | None:
            self.apart.asked.append(self.tree)
            if self.tree in self.apart.lost:
                return None
            there: Moment = pickle.loads(self.sent)
            own = frame("s1", THREE)
            found = grown(own, there, predict(own, there), self.tree)
            back: GrownTree = pickle.loads(pickle.dumps(found))
            return back


@pytest.mark.parametrize("lost", [(), (1,), (2,), (1, 2)])
def test_trees_grown_elsewhere_give_the_same_decision(lost: tuple[int, ...]) -> None:
    apart = Apart(*lost)
    here = decide(FRAME, SCENE).trace
    there = decide(FRAME, SCENE, apart).trace
    assert apart.asked == [1, 2]
    assert plan_trace.encode(there) == plan_trace.encode(here)


def test_the_trees_share_the_rollouts() -> None:
    assert [share(40, 3, tree) for tree in range(3)] == [14, 13, 13]
    assert [share(2, 3, tree) for tree in range(3)] == [1, 1, 0]
    search = searched(FRAME, SCENE, predict(FRAME, SCENE))
    drawn = [one for one in search.rollouts if not one.forced]
    assert len(drawn) == THREE.rollouts
    assert sum(edge.visits for edge in search.tree.edges[()].values()) == THREE.rollouts
    samples = [one.drawn for one in drawn]
    assert samples[:13] != samples[14:27]  # each tree draws its own


def test_the_joined_tree_has_learnt_from_all_rollouts_in_order() -> None:
    search = searched(FRAME, SCENE, predict(FRAME, SCENE))
    again = Tree()
    for one in search.rollouts:
        if not one.forced:
            again.back_up(one.actions[: THREE.depth], one.reward)
    assert again == search.tree


def test_reasons_why_actions_do_not_apply_are_joined() -> None:
    beliefs = predict(FRAME, SCENE)
    search = searched(FRAME, SCENE, beliefs)
    for tree in (1, 2):
        for where, reason in grown(FRAME, SCENE, beliefs, tree).refusals.items():
            assert search.refusals[where] == reason


def test_a_grown_tree_is_small_enough_to_send() -> None:
    found = grown(FRAME, SCENE, predict(FRAME, SCENE), 1)
    assert all(leg.traffic.vehicles == () for one in found.rollouts for leg in one.legs)
    assert any(one.braking for one in found.rollouts) == any(
        one.braking for one in decide(FRAME, SCENE).trace.rollouts[14:27]
    )


def test_a_trace_names_its_number_of_trees() -> None:
    trace: PlanTrace = decide(FRAME, SCENE).trace
    assert trace_reading.decode(plan_trace.encode(trace)).settings.trees == 3
    bad = msgspec.structs.replace(trace, settings=msgspec.structs.replace(THREE, trees=65))
    with pytest.raises(TraceError, match=r"settings\.trees"):
        trace_reading.decode(plan_trace.encode(bad))
    alone = decide(frame("s1", Settings(rollouts=10)), SCENE).trace
    assert b'"trees"' not in plan_trace.encode(alone)
