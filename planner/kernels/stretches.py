"""The stretches of a path that other vehicles occupy, in tables."""

import math
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

_jit = njit(cache=True, error_model="numpy")


class Stretches(NamedTuple):
    """The stretches of a path that other vehicles occupy; NaN where they are not on it."""

    low: Floats  # [m] [M, T] arcs between which the body lies
    high: Floats  # [m] [M, T]
    wide_low: Floats  # [m] [M, T] the same, joined over a safety time before and after the step
    wide_high: Floats  # [m] [M, T]
    along: Floats  # [m/s] [M, T] speed along the path
    cosine: Floats  # [M, T] of the angle to the path
    speed: Floats  # [m/s] [M, T]
    entered: Floats  # [M, T] step at which it last came onto the path
    last: Floats  # [M] last step at which it is on the path; -1: never; FOREVER: still at the end
    top: Floats  # [m] [M] highest arc that it reaches


@_jit
def empty(count: int, total: int) -> Stretches:
    """Return stretches of `count` vehicles over `total` steps, none of which is on the path."""
    shape = (count, total)
    return Stretches(
        np.full(shape, np.nan),
        np.full(shape, np.nan),
        np.full(shape, np.nan),
        np.full(shape, np.nan),
        np.zeros(shape),
        np.zeros(shape),
        np.empty(shape),
        np.empty(shape),
        np.empty(count),
        np.empty(count),
    )


@_jit
def select(found: Stretches, rows: Ints, states: Floats, which: Ints) -> Stretches:
    """Return some rows of the stretches found, in order.

    Args:
        found: the stretches of several vehicles.
        rows: [M] those to take; -1 for a vehicle that is never on the path.
        states: [V, T, 4] of all vehicles.
        which: [M] indices of the vehicles wanted.
    """
    count, total = len(rows), states.shape[1]
    some = empty(count, total)
    for m in range(count):
        k = rows[m]
        some.speed[m] = states[which[m], :, 3]
        if k < 0:
            some.entered[m] = np.arange(1.0, total + 1.0)
            some.last[m], some.top[m] = -1.0, -math.inf
            continue
        some.low[m], some.high[m] = found.low[k], found.high[k]
        some.wide_low[m], some.wide_high[m] = found.wide_low[k], found.wide_high[k]
        some.along[m], some.cosine[m] = found.along[k], found.cosine[k]
        some.entered[m] = found.entered[k]
        some.last[m], some.top[m] = found.last[k], found.top[k]
    return some


def first_of(found: Stretches, count: int) -> Stretches:
    """Return the first rows of stretches."""
    return Stretches(*(column[:count] for column in found))


def roomier(found: Stretches, count: int, room: int) -> Stretches:
    """Return the first `count` rows of stretches, with room for `room` rows in all."""
    columns = [np.empty((room, *column.shape[1:])) for column in found]
    for column, old in zip(columns, found, strict=True):
        column[:count] = old[:count]
    return Stretches(*columns)


@_jit
def stay_behind(behind: Bools, found: Stretches, step: int, rear: float) -> None:
    """Mark the vehicles behind a place [m] on the path; those marked before stay marked."""
    t = min(step, found.low.shape[1] - 1)
    for m in range(len(behind)):
        behind[m] = behind[m] or 0.5 * (found.low[m, t] + found.high[m, t]) < rear
