"""What is said of traffic lights, word by word, and what holds of all of it."""

import re
from pathlib import Path
from typing import get_args

import pytest

from tests.nlg import light_cases
from tests.nlg.scenery import CONTEXT
from tests.nlg.test_nlg_causes import DOUBLED, UNTIDY
from xavi_dialogue.domain.traffic_lights import Crossed, LightAnswer, LightPassed, LightTold, Shown
from xavi_dialogue.nlg.say import say

TEXTS = (Path(__file__).parent / "golden" / "light.txt").read_text(encoding="utf-8").splitlines()
TABLE = [
    pytest.param(case, text, id=text[:60])
    for case, text in zip(light_cases.CASES, TEXTS, strict=True)
]


@pytest.mark.parametrize(("answer", "text"), TABLE)
def test_an_answer_about_a_light_is_said(answer, text):
    assert say(answer, CONTEXT).text == text


@pytest.mark.parametrize("answer", light_cases.CASES)
def test_it_is_tidy(answer):
    said = say(answer, CONTEXT).text
    assert not UNTIDY.search(said)
    assert not DOUBLED.search(said)


def spoken(answer):
    return set(re.findall(r"[a-z]+", say(answer, CONTEXT).text.lower()))


def test_every_kind_of_answer_has_a_case():
    assert {type(case) for case in light_cases.CASES} >= set(get_args(LightAnswer))


@pytest.mark.parametrize("colour", ["red", "amber", "green"])
def test_the_colour_that_is_told_is_the_one_that_was_shown(colour):
    shown = Shown(light_cases.LIGHT, colour, 2.0, True)
    others = {"red", "amber", "green"} - {colour}
    for answer in (
        LightTold("colour", shown),
        LightTold("where", shown, distance=20.0),
        LightPassed(Crossed(5.0, 10.0, shown, 3.0), colour, True),
    ):
        words = spoken(answer)
        assert colour in words
        assert not words & others


def test_what_was_not_seen_is_not_told():
    for answer in (LightTold("colour"), LightTold("where"), LightPassed(light_cases.UNSEEN, "red")):
        assert not spoken(answer) & {"red", "green", "amber"}
