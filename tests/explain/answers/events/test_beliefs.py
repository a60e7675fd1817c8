"""What was believed of a vehicle: at which time, how it moved, because of what, what came of it."""

from typing import Any

import pytest

from tests.explain.answers.stated import (
    belief,
    look,
    result,
    scene,
    they,
    thoughts,
)
from xavi_dialogue.domain.answers import NotRecorded
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import HowSure
from xavi_dialogue.domain.terms import (
    At,
    Believed,
    Event,
    Exists,
    Happens,
    Is,
    Not,
    Related,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.explain.answers.events.beliefs import (
    asked_time,
    history_of,
    how_sure,
    steepest,
    time_of,
)

ONE, TWO = Vehicle(1), Vehicle(2)
TURN = Event("exit-left", ONE)
STEADY = thoughts((2.0, 0.6), (8.0, 0.65), (14.0, 0.9))


def sure(of: Any, time: Any = None, span: Any = None, **facts: Any) -> Any:
    question = HowSure(of) if time is None else HowSure(of, time)
    return result(how_sure, question, scene(span, **facts))


# --- how it moved -------------------------------------------------------------------------------


def test_beliefs_are_kept_where_they_moved() -> None:
    told = thoughts((2.0, 0.5), (4.0, 0.55), (6.0, 0.59), (8.0, 0.9), (10.0, 0.85), (12.0, 0.7))
    found = result(history_of, scene(**told), 1, TURN)
    assert [b.time for b in found.history] == [2.0, 6.0, 8.0, 12.0]
    assert found.turning == (6.0, 8.0)
    assert (found.vehicle, found.of) == (1, TURN)


def test_without_an_event_the_likeliest_is_followed() -> None:
    told = thoughts((2.0, 0.55), (4.0, 0.52), (6.0, 0.46), (8.0, 0.42))
    found = result(history_of, scene(**told), 1, None)
    assert [b.time for b in found.history] == [2.0, 6.0, 8.0]  # 55, 54 the other, 58 % now
    assert found.probability == pytest.approx(0.58)
    assert found.turning is None  # at most 4 % at a time
    assert (found.besides, found.of) == ((), None)


def test_the_belief_of_the_time_asked_about_is_among_those_told() -> None:
    found = result(history_of, scene(**STEADY), 1, TURN, At(9.0))
    assert [b.time for b in found.history] == [2.0, 8.0, 14.0]
    assert (found.time, found.probability) == (8.0, pytest.approx(0.65))
    found = result(history_of, scene(**STEADY), 1, TURN)
    assert [b.time for b in found.history] == [2.0, 14.0]
    assert (found.time, found.probability) == (14.0, pytest.approx(0.9))
    found = result(history_of, scene(**STEADY), 1, None, At(9.0))
    assert found.probability == pytest.approx(0.65)
    before = result(history_of, scene(**STEADY), 1, TURN, At(1.0))
    assert (before.time, before.probability) == (None, None)


def test_what_else_was_likely_is_told_beside_an_event() -> None:
    found = result(history_of, scene(**STEADY), 1, TURN, At(3.0))
    assert [(e.actions, e.probability) for e in found.besides] == [
        (("continue",), pytest.approx(0.4))
    ]
    assert result(history_of, scene(**STEADY), 1, TURN).besides == ()  # hardly anything is left


def test_of_whom_nothing_was_believed_nothing_is_told() -> None:
    found = result(history_of, scene(looks={1: look(1)}), 1, None)
    assert found == NotRecorded("not-recorded", ONE, about="probability")
    empty = (belief(1, 3.0), belief(1, 5.0, ("continue", 0.7)))
    found = result(history_of, scene(looks={1: look(1)}, beliefs=empty), 1, None, At(4.0))
    assert (found.probability, [b.time for b in found.history]) == (None, [3.0, 5.0])


@pytest.mark.parametrize(
    ("curve", "found"),
    [
        (((1.0, 0.5), (2.0, 0.55), (3.0, 0.9), (4.0, 0.95)), (2.0, 3.0)),
        (((1.0, 0.9), (2.0, 0.3), (3.0, 0.6)), (1.0, 2.0)),
        (((1.0, 0.5), (2.0, 0.57), (3.0, 0.64)), None),
        (((1.0, 0.5), (2.0, 0.6)), (1.0, 2.0)),
        (((1.0, 0.5),), None),
        ((), None),
    ],
)
def test_the_steepest_part_of_a_curve(curve: Any, found: Any) -> None:
    assert steepest(curve) == found


def test_what_it_did_while_the_belief_moved_is_why() -> None:
    told = (
        they(1, "brake", 5.0, 6.0),  # before it
        they(1, "slow-down", 6.0, 9.0),
        they(1, "signal", 12.0, 13.0),
        they(1, "move", 13.5, 15.0),
        they(1, "stop", 14.5, 15.0),  # after it
    )
    moved = thoughts((2.0, 0.5), (8.0, 0.5), (14.0, 0.9))
    assert result(history_of, scene(episodes=told, **moved), 1, TURN).why == told[2]
    assert result(history_of, scene(episodes=told[:2], **moved), 1, TURN).why == told[1]
    assert result(history_of, scene(episodes=told[:1], **moved), 1, TURN).why is None
    late = (they(1, "brake", 5.0, 6.6),)
    assert result(history_of, scene(episodes=late, **moved), 1, TURN).why == late[0]
    still = thoughts((2.0, 0.5), (8.0, 0.5))
    assert result(history_of, scene(episodes=told, **still), 1, TURN).why is None


def test_what_came_of_it_is_the_event_or_the_way_it_took() -> None:
    turned = (they(1, "exit-left", 16.0, 18.0),)
    assert result(history_of, scene(episodes=turned, **STEADY), 1, TURN, At(9.0)).came == turned[0]
    straight = (they(1, "exit-right", 16.0, 18.0),)
    found = result(history_of, scene(episodes=straight, **STEADY), 1, TURN, At(9.0))
    assert found.came == straight[0]
    early = (they(1, "exit-left", 4.0, 6.0), they(1, "exit-right", 16.0, 18.0))
    found = result(history_of, scene(episodes=early, **STEADY), 1, TURN, At(9.0))
    assert found.came == early[1]
    found = result(history_of, scene(episodes=early[:1], **STEADY), 1, TURN, At(9.0))
    assert found.came is None
    found = result(history_of, scene(episodes=(they(1, "continue", 16.0),), **STEADY), 1, None)
    assert found.came is None
    passed = (they(1, "cross", 15.0, 16.0),)
    event = Event("pass", ONE)
    found = result(history_of, scene(episodes=passed, **STEADY), 1, event, At(9.0))
    assert found.came == passed[0]


# --- the time that is asked about ---------------------------------------------------------------


@pytest.mark.parametrize(
    ("event", "time", "span", "at"),
    [
        (TURN, Unsaid(), None, 9.0),
        (Event("exit-left", ONE, tense="perfect"), Unsaid(), None, 9.0),
        (Event("exit-left", ONE, tense="present"), Unsaid(), None, 20.0),
        (Event("exit-right", ONE), Unsaid(), None, 20.0),
        (None, Unsaid(), None, 20.0),
        (TURN, At(4.0), None, 4.0),
        (TURN, At(19.5), None, 19.5),
        (TURN, Unsaid(), Span(3.0, 3.0, said=True), 3.0),
        (TURN, Unsaid(), Span(19.0, 19.5, said=True), 9.0),
        (TURN, Unsaid(), Span(25.0, 30.0, ahead=True), 20.0),
    ],
)
def test_the_time_asked_about(event: Any, time: Any, span: Any, at: float) -> None:
    turned = (they(1, "exit-left", 5.0, 6.0), they(1, "exit-left", 9.0, 10.0))
    asked = scene(span, episodes=turned, looks={1: look(1)})
    assert asked_time(asked, event, time) == at


@pytest.mark.parametrize(
    ("of", "time"),
    [
        (Happens(Event("stop", time=At(3.0))), At(3.0)),
        (Not(Happens(Event("stop", time=At(3.0)))), At(3.0)),
        (Believed(Related("behind", ONE, time=At(4.0))), At(4.0)),
        (Is("safe", time=At(5.0)), At(5.0)),
        (Exists(ONE, At(3.0)), Unsaid()),
        (None, Unsaid()),
    ],
)
def test_the_time_within_a_proposition(of: Any, time: Any) -> None:
    assert time_of(of) == time
