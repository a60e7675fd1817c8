"""What else would have come of the past: where that would leave us, and when it is judged."""

import pytest

from tests.dialogue.talking import Talk


@pytest.mark.parametrize(
    "text",
    [
        "Would we have arrived by now if we hadn't stopped?",
        "where would we be now if we had not stopped",
        "If you had not stopped, would we be there by now?",
    ],
)
def test_where_we_would_be_without_our_stop_is_told_in_time(text: str) -> None:
    assert "seconds sooner" in Talk("s4-0").hear(text)


@pytest.mark.parametrize(
    "text",
    [
        "if it hadn't stopped, where would we be now?",
        "Where would we be now if he had driven on?",
        "and if he had kept going?",
        "what would have happened if it had moved on",
    ],
)
def test_who_held_us_up_would_have_freed_our_way(text: str) -> None:
    said = Talk("s4-0").hear("Why did you brake at 20 s?", text)
    assert "dropped back" not in said
    assert "braked as hard" not in said


@pytest.mark.parametrize(
    "text",
    [
        "What would you have done at 20 s if the road had been clear?",
        "at 20 seconds, what would you have done if the way had been free?",
    ],
)
def test_a_free_way_is_one_with_nobody_else(text: str) -> None:
    said = Talk("s4-0").say(text).reply
    assert said.reason == "planner-unavailable"  # the plan without the others is asked for
