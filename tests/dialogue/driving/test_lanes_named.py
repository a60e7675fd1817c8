"""Lanes that are named by their side, or spoken of before, and what following somebody cost."""

import pytest

from tests.dialogue.talking import Talk
from xavi_dialogue.domain.meaning import Ask, HowMuch, Why
from xavi_dialogue.domain.terms import Described, Event, Happens, Is, Lane, Measured, Not
from xavi_dialogue.nlu.parse import Parser


@pytest.mark.parametrize(
    ("text", "lane"),
    [
        ("The middle lane's moving. Why aren't we in it?", Lane("other")),
        ("the right lane is free, why aren't we there", Lane("right")),
        ("the right is empty, why don't we go there", Lane("right")),
        ("the middle lane is moving, why are we not in that one", Lane("other")),
    ],
)
def test_why_we_are_not_in_a_lane_is_why_we_do_not_change_there(text: str, lane: Lane) -> None:
    acts = [reading.acts for reading in Parser().read(text)]
    change = Event("change-lane", object=lane, tense="present")
    assert (Ask(Why(Not(Happens(change)))),) in acts


@pytest.mark.parametrize(
    ("text", "lane"),
    [
        ("the left's free, isn't it", Lane("left")),
        ("is the left clear", Lane("left")),
        ("the right is empty", Lane("right")),
        ("the middle's empty next to us", Lane("other")),
    ],
)
def test_a_side_with_an_article_is_the_lane_there(text: str, lane: Lane) -> None:
    [act] = Parser().read(text)[0].acts
    that = act.question.that if isinstance(act, Ask) else act.that  # type: ignore[union-attr]
    assert that == Is("free", lane, tense="present")


@pytest.mark.parametrize("text", ["and the right?", "what about the right?", "and the right lane?"])
def test_a_side_behind_a_question_for_a_lane_change_is_the_change_there(text: str) -> None:
    reply = Talk("motorway-0", 3.0).hear("why don't we move left?", text)
    assert reply == Talk("motorway-0", 3.0).hear("why don't we move right?")


@pytest.mark.parametrize(
    "text",
    [
        "how much time did we lose behind the lorry",
        "what have we lost by staying behind the lorry",
        "how many seconds have we lost behind the lorry?",
    ],
)
def test_time_lost_behind_somebody_is_lost_by_following(text: str) -> None:
    [act] = Parser().read(text)[0].acts
    assert isinstance(act, Ask)
    assert isinstance(act.question, HowMuch)
    of = act.question.of
    assert isinstance(of, Measured)
    assert of.attribute == "delay"
    assert of.event is not None
    assert (of.event.action, of.event.object) == ("follow", Described("truck"))
