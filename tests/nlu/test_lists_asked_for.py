"""Lists of what happened, asked for in several wordings."""

import pytest

from xavi_dialogue.domain.meaning import Ask, Listing
from xavi_dialogue.nlu.parse import Parser


@pytest.fixture(scope="module")
def parser() -> Parser:
    return Parser()


def listing(parser: Parser, text: str) -> Listing:
    (act,) = parser.read(text)[0].acts
    assert isinstance(act, Ask)
    assert isinstance(act.question, Listing)
    return act.question


@pytest.mark.parametrize(
    "text",
    [
        "List all the times you braked hard.",
        "list every time you braked hard",
        "list all the moments when you braked hard",
        "Give me a list of all the times you braked hard.",
    ],
)
def test_times_of_a_deed_are_those_of_its_manner(parser: Parser, text: str) -> None:
    event = listing(parser, text).event
    assert event is not None
    assert (event.action, event.manner, event.object) == ("brake", ("hard",), None)


@pytest.mark.parametrize(
    "text",
    [
        "Give me a list of everyone you gave way to since we set off.",
        "make a list of everybody you gave way to",
        "list everyone you gave way to",
    ],
)
def test_a_list_of_whom_is_no_account_of_the_ride(parser: Parser, text: str) -> None:
    event = listing(parser, text).event
    assert event is not None
    assert event.action == "give-way"


def test_decisions_during_a_deed_stay_decisions(parser: Parser) -> None:
    assert listing(parser, "list your decisions during the turn").of == "decisions"
