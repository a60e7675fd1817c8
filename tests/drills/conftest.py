"""What all drills share: processes that are ended with the drill, and nothing left behind."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.drills.processes import Crew


@pytest.fixture
def crew(tmp_path: Path) -> Iterator[Crew]:
    """Starts processes; after the drill all end when told to, and nothing is left of them."""
    made = Crew(tmp_path)
    try:
        yield made
        made.dismiss()
        left = made.leavings()
    finally:
        made.clear()
    assert left == []
