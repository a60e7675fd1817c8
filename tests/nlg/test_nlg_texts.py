"""What is said of every kind of factual answer, word by word."""

from pathlib import Path
from typing import get_args

import pytest

from tests.nlg import (
    answer_cases,
    danger_cases,
    dialogue_cases,
    journey_cases,
    light_cases,
    measure_cases,
    turn_cases,
)
from tests.nlg.scenery import CONTEXT
from xavi_dialogue.domain.answers import Answer, Measures
from xavi_dialogue.domain.traffic_lights import LightAnswer
from xavi_dialogue.domain.vocabulary import Attribute
from xavi_dialogue.nlg.content.tables import FACTS
from xavi_dialogue.nlg.say import say

GOLDEN = Path(__file__).parent / "golden"


def golden(name: str) -> list[str]:
    return (GOLDEN / f"{name}.txt").read_text(encoding="utf-8").splitlines()


def table(name: str, cases: tuple[object, ...]) -> list[object]:
    texts = golden(name)
    return [pytest.param(case, text, id=text[:60]) for case, text in zip(cases, texts, strict=True)]


@pytest.mark.parametrize(("measures", "text"), table("measure", measure_cases.CASES))
def test_a_measure_is_said_in_the_sentence_of_its_attribute(measures, text):
    assert say(Measures(measures), CONTEXT).text == text


@pytest.mark.parametrize(("answer", "text"), table("answer", answer_cases.CASES))
def test_an_answer_is_said(answer, text):
    assert say(answer, CONTEXT).text == text


@pytest.mark.parametrize(("answer", "text"), table("journey", journey_cases.CASES))
def test_an_answer_about_our_way_is_said(answer, text):
    assert say(answer, CONTEXT).text == text


@pytest.mark.parametrize(("answer", "text"), table("danger", danger_cases.CASES))
def test_an_answer_about_danger_is_said(answer, text):
    assert say(answer, CONTEXT).text == text


@pytest.mark.parametrize(("answer", "text"), table("turn", turn_cases.CASES))
def test_an_answer_about_turns_is_said(answer, text):
    assert say(answer, CONTEXT).text == text


def test_every_attribute_has_a_case():
    cases = {m.attribute for case in measure_cases.CASES for m in case}
    assert cases == set(get_args(Attribute))


def test_every_kind_of_factual_answer_has_a_case():
    cases = {
        type(case)
        for case in (
            *answer_cases.CASES,
            *dialogue_cases.CASES,
            *danger_cases.CASES,
            *turn_cases.CASES,
            *journey_cases.CASES,
            *light_cases.CASES,
        )
    }
    assert set(FACTS) - cases == {Measures}
    assert set(FACTS) <= {*get_args(Answer), *get_args(LightAnswer)}
