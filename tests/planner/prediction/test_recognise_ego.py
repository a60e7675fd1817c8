"""How those who have to give way to the ego reckon with it: at a crossroads drawn by hand."""

from dataclasses import replace

import numpy as np
import pytest

from planner.motion.forward import DT
from planner.motion.tracks import Observed
from planner.prediction.recognise import recognise
from planner.record.trace import EgoGoal, Settings
from sim.roads.network import Direction
from tests.planner.crossroads import ARM, crossroads, lane_row

EGO, OTHER = 0, 1
STRAIGHT_ON = EgoGoal("north_out", 60.0, None)
TO_THE_LEFT = EgoGoal("west_out", 60.0, None)
KIND = {"straight": "continue", "right": "exit-right"}
GONE = 7.0  # [s] after which who sets off at once has left the junction


def standing(arm: str, turn: Direction, away: float, vehicle: int) -> Observed:
    """A vehicle that has stood for 4 s at a distance [m] before the junction, or in it."""
    place, heading = crossroads().line(lane_row(arm, turn)).pose(ARM - away)
    shown = frozenset({turn}) if turn in ("left", "right") else frozenset()
    return Observed(
        vehicle,
        4.8,
        1.8,
        np.tile(place, (20, 1)),
        np.full(20, heading),
        np.zeros(20),
        shown,
    )


def leaves(away: float, bound: EgoGoal | None, speed: float = 0.0) -> float:
    """When [s] a left turn from the north is over, where the ego is in the south."""
    waiting = standing("north", "left", 1.0, OTHER)
    ego = standing("south", "straight", away, EGO)
    if speed > 0.0:
        back = np.outer(np.arange(19, -1, -1), (0.0, speed * DT))
        ego = replace(ego, position=ego.position - back, speed=np.full(20, speed))
    found = recognise(crossroads(), [ego, waiting], Settings(), 40.0, EGO, bound=bound)
    assert list(found) == [OTHER]
    (belief,) = (b for b in found[OTHER] if b.goal.kind == "exit-left")
    east = belief.trajectories[0].motion.position[:, 0] > 12.0
    return float(np.argmax(east)) * 0.2 if bool(np.any(east)) else 30.0


def test_a_left_turn_waits_for_the_ego_that_is_about_to_set_off() -> None:
    assert leaves(2.0, STRAIGHT_ON) > GONE > leaves(2.0, None)


def test_a_left_turn_does_not_wait_for_an_ego_that_turns_left_too() -> None:
    assert leaves(2.0, TO_THE_LEFT) < GONE


def test_where_the_ego_drives_to_counts_while_it_moves() -> None:
    assert leaves(20.0, TO_THE_LEFT, 8.0) < GONE < leaves(20.0, None, 8.0)
    assert leaves(20.0, STRAIGHT_ON, 8.0) > GONE


def test_a_left_turn_does_not_wait_where_there_is_time_enough() -> None:
    assert leaves(100.0, STRAIGHT_ON) < GONE


@pytest.mark.parametrize("turn", ["straight", "right"])
def test_who_goes_straight_on_or_right_does_not_wait_for_the_ego(turn: Direction) -> None:
    oncoming = standing("north", turn, 1.0, OTHER)
    ego = standing("south", "straight", 2.0, EGO)
    found = recognise(crossroads(), [ego, oncoming], Settings(), 40.0, EGO, bound=STRAIGHT_ON)
    (belief,) = (b for b in found[OTHER] if b.goal.kind == KIND[turn])
    assert belief.trajectories[0].held_up == ()
    assert belief.trajectories[0].motion.speed[10] > 1.5


def test_the_ego_moves_off_behind_those_before_it() -> None:
    """Whatever their names, a queue is reckoned with from its head on."""
    waiting = standing("north", "left", 1.0, OTHER)
    queue = [standing("south", "straight", 2.0 + 8.0 * k, v) for k, v in enumerate((7, 5, EGO))]
    tracks = sorted([waiting, *queue], key=lambda track: track.vehicle)
    found = recognise(crossroads(), tracks, Settings(), 40.0, EGO, bound=STRAIGHT_ON)
    (belief,) = (b for b in found[OTHER] if b.goal.kind == "exit-left")
    held = {h.vehicle for h in belief.trajectories[0].held_up}
    assert held == {7, 5, EGO}
