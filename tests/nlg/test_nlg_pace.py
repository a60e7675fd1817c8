"""Pace: the tense and the speed at which somebody who slows us is stated to drive."""

import pytest
from msgspec.structs import replace

from tests.nlg.causal_cases import LATER, THEN
from tests.nlg.scenery import NOW, look
from xavi_dialogue.domain.answers import Cause, ChoiceReason, Mechanism, MotionCause, MotionReason
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


@pytest.mark.parametrize(
    ("before", "text"),
    [
        (4.5, "to stop ahead of us later"),
        (7.0, "was stopping ahead of us"),
    ],
)
def test_who_drives_on_stops_in_the_rollouts_alone(before: float, text: str) -> None:
    """The lowest speed of a hold-up may be reached late in a rollout."""
    halts = Cause(1, ("continue",), 1.0, Mechanism("leader", 4.5, 0.0, 9.0, 0.9, present=True))
    told = replace(LATER, causes=(halts,))
    looks = {(1, t): seen(t, s) for t, s in ((THEN - 1.0, before), (THEN, 4.5), (NOW, 4.5))}
    answer = ChoiceReason("why", None, told, past=True)
    assert text in say(answer, SpeechContext(now=NOW, looks=looks)).text
