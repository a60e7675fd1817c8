"""Where a vehicle is said to be: it comes from a side only while it heads for us from there."""

import math

import pytest

from xavi_dialogue.explain.facts.bearings import Offset, bearing


@pytest.mark.parametrize(
    ("ahead", "left", "turn", "word"),
    [
        (30.0, 40.0, -90.0, "crossing-left"),
        (30.0, -40.0, 90.0, "crossing-right"),
        (30.0, -40.0, -90.0, "ahead-right"),  # it has crossed, and moves away
        (-30.0, 12.0, -90.0, "behind-left"),
        (20.0, -14.0, 180.0, "ahead-right"),
        (60.0, 3.5, 180.0, "oncoming"),
        (30.0, 0.5, 0.0, "ahead"),
    ],
)
def test_where_a_vehicle_is(ahead: float, left: float, turn: float, word: str) -> None:
    assert bearing(Offset(ahead, left, math.radians(turn), 5.0)) == word
