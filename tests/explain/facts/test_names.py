"""Which actions stand for which, and whom a thing names."""

import pytest

from xavi_dialogue.domain.terms import Ego, Event, Lane, Thing, Vehicle, Vehicles
from xavi_dialogue.domain.vocabulary import ActionName, Manner
from xavi_dialogue.explain.facts.actions import covered, mirrored, named, somebody


@pytest.mark.parametrize(
    ("asked", "counts"),
    [
        ({"brake"}, {"brake"}),
        ({"slow-down"}, {"slow-down", "brake"}),
        ({"turn", "wait"}, {"turn", "exit-left", "exit-right", "wait", "give-way"}),
    ],
)
def test_which_actions_count_as_one(asked: set[ActionName], counts: set[ActionName]) -> None:
    assert covered(frozenset(asked)) == counts


@pytest.mark.parametrize(
    ("thing", "numbers"),
    [
        (Ego(), {0}),
        (Vehicle(3), {3}),
        (Vehicles((2, 5)), {2, 5}),
        (Lane(), None),
        (None, None),
    ],
)
def test_whom_a_thing_names(thing: Thing | None, numbers: set[int] | None) -> None:
    assert somebody(thing) == numbers


def test_a_number_names_a_thing() -> None:
    assert (named(0), named(4)) == (Ego(), Vehicle(4))


def test_who_blocks_us_is_whom_we_wait_for() -> None:
    manner: tuple[Manner, ...] = ("long",)
    blocking = Event("block", Vehicle(2), Ego(), "left", manner, tense="present", modal="will")
    assert mirrored(blocking) == Event(
        "wait", Ego(), Vehicle(2), "left", manner, tense="present", modal="will"
    )
    assert mirrored(Event("block", Vehicle(2))) == Event("wait", Ego(), Vehicle(2))
    other = Event("follow", Vehicle(2), Ego())
    assert mirrored(other) is other
