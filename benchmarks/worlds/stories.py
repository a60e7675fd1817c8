"""Stories with one cause: the ego, the vehicle that is to matter to it, and their roads."""

from collections.abc import Mapping
from random import Random

from benchmarks.worlds.roads import crossing, straight
from benchmarks.worlds.values import Edge, Halt, Shape, Sketch, Vehicle

JUNCTION = 10.0  # [m] from the middle of a junction to its edges
SHAPES: tuple[Shape, ...] = ("car", "car", "van", "truck", "bus", "motorcycle")
TALL: tuple[Shape, ...] = ("truck", "bus")


def leader(draw: Random) -> Sketch:
    """Draw a story of one lane, in which a vehicle ahead is slow or stands for a while."""
    roads = straight(draw, 1, (260.0, 420.0))
    main = roads.edges["main"]
    ego = starting(draw, ("main",), main, draw.uniform(10.0, 40.0))
    place = ego.position + draw.uniform(30.0, 65.0)
    shape = draw.choice(SHAPES)
    if draw.random() < 0.3:
        stand = Halt("main", 0, place + draw.uniform(40.0, 70.0), draw.uniform(5.0, 10.0), False)
        planted = Vehicle("stopping", shape, ("main",), 0, place, 0.7 * main.speed, halt=stand)
    else:
        top = main.speed * draw.uniform(0.3, 0.6)
        planted = Vehicle("slow", shape, ("main",), 0, place, min(top, ego.speed), top)
    return Sketch(roads, ego, (planted,))


def leader_on_two_lanes(draw: Random) -> Sketch:
    """Draw a story of two lanes, in which a slow vehicle ahead can be overtaken."""
    roads = straight(draw, 2, (350.0, 500.0))
    main = roads.edges["main"]
    ego = starting(draw, ("main",), main, draw.uniform(10.0, 40.0))
    place = ego.position + draw.uniform(35.0, 70.0)
    top = main.speed * draw.uniform(0.2, 0.45)
    planted = Vehicle("slow", draw.choice(SHAPES), ("main",), 0, place, top, top)
    return Sketch(roads, ego, (planted,))


def cross(draw: Random) -> Sketch:
    """Draw a story of the ego at a give-way line while a vehicle comes on the main road."""
    roads = crossing(draw, arms=("south",))
    ends = ["west_out", "east_out"] + ["north_out"] * ("north_out" in roads.edges)
    end = draw.choice(ends)
    ego, time = approaching(draw, roads.edges, "south", end)
    came = "west" if end == "east_out" or draw.random() < 0.5 else "east"
    planted = meeting(draw, roads.edges, came, time)
    return Sketch(roads, ego, (planted,))


def merge(draw: Random) -> Sketch:
    """Draw a story of a vehicle that joins the ego's lane from a side road or the next lane."""
    return _joining(draw) if draw.random() < 0.5 else _cutting_in(draw)


def oncoming(draw: Random) -> Sketch:
    """Draw a story in which the ego turns left, and a vehicle comes towards it."""
    roads = crossing(draw, arms=("north",))
    ego, time = approaching(draw, roads.edges, "west", "north_out")
    return Sketch(roads, ego, (meeting(draw, roads.edges, "east", time),))


def occluder(draw: Random) -> Sketch:
    """Draw a story in which a tall vehicle hides, for some time, the one that matters."""
    return draw.choice((_behind_a_standing_one, _behind_one_that_leaves, _behind_one_ahead))(draw)


ONE = (leader, leader_on_two_lanes, cross, merge, oncoming, occluder)


def one(draw: Random) -> Sketch:
    """Draw a story in which a single vehicle matters."""
    return draw.choice(ONE)(draw)


def _joining(draw: Random) -> Sketch:
    """Draw a slow vehicle that turns from a side road into the ego's."""
    arm = draw.choice(("south", "north"))
    roads = crossing(draw, arms=(arm,))
    main = roads.edges["west_in"]
    gap = main.speed * draw.uniform(3.5, 6.0)
    start = main.length - JUNCTION - gap
    ego = starting(draw, ("west_in", "east_out"), main, start)
    side = roads.edges[f"{arm}_in"]
    place = side.length - JUNCTION - draw.uniform(1.0, 12.0)
    top = main.speed * draw.uniform(0.3, 0.6)
    planted = Vehicle(
        "joining",
        draw.choice(SHAPES),
        (f"{arm}_in", "east_out"),
        0,
        place,
        min(4.0, top),
        top,
        manners=(("jmTimegapMinor", "0.3"), ("impatience", "0.5")),
    )
    return Sketch(roads, ego, (planted,))


def _cutting_in(draw: Random) -> Sketch:
    """Draw a vehicle ahead in the left lane that crosses the ego's lane to turn right."""
    roads = crossing(draw, lanes=2, arms=("south",))
    main = roads.edges["west_in"]
    ego = starting(draw, ("west_in", "east_out"), main, draw.uniform(15.0, 60.0))
    place = ego.position + draw.uniform(14.0, 28.0)
    speed = main.speed * draw.uniform(0.5, 0.75)
    planted = Vehicle(
        "cutting-in",
        draw.choice(("car", "van")),
        ("west_in", "south_out"),
        1,
        place,
        min(speed, ego.speed),
        speed,
        manners=(("lcStrategic", "1.5"), ("lcAssertive", "3"), ("decel", "2")),
    )
    return Sketch(roads, ego, (planted,))


def _behind_a_standing_one(draw: Random) -> Sketch:
    """Draw a tall vehicle that stands on the opposite lane near a give-way line."""
    roads = crossing(draw, arms=("south",))
    end = draw.choice(["west_out", "east_out"] + ["north_out"] * ("north_out" in roads.edges))
    ego, time = approaching(draw, roads.edges, "south", end)
    planted = meeting(draw, roads.edges, "west", time)
    back = draw.uniform(12.0, 30.0)
    stand = Halt("south_out", 0, back, 300.0, False)
    tall = Vehicle("hiding", draw.choice(TALL), ("south_out",), 0, back, 0.0, halt=stand)
    return Sketch(roads, ego, (planted,), (tall,))


def _behind_one_ahead(draw: Random) -> Sketch:
    """Draw a tall vehicle ahead that goes straight on, while the ego turns left."""
    roads = crossing(draw, arms=("north",))
    ego, time = approaching(draw, roads.edges, "west", "north_out")
    planted = meeting(draw, roads.edges, "east", time)
    place = ego.position + draw.uniform(20.0, 26.0)
    speed = roads.edges["west_in"].speed
    tall = Vehicle("hiding", draw.choice(TALL), ("west_in", "east_out"), 0, place, speed)
    return Sketch(roads, ego, (planted,), (tall,))


def _behind_one_that_leaves(draw: Random) -> Sketch:
    """Draw a tall vehicle that drives slowly along the road from which the ego comes."""
    sketch = _behind_a_standing_one(draw)
    top = draw.uniform(1.5, 5.0)
    place = draw.uniform(12.0, 20.0)
    tall = Vehicle("hiding", draw.choice(TALL), ("south_out",), 0, place, top, top)
    return Sketch(sketch.roads, sketch.ego, sketch.planted, (tall,))


def starting(draw: Random, route: tuple[str, ...], edge: Edge, place: float) -> Vehicle:
    """Draw the ego on its way at some speed below the limit."""
    return Vehicle("ego", "car", route, 0, place, edge.speed * draw.uniform(0.6, 0.95))


def approaching(
    draw: Random, edges: Mapping[str, Edge], arm: str, end: str
) -> tuple[Vehicle, float]:
    """Draw the ego on its way to the junction, with the time [s] at which it roughly arrives."""
    edge = edges[f"{arm}_in"]
    way = min(draw.uniform(45.0, 85.0), edge.length - JUNCTION - 15.0)
    ego = starting(draw, (edge.id, end), edge, edge.length - JUNCTION - way)
    return ego, way / (0.85 * edge.speed)


def meeting(draw: Random, edges: Mapping[str, Edge], arm: str, time: float) -> Vehicle:
    """Draw a vehicle on the main road that comes to the junction at about a time [s]."""
    edge = edges[f"{arm}_in"]
    out = {"west": "east_out", "east": "west_out"}[arm]
    top = edge.speed * draw.uniform(0.6, 1.0)
    way = top * (time + draw.uniform(-0.5, 2.5))
    place = max(edge.length - JUNCTION - way, 12.0)
    return Vehicle("crossing", draw.choice(SHAPES), (edge.id, out), 0, place, top, top)
