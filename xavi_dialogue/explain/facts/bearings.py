"""Where the other vehicles are, seen from our car or from another one."""

import math
from dataclasses import dataclass

from planner.record.places import RoadPlace
from sim.roads.network import angle_between
from sim.scene import VehicleState
from xavi_dialogue.domain.vocabulary import Bearing
from xavi_dialogue.explain.history.thresholds import OPPOSITE, SAME_LANE, SAME_WAY

CORRIDOR = 8.0  # [m] maximum offset sideways of an oncoming vehicle on our road
LINE = 4.0  # [m] maximum offset sideways of a vehicle straight ahead or behind
AHEAD, ABREAST = 15.0, 65.0  # [deg] angles up to which it is ahead, and not abreast


@dataclass(frozen=True, slots=True)
class Offset:
    """The centre of a vehicle in the frame of another one."""

    ahead: float  # [m] negative: behind
    left: float  # [m] negative: to the right
    turn: float  # [rad] its heading relative to the other's, in (-pi, pi]
    clear: float  # [m] half the lengths of both: nearer than this they are side by side

    @property
    def distance(self) -> float:
        """The distance between the centres [m]."""
        return math.hypot(self.ahead, self.left)

    @property
    def same_way(self) -> bool:
        """Whether both head the same way."""
        return abs(self.turn) <= SAME_WAY

    @property
    def opposite(self) -> bool:
        """Whether they head in opposite directions."""
        return abs(self.turn) >= OPPOSITE


def offset(eye: VehicleState, other: VehicleState) -> Offset:
    """Return where `other` is, seen from `eye`."""
    (ex, ey), (ox, oy) = centre(eye), centre(other)
    cos, sin = math.cos(eye.heading), math.sin(eye.heading)
    dx, dy = ox - ex, oy - ey
    return Offset(
        ahead=dx * cos + dy * sin,
        left=dy * cos - dx * sin,
        turn=angle_between(other.heading, eye.heading),
        clear=(eye.length + other.length) / 2.0,
    )


def bearing(
    seen: Offset, mine: RoadPlace | None = None, theirs: RoadPlace | None = None
) -> Bearing:
    """Return the word for where a vehicle is.

    Args:
        seen: where it is in our frame.
        mine: our place on the road, if that is known.
        theirs: the place of the other vehicle.
    """
    if seen.opposite:
        return "oncoming" if oncoming(seen) else aside(seen)
    if not seen.same_way:
        return _across(seen)
    side = lane_side(seen, mine, theirs)
    if side == 0:
        return "ahead" if seen.ahead > 0.0 else "behind"
    if abs(seen.ahead) <= seen.clear:
        return "beside-left" if side > 0 else "beside-right"
    if seen.ahead > 0.0:
        return "ahead-left" if side > 0 else "ahead-right"
    return "behind-left" if side > 0 else "behind-right"


def _across(seen: Offset) -> Bearing:
    """Return the word for a vehicle that heads across our way: where it comes from, or where it is.

    It comes from a side as long as it heads for our line; once it has crossed the line, the word
    is for where it is.
    """
    nears = seen.left * math.sin(seen.turn) < 0.0
    if not nears or seen.ahead < -seen.clear:
        return aside(seen)
    return "crossing-left" if seen.left > 0.0 else "crossing-right"


def oncoming(seen: Offset) -> bool:
    """Check whether a vehicle comes towards us, on our road or one that leads into it."""
    return seen.opposite and seen.ahead > 0.0 and abs(seen.left) <= max(CORRIDOR, seen.ahead / 2.0)


def aside(seen: Offset) -> Bearing:
    """Return the direction in which a vehicle is, whichever way it heads."""
    angle = math.degrees(math.atan2(seen.left, seen.ahead))
    straight = abs(seen.left) <= LINE
    if abs(angle) <= AHEAD and straight:
        return "ahead"
    if abs(angle) >= 180.0 - AHEAD and straight:
        return "behind"
    if abs(angle) < ABREAST:
        return "ahead-left" if angle > 0.0 else "ahead-right"
    if abs(angle) > 180.0 - ABREAST:
        return "behind-left" if angle > 0.0 else "behind-right"
    return "left" if angle > 0.0 else "right"


def lane_side(seen: Offset, mine: RoadPlace | None, theirs: RoadPlace | None) -> int:
    """Return which lane a vehicle that heads our way is in: 0 ours, 1 left of it, -1 right of it.

    The recorded lanes count if both are on one road and far enough apart; else the offset does.
    """
    aside = 0 if abs(seen.left) <= SAME_LANE else 1 if seen.left > 0.0 else -1
    if mine is None or theirs is None or mine.edge != theirs.edge:
        return aside
    if mine.lane is None or theirs.lane is None or abs(seen.ahead) <= 2.0 * seen.clear:
        return aside
    return (theirs.lane > mine.lane) - (theirs.lane < mine.lane)


def centre(state: VehicleState) -> tuple[float, float]:
    """Return the middle of a vehicle [m]."""
    (x, y), half = state.position, state.length / 2.0
    return x - half * math.cos(state.heading), y - half * math.sin(state.heading)
