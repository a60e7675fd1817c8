"""Setting off after a stop, and driving on after a turn."""

import pytest

from tests.dialogue.talking import Talk
from xavi_dialogue.nlu.notation import acts_line
from xavi_dialogue.nlu.parse import Parser


@pytest.mark.parametrize(
    "text",
    [
        "why so slow off the line?",
        "why did it take you so long to set off?",
        "what took you so long when it turned green?",
        "why were you so slow to get going?",
        "why did you set off so slowly?",
        "why did you take ages to get going?",
        "why was the start so slow?",
    ],
)
def test_a_slow_start_is_not_going_at_once(text: str) -> None:
    acts = acts_line(Parser().read(text)[0].acts)
    assert acts.startswith("Ask(Why(Not(Happens(Event(go, time=Within)")


@pytest.mark.parametrize("text", ["why are we so slow?", "why are we going slowly?"])
def test_a_turn_that_is_over_was_not_given_up(text: str) -> None:
    """It ended at 8.3 s."""
    reply = Talk("s2-2", 8.8, planner=False).hear(text)
    assert "changed my plan" not in reply


@pytest.mark.parametrize(
    "text", ["which one was the slowest?", "who was the slowest of them?", "the slowest one?"]
)
def test_the_slowest_one_is_of_those_just_told(text: str) -> None:
    reply = Talk("junction-0", 36.0, planner=False).hear("who crossed our way?", text)
    assert "pedestrian" in reply
    assert "car" not in reply
