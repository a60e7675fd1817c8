"""Collision test of two moving oriented boxes (separating axes), over all samples at once."""

import numpy as np

from planner.trajectory import Array


def first_overlap(
    position: Array,
    heading: Array,
    size: tuple[float, float],
    other_position: Array,
    other_heading: Array,
    other_size: tuple[float, float],
) -> int | None:
    """Index of the first sample in which two boxes overlap, or None.

    Args:
        position, other_position: [m] [T, 2] centres of the front bumpers.
        heading, other_heading: [rad] [T]
        size, other_size: length and width [m].
    """
    ax, ay = np.cos(heading), np.sin(heading)
    bx, by = np.cos(other_heading), np.sin(other_heading)
    dx = (other_position[:, 0] - 0.5 * other_size[0] * bx) - (position[:, 0] - 0.5 * size[0] * ax)
    dy = (other_position[:, 1] - 0.5 * other_size[0] * by) - (position[:, 1] - 0.5 * size[0] * ay)
    cos, sin = np.abs(ax * bx + ay * by), np.abs(ax * by - ay * bx)
    length, width = 0.5 * size[0], 0.5 * size[1]
    other_length, other_width = 0.5 * other_size[0], 0.5 * other_size[1]
    overlaps = (
        (np.abs(dx * ax + dy * ay) < length + other_length * cos + other_width * sin)
        & (np.abs(dy * ax - dx * ay) < width + other_length * sin + other_width * cos)
        & (np.abs(dx * bx + dy * by) < other_length + length * cos + width * sin)
        & (np.abs(dy * bx - dx * by) < other_width + length * sin + width * cos)
    )
    hits = np.flatnonzero(overlaps)
    return int(hits[0]) if len(hits) else None
