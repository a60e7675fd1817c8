"""Who would be touched by the side of a vehicle that turns."""

import math

import pytest

from planner.manoeuvres.clearance import MARGIN, first_touch
from sim.boxes import overlap
from sim.scene import VehicleState
from tests.planner.worlds import LENGTH, WIDTH, plan_of, situation

PATH = plan_of("s2", situation("s2", "south_in_0", 30.0), "exit-left").path
REACH = 200.0


def at(arc: float) -> VehicleState:
    position, heading = PATH.pose(arc, LENGTH)
    return VehicleState(position, heading, 5.0, 0.0, LENGTH, WIDTH)


def beside(arc: float, aside: float) -> VehicleState:
    """One that stands across the path's inner side, its front at a distance [m] from the line."""
    (x, y), heading = PATH.pose(arc)
    to_path = heading - math.pi / 2.0
    front = (x - aside * math.cos(to_path), y - aside * math.sin(to_path))
    return VehicleState(front, to_path, 0.0, 0.0, LENGTH, WIDTH)


def turning() -> float:
    """The arc [m] in the middle of the turn."""
    arcs = [0.5 * k for k in range(round(2.0 * PATH.length))]
    return next(a for a in arcs if PATH.pose(a)[1] - PATH.pose(0.0)[1] > math.pi / 4.0)


def test_who_stands_clear_of_the_line_but_not_of_the_body_is_found() -> None:
    other = beside(turning(), 0.5 * WIDTH + 0.1)
    found = first_touch(PATH, 0.0, REACH, at(0.0), {7: other})
    assert found is not None
    free, who = found
    assert who == 7
    assert not overlap(at(free), other)
    assert any(overlap(at(free + 0.1 * k), other) for k in range(1, 80))


@pytest.mark.parametrize("aside", [3.0, 6.0])
def test_who_stands_well_beside_is_no_concern(aside: float) -> None:
    assert first_touch(PATH, 0.0, REACH, at(0.0), {7: beside(turning(), aside)}) is None


def test_only_what_is_within_reach_counts() -> None:
    other = beside(turning(), 0.0)
    assert first_touch(PATH, 0.0, turning() - 15.0, at(0.0), {7: other}) is None


def test_who_is_touched_already_is_left_out() -> None:
    arc = turning()
    other = beside(arc, 0.5 * WIDTH + 0.5 * MARGIN)
    inside = next(a for a in (arc + 0.2 * k for k in range(40)) if overlap(at(a), other))
    assert first_touch(PATH, inside, REACH, at(inside), {7: other}) is None
