"""Joined motions: the same as joining one after the other, however they are come to."""

from collections.abc import Sequence

import pytest

from planner.trace import SAMPLE_PERIOD, Track
from tests.explain.facts.scenes import Actor, made, recorded, straight
from xavi_dialogue.explain.history import joining
from xavi_dialogue.explain.history.joining import Joined, joined

RIDES = ("s1-0", "s3-0", "motorway-0")


def naive(tracks: Sequence[Track]) -> list[tuple[float, tuple[float, float], float]]:
    """Every sample that is later than the last one: time, position, speed."""
    found: list[tuple[float, tuple[float, float], float]] = []
    for track in tracks:
        for k, speed in enumerate(track.speed):
            time = track.start + k * SAMPLE_PERIOD
            if not found or time > found[-1][0] + SAMPLE_PERIOD / 2.0 + 1e-6:
                found.append((round(time, 3), track.position[k], speed))
    return found


@pytest.mark.parametrize("name", RIDES)
def test_joined_is_what_a_plain_loop_gives(name: str) -> None:
    ride = recorded(name)
    for vehicle in (0, *ride.vehicles):
        motion = ride.motion(vehicle)
        wanted = naive([t.history[vehicle] for t in ride.traces if vehicle in t.history])
        assert list(zip(motion.time, motion.position, motion.speed, strict=True)) == wanted


@pytest.mark.parametrize("name", RIDES)
def test_going_on_and_looking_back_give_the_same(name: str) -> None:
    traces = recorded(name).traces
    joining._kept.clear()
    for count in (3, len(traces) // 2, len(traces), 5):
        part = traces[:count]
        assert joined(part).seen == Joined().extended(part).seen


def test_rides_are_not_mixed_up() -> None:
    one = made({0: Actor(straight(0.0, 0.0, 10.0))}, 5.0)
    other = made({0: Actor(straight(7.0, 0.0, 10.0))}, 5.0)
    assert one.motion(0).position[0] == (0.0, 0.0)
    assert other.motion(0).position[0] == (7.0, 0.0)
    assert one.back(3.0).motion(0).time[-1] == 3.0


def test_hidden_stretches_are_told() -> None:
    actors = {
        0: Actor(straight(0.0, 0.0, 10.0)),
        1: Actor(straight(30.0, 4.0, 10.0), hidden=(3.0, 5.0)),
    }
    assert made(actors, 8.0).seen(1).hidden == ((3.0, 5.0),)
