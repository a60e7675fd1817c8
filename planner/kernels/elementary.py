"""Elementary functions whose results are the same on every processor.

Those of numpy differ by a last digit between processors with and without AVX-512, from which a
search comes to other plans. Compiled by numba, they are those of the C library.
"""

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_jit = njit(cache=True, error_model="numpy")


def arctan2(y: Floats, x: Floats) -> Floats:
    """Return the angles [rad] of vectors of equal shape, in (-pi, pi]."""
    return _arctan2(np.ravel(y), np.ravel(x)).reshape(np.shape(y))


@_jit
def _arctan2(y: Floats, x: Floats) -> Floats:
    found = np.empty(len(y))
    for k in range(len(y)):
        found[k] = math.atan2(y[k], x[k])
    return found


@_jit
def power(base: Floats, exponent: float) -> Floats:
    """Return the powers of numbers [N]."""
    found = np.empty(len(base))
    for k in range(len(base)):
        found[k] = math.pow(base[k], exponent)
    return found
