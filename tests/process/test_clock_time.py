"""Times as people write them."""

from typing import Any

import pytest

from xavi_dialogue.process.clock_time import seconds_of


@pytest.mark.parametrize(
    ("given", "time"),
    [
        (65, 65.0), (65.5, 65.5), ("65", 65.0), ("65s", 65.0), ("65 s", 65.0), ("1:05", 65.0),
        ("0:14.5", 14.5), ("1:65", None), ("soon", None), ("", None), (True, None), (None, None),
        (float("nan"), None), ("nan", None),
    ],
)  # fmt: skip
def test_a_time_is_seconds_or_minutes_and_seconds(given: Any, time: float | None) -> None:
    assert seconds_of(given) == time
