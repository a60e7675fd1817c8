"""Goals that another vehicle may have: the exits in view, and stopping."""

import math
from dataclasses import dataclass

from planner.actions import Situation
from planner.trace import Action, EgoGoal
from planner.trajectory import Roads
from sim.network import Link

BEYOND = 4.0  # [m] into its exit that a vehicle has reached its goal
STOP_PRIOR = 0.02  # of stopping; the exits share the rest equally


@dataclass(frozen=True, slots=True)
class Goal:
    """One goal of another vehicle."""

    kind: Action  # the macro action that ends at it
    place: str  # in words
    target: EgoGoal | None  # None for stopping
    prior: float


PLACES: dict[Action, str] = {
    "exit-left": "the road to the left",
    "exit-right": "the road to the right",
    "exit-straight": "the road straight on",
    "continue": "the road straight on",
    "stop": "where it comes to a stop",
}


def goals_in_view(roads: Roads, starts: tuple[Situation, ...], view: float) -> tuple[Goal, ...]:
    """The goals of a vehicle that may be on one of several lanes, stopping last."""
    found: dict[str, tuple[Action, EgoGoal]] = {}
    for here in starts:
        for kind, target in _exits(roads, here, view):
            found.setdefault(target.edge, (kind, target))
    if not found:
        return (Goal("stop", PLACES["stop"], None, 1.0),)
    share = (1.0 - STOP_PRIOR) / len(found)
    exits = tuple(Goal(kind, PLACES[kind], target, share) for kind, target in found.values())
    return (*exits, Goal("stop", PLACES["stop"], None, STOP_PRIOR))


def _exits(roads: Roads, here: Situation, view: float) -> list[tuple[Action, EgoGoal]]:
    network = roads.network
    lane = network.lanes[here.location.lane]
    inside = network.link_via(lane.id)
    if inside is not None:
        return [_exit(roads, inside)]
    ahead = lane.length - here.location.offset
    lanes = network.edge_lanes(lane.edge)
    links = [link for other in lanes for link in network.links_from(other.id)]
    if ahead > view or not links:
        position = min(lane.length - 1.0, here.location.offset + view)
        return [("continue", EgoGoal(lane.edge, max(position, here.location.offset), None))]
    return [_exit(roads, link) for link in links if link.direction != "turnaround"]


def _exit(roads: Roads, link: Link) -> tuple[Action, EgoGoal]:
    target = roads.network.lanes[link.to_lane]
    kind: Action = "continue"
    if link.direction == "left":
        kind = "exit-left"
    elif link.direction == "right":
        kind = "exit-right"
    elif link.yields_to:
        kind = "exit-straight"
    return kind, EgoGoal(target.edge, min(BEYOND, 0.5 * target.length), None)


def stopping_time(distance: float, speed: float, limit: float, up: float, down: float) -> float:
    """The shortest time [s] to come to rest after a distance [m].

    Args:
        distance: [m]
        speed: [m/s] at the start.
        limit: [m/s] highest speed.
        up, down: [m/s2] acceleration and braking.
    """
    peak = math.sqrt(max((2.0 * distance * up * down + down * speed**2) / (up + down), 0.0))
    peak = max(min(peak, limit), 1e-3)
    if peak < speed:
        return 2.0 * distance / max(speed, 1e-3)
    used = (peak**2 - speed**2) / (2.0 * up) + peak**2 / (2.0 * down)
    return (peak - speed) / up + peak / down + max(distance - used, 0.0) / peak
