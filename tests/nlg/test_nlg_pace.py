"""Pace: the tense and the speed at which somebody who slows us is stated to drive."""

import pytest

from tests.nlg.scenery import NOW, look
from xavi_dialogue.domain.answers import MotionCause, MotionReason
from xavi_dialogue.domain.facts import Episode, Look
from xavi_dialogue.domain.terms import Ego
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.say import say

BEGAN = 16.0  # [s]
BRAKING = MotionReason(
    Episode(Ego(), "brake", BEGAN, speed_from=12.0, speed_to=5.0),
    (MotionCause("leader", 1, speed=10.0),),
)


def seen(time: float, speed: float, *, in_view: bool = True) -> Look:
    return look(1, time, "van", "red", "ahead", speed=speed, in_view=in_view)


@pytest.mark.parametrize(
    ("now", "text"),
    [
        (seen(NOW, 0.0), "is standing ahead of us"),
        (seen(NOW, 5.0), "is driving ahead of us at 18 km/h"),
        (seen(NOW, 10.5), "is driving ahead of us at 36 km/h"),
        (seen(NOW, 15.0), "was driving ahead of us at 36 km/h"),
        (seen(NOW, 10.0, in_view=False), "was driving ahead of us at 36 km/h"),
    ],
)
def test_the_present_tense_takes_the_speed_now(now: Look, text: str) -> None:
    looks = {(1, BEGAN): seen(BEGAN, 10.0), (1, NOW): now}
    assert text in say(BRAKING, SpeechContext(now=NOW, looks=looks)).text
