"""The range of a difference in time that is told where more is wanted."""

from dataclasses import replace

import msgspec
import pytest

from tests.nlg.causal_cases import AHEAD, CHANGED, LATER
from tests.nlg.scenery import CONTEXT
from xavi_dialogue.domain.answers import ChoiceReason, Contrast
from xavi_dialogue.domain.evidence import TimeRange
from xavi_dialogue.nlg.say import say

SAID = "In nine of ten cases like that, it comes out"


def told(low: float, high: float, contrast: Contrast = LATER) -> str:
    found = msgspec.structs.replace(contrast, likely=TimeRange(low, high, 0.9, 120))
    text = say(ChoiceReason("why", CHANGED, found), replace(CONTEXT, detail="more")).text
    return next((s for s in text.split(". ") if s.startswith(SAID)), "").removeprefix(SAID).strip()


@pytest.mark.parametrize(
    ("low", "high", "text"),
    [
        (0.5, 5.0, "half a second to 5 seconds later"),
        (-5.0, -2.0, "2 to 5 seconds sooner"),
        (-2.0, 5.0, "between 2 seconds sooner and 5 seconds later"),
        (-0.1, 5.0, "at most 5 seconds later"),
        (-5.0, 0.2, "at most 5 seconds sooner"),
        (2.0, 2.9, ""),  # not worth telling
    ],
)
def test_the_calibrated_range_is_told_in_plain_words(low: float, high: float, text: str) -> None:
    assert told(low, high) == text


def test_with_a_place_on_the_way_the_range_is_told_to_be_to_the_destination() -> None:
    ahead = msgspec.structs.replace(LATER, aim=AHEAD)
    assert told(1.0, 6.0, ahead) == "1 to 6 seconds later at our destination"


def test_where_the_calibration_does_not_reach_no_range_is_told() -> None:
    """The range over the rollouts, from 1 to 6 seconds, is not told in its place."""
    none = msgspec.structs.replace(LATER, likely=None)
    text = say(ChoiceReason("why", CHANGED, none), replace(CONTEXT, detail="more")).text
    assert "situations that I simulated" in text
    assert SAID not in text
    assert "1 to 6" not in text
