"""The course of a vehicle: a path with speed limits, lines to wait at and lights, for kernels."""

from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]
Codes = NDArray[np.int8]
Motion: TypeAlias = tuple[float, float, float]  # arc [m], speed [m/s], acceleration [m/s2]


class Course(NamedTuple):
    """The limits and stops of a vehicle that drives along a path."""

    caps: Floats  # [m/s] at every metre
    halting: float  # [m/s2] deceleration to a standstill; 0 to drive on
    # [m] [L, 3] arcs of lines to give way at, and of the exits of their junctions; and whether to
    # approach slowly while a vehicle with priority stands there (1) or not (0)
    lines: Floats
    rooms: Floats  # [m] [K, 2] arcs of the entry and exit of junctions to keep clear
    lights: Floats  # [m] [S] arcs at which to stop for a light
    shows: Codes  # [S, T] the code of its state at every step; the last one stays
