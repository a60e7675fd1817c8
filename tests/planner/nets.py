"""Road networks of many kinds: shipped, generated, and drawn by hand."""

import math
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path

from planner.manoeuvres.actions import Situation
from planner.roads.trajectory import Roads
from sim.roads.netfile import read_network
from sim.roads.network import Direction, Lane, Link, Location, Network, cumulative, point_at
from sim.scene import Point
from sim.setup.scenario import load

SCENARIOS = ("s1", "s2", "s3", "s4", "motorway", "town")

#: What netgenerate is asked for.
GENERATED = {
    "grid": ("-g", "--grid.number", "3", "--grid.length", "90", "-L", "2"),
    "blocks": (
        *("-g", "--grid.number", "3", "--grid.length", "60"),
        *("--default-junction-type", "right_before_left"),
    ),
    "spider": ("-s", "--spider.arm-number", "5", "--spider.circle-number", "2", "-L", "2"),
    "random": ("-r", "--rand.iterations", "15", "--rand.random-lanenumber", "-L", "3"),
    "open": ("-r", "--rand.iterations", "10", "--no-internal-links", "-L", "2"),
}


@cache
def shipped(name: str) -> Roads:
    """The roads of a scenario; the ring of s3 is known as a roundabout."""
    network = read_network(load(name).network)
    ring = frozenset(lane.edge for lane in network.lanes.values() if lane.edge.startswith("ring_"))
    return Roads(replace(network, roundabouts=(ring,)) if name == "s3" else network)


def generate(name: str, folder: Path) -> Roads:
    """Roads made by netgenerate."""
    target = folder / f"{name}.net.xml"
    program = str(Path(sys.executable).parent / "netgenerate")
    command = [program, *GENERATED[name], "--seed", "3", "-o", str(target)]
    subprocess.run(command, check=True, capture_output=True)
    return Roads(read_network(target))


def lane(name: str, points: Sequence[Point], limit: float = 13.89, *, inside: bool = False) -> Lane:
    """A lane; the last part of its name is its index, the rest its edge."""
    edge, _, index = name.rpartition("_")
    line = tuple(points)
    length = cumulative(line)[-1]
    return Lane(
        name, edge, int(index), 3.5, limit, line, inside, length, length, frozenset({"passenger"})
    )


def link(
    start: str,
    end: str,
    direction: Direction = "straight",
    via: tuple[str, ...] = (),
    *,
    yields_to: tuple[int, ...] = (),
    foes: tuple[int, ...] = (),
    index: int = 0,
) -> Link:
    """A link at junction J."""
    return Link("J", index, start, end, via, direction, yields_to, foes, False)


def drawn(lanes: Sequence[Lane], links: Sequence[Link] = ()) -> Roads:
    """Roads drawn by hand."""
    return Roads(Network({x.id: x for x in lanes}, tuple(links), "drawn"))


def arc(radius: float, angle: float, step: float, lead: float = 30.0) -> tuple[Point, ...]:
    """A straight line of length `lead` [m], and then a bend to the left.

    Args:
        radius: [m]
        angle: [rad] of the bend.
        step: [m] length of the sides of the polygon that draws it.
        lead: [m]
    """
    count = max(2, round(radius * angle / step))
    turned = [angle * k / count for k in range(count + 1)]
    bend = ((lead + radius * math.sin(t), radius * (1.0 - math.cos(t))) for t in turned)
    return ((0.0, 0.0), *bend)


def on_lane(roads: Roads, name: str, offset: float, speed: float = 8.0) -> Situation:
    """On the centreline of a lane at an offset [m]; a negative one counts from its end."""
    here = roads.network.lanes[name]
    at = offset if offset >= 0.0 else here.length + offset
    position, heading = point_at(here.centreline, at)
    return Situation(0.0, position, heading, speed, 0.0, Location(name, at, 0.0))
