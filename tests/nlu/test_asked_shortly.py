"""Questions without "do you"."""

import pytest

from xavi_dialogue.domain.meaning import Ask, Compare, HowLong, Whether
from xavi_dialogue.domain.terms import Believed, Event, Feature, Happens
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


@pytest.mark.parametrize(
    "text",
    [
        "what took longer, the light or the people",
        "which took longer, the light or the pedestrians?",
        "what cost us more, the light or the pedestrians?",
    ],
)
def test_what_took_longer_asks_how_long_we_waited_for_each(parser: Parser, text: str) -> None:
    asked = [act.question for act in parser.read(text)[0].acts if isinstance(act, Ask)]
    waits = [one.of for one in asked if isinstance(one, HowLong)]
    assert [isinstance(one, Event) and one.action for one in waits] == ["wait", "wait"]
    assert isinstance(waits[0], Event)
    assert waits[0].object == Feature("light")


def test_which_of_two_vehicles_is_longer_is_of_their_size(parser: Parser) -> None:
    (act,) = parser.read("which is longer, the bus or the van?")[0].acts
    assert isinstance(act, Ask)
    assert isinstance(act.question, Compare)
    assert act.question.by == "size"
