"""Random road networks: a straight road, or one that a minor road joins or crosses."""

import math
from dataclasses import replace
from random import Random

from benchmarks.worlds.values import Edge, Node, Roads

LIMITS = (8.33, 11.11, 13.89, 16.67)  # [m/s] of a main road
MINOR_LIMITS = (8.33, 11.11)  # [m/s]
MAIN, MINOR = 10, 3  # priorities
SKEW = math.radians(25.0)  # greatest deviation of an arm from its compass point
BOW, POINTS = (0.4, 0.9), 16  # [rad] turn of an arc, and the number of its pieces
ASIDE = (22.0, 40.0)  # [m] between the main road and one that does not meet it


def straight(draw: Random, lanes: int, length: tuple[float, float]) -> Roads:
    """Return a road from west to east and back without junctions, and another beside it.

    Args:
        draw: where chance comes from.
        lanes: in each direction.
        length: [m] least and greatest.
    """
    limit, long = draw.choice(LIMITS[1:]), draw.uniform(*length)
    nodes = [Node("west", 0.0, 0.0, True), Node("east", long, 0.0, True)]
    edges = _both_ways("west", "east", "main", "back", lanes, limit, MAIN, long)
    off = draw.choice((-1.0, 1.0)) * draw.uniform(*ASIDE)
    return _turned(draw, *_with_aside(draw, nodes, edges, (0.0, off), (long, off)))


def crossing(draw: Random, lanes: int = 1, arms: tuple[str, ...] = ()) -> Roads:
    """Return a main road from west to east that a minor road joins, or crosses, at J.

    The edges towards J are named `west_in` and so on, those away from it `west_out`.

    Args:
        draw: where chance comes from.
        lanes: of the main road in each direction.
        arms: of the minor road that there must be; the other may be there.
    """
    minor = [arm for arm in ("south", "north") if arm in arms or draw.random() < 0.6]
    limit, slow = draw.choice(LIMITS[1:]), draw.choice(MINOR_LIMITS)
    nodes = [Node("J", 0.0, 0.0, False)]
    edges: list[Edge] = []
    ways = {"west": (-1.0, 0.0), "east": (1.0, 0.0), "south": (0.0, -1.0), "north": (0.0, 1.0)}
    for arm in ("west", "east", *(minor or ["south"])):
        main = arm in ("west", "east")
        long = draw.uniform(170.0, 260.0) if main else draw.uniform(100.0, 150.0)
        nodes.append(Node(arm, long * ways[arm][0], long * ways[arm][1], True))
        speed, priority = (limit, MAIN) if main else (min(slow, limit), MINOR)
        names = (f"{arm}_in", f"{arm}_out")
        edges += _both_ways(arm, "J", *names, lanes if main else 1, speed, priority, long)
    off, side = draw.uniform(*ASIDE), draw.choice((-1.0, 1.0))
    ends = (side * 22.0, off), (side * 150.0, off)
    if minor == ["north"]:
        ends = (side * 22.0, -off), (side * 150.0, -off)
    return _turned(draw, *_with_aside(draw, nodes, edges, *ends))


def bent(draw: Random, roads: Roads) -> Roads:
    """Bend roads: a road without a junction becomes an arc, and arms meet at oblique angles.

    The separate road is moved farther away, so that it still meets no other.
    """
    nodes = {node.id: node for node in roads.nodes}
    if "J" in nodes:
        angles = {arm: draw.uniform(-SKEW, SKEW) for arm in ("west", "east", "south", "north")}
        turned = [
            _about(node, angles[node.id]) if node.id in angles else node for node in nodes.values()
        ]
        return Roads(tuple(_away(node) for node in turned), roads.edges)
    bow = draw.choice((-1.0, 1.0)) * draw.uniform(*BOW)
    edges = {name: _arc(nodes, edge, bow) for name, edge in roads.edges.items()}
    return Roads(roads.nodes, edges)


def _about(node: Node, angle: float) -> Node:
    """Return a node turned about the junction."""
    cos, sin = math.cos(angle), math.sin(angle)
    return Node(node.id, node.x * cos - node.y * sin, node.x * sin + node.y * cos, node.end)


def _away(node: Node) -> Node:
    """Return a node, three times as far away if it is of the separate road."""
    far = 3.0 if node.id.startswith("aside") else 1.0
    return Node(node.id, far * node.x, far * node.y, node.end)


def _arc(nodes: dict[str, Node], edge: Edge, bow: float) -> Edge:
    """Return an edge along an arc that turns left by an angle [rad], seen on the way there."""
    a, b = nodes[edge.start], nodes[edge.end]
    forth = edge.id in ("main", "aside_there")
    chord = math.dist((a.x, a.y), (b.x, b.y))
    along = ((b.x - a.x) / chord, (b.y - a.y) / chord)
    side = 1.0 if forth else -1.0
    radius = chord / (2.0 * math.sin(abs(bow) / 2.0))
    points = []
    for k in range(POINTS + 1):
        turn = bow * (k / POINTS - 0.5)
        x = chord / 2.0 + radius * math.sin(abs(bow) * (k / POINTS - 0.5))
        y = math.copysign(radius * (math.cos(turn) - math.cos(bow / 2.0)), bow * side)
        points.append((a.x + along[0] * x - along[1] * y, a.y + along[1] * x + along[0] * y))
    return replace(edge, shape=tuple(points))


def _both_ways(
    a: str,
    b: str,
    there: str,
    back: str,
    lanes: int,
    speed: float,
    priority: int,
    length: float,
) -> list[Edge]:
    return [
        Edge(there, a, b, lanes, speed, priority, length),
        Edge(back, b, a, lanes, speed, priority, length),
    ]


def _with_aside(
    draw: Random,
    nodes: list[Node],
    edges: list[Edge],
    a: tuple[float, float],
    b: tuple[float, float],
) -> tuple[list[Node], list[Edge]]:
    ends = [Node("aside_a", *a, True), Node("aside_b", *b, True)]
    names = ("aside_there", "aside_back")
    speed = draw.choice(LIMITS[:3])
    road = _both_ways("aside_a", "aside_b", *names, 1, speed, MINOR, math.dist(a, b))
    return [*nodes, *ends], [*edges, *road]


def _turned(draw: Random, nodes: list[Node], edges: list[Edge]) -> Roads:
    """Return the roads turned by a random angle."""
    angle = draw.uniform(-math.pi, math.pi)
    cos, sin = math.cos(angle), math.sin(angle)
    turned = (
        Node(
            node.id,
            round(node.x * cos - node.y * sin, 2),
            round(node.x * sin + node.y * cos, 2),
            node.end,
        )
        for node in nodes
    )
    return Roads(tuple(turned), {edge.id: edge for edge in edges})
