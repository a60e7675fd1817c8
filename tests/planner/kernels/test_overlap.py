import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from planner.kernels.collision import overlap as touching
from sim.boxes import overlap
from sim.scene import VehicleState

places = st.tuples(st.floats(-8.0, 8.0), st.floats(-8.0, 8.0))
angles = st.floats(-math.pi, math.pi)
sizes = st.tuples(st.floats(1.0, 12.0), st.floats(0.5, 3.0))


def box(place: tuple[float, float], heading: float, size: tuple[float, float]) -> VehicleState:
    return VehicleState(place, heading, 0.0, 0.0, *size)


@given(places, angles, sizes, places, angles, sizes)
def test_the_kernel_agrees_with_the_ground_truth(
    place: tuple[float, float],
    heading: float,
    size: tuple[float, float],
    other: tuple[float, float],
    turned: float,
    other_size: tuple[float, float],
) -> None:
    hit = overlap(box(place, heading, size), box(other, turned, other_size))
    wider = (other_size[0] + 1e-6, other_size[1] + 1e-6)
    narrower = (other_size[0] - 1e-6, other_size[1] - 1e-6)
    for almost in (wider, narrower):  # no boxes that just touch
        assume(overlap(box(place, heading, size), box(other, turned, almost)) == hit)
    assert touching(*place, heading, size, *other, turned, np.array(other_size)) == hit


@pytest.mark.parametrize(
    ("aside", "along", "hit"),
    [(1.7, 0.0, True), (1.9, 0.0, False), (0.0, 4.7, True), (0.0, 4.9, False), (0.0, -4.7, True)],
)
def test_parallel_boxes(aside: float, along: float, hit: bool) -> None:
    size = (4.8, 1.8)
    assert touching(0.0, 0.0, 0.0, size, along, aside, 0.0, np.array(size)) == hit


def test_who_has_left_the_network_is_met_by_nobody() -> None:
    size, gone = (4.8, 1.8), float("nan")
    assert not touching(0.0, 0.0, 0.0, size, gone, gone, 0.0, np.array(size))
