"""Questions without "do you"."""

import pytest

from xavi_dialogue.domain.meaning import Ask, Whether
from xavi_dialogue.domain.terms import Believed, Happens
from xavi_dialogue.nlu.parse import Parser


@pytest.fixture(scope="module")
def parser() -> Parser:
    return Parser()


@pytest.mark.parametrize(
    ("text", "action"),
    [
        ("reckon it'll change before we get there?", "turn-colour"),
        ("reckon he'll stop?", "stop"),
        ("so, think he'll let us go?", "let-go"),
    ],
)
def test_what_we_think_is_asked_without_us(parser: Parser, text: str, action: str) -> None:
    (act,) = parser.read(text)[0].acts
    assert isinstance(act, Ask)
    assert isinstance(act.question, Whether)
    of = act.question.that
    assert isinstance(of, Believed)
    assert isinstance(of.content, Happens)
    assert of.content.event.action == action
