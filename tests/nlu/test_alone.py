"""Whether one vehicle alone is the cause: "only because of the lorry?"."""

import pytest

from xavi_dialogue.domain.meaning import Ask, Elliptic, Why
from xavi_dialogue.domain.terms import SOMEBODY_ELSE, Vehicle
from xavi_dialogue.nlu.interpret import interpret
from xavi_dialogue.nlu.parse import Parser

PARSER = Parser()


@pytest.mark.parametrize(
    ("text", "alone"),
    [
        ("Was it only because of vehicle 2?", True),
        ("Was it just because of vehicle 2?", True),
        ("Was it because of vehicle 2 alone?", True),
        ("Was it solely because of vehicle 2?", True),
        ("Did you slow down only because of vehicle 2?", True),
        ("You slowed down only because of vehicle 2?", True),
        ("Did you stop just for vehicle 2?", True),
        ("Was vehicle 2 the only reason?", True),
        ("Was it because of vehicle 2 and nobody else?", True),
        ("Was it because of vehicle 2?", False),
        ("Did you just brake because of vehicle 2?", False),
        ("Was it not only because of vehicle 2?", False),
    ],
)
def test_whether_it_is_one_alone_is_read(text: str, alone: bool) -> None:
    (act,) = PARSER.read(text)[0].acts
    assert isinstance(act, Ask)
    assert isinstance(act.question, Why)
    assert (act.question.suspect, act.question.alone) == (Vehicle(2), alone)


@pytest.mark.parametrize(
    "text",
    [
        "Was it because of nobody else?",
        "Was it because of anybody else?",
        "Was anyone else a reason?",
        "Was no one else a reason?",
        "Did anybody else matter?",
        "Did nobody else matter?",
    ],
)
def test_whether_others_are_the_cause_is_read(text: str) -> None:
    (act,) = PARSER.read(text)[0].acts
    assert isinstance(act, Ask)
    assert isinstance(act.question, Why)
    assert act.question.suspect == SOMEBODY_ELSE


@pytest.mark.parametrize(
    "text", ["And nobody else?", "Nobody else?", "No one else?", "Anyone else?", "Who else?"]
)
def test_somebody_else_stands_for_itself(text: str) -> None:
    assert interpret(text)[0].acts == (Elliptic(SOMEBODY_ELSE),)


def test_a_vehicle_may_matter() -> None:
    (act,) = PARSER.read("Did vehicle 2 matter?")[0].acts
    assert isinstance(act, Ask)
    assert isinstance(act.question, Why)
    assert act.question.suspect == Vehicle(2)
