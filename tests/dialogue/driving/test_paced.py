"""Who sets our pace, and who was the fastest of all."""

import pytest

from tests.dialogue.talking import Talk


@pytest.mark.parametrize(
    "text", ["why are we so slow", "why are we crawling", "why don't we go faster?"]
)
@pytest.mark.parametrize("at", [1.5, 3.0, 5.0])
def test_a_slower_leader_is_why_we_are_no_faster(text: str, at: float) -> None:
    reply = Talk("motorway-0", at).hear(text)
    assert "does not show why" not in reply


@pytest.mark.parametrize(
    "text",
    ["what was the fastest car we've seen", "what's the fastest car so far", "which was fastest?"],
)
def test_the_fastest_of_the_ride_is_told_with_its_speed(text: str) -> None:
    assert Talk("motorway-0", 20.0).hear(text).startswith("The highest speed of the")


@pytest.mark.parametrize(
    "text",
    ["Is that within what you consider safe?", "is that what you call safe?", "is that safe?"],
)
def test_a_standard_of_ours_is_no_question_for_whom_it_holds(text: str) -> None:
    reply = Talk("motorway-0", 20.0).hear("what is the gap to the car ahead?", text)
    assert reply.startswith(("Yes", "No:", "No,"))


@pytest.mark.parametrize("text", ["why can't we do that?", "what's stopping us doing the same?"])
@pytest.mark.parametrize("before", ["how fast is the lorry?", "is the lorry speeding?"])
def test_why_not_that_after_a_pace_of_another_is_why_we_are_no_faster(
    before: str, text: str
) -> None:
    reply = Talk("motorway-0", 20.0).hear(before, text)
    assert reply.startswith("We are driving at")


@pytest.mark.parametrize(
    "text", ["the white lorry is speeding past us", "the white lorry is racing past us"]
)
def test_speeding_past_is_passing(text: str) -> None:
    assert "speeding up" not in Talk("motorway-0", 20.0).hear(text)
