"""Whether an attribute has a value that is said in words."""

from typing import Any

import pytest

from tests.explain.answers.propositions.test_comparisons import ONE, TWO, weighed
from tests.explain.answers.stated import look
from xavi_dialogue.domain.answers import CannotSay, Measures
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Has,
    Unknown,
    Vehicles,
    WholeRide,
)

# --- has ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("shown", "said", "holds"),
    [
        (("left",), "left", True),
        (("left",), " LEFT ", True),
        (("left",), "right", False),
        (("left", "right"), "right", True),
        (("left",), "on", True),
        (("brake",), "on", False),
        (("left",), "off", False),
        (("brake",), "none", True),
        (("left", "right"), "hazard", True),
        (("left", "right"), "both", True),
        (("left",), "warning", False),
        ((), "warning", False),
    ],
)
def test_an_indicator_shows_what_is_said(shown: Any, said: str, holds: bool) -> None:
    values = {("indicator", 1): {"lights": shown}}
    found = weighed(Has("indicator", said, ONE), values=values)
    assert found.holds is holds
    assert found.facts[0].lights == shown


@pytest.mark.parametrize(
    ("shown", "said", "holds"),
    [
        (("brake",), "on", True),
        (("left",), "on", False),
        (("brake",), "off", False),
        ((), "none", True),
    ],
)
def test_brake_lights_are_on_or_off(shown: Any, said: str, holds: bool) -> None:
    values = {("brake-lights", 1): {"lights": shown}}
    assert weighed(Has("brake-lights", said, ONE), values=values).holds is holds


def blinking(*times: float) -> Any:
    """The right indicator is seen at some times, and between 2 and 12 s something is seen."""
    return {
        ("indicator", 1): lambda t: (
            {"lights": ("right",) if any(abs(t - x) < 0.1 for x in times) else ()}
            if 2.0 <= t <= 12.0
            else None
        )
    }


def test_a_light_of_the_past_was_shown_at_some_time() -> None:
    asked = Has("indicator", "right", ONE, Between(1.0, 9.0), "past")
    found = weighed(asked, values=blinking(5.0))
    assert (found.holds, found.facts[0].time) == (True, pytest.approx(5.0))
    found = weighed(asked, values=blinking(11.0))
    assert (found.holds, found.facts[0].time) == (False, pytest.approx(9.0, abs=0.4))
    whole = Has("indicator", "right", ONE, WholeRide(), "past")
    assert weighed(whole, values=blinking(11.2)).holds is True
    assert weighed(whole, values=blinking(10.0), now=10.0).holds is True  # up to its end
    unseen = Has("indicator", "right", ONE, Between(13.0, 16.0), "past")
    found = weighed(unseen, values=blinking(5.0))
    assert (found.holds, found.gap) == (None, "not-recorded")


def test_a_light_of_a_moment_is_shown_then() -> None:
    for time, holds in ((5.0, True), (6.0, False)):
        asked = Has("indicator", "right", ONE, At(time), "past")
        assert weighed(asked, values=blinking(5.0)).holds is holds
    now = Has("indicator", "right", ONE)
    assert weighed(now, Span(2.0, 9.0, said=True), values=blinking(5.6)).holds is True
    assert weighed(now, values=blinking(5.6), now=11.0).holds is False


@pytest.mark.parametrize(
    ("attribute", "fields", "said", "holds"),
    [
        ("colour", {"word": "dark blue"}, "blue", True),
        ("colour", {"word": "Blue"}, "blue", True),
        ("colour", {"word": "blue"}, "red", False),
        ("lane", {"value": 2.0}, "2", True),
        ("lane", {"value": 2.0}, "3", False),
        ("lane", {"value": 1.0, "side": "left"}, "left", True),
        ("lane", {"side": "left"}, "left", True),
        ("lane", {"side": "left"}, "right", False),
        ("kind", {"word": "truck"}, "truck", True),
        ("kind", {"word": "truck"}, "bus", False),
        ("kind", {"word": "truck"}, "fire truck", None),
        ("kind", {"word": "car"}, "taxi", None),
        ("kind", {"word": "truck"}, "taxi", False),
        ("kind", {"word": "car"}, "emergency", None),
    ],
)
def test_a_value_is_what_is_said(attribute: Any, fields: Any, said: str, holds: Any) -> None:
    found = weighed(Has(attribute, said, ONE), values={(attribute, 1): fields})
    assert found.holds is holds
    assert found.gap == (None if holds is not None else "not-sensed")


def test_what_is_inside_a_vehicle_is_told_as_unknown() -> None:
    found = weighed(Has("load", "wood", ONE), values={("load", 1): {"gap": "not-sensed"}})
    assert (found.holds, found.gap) == (None, "not-sensed")
    assert isinstance(found.answer, Measures)
    assert found.answer.measures[0].gap == "not-sensed"
    lacking = weighed(Has("lane", "2", ONE))
    assert (lacking.holds, lacking.gap, lacking.facts) == (None, "not-recorded", ())


def test_a_colour_lasts_and_a_lane_does_not() -> None:
    """Somebody who was seen last at 5 s: what it keeps is told as it was then."""
    lost = {1: look(1, in_view=False, seen=5.0)}

    def until(fields: Any) -> Any:
        return lambda t: fields if t <= 5.0 else {"gap": "out-of-view"}

    values = {("colour", 1): until({"word": "blue"}), ("lane", 1): until({"value": 2.0})}
    found = weighed(Has("colour", "blue", ONE), looks=lost, values=values)
    assert (found.holds, found.facts[0].time) == (True, 5.0)
    found = weighed(Has("lane", "2", ONE), looks=lost, values=values)
    assert (found.holds, found.gap, found.facts[0].time) == (None, "out-of-view", 5.0)


def test_of_several_it_is_enough_that_one_has_it() -> None:
    values = {("colour", 1): {"word": "blue"}, ("colour", 2): {"word": "red"}}
    found = weighed(Has("colour", "red", Vehicles((1, 2))), values=values)
    assert (found.holds, found.facts[0].thing) == (True, TWO)
    found = weighed(Has("colour", "green", Vehicles((1, 2))), values=values)
    assert (found.holds, found.facts[0].thing) == (False, ONE)


def test_words_without_sense_are_refused() -> None:
    found = weighed(Has("colour", "red", Unknown("gizmo")))
    assert isinstance(found, CannotSay)
    assert found.words == "gizmo"
