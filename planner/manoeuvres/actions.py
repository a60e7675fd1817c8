"""Macro actions on a lane graph.

`expand` turns a macro action into a plan that can be driven from a situation, or says in words
why it does not apply there.
"""

import math

import numpy as np

from planner.kernels.limits import COMFORT, STANDING_TIME
from planner.manoeuvres.following import follow_on, stop
from planner.manoeuvres.layout import (
    CLEAR,
    FAR,
    Layout,
    finish,
    lookahead,
    waits_after,
    waits_along,
)
from planner.manoeuvres.plans import (
    ActionPlan,
    GiveWay,
    LaneChange,
    LaneFollow,
    LetCross,
    Manoeuvre,
    Situation,
    Stop,
    Turn,
)
from planner.record.trace import Action, EgoGoal
from planner.roads.roundabouts import Roundabout, roundabout_ahead
from planner.roads.routes import (
    Refusal,
    approaches,
    lane_end,
    link_ahead,
    onward,
    remaining,
    rest_of,
)
from planner.roads.trajectory import KEPT, LATERAL_ACCELERATION, Roads
from sim.roads.network import Direction, Lane, Link

__all__ = [
    "CLEAR",
    "COMFORT",
    "LANE_CHANGE_LENGTH",
    "LANE_CHANGE_TIME",
    "STANDING_TIME",
    "ActionPlan",
    "GiveWay",
    "LaneChange",
    "LaneFollow",
    "Manoeuvre",
    "Situation",
    "Stop",
    "Turn",
    "exit_by",
    "expand",
]

LANE_CHANGE_TIME = 3.0  # [s]
LANE_CHANGE_LENGTH = (15.0, 200.0)  # [m] shortest and longest
SWAY = 10.0 / math.sqrt(3.0)  # peak sideways acceleration of a quintic, times time^2 / width
TAPER = 10.0  # [m] beyond the end of a lane that merges where one can move to one that leads on
BEFORE_EXIT = 10.0  # [m] before an exit of a roundabout at which to choose whether to take it
DIRECTIONS: dict[Action, Direction] = {
    "exit-left": "left",
    "exit-right": "right",
    "exit-straight": "straight",
}
SIDES: dict[Action, Direction] = {"change-left": "left", "change-right": "right"}


def expand(
    roads: Roads, here: Situation, action: Action, goal: EgoGoal | None, view: float
) -> ActionPlan | Refusal:
    """Return the plan for a macro action, or why it does not apply.

    Args:
        roads: the road network.
        here: where the vehicle is.
        action: the macro action.
        goal: where the vehicle wants to get; an action that comes past it ends there, and of
            several links in one direction the one that leads there is taken.
        view: [m] how far ahead a junction is seen.
    """
    key = (here.position, here.heading, here.speed, here.location, action, goal, view)
    found: ActionPlan | Refusal | None = roads.plans.get(key)
    if found is None:
        if len(roads.plans) >= KEPT:
            roads.plans.clear()
        found = roads.plans[key] = _expanded(roads, here, action, goal, view)
    return found


def _expanded(
    roads: Roads, here: Situation, action: Action, goal: EgoGoal | None, view: float
) -> ActionPlan | Refusal:
    if action in SIDES:
        return _change(roads, here, action, goal)
    if action in DIRECTIONS:
        return _exit(roads, here, action, goal, view)
    if action == "continue-next-exit":
        return _next_exit(roads, here, goal, view)
    return follow_on(roads, here, goal, view) if action == "continue" else stop(roads, here, goal)


def _change(
    roads: Roads, here: Situation, action: Action, goal: EgoGoal | None
) -> ActionPlan | Refusal:
    network, lane, side = roads.network, here.location.lane, SIDES[action]
    if network.lanes[lane].internal:
        return Refusal("lanes are not changed inside a junction")
    target = network.left_of(lane) if side == "left" else network.right_of(lane)
    if target is None:
        return Refusal(f"there is no lane to the {side}")
    length = _change_length(roads, here, target)
    if _room(roads, lane, target.id, length + 5.0) - here.location.offset < length + 5.0:
        return Refusal("the lane ends too soon to change")
    reach = length + lookahead(roads, here)
    row = onward(roads, (target.id,), reach + here.location.offset, goal)
    path = roads.path(row, here.position, here.heading, length, reach, length)
    waits = waits_along(roads, path, row)
    if any(isinstance(m, LetCross) and m.stop < length for m in waits):
        return Refusal("a crossing for pedestrians comes first, where nobody overtakes")
    manoeuvres = (LaneChange(0.0, length, side), *waits)
    return finish(roads, action, path, manoeuvres, length, 0.0, goal)


def _change_length(roads: Roads, here: Situation, target: Lane) -> float:
    """Return the length [m] of a lane change: longer where a bend uses much lateral grip."""
    shortest, longest = LANE_CHANGE_LENGTH
    line, offset = roads.line((target.id,)), here.location.offset
    near = (line.arc >= offset) & (line.arc <= offset + here.speed * LANE_CHANGE_TIME)
    bend = float(np.max(np.abs(line.curvature[near]), initial=0.0)) * here.speed**2
    left = max(LATERAL_ACCELERATION - bend, 0.2 * LATERAL_ACCELERATION)
    width = 0.5 * (roads.network.lanes[here.location.lane].width + target.width)
    time = max(LANE_CHANGE_TIME, math.sqrt(SWAY * width / left))
    return min(max(here.speed * time, shortest), longest)


def _room(roads: Roads, lane: str, target: str, wanted: float) -> float:
    """Length [m] over which two lanes run side by side, from the start of the first on."""
    network, room = roads.network, 0.0
    while True:
        own, other = lane_end(roads, lane), lane_end(roads, target)
        room += min(network.lanes[lane].length, network.lanes[target].length)
        if room >= wanted + FAR:
            return room
        if own.joint is None or other.joint is None:
            return room + (TAPER if own.merges and other.leads else 0.0)
        lane, target = own.joint.to_lane, other.joint.to_lane
        if lane == target or network.lanes[lane].edge != network.lanes[target].edge:
            return room


def _exit(
    roads: Roads, here: Situation, action: Action, goal: EgoGoal | None, view: float
) -> ActionPlan | Refusal:
    direction = DIRECTIONS[action]
    ring = roundabout_ahead(roads, here.location, view)
    if isinstance(ring, Roundabout):
        beside = ring.entry and _beside(roads, ring.entry, direction)
        if not beside:
            return _leave(roads, here, action, ring, goal)
    link = link_ahead(roads, here.location, direction, view, goal)
    if isinstance(link, Refusal):
        return link
    if action == "exit-straight" and not link.yields_to:
        return Refusal("going straight on needs no giving way here")
    return exit_by(roads, here, action, link, goal)


def _beside(roads: Roads, entry: Link, direction: Direction) -> bool:
    """Check whether a road leads past a roundabout in a direction."""
    network = roads.network
    return any(
        lead.direction == direction
        and network.roundabout(network.lanes[lead.link.to_lane].edge) is None
        for lead in lane_end(roads, entry.from_lane).leads
    )


def exit_by(
    roads: Roads, here: Situation, action: Action, link: Link, goal: EgoGoal | None
) -> ActionPlan:
    """Return the plan to follow the lane, give way, and turn along a link ahead or driven on."""
    lane = here.location.lane
    if lane in link.via:
        lanes = (lane, *rest_of(roads.network, lane))
    else:
        ways = (way.lanes for way in approaches(roads, here.location, FAR))
        ahead = next((row for row in ways if link.from_lane in row), (lane,))
        before = ahead[: ahead.index(link.from_lane) + 1] if link.from_lane in ahead else (lane,)
        lanes = (*before, *link.via, link.to_lane)
    return _through(roads, here, action, lanes, link, goal)


def _through(
    roads: Roads,
    here: Situation,
    action: Action,
    lanes: tuple[str, ...],
    last: Link,
    goal: EgoGoal | None,
) -> ActionPlan:
    """Drive along connected lanes, the last of which lies beyond the link to turn by."""
    way = Layout.of(roads, here, lanes, goal)
    out = next(x.out for x in reversed(way.crossings) if x.link == last)
    commit = next(x.enter for x in way.crossings if x.turns or x.link == last)
    end = out + min(CLEAR, 0.5 * roads.network.lanes[last.to_lane].length)
    manoeuvres = (*way.manoeuvres(), *waits_after(roads, way, end))
    return finish(roads, action, way.path, manoeuvres, end, commit, goal)


def _leave(
    roads: Roads, here: Situation, action: Action, ring: Roundabout, goal: EgoGoal | None
) -> ActionPlan | Refusal:
    """Leave a roundabout by its next exit."""
    if DIRECTIONS[action] != ring.side:
        return Refusal(f"a roundabout is left to the {ring.side}")
    if not ring.exits:
        return Refusal("the roundabout has no exit")
    near = ring.exits[0]
    own = [link for link in near.out if link.from_lane == near.lanes[-1]]
    if not own:
        return Refusal("its lane does not lead out of the roundabout")
    edges = roads.network.lanes
    out = min(own, key=lambda link: remaining(roads, edges[link.to_lane].edge, goal))
    return _through(roads, here, action, (*near.lanes, *out.via, out.to_lane), out, goal)


def _next_exit(
    roads: Roads, here: Situation, goal: EgoGoal | None, view: float
) -> ActionPlan | Refusal:
    """Go on past the next exit of a roundabout, to just before the one after it."""
    ring = roundabout_ahead(roads, here.location, view)
    if isinstance(ring, Refusal):
        return ring
    if len(ring.exits) < 2:
        return Refusal("the roundabout has no other exit")
    near, after = ring.exits[:2]
    if near.on is None:
        return Refusal("its lane does not lead on round the roundabout")
    way = Layout.of(roads, here, after.lanes, goal)
    passed = next(x.out for x in way.crossings if x.link == near.on)
    end = max(way.end - BEFORE_EXIT, 0.5 * (passed + way.end))
    commit = next((x.enter for x in way.crossings if x.link == ring.entry), math.inf)
    manoeuvres = (*way.manoeuvres(), LaneFollow(passed, end), *waits_after(roads, way, end))
    return finish(roads, "continue-next-exit", way.path, manoeuvres, end, commit, goal)
