"""Oriented boxes."""

import math
from dataclasses import replace

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from sim.boxes import corners, overlap
from sim.scene import Point, VehicleState

CAR = VehicleState((0.0, 0.0), 0.0, 5.0, 0.0, 4.8, 1.8)

BOXES = st.builds(
    VehicleState,
    position=st.tuples(st.floats(-8.0, 8.0), st.floats(-8.0, 8.0)),
    heading=st.floats(-math.pi, math.pi),
    speed=st.just(0.0),
    acceleration=st.just(0.0),
    length=st.floats(1.0, 12.0),
    width=st.floats(0.5, 3.0),
)


def turned(state: VehicleState, angle: float, shift: Point) -> VehicleState:
    x, y = state.position
    c, s = math.cos(angle), math.sin(angle)
    position = (c * x - s * y + shift[0], s * x + c * y + shift[1])
    return replace(state, position=position, heading=state.heading + angle)


def grown(state: VehicleState, by: float) -> VehicleState:
    """The box with every side moved outwards [m]."""
    x, y = state.position
    front = (x + by * math.cos(state.heading), y + by * math.sin(state.heading))
    length, width = state.length + 2.0 * by, state.width + 2.0 * by
    return replace(state, position=front, length=length, width=width)


def test_corners_of_a_car_heading_north() -> None:
    car = replace(CAR, position=(10.0, 20.0), heading=math.pi / 2)
    expected = ((9.1, 20.0), (10.9, 20.0), (10.9, 15.2), (9.1, 15.2))
    for corner, wanted in zip(corners(car), expected, strict=True):
        assert corner == pytest.approx(wanted)


@pytest.mark.parametrize(
    ("position", "heading", "expected"),
    [
        ((0.0, 0.0), 0.0, True),
        ((4.7, 0.0), 0.0, True),
        ((4.9, 0.0), 0.0, False),
        ((0.0, 1.7), 0.0, True),  # across a lane boundary
        ((0.0, 1.9), 0.0, False),
        ((4.0, 1.0), math.pi / 2, False),  # crossing ahead of the bumper
        ((-2.0, 1.0), math.pi / 2, True),
        ((3.0, -0.2), -math.pi / 4, False),  # bounding boxes meet, cars do not
    ],
)
def test_overlap(position: Point, heading: float, expected: bool) -> None:
    assert overlap(CAR, replace(CAR, position=position, heading=heading)) is expected


@given(a=BOXES, b=BOXES)
def test_overlap_is_symmetric(a: VehicleState, b: VehicleState) -> None:
    assert overlap(a, b) == overlap(b, a)


@given(
    a=BOXES,
    b=BOXES,
    angle=st.floats(-math.pi, math.pi),
    shift=st.tuples(st.floats(-100.0, 100.0), st.floats(-100.0, 100.0)),
)
def test_overlap_survives_turning_the_map(
    a: VehicleState, b: VehicleState, angle: float, shift: Point
) -> None:
    # Where boxes just touch, rounding decides.
    assume(overlap(grown(a, 1e-6), b) == overlap(grown(a, -1e-6), b))
    assert overlap(a, b) == overlap(turned(a, angle, shift), turned(b, angle, shift))


@given(a=BOXES)
def test_a_box_overlaps_itself_and_nothing_far_away(a: VehicleState) -> None:
    assert overlap(a, a)
    assert not overlap(a, turned(a, 0.0, (100.0, 0.0)))
