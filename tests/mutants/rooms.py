"""The rooms whose code gets faults, and the tests that ought to notice."""

from pathlib import Path

ROOT = Path(__file__).parents[2]
#: Modules and folders of each room. The planner's compiled kernels are left out: a fault in one
#: shows only after a compilation, and the kernels are compared with a reference of their own.
ROOMS: dict[str, tuple[str, ...]] = {
    "causal": ("xavi_dialogue/causal",),
    "dialogue": ("xavi_dialogue/dialogue",),
    "explain": ("xavi_dialogue/explain",),
    "grounding": ("xavi_dialogue/nlu/grounding",),
    "recognition": (
        "planner/prediction/astar.py",
        "planner/prediction/goals.py",
        "planner/prediction/likelihood.py",
        "planner/prediction/recognise.py",
        "planner/motion/tracks.py",
    ),
    "search and reward": (
        "planner/search/comparison.py",
        "planner/search/decide.py",
        "planner/motion/forward.py",
        "planner/rollouts/reward.py",
        "planner/rollouts/rollout.py",
        "planner/search/mcts.py",
        "planner/search/tree.py",
    ),
}
#: The tests of these rooms, less those that are marked slow.
TESTS = (
    "tests/dashboard",
    "tests/service/test_evidence.py",
    "tests/chat/test_killed.py",
    "tests/nlg/test_narration.py",
    "tests/causal",
    "tests/dialogue",
    "tests/explain",
    "tests/nlu",
    "tests/planner",
    "tests/truth",
)
#: What compares with a file that is written anew from the code.
GOLDEN = ("tests/planner/search/test_golden.py",)


def modules() -> list[tuple[str, str]]:
    """Every module as its room and its path from the top folder, in order."""
    return sorted(
        (room, path.relative_to(ROOT).as_posix())
        for room, places in ROOMS.items()
        for place in places
        for path in ([ROOT / place] if place.endswith(".py") else (ROOT / place).rglob("*.py"))
        if path.is_file()
    )
