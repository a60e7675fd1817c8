"""Macro actions, and the manoeuvres that they are made of, on a lane graph.

`expand` turns a macro action into a plan that can be driven from a situation, or says in words
why it does not apply there.
"""

import math
from dataclasses import dataclass

from planner.routes import Refusal, link_ahead, onward, straight_on
from planner.trace import Action, EgoGoal
from planner.trajectory import Path, Roads
from sim.network import Direction, Link, Location
from sim.scene import Point

LANE_CHANGE_TIME = 3.0  # [s]
LANE_CHANGE_LENGTH = (15.0, 50.0)  # [m] shortest and longest
STRAIGHTEN = 12.0  # [m] in which a vehicle off its centreline gets back to it
AHEAD = 80.0  # [m] of path beyond the end of an action, to see leaders and bends
FAR = 400.0  # [m] beyond which no action reaches
CLEAR = 5.0  # [m] beyond a junction at which crossing it is over
STANDING_TIME = 3.0  # [s] that Stop stays at a standstill
COMFORT = 2.0  # [m/s2] braking for bends, waiting lines and stops


@dataclass(frozen=True, slots=True)
class LaneFollow:
    """Drive along the lane."""

    start: float  # [m] arc
    end: float  # [m] arc


@dataclass(frozen=True, slots=True)
class LaneChange:
    """Move over to the neighbouring lane."""

    start: float  # [m] arc
    end: float  # [m] arc
    side: Direction


@dataclass(frozen=True, slots=True)
class GiveWay:
    """Wait at a line until those who go first on the link's foes leave a gap."""

    stop: float  # [m] arc of the waiting line, for the front bumper; negative once passed
    clear: float  # [m] arc at which the junction is left
    link: Link
    yields_to: frozenset[tuple[str, int]]  # (junction, link index) of those who go first


@dataclass(frozen=True, slots=True)
class Turn:
    """Cross a junction along a link."""

    start: float  # [m] arc
    end: float  # [m] arc
    direction: Direction


@dataclass(frozen=True, slots=True)
class Stop:
    """Brake to a standstill and stand for STANDING_TIME."""

    start: float  # [m] arc


Manoeuvre = LaneFollow | LaneChange | GiveWay | Turn | Stop


@dataclass(frozen=True, slots=True)
class Situation:
    """Where a vehicle is when it chooses an action."""

    time: float  # [s]
    position: Point  # [m]
    heading: float  # [rad]
    speed: float  # [m/s]
    acceleration: float  # [m/s2]
    location: Location


@dataclass(frozen=True, slots=True, eq=False)
class ActionPlan:
    """One macro action, ready to be driven."""

    action: Action
    path: Path
    manoeuvres: tuple[Manoeuvre, ...]
    end: float  # [m] arc at which the action is over
    commit: float  # [m] arc from which it can no longer be taken back
    goal: float | None  # [m] arc at which the goal is reached, if this action reaches it

    @property
    def give_ways(self) -> tuple[GiveWay, ...]:
        """The lines at which this action may have to wait."""
        return tuple(m for m in self.manoeuvres if isinstance(m, GiveWay))

    @property
    def stops(self) -> bool:
        """Whether the action ends at a standstill."""
        return self.action == "stop"

    @property
    def changes_lane(self) -> bool:
        """Whether the action moves to another lane of the same edge."""
        return any(isinstance(m, LaneChange) for m in self.manoeuvres)


DIRECTIONS: dict[Action, Direction] = {
    "exit-left": "left",
    "exit-right": "right",
    "exit-straight": "straight",
}
SIDES: dict[Action, Direction] = {"change-left": "left", "change-right": "right"}


def expand(
    roads: Roads, here: Situation, action: Action, goal: EgoGoal | None, view: float
) -> ActionPlan | Refusal:
    """The plan for a macro action, or why it does not apply.

    Args:
        roads: the road network.
        here: where the vehicle is.
        action: the macro action.
        goal: where the vehicle wants to get; an action that comes past it ends there.
        view: [m] how far ahead a junction is seen.
    """
    if action in SIDES:
        return _change(roads, here, action, goal)
    if action in DIRECTIONS:
        return _exit(roads, here, action, goal, view)
    if action == "continue":
        return _continue(roads, here, goal, view)
    if action == "stop":
        return _stop(roads, here)
    return Refusal("there is no roundabout ahead")


def _change(
    roads: Roads, here: Situation, action: Action, goal: EgoGoal | None
) -> ActionPlan | Refusal:
    network, lane, side = roads.network, here.location.lane, SIDES[action]
    if network.lanes[lane].internal:
        return Refusal("lanes are not changed inside a junction")
    target = network.left_of(lane) if side == "left" else network.right_of(lane)
    if target is None:
        return Refusal(f"there is no lane to the {side}")
    shortest, longest = LANE_CHANGE_LENGTH
    length = min(max(here.speed * LANE_CHANGE_TIME, shortest), longest)
    if network.lanes[lane].length - here.location.offset < length + 5.0:
        return Refusal("the lane ends too soon to change")
    path = roads.path(
        onward(roads, (target.id,), length + AHEAD),
        here.position,
        here.heading,
        length,
        length + AHEAD,
    )
    manoeuvres = (LaneChange(0.0, length, side),)
    return _finish(
        roads,
        "change-left" if side == "left" else "change-right",
        path,
        manoeuvres,
        length,
        0.0,
        goal,
    )


def _exit(
    roads: Roads, here: Situation, action: Action, goal: EgoGoal | None, view: float
) -> ActionPlan | Refusal:
    link = link_ahead(roads, here.location, DIRECTIONS[action], view)
    if isinstance(link, Refusal):
        return link
    if action == "exit-straight" and not link.yields_to:
        return Refusal("going straight on needs no giving way here")
    return exit_by(roads, here, action, link, goal)


def exit_by(
    roads: Roads, here: Situation, action: Action, link: Link, goal: EgoGoal | None
) -> ActionPlan:
    """Lane-follow, give way, and turn along a link ahead, or along the one being driven."""
    lane = here.location.lane
    inside = link.via.index(lane) if lane in link.via else -1
    lanes = (*(() if inside >= 0 else (lane,)), *link.via[max(inside, 0) :], link.to_lane)
    ahead = sum(roads.network.lanes[name].length for name in lanes[:-1])
    path = _along(roads, here, lanes, ahead - here.location.offset + AHEAD)
    begins = dict(path.lanes)
    out = begins[link.to_lane]
    enter = 0.0 if inside >= 0 else begins[lanes[1]]
    manoeuvres: list[Manoeuvre] = [] if inside >= 0 else [LaneFollow(0.0, enter)]
    manoeuvres += _give_way(link, inside, begins, enter)
    manoeuvres.append(Turn(enter, out, link.direction))
    return _finish(roads, action, path, tuple(manoeuvres), out + CLEAR, enter, goal)


def _continue(
    roads: Roads, here: Situation, goal: EgoGoal | None, view: float
) -> ActionPlan | Refusal:
    network = roads.network
    lanes = [here.location.lane]
    link = network.link_via(lanes[0])
    if link is not None:
        if link.direction != "straight":
            return Refusal("it is turning at the junction")
        lanes += [*link.via[link.via.index(lanes[0]) + 1 :], link.to_lane]
    seen = sum(network.lanes[name].length for name in lanes) - here.location.offset
    blocked: str | None = None
    while seen < FAR and not (goal and network.lanes[lanes[-1]].edge == goal.edge):
        onwards = straight_on(roads, lanes[-1])
        if isinstance(onwards, Refusal):
            blocked = onwards.reason if network.links_from(lanes[-1]) else None
            break
        lanes += [*onwards.via, onwards.to_lane]
        seen += sum(network.lanes[name].length for name in lanes[-1 - len(onwards.via) :])
    if blocked and seen < view:
        return Refusal(blocked)
    end = min(seen - view / 2.0, FAR) if blocked else min(seen, FAR)
    path = _along(roads, here, tuple(lanes), end + AHEAD)
    return _finish(roads, "continue", path, (LaneFollow(0.0, end),), end, math.inf, goal)


def _stop(roads: Roads, here: Situation) -> ActionPlan | Refusal:
    if roads.network.lanes[here.location.lane].internal:
        return Refusal("it must not stop inside a junction")
    path = _along(roads, here, (here.location.lane,), AHEAD)
    rest = here.speed**2 / (2.0 * COMFORT) + here.speed * 0.5
    if roads.network.lanes[path.lane_at(rest)[0]].internal:
        return Refusal("it would come to a stop inside the junction")
    return _finish(roads, "stop", path, (Stop(0.0),), path.length, math.inf, None)


def _finish(
    roads: Roads,
    action: Action,
    path: Path,
    manoeuvres: tuple[Manoeuvre, ...],
    end: float,
    commit: float,
    goal: EgoGoal | None,
) -> ActionPlan:
    reached = None if goal is None else _goal_arc(roads, path, goal, end)
    return ActionPlan(
        action, path, manoeuvres, end if reached is None else reached, commit, reached
    )


def _goal_arc(roads: Roads, path: Path, goal: EgoGoal, end: float) -> float | None:
    for name, start in path.lanes:
        lane = roads.network.lanes[name]
        wanted = lane.edge == goal.edge and goal.lane in (None, lane.index)
        if wanted and 0.0 <= start + goal.position <= end:
            return start + goal.position
    return None


def _give_way(link: Link, inside: int, begins: dict[str, float], enter: float) -> list[Manoeuvre]:
    waits = link.via[1] if link.waits_inside and len(link.via) > 1 else None
    if not link.yields_to or (inside >= 0 and waits not in begins):
        return []
    line = enter if waits is None else begins[waits]
    foes = frozenset((link.junction, index) for index in link.yields_to)
    return [GiveWay(line - 0.5, begins[link.to_lane], link, foes)]


def _along(roads: Roads, here: Situation, lanes: tuple[str, ...], reach: float) -> Path:
    row = onward(roads, lanes, reach + here.location.offset)
    return roads.path(row, here.position, here.heading, STRAIGHTEN, reach)
