"""Stories of drivers that react: a vehicle matters by what it makes another do, or gives way."""

from dataclasses import replace
from random import Random

from benchmarks.worlds.roads import crossing, straight
from benchmarks.worlds.stories import JUNCTION, SHAPES, meeting, starting
from benchmarks.worlds.values import Roads, Sketch, Vehicle

_STAYS = ("lcSpeedGain", "0")


def interactive(draw: Random) -> Sketch:
    """Draw a story in which another driver's reaction decides what the ego does."""
    return draw.choice((_waits_to_turn, _waits_at_the_line, _pulls_out, _lets_in))(draw)


def _waits_to_turn(draw: Random) -> Sketch:
    """Draw a vehicle ahead that turns left and waits for an oncoming one; the ego goes straight."""
    roads = crossing(draw, arms=("north",))
    return _waiting(draw, roads, ("west_in", "east_out"), "north_out")


def _waits_at_the_line(draw: Random) -> Sketch:
    """Draw a vehicle ahead that waits to turn left for one to which the ego need not give way."""
    roads = crossing(draw, arms=("south",))
    return _waiting(draw, roads, ("south_in", "east_out"), "west_out")


def _waiting(draw: Random, roads: Roads, route: tuple[str, str], end: str) -> Sketch:
    """Draw the ego behind a vehicle with another destination, which waits for one from the east."""
    edge = roads.edges[route[0]]
    room = edge.length - JUNCTION
    first = draw.uniform(20.0, min(room - 45.0, 45.0))  # [m] to the junction
    gap = draw.uniform(28.0, min(room - first - 12.0, 55.0))
    ego = starting(draw, route, edge, room - first - gap)
    shape = draw.choice(SHAPES)
    ahead = Vehicle("waits", shape, (edge.id, end), 0, room - first, ego.speed)
    comes = meeting(draw, roads.edges, "east", first / (0.7 * edge.speed))
    top = comes.speed * draw.uniform(0.4, 0.9)
    return Sketch(roads, ego, (ahead, replace(comes, speed=top, top=top)))


def _pulls_out(draw: Random) -> Sketch:
    """Draw a vehicle in the next lane that pulls out before the ego to pass a slow one."""
    roads = straight(draw, 2, (350.0, 500.0))
    main = roads.edges["main"]
    ego = replace(starting(draw, ("main",), main, draw.uniform(10.0, 30.0)), lane=1)
    place = ego.position + draw.uniform(18.0, 40.0)
    top = main.speed * draw.uniform(0.5, 0.75)
    keep = (("lcKeepRight", "0"), ("lcStrategic", "0"))
    eager = (*keep, ("lcSpeedGain", "10"), ("lcAssertive", "2"))
    pulling = Vehicle("pulling-out", "car", ("main",), 0, place, top, top, manners=eager)
    far = place + draw.uniform(25.0, 60.0)
    slow = main.speed * draw.uniform(0.1, 0.3)
    shape = draw.choice(SHAPES)
    held = Vehicle("slow", shape, ("main",), 0, far, slow, slow, manners=(*keep, _STAYS))
    return Sketch(roads, ego, (pulling, held))


def _lets_in(draw: Random) -> Sketch:
    """Draw a slow vehicle ahead, and one behind in the next lane that brakes to let the ego in."""
    roads = straight(draw, 2, (350.0, 500.0))
    main = roads.edges["main"]
    ego = starting(draw, ("main",), main, draw.uniform(40.0, 60.0))
    place = ego.position + draw.uniform(35.0, 60.0)
    top = main.speed * draw.uniform(0.2, 0.4)
    keep = (("lcKeepRight", "0"), ("lcStrategic", "0"), _STAYS)
    slow = Vehicle("slow", draw.choice(SHAPES), ("main",), 0, place, top, top, manners=keep)
    back = ego.position - draw.uniform(12.0, 30.0)
    pace = main.speed * draw.uniform(0.9, 1.0)
    lets = Vehicle("lets-in", draw.choice(SHAPES), ("main",), 1, back, pace, pace, manners=keep)
    return Sketch(roads, ego, (slow,), (lets,))
