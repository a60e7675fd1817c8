"""Whether one vehicle alone is the cause: "only because of the lorry?"."""

import pytest

from xavi_dialogue.domain.meaning import Ask, Why
from xavi_dialogue.domain.terms import Vehicle
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
