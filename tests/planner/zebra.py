"""A straight road east with a crossing for people, drawn by hand: no simulation.

The road leads along y = 0 from x = 0; the crossing lies between x = 100 and 104 and leads from
y = -1.6 to y = 1.6. Its index at junction J is 9.
"""

import math
from collections.abc import Sequence

import numpy as np

from planner.manoeuvres.actions import ActionPlan, Situation, expand
from planner.motion.obstacles import Obstacle
from planner.motion.tracks import Observed
from planner.record.trace import Action
from planner.roads.routes import Refusal
from planner.roads.trajectory import Roads
from sim.roads.lanes import UNSIGNALLED, Control, Crossing
from sim.roads.network import Lane, Link, Location, Network
from tests.planner.nets import lane

INDEX = 9
KEY = ("J", INDEX)


def zebra(
    *,
    priority: bool = True,
    control: Control = UNSIGNALLED,
    lanes: int = 1,
    of_crossing: Control | None = None,
) -> Roads:
    """The roads.

    Args:
        priority: whether people go first.
        control: of the crossing and of the road.
        lanes: of the road, from y = 0 to the left.
        of_crossing: control of the crossing, where that is another one.
    """
    found: dict[str, Lane] = {}
    links: list[Link] = []
    for k in range(lanes):
        y = 3.2 * k
        row = (
            lane(f"in_{k}", [(0.0, y), (100.0, y)]),
            lane(f":J_{k}", [(100.0, y), (104.0, y)], inside=True),
            lane(f"out_{k}", [(104.0, y), (400.0, y)]),
        )
        found |= {x.id: x for x in row}
        links.append(
            Link(
                "J",
                k,
                row[0].id,
                row[2].id,
                (row[1].id,),
                "straight",
                (),
                (),
                False,
                control,
                other_yields_to=(INDEX,) if priority else (),
                other_foes=(INDEX,),
            )
        )
    line = ((102.0, -1.6), (102.0, 3.2 * lanes - 1.6))
    crossing = Crossing(":J_c0_0", "J", INDEX, line, 4.0, ("in",), of_crossing or control)
    return Roads(Network(found, tuple(links), "zebra", crossings=(crossing,)))


def walker(
    points: Sequence[tuple[float, float]],
    heading: float,
    vehicle: int = 5,
    kind: str = "pedestrian",
) -> Observed:
    """Somebody seen at points [m], 0.2 s apart, now last."""
    position = np.array(points)
    steps = np.hypot(*np.diff(position, axis=0).T) / 0.2
    speed = np.concatenate((steps[:1], steps)) if len(points) > 1 else np.zeros(1)
    return Observed(vehicle, 0.2, 0.5, position, np.full(len(points), heading), speed, kind=kind)


def walking(
    x: float, y: float, heading: float, speed: float = 1.4, samples: int = 16, vehicle: int = 5
) -> Observed:
    """Somebody who has walked straight to a place [m]."""
    cos, sin = math.cos(heading), math.sin(heading)
    back = [0.2 * speed * k for k in range(samples)][::-1]
    return walker([(x - b * cos, y - b * sin) for b in back], heading, vehicle)


def standing_at(x: float, y: float, heading: float, samples: int = 16) -> Observed:
    """Somebody who has stood at a place [m]."""
    return walker([(x, y)] * samples, heading)


def stepping(y: float, speed: float, start: int = 0, steps: int = 120) -> Obstacle:
    """Somebody who walks north over the crossing from y [m], from a step on."""
    arcs = y + speed * 0.2 * np.maximum(np.arange(steps) - start, 0.0)
    return Obstacle(
        5, 0.2, 0.5, np.column_stack((np.full(steps, 102.0), arcs)),
        np.full(steps, math.pi / 2.0), np.full(steps, speed), frozenset((KEY,)), on_foot=True,
    )  # fmt: skip


def before(roads: Roads, away: float, speed: float, action: Action = "continue") -> ActionPlan:
    """The plan of an action at a distance [m] before the crossing."""
    x = 100.0 - away
    here = Situation(0.0, (x, 0.0), 0.0, speed, 0.0, Location("in_0", x, 0.0))
    found = expand(roads, here, action, None, 100.0)
    assert not isinstance(found, Refusal), found.reason
    return found
