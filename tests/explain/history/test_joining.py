"""Joined motions: the same as joining one after the other, however they are come to."""

from collections.abc import Sequence
from dataclasses import replace

import pytest

from planner.record.trace import SAMPLE_PERIOD, Track
from sim.scene import Scene
from tests.explain.facts.scenes import Actor, made, recorded, straight
from xavi_dialogue.explain.facts.states import states_of
from xavi_dialogue.explain.history import joining
from xavi_dialogue.explain.history.joining import Joined, joined
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride

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


def moment(ride: Ride, time: float, gone: int | None = None) -> Scene:
    """What is seen a while after the last decision, everybody having driven on as before."""
    rest = time - ride.latest.sim_time
    return Scene(
        time,
        {
            vehicle: replace(s, position=(s.position[0] + rest * s.speed, s.position[1]))
            for vehicle, s in ride.latest.scene.items()
            if vehicle != gone
        },
    )


ACTORS = {0: Actor(straight(0.0, 0.0, 10.0)), 1: Actor(straight(30.0, 4.0, 5.0))}


def seen_at(time: float, now: float, gone: int | None = None) -> Ride:
    """A ride with its last decision at 5 s, and a scene of another time."""
    ride = made(ACTORS, 5.0)
    scene = moment(ride, time, gone)
    return Ride(Record(now, ride.traces, ride.events, scene=scene))


def test_motion_reaches_up_to_what_is_seen_now() -> None:
    ride = seen_at(5.7, 5.7)
    assert ride.motion(0).time[-5:] == (5.0, 5.2, 5.4, 5.6, 5.7)
    assert [x for x, _ in ride.motion(0).position[-3:]] == pytest.approx([54.0, 56.0, 57.0])
    state = states_of(ride).state(1, 5.7)
    assert state is not None
    assert state.position == pytest.approx((58.5, 4.0))


def test_who_is_not_seen_any_more_has_left() -> None:
    assert states_of(seen_at(5.7, 5.7)).in_view(5.7) == (1,)
    assert states_of(seen_at(5.7, 5.7, gone=1)).in_view(5.7) == ()
    assert states_of(seen_at(5.7, 5.7, gone=1)).in_view(5.0) == (1,)


@pytest.mark.parametrize(("time", "now"), [(4.7, 5.7), (5.0, 5.7), (5.9, 5.7)])
def test_a_scene_before_the_last_decision_or_after_now_tells_nothing(
    time: float, now: float
) -> None:
    assert seen_at(time, now).scene is None
    assert seen_at(time, now).motion(0).time[-1] == 5.0


def test_looking_back_does_not_see_what_comes_later() -> None:
    assert seen_at(5.7, 5.7).back(5.4).motion(0).time[-1] == 5.0
