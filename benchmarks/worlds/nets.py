"""New networks made by netgenerate, with random traffic.

A world is a number in a family: the same number gives the same world, and families share none.
"""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from random import Random

from benchmarks.worlds.folder import NAME, write_traffic
from benchmarks.worlds.generated import followers, walk
from benchmarks.worlds.values import Edge, Halt, Roads, Shape, Vehicle, World
from sim.roads.netconvert import generate
from sim.roads.netfile import read_network
from sim.roads.network import Network
from sim.setup.scenario import Scenario

SHAPES: tuple[Shape, ...] = ("car", "car", "car", "van", "truck", "bus", "motorcycle")
LIMITS = (8.33, 11.11, 13.89, 16.67)  # [m/s]
LONG = (100.0, 220.0)  # [m] length of the ego's way, from the beginning of its first edge
FEWEST, MOST = 2, 7  # number of others
APART = 16.0  # [m] least distance between the fronts of two that start in one lane
CLEAR = 20.0  # [m] at both ends of an edge, where nobody starts
LEAST = 60.0  # [m] least length of an edge on which the ego's way may begin or end
HALTS = 0.12  # share of the others that stop on the way
TRIES = 200
DURATION = 60.0  # [s] greatest duration of a ride


class NoWay(Exception):
    """A network has no way for the ego that is long enough."""


def write_net(family: str, number: int, folder: Path) -> Scenario:
    """Write the scenario folder of a random world, which need not exist.

    Raises:
        NetconvertError: netgenerate is not installed, or fails.
        ScenarioError: the vehicles do not fit the roads.
        NoWay: none of many networks has a way that is long enough.
    """
    folder.mkdir(parents=True, exist_ok=True)
    draw = Random(f"{family}/{number}")
    for _ in range(TRIES):
        generate(_arguments(draw), folder / f"{NAME}.net.xml")
        network = read_network(folder / f"{NAME}.net.xml")
        world = _world(draw, network, number)
        if world is not None:
            scenario = write_traffic(world, folder, "A network and traffic at random.")
            return replace(scenario, duration=DURATION, seed=number)
    raise NoWay(f"{family} {number}")


def _arguments(draw: Random) -> list[str]:
    """Draw the arguments for netgenerate."""
    rest = ["--seed", str(draw.randrange(2**31)), "--default.speed", str(draw.choice(LIMITS))]
    rest += ["--default.lanenumber", str(draw.choice((1, 2, 2, 3)))]
    kind = draw.choice(("grid", "spider", "random", "random"))
    if kind == "grid":
        bent = str(draw.uniform(0.0, 15.0))
        sizes = ("--grid.x-length", "--grid.y-length")
        lengths = [part for name in sizes for part in (name, str(draw.uniform(90.0, 220.0)))]
        return ["-g", "--grid.number", "3", *lengths, "--perturb-x", bent, *rest]
    if kind == "spider":
        arms, space = str(draw.randint(4, 7)), str(draw.uniform(80.0, 160.0))
        circles = ("--spider.circle-number", "2", "--spider.space-radius", space)
        return ["-s", "--spider.arm-number", arms, *circles, *rest]
    far = ("--rand.min-distance", "90", "--rand.max-distance", str(draw.uniform(150.0, 280.0)))
    varied = ("--rand.random-lanenumber", "--rand.random-priority")
    return ["-r", "--rand.iterations", "20", *far, *varied, *rest]


def _world(draw: Random, network: Network, number: int) -> World | None:
    """Put an ego and others on a network; None if it has no way that is long enough."""
    after = followers(network)
    way = _way(draw, network, after)
    if way is None:
        return None
    first = network.edge_lanes(way[0])
    lane, start = draw.randrange(len(first)), draw.uniform(CLEAR, 0.4 * first[0].length)
    speed = 0.8 * first[0].speed_limit
    ego = Vehicle("ego", "car", way, lane, start, speed)
    near = _near(network, way, after)
    taken = [(way[0], lane, start)]
    others: dict[int, Vehicle] = {}
    wanted = draw.randint(FEWEST, MOST)
    for _ in range(TRIES):
        one = _other(draw, network, after, way if draw.random() < 0.5 else near)
        if len(others) < wanted and one is not None and _free(one, taken):
            others[len(others) + 1] = one
            taken.append((one.route[0], one.lane, one.position))
    edges = {
        edge: Edge(edge, "", "", len(lanes), lanes[0].speed_limit, 0, lanes[0].length)
        for edge in way
        if (lanes := network.edge_lanes(edge))
    }
    return World("none", number, Roads((), edges), ego, others, (), ())


def _way(
    draw: Random, network: Network, after: dict[str, tuple[str, ...]]
) -> tuple[str, ...] | None:
    """Draw a way for the ego that takes no edge twice, and whose first and last edges are long."""
    starts = [e for e in sorted(after) if network.edge_lanes(e)[0].length >= LEAST]
    wanted = draw.uniform(*LONG)
    for _ in range(TRIES if starts else 0):
        way = walk(network, after, draw.choice(starts), draw)
        length = 0.0
        for k, edge in enumerate(way):
            long = network.edge_lanes(edge)[0].length
            length += long
            if k and length >= wanted and long >= LEAST:
                return way[: k + 1]
    return None


def _near(
    network: Network, way: Sequence[str], after: dict[str, tuple[str, ...]]
) -> tuple[str, ...]:
    """Return the edges that lead to an edge of a way, or to one that follows such an edge."""
    ends = {end for edge in way for end in (edge, *after.get(edge, ()))}
    return tuple(e for e in sorted(after) if ends & {*after[e]})


def _other(
    draw: Random, network: Network, after: dict[str, tuple[str, ...]], places: Sequence[str]
) -> Vehicle | None:
    """Draw a vehicle on one of some edges, with a way of its own."""
    edge = draw.choice(places)
    lanes = network.edge_lanes(edge)
    length = lanes[0].length
    if length < 3.0 * CLEAR:
        return None
    way = walk(network, after, edge, draw)
    limit = lanes[0].speed_limit
    top = limit * draw.choice((draw.uniform(0.35, 0.7), draw.uniform(0.7, 1.0), 1.0))
    halt = None
    lane, start = draw.randrange(len(lanes)), draw.uniform(CLEAR, length - CLEAR)
    if draw.random() < HALTS and start + 2.0 * CLEAR < length:
        place = draw.uniform(start + CLEAR, length - CLEAR)
        halt = Halt(edge, lane, place, draw.uniform(3.0, 20.0), False)
    return Vehicle("other", draw.choice(SHAPES), way, lane, start, 0.9 * top, top, halt)


def _free(one: Vehicle, taken: Sequence[tuple[str, int, float]]) -> bool:
    return all(
        (one.route[0], one.lane) != (edge, lane) or abs(one.position - position) >= APART
        for edge, lane, position in taken
    )
