"""Speeds and lanes that are said beside a verb, and how far the trip is."""

import pytest

from xavi_dialogue.domain.meaning import Ask, Claim, HowLong, HowMuch, Whether, Why
from xavi_dialogue.domain.terms import (
    Both,
    Compares,
    Ego,
    Event,
    Happens,
    Is,
    Measured,
    Not,
    Quantity,
    Related,
    WholeRide,
)
from xavi_dialogue.nlu.parse import Parser


@pytest.fixture(scope="module")
def parser() -> Parser:
    return Parser()


def question(parser: Parser, text: str) -> object:
    (act,) = parser.read(text)[0].acts
    assert isinstance(act, Ask), act
    return act.question


@pytest.mark.parametrize(
    ("text", "comparator"),
    [
        ("did we ever get above 40", "more"),
        ("Did we ever go over 40?", "more"),
        ("did we ever drop below 40", "less"),
        ("did you ever stay under 40?", "less"),
    ],
)
def test_a_number_above_or_below_which_we_ever_got_is_a_speed_of_the_ride(
    parser: Parser, text: str, comparator: str
) -> None:
    asked = question(parser, text)
    assert isinstance(asked, Whether)
    of = asked.that
    assert isinstance(of, Compares)
    assert (of.left.attribute, of.left.time, of.comparator) == ("speed", WholeRide(), comparator)
    assert isinstance(of.right, Quantity)
    assert of.right.value == pytest.approx(40.0 / 3.6)


@pytest.mark.parametrize(
    "text",
    [
        "any reason we never got above 40",
        "is there a reason we never went over 40?",
        "why did we never get above 40 here",
    ],
)
def test_any_reason_asks_why(parser: Parser, text: str) -> None:
    asked = question(parser, text)
    assert isinstance(asked, Why)
    assert isinstance(asked.of, Not)
    assert isinstance(asked.of.content, Compares)


@pytest.mark.parametrize(
    "text",
    [
        "how far are we going today?",
        "how far do we go",
        "how far is the trip",
        "how far do we drive",
    ],
)
def test_how_far_we_go_is_how_far_the_destination_is(parser: Parser, text: str) -> None:
    asked = question(parser, text)
    assert isinstance(asked, HowMuch)
    assert isinstance(asked.of, Measured)
    assert asked.of.attribute == "distance-to-go"


@pytest.mark.parametrize(
    "text", ["was that grey car driving in our lane?", "was the grey van driving in our lane"]
)
def test_driving_in_a_lane_is_being_on_it(parser: Parser, text: str) -> None:
    asked = question(parser, text)
    assert isinstance(asked, Whether)
    assert isinstance(asked.that, Related)
    assert asked.that.relation == "on"


def test_stopped_in_a_lane_is_both(parser: Parser) -> None:
    asked = question(parser, "is the bus stopped in our lane")
    assert isinstance(asked, Whether)
    assert isinstance(asked.that, Both)
    assert [type(part) for part in asked.that.contents] == [Is, Related]


@pytest.mark.parametrize(
    "text", ["how long did they have to wait because of us", "how long did they wait for us"]
)
def test_waiting_because_of_somebody_is_waiting_for_him(parser: Parser, text: str) -> None:
    asked = question(parser, text)
    assert isinstance(asked, HowLong)
    assert isinstance(asked.of, Event)
    assert (asked.of.action, asked.of.object) == ("wait", Ego())


@pytest.mark.parametrize(
    "text", ["the brown car is it waiting for us", "the brown car, is it waiting for us?"]
)
def test_a_question_about_somebody_named_before_it_is_no_claim_of_who_it_is(
    parser: Parser, text: str
) -> None:
    readings = parser.read(text)
    asked = question(parser, text)
    assert isinstance(asked, Whether)
    assert isinstance(asked.that, Happens)
    claims = [r for r in readings if any(isinstance(act, Claim) for act in r.acts)]
    assert all(claim.cost > readings[0].cost + 0.5 for claim in claims)
