"""Whether somebody goes straight on or halts, by what is seen of it."""

from typing import Any

import pytest

from tests.explain.answers.ride.test_conduct import ONE, TWO, shown
from tests.explain.answers.stated import (
    US,
    decision,
    did,
    look,
    roads,
    they,
)
from xavi_dialogue.domain.terms import At, Event

# --- straight on --------------------------------------------------------------------------------

STRAIGHT = Event("continue", tense="present")


def turning(**fields: Any) -> Any:
    return {("turn", 0): fields}


@pytest.mark.parametrize(
    ("turn", "holds"),
    [
        ({"value": 149.0, "side": "left"}, False),
        ({"value": 151.0, "side": "left"}, True),
        ({"value": 50.0, "side": "straight"}, True),
        ({"side": "right"}, False),
        ({"gap": "not-recorded"}, True),
    ],
)
def test_we_go_straight_on_where_no_turn_is_near(turn: Any, holds: bool) -> None:
    for event in (STRAIGHT, Event("exit-straight", tense="present")):
        found = shown(event, values=turning(**turn))
        assert found.holds is holds
        assert [m.value for m in found.facts] == ([] if "gap" in turn else [turn.get("value")])


def test_what_bends_our_way_is_told_by_itself() -> None:
    far = turning(value=500.0, side="left")
    for action in ("exit-left", "exit-right", "change-left", "change-right", "continue-next-exit"):
        assert shown(STRAIGHT, values=far, episodes=(did(action, 19.0),)) is None
        assert shown(STRAIGHT, values=far, episodes=(did(action, 18.0, 19.9),)) is not None
    assert shown(STRAIGHT, values=far, episodes=(did("exit-left", 21.0),)).holds is True
    assert shown(Event("continue"), values=far) is None
    assert shown(Event("continue", ONE, tense="present"), values=far) is None
    assert shown(Event("stop", tense="present"), values=far) is None


# --- halting ------------------------------------------------------------------------------------


def firm(peak: float | None = 1.0, begin: float = 18.0, end: float | None = None) -> Any:
    return they(1, "brake", begin, end, peak=peak)


@pytest.mark.parametrize(
    ("braking", "holds"),
    [
        (firm(), True),
        (firm(0.9), False),
        (firm(None), False),
        (firm(end=19.6), True),
        (firm(end=19.4), False),
    ],
)
def test_who_brakes_firmly_is_stopping(braking: Any, holds: bool) -> None:
    found = shown(Event("stop", ONE, tense="present"), episodes=(braking,))
    assert (found is not None) is holds
    if found is not None:
        assert (found.holds, found.facts) == (True, (braking,))


def test_of_the_past_or_of_braking_nothing_is_added() -> None:
    assert shown(Event("stop", ONE), episodes=(firm(),)) is None
    assert shown(Event("brake", ONE, tense="present"), episodes=(firm(),)) is None
    slow = (they(1, "slow-down", 15.0),)
    assert shown(Event("slow-down", ONE, tense="present"), episodes=slow) is None
    assert shown(Event("stop", ONE, tense="present"), episodes=(they(1, "stop", 19.0),)) is None


def test_who_has_to_let_us_go_first_slows_down_for_us() -> None:
    for action in ("stop", "brake", "slow-down"):
        for_us = Event(action, ONE, US, tense="present")
        braking = they(1, "brake", 18.0, peak=2.0)
        for who, holds in (("ego", True), ("vehicle", False), (None, False)):
            road = roads() if who is None else roads((1, who))
            found = shown(for_us, episodes=(braking,), traces=[decision(20.0, road=road)])
            assert (found is not None) is holds
            if found is not None:
                assert (found.holds, found.facts) == (True, (braking,))


def test_of_the_past_the_rule_of_that_time_tells() -> None:
    traces = [decision(5.0, road=roads((1, "ego"))), decision(20.0, road=roads((1, "vehicle")))]
    stopped = they(1, "stop", 3.0, 8.0)
    event = Event("stop", ONE, US, time=At(5.0))
    assert shown(event, episodes=(stopped,), traces=traces).facts == (stopped,)
    late = they(1, "stop", 17.0, 19.9)
    event = Event("stop", ONE, US, time=At(18.0))
    assert shown(event, episodes=(late,), traces=traces) is None
    braked = firm(begin=4.0, end=6.0)
    event = Event("stop", ONE, US, time=At(5.0))
    assert shown(event, episodes=(braked,), traces=traces).facts == (braked,)
    assert shown(Event("stop", ONE, TWO, time=At(5.0)), episodes=(stopped,), traces=traces,
                 looks={1: look(1), 2: look(2)}) is None  # fmt: skip
    held = they(1, "stop", 3.0, 8.0, object=US)
    assert shown(event, episodes=(held,), traces=traces) is None  # it is recorded


def test_what_is_only_possible_or_to_come_is_not_read() -> None:
    for event in (
        Event("stop", ONE, tense="present", modal="can"),
        Event("stop", ONE, tense="future"),
        Event("turn", ONE, tense="present"),
    ):
        assert shown(event, episodes=(firm(),)) is None
