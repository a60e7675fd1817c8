"""The recorded route beyond the first actions of a plan."""

from collections.abc import Sequence
from itertools import takewhile

from planner.record.places import RouteStep
from planner.record.trace import PlanTrace
from xavi_dialogue.causal.model import Actions
from xavi_dialogue.explain.causes.vehicles.actions import EXITS


def route_after(trace: PlanTrace, node: Actions) -> tuple[tuple[RouteStep, ...], int]:
    """Find the junctions of the route that remain after some actions.

    Returns:
        The steps of the route, and how many exits of the roundabout that comes first were passed.
    """
    route: Sequence[RouteStep] = () if trace.road is None else trace.road.route
    passed = 0
    for action in node:
        if action == "continue-next-exit":
            passed += 1
        elif action in EXITS and route:
            route, passed = route[1:], 0
        elif action == "continue":
            route = route[len(list(takewhile(_straight, route))) :]
    return tuple(route), passed


def _straight(step: RouteStep) -> bool:
    return step.kind == "junction" and step.turn == "exit-straight"


def shared(one: Actions, other: Actions) -> Actions:
    """Return the actions that two plans begin with."""
    same = takewhile(lambda pair: pair[0] == pair[1], zip(one, other, strict=False))
    return tuple(action for action, _ in same)
