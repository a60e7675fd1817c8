"""Stories of several vehicles: joint causes, either of two, pre-emption, and no cause."""

from dataclasses import replace
from random import Random

from benchmarks.worlds.roads import crossing, straight
from benchmarks.worlds.stories import JUNCTION, SHAPES, approaching, meeting, starting
from benchmarks.worlds.values import Edge, Sketch, Vehicle


def both(draw: Random) -> Sketch:
    """Draw a story of two slow vehicles ahead, side by side; each alone could be passed."""
    roads = straight(draw, 2, (350.0, 500.0))
    main = roads.edges["main"]
    ego = starting(draw, ("main",), main, draw.uniform(10.0, 40.0))
    place = ego.position + draw.uniform(35.0, 65.0)
    top = main.speed * draw.uniform(0.25, 0.45)
    keep = (("lcKeepRight", "0"), ("lcStrategic", "0"), ("lcSpeedGain", "0"))
    ahead = Vehicle("slow", draw.choice(SHAPES), ("main",), 0, place, top, top, manners=keep)
    near = place + draw.uniform(-8.0, 8.0)
    beside = replace(ahead, role="beside", shape=draw.choice(SHAPES), lane=1, position=near)
    return Sketch(roads, ego, (ahead, beside))


def either(draw: Random) -> Sketch:
    """Draw a story of two vehicles at a junction at about the same time, who both go first."""
    turns = draw.random() < 0.4
    roads = crossing(draw, arms=("north",) if turns else ("south",))
    if turns:
        ego, time = approaching(draw, roads.edges, "west", "north_out")
        first = meeting(draw, roads.edges, "east", time)
        return Sketch(roads, ego, (first, _behind(draw, first)))
    end = draw.choice(["west_out", "west_out"] + ["north_out"] * ("north_out" in roads.edges))
    ego, time = approaching(draw, roads.edges, "south", end)
    first = meeting(draw, roads.edges, "west", time)
    if draw.random() < 0.5:
        return Sketch(roads, ego, (first, _behind(draw, first)))
    return Sketch(roads, ego, (first, meeting(draw, roads.edges, "east", time)))


def pre_empted(draw: Random) -> Sketch:
    """Draw a story of a slow vehicle ahead in one lane, with an equally slow one ahead of it."""
    roads = straight(draw, 1, (320.0, 460.0))
    ego, ahead = _slow_ahead(draw, roads.edges["main"])
    assert ahead.top is not None
    place = ahead.position + draw.uniform(20.0, 38.0)
    top = ahead.top * draw.uniform(0.95, 1.05)
    further = replace(ahead, shape=draw.choice(SHAPES), position=place, top=top, speed=top)
    return Sketch(roads, ego, (ahead, further))


def distractor(draw: Random) -> Sketch:
    """Draw a story of a vehicle in the ego's way only because another is in its own."""
    if draw.random() < 0.5:
        roads = straight(draw, 1, (320.0, 460.0))
        ego, slow = _slow_ahead(draw, roads.edges["main"])
        place = slow.position + draw.uniform(16.0, 26.0)
        behind = replace(slow, role="held-up", shape=draw.choice(SHAPES), top=None)
        return Sketch(roads, ego, (replace(slow, position=place),), (behind,))
    roads = crossing(draw, arms=("south",))
    end = draw.choice(["west_out", "east_out"])
    ego, time = approaching(draw, roads.edges, "south", end)
    arm = "west" if end == "east_out" or draw.random() < 0.5 else "east"
    slow = meeting(draw, roads.edges, arm, time)
    place = min(ego.position + draw.uniform(16.0, 26.0), roads.edges["south_in"].length - 14.0)
    waits = Vehicle("held-up", "car", ego.route, 0, place, ego.speed)
    return Sketch(roads, ego, (slow,), (waits,))


def nobody(draw: Random) -> Sketch:
    """Draw a story in which the ego slows down for a turn as it would alone, behind a vehicle."""
    arm = draw.choice(("north", "south"))
    roads = crossing(draw, arms=(arm,))
    ego, _ = approaching(draw, roads.edges, "west", f"{arm}_out")
    place = min(
        ego.position + draw.uniform(22.0, 45.0), roads.edges["west_in"].length - JUNCTION - 4.0
    )
    route = draw.choice((ego.route, ("west_in", "east_out")))
    ahead = Vehicle("ahead", draw.choice(SHAPES), route, 0, place, roads.edges["west_in"].speed)
    return Sketch(roads, ego, (), (ahead,))


def _slow_ahead(draw: Random, main: Edge) -> tuple[Vehicle, Vehicle]:
    """Draw the ego, and a slow vehicle ahead of it."""
    ego = starting(draw, ("main",), main, draw.uniform(10.0, 40.0))
    place = ego.position + draw.uniform(28.0, 55.0)
    top = main.speed * draw.uniform(0.3, 0.5)
    return ego, Vehicle("slow", draw.choice(SHAPES), ("main",), 0, place, top, top)


def _behind(draw: Random, first: Vehicle) -> Vehicle:
    """Draw another vehicle close behind one that crosses."""
    place = max(first.position - draw.uniform(16.0, 26.0), 3.0)
    return replace(first, shape="car", position=place)
