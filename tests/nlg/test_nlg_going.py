"""What is said of going, of not having slowed down, and of what others announce."""

from dataclasses import replace

import pytest

from tests.nlg.scenery import CONTEXT
from xavi_dialogue.domain.answers import (
    Bystander,
    GoReason,
    MotionCause,
    PlaceReason,
    SignalReason,
    Unslowed,
)
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.nlg.say import say

E, ONE = Ego(), Vehicle(1)
TURN = Episode(E, "exit-right", 9.0, 11.0)
SLOWED = Episode(E, "slow-down", 5.0, 7.0, speed_from=10.0, speed_to=5.0)
FIRST = MotionCause("right-of-way", 1)


@pytest.mark.parametrize(
    ("answer", "parts"),
    [
        (GoReason(TURN, ()), ("I turned right then because the way was free",)),
        (
            GoReason(TURN, (Bystander(1, "vehicle", "standing", 12.0),)),
            ("(vehicle 1)", "which had right of way, was standing still"),
        ),
        (
            GoReason(TURN, (Bystander(1, "ego", "steady", 12.0),)),
            ("(vehicle 1) had to let us go first",),
        ),
        (
            GoReason(TURN, (Bystander(1, "vehicle", gone=True),)),
            ("I had let", "go first"),
        ),
        (Unslowed(SLOWED, FIRST), ("had right of way", "had to brake for us")),
        (Unslowed(SLOWED, FIRST, 8.0, 8.4), ("at about the same time",)),
        (Unslowed(SLOWED, FIRST, 8.0, 11.0), ("about 3 seconds before",)),
        (Unslowed(SLOWED, MotionCause("turn")), ("I had to take the turn at a safe speed",)),
        (
            SignalReason(1, Episode(ONE, "signal", 9.0, None, side="right"), ("exit-right",), 0.9),
            ("is indicating right", "seems to want to turn right", "90 %"),
        ),
        (
            PlaceReason(1, "behind", Episode(ONE, "give-way", 4.0, 5.0, object=E)),
            ("is behind us because it gave way to us",),
        ),
        (PlaceReason(1, "behind"), ("is going the same way as we are",)),
    ],
)
def test_it_is_said_so(answer, parts):
    text = say(answer, CONTEXT).text
    for part in parts:
        assert part.lower() in text.lower(), text


def test_simpler_words_have_no_figures_but_the_number_of_the_vehicle():
    simple = replace(CONTEXT, detail="simpler")
    signal = Episode(ONE, "signal", 9.0, None, side="right")
    assert "%" not in say(SignalReason(1, signal, ("exit-right",), 0.9), simple).text
    assert "seconds" not in say(Unslowed(SLOWED, FIRST, 8.0, 11.0), simple).text
