"""What only a dialogue says: questions back, quizzes, unknown words, and answers said again."""

from dataclasses import replace
from pathlib import Path

import pytest

from tests.nlg import dialogue_cases
from tests.nlg.dialogue_cases import CHANGED, STOPPED, between
from tests.nlg.scenery import CONTEXT
from tests.nlg.test_nlg_properties import check
from xavi_dialogue.domain.answers import Judged
from xavi_dialogue.domain.meaning import Whether, Why
from xavi_dialogue.nlg.say import say

GOLDEN = Path(__file__).parent / "golden" / "dialogue.txt"


def spoken(case):
    """Write the text, and the choices that it offers, as they stand in the golden file."""
    said = say(case, CONTEXT)
    return " | ".join((said.text, *said.choices))


CASES = [
    pytest.param(case, text, id=text[:60])
    for case, text in zip(
        dialogue_cases.CASES, GOLDEN.read_text(encoding="utf-8").splitlines(), strict=True
    )
]


@pytest.mark.parametrize(("case", "text"), CASES)
def test_it_is_said(case, text):
    assert spoken(case) == text
    check(say(case, CONTEXT).text)


@pytest.mark.parametrize("case", dialogue_cases.CLARIFICATIONS)
def test_choices_are_one_sentence_and_differ(case):
    said = say(case, CONTEXT)
    assert len(set(said.choices)) == len(said.choices)
    if said.choices:
        assert said.text.startswith("Do you mean (1) ")
        assert said.text.count("?") == 1
    assert not any(choice.startswith(("I ", "My ")) for choice in said.choices)


def test_readings_that_differ_only_in_the_type_of_question_say_the_type():
    said = say(between(Why(STOPPED), Whether(STOPPED)), CONTEXT)
    assert said.choices == ("Why did you stop?", "Did you stop?")


def test_readings_that_cannot_be_told_apart_are_not_offered():
    assert say(between(Why(CHANGED), Why(CHANGED)), CONTEXT).choices == ()


@pytest.mark.parametrize("turn", [0, 1, 2])
def test_the_words_of_a_verdict_take_turns(turn):
    cases = [case for case in dialogue_cases.CASES if isinstance(case, Judged)]
    texts = [say(case, replace(CONTEXT, turn=turn)).text for case in cases]
    before = [say(case, replace(CONTEXT, turn=turn + 1)).text for case in cases]
    assert texts != before
    for text in texts:
        check(text)
