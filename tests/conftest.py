"""What all tests share: one deterministic Hypothesis profile, and where the repository lies."""

import gc
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from hypothesis import settings

# Examples follow from the test alone and no test fails for being slow: same code, same result.
settings.register_profile("deterministic", derandomize=True, deadline=None, max_examples=60)
settings.load_profile("deterministic")

ROOT = Path(__file__).parents[1]
GARBAGE = (20_000, 20, 20)  # thresholds of the collector; the tests make many short-lived objects
#: The files that take longest, in this order. They run first, so that what is left for the end are
#: short ones, and processes that share the files out end together.
LONGEST = (
    "test_transcripts.py",
    "simulated/test_world.py",
    "explain/answers/test_every_question.py",
    "chat/test_killed.py",
    "planner/driving/test_signal_rides.py",
    "benchmarks/test_foreign.py",
    "sim/scenarios/test_worlds.py",
)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Put the longest files first; a name that is none of a file is a mistake."""
    ranks = {(ROOT / "tests" / name).resolve(strict=True): k for k, name in enumerate(LONGEST)}
    items.sort(key=lambda item: ranks.get(item.path, len(ranks)))


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Iterator[None]:
    """Load the tests without looking for garbage among them, and never look there later."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.collect()
        gc.freeze()
        gc.set_threshold(*GARBAGE)
        gc.enable()


@pytest.fixture(scope="session", autouse=True)
def unfreeze() -> Iterator[Callable[[], None]]:
    """Let rides that end leave excluded from collections what is loaded; gives what includes it.

    Each ride begins with a collection and excludes what that leaves until it ends. With all tests
    loaded the next ride would look through millions of objects first.
    """
    with pytest.MonkeyPatch.context() as patch:
        include = gc.unfreeze
        patch.setattr(gc, "unfreeze", lambda: None)
        yield include


@pytest.fixture(scope="session")
def root() -> Path:
    """The repository's top folder."""
    return ROOT


@pytest.fixture(scope="session", autouse=True)
def nobody_s_own_files(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Keep what tests, and the processes that they start, write about the user to themselves."""
    with pytest.MonkeyPatch.context() as patch:
        for name in ("XDG_DATA_HOME", "XDG_STATE_HOME"):
            patch.setenv(name, str(tmp_path_factory.mktemp(name.lower())))
        yield
