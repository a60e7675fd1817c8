"""What is said of lanes left alone, of moves to come, and of gains that a question claims."""

import pytest
from msgspec.structs import replace

from tests.nlg.causal_cases import CHANGED, CLOSE, EFFORT, LATER, RISKY, ends
from tests.nlg.scenery import CONTEXT
from xavi_dialogue.domain.answers import (
    ChoiceReason,
    MotionCause,
    MotionReason,
    Share,
    SupposedOfUs,
)
from xavi_dialogue.domain.evidence import Effect
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.nlg.content.clauses.manoeuvres import own_verbs
from xavi_dialogue.nlg.say import say
from xavi_dialogue.nlg.surface.orthography import join

E = Ego()
BRAKING = Episode(E, "brake", 20.0, None, speed_from=13.0, speed_to=11.0)
LETTING = Episode(E, "give-way", 8.0, 10.0, object=Vehicle(2))
BESIDE = MotionCause("lane-beside", 1)
STANDS = MotionCause("lane-ahead", 1, speed=0.0, value=40.0)
SLOW = MotionCause("lane-ahead", 1, speed=8.0, value=40.0)
NO_LANE = replace(EFFORT, verdict="alone", told=(), terms=(), causes=(), outcome=None)
GAIN = (Effect("time", "s", -1.5, -2.0, -1.0, 20, 8),)
GAINS = replace(LATER, effects=GAIN, causes=(), told=(Share("time", -1.5),), verdict="worse")


@pytest.mark.parametrize(
    ("answer", "part"),
    [
        (ChoiceReason("why-not", None, NO_LANE, ahead=BESIDE), "was right beside us in that lane"),
        (
            ChoiceReason("why-not", None, NO_LANE, ahead=STANDS),
            "was standing in that lane about 40 metres ahead",
        ),
        (
            ChoiceReason("why-not", None, NO_LANE, ahead=SLOW),
            "was driving at only 29 km/h in that lane",
        ),
        (
            ChoiceReason("why-not", None, replace(EFFORT, causes=(), cleared=(1,)), ahead=BESIDE),
            "; besides, the red lorry",
        ),
        (
            ChoiceReason(
                "why", CHANGED, replace(CLOSE, causes=()), ahead=MotionCause("leader", 1, speed=8.0)
            ),
            "was driving ahead of us at 29 km/h, though it made little difference",
        ),
        (
            MotionReason(BRAKING, (MotionCause("next-move", actions=("change-left",)),)),
            "I am getting ready to move to the left lane",
        ),
        (
            MotionReason(BRAKING, (MotionCause("cut-in", 1, ("change-right",), 0.5),)),
            "may well move in ahead of us (50 %)",
        ),
        (SupposedOfUs(GAINS, claimed=300.0, form="quicker"), "Hardly that much: we would have"),
        (SupposedOfUs(GAINS, claimed=0.5, form="quicker"), "More than that: we would have"),
        (SupposedOfUs(GAINS, claimed=1.5, form="quicker"), "Yes, we would have"),
    ],
)
def test_the_reason_is_in_the_words_of_a_passenger(answer, part):
    assert part in say(answer, CONTEXT).text


def test_who_would_crash_is_not_said_to_be_in_time():
    late = (Share("collision", 80.0, 0.46, 0.02), Share("late", -9.0, 0.0, 1.0))
    said = say(ChoiceReason("why", CHANGED, replace(RISKY, told=late, terms=late)), CONTEXT).text
    assert "46 %" in said
    assert "in time" not in said


def test_a_lane_that_we_need_next_is_the_reason_not_to_leave_it():
    foil = replace(ends("termination"), foil=("change-left",), fact=("continue", "change-right"))
    said = say(ChoiceReason("why-not", None, replace(foil, route="change-right")), CONTEXT).text
    assert "as we had to move to the right lane next" in said


def test_driving_on_beside_a_stop_is_not_staying_in_a_lane():
    assert own_verbs(("continue",), ("stop", "change-left")) == own_verbs(("continue",))
    assert own_verbs(("continue",), ("change-left",)) != own_verbs(("continue",))


@pytest.mark.parametrize(
    ("words", "text"),
    [("a 11 % risk", "an 11 % risk"), ("a 80 % risk", "an 80 % risk"), ("a 1 % risk",) * 2],
)
def test_the_article_fits_the_figure(words, text):
    assert join((words,)) == text
