"""Who sets off across the ego's way is not expected to stop again: a left turn in s2."""

import numpy as np
import pytest

from planner.motion.forward import DT
from planner.motion.tracks import Observed
from planner.prediction.insisting import insists
from planner.prediction.recognise import recognise
from planner.record.trace import EgoGoal, Settings
from tests.planner.nets import shipped
from tests.planner.worlds import before_end, row, situation

EGO, OTHER = 0, 1
ROADS = shipped("s2")
LEFT = row("s2", "east_in_0", "left")  # its second lane begins beyond the place where to wait
STRAIGHT = row("s2", "west_in_0", "straight")


def seen(vehicle: int, lanes: tuple[str, ...], last: float, speeds: list[float]) -> Observed:
    """A vehicle with its latest speeds [m/s], steady before, whose front is at an arc [m] now."""
    speed = np.array([speeds[0]] * 15 + speeds)
    arcs = last - np.cumsum([0.0, *(speed[:0:-1] * DT)])[::-1]
    poses = [ROADS.line(lanes).pose(float(arc)) for arc in arcs]
    place, heading = (np.array([pose[k] for pose in poses]) for k in (0, 1))
    shown = frozenset({"left"}) if vehicle == OTHER else frozenset()
    return Observed(vehicle, 4.8, 1.8, place, heading, speed, shown)


def turning(speeds: list[float], beyond: float) -> Observed:
    begin = dict(ROADS.line(LEFT).lanes)[LEFT[2]]
    return seen(OTHER, LEFT, begin + beyond, speeds)


def waits(speeds: list[float], beyond: float, away: float = 6.0, pace: float = 8.0) -> bool:
    """Whether it is expected to give way to the ego, which comes at a distance [m] and speed."""
    ego = seen(EGO, STRAIGHT, before_end("s2", STRAIGHT[0], away), [pace] * 5)
    tracks, bound = [ego, turning(speeds, beyond)], EgoGoal("east_out", 60.0, None)
    found = recognise(ROADS, tracks, Settings(), 40.0, EGO, bound=bound)
    (belief,) = (b for b in found[OTHER] if b.goal.kind == "exit-left")
    return {h.vehicle for h in belief.trajectories[0].held_up} == {EGO}


def test_who_speeds_up_beyond_the_place_where_to_wait_goes_on() -> None:
    assert not waits([0.5, 1.0, 1.5], 0.5)


@pytest.mark.parametrize("speeds", [[1.5, 1.5, 1.5], [2.0, 1.8, 1.5]])
def test_who_does_not_speed_up_waits(speeds: list[float]) -> None:
    assert waits(speeds, 0.5)


def test_who_may_still_wait_at_the_place_for_it_waits() -> None:
    assert waits([0.5, 1.0, 1.5], -3.0, away=-2.0, pace=11.0)


def test_a_track_of_a_moment_tells_nothing() -> None:
    track = turning([0.5, 1.0, 1.5], 0.5)
    short = Observed(
        OTHER, 4.8, 1.8, track.position[-1:], track.heading[-1:], track.speed[-1:], frozenset()
    )
    starts = (situation("s2", "east_in_0", 10.0),)
    assert not insists(ROADS.network, starts, short, ())
