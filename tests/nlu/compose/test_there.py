"""Where we are asked to go: a lane that is named, or was just spoken of."""

import pytest

from tests.dialogue.talking import Talk


@pytest.mark.parametrize(
    "text",
    [
        "the middle lane is moving, go there",
        "the left lane is empty, move over there",
        "go into the middle lane",
        "go there",
    ],
)
def test_a_lane_to_go_to_is_not_where_we_go_anyway(text: str) -> None:
    reply = Talk("motorway-0", 10.0, planner=False).say(text).reply.text
    assert "just what I am doing" not in reply


@pytest.mark.parametrize(
    "text",
    ["predicted manoeuvre of vehicle 1?", "predicted path of 1?", "expected behaviour of 1?"],
)
def test_a_prediction_in_other_nouns_is_asked_for(text: str) -> None:
    known = Talk("s1-0", 5.0).say("what is the prediction for vehicle 1?").reply.text
    assert Talk("s1-0", 5.0).say(text).reply.text == known
