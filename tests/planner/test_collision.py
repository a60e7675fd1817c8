import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.collision import first_overlap
from sim.boxes import overlap
from sim.scene import VehicleState

places = st.tuples(st.floats(-8.0, 8.0), st.floats(-8.0, 8.0))
angles = st.floats(-math.pi, math.pi)
sizes = st.tuples(st.floats(1.0, 12.0), st.floats(0.5, 3.0))


def box(place: tuple[float, float], heading: float, size: tuple[float, float]) -> VehicleState:
    return VehicleState(place, heading, 0.0, 0.0, *size)


@given(
    st.lists(st.tuples(places, angles), min_size=1, max_size=8),
    st.lists(st.tuples(places, angles), min_size=8, max_size=8),
    sizes,
    sizes,
)
def test_the_vectorised_test_agrees_with_the_ground_truth(
    one: list[tuple[tuple[float, float], float]],
    other: list[tuple[tuple[float, float], float]],
    size: tuple[float, float],
    other_size: tuple[float, float],
) -> None:
    other = other[: len(one)]
    hits = [overlap(box(*a, size), box(*b, other_size)) for a, b in zip(one, other, strict=True)]
    found = first_overlap(
        np.array([place for place, _ in one]),
        np.array([heading for _, heading in one]),
        size,
        np.array([place for place, _ in other]),
        np.array([heading for _, heading in other]),
        other_size,
    )
    assert found == (hits.index(True) if True in hits else None)


@pytest.mark.parametrize(
    ("aside", "along", "hit"),
    [(1.7, 0.0, 0), (1.9, 0.0, None), (0.0, 4.7, 0), (0.0, 4.9, None), (0.0, -4.7, 0)],
)
def test_parallel_boxes(aside: float, along: float, hit: int | None) -> None:
    here, there = np.zeros((1, 2)), np.array([[along, aside]])
    straight = np.zeros(1)
    assert first_overlap(here, straight, (4.8, 1.8), there, straight, (4.8, 1.8)) == hit


def test_who_has_left_the_network_is_met_by_nobody() -> None:
    gone = np.full((3, 2), np.nan)
    straight = np.zeros(3)
    assert first_overlap(np.zeros((3, 2)), straight, (5, 2), gone, straight, (5, 2)) is None
