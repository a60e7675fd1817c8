"""From where on what somebody does has a name: just within each threshold, and beyond it."""

import math
import runpy
from typing import Any

import pytest

from tests.explain.facts.scenes import Actor, made, shifted, speeds, straight
from xavi_dialogue.domain.terms import Ego, Event, Vehicle
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history import thresholds

ONE = Vehicle(1)


def world(ours: Any = None, **other: Any) -> World:
    """We drive at 10 m/s, with another vehicle on the path that is given."""
    actors = {0: Actor(ours or straight(0.0, 0.0, 10.0))}
    return World(made(actors | ({1: Actor(**other)} if other else {}), 8.0))


def test_the_thresholds_are_in_order() -> None:
    table = runpy.run_path(thresholds.__file__)
    assert table["BRAKING"] < table["HARD"]
    assert table["SAME_WAY"] < table["OPPOSITE"]
    assert table["SMALL"] < table["BIG"]
    assert table["CLOSE"] < table["SAME_LANE"] < table["ROAD_WIDTH"]
    assert table["FOLLOWED"] < table["FOLLOWING"]


@pytest.mark.parametrize(
    ("rate", "action", "hard"),
    [(0.6, "slow-down", False), (1.2, "brake", False), (2.5, "brake", False), (4.0, "brake", True)],
)
def test_slowing_down_is_braking_and_hard_by_its_rate(rate: float, action: str, hard: bool) -> None:
    marks = ((0.0, 14.0), (2.0, 14.0), (5.0, 14.0 - 3.0 * rate), (8.0, 14.0 - 3.0 * rate))
    found = world(speeds(0.0, 0.0, marks))
    (episode,) = found.episodes(Ego(), ("slow-down", "brake"))
    assert episode.action == action
    firm = Event("brake", Ego(), manner=("hard",))
    assert bool(found.holds(firm, 0.0, 8.0)) is hard


@pytest.mark.parametrize(
    ("left", "relation", "holds"),
    [
        (3.5, "beside", True),
        (11.0, "beside", True),
        (15.0, "beside", False),
        (1.5, "beside", False),
        (12.0, "near", True),
        (22.0, "near", False),  # 20 m between the bodies
    ],
)
def test_who_is_abreast_is_beside_us_and_near_within_some_metres(
    left: float, relation: Any, holds: bool
) -> None:
    found = world(path=straight(0.0, left, 10.0))
    assert found.relation(relation, ONE, Ego(), 5.0) is holds


@pytest.mark.parametrize(
    ("speed", "ahead", "left", "follows"),
    [
        (10.0, 40.0, 0.0, True),  # 3.5 s
        (10.0, 60.0, 0.0, False),  # 5.5 s
        (1.0, 15.0, 0.0, True),  # 10 m
        (1.0, 22.0, 0.0, False),
        (10.0, 30.0, 1.9, True),
        (10.0, 30.0, 3.5, False),
    ],
)
def test_who_is_close_ahead_in_our_lane_is_followed(
    speed: float, ahead: float, left: float, follows: bool
) -> None:
    found = world(straight(0.0, 0.0, speed), path=straight(ahead, left, speed))
    assert bool(found.holds(Event("follow", Ego(), ONE), 0.0, 8.0)) is follows


@pytest.mark.parametrize(("seen", "follows"), [(3.0, True), (1.0, False)])
def test_one_is_followed_for_two_seconds_at_least(seen: float, follows: bool) -> None:
    found = world(path=straight(30.0, 0.0, 10.0), since=2.0, until=2.0 + seen)
    assert bool(found.holds(Event("follow", Ego(), ONE), 0.0, 8.0)) is follows


@pytest.mark.parametrize(("ahead", "cuts"), [(25.0, True), (45.0, False)])
def test_who_moves_in_close_ahead_cuts_in(ahead: float, cuts: bool) -> None:
    found = world(path=shifted(straight(ahead, 3.5, 10.0), 2.0, 5.0, -3.5))
    assert bool(found.holds(Event("cut-in", ONE, Ego()), 0.0, 8.0)) is cuts


@pytest.mark.parametrize(
    ("ahead", "degrees", "speed", "crosses"),
    [
        (30.0, 90.0, 8.0, True),
        (60.0, 90.0, 8.0, False),
        (30.0, 60.0, 8.0, True),
        (30.0, 40.0, 8.0, False),
        (30.0, 120.0, 8.0, True),
        (30.0, 140.0, 8.0, False),
        (30.0, 90.0, 1.5, True),
        (30.0, 90.0, 0.8, False),
    ],
)
def test_who_drives_across_ahead_of_us_crosses_our_way(
    ahead: float, degrees: float, speed: float, crosses: bool
) -> None:
    angle = math.radians(degrees)
    back = 4.0 * speed  # our ways meet after 4 s, as we crawl
    x, y = ahead + 0.5 * 4.0 - back * math.cos(angle), -back * math.sin(angle)
    found = world(straight(0.0, 0.0, 0.5), path=straight(x, y, speed, angle))
    assert bool(found.holds(Event("cross", ONE, Ego()), 0.0, 8.0)) is crosses


@pytest.mark.parametrize(
    ("length", "word"), [(2.9, "small"), (3.5, None), (6.0, None), (7.0, "big"), (12.0, "big")]
)
def test_a_vehicle_is_big_or_small_by_its_length(length: float, word: Any) -> None:
    found = world(path=straight(30.0, 0.0, 10.0), length=length)
    assert found.measure("size", ONE, 5.0).word == word
