"""A crossroads with traffic lights, made by hand: no simulation.

Four arms of 150 m, one lane each way. The places of its controller J are numbered anticlockwise
from the south: right, straight, left of each arm.
"""

import math
from functools import cache

import numpy as np

from planner.kernels.course import Codes
from planner.kernels.limits import OPEN
from planner.manoeuvres.actions import ActionPlan, Situation, expand
from planner.motion.obstacles import Obstacle
from planner.motion.tracks import links_of
from planner.record.light_record import Showing
from planner.record.trace import Action
from planner.roads.routes import Refusal
from planner.roads.trajectory import Roads
from planner.traffic_lights.observations import Watched
from planner.traffic_lights.signals import MEANING, Lights
from sim.roads.lanes import Lane, Link
from sim.roads.lines import point_at
from sim.roads.network import Direction, Location, Network
from sim.scene import Point, Signal
from tests.planner.nets import lane

ARM = 150.0  # [m]
HALF = 12.0  # [m] of the junction
ASIDE = 1.75  # [m] from the middle of the road to that of a lane
LIMIT = 13.89  # [m/s]
TURNS: tuple[Direction, ...] = ("right", "straight", "left")
ARMS = ("south", "east", "north", "west")  # from which one comes, anticlockwise
CONTROLLER = "J"
#: South and north go, left turns giving way; east and west are held.
NORTH_SOUTH = "GGgrrrGGgrrr"
EAST_WEST = "rrrGGgrrrGGg"


def _turned(point: Point, quarters: int) -> Point:
    x, y = point
    for _ in range(quarters % 4):
        x, y = -y, x
    return round(x, 6), round(y, 6)


def place(arm: str, turn: Direction) -> int:
    """The place of a turn in the controller's state, and the index of its link."""
    return 3 * ARMS.index(arm) + TURNS.index(turn)


def _line(turn: Direction) -> tuple[Point, ...]:
    """The way of a turn through the junction from the south."""
    if turn == "straight":
        return (ASIDE, -HALF), (ASIDE, HALF)
    radius = HALF - ASIDE if turn == "right" else HALF + ASIDE
    side = 1.0 if turn == "right" else -1.0
    middle = side * HALF
    angles = np.linspace(0.0, math.pi / 2.0, 9)
    return tuple(
        (middle - side * radius * math.cos(a), -HALF + radius * math.sin(a))
        for a in angles.tolist()
    )


def _lane(name: str, points: tuple[Point, ...], *, inside: bool) -> Lane:
    return lane(f"{name}_0", points, LIMIT, inside=inside)


def _yields(arm: int, turn: Direction) -> tuple[int, ...]:
    """The links that go first where lights let both go: a left turn yields to who comes on."""
    opposite = ARMS[(arm + 2) % 4]
    return (place(opposite, "right"), place(opposite, "straight")) if turn == "left" else ()


@cache
def crossroads() -> Roads:
    """The roads."""
    lanes: dict[str, Lane] = {}
    links: list[Link] = []
    for k, arm in enumerate(ARMS):
        into = tuple(_turned(p, k) for p in ((ASIDE, -ARM - HALF), (ASIDE, -HALF)))
        away = tuple(_turned(p, k) for p in ((-ASIDE, -HALF), (-ASIDE, -ARM - HALF)))
        for name, points in ((f"{arm}_in", into), (f"{arm}_out", away)):
            lanes[f"{name}_0"] = _lane(name, points, inside=False)
        for turn in TURNS:
            via = _lane(f":{arm}_{turn}", tuple(_turned(p, k) for p in _line(turn)), inside=True)
            lanes[via.id] = via
            to = ARMS[(k + {"right": 1, "straight": 2, "left": 3}[turn]) % 4]
            links.append(
                Link(
                    "J",
                    place(arm, turn),
                    f"{arm}_in_0",
                    f"{to}_out_0",
                    (via.id,),
                    turn,
                    _yields(k, turn),
                    _foes(k, turn),
                    False,
                    Signal(CONTROLLER, place(arm, turn)),
                )
            )
    return Roads(Network(lanes, tuple(links), "crossroads"))


def _foes(arm: int, turn: Direction) -> tuple[int, ...]:
    """The links whose ways cross or merge."""
    right, ahead, left = (ARMS[(arm + k) % 4] for k in (1, 2, 3))
    met = {
        "right": [(left, "straight"), (ahead, "left")],
        "straight": [
            *((right, turn) for turn in ("straight", "left", "right")),
            *((left, turn) for turn in ("straight", "left")),
            (ahead, "left"),
        ],
        "left": [
            (right, "straight"), (right, "left"), (left, "straight"), (left, "left"),
            (ahead, "straight"), (ahead, "right"),
        ],
    }  # fmt: skip
    return tuple(sorted(place(other, way) for other, way in met[turn]))  # type: ignore[arg-type]


def lane_row(arm: str, turn: Direction) -> tuple[str, ...]:
    """The lanes of a way through the junction."""
    link = next(x for x in crossroads().network.links_from(f"{arm}_in_0") if x.direction == turn)
    return (link.from_lane, *link.via, link.to_lane)


def before(away: float, speed: float, arm: str = "south") -> Situation:
    """On an arm at a distance [m] before the junction."""
    name = f"{arm}_in_0"
    here = crossroads().network.lanes[name]
    at = here.length - away
    position, heading = point_at(here.centreline, at)
    return Situation(0.0, position, heading, speed, 0.0, Location(name, at, 0.0))


def plan(here: Situation, action: Action) -> ActionPlan:
    """The plan of an action that applies."""
    found = expand(crossroads(), here, action, None, 100.0)
    assert not isinstance(found, Refusal), found.reason
    return found


def shown(states: list[tuple[float, str]], steps: int = 200) -> Lights:
    """What the lights show: from times [s] on, states in letters."""
    times = [round(time / 0.2) for time, _ in states]
    meaning: dict[Signal, Codes] = {}
    for k in range(12):
        codes = np.zeros(steps, np.int8)
        for since, (_, letters) in zip(times, states, strict=True):
            codes[since:] = MEANING.get(letters[k], OPEN)
        meaning[Signal(CONTROLLER, k)] = codes
    return Lights(meaning)


def watched(*seen: tuple[float, str]) -> Watched:
    """What was seen of the controller."""
    return Watched(CONTROLLER, tuple(range(12)), tuple(Showing(t, s) for t, s in seen))


def driving(arm: str, turn: Direction, arcs: list[float], vehicle: int = 1) -> Obstacle:
    """A vehicle whose front is at the given arcs [m] along its way, step by step."""
    line = crossroads().line(lane_row(arm, turn))
    poses = [line.pose(arc) for arc in arcs]
    return Obstacle(
        vehicle,
        4.8,
        1.8,
        np.array([position for position, _ in poses]),
        np.array([heading for _, heading in poses]),
        np.gradient(np.array(arcs)) / 0.2,
        links_of(crossroads(), lane_row(arm, turn)),
    )
