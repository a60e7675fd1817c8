"""Whether we look around us, and whether our lane is the one to be in."""

import pytest

from tests.dialogue.talking import Talk
from xavi_dialogue.nlu.notation import acts_line
from xavi_dialogue.nlu.parse import Parser


def read(text: str) -> str:
    return acts_line(Parser().read(text)[0].acts)


@pytest.mark.parametrize(
    "text",
    [
        "did you check your mirrors?",
        "did you check your blind spot before you turned?",
        "did you look both ways",
        "do you look left and right?",
        "are you paying attention?",
        "are you concentrating?",
        "were you watching the road?",
    ],
)
def test_looking_around_is_attending(text: str) -> None:
    assert "Is(awake, Ego" in read(text)


@pytest.mark.parametrize(
    "text", ["did you check your mirrors?", "did you look both ways before you set off?"]
)
def test_whom_we_saw_is_told(text: str) -> None:
    reply = Talk("junction-0", 34.5, planner=False).hear(text)
    assert reply.startswith("I look to all sides at all times")
    assert "nearest that I saw at 0:" in reply


def test_whom_we_see_is_told() -> None:
    reply = Talk("junction-0", 20.0, planner=False).hear("are you paying attention?")
    assert "nearest that I see" in reply


@pytest.mark.parametrize(
    "text",
    [
        "is this the last turn?",
        "was that the final turn?",
        "any more turns?",
        "any turns left?",
        "are there more turns coming?",
        "do we have any more turns?",
        "how many more turns before we arrive?",
    ],
)
def test_turns_that_are_left_are_counted(text: str) -> None:
    assert read(text) == "Ask(HowMany(Event(turn, tense=future)))"


@pytest.mark.parametrize("text", ["any more left turns?", "are there any left turns left?"])
def test_turns_to_one_side_are_counted(text: str) -> None:
    assert read(text) == "Ask(HowMany(Event(exit-left, tense=future)))"


@pytest.mark.parametrize(
    ("text", "acts"),
    [
        ("are we in the correct lane?", "Ask(Whether(Is(right, Lane)))"),
        ("are we in the right lane for the turn?", "Ask(Whether(Is(right, Lane)))"),
        ("are you in the right lane to turn off?", "Ask(Whether(Is(right, Lane)))"),
        ("are we in the wrong lane?", "Ask(Whether(Not(Is(right, Lane))))"),
        ("are we in the right lane?", "Ask(Whether(Related(on, Ego, Lane(right))))"),
    ],
)
def test_the_right_lane_for_something_is_the_one_to_be_in(text: str, acts: str) -> None:
    assert read(text) == acts


@pytest.mark.parametrize(
    "text",
    ["are we in the right lane for where we're going?", "are we in the wrong lane?"],
)
def test_whether_the_plan_leaves_our_lane_is_told(text: str) -> None:
    reply = Talk("junction-0", 9.0, planner=False).hear(text)
    assert reply.startswith("We are in the only lane here, and my plan has no lane change")


@pytest.mark.parametrize(
    "text", ["are you keeping to it?", "and are you sticking to it?", "do you stick to that?"]
)
def test_a_limit_just_told_is_what_is_kept_to(text: str) -> None:
    reply = Talk("junction-0", 9.0, planner=False).hear("what is the limit here?", text)
    assert "the limit here is" in reply
