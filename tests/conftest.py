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
