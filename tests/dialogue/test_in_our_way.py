"""Who is in our way, who goes first, and how it is with us where others would have gone."""

import pytest

from tests.dialogue.talking import Talk


@pytest.mark.parametrize(
    ("ride", "at", "question", "begins"),
    [
        ("junction-0", 12.0, "Is there anybody in our way?", "Yes, the pedestrian (vehicle 8) is"),
        ("s4-0", 10.0, "Is anything in our way?", "Yes, the blue lorry (vehicle 1) is in our way"),
        ("junction-0", 24.0, "Is anyone in our way?", "No, there is no vehicle in our way"),
        ("town-0", 20.0, "Is there a bus in the way?", "No, there is no bus in our way"),
    ],
)
def test_who_is_in_our_way_is_the_nearest_who_is(ride: str, at: float, question: str, begins: str):
    assert Talk(ride, at).hear(question).startswith(begins)


@pytest.mark.parametrize(
    ("at", "question", "begins"),
    [
        (12.0, "Do we have right of way or them?", "The pedestrian coming from the right"),
        (24.0, "Do we let the bicycle go?", "Yes, the green bicycle beside us on the right"),
        (24.0, "Was that normal?", "Yes, waiting for the traffic light was normal"),
        (24.0, "Other drivers would have gone. Why not you?", "I am waiting, because the traffic"),
        (24.0, "The bicycle went. Why didn't you?", "We are standing still, because the traffic"),
    ],
)
def test_what_is_asked_of_us_beside_others(at: float, question: str, begins: str) -> None:
    assert Talk("junction-0", at).hear(question).startswith(begins)


def test_why_not_you_is_about_what_was_just_said_of_others() -> None:
    talk = Talk("junction-0", 12.0)
    talk.hear("How fast are we going?")
    told = talk.hear("Any other driver would have gone by now. Why not you?", "And why?")
    assert "red" in told or "go first" in told
