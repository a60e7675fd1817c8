"""The macro actions Continue and Stop: following the road."""

import math

from planner.kernels.limits import COMFORT, EMERGENCY, FOLLOWING
from planner.manoeuvres.layout import (
    BEFORE_LINE,
    CLEAR,
    FAR,
    INSIDE,
    STRAIGHTEN,
    Layout,
    Wait,
    finish,
    lookahead,
    waits_after,
    waits_along,
)
from planner.manoeuvres.plans import ActionPlan, GiveWay, LaneFollow, LetCross, Situation, Stop
from planner.record.trace import EgoGoal
from planner.roads.routes import (
    Refusal,
    direction_of,
    lane_end,
    onward,
    remaining,
    rest_of,
    straight_on,
)
from planner.roads.trajectory import Roads
from sim.roads.network import Link

MERGING_TIME = 4.0  # [s] at the speed limit before the end of a lane, in which to move over
MERGING = 35.0  # [m] before the end of a lane at which to look for a gap beside it
SETTLING = 0.5  # [s] in which braking sets in and eases off
MARGIN = 5.0  # [m] of path beyond where a vehicle comes to rest


def follow_on(
    roads: Roads, here: Situation, goal: EgoGoal | None, view: float
) -> ActionPlan | Refusal:
    """Go straight on: up to the goal, or else past the next junction to the next decision.

    A decision is due before a junction where one has to give way, or cannot go straight on, or
    where the way to the goal turns off; before a lane ends; and where another lane opens that
    leads to the goal, as at an exit of a motorway.
    """
    network, lane = roads.network, here.location.lane
    refused = _refused_inside(roads, lane)
    if refused is not None:
        return refused
    lanes = [lane, *rest_of(network, lane)]
    seen = sum(network.lanes[name].length for name in lanes) - here.location.offset
    begun: float | None = None  # [m] from here at which the road beyond a junction begins
    if _crossing(roads, lane):
        begun = max(seen - network.lanes[lanes[-1]].length, 0.0)
    opened: float | None = None  # [m] from here at which another lane opens
    halt: Refusal | None = None
    while not (goal and network.lanes[lanes[-1]].edge == goal.edge):
        if seen - _room_to_choose(roads, lanes[-1], goal, view) >= FAR:
            break
        link = straight_on(roads, lanes[-1], goal)
        if isinstance(link, Refusal):
            halt = link if _leads_on(roads, lanes[-1]) else None
            break
        joint = lane_end(roads, lanes[-1]).joint == link
        if not joint and _off(roads, link, goal):
            begun = opened if begun is None else begun
            if begun is not None or seen >= view:
                halt = Refusal("")
                break
        lanes += [*link.via, link.to_lane]
        seen += sum(network.lanes[name].length for name in lanes[-1 - len(link.via) :])
        beyond = seen - network.lanes[link.to_lane].length
        begun = begun if joint else beyond
        opened = beyond if joint and _widens(roads, link) else opened
    end = min(seen, FAR)
    room = _room_to_choose(roads, lanes[-1], goal, view)
    if halt is not None and begun is not None:
        end = max(seen - room, min(begun + CLEAR, 0.5 * (begun + seen)))
    elif halt is not None and seen >= max(view, room + MARGIN):
        end = seen - room
    elif halt is not None:
        end = seen - MERGING
        if end < MARGIN or not lane_end(roads, lanes[-1]).merges:
            return halt
    way = Layout.of(roads, here, tuple(lanes), goal)
    end = max(min(end, FAR, way.path.length), 0.1)
    waits = (m for m in way.manoeuvres() if isinstance(m, Wait))
    manoeuvres = (LaneFollow(0.0, end), *waits, *waits_after(roads, way, end))
    return finish(roads, "continue", way.path, manoeuvres, end, math.inf, goal)


def _room_to_choose(roads: Roads, lane: str, goal: EgoGoal | None, view: float) -> float:
    """Return how far [m] before the end of a lane the next action is to be chosen.

    Where the lane merges, or another lane leads to the goal, there must be room to change.
    """
    end = lane_end(roads, lane)
    off = [_off(roads, lead.link, goal) for lead in end.leads]
    changes = end.merges or (bool(off) and all(off))
    change = MERGING_TIME * roads.network.lanes[lane].speed_limit if changes else 0.0
    return max(view / 2.0, change)


def stop(roads: Roads, here: Situation, goal: EgoGoal | None) -> ActionPlan | Refusal:
    """Brake to a standstill on the road ahead; the front may stick out over a waiting line."""
    network, lane = roads.network, here.location.lane
    if network.lanes[lane].internal:
        return Refusal("it must not stop inside a junction")
    rest = _rest(here.speed, COMFORT)
    reach = rest + lookahead(roads, here)
    row = onward(roads, (lane,), reach + here.location.offset, goal)
    path = roads.path(row, here.position, here.heading, STRAIGHTEN, reach, rest + MARGIN)
    lines = [m.stop for m in waits_along(roads, path, row) if isinstance(m, GiveWay | LetCross)]
    for braking in (COMFORT, FOLLOWING, EMERGENCY):
        end = _rest(here.speed, braking)
        before = path.lane_at(end - INSIDE + BEFORE_LINE)[0]
        if end <= min(lines, default=end) + INSIDE and not network.lanes[before].internal:
            halt = Stop(0.0, braking)
            return finish(roads, "stop", path, (halt,), path.length, math.inf, goal)
    return Refusal("it would come to a stop inside the junction")


def _rest(speed: float, braking: float) -> float:
    """Return where [m] from here a vehicle that brakes comes to rest."""
    return speed**2 / (2.0 * braking) + speed * SETTLING


def _refused_inside(roads: Roads, lane: str) -> Refusal | None:
    """Return why a vehicle cannot simply go on from inside a junction; None if it can."""
    link = _crossing(roads, lane)
    if link is None:
        return None
    if roads.network.roundabout(roads.network.lanes[link.to_lane].edge) is not None:
        return Refusal("it is in a roundabout")
    if direction_of(roads, link) != "straight":
        return Refusal("it is turning at the junction")
    return None


def _crossing(roads: Roads, lane: str) -> Link | None:
    """Return the link on which a vehicle is crossing a junction; None elsewhere."""
    link = roads.network.link_via(lane)
    return None if link is None or lane_end(roads, link.from_lane).joint == link else link


def _widens(roads: Roads, link: Link) -> bool:
    """Check whether the road has more lanes beyond a link than before it."""
    network = roads.network
    before, beyond = (network.lanes[name].edge for name in (link.from_lane, link.to_lane))
    return len(network.edge_lanes(beyond)) > len(network.edge_lanes(before))


def _leads_on(roads: Roads, lane: str) -> bool:
    """Check whether the road goes on from a lane, or from those beside it."""
    end = lane_end(roads, lane)
    return bool(end.leads) or end.merges


def _off(roads: Roads, link: Link, goal: EgoGoal | None) -> bool:
    """Check whether another way than over a link is shorter to the goal, or no way leads there."""
    if goal is None:
        return False
    network = roads.network
    edges = {
        network.lanes[way.to_lane].edge
        for lane in network.edge_lanes(network.lanes[link.from_lane].edge)
        for way in network.links_from(lane.id)
    }
    best = min(remaining(roads, edge, goal) for edge in sorted(edges))
    ours = remaining(roads, network.lanes[link.to_lane].edge, goal)
    return math.isinf(best) or ours > best
