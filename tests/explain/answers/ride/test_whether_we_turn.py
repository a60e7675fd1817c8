"""Whether we turn, go straight on, take an exit or stay on the road; asked at 20 s."""

from typing import Any

import pytest

from tests.explain.answers.ride.test_onward import LEFT, OVER, RIGHT, RING, SAID, US, ahead, way
from tests.explain.answers.stated import did
from xavi_dialogue.domain.meaning import Whether
from xavi_dialogue.domain.terms import (
    At,
    Destination,
    Event,
    Exists,
    Exit,
    Happens,
    Is,
    Junction,
    Lane,
    Next,
    Not,
    Now,
    Related,
    Road,
    Vehicle,
    WholeRide,
)
from xavi_dialogue.explain.answers.ride import onward as room

ROTARY = Junction("roundabout")
PAST = "none"


def ours(that: Any, *route: Any, **more: Any) -> Any:
    that = Happens(that) if isinstance(that, Event) else that
    found = room.whether_ours(Whether(that), ahead(*route, **more))
    return PAST if found is None else found


def do(action: Any, to: Any = None, **more: Any) -> Event:
    return Event(action, object=to, **({"tense": "present"} | more))


# Whether there is such a junction ---------------------------------------------------------------


@pytest.mark.parametrize(
    ("that", "route", "found"),
    [
        (Exists(Junction()), (OVER, RING), way((OVER, 1), (RING, 2), form="junctions", holds=True)),
        (Exists(Junction()), (), way(form="junctions", holds=False)),
        (Exists(ROTARY), (OVER, RING), way((RING, 2), form="roundabouts", holds=True)),
        (Not(Exists(ROTARY)), (OVER,), way(form="roundabouts", holds=False)),
        (Exists(ROTARY, tense="past"), (RING,), PAST),
        (Exists(Lane()), (RING,), PAST),
        (do("enter", ROTARY), (OVER, RING, RING), way((RING, 2), holds=True)),
        (do("enter", ROTARY, tense="future"), (RING,), way((RING, 1), holds=True)),
        (do("enter", ROTARY), (OVER,), way(form="roundabouts", holds=False)),
        (do("enter", ROTARY, tense="past"), (RING,), PAST),
        (do("enter", Junction()), (RING,), PAST),
        (do("enter", ROTARY, modal="must"), (OVER, RING, RING), way((RING, 2))),
        (do("enter", ROTARY, modal="must"), (OVER,), PAST),
        (Happens(Event("enter", Vehicle(1), ROTARY, tense="present")), (RING,), PAST),
    ],
)
def test_a_junction_is_ahead_or_is_not(that: Any, route: Any, found: Any) -> None:
    assert ours(that, *route) == found


def test_of_a_time_gone_by_nothing_lies_ahead() -> None:
    assert ours(Exists(Junction()), OVER, span=SAID) == PAST
    assert ours(do("turn"), OVER, span=SAID) == PAST
    assert ours(do("turn", time=WholeRide()), RIGHT, span=SAID) == way((RIGHT, 1), holds=True)


# Whether it is our turning ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("route", "inside", "found"),
    [
        ((RIGHT, OVER), False, way((RIGHT, 1), holds=True)),
        ((RIGHT,), False, way((RIGHT, 1), holds=True)),
        ((OVER, RIGHT), False, way((OVER, 1), holds=False)),
        ((RING,), True, way((RING, 1), holds=False, inside=True)),
    ],
)
def test_a_place_is_where_we_turn(route: Any, inside: bool, found: Any) -> None:
    for thing in (Junction(), Exit()):
        that = Related("same-as", thing, Exit())
        assert ours(that, *route, inside=inside) == found
    assert ours(Related("same-as", Vehicle(1), Exit()), *route) == PAST
    assert ours(Related("ahead-of", Exit(), US), *route) == PAST
    assert ours(Related("same-as", Exit(), Exit()), *route, span=SAID) == PAST
    assert ours(Related("same-as", Exit(), Exit())) == PAST


def test_the_first_exit_of_the_ring_is_ours_where_we_take_it() -> None:
    first = RING.__class__(20.0, "roundabout", "exit-straight", 1, 4, 4, "give-way")
    that = Related("same-as", Exit(), Exit())
    assert ours(that, first, inside=True) == way((first, 1), holds=True, inside=True)
    assert ours(that, first) == way((first, 1), holds=False)


# Whether we missed the exit ---------------------------------------------------------------------


@pytest.mark.parametrize(
    ("event", "route", "found"),
    [
        (do("pass", Exit(), tense="perfect"), (RING,), way((RING, 1), holds=False)),
        (do("pass", Exit(), tense="past"), (RIGHT,), way((RIGHT, 1), holds=False)),
        (do("pass", Exit(), tense="past"), (OVER,), way(form="road", holds=False)),
        (do("pass", Exit(), tense="future"), (RING,), PAST),
        (do("pass", tense="past"), (RING,), PAST),
        (do("turn", Exit(), tense="past"), (RING,), PAST),
        (Event("pass", Vehicle(1), Exit()), (RING,), PAST),
    ],
)
def test_an_exit_that_we_did_not_pass_is_not_missed(event: Event, route: Any, found: Any) -> None:
    assert ours(event, *route) == found


def test_an_exit_that_we_did_pass_is_an_event() -> None:
    passed = do("pass", Exit(), tense="past")
    assert ours(passed, RING, episodes=(did("pass", 12.0, 14.0),)) == PAST


# Whether we turn --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("event", "route", "found"),
    [
        (do("turn"), (RIGHT, LEFT), way((RIGHT, 1), holds=True)),
        (do("turn"), (OVER, RIGHT), way((OVER, 1), (RIGHT, 2), holds=False)),
        (do("turn", modal="want"), (RIGHT,), way((RIGHT, 1), holds=True)),
        (do("turn", modal="could"), (RIGHT,), PAST),
        (do("exit-right"), (RIGHT,), way((RIGHT, 1), holds=True)),
        (do("exit-left"), (RIGHT, LEFT), way((RIGHT, 1), holds=False)),
        (do("exit-straight"), (OVER, RIGHT), way((OVER, 1), holds=True)),
        (do("continue"), (OVER, RIGHT), way((OVER, 1), holds=True)),
        (do("continue"), (RIGHT,), way((RIGHT, 1), holds=False)),
        (do("turn", Junction(rank=2)), (OVER, RIGHT), way((RIGHT, 2), holds=True)),
        (do("turn", Junction(rank=1)), (OVER, RIGHT), way((OVER, 1), holds=False)),
        (do("turn", Junction(rank=-1)), (OVER, RIGHT), way((OVER, 1), holds=False)),
        (do("turn", Junction(rank=3)), (OVER, RIGHT), way(holds=False)),
        (do("turn"), (), way(holds=False)),
        (do("continue"), (), None),
        (do("turn"), (RING, RIGHT), way((RING, 1), holds=False)),
        (do("turn", time=Next()), (RIGHT,), way((RIGHT, 1), holds=True)),
        (do("turn", time=Now(), tense="future"), (RIGHT,), way((RIGHT, 1), holds=True)),
        (do("turn", time=At(5.0)), (RIGHT,), PAST),
        (do("turn", tense="past"), (RIGHT,), PAST),
        (do("turn", Vehicle(1)), (RIGHT,), PAST),
        (do("brake"), (RIGHT,), PAST),
        (do("continue", Destination()), (RIGHT,), PAST),
        (Event("turn", Vehicle(1), tense="present"), (RIGHT,), PAST),
        (Is("fast"), (RIGHT,), PAST),
    ],
)
def test_we_turn_or_go_straight_on(event: Any, route: Any, found: Any) -> None:
    expected = way(holds=True) if found is None else found
    assert ours(event, *route) == expected
    if isinstance(event, Event):
        assert ours(Not(Happens(event)), *route) == expected


def test_what_is_under_way_is_an_event() -> None:
    turns = did("exit-right", 19.0)
    assert ours(do("turn"), RIGHT, episodes=(turns,)) == PAST
    assert ours(do("turn", tense="future"), RIGHT, episodes=(turns,)) != PAST


# Whether we leave the road or a roundabout ------------------------------------------------------


@pytest.mark.parametrize(
    ("event", "route", "found"),
    [
        (do("leave", Road()), (RIGHT, LEFT), way((RIGHT, 1), holds=True)),
        (do("continue", Road()), (RIGHT, LEFT), way((RIGHT, 1), form="road", holds=False)),
        (do("circle"), (RING, RING), way((RING, 1), holds=False)),
        (do("leave", Road()), (OVER, RIGHT, LEFT), way((RIGHT, 2), holds=True)),
        (do("leave", Road()), (OVER, RING), way((RING, 2), holds=True)),
        (do("leave", Road()), (OVER,), way(form="road", holds=True)),
        (do("continue", Road()), (OVER,), way(form="road", holds=True)),
        (do("continue", Road()), (OVER, RIGHT), way((RIGHT, 2), form="road", holds=False)),
        (do("turn", Road()), (OVER, RIGHT), PAST),
        (do("circle"), (OVER, RING), way((RING, 2), holds=False)),
        (do("circle"), (OVER,), PAST),
        (do("leave", Lane()), (RING,), PAST),
        (do("leave", Junction()), (RING,), PAST),
        (do("leave", ROTARY), (OVER, RING), way((RING, 2))),
        (do("leave"), (OVER, RING), way((RING, 2))),
        (do("leave", Exit(2)), (OVER, RING), way((RING, 2), holds=True)),
        (do("leave", Exit(1)), (OVER, RING), way((RING, 2), holds=False)),
        (do("turn", Exit(2)), (RING,), way((RING, 1), holds=True)),
        (do("leave", Exit(2)), (OVER, RIGHT), way((RIGHT, 2), holds=True)),
        (do("leave", Exit(1)), (OVER, RIGHT), way((OVER, 1), holds=False)),
        (do("exit-right", Exit(2)), (OVER, RIGHT), way((RIGHT, 2), holds=True)),
        (do("exit-left", Exit(2)), (OVER, RIGHT), way((RIGHT, 2), holds=False)),
        (do("leave", Exit(3)), (OVER, RIGHT), way((RIGHT, 2), holds=False)),
        (do("leave", Exit(-1)), (OVER, RIGHT), way((RIGHT, 2), holds=False)),
        (do("leave"), (OVER, RIGHT, LEFT), way((RIGHT, 2), holds=False)),
        (do("leave"), (OVER,), way(form="road")),
    ],
)
def test_we_leave_by_an_exit_or_stay(event: Event, route: Any, found: Any) -> None:
    assert ours(event, *route) == found


def test_on_the_ring_the_exit_in_question_is_the_next() -> None:
    leave = do("leave")
    assert ours(leave, RING, inside=True) == way((RING, 1), holds=False, inside=True)
    first = RING.__class__(20.0, "roundabout", "exit-straight", 1, 4, 4, "give-way")
    assert ours(leave, first, inside=True) == way((first, 1), holds=True, inside=True)
    unknown = RING.__class__(20.0, "roundabout", "exit-left", None, None, 4, "give-way")
    assert ours(leave, unknown) == way((unknown, 1), holds=False)
