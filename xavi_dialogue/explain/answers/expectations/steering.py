"""Steering: how the plan turns at the junctions of our way."""

import math
from bisect import bisect_left
from typing import Final

from msgspec.structs import replace

from planner.record.places import RouteStep
from planner.record.trace import Action
from xavi_dialogue.explain.answers.expectations.precedence import planned_line
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.history.motion import Motion
from xavi_dialogue.explain.history.nearing import junctions_ahead, still_to

BEFORE: Final = 4.0  # [m] before a junction, where our line still has the direction of the road
ACROSS: Final = 30.0  # [m] of our line that lead through a junction
TURNED: Final = math.radians(40.0)  # [rad] change of direction that is a turn


def as_planned(asked: Asked, route: tuple[RouteStep, ...]) -> tuple[RouteStep, ...]:
    """Return the junctions ahead, with the turn of the plan at the first where it leaves the route.

    What comes after that junction is not recorded. Roundabouts are left as the route has them.
    """
    trace = asked.ride.at(asked.now)
    line = None if trace is None else planned_line(trace)
    if line is None or not line.arc:
        return route
    gone = -still_to(asked.ride, 0.0, asked.now)
    for k, step in enumerate(route):
        after = route[k + 1].distance - step.distance if k + 1 < len(route) else ACROSS
        turn = _turn(line, step.distance + gone, min(after, ACROSS))
        if step.kind == "roundabout" or turn is None:
            return route
        if turn != step.turn:
            return (*route[:k], replace(step, turn=turn))
    return route


def goes_onward(asked: Asked) -> bool:
    """Whether our plan leaves the recorded route; the way after that is not known."""
    route = junctions_ahead(asked.ride, asked.now)
    return as_planned(asked, route) != route


def _turn(line: Motion, at: float, length: float) -> Action | None:
    """Return how a line turns over a length [m] from a place [m] along it; None: it ends before."""
    ends = [bisect_left(line.arc, m) for m in (max(at - BEFORE, 0.0), at + length)]
    if ends[1] >= len(line.arc):
        return None
    angle = math.remainder(line.heading[ends[1]] - line.heading[ends[0]], math.tau)
    if abs(angle) < TURNED:
        return "exit-straight"
    return "exit-left" if angle > 0.0 else "exit-right"
