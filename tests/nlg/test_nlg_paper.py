"""Style `paper`: every sentence of the paper's tables, word for word."""

import pytest

from planner.record.trace import UNITS
from xavi_dialogue.domain.answers import (
    Cause,
    ChoiceReason,
    Contrast,
    Effect,
    Evidence,
    OutcomeEstimate,
    SupposedOfUs,
)
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.paper import raw_words
from xavi_dialogue.nlg.say import say as speak

CUT_AND_TURN = ("change-right", "exit-right")


def explanation(foil, outcome="done", probability=1.0, effects=(), causes=(), *, hit=None):
    return Contrast(
        fact=("change-left", "continue"),
        foil=foil,
        outcome=OutcomeEstimate(outcome, probability, hit),
        effects=effects,
        causes=causes,
        evidence=Evidence("tree", 120, 32, ("0123456789abcdef",)),
        decided=1.0,
    )


def effect(component, delta, spread=0.4):
    return Effect(component, UNITS[component], delta, delta - spread, delta + spread, 60, 20)


def cause(vehicle, actions, probability):
    return Cause(vehicle, actions, probability)


SLOWER = effect("time", 4.0)
MORE_JERK = effect("jerk", 0.4)
LESS_TURNING = effect("angular-acceleration", -0.2)
ONE = cause(1, CUT_AND_TURN, 0.5)
TWO = cause(2, ("exit-right",), 1.0)
TURNS_LEFT = cause(1, ("exit-left",), 0.8)


def say(found: Contrast, effects: int = 1, causes: int = 1) -> str:
    context = SpeechContext(style="paper", max_effects=effects, max_causes=causes)
    texts = {
        speak(ChoiceReason("why", None, found), context).text,
        speak(SupposedOfUs(found), context).text,
    }
    assert len(texts) == 1
    return texts.pop()


@pytest.mark.parametrize(
    ("found", "sentence"),
    [
        (
            explanation(("continue",), "done", 0.8, (SLOWER,), (ONE,)),
            "If ego had gone straight then it would have likely reached the goal slower because "
            "vehicle 1 probably changes right then exits right.",
        ),
        (
            explanation(("continue",), "collision", 0.8, (), (ONE,), hit=1),
            "If ego had gone straight then it would have likely collided with vehicle 1 because "
            "vehicle 1 probably changes right then exits right.",
        ),
        (
            explanation(("exit-right",), "dead"),
            "If ego had turned right then it would have not reached the goal.",
        ),
        (
            explanation(("exit-right",), "collision", 1.0, (), (ONE,), hit=1),
            "If ego had turned right then it would have collided with vehicle 1 because "
            "vehicle 1 probably changes right and exits right.",
        ),
    ],
)
def test_table_1(found: Contrast, sentence: str) -> None:
    assert say(found) == sentence


@pytest.mark.parametrize(
    ("found", "sentence"),
    [
        (
            explanation(("exit-straight",), "dead"),
            "If ego had gone straight then it would have not reached the goal.",
        ),
        (
            explanation(("exit-straight",), "dead", 1.0, (), (TURNS_LEFT,)),
            "If ego had gone straight then it would have not reached the goal because "
            "vehicle 1 likely turns left.",
        ),
        (
            explanation(("exit-left",), "dead"),
            "If ego had turned left then it would have not reached the goal.",
        ),
        (
            explanation(("exit-left",), "dead", 1.0, (), (TURNS_LEFT,)),
            "If ego had turned left then it would have not reached the goal because "
            "vehicle 1 likely turns left.",
        ),
    ],
)
def test_table_2(found: Contrast, sentence: str) -> None:
    assert say(found) == sentence


@pytest.mark.parametrize(
    ("effects", "causes", "rest"),
    [
        (1, 1, "slower because vehicle 1 probably changes right then exits right."),
        (
            1,
            2,
            "slower because vehicle 1 probably changes right then exits right and "
            "vehicle 2 exits right.",
        ),
        (
            2,
            1,
            "slower and with more jerk because vehicle 1 probably changes right then exits right.",
        ),
        (
            3,
            1,
            "slower and with more jerk and with less angular acceleration because "
            "vehicle 1 probably changes right then exits right.",
        ),
    ],
)
def test_table_3(effects: int, causes: int, rest: str) -> None:
    found = explanation(("continue",), "done", 0.8, (SLOWER, MORE_JERK, LESS_TURNING), (ONE, TWO))
    start = "If ego had gone straight then it would have likely reached the goal "
    assert say(found, effects, causes) == start + rest


def test_effects_come_in_the_order_of_the_paper() -> None:
    """Largest first in their own units, whatever they are worth to the planner."""
    found = explanation(("continue",), "done", 0.8, (LESS_TURNING, SLOWER, MORE_JERK), (ONE,))
    for effects, rest in (
        (1, "slower because"),
        (2, "slower and with more jerk because"),
        (3, "slower and with more jerk and with less angular acceleration because"),
    ):
        assert f"reached the goal {rest}" in say(found, effects)


def test_the_raw_sentence_is_that_of_the_paper() -> None:
    """The example of section 3.4, before post-processing."""
    found = explanation(
        ("continue",), "done", 0.75, (effect("time", -5.0),), (cause(1, ("change-right",), 0.6),)
    )
    words = raw_words(found, SpeechContext(style="paper"))
    assert " ".join(words) == (
        "if ego had continued ahead then it would have likely reached its goal "
        "with lower time to goal because vehicle 1 would have probably changed right ."
    )


@pytest.mark.parametrize(
    ("probability", "adverb"),
    [
        (0.0, "never "),
        (1e-12, "never "),
        (0.2, "unlikely "),
        (0.33, "unlikely "),
        (0.5, "probably "),
        (0.67, "probably "),
        (0.68, "likely "),
        (1 - 1e-6, "likely "),
        (1 - 1e-12, ""),
        (1.0, ""),
    ],
)
def test_adverbs_have_the_papers_thresholds(probability: float, adverb: str) -> None:
    found = explanation(("continue",), "done", probability, (SLOWER,))
    assert say(found) == (
        f"If ego had gone straight then it would have {adverb}reached the goal slower."
    )


@pytest.mark.parametrize(
    ("delta", "phrase"),
    [(-2.0, "faster"), (0.0, "in the same time"), (2.0, "slower")],
)
def test_the_sign_of_a_time_difference(delta: float, phrase: str) -> None:
    found = explanation(("continue",), "done", 1.0, (effect("time", delta),))
    assert say(found).endswith(f"reached the goal {phrase}.")


def test_effects_belong_to_journeys_that_arrive() -> None:
    found = explanation(("continue",), "dead", 1.0, (SLOWER,), ())
    assert "slower" not in say(found)


def test_two_causes_of_one_vehicle_share_their_subject() -> None:
    causes = (cause(1, ("change-right",), 0.5), cause(1, ("exit-right",), 1.0))
    found = explanation(("exit-right",), "done", 1.0, (SLOWER,), causes)
    assert say(found, causes=2).endswith(
        "because vehicle 1 probably changes right and exits right."
    )
