"""How a value compares with another one, with a number, and with what is allowed."""

from typing import Any

import pytest

from tests.explain.answers.stated import US, did, look, result, scene
from xavi_dialogue.domain.answers import Counted
from xavi_dialogue.domain.terms import (
    At,
    Compares,
    Event,
    Everyone,
    Exists,
    Has,
    Measured,
    Passenger,
    Quantity,
    Vehicle,
    Vehicles,
    WholeRide,
)
from xavi_dialogue.explain.answers.propositions.comparisons import compares, has

ONE, TWO = Vehicle(1), Vehicle(2)
LOOKS = {1: look(1), 2: look(2)}


def weighed(of: Any, span: Any = None, **facts: Any) -> Any:
    explainer = has if isinstance(of, Has) else compares
    return result(explainer, of, scene(span, **({"looks": LOOKS} | facts)))


# --- compares -----------------------------------------------------------------------------------

SPEED = Measured("speed")


def held(comparator: Any, right: Any, value: float, *, by: Any = None, **more: Any) -> Any:
    left = Measured(more.pop("attribute", "distance"), to=ONE)
    values = {(left.attribute, 0): value}
    return weighed(Compares(left, comparator, Quantity(right, "m"), by), values=values).holds


@pytest.mark.parametrize(
    ("comparator", "value", "holds"),
    [
        ("more", 10.6, True),
        ("more", 10.4, False),
        ("too-much", 10.6, True),
        ("too-much", 10.4, False),
        ("less", 9.4, True),
        ("less", 9.6, False),
        ("less", 10.6, False),
        ("at-least", 9.6, True),
        ("at-least", 9.4, False),
        ("enough", 9.6, True),
        ("enough", 9.4, False),
        ("at-most", 10.4, True),
        ("at-most", 10.6, False),
        ("same", 10.4, True),
        ("same", 9.6, True),
        ("same", 10.6, False),
        ("same", 9.4, False),
    ],
)
def test_half_a_metre_more_or_less_is_the_same(comparator: Any, value: float, holds: bool) -> None:
    assert held(comparator, 10.0, value) is holds


@pytest.mark.parametrize(
    ("attribute", "same", "other"),
    [
        ("speed", 0.55, 0.65),
        ("limit", 0.25, 0.35),
        ("gap", 0.45, 0.55),
        ("headway", 0.15, 0.25),
        ("time-to-collision", 0.25, 0.35),
        ("deceleration", 0.25, 0.35),
        ("acceleration", 0.25, 0.35),
        ("size", 0.25, 0.35),
        ("time-to-go", 0.95, 1.05),
        ("distance-to-go", 4.9, 5.1),
        ("probability", 0.025, 0.035),
        ("duration", 0.45, 0.55),
        ("jerk", 0.0, 0.01),
    ],
)
def test_up_to_which_difference_values_are_the_same(
    attribute: Any, same: float, other: float
) -> None:
    assert held("same", 10.0, 10.0 + same, attribute=attribute) is True
    assert held("same", 10.0, 10.0 - other, attribute=attribute) is False


def test_by_how_much_is_taken_as_said() -> None:
    by = Quantity(3.0, "m")
    assert held("more", 10.0, 12.6, by=by) is True
    assert held("more", 10.0, 12.4, by=by) is False
    assert held("less", 10.0, 7.4, by=by) is True
    assert held("less", 10.0, 7.6, by=by) is False


def test_speeds_differ_where_they_are_told_apart_in_kilometres_per_hour() -> None:
    values = {("speed", 0): 10.3, ("speed", 1): 10.0}  # 37 and 36 km/h
    than_him = Compares(SPEED, "more", Measured("speed", ONE))
    assert weighed(than_him, values=values).holds is True
    values = {("speed", 0): 10.1, ("speed", 1): 10.0}  # 36 and 36 km/h
    assert weighed(than_him, values=values).holds is False
    faster = Compares(Measured("speed", ONE), "less", SPEED)
    assert weighed(faster, values=values).holds is False


def test_both_values_are_told_or_the_number_beside_ours() -> None:
    values = {("speed", 0): 12.0, ("speed", 1): 10.0}
    found = weighed(Compares(SPEED, "more", Measured("speed", ONE)), values=values)
    assert [(m.thing, m.value) for m in found.facts] == [(US, 12.0), (ONE, 10.0)]
    found = weighed(Compares(SPEED, "more", Quantity(11.0, "m/s")), values=values)
    assert [(m.value, m.reference) for m in found.facts] == [(12.0, 11.0)]


def test_percent_are_shares() -> None:
    left = Measured("probability", ONE)
    values = {("probability", 1): 0.8}
    assert weighed(Compares(left, "more", Quantity(70.0, "%")), values=values).holds is True
    assert weighed(Compares(left, "more", Quantity(90.0, "%")), values=values).holds is False


def test_without_another_side_a_speed_is_held_against_the_limit() -> None:
    values = {("speed", 0): 15.0, ("limit", 0): 13.9, ("limit", 1): 20.0, ("speed", 1): 15.0}
    found = weighed(Compares(SPEED, "too-much"), values=values)
    assert (found.holds, found.facts[0].reference) == (True, 13.9)
    assert weighed(Compares(Measured("speed", ONE), "too-much"), values=values).holds is False
    gap = weighed(Compares(Measured("gap", to=ONE), "enough"), values={("gap", 0, 1): 9.0})
    assert (gap.holds, gap.gap, [m.value for m in gap.facts]) == (None, "not-recorded", [9.0])


def test_the_limit_is_that_of_the_time_of_the_extreme() -> None:
    values = {
        ("speed", 0): lambda t: 15.0 if t == 6.0 else 12.0,
        ("limit", 0): lambda t: 20.0 if t == 6.0 else 10.0,
    }
    left = Measured("speed", time=WholeRide(), tense="past")
    found = weighed(Compares(left, "more", Measured("limit")), values=values)
    assert (found.holds, [m.value for m in found.facts]) == (False, [15.0, 20.0])


def test_the_ride_is_weighed_by_its_extreme() -> None:
    values = {("speed", 0): lambda t: {6.0: 15.0, 8.0: 4.0}.get(t, 10.0)}
    left = Measured("speed", time=WholeRide(), tense="past")
    for comparator, number, holds in (
        ("more", 14.0, True), ("more", 16.0, False), ("less", 5.0, True), ("less", 3.0, False),
        ("at-most", 5.0, True), ("at-least", 14.0, True),
    ):  # fmt: skip
        found = weighed(Compares(left, comparator, Quantity(number, "m/s")), values=values)  # type: ignore[arg-type]
        assert found.holds is holds
    ever = Compares(Measured("speed", tense="past"), "more", Quantity(14.0, "m/s"))
    assert weighed(ever, values=values).facts[0].value == 15.0
    at_once = {("speed", 0): lambda t: 15.0 if t == 0.5 else 10.0}
    assert weighed(ever, values=at_once, now=1.0).facts[0].value == 10.0  # hardly begun
    for left in (
        Measured("speed", time=At(7.0), tense="past"),
        Measured("speed"),
    ):
        found = weighed(Compares(left, "more", Quantity(9.0, "m/s")), values=values)
        assert (found.holds, found.facts[0].value) == (True, 10.0)
    against = Compares(Measured("speed", time=WholeRide(), tense="past"), "less", SPEED)
    assert weighed(against, values=values).facts[0].extreme == "mean"
    mine = Measured("speed", Passenger(), time=WholeRide(), tense="past")
    found = weighed(Compares(mine, "more", Quantity(14.0, "m/s")), values=values)
    assert (found.holds, found.facts[0].thing) == (True, US)
    theirs = Measured("speed", ONE, time=WholeRide(), tense="past")
    values = {("speed", 1): lambda t: 15.0 if t == 6.0 else 10.0}
    found = weighed(Compares(theirs, "more", Quantity(14.0, "m/s")), values=values)
    assert (found.holds, found.facts[0].thing) == (True, ONE)


def test_what_is_not_known_cannot_be_compared() -> None:
    than_him = Compares(SPEED, "more", Measured("speed", ONE))
    found = weighed(than_him, values={("speed", 0): 9.0, ("speed", 1): {"gap": "hidden"}})
    assert (found.holds, found.gap, [m.value for m in found.facts]) == (None, "hidden", [9.0])
    found = weighed(than_him, values={("speed", 1): 9.0, ("speed", 0): {"gap": "in-future"}})
    assert (found.holds, found.gap, [m.value for m in found.facts]) == (None, "in-future", [9.0])


def test_against_everybody_it_is_the_most_or_the_least() -> None:
    values = {("speed", 0): 11.0, ("speed", 1): 9.0, ("speed", 2): 13.0}
    everybody = Measured("speed", Everyone())
    found = weighed(Compares(SPEED, "more", everybody), values=values)
    assert (found.holds, found.facts[1].value) == (False, 13.0)
    found = weighed(Compares(SPEED, "less", everybody), values=values)
    assert (found.holds, found.facts[1].value) == (False, 9.0)
    found = weighed(Compares(SPEED, "more", everybody), values=values | {("speed", 2): None})
    assert (found.holds, found.facts[1].value) == (True, 9.0)


def test_of_several_it_has_to_hold_of_each() -> None:
    both = Compares(Measured("speed", Vehicles((1, 2))), "more", Quantity(8.0, "m/s"))
    values = {("speed", 1): 9.0, ("speed", 2): 13.0}
    found = weighed(both, values=values)
    assert (found.holds, [m.value for m in found.facts]) == (True, [9.0, 13.0])
    assert weighed(both, values=values | {("speed", 2): 7.0}).holds is False
    found = weighed(both, values={("speed", 2): 13.0})
    assert (found.holds, [m.value for m in found.facts]) == (True, [13.0])
    assert weighed(both, values={}).holds is None
    found = weighed(Compares(Measured("speed", Vehicles((1, 2))), "more", SPEED),
                    values=values | {("speed", 0): 5.0})  # fmt: skip
    assert [m.value for m in found.facts] == [9.0, 13.0, 5.0]


def test_a_number_that_was_said_is_held_against_the_count() -> None:
    stops = tuple(did("stop", t, t + 1.0) for t in (2.0, 6.0, 12.0))
    left = Measured("count", event=Event("stop", time=WholeRide()))
    for comparator, number, holds in (
        ("same", 3.0, True), ("same", 2.0, False), ("more", 2.0, True), ("more", 3.0, False),
        ("at-least", 3.0, True), ("at-least", 4.0, False),
    ):  # fmt: skip
        found = weighed(Compares(left, comparator, Quantity(number)), episodes=stops)  # type: ignore[arg-type]
        assert isinstance(found.answer, Counted)
        assert (found.holds, found.answer.count, found.answer.said) == (holds, 3, holds)
    assert weighed(Compares(left, "more"), episodes=stops).holds is None
    things = Measured("count", Everyone(), about=Exists(Everyone("car")))
    found = weighed(Compares(things, "same", Quantity(2.0)))
    assert (found.holds, found.answer.count, found.answer.such) == (True, 2, Everyone("car"))
