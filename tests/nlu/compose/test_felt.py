"""What passengers feel the car do is stated of it, and no request for it."""

import pytest

from tests.dialogue.talking import Talk
from xavi_dialogue.domain.meaning import Ask, Claim, Feel, Why
from xavi_dialogue.domain.terms import Ego, Happens
from xavi_dialogue.nlu.parse import Parser


@pytest.fixture(scope="module")
def parser() -> Parser:
    return Parser()


@pytest.mark.parametrize(
    ("text", "action"),
    [
        ("I felt us brake just now", "slow-down"),
        ("I felt the car slow down", "slow-down"),
        ("just felt us brake", "slow-down"),
        ("i felt you brake hard", "brake"),
        ("I felt us swerve to the left", "swerve"),
        ("I felt the car brake there", "slow-down"),
    ],
)
def test_what_is_felt_is_stated_of_us(parser: Parser, text: str, action: str) -> None:
    (act,) = parser.read(text)[0].acts
    assert isinstance(act, Claim)
    assert isinstance(act.that, Happens)
    assert act.that.event.action == action
    assert act.that.event.actor == Ego()


@pytest.mark.parametrize(
    "text",
    [
        "I felt us slow down, what for?",
        "I felt us brake just now, why?",
        "I just felt the car brake. What was that for?",
    ],
)
def test_a_reason_beside_it_is_asked_of_it(parser: Parser, text: str) -> None:
    (act,) = parser.read(text)[0].acts
    assert isinstance(act, Ask)
    assert isinstance(act.question, Why)
    assert isinstance(act.question.of, Happens)
    assert act.question.of.event.action == "slow-down"


@pytest.mark.parametrize("text", ["I feel sick", "I felt it in my tummy", "I feel scared"])
def test_a_feeling_stays_one(parser: Parser, text: str) -> None:
    (act,) = parser.read(text)[0].acts
    assert isinstance(act, Feel)


@pytest.mark.parametrize("text", ["I felt us brake just now", "I felt the car slow down there"])
def test_what_was_felt_is_agreed_to(text: str) -> None:
    reply = Talk("junction-0", 12.0).say(text).reply.text
    assert "makes you nervous" not in reply
    assert not reply.startswith(("Actually", "No"))
