"""The reaction of others to a vehicle that is, or comes, ahead of them on their own path.

Car-following is the Intelligent Driver Model (IDM; Treiber, Hennecke and Helbing 2000, Equations
3 and 4) without its free-road term: a driver who is not held up moves as predicted. Where the IDM
brakes harder than the constant-acceleration heuristic finds necessary, as behind a vehicle that
has just cut in, the two are combined (Kesting, Treiber and Helbing 2010, Equation 11).
"""

import math
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from planner.kernels.limits import ACCELERATION, COMFORT, FIRM, MIN_GAP, RELAXATION, STEP

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

HEADWAY = 0.9  # [s] kept to a leader
COOLNESS = 0.99  # share of the constant-acceleration heuristic
DELAY = 3  # steps after which a driver reacts to a vehicle that has come onto its path
NOTICEABLE = 0.5  # [m/s2] minimum braking beyond the predicted one for a reaction
STANDING = 0.05  # [m/s] below which a predicted motion waits
BESIDE = 0.2  # [m] kept free beside the body
CLEARED = 0.5  # [s] before a driver arrives by which a crossing vehicle must be off its path
NEAREST = 0.1  # [m] minimum gap in calculations
ALIGNED = 0.9  # minimum cosine of the angle between two headings that count as alike
MOVES = 0.2  # [m] minimum motion in two steps that defines the direction of a path
CROSSING = 0.1  # [m/s] minimum lateral speed of a vehicle that is about to leave a path

_jit = njit(cache=True, error_model="numpy")
_inline = njit(cache=True, error_model="numpy", inline="always")  # avoids reference counting


class Drivers(NamedTuple):
    """The other vehicles, and their progress along their predicted paths."""

    paths: Floats  # [M, T, 4] predicted states
    arcs: Floats  # [m] [M, T] along them; filled in for those that are measured
    measured: Bools  # [M] whether its arcs are filled in
    sizes: Floats  # [m] [M, 2] length and width
    at: Floats  # [M] step of the prediction that each has reached; less than the time if it is late
    pace: Floats  # [m/s] [M]
    noticed: Ints  # [M] number of steps for which the ego has been on its path
    late: Bools  # [M] whether it has braked
    elsewhere: Bools  # [M, T] whether it is above or below the ego's way; or [0, 0]


class Leader(NamedTuple):
    """A vehicle that may be ahead of a driver."""

    x: float  # [m] of the middle
    y: float  # [m]
    cos: float  # of the heading
    sin: float
    speed: float  # [m/s]
    gain: float  # [m/s2] acceleration
    length: float  # [m]
    width: float  # [m]


@_jit
def react(
    own: Floats,
    size: tuple[float, float],
    first: int,
    states: Floats,
    sizes: Floats,
    noticed: Ints,
    braking: Bools,
    elsewhere: Bools,
) -> tuple[Floats, Ints, Bools]:
    """Return the motion of others while a vehicle, the ego, drives along a line.

    Each keeps to its predicted path and never gets ahead of its prediction. It brakes for the ego
    if the ego is ahead on its path, and for others that brake. After the line it drives on, late.

    Args:
        own, size, first: states [S, 4] of the ego from step `first` on; length and width [m].
        states, sizes: [M, T, 4] and [M, 2] of the others, as predicted.
        noticed, braking: [M] steps for which the ego has been on their path; whether they braked.
        elsewhere: [M, T] whether they are above or below the ego's way; [0, 0] if none ever is.

    Returns:
        The states, and `noticed` and `braking` after the line; `states` itself if none reacts.
    """
    count, total = states.shape[:2]
    pace = states[:, min(first, total - 1), 3].copy()
    at, late = np.full(count, float(first)), braking.copy()
    arcs, measured = np.empty((count, total)), np.zeros(count, np.bool_)
    them = Drivers(states, arcs, measured, sizes, at, pace, noticed.copy(), late, elsewhere)
    moved, ends = states, min(first + len(own), total) - 1
    pushes = np.empty(count)  # [m/s2] highest acceleration allowed to each
    for t in range(first, total - 1):
        if t >= ends and moved is states:
            break  # nobody reacts
        pushes[:] = math.inf
        if t < ends:
            _mind(them, pushes, _ego(own, t - first, size), moved, t)
        for m in range(count):
            if at[m] == t and (pushes[m] == math.inf or not _brakes(them, m, pushes[m])):
                at[m], pace[m] = float(t + 1), states[m, t + 1, 3]
                continue
            moved = states.copy() if moved is states else moved
            _drive_on(them, m, t, pushes[m], moved[m, t + 1])
    return moved, them.noticed, late


@_jit
def _norm(x: float, y: float) -> float:
    return math.sqrt(x * x + y * y)


@_inline
def _ego(own: Floats, k: int, size: tuple[float, float]) -> Leader:
    return _leader(own[k], size, (own[k, 3] - own[max(k - 1, 0), 3]) / STEP)


@_inline
def _leader(state: Floats, size: tuple[float, float], gain: float) -> Leader:
    cos, sin = math.cos(state[2]), math.sin(state[2])
    x, y = state[0] - 0.5 * size[0] * cos, state[1] - 0.5 * size[0] * sin
    return Leader(x, y, cos, sin, state[3], gain, size[0], size[1])


@_inline
def _mind(them: Drivers, pushes: Floats, ego: Leader, moved: Floats, t: int) -> None:
    """Lower the highest acceleration [m/s2] of each driver, for the ego and those that brake.

    A driver reacts to the ego once the ego has been on its path for DELAY steps, or at once if the
    ego is there at step 0.
    """
    paths, sizes, at, pace = them.paths, them.sizes, them.at, them.pace
    noticed, late = them.noticed, them.late
    for m in range(len(pushes)):
        x, y = moved[m, t, 0], moved[m, t, 1]
        if not _near(x, y, pace[m], sizes[m, 0], ego):
            noticed[m] = 0
            continue
        push = math.inf
        if _concerns(paths, m, int(at[m]), x, y, pace[m], sizes[m, 0], ego):
            push = _push(them, m, moved, t, ego, True)
        if push == math.inf:
            noticed[m] = 0
        else:
            noticed[m] += DELAY + 1 if t == 0 else 1
            if noticed[m] > DELAY:
                pushes[m] = push
    for n in range(len(pushes)):
        if not late[n]:
            continue
        leader = _leader(moved[n, t], (sizes[n, 0], sizes[n, 1]), 0.0)
        level = not _elsewhere(them, n, int(at[n]))
        for m in range(len(pushes)):
            x, y, k = moved[m, t, 0], moved[m, t, 1], int(at[m])
            near = n != m and _near(x, y, pace[m], sizes[m, 0], leader)
            if near and _concerns(paths, m, k, x, y, pace[m], sizes[m, 0], leader):
                pushes[m] = min(pushes[m], _push(them, m, moved, t, leader, level))


@_inline
def _brakes(them: Drivers, m: int, push: float) -> bool:
    """Check whether a driver has to brake noticeably harder than predicted."""
    k = int(them.at[m])
    planned = (them.paths[m, k + 1, 3] - them.pace[m]) / STEP
    least = planned if them.late[m] else min(planned, 0.0) - NOTICEABLE
    return bool(push < least and them.pace[m] > STANDING)


@_inline
def _drive_on(them: Drivers, m: int, t: int, push: float, state: Floats) -> None:
    """Move a late driver on by one step, into its state at the next one."""
    path, at, pace = them.paths[m], them.at[m], them.pace[m]
    wanted = path[min(int(at) + 1, len(path) - 1), 3]
    free = max(min((wanted - pace) / RELAXATION, ACCELERATION), -FIRM)
    faster = max(pace + max(min(free, push), -FIRM) * STEP, 0.0)
    room = 0.5 * (pace + faster) * STEP
    them.late[m] = True
    them.at[m] = min(_onward(path, at, room), float(t + 1))
    them.pace[m] = faster
    _put(path, them.at[m], faster, state)


@_inline
def _near(x: float, y: float, pace: float, length: float, leader: Leader) -> bool:
    """Check whether a leader may concern a driver at (x, y), without computing a square root."""
    dx, dy = leader.x - x, leader.y - y
    reach = _wished(pace, pace) + leader.length + length + 1e-6
    return bool(dx * dx + dy * dy <= reach * reach)


@_inline
def _concerns(
    paths: Floats, m: int, k: int, x: float, y: float, pace: float, length: float, leader: Leader
) -> bool:
    """Check whether a leader may concern a driver at (x, y): it is ahead, and near enough."""
    dx, dy = leader.x - x, leader.y - y
    away = _norm(dx, dy) - leader.length - length
    if not away <= _wished(pace, pace):
        return False  # far away, or out of the network
    cos, sin = _direction(paths, m, k)
    if dx * cos + dy * sin < -0.5 * length:
        return False
    alike = cos * leader.cos + sin * leader.sin
    return alike <= ALIGNED or away <= _wished(pace, pace - leader.speed * alike)


@_inline
def _push(them: Drivers, m: int, moved: Floats, t: int, leader: Leader, level: bool) -> float:
    """Return the acceleration [m/s2] that a leader, level with the ego or not, allows; or inf."""
    pace, length, width = them.pace[m], them.sizes[m, 0], them.sizes[m, 1]
    ahead, aside, k = _along(them, m, moved[m, t], leader.x, leader.y)
    cos, sin = _direction(them.paths, m, k)
    along, across = leader.cos * cos + leader.sin * sin, leader.sin * cos - leader.cos * sin
    half = 0.5 * (leader.length * abs(along) + leader.width * abs(across))
    wide = 0.5 * (leader.length * abs(across) + leader.width * abs(along) + width) + BESIDE
    if abs(aside) >= wide or ahead < -0.5 * length or (level and _elsewhere(them, m, k)):
        return math.inf
    gap, along, across = max(ahead - half, NEAREST), leader.speed * along, leader.speed * across
    if abs(across) > CROSSING:
        clear = (wide - aside * math.copysign(1.0, across)) / abs(across)
        if gap > (pace - along) * (clear + CLEARED):
            return math.inf
    return _follow(gap, pace, max(along, 0.0), leader.gain)


@_inline
def _elsewhere(them: Drivers, m: int, k: int) -> bool:
    """Check whether a driver is above or below the ego's way at a sample of its path."""
    return bool(len(them.elsewhere) > 0 and them.elsewhere[m, k])


@_jit
def _wished(speed: float, closing: float) -> float:
    """Return the desired gap [m] to a leader, at a speed and a closing speed [m/s]."""
    catching_up = speed * closing / (2.0 * math.sqrt(ACCELERATION * COMFORT))
    return MIN_GAP + max(speed * HEADWAY + catching_up, 0.0)


@_jit
def _follow(gap: float, speed: float, leader: float, gain: float) -> float:
    """Return the acceleration [m/s2] behind a leader at a gap [m]; speeds in [m/s]."""
    closing = speed - leader
    idm = ACCELERATION * (1.0 - (_wished(speed, closing) / gap) ** 2)
    gain = min(gain, ACCELERATION)
    if leader * closing <= -2.0 * gap * gain and (gain < 0.0 or closing < 0.0):
        needed = speed * speed * gain / (leader * leader - 2.0 * gap * gain + 1e-9)
    else:
        needed = gain - max(closing, 0.0) ** 2 / (2.0 * gap)
    if idm >= needed:
        return idm
    soft = needed + COMFORT * math.tanh((idm - needed) / COMFORT)
    return (1.0 - COOLNESS) * idm + COOLNESS * soft


@_inline
def _along(them: Drivers, m: int, here: Floats, x: float, y: float) -> tuple[float, float, int]:
    """Return where a point (x, y) lies along a driver's path, from the driver on.

    Returns:
        The distance [m] along the path from the driver's front to the point, that [m] of the point
        to the left of the path, and the index of the nearest sample.
    """
    path, arcs, start = them.paths[m], them.arcs[m], int(them.at[m])
    if not them.measured[m]:
        _measure(path, arcs)
        them.measured[m] = True
    mine = arcs[start] + _norm(here[0] - path[start, 0], here[1] - path[start, 1])
    wanted = mine + _norm(x - here[0], y - here[1])
    k = min(start + np.searchsorted(arcs[start:], wanted), len(path) - 1)
    while k > start and math.isnan(path[k, 0]):
        k -= 1
    best = (path[k, 0] - x) ** 2 + (path[k, 1] - y) ** 2
    for way in (-1, 1):
        while start <= k + way < len(path):
            d = (path[k + way, 0] - x) ** 2 + (path[k + way, 1] - y) ** 2
            if not d <= best:
                break
            k, best = k + way, d
    cos, sin = _direction(them.paths, m, k)
    dx, dy = x - path[k, 0], y - path[k, 1]
    return arcs[k] - mine + dx * cos + dy * sin, dy * cos - dx * sin, k


@_jit
def _measure(path: Floats, arcs: Floats) -> None:
    """Fill in the arcs [m] [T] of a driver's path [T, 4]."""
    arcs[0] = 0.0
    for k in range(1, len(path)):
        step = _norm(path[k, 0] - path[k - 1, 0], path[k, 1] - path[k - 1, 1])
        arcs[k] = arcs[k - 1] + (0.0 if math.isnan(step) else step)


@_inline
def _direction(paths: Floats, m: int, k: int) -> tuple[float, float]:
    """Return the direction (cosine, sine) of a path at a sample; the heading at a standstill."""
    before, after = max(k - 1, 0), min(k + 1, paths.shape[1] - 1)
    dx = paths[m, after, 0] - paths[m, before, 0]
    dy = paths[m, after, 1] - paths[m, before, 1]
    step = _norm(dx, dy)
    if step > MOVES:
        return dx / step, dy / step
    return math.cos(paths[m, k, 2]), math.sin(paths[m, k, 2])


@_jit
def _onward(path: Floats, at: float, room: float) -> float:
    """Return the step of a prediction that a driver reaches by driving on by `room` [m].

    Where the prediction waits, the driver waits as long.
    """
    last = len(path) - 1
    if path[min(int(at) + 1, last), 3] < STANDING:
        return min(at + 1.0, float(last))
    while room > 0.0 and at < last:
        k = int(at)
        if math.isnan(path[k + 1, 0]):
            return float(k + 1)
        if path[k + 1, 3] < STANDING:
            return at
        length = _norm(path[k + 1, 0] - path[k, 0], path[k + 1, 1] - path[k, 1])
        left = length * (k + 1 - at)
        if left > room:
            return at + room / length
        room -= left
        at = float(k + 1)
    return at


@_jit
def _put(path: Floats, at: float, speed: float, state: Floats) -> None:
    """Write the state of a driver that has reached a (fractional) step of its prediction."""
    k = int(at)
    after, share = min(k + 1, len(path) - 1), at - k
    if share <= 0.0 or math.isnan(path[after, 0]):
        after = k
    turned = path[after, 2] - path[k, 2]
    turned = math.atan2(math.sin(turned), math.cos(turned))
    state[0] = path[k, 0] + share * (path[after, 0] - path[k, 0])
    state[1] = path[k, 1] + share * (path[after, 1] - path[k, 1])
    state[2] = path[k, 2] + share * turned
    state[3] = speed
