"""What positions and speeds show of somebody's driving where no episode tells it."""

from typing import Any

import pytest

from tests.explain.answers.stated import (
    US,
    did,
    driven,
    look,
    result,
    scene,
    they,
)
from xavi_dialogue.domain.terms import Event, Related, Vehicle
from xavi_dialogue.explain.answers.ride.conduct import conduct

ONE, TWO = Vehicle(1), Vehicle(2)


def shown(event: Event, **facts: Any) -> Any:
    return result(conduct, scene(**({"looks": {1: look(1)}} | facts)), event)


# --- moving in ahead of somebody ----------------------------------------------------------------

CUT = Event("cut-in", US, ONE, tense="present")
MOVED = (did("change-right", 16.0, 18.0),)


def from_right(ahead: float = -9.0, left: float = -3.5, **more: Any) -> Any:
    """Somebody who is to our right before we change lanes, and behind us now."""
    return {1: lambda t: look(1, -5.0, left) if t < 18.0 else look(1, ahead, **more)}


def test_a_lane_change_close_ahead_of_somebody_is_moving_in() -> None:
    found = shown(CUT, looks=from_right(), episodes=MOVED)
    assert (found.holds, found.facts) == (True, MOVED)
    left = (did("change-left", 16.0, 18.0),)
    assert shown(CUT, looks=from_right(left=3.5), episodes=left).facts == left
    assert shown(CUT, looks=from_right(left=3.5), episodes=MOVED) is None
    assert shown(CUT, looks=from_right(), episodes=left) is None


@pytest.mark.parametrize(
    ("looks", "holds"),
    [
        (from_right(left=-1.1), True),
        (from_right(left=-0.9), False),
        (from_right(ahead=-14.9), True),  # 1.5 s at 10 m/s
        (from_right(ahead=-15.1), False),
        (from_right(ahead=-7.9, speed=2.0), True),  # or 8 m
        (from_right(ahead=-8.1, speed=2.0), False),
        (from_right(ahead=9.0), False),
        (from_right(oncoming=True), False),
    ],
)
def test_how_close_that_is(looks: Any, holds: bool) -> None:
    found = shown(CUT, looks=looks, episodes=MOVED)
    assert (found is not None) is holds


def test_a_lane_change_to_the_left_needs_somebody_there() -> None:
    left = (did("change-left", 16.0, 18.0),)
    assert shown(CUT, looks=from_right(left=1.1), episodes=left) is not None
    assert shown(CUT, looks=from_right(left=0.9), episodes=left) is None


def test_where_he_was_is_told_by_when_we_began() -> None:
    early = lambda t: look(1, -5.0, 3.5) if t < 16.0 else from_right()[1](t)  # noqa: E731
    assert shown(CUT, looks={1: early}, episodes=MOVED) is not None
    late = lambda t: None if t < 17.0 else from_right()[1](t)  # noqa: E731
    assert shown(CUT, looks={1: late}, episodes=MOVED) is None


def test_a_lane_change_that_is_long_over_is_none() -> None:
    for end, holds in ((14.1, True), (13.9, False)):
        moved = (did("change-right", 12.0, end),)
        assert (shown(CUT, looks=from_right(), episodes=moved) is not None) is holds
    two = (did("change-left", 13.0, 15.0), *MOVED)
    assert shown(CUT, looks=from_right(), episodes=two).facts == MOVED


def test_that_he_braked_is_told_beside_it() -> None:
    braked = they(1, "brake", 17.0, 18.0)
    assert shown(CUT, looks=from_right(), episodes=(*MOVED, braked)).facts == (*MOVED, braked)
    before = they(1, "brake", 15.0, 15.5)
    assert shown(CUT, looks=from_right(), episodes=(*MOVED, before)).facts == MOVED


def test_what_is_recorded_needs_no_reading() -> None:
    cut = did("cut-in", 17.0, object=ONE)
    assert shown(CUT, looks=from_right(), episodes=(*MOVED, cut)) is None


def test_pulling_out_before_somebody_is_moving_in() -> None:
    out = Event("pull-out", US, ONE, tense="present")
    assert shown(out, looks=from_right(), episodes=MOVED).facts == MOVED
    assert shown(out, looks=from_right(left=3.5), episodes=MOVED) is None
    assert shown(Event("pull-out", TWO, ONE, tense="present"), looks=from_right()) is None


def test_changing_lanes_ahead_of_somebody_is_moving_in() -> None:
    change = Event("change-lane", where=Related("ahead-of", US, ONE))
    assert shown(change, looks=from_right(), episodes=MOVED).facts == MOVED
    braked = they(1, "brake", 17.0, 18.0)
    far = from_right(ahead=-30.0)
    assert shown(change, looks=far, episodes=MOVED) is None
    assert shown(change, looks=far, episodes=(*MOVED, braked)).facts == (*MOVED, braked)
    for begin, holds in ((15.0, True), (14.9, False)):  # 1 s before at most
        early = they(1, "brake", begin, 17.0)
        assert (shown(change, looks=far, episodes=(*MOVED, early)) is not None) is holds
    cut = did("cut-in", 17.0, object=ONE)
    assert shown(change, looks=far, episodes=(cut,)).facts == (cut,)
    assert shown(change, looks=far, episodes=(braked,)) is None
    behind = Event("change-lane", where=Related("behind", US, ONE))
    assert shown(behind, looks=far, episodes=(*MOVED, braked)) is None
    long_over = (did("change-right", 10.0, 13.9), braked)
    assert shown(change, looks=far, episodes=long_over) is None


# --- following ----------------------------------------------------------------------------------

BEHIND = Event("follow", US, ONE, tense="present")


@pytest.mark.parametrize(
    ("moving", "looks", "holds"),
    [
        (did("change-left", 18.0), look(1, 20.0, 1.1), True),
        (did("change-left", 18.0), look(1, 20.0, 0.9), False),
        (did("change-left", 18.0), look(1, 20.0, -1.1), False),
        (did("change-right", 18.0), look(1, 20.0, -1.1), True),
        (did("change-right", 18.0), look(1, 20.0, -0.9), False),
        (did("change-right", 18.0, 19.0), look(1, 20.0, -3.5), False),
        (did("change-right", 18.0), look(1, -20.0, -3.5), False),
        (did("change-right", 18.0), look(1, 20.0, -3.5, oncoming=True), False),
    ],
)
def test_changing_to_the_lane_of_somebody_ahead_is_following(
    moving: Any, looks: Any, holds: bool
) -> None:
    found = shown(BEHIND, looks={1: looks}, episodes=(moving,))
    assert (found is not None) is holds
    if found is not None:
        assert (found.holds, found.facts) == (True, (moving,))


def test_following_that_is_recorded_or_past_is_not_read() -> None:
    moving, looks = did("change-left", 18.0), {1: look(1, 20.0, 3.5)}
    following = did("follow", 15.0, object=ONE)
    assert shown(BEHIND, looks=looks, episodes=(moving, following)) is None
    assert shown(Event("follow", US, ONE), looks=looks, episodes=(moving,)) is None
    assert shown(Event("follow", US, TWO, tense="present"), looks=looks, episodes=(moving,)) is None


FOLLOWS = Event("follow", ONE, US, tense="present")
#: We drive east and are at 200 m now; he drives 50 m behind us.
OURS = driven([10.0 * k for k in range(21)])


def his(x: float, y: float = 0.0, heading: float = 0.0) -> Any:
    return driven([x - 10.0, x], y, since=19.0, heading=heading)


@pytest.mark.parametrize(
    ("his_line", "holds"),
    [
        (his(150.0), True),
        (his(150.0, y=1.9), True),
        (his(150.0, y=2.1), False),
        (his(150.0, heading=0.55), True),
        (his(150.0, heading=0.65), False),
        (his(150.0, heading=-0.65), False),
        (his(121.0, heading=0.0), True),  # 8 s ago at most
        (his(110.0), False),
        (his(200.0), False),  # where we are only now
    ],
)
def test_who_drives_where_we_drove_follows_us(his_line: Any, holds: bool) -> None:
    found = shown(FOLLOWS, motions={0: OURS, 1: his_line}, values={("distance", 0, 1): 45.0})
    assert (found is not None) is holds
    if found is not None:
        assert (found.holds, found.facts[0].value) == (True, 45.0)


def test_only_the_next_one_follows_us() -> None:
    motions = {0: OURS, 1: his(140.0), 2: his(170.0)}
    looks = {1: look(1, -60.0), 2: look(2, -30.0)}
    assert shown(FOLLOWS, motions=motions, looks=looks) is None
    second = Event("follow", TWO, US, tense="present")
    assert shown(second, motions=motions, looks=looks).holds is True
    away = looks | {2: look(2, -30.0, in_view=False)}
    assert shown(FOLLOWS, motions=motions, looks=away).holds is True
    assert shown(second, motions=motions, looks=away) is None


def test_following_us_is_read_of_now_alone() -> None:
    motions = {0: OURS, 1: his(150.0)}
    recorded = they(1, "follow", 15.0, object=US)
    assert shown(FOLLOWS, motions=motions, episodes=(recorded,)) is None
    assert shown(Event("follow", ONE, US), motions=motions) is None
    assert shown(Event("follow", ONE, TWO, tense="present"), motions=motions) is None
    assert shown(FOLLOWS, motions={0: OURS}) is None
    assert shown(Event("follow", ONE, US, tense="present", modal="will"), motions=motions) is None
    assert shown(Event("follow", ONE, US, tense="future"), motions=motions) is None


# --- passing ------------------------------------------------------------------------------------

PASS = Event("overtake", US, ONE, tense="present")


@pytest.mark.parametrize(
    ("looks", "speed", "holds"),
    [
        (look(1, 20.0, 1.1), 12.0, True),
        (look(1, 20.0, -1.1), 12.0, True),
        (look(1, 20.0, 0.9), 12.0, False),
        (look(1, 20.0, 3.5), 10.0, False),  # no faster
        (look(1, 20.0, 3.5), None, False),
        (look(1, -1.0, 3.5), 12.0, False),
        (look(1, 0.0, 3.5), 12.0, True),
        (look(1, 20.0, 3.5, oncoming=True), 12.0, False),
        (look(1, 20.0, 3.5, in_view=False), 12.0, False),
    ],
)
def test_who_is_faster_and_beside_a_line_is_about_to_pass(
    looks: Any, speed: Any, holds: bool
) -> None:
    found = shown(PASS, looks={1: looks}, values={("speed", 0): speed})
    assert (found is not None) is holds
    if found is not None:
        assert (found.holds, found.facts[0].value) == (True, 12.0)


def test_leaving_his_line_is_about_to_pass() -> None:
    facts: dict[str, Any] = {"looks": {1: look(1, 20.0)}, "values": {("speed", 0): 12.0}}
    left = did("change-left", 16.0)
    assert shown(PASS, episodes=(did("change-left", 13.0, 15.0), left), **facts).facts == (left,)
    assert shown(PASS, episodes=(did("change-right", 16.0),), **facts) is None
    assert shown(PASS, episodes=(did("change-left", 10.0, 13.9),), **facts) is None
    recorded = did("overtake", 16.0, object=ONE)
    assert shown(PASS, episodes=(left, recorded), **facts) is None
    assert shown(Event("overtake", US, TWO, tense="present"), episodes=(left,), **facts) is None
    assert shown(Event("overtake", US, tense="present"), episodes=(left,), **facts) is None
    assert shown(Event("overtake", US, ONE), episodes=(left,), **facts) is None
