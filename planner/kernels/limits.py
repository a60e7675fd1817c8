"""The limits of driving: braking, gaps and speeds, and the codes of lights and hold-ups."""

import math

from numba import njit

from planner.kernels.course import Floats

STEP = 0.2  # [s] of the common time base
COMFORT = 2.0  # [m/s2] braking for bends, waiting lines and stops
ACCELERATION = 2.3  # [m/s2] the greatest when speeding up
FOLLOWING = 3.0  # [m/s2] braking assumed of leaders and applied behind them
FIRM = 4.4  # [m/s2] the hardest braking for a waiting line
EMERGENCY = 7.0  # [m/s2] the hardest braking
JERK_UP, JERK_DOWN = 3.0, 12.0  # [m/s3] change of acceleration upwards and downwards
REACTION = 0.9  # [s] of Krauss' model
RELAXATION = 0.5  # [s] in which a wanted speed is approached
MIN_GAP = 2.0  # [m] to a standing leader
GAP_HORIZON = 40  # steps that a gap at a waiting line must stay clear
INTRUSION = 1.0  # [m] that a vehicle may stand inside another's stretch: boxes are generous
HINDERED = 0.5  # [m/s] below its free speed, from which on a vehicle counts as held up
STANDING_TIME = 3.0  # [s] that a vehicle stands at the end of a stop
ALIGNED = 0.9  # least cosine of the angle to the path of a vehicle that drives along it
CUT_IN_MEMORY = 15  # steps after entering the path during which a leader counts as cutting in
READY = 4.0  # [m/s] at a waiting line while somebody with priority stands there
JAM = 2.0  # [m/s] below which a vehicle beyond a junction is assumed to block its exit
FORESIGHT = 10  # steps ahead in which to look for vehicles that move in
CRAWL = 0.5  # [m/s] up to which a leader blocks the way rather than leads
LEAST = 0.2  # [m] the smallest gap in calculations
BEFORE = 1.0  # [m] before a vehicle that crosses, at which to stop
BEYOND = 0.5  # [m] past the stopping place of a light, up to which the light still counts
AT_LINE = 1.0  # [m] before a line within which a full stop counts
STANDING = 0.1  # [m/s] below which a vehicle stands
# What a light shows: go first; go by the rules; stop if that is comfortable; stop; stop, then go.
FIRST, OPEN, AMBER, SHUT, HALT = -1, 0, 1, 2, 3
# How a vehicle is held up, by index.
LEADER, RIGHT_OF_WAY, CUT_IN, BLOCKED, NEWCOMER = 0, 1, 2, 3, 4

_jit = njit(cache=True, error_model="numpy")


@_jit
def safe_speed(gap: float, leader: float, braking: float) -> float:
    """Return Krauss' safe speed [m/s] at a gap [m] behind a leader that drives at a speed [m/s]."""
    reach = braking * REACTION
    squared = reach * reach + leader * leader + 2.0 * braking * max(gap, 0.0)
    return max(0.0, -reach + math.sqrt(squared))


@_jit
def towards(speed: float, acceleration: float, wanted: float, hardest: float, dt: float) -> float:
    """Return the acceleration [m/s2] towards a wanted speed [m/s], within all limits."""
    wished = min(max((wanted - speed) / RELAXATION, -hardest), ACCELERATION)
    if wished < acceleration:
        return max(wished, acceleration - JERK_DOWN * dt)
    return min(wished, max(acceleration + JERK_UP * dt, min(0.0, acceleration + JERK_DOWN * dt)))


@_jit
def cap(caps: Floats, arc: float) -> float:
    """Return the highest speed [m/s] at an arc [m]; caps are given for every metre."""
    return float(caps[min(int(arc), len(caps) - 1)])
