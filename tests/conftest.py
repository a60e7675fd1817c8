"""What all tests share: one deterministic Hypothesis profile, and where the repository lies."""

from pathlib import Path

import pytest
from hypothesis import settings

# Examples follow from the test alone and no test fails for being slow: same code, same result.
settings.register_profile("deterministic", derandomize=True, deadline=None, max_examples=60)
settings.load_profile("deterministic")

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="session")
def root() -> Path:
    """The repository's top folder."""
    return ROOT
