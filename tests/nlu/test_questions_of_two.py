"""Questions of two: "ahead or behind", "he waits or we wait", "the limit, and are we over it"."""

import pytest

from xavi_dialogue.domain.meaning import Ask, Request, Whether
from xavi_dialogue.domain.terms import Both, Compares, Described, Exists, Happens, Measured
from xavi_dialogue.nlu.parse import Parser


@pytest.fixture(scope="module")
def parser() -> Parser:
    return Parser()


@pytest.mark.parametrize(
    ("text", "bearings"),
    [
        ("Is there anybody behind us or beside us?", ("behind", "beside")),
        ("Is there a car ahead or behind?", ("ahead", "behind")),
        ("Are there any vans on the left or on the right?", ("left", "right")),
    ],
)
def test_a_second_place_is_of_the_same_description(
    parser: Parser, text: str, bearings: tuple[str, ...]
) -> None:
    act = parser.read(text)[0].acts[0]
    assert isinstance(act, Ask)
    assert isinstance(act.question, Whether)
    both = act.question.that
    assert isinstance(both, Both)
    assert both.join == "or"
    things = [part.thing for part in both.contents if isinstance(part, Exists)]
    assert tuple(t.bearing for t in things if isinstance(t, Described)) == bearings


@pytest.mark.parametrize(
    "text", ["He waits for us or we wait for him?", "It goes first or we go first?"]
)
def test_two_statements_with_or_are_one_question(parser: Parser, text: str) -> None:
    acts = parser.read(text)[0].acts
    assert len(acts) == 1
    act = acts[0]
    assert isinstance(act, Ask)
    assert isinstance(act.question, Whether)
    assert isinstance(act.question.that, Both)
    assert all(isinstance(part, Happens) for part in act.question.that.contents)


@pytest.mark.parametrize(
    ("text", "degree"),
    [
        ("What is the limit and are we over it?", "more"),
        ("How fast are we allowed to go here and are we above it?", "more"),
        ("What is the limit and is he under it?", "less"),
    ],
)
def test_over_it_is_over_the_limit(parser: Parser, text: str, degree: str) -> None:
    acts = parser.read(text)[0].acts
    assert len(acts) == 2
    last = acts[-1]
    assert isinstance(last, Ask)
    assert isinstance(last.question, Whether)
    that = last.question.that
    assert isinstance(that, Compares)
    assert that.comparator == degree
    assert isinstance(that.right, Measured)
    assert that.right.attribute == "limit"


def test_what_a_request_is_for_is_not_asked(parser: Parser) -> None:
    for reading in parser.read("Could you flash your lights so he moves on?"):
        kept = [act for act in reading.acts if not isinstance(act, Request)]
        assert not any(isinstance(act, Ask) for act in kept)
