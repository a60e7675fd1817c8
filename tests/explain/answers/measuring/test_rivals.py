"""Which of two road users is faster, nearer or bigger, and by how much."""

from typing import Any

import pytest

from tests.explain.answers.given import (
    NOW,
    Given,
    look,
    refused,
)
from xavi_dialogue.domain.answers import NotUnderstood
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import Compare
from xavi_dialogue.domain.terms import (
    Compares,
    Ego,
    Feature,
    Measured,
    Quantity,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.explain.answers.measuring import rivals


def compared(by: Any, values: dict[Any, Any], *, by_how_much: bool = False, **more: Any) -> Any:
    """What is told of two vehicles of which something was measured."""
    looks = {v: look(v) for v in (1, 2)}
    given = Given(looks=looks, measures=values, **more)
    question = Compare((Vehicle(1), Vehicle(2)), by)
    return rivals.rivals(question, given.asked(), by=by_how_much)


@pytest.mark.parametrize(
    ("by", "attribute", "one", "other", "comparator", "first"),
    [
        ("speed", "speed", 14.0, 10.0, "more", 1),
        ("speed", "speed", 10.0, 14.0, "more", 2),
        ("time", "speed", 10.0, 14.0, "more", 2),
        ("size", "size", 4.0, 12.0, "more", 2),
        ("distance", "distance", 40.0, 12.0, "less", 2),
        ("distance", "distance", 12.0, 40.0, "less", 1),
        ("speed", "speed", 10.0, 10.5, "same", 2),
        ("speed", "speed", 10.0, 10.7, "more", 2),
    ],
)
def test_which_of_two_is_faster_bigger_or_nearer(
    by: Any, attribute: Any, one: float, other: float, comparator: str, first: int
) -> None:
    values = {(attribute, Vehicle(1)): one, (attribute, Vehicle(2)): other}
    found = compared(by, values)
    assert (found.holds, found.either) == (True, True)
    assert (found.that.left.thing, found.that.comparator) == (Vehicle(first), comparator)
    assert found.that.left.attribute == attribute
    assert found.that.by is None
    assert [fact.value for fact in found.facts] == sorted(
        (one, other), reverse=attribute != "distance"
    )


def test_distances_are_from_us_and_differences_in_metres_per_second() -> None:
    near = {("distance", Vehicle(1), Ego()): 5.0, ("distance", Vehicle(2), Ego()): 9.0}
    assert compared("distance", near).that.left.thing == Vehicle(1)
    speeds = {("speed", Vehicle(1), None): 10.0, ("speed", Vehicle(2), None): 14.0}
    assert compared("speed", speeds, by_how_much=True).that.by == Quantity(4.0, "m/s")
    same = {("speed", Vehicle(1)): 10.0, ("speed", Vehicle(2)): 10.2}
    assert compared("speed", same, by_how_much=True).that.by is None


def test_where_a_value_is_missing_it_cannot_be_told() -> None:
    gone = Measure("speed", Vehicle(2), NOW, gap="out-of-view")
    found = compared("speed", {("speed", Vehicle(1)): 10.0, ("speed", Vehicle(2)): gone})
    assert (found.holds, found.gap, found.either) == (None, "out-of-view", False)
    left, right = Measured("speed", Vehicle(1)), Measured("speed", Vehicle(2))
    assert found.that == Compares(left, "more", right)
    assert [fact.value for fact in found.facts] == [10.0]


def test_what_cannot_be_measured_of_two_is_not_compared() -> None:
    assert refused(compared, "comfort", {}) == NotUnderstood()
    asked = Given(looks={1: look(1)}).asked()
    alone = Compare((Vehicle(1), Feature("queue")), "speed")
    assert refused(rivals.rivals, alone, asked) == NotUnderstood()
    several = Compare((Vehicles((1, 2)),), "speed")
    two = Given(looks={1: look(1), 2: look(2)}).asked()
    assert rivals.rivals(several, two).holds is None  # type: ignore[union-attr]


def test_of_several_the_most_is_told_with_the_value_of_each() -> None:
    values: dict[Any, Any] = {("speed", Vehicle(v)): s for v, s in ((1, 9.0), (2, 12.0), (3, 4.0))}
    given = Given(looks={v: look(v) for v in (1, 2, 3)}, measures=values)
    for least, order in ((False, [12.0, 9.0, 4.0]), (True, [4.0, 9.0, 12.0])):
        question = Compare((Vehicles((1, 2, 3)),), "speed", least)
        found: Any = rivals.rivals(question, given.asked())
        assert [fact.value for fact in found.facts] == order
        assert found.that.comparator == ("less" if least else "more")
