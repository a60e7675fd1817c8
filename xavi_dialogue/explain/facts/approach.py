"""Closest approach of two vehicles, and the gap between them along their lane."""

import math
from dataclasses import dataclass

import numpy as np

from sim.scene import EGO
from xavi_dialogue.explain.facts.bearings import Offset
from xavi_dialogue.explain.facts.bodies import at_least, distance
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.thresholds import ALONG, SAME_LANE, SAME_WAY

BETWEEN = (-0.15, -0.1, -0.05, 0.05, 0.1, 0.15)  # [s] offsets to try around the closest sample
IN_LINE = 2.5  # [m] maximum distance sideways from a path of a vehicle that is on it
BEND = 60.0  # [m] ahead from which a winding road may explain an offset sideways
STRAIGHT = math.radians(20.0)  # [rad] maximum difference of headings for a gap measured straight


@dataclass(frozen=True, slots=True)
class Closest:
    """The moment at which two bodies were closest."""

    time: float  # [s]
    distance: float  # [m]


def closest(states: States, one: int, other: int, begin: float, end: float) -> Closest | None:
    """Return the closest approach of two bodies in an interval [s]; None if they never met."""
    key = ("closest", one, other, begin, end)
    return states.memo(key, lambda: _closest(states, one, other, begin, end))


def _closest(states: States, one: int, other: int, begin: float, end: float) -> Closest | None:
    pair = states.pair(one, other)
    if pair is None:
        return None
    inside = [float(t) for t in pair.time if begin - 1e-6 <= t <= end + 1e-6]
    inside = [t for t in inside if states.visible(other, t) or other == EGO]
    edges = [t for t in (begin, end) if states.visible(other, t) or other == EGO]
    bounds = []
    for t in (*inside, *edges):
        a, b = states.state(one, t), states.state(other, t)
        if a is not None and b is not None:
            bounds.append((at_least(a, b), t))
    best: Closest | None = None
    for bound, t in sorted(bounds):
        if best is not None and bound >= best.distance:
            break
        best = _nearer(states, one, other, t, best)
    if best is not None:
        middle = best.time
        for step in BETWEEN:
            if begin <= middle + step <= end:
                best = _nearer(states, one, other, middle + step, best)
    return best


def _nearer(
    states: States, one: int, other: int, time: float, best: Closest | None
) -> Closest | None:
    a, b = states.state(one, time), states.state(other, time)
    if a is None or b is None:
        return best
    found = distance(a, b)
    return Closest(time, found) if best is None or found < best.distance else best


@dataclass(frozen=True, slots=True)
class Following:
    """One vehicle behind another on one line."""

    behind: int
    ahead: int
    gap: float  # [m] bumper to bumper along the way


def following(states: States, one: int, other: int, time: float) -> Following | None:
    """Return which of two vehicles is behind the other on one line at a time [s], and the gap.

    The way is the path that the one ahead has driven, if it passed the other's place; else it is
    straight on.
    """
    seen = states.offset(one, other, time)
    if seen is None:
        return None
    behind, ahead = (one, other) if seen.ahead > 0.0 else (other, one)
    if _lanes_differ(states, one, other, time) or _abreast(seen):
        return None
    along = _along_path(states, behind, ahead, time)
    if along is not None:
        return Following(behind, ahead, along)
    view = states.offset(behind, ahead, time)
    if view is None or abs(view.turn) > min(STRAIGHT, SAME_WAY) or abs(view.left) > SAME_LANE:
        return None
    return Following(behind, ahead, max(view.ahead - view.clear, 0.0))


def _lanes_differ(states: States, one: int, other: int, time: float) -> bool:
    """Check whether both are on one road, and known to be in different lanes of it."""
    a, b = states.place(one, time), states.place(other, time)
    if a is None or b is None or a.lane is None or b.lane is None:
        return False
    return a.edge == b.edge and a.lane != b.lane


def _abreast(seen: Offset) -> bool:
    """Check whether both head the same way on different lines, and not far ahead."""
    return abs(seen.turn) < ALONG and abs(seen.left) > SAME_LANE and seen.ahead < BEND


def _along_path(states: States, behind: int, ahead: int, time: float) -> float | None:
    """Return the gap along the way that the one ahead has driven past the one behind it."""
    state, leader = states.state(behind, time), states.state(ahead, time)
    motion = states.motion(ahead)
    last = motion.index(time)
    if state is None or leader is None or last is None or last < 2:
        return None
    _, x, y, heading, _ = motion.arrays
    arc = np.array(motion.arc)
    apart = np.hypot(x[: last + 1] - state.position[0], y[: last + 1] - state.position[1])
    k = int(np.argmin(apart))
    step = max(arc[min(k + 1, last)] - arc[max(k - 1, 0)], 0.0)
    turn = math.remainder(heading[k] - state.heading, math.tau)
    if apart[k] > IN_LINE + step or abs(turn) > SAME_WAY / 2.0 or k == last:
        return None
    dx, dy = state.position[0] - x[k], state.position[1] - y[k]
    aside = abs(dy * math.cos(heading[k]) - dx * math.sin(heading[k]))
    if aside > SAME_LANE:
        return None
    along = dx * math.cos(heading[k]) + dy * math.sin(heading[k])
    rest = math.dist(leader.position, motion.position[last])
    gap = float(arc[last] - arc[k]) + rest - float(along) - leader.length
    return max(gap, 0.0)
