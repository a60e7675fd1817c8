"""Precedence: who comes first where ways meet, as predicted; roundabouts and red lights ahead."""

import math
from collections.abc import Sequence
from itertools import pairwise, takewhile
from typing import Final, Literal, TypeAlias

from planner.record.places import RoadFacts
from planner.record.trace import SAMPLE_PERIOD, PlanTrace, TrajectoryPrediction
from sim.scene import EGO, LightState, Point
from xavi_dialogue.causal.model import Actions
from xavi_dialogue.explain.causes.vehicles.course import lines
from xavi_dialogue.explain.history.motion import Motion
from xavi_dialogue.explain.history.ride import planned, prediction
from xavi_dialogue.explain.history.traffic_lights import at_step

MEETING: Final = 2.0  # [m] within which two lines meet
MOVING: Final = 0.5  # [m/s] above which a vehicle moves along its line
TURNED: Final = math.radians(35.0)  # [rad] maximum difference of directions that count as the same
BESIDE: Final = 9.0  # [m] maximum offset sideways of a vehicle on our road
SHORTLY: Final = 4.0  # [s] maximum time before us at which a vehicle passes in front of us
BESIDE_LINE: Final = 4.0  # [m] within which a vehicle is on our line
KNOWN: Final = 0.5  # minimum probability of ways that do not meet ours
RARE: Final = 0.1  # maximum probability of those that do
AHEAD: Final = 15.0  # [m] length of our way that gives the direction of our road

First: TypeAlias = Literal["we", "they", "nobody"]


def first(trace: PlanTrace, way: TrajectoryPrediction) -> First | None:
    """Return who is first where our ways meet; nobody if they do not. None: not known."""
    ours = planned_line(trace)
    if ours is None or not way.path or not way.speed:
        return None
    for k, (place, speed) in enumerate(zip(way.path, way.speed, strict=False)):
        if speed <= MOVING:
            continue
        there = _reached(ours, place)
        if there is not None:
            return "they" if trace.sim_time + k * SAMPLE_PERIOD <= there else "we"
    return "nobody"


def is_apart(trace: PlanTrace, vehicle: int) -> bool:
    """Check whether hardly any predicted way of a vehicle crosses or joins ours.

    It is not if that is not known, as where our line or theirs ends too soon. A vehicle that drives
    ahead on our way has joined it already.
    """
    known, ours = prediction(trace, vehicle), planned_line(trace)
    step = trace.road.route[0] if trace.road is not None and trace.road.route else None
    length = 0.0 if ours is None or not ours.arc else ours.arc[-1]
    if known is None or ours is None or (step is not None and length < step.distance + AHEAD):
        return False
    shares = {True: 0.0, False: 0.0}
    for goal in known.goals:
        for way in goal.trajectories:
            goes = bool(way.path) and way.speed[-1:] > (MOVING,)  # it does not end in a halt
            if goes and math.dist(way.path[0], way.path[-1]) >= AHEAD:
                meets = first(trace, way) != "nobody" and not _leads(ours, way)
                shares[meets] += goal.probability * way.probability
    return shares[False] >= KNOWN and shares[True] < RARE


def _leads(ours: Motion, way: TrajectoryPrediction) -> bool:
    """Check whether a way begins on our line, in its direction."""
    k = min(range(len(ours.position)), key=lambda k: math.dist(ours.position[k], way.path[0]))
    if k == 0 or math.dist(ours.position[k], way.path[0]) > BESIDE_LINE:
        return False
    along, theirs = _direction(ours.position[k : k + 3]), _direction(way.path[:2])
    if along is None or theirs is None:
        return False
    return abs(math.remainder(theirs - along, math.tau)) <= TURNED


def before_us(trace: PlanTrace, way: TrajectoryPrediction) -> bool | None:
    """Check whether a way crosses ours shortly before we get there; None: not known."""
    ours = planned_line(trace)
    if ours is None or not way.path or not way.speed:
        return None
    for k, (place, speed) in enumerate(zip(way.path, way.speed, strict=False)):
        there = _reached(ours, place) if speed > MOVING else None
        if there is not None and 0.0 <= there - trace.sim_time - k * SAMPLE_PERIOD <= SHORTLY:
            return True
    return False


def into_our_road(trace: PlanTrace, way: TrajectoryPrediction) -> bool | None:
    """Check whether a way leads into the road that we are on; None: not known."""
    ours = planned_line(trace)
    if ours is None or len(way.path) < 2:
        return None
    here = ours.position[0]
    ends = [p for p in ours.position if math.dist(here, p) <= AHEAD]
    road, last = _direction(ends), _direction(way.path[-4:])
    if road is None or last is None:
        return None
    turned = abs(math.remainder(last - road, math.pi))
    dx, dy = way.path[-1][0] - here[0], way.path[-1][1] - here[1]
    return turned <= TURNED and abs(dy * math.cos(road) - dx * math.sin(road)) <= BESIDE


def planned_line(trace: PlanTrace) -> Motion | None:
    """Return the line of the rollout that follows the plan furthest, best to the destination."""
    plan, known = planned(trace), lines(trace)
    fitting = [
        (_common(plan, tuple(a.action for a in r.actions)), r.outcome == "done", known[r.index])
        for r in trace.rollouts
        if r.index in known and tuple(a.action for a in r.actions[:1]) == plan[:1]
    ]
    fitting = [one for one in fitting if len(one[2].position) > 1]
    best = max(fitting, key=lambda one: (*one[:2], one[2].arc[-1:]), default=None)
    return None if best is None else best[2]


def _common(plan: Actions, done: Actions) -> int:
    """Return how many actions two sequences begin with in common."""
    same = takewhile(lambda pair: pair[0] == pair[1], zip(plan, done, strict=False))
    return len(tuple(same))


def _reached(ours: Motion, place: Point) -> float | None:
    """Return when [s] we pass a place; None if our line does not lead past it."""
    best = min((_apart(a, b, place), k) for k, (a, b) in enumerate(pairwise(ours.position)))
    return ours.time[best[1]] if best[0] <= MEETING else None


def _apart(a: Point, b: Point, place: Point) -> float:
    """Return how far [m] a place is from the line between two others."""
    (ax, ay), (bx, by), (x, y) = a, b, place
    length = (bx - ax) ** 2 + (by - ay) ** 2
    along = 0.0 if length == 0.0 else ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length
    along = min(max(along, 0.0), 1.0)
    return math.hypot(x - ax - along * (bx - ax), y - ay - along * (by - ay))


def _direction(points: Sequence[Point]) -> float | None:
    """Return the direction [rad] in which points lead; None if they stay in one place."""
    if len(points) < 2 or math.dist(points[0], points[-1]) < MOVING:
        return None
    (ax, ay), (bx, by) = points[0], points[-1]
    return math.atan2(by - ay, bx - ax)


def at_ring(road: RoadFacts | None) -> bool:
    """Check whether the next junction is that of a roundabout, or we are on one."""
    coming = road is not None and bool(road.route) and road.route[0].kind == "roundabout"
    return coming or on_ring(road)


def on_ring(road: RoadFacts | None) -> bool:
    """Check whether we are on a roundabout, where those who come to it have to wait."""
    place = None if road is None else road.places.get(EGO)
    return place is not None and place.roundabout


def red_ahead(road: RoadFacts | None) -> bool:
    """Check whether the next junction on our way has a light that is red for us."""
    return _shows(road, (LightState.RED, LightState.RED_AMBER))


def green_ahead(road: RoadFacts | None) -> bool:
    """Check whether the next junction on our way has a light by which all others stop for us."""
    return _shows(road, (LightState.GREEN,))


def _shows(road: RoadFacts | None, states: tuple[LightState, ...]) -> bool:
    light = None if road is None or not road.route else at_step(road, road.route[0])
    return light is not None and light.state in [state.value for state in states]
