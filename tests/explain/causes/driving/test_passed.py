"""Who has passed, and is no longer waited for."""

import math

from tests.explain.causes.decisions import Driven
from tests.explain.facts.scenes import Actor, speeds, straight
from xavi_dialogue.explain.causes.driving.passed import has_passed

STANDING = Actor(speeds(0.0, 0.0, ((0.0, 0.0), (9.0, 0.0))))
ACROSS = Actor(straight(10.0, -10.0, 5.0, math.pi / 2.0))  # from the right, on our lane at 2 s


def test_who_crosses_has_passed_once_beyond_our_lane() -> None:
    ride = Driven({0: STANDING, 1: ACROSS}, 8.0).ride()
    assert [has_passed(ride, 1, t) for t in (0.0, 1.0, 2.0, 4.0)] == [False, False, False, True]
    assert not has_passed(ride, None, 4.0)


def test_who_stands_beside_our_lane_has_not_passed() -> None:
    beside = Actor(straight(10.0, 4.0, 0.0, math.pi / 2.0))
    ride = Driven({0: STANDING, 1: beside}, 8.0).ride()
    assert not has_passed(ride, 1, 4.0)


def test_who_is_behind_us_has_passed() -> None:
    ride = Driven({0: STANDING, 1: Actor(straight(-12.0, 0.0, 0.0))}, 8.0).ride()
    assert has_passed(ride, 1, 4.0)
