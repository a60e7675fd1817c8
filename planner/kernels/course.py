"""What is driven along a path, as the kernels know it."""

from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]
Codes = NDArray[np.int8]
Motion: TypeAlias = tuple[float, float, float]  # arc [m], speed [m/s], acceleration [m/s2]


class Course(NamedTuple):
    """What is driven along a path."""

    caps: Floats  # [m/s] at every metre
    halting: float  # [m/s2] of braking to a standstill; 0 to drive on
    # [m] [L, 3] arcs of lines to give way at, and at which the junction is left; and whether to
    # come to them slowly while somebody with priority stands there (1) or not (0)
    lines: Floats
    rooms: Floats  # [m] [K, 2] arcs at which to keep out of a junction, and to have left it
    lights: Floats  # [m] [S] arcs at which to stop for a light
    shows: Codes  # [S, T] what it shows at every step; the last one stays
