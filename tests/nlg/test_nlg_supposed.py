"""What is said of suppositions, sudden acts and requests; see golden/supposed.txt."""

from pathlib import Path

import pytest
from msgspec.structs import replace

from tests.nlg import supposed_cases
from tests.nlg.causal_cases import LATER, effect
from tests.nlg.scenery import CONTEXT
from tests.nlg.test_nlg_properties import check
from xavi_dialogue.domain.answers import ChoiceReason, Share, SupposedOfOther, SupposedOfUs
from xavi_dialogue.domain.reasons import Performed
from xavi_dialogue.domain.terms import Event, Vehicle
from xavi_dialogue.nlg.say import say

GOLDEN = Path(__file__).parent / "golden" / "supposed.txt"
TEXTS = GOLDEN.read_text(encoding="utf-8").splitlines()


@pytest.mark.parametrize(
    ("answer", "text"), list(zip(supposed_cases.CASES, TEXTS, strict=True)), ids=TEXTS
)
def test_a_supposition_is_answered(answer, text):
    said = say(answer, CONTEXT).text
    assert said == text
    check(said)


def test_what_decided_against_a_gain_is_told_with_it():
    """A lane change that was too much for the gain is not kept quiet where it is asked what if."""
    gain = replace(
        LATER,
        fact=("continue",),
        foil=("change-left",),
        causes=(),
        effects=(effect("time", -0.8),),
        told=(Share("effort", 2.0), Share("time", -0.8)),
    )
    text = say(SupposedOfUs(gain), CONTEXT).text
    assert text.endswith("sooner, but it would have taken one more lane change.")
    free = replace(gain, told=(Share("jerk", 2.0),))
    assert "lane change" not in say(SupposedOfUs(free), CONTEXT).text


@pytest.mark.parametrize(
    ("done", "told"),
    [
        (Performed("exit-right", "did", 4.0), "That is just what I did: I turned right at 0:04."),
        (Performed("exit-right", "doing", 4.0), "That is just what I am doing."),
        (Performed("exit-right", "will"), "That is just what I plan to do: to turn right."),
    ],
)
def test_what_is_done_is_told_alone_and_in_its_tense(done, told):
    """The whole plan is not told as done: only what is asked about."""
    plan = replace(LATER, fact=("continue", "exit-right"), foil=(), effects=(), verdict="close")
    said = say(SupposedOfUs(plan, done=done, past=done.when == "did"), CONTEXT).text
    assert said.startswith(told)
    check(said)


@pytest.mark.parametrize(
    ("later", "told"),
    [
        (Performed("change-left", "did", 4.0), "I moved to the left lane later at 0:04."),
        (Performed("change-left", "doing", 4.0), "I am doing so now."),
        (Performed("change-left", "will"), "I plan to move to the left lane later on."),
    ],
)
def test_what_was_compared_and_done_later_is_told(later, told):
    for answer in (
        SupposedOfUs(LATER, later=later),
        ChoiceReason("why-not", None, LATER, later=later),
    ):
        said = say(answer, CONTEXT).text
        assert told in said
        check(said)
        assert told not in say(replace(answer, later=None), CONTEXT).text


def test_all_of_whom_it_is_supposed_are_named():
    one = SupposedOfOther(2, None, None, LATER.fact, LATER.fact, True, None, False)
    alone = say(one, CONTEXT).text
    both = say(replace(one, others=(1,)), CONTEXT).text
    assert "vehicle 2" in alone
    assert "vehicle 1" not in alone
    assert "vehicle 1" in both
    assert "vehicle 2" in both
    brakes = replace(one, supposed=Event("brake", Vehicle(2)), others=(1,))
    assert "vehicle 1" in say(brakes, CONTEXT).text
    nobody = say(replace(one, others=(1,), everybody=True), CONTEXT).text
    assert nobody.startswith("Even if nobody else was around, I would still")


def test_who_is_left_out_is_named():
    one = SupposedOfOther(2, None, None, LATER.fact, LATER.fact, True, None, False)
    said = say(replace(one, left_out=(1,)), CONTEXT).text
    assert "one vehicle at a time only" in said
    assert "vehicle 1" in said
    check(said)


def test_when_it_could_last_be_done_is_told():
    for answer in (
        SupposedOfUs(LATER, open_at=5.0),
        ChoiceReason("why-not", None, LATER, open_at=5.0),
    ):
        said = say(answer, CONTEXT).text
        assert "I last had that choice at 0:05." in said
        check(said)
        assert "last had" not in say(replace(answer, open_at=None), CONTEXT).text


def test_what_did_not_come_about_is_no_condition_of_anybody():
    asked = Event("brake", tense="past", modal="would")
    one = SupposedOfOther(2, None, None, LATER.fact, LATER.fact, True, asked=asked, undone=True)
    for still, words in (
        (False, "I did not brake, and would not have without"),
        (True, "I did not brake, but without"),
    ):
        said = say(replace(one, still=still), CONTEXT).text
        assert said.startswith(words)
        assert "still" not in said
        check(said)
