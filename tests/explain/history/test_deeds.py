"""What we carried out, as the events tell it."""

from typing import Any

import pytest

from planner.record.events import Event
from tests.explain.facts.scenes import Actor, made, speeds
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.explain.history.deeds import Deed, read_deeds
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import (
    Ride,
    meets,
)


def ride(*traces: Any, now: float = 20.0, **more: Any) -> Ride:
    return Ride(Record(now, traces, **more))


def started(time: float, action: Any, decision: int | None = 1) -> Event:
    return Event("action-started", time, action, decision)


def test_events_tell_what_was_set_out_to_do() -> None:
    events = (
        Event("action-ended", 0.5, "continue"),  # of which nothing is known
        started(1.0, "continue", 1),
        Event("action-committed", 2.0, "stop", 2),  # of something else
        Event("gave-way", 2.5, vehicle=1),
        started(3.0, "change-left", 3),
        Event("action-committed", 3.5, "change-left", 4),
        Event("action-ended", 6.0, "change-left"),
        Event("action-committed", 6.5, "change-left", 9),  # too late
        started(7.0, "exit-left", 7),
        Event("action-committed", 8.0),
        Event("arrived", 9.0),
    )
    assert read_deeds(events) == [
        Deed("continue", 1, 1.0, None, 3.0),
        Deed("change-left", 4, 3.0, 3.5, 6.0),
        Deed("exit-left", 7, 7.0, 8.0, 9.0),
    ]
    for kind in ("collided", "ended"):
        assert read_deeds((*events[:2], Event(kind, 5.0)))[0].ended == 5.0


@pytest.mark.parametrize(
    ("deed", "carried_out"),
    [
        (Deed("exit-left", 1, 3.0, 4.0, 5.0), True),
        (Deed("exit-left", 1, 3.0), False),
        (Deed("exit-left", 1, 3.0, None, 5.0), False),
        (Deed("change-left", 1, 3.0), True),
        (Deed("change-left", 1, 3.0, None, 5.0), False),
        (Deed("continue", 1, 3.0, None, 5.0), True),
        (Deed("stop", 1, 3.0, None, 5.0), True),
    ],
)
def test_a_turn_still_to_come_is_not_carried_out(deed: Deed, carried_out: bool) -> None:
    assert deed.carried_out is carried_out


def test_a_deed_is_done_from_when_it_was_decided_for_good() -> None:
    assert Deed("stop", 1, 3.0, 4.0, 6.0).span == (4.0, 6.0)
    assert Deed("stop", 1, 3.0).span == (3.0, float("inf"))


def test_a_stop_that_came_to_nothing_is_no_deed() -> None:
    slows = {0: Actor(speeds(0.0, 0.0, ((2.0, 8.0), (4.0, 2.0), (6.0, 8.0))))}
    events = (started(1.0, "stop"), Event("action-ended", 5.0, "stop"))
    assert made(slows, 8.0, events=events).deeds == ()
    assert len(made(slows, 8.0, events=events[:1]).deeds) == 1  # it may still come to stand
    assert len(ride(events=events).deeds) == 1  # nothing is known of how it drove
    assert made(slows, 8.0, events=events).stood(Deed("stop", 1, 1.0, None, 5.0)) is None


def test_what_is_under_way_has_not_ended() -> None:
    begun = (started(3.0, "exit-left"),)
    assert ride(events=begun).under_way == Deed("exit-left", 1, 3.0)
    over = (*begun, Event("action-ended", 5.0, "exit-left"))
    assert ride(events=over).under_way is None
    assert ride().under_way is None


MOVES = (
    started(0.0, "continue"),
    started(4.0, "change-left"),
    Event("action-committed", 4.0, "change-left"),
    Event("action-ended", 6.0, "change-left"),
    started(6.0, "continue"),
)


def test_the_deed_meant_is_the_last_that_meets_a_time() -> None:
    found = ride(events=MOVES)
    goes, change, on = found.deeds
    assert found.meant(found.deeds) == on
    assert found.meant(found.deeds, Span(1.0, 5.0)) == change
    assert found.meant(found.deeds[:1], Span(5.0, 6.0)) is None
    assert found.manoeuvre() == change
    assert found.manoeuvre(Span(7.0, 8.0)) == on
    assert found.manoeuvre(Span(1.0, 2.0)) == goes
    assert ride(events=MOVES[:1]).manoeuvre() == Deed("continue", 1, 0.0)


@pytest.mark.parametrize(
    ("done", "span", "met"),
    [
        ((1.0, 3.0), (2.0, 4.0), True),
        ((1.0, 3.0), (3.0, 4.0), False),
        ((4.0, 6.0), (2.0, 4.0), False),
        ((4.0, 4.0), (2.0, 4.0), True),
        ((1.0, 3.0), (3.0, 3.0), True),
        ((1.0, 3.0), (1.0, 1.0), True),
        ((1.0, 3.0), (3.1, 3.1), False),
        ((1.0, 1.0), (2.0, 2.0), False),
    ],
)
def test_spans_meet_in_more_than_an_end_but_for_moments(done: Any, span: Any, met: bool) -> None:
    assert meets(done, Span(*span)) is met
