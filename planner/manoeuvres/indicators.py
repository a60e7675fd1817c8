"""The lights that the car shows: its indicators before turns and lane changes, its brake light.

On a roundabout, as people do where it is the rule, it indicates when it leaves, and not before
it has passed the exit before.
"""

from collections.abc import Sequence

from planner.manoeuvres.plans import ActionPlan, LaneChange, Turn
from planner.record.trace import Action
from planner.roads.trajectory import Roads
from sim.roads.network import Direction

AHEAD = 30.0  # [m] before a turn from which it is indicated at the latest
EARLY = 3.0  # [s] before it
BRAKING = 0.5  # [m/s2] of deceleration beyond which the brake light is lit
STANDING = 0.1  # [m/s] below which the brake is held
SIDES: dict[Action, Direction] = {"change-left": "left", "change-right": "right"}


def lights(
    roads: Roads,
    plan: ActionPlan,
    arc: float,
    speed: float,
    acceleration: float,
    later: Sequence[Action] = (),
) -> tuple[str, ...]:
    """Return the lights to show, of left, right, brake.

    Args:
        roads: the road network.
        plan: that is driven.
        arc: [m] where on it the front is.
        speed: [m/s]
        acceleration: [m/s2]
        later: what is meant to be done after the plan, in order.
    """
    side = _side(roads, plan, arc, speed) or _next_side(roads, plan, arc, speed, later)
    braking = acceleration < -BRAKING or speed < STANDING
    return (*((side,) if side in ("left", "right") else ()), *(("brake",) if braking else ()))


def _side(roads: Roads, plan: ActionPlan, arc: float, speed: float) -> Direction | None:
    """To which side the plan leads now or soon."""
    lead = max(AHEAD, EARLY * speed)
    for manoeuvre in plan.manoeuvres:
        if isinstance(manoeuvre, LaneChange) and arc < manoeuvre.end:
            return manoeuvre.side
        if isinstance(manoeuvre, Turn) and arc < manoeuvre.end:
            passed = _beyond_exits(roads, plan, manoeuvre.start)
            first = max(manoeuvre.start - lead, passed)
            if _onto_ring(roads, plan, manoeuvre):
                continue
            return manoeuvre.direction if arc >= first else None
    return None


def _next_side(
    roads: Roads, plan: ActionPlan, arc: float, speed: float, later: Sequence[Action]
) -> Direction | None:
    """To which side the action after the plan leads, where that comes soon."""
    if not later or plan.end - arc > EARLY * speed:
        return None
    if later[0] in SIDES:
        return SIDES[later[0]]
    leaves = plan.action == "continue-next-exit" and later[0] in ("exit-left", "exit-right")
    if leaves and arc >= _beyond_exits(roads, plan, plan.end):
        return "left" if later[0] == "exit-left" else "right"
    return None


def _onto_ring(roads: Roads, plan: ActionPlan, turn: Turn) -> bool:
    """Check whether a turn leads onto a roundabout, which nobody indicates."""
    ring = roads.network.roundabout
    lanes = roads.network.lanes
    before = lanes[plan.path.lane_at(turn.start - 1e-3)[0]]
    after = lanes[plan.path.lane_at(turn.end + 1e-3)[0]]
    return ring(before.edge) is None and ring(after.edge) is not None


def _beyond_exits(roads: Roads, plan: ActionPlan, arc: float) -> float:
    """Return the arc [m] of the last exit of a roundabout passed before an arc, or of its entry.

    It is 0 if the plan leads through no roundabout.
    """
    network, found = roads.network, 0.0
    before: str | None = None
    for name, start in plan.path.lanes:
        edge = network.lanes[name].edge
        if start >= arc or network.lanes[name].internal:
            continue
        ring = network.roundabout(edge)
        if ring is not None and (before is None or set(_ways_on(roads, before)) - ring):
            found = start
        before = None if ring is None else edge
    return found


def _ways_on(roads: Roads, edge: str) -> list[str]:
    network = roads.network
    links = [x for lane in network.edge_lanes(edge) for x in network.links_from(lane.id)]
    return [network.lanes[link.to_lane].edge for link in links]
