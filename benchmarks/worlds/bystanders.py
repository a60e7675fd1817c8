"""Random bystanders: vehicles that are not to matter to the ego."""

from collections.abc import Callable, Sequence
from random import Random

from benchmarks.worlds.stories import JUNCTION, SHAPES
from benchmarks.worlds.values import Edge, Halt, Sketch, Vehicle

MOST = 8
APART = 18.0  # [m] least distance between the fronts of two that start in one lane
TRIES = 8  # attempts to find a free place, per vehicle
FOREVER = 300.0  # [s] longer than any ride


def bystanders(draw: Random, sketch: Sketch) -> list[Vehicle]:
    """Draw some bystanders, possibly none, each with its own place."""
    there = [sketch.ego, *sketch.cast]
    wanted = draw.randint(0, MOST + 1 - len(sketch.cast))
    found: list[Vehicle] = []
    for _ in range(wanted * TRIES):
        one = draw.choice(PLACES)(draw, sketch)
        if len(found) < wanted and one is not None and _free(one, [*there, *found]):
            found.append(one)
    return found


def _free(one: Vehicle, others: Sequence[Vehicle]) -> bool:
    return all(
        (one.route[0], one.lane) != (other.route[0], other.lane)
        or abs(one.position - other.position) >= APART
        for other in others
    )


def _driving(draw: Random, role: str, edge: Edge, lane: int = 0) -> Vehicle:
    place = draw.uniform(14.0, edge.length - JUNCTION - 8.0)
    top = edge.speed * draw.uniform(0.7, 1.0)
    return Vehicle(role, draw.choice(SHAPES), (edge.id,), lane, place, 0.9 * top, top)


def _parked(draw: Random, sketch: Sketch) -> Vehicle | None:
    """Draw a vehicle parked beside a road that the ego does not take."""
    edges = [e for e in sketch.roads.edges.values() if e.id not in _ways(sketch)]
    return _standing(draw, "parked", draw.choice(edges), beside=True)


def _standing(draw: Random, role: str, edge: Edge, *, beside: bool) -> Vehicle:
    place = draw.uniform(14.0, edge.length - JUNCTION - 8.0)
    stand = Halt(edge.id, 0, place, FOREVER, beside)
    return Vehicle(role, draw.choice(SHAPES), (edge.id,), 0, place, 0.0, halt=stand)


def _aside(draw: Random, sketch: Sketch) -> Vehicle | None:
    """Draw a vehicle on a road that does not meet the ego's."""
    edge = sketch.roads.edges[draw.choice(("aside_there", "aside_back"))]
    return _driving(draw, "other-road", edge)


def _behind(draw: Random, sketch: Sketch) -> Vehicle | None:
    """Draw a vehicle far behind the ego, and not faster; None if there is no room."""
    ego, edge = sketch.ego, sketch.roads.edges[sketch.ego.route[0]]
    room = ego.position - 35.0
    if room < 14.0:
        return None
    lane, place = draw.randrange(edge.lanes), draw.uniform(14.0, room)
    top = edge.speed * draw.uniform(0.5, 0.9)
    return Vehicle("behind", draw.choice(SHAPES), ego.route, lane, place, 0.9 * top, top)


def _leaving(draw: Random, sketch: Sketch) -> Vehicle | None:
    """Draw a vehicle that drives away from the junction, or past the ego on a straight road."""
    edges = [e for e in sketch.roads.edges.values() if e.id == "back" or e.id.endswith("_out")]
    edge = draw.choice(edges)
    lane = draw.randrange(edge.lanes)
    if edge.id in _ways(sketch):  # ahead of the ego: as fast as it may be
        place = draw.uniform(40.0, edge.length - 20.0)
        return Vehicle("leaving", draw.choice(SHAPES), (edge.id,), lane, place, edge.speed)
    role = "oncoming" if edge.id in _opposite(sketch) else "leaving"
    return _driving(draw, role, edge, lane)


def _passing(draw: Random, sketch: Sketch) -> Vehicle | None:
    """Draw a fast vehicle ahead of the ego, in a lane that the ego does not need."""
    ego, edge = sketch.ego, sketch.roads.edges[sketch.ego.route[0]]
    place = ego.position + draw.uniform(5.0, 90.0)
    if edge.lanes < 2 or place > edge.length - JUNCTION - 8.0:
        return None
    keep = (("lcKeepRight", "0"), ("lcStrategic", "0"))
    shape = draw.choice(SHAPES)
    return Vehicle("other-lane", shape, ego.route, 1, place, edge.speed, manners=keep)


def _past(draw: Random, sketch: Sketch) -> Vehicle | None:
    """Draw an oncoming vehicle that goes straight on; None if the ego crosses its way."""
    if sketch.ego.route != ("west_in", "east_out"):
        return None
    edge = sketch.roads.edges["east_in"]
    one, lane = _driving(draw, "oncoming", edge), draw.randrange(edge.lanes)
    route = ("east_in", "west_out")
    return Vehicle(one.role, one.shape, route, lane, one.position, one.speed, one.top)


def _ways(sketch: Sketch) -> set[str]:
    """Return the edges that matter to the story."""
    return {*sketch.ego.route, *(edge for one in sketch.cast for edge in one.route)}


def _opposite(sketch: Sketch) -> set[str]:
    swap = {"_in": "_out", "_out": "_in"}
    ends = {e.rpartition("_")[0] + swap.get("_" + e.rpartition("_")[2], "") for e in _ways(sketch)}
    return {*ends, "back"}


PLACES: tuple[Callable[[Random, Sketch], Vehicle | None], ...] = (
    _parked,
    _aside,
    _behind,
    _leaving,
    _leaving,
    _passing,
    _past,
)
