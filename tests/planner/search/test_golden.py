"""A small search compared with the one on file, node by node.

Where a change of the planner is meant to change the search, write the file anew, and look at
what changed before you commit it:

    python -m tests.planner.search.test_golden
"""

import json
from pathlib import Path
from typing import Any

import pytest

from planner.record.trace import Settings
from planner.search.decide import predict, prepare
from planner.search.inputs import Frame, Moment
from planner.search.mcts import Search
from tests.planner.worlds import before_end, changing, driven, frame, moment, run, still

GOLDEN = Path(__file__).parent / "golden" / "s1_cut_in.json"


def decision() -> tuple[Frame, Moment]:
    """Vehicle 1 cuts in ahead of the ego of s1."""
    line = changing("s1", "main_in_1", "main_in_0", before_end("s1", "main_in_1", 85.0))
    scene = {
        0: still("s1", ("main_in_0",), before_end("s1", "main_in_0", 95.0)),
        1: driven(line, 12.0, [8.0] * 8),
    }
    return frame("s1", Settings(rollouts=40, min_rollouts=8)), moment("s1", scene)


def searched() -> dict[str, Any]:
    """The beliefs, the tree and the plan of the decision."""
    constant, scene = decision()
    beliefs = predict(constant, scene)
    search = prepare(constant, scene, beliefs)
    run(search)
    return {
        "beliefs": {b.goal.kind: round(b.probability, 4) for b in beliefs[1]},
        "tree": tree(search),
        "forced": sum(1 for rollout in search.rollouts if rollout.forced),
        "outcomes": [rollout.outcome for rollout in search.rollouts],
        "plan": [step.action for step in search.plan()],
    }


def tree(search: Search) -> dict[str, dict[str, list[float]]]:
    """Visits and value of every edge, by the actions that lead to its node."""
    return {
        " > ".join(node): {
            action: [edge.visits, round(edge.value, 3)] for action, edge in known.items()
        }
        for node, known in sorted(search.tree.edges.items())
    }


def test_the_search_is_the_one_on_file() -> None:
    stored, found = json.loads(GOLDEN.read_text(encoding="utf-8")), searched()
    assert found["beliefs"] == pytest.approx(stored["beliefs"], abs=0.01)
    assert list(found["tree"]) == list(stored["tree"])
    for node, known in stored["tree"].items():
        assert list(found["tree"][node]) == list(known), node
        for action, (visits, value) in known.items():
            assert found["tree"][node][action][0] == visits, (node, action)
            assert found["tree"][node][action][1] == pytest.approx(value, abs=0.05), (node, action)
    for key in ("forced", "outcomes", "plan"):
        assert found[key] == stored[key]


if __name__ == "__main__":
    GOLDEN.write_text(json.dumps(searched(), indent=1) + "\n", encoding="utf-8")
