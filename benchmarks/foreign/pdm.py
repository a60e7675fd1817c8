"""The score of NAVSIM's predictive driver model, applied to a whole ride.

Formula, weights and bounds are those of NAVSIM's version 1 (Dauner et al., "NAVSIM: Data-Driven
Non-Reactive Autonomous Vehicle Simulation and Benchmarking", NeurIPS 2024; docs/metrics.md and
pdm_scorer.py of github.com/autonomousvision/navsim):

    PDMS = NC DAC (5 EP + 5 TTC + 2 C) / 12

In NAVSIM a scene lasts four seconds; here a ride is cut into pieces of four seconds. NC (no
collision that the ego caused) and DAC (always on the road) are 0 or 1 for the ride. TTC (time to
collision within bounds) and C (comfort) are the shares of the pieces that keep to their bounds. EP
is the progress of a driver when the faster of two arrives, as a share of the way.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.signal import savgol_filter

from sim.boxes import overlap
from sim.roads.network import angle_between
from sim.scene import EGO, Scene, VehicleState

Array = NDArray[np.float64]

SAMPLE = 0.1  # [s] between states
PIECE = 40  # samples of a piece
WEIGHTS = {"progress": 5.0, "time_to_collision": 5.0, "comfort": 2.0}
AHEAD = (0, 3, 6, 9)  # samples ahead for which everybody's motion is extrapolated
STOPPED = 5e-3  # [m/s]
IN_FRONT, BEHIND = math.radians(30.0), math.radians(150.0)  # bounds of bearings from the ego
REACH = 30.0  # [m] within which the ego may meet others
REAR = 1.0  # [m] from the rear bumper to the rear axle
ACCELERATION = (-4.05, 2.40)  # [m/s2] along the heading
LATERAL = 4.89  # [m/s2]
YAW_RATE, YAW_ACCELERATION = 0.95, 1.93  # [rad/s], [rad/s2]
JERK, JERK_ALONG = 8.37, 4.13  # [m/s3]


def score(*, collided: bool, off_road: bool, parts: dict[str, float]) -> float:
    """Return the score from 0 to 1.

    Args:
        collided: whether the ego caused a collision.
        off_road: whether it was off the road at any time.
        parts: `progress`, `time_to_collision` and `comfort`, each from 0 to 1.
    """
    if collided or off_road:
        return 0.0
    return sum(WEIGHTS[name] * parts[name] for name in WEIGHTS) / sum(WEIGHTS.values())


def progress(own: Sequence[float], other: Sequence[float]) -> float:
    """Return how far a driver is when the faster of two arrives, as a share of the way.

    Args:
        own: [m] travelled at each sample; the length of the way is what the faster driver has
            travelled in the end.
        other: the same of the other driver, from the same start. For a driver that does not
            arrive, the samples reach as far as it was observed.
    """
    if not own or not other:
        return 0.0
    last = min(len(own), len(other)) - 1
    far = max(own[last], other[last])
    return 1.0 if far <= 5.0 else min(own[last] / far, 1.0)


def comfortable(speed: Array, acceleration: Array, heading: Array) -> float:
    """Return the share of pieces within the bounds of comfort, from states [N] at 10 Hz.

    Args:
        speed: [m/s]
        acceleration: [m/s2] along the heading.
        heading: [rad]
    """
    kept = [
        _comfortable(speed[part], acceleration[part], np.unwrap(heading[part]))
        for part in _pieces(len(speed))
    ]
    return sum(kept) / len(kept) if kept else 1.0


def in_time(scenes: Sequence[Scene], off_lane: Sequence[bool]) -> float:
    """Return the share of pieces in which the ego would hit nobody within 0.9 s.

    Args:
        scenes: at 10 Hz.
        off_lane: for each scene, whether the ego is in more than one lane or in a junction. There
            vehicles beside it matter too, elsewhere only those in front.
    """
    close = [_close(scenes, k, off_lane[k]) for k in range(len(scenes))]
    kept = [not any(close[part]) for part in _pieces(len(scenes))]
    return sum(kept) / len(kept) if kept else 1.0


def _pieces(count: int) -> list[slice]:
    """Return the pieces of a ride; a remainder belongs to the last one."""
    starts = list(range(0, max(count - PIECE, 0) + 1, PIECE))
    ends = [*starts[1:], count]
    return [slice(a, b) for a, b in zip(starts, ends, strict=True)] if count else []


def _comfortable(speed: Array, acceleration: Array, heading: Array) -> bool:
    if len(speed) < 3:
        return True
    turning = _derived(heading, 5, 1)
    along = _smooth(acceleration)
    across = _smooth(speed * turning)
    magnitude = _smooth(np.hypot(acceleration, speed * turning))
    return bool(
        np.all((along >= ACCELERATION[0]) & (along <= ACCELERATION[1]))
        and np.all(np.abs(across) <= LATERAL)
        and np.all(np.abs(_derived(magnitude, 15, 1)) <= JERK)
        and np.all(np.abs(_derived(along, 15, 1)) <= JERK_ALONG)
        and np.all(np.abs(_derived(heading, 5, 2, 3)) <= YAW_ACCELERATION)
        and np.all(np.abs(turning) <= YAW_RATE)
    )


def _smooth(values: Array) -> Array:
    found: Array = savgol_filter(values, min(8, len(values)), 2)
    return found


def _derived(values: Array, window: int, order: int, degree: int = 2) -> Array:
    """Return a derivative by the filter of Savitzky and Golay (Analytical Chemistry 36, 1964)."""
    width = min(window, len(values))
    degree = min(degree, width - 1)
    found: Array = savgol_filter(values, width, degree, deriv=min(order, degree), delta=SAMPLE)
    return found


def _close(scenes: Sequence[Scene], k: int, off_lane: bool) -> bool:
    ego = scenes[k].ego
    if ego.speed < STOPPED:
        return False
    for ahead in (step for step in AHEAD if k + step < len(scenes)):
        moved = _moved(ego, ahead * SAMPLE)
        for name, other in scenes[k + ahead].vehicles.items():
            near = name != EGO and math.dist(other.position, moved.position) <= REACH
            if near and overlap(moved, other) and _matters(ego, other, off_lane):
                return True
    return False


def _moved(ego: VehicleState, seconds: float) -> VehicleState:
    way = ego.speed * seconds
    x, y = ego.position
    there = (x + way * math.cos(ego.heading), y + way * math.sin(ego.heading))
    return replace(ego, position=there)


def _matters(ego: VehicleState, other: VehicleState, off_lane: bool) -> bool:
    """Check whether the ego has to keep clear of another vehicle."""
    back = REAR - ego.length
    x = ego.position[0] + back * math.cos(ego.heading)
    y = ego.position[1] + back * math.sin(ego.heading)
    half = 0.5 * other.length
    middle_x = other.position[0] - half * math.cos(other.heading)
    middle_y = other.position[1] - half * math.sin(other.heading)
    bearing = abs(angle_between(math.atan2(middle_y - y, middle_x - x), ego.heading))
    return bearing < IN_FRONT or (off_lane and bearing < BEHIND)
