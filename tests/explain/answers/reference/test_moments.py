"""Which stretch or moment of a ride of 20 s a term is about."""

from typing import Any

import pytest

from tests.explain.answers.stated import scene
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.terms import (
    Ago,
    At,
    Between,
    Next,
    Now,
    Start,
    Unsaid,
    WholeRide,
    Within,
)
from xavi_dialogue.explain.answers.reference.moments import (
    Window,
    instant,
    is_ahead,
    is_past,
    was_said,
    window,
)

SAID, MEANT = Span(4.0, 6.0, said=True), Span(4.0, 6.0)
TILL_NOW = Span(12.0, 20.0)  # inferred, and so the present
BEYOND = Span(12.0, 25.0, said=True)
AHEAD = Span(25.0, 30.0, ahead=True)


@pytest.mark.parametrize(
    ("time", "tense", "span", "stretch"),
    [
        (At(3.0), "past", SAID, (3.0, 3.0, True)),
        (Between(2.0, 9.0), "past", None, (2.0, 9.0, True)),
        (Between(2.0, 30.0), "past", None, (2.0, 20.0, True)),
        (Now(), "past", None, (20.0, 20.0, True)),
        (WholeRide(), "past", None, (0.0, 20.0, True)),
        (Start(), "past", None, (0.0, 1.5, True)),
        (Ago(5.0), "past", None, (15.0, 15.0, True)),
        (Ago(), "past", None, (17.0, 17.0, True)),
        (Ago(50.0), "past", None, (0.0, 0.0, True)),
        (Unsaid(), "past", SAID, (4.0, 6.0, True)),
        (Unsaid(), "present", MEANT, (4.0, 6.0, False)),
        (Unsaid(), "past", BEYOND, (12.0, 20.0, True)),
        (Unsaid(), "past", TILL_NOW, (0.0, 20.0, False)),
        (Unsaid(), "present", TILL_NOW, (20.0, 20.0, False)),
        (Unsaid(), "past", AHEAD, (0.0, 20.0, False)),
        (Unsaid(), "present", None, (20.0, 20.0, False)),
        (Unsaid(), "future", None, (20.0, 20.0, False)),
        (Unsaid(), "perfect", None, (0.0, 20.0, False)),
        (Unsaid(), "past", None, (0.0, 20.0, False)),
    ],
)
def test_a_term_has_its_stretch(time: Any, tense: str, span: Any, stretch: Any) -> None:
    assert window(scene(span), time, tense) == Window(*stretch)


def test_the_past_is_meant_where_no_tense_is_said() -> None:
    assert window(scene()) == Window(0.0, 20.0)
    assert instant(scene(Span(0.0, 20.0, said=True))) == 20.0


@pytest.mark.parametrize(
    ("time", "span", "moment"),
    [
        (Unsaid(), None, 20.0),
        (Unsaid(), SAID, 5.0),
        (Unsaid(), TILL_NOW, 20.0),
        (At(3.0), SAID, 3.0),
        (Between(2.0, 9.0), None, 5.5),
        (WholeRide(), None, 20.0),
        (Between(0.0, 19.0), None, 20.0),  # all of the ride, so far
        (Between(0.0, 18.0), None, 9.0),
        (Between(1.0, 20.0), None, 10.5),
    ],
)
def test_a_term_has_its_moment(time: Any, span: Any, moment: float) -> None:
    assert instant(scene(span), time, "past") == moment


@pytest.mark.parametrize(
    ("time", "tense", "span", "past"),
    [
        (At(3.0), "present", None, True),
        (At(18.4), "present", None, True),
        (At(18.6), "present", None, False),
        (At(19.0), "past", None, True),
        (Unsaid(), "past", None, True),
        (Unsaid(), "perfect", None, True),
        (Unsaid(), "present", None, False),
        (Unsaid(), "future", None, False),
        (Unsaid(), "present", SAID, True),
        (Unsaid(), "present", Span(16.0, 19.0, said=True), False),
        (Unsaid(), "present", TILL_NOW, False),
        (At(19.0), "present", SAID, False),  # the time within the term comes first
    ],
)
def test_a_term_is_about_what_lies_behind_or_not(
    time: Any, tense: str, span: Any, past: bool
) -> None:
    assert is_past(scene(span), time, tense) is past


@pytest.mark.parametrize(
    ("time", "tense", "span", "ahead"),
    [
        (Next(), "present", None, True),
        (Within(5.0), "present", SAID, True),
        (At(25.0), "future", None, False),
        (Between(22.0, 25.0), "future", None, False),
        (Unsaid(), "future", None, True),
        (Unsaid(), "future", SAID, False),
        (Unsaid(), "present", None, False),
        (Unsaid(), "present", AHEAD, True),
        (Unsaid(), "past", TILL_NOW, False),
    ],
)
def test_a_term_is_about_what_is_to_come_or_not(
    time: Any, tense: str, span: Any, ahead: bool
) -> None:
    assert is_ahead(scene(span), time, tense) is ahead


@pytest.mark.parametrize(
    ("time", "span", "said"),
    [
        (At(3.0), None, True),
        (Unsaid(), None, False),
        (Unsaid(), SAID, True),
        (Unsaid(), MEANT, False),
        (Next(), None, False),
    ],
)
def test_a_time_was_named_or_was_not(time: Any, span: Any, said: bool) -> None:
    assert was_said(scene(span), time) is said


def test_a_short_stretch_is_a_moment() -> None:
    assert Window(2.0, 3.5).instant
    assert not Window(2.0, 3.6).instant
    assert Window(2.0, 5.0).middle == 3.5
    assert Window(2.0, 5.0, True).widened() == Window(0.5, 6.5, True)
    assert Window(2.0, 5.0).widened(3.0) == Window(-1.0, 8.0)
