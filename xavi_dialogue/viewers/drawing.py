"""Scenes, plans, beliefs and ghosts as messages for viewers."""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

from planner.record.trace import PlanTrace
from sim.roads.network import Network
from sim.scene import EGO, Light, PersonState, Point, Scene, VehicleState
from xavi_dialogue.library.trajectories import Trajectory
from xavi_dialogue.viewers import colours, messages
from xavi_dialogue.viewers.messages import Box, Message, Part, Place

LIGHT_HEIGHT = 3.0  # [m]
LIGHT_SIZE = 0.9  # [m]
LABEL_ABOVE = 0.9  # [m] above the roof
LINE_HEIGHT = 0.25  # [m] above the road
LINE_WIDTH = 0.35  # [m]
FAINTEST = 0.02  # probability of the least likely belief that is drawn
KMH = 3.6


def vehicles(scene: Scene, before: Scene | None) -> Message:
    """Return who is in view, with who has left it since the scene before."""
    here: dict[int, VehicleState | PersonState] = {**scene.vehicles, **scene.people}
    were = () if before is None else (*before.vehicles, *before.people)
    gone = [_name(who) for who in were if who not in here]
    entities = [
        messages.entity(_name(who), scene.time, _user(who, state))
        for who, state in sorted(here.items())
    ]
    return messages.scene(entities, gone, scene.time)


def lights(scene: Scene, network: Network, before: Scene | None) -> Message:
    """Return the traffic lights in view, at the ends of the lanes that they control."""
    old = () if before is None else before.lights
    here = {_light(one) for one in scene.lights}
    entities = [
        messages.entity(_light(one), scene.time, tuple(_lamps(one, network)))
        for one in scene.lights
    ]
    gone = [_light(one) for one in old if _light(one) not in here]
    return messages.scene(entities, gone, scene.time)


def own_frame(scene: Scene) -> Message:
    """Return the place of our own car: the middle of the ground under it."""
    return messages.frame(scene.time, _middle(scene.ego, 0.0), scene.ego.heading)


def odometry(scene: Scene) -> Message:
    """Return place and speed of our own car."""
    ego = scene.ego
    return messages.odometry(scene.time, _middle(ego, 0.0), ego.heading, ego.speed)


def plan(time: float, path: Sequence[Point]) -> Message:
    """Return the path that is planned."""
    return messages.poses(time, _raised(path))


def beliefs(trace: PlanTrace, before: PlanTrace | None) -> Message:
    """Return where the others may go: the fainter the less likely, and the later on a path."""
    entities = []
    for known in trace.predictions:
        parts = tuple(_paths(trace, known.vehicle))
        if parts:
            entities.append(messages.entity(_belief(known.vehicle), trace.sim_time, parts))
    here = {one.id for one in entities}
    old = () if before is None else (_belief(one.vehicle) for one in before.predictions)
    gone = [name for name in old if name not in here]
    return messages.scene(entities, gone, trace.sim_time)


def ghost(name: str, what: Trajectory, time: float, size: VehicleState) -> Message:
    """Return what would have been driven at a time [s]: nothing before and after it."""
    place = what.at(time)
    if place is None:
        return messages.scene((), (name,), time)
    ahead = what.at(min(time + what.period, what.end)) or place
    heading = math.atan2(ahead[1] - place[1], ahead[0] - place[0])
    if ahead == place:
        heading = _last_heading(what, time, size.heading)
    box = _box(place, heading, (size.length, size.width, colours.height(size)))
    path = messages.line(_raised(what.points), LINE_WIDTH, [colours.GHOST])
    above = (place[0], place[1], colours.height(size) + LABEL_ABOVE)
    said = messages.label(name, above, colours.GHOST)
    entity = messages.entity(name, time, (messages.cube(box, colours.GHOST), path, said))
    return messages.scene((entity,))


def _last_heading(what: Trajectory, time: float, default: float) -> float:
    """Return the heading [rad] with which a car came that stands at a time [s]."""
    past = [point for k, point in enumerate(what.points) if what.start + k * what.period <= time]
    moves = ((a, b) for a, b in pairwise(past) if a != b)
    heading = default
    for a, b in moves:
        heading = math.atan2(b[1] - a[1], b[0] - a[0])
    return heading


def _user(who: int, state: VehicleState | PersonState) -> tuple[Part, ...]:
    tall = colours.height(state)
    size = (state.length, state.width, tall)
    box = _box(state.position, state.heading, size)
    name = "we" if who == EGO else f"{state.kind} {who}"
    above = (box.place[0], box.place[1], tall + LABEL_ABOVE)
    text = f"{name}, {state.speed * KMH:.0f} km/h"
    return (
        messages.cube(box, colours.colour(who, state)),
        messages.label(text, above, colours.TEXT),
    )


def _box(front: Point, heading: float, size: Place) -> Box:
    back = size[0] / 2.0
    place = (front[0] - back * math.cos(heading), front[1] - back * math.sin(heading))
    return Box((*place, size[2] / 2.0), heading, size)


def _middle(state: VehicleState, z: float) -> Place:
    box = _box(state.position, state.heading, (state.length, state.width, 0.0))
    return (box.place[0], box.place[1], z)


def _lamps(light: Light, network: Network) -> Iterator[Part]:
    colour = colours.SIGNALS[light.state]
    for lane in dict.fromkeys(link.from_lane for link in network.signalled(light.signal)):
        x, y = network.lanes[lane].centreline[-1]
        yield messages.ball((x, y, LIGHT_HEIGHT), LIGHT_SIZE, colour)


def _paths(trace: PlanTrace, vehicle: int) -> Iterator[Part]:
    goals = next(one.goals for one in trace.predictions if one.vehicle == vehicle)
    for goal in goals:
        for way in goal.trajectories:
            chance = goal.probability * way.probability
            if chance < FAINTEST or len(way.path) < 2:
                continue
            last = len(way.path) - 1
            shades = [
                colours.faded(colours.BELIEF, chance * (1.0 - 0.8 * k / last))
                for k in range(last + 1)
            ]
            yield messages.line(_raised(way.path), LINE_WIDTH, shades)
            x, y = way.path[last]
            text = f"{goal.place} {chance:.0%}"
            yield messages.label(text, (x, y, LABEL_ABOVE), colours.BELIEF)


def _raised(path: Sequence[Point]) -> list[Place]:
    return [(x, y, LINE_HEIGHT) for x, y in path]


def _name(who: int) -> str:
    return f"user {who}"


def _belief(who: int) -> str:
    return f"belief {who}"


def _light(light: Light) -> str:
    return f"light {light.signal.controller} {light.signal.index}"
