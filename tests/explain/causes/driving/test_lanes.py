"""Who is in our lane, and in the one beside it."""

import math

import pytest

from planner.record.places import RoadFacts, RoadPlace, RouteStep
from tests.explain.facts.scenes import Actor, made, straight
from xavi_dialogue.domain.answers import MotionCause
from xavi_dialogue.explain.causes.driving.blocking import blocking, in_lane_beside
from xavi_dialogue.explain.causes.driving.slowness import in_lane_ahead, leader
from xavi_dialogue.explain.causes.driving.yielding import leads
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.ride import Ride


def place(
    limit: float = 14.0, lane: int | None = 0, edge: str = "a", ring: bool = False
) -> RoadPlace:
    return RoadPlace(edge, lane, 3, limit, lane is None, ring)


def with_road(
    road: RoadFacts | None, until: float = 8.0, speed: float = 10.0, **other: object
) -> Ride:
    """At a steady speed; each decision has the same road."""
    path = other.pop("path", straight(0.0, 0.0, speed))
    return made({0: Actor(path)}, until, roads=lambda _: road, **other)  # type: ignore[arg-type]


def ahead(*steps: RouteStep, distance: float | None = None, limit: float = 14.0) -> RoadFacts:
    return RoadFacts({0: place(limit)}, steps, distance)


def lanes(
    *others: tuple[float, float, float, int], ours: float = 10.0, limit: float = 14.0
) -> Ride:
    """Others by place, speed and lane; we are in the middle one of three."""
    actors = {0: Actor(straight(0.0, 0.0, ours))}
    places = {0: place(limit, 1)}
    for k, (x, y, speed, number) in enumerate(others, 1):
        actors[k] = Actor(straight(x, y, speed))
        places[k] = place(limit, number)
    return made(actors, 0.0, roads=lambda _: RoadFacts(places))


@pytest.mark.parametrize(
    ("x", "y", "told"),
    [
        (54.7, 0.0, True),  # 49.9 m, 5 s are 50
        (54.9, 0.0, False),
        (30.0, 2.0, True),
        (30.0, 2.1, True),  # 8 % of the way aside
        (30.0, 2.5, False),
        (-20.0, 0.0, False),
    ],
)
def test_who_drives_in_front_of_us(x: float, y: float, told: bool) -> None:
    whole = lanes((x, y, 8.0, 1))
    found = leader(whole, World(whole), 0.0)
    assert (found is not None) is told


def test_the_nearest_in_our_lane_leads() -> None:
    whole = lanes((40.0, 0.0, 8.0, 1), (20.0, 0.0, 8.0, 1), (15.0, 1.0, 8.0, 2))
    assert [look.vehicle for look in in_lane_ahead(whole, World(whole), 0.0, 90.0)] == [2, 1]
    slow = lanes((16.7, 0.0, 8.0, 1), ours=1.0)
    assert leader(slow, World(slow), 0.0) is not None
    assert (
        leader(
            lanes((16.9, 0.0, 8.0, 1), ours=1.0), World(lanes((16.9, 0.0, 8.0, 1), ours=1.0)), 0.0
        )
        is None
    )
    bare = made({0: Actor(straight(0.0, 0.0, 10.0)), 1: Actor(straight(30.0, 2.1, 8.0))}, 0.0)
    assert leader(bare, World(bare), 0.0) is None


@pytest.mark.parametrize(
    ("x", "y", "speed", "told"),
    [
        (40.0, 0.0, 11.9, True),
        (40.0, 0.0, 12.1, False),  # not 2 m/s slower than the limit
        (84.7, 0.0, 5.0, True),  # 79.9 m; eight seconds are 80
        (84.9, 0.0, 5.0, False),
        (-20.0, 0.0, 5.0, False),
    ],
)
def test_who_makes_us_leave_the_lane(x: float, y: float, speed: float, told: bool) -> None:
    whole = lanes((x, y, speed, 1))
    found = blocking(whole, World(whole), 0.0, "change-left")
    assert found == (MotionCause("leader", 1, speed=speed) if told else None)


@pytest.mark.parametrize(
    ("x", "speed", "lane", "told"),
    [
        (60.0, 5.0, 2, False),  # no faster there
        (60.0, 5.1, 2, True),
        (60.0, 5.0, 0, True),
        (-30.0, 5.0, 2, True),
        (84.9, 5.0, 2, True),  # too far to matter
    ],
)
def test_nobody_leaves_a_lane_for_one_that_is_as_slow(
    x: float, speed: float, lane: int, told: bool
) -> None:
    whole = lanes((40.0, 0.0, 5.0, 1), (x, 3.5 * (lane - 1), speed, lane))
    assert (blocking(whole, World(whole), 0.0, "change-left") is not None) is told


def test_who_comes_into_view_a_moment_later_counts() -> None:
    """At 1 s it is seen, by then in the lane that was ours."""

    def roads(time: float) -> RoadFacts:
        return RoadFacts({0: place(14.0, 1 if time < 1.0 else 2), 1: place(14.0, 1)})

    actors = {0: Actor(straight(0.0, 0.0, 10.0)), 1: Actor(straight(40.0, 0.0, 5.0), since=1.0)}
    whole = made(actors, 2.0, roads=roads)
    assert blocking(whole, World(whole), 0.0, "change-left") == MotionCause("leader", 1, speed=5.0)
    early = made(actors, 2.0, roads=roads, now=0.9)
    assert blocking(early, World(early), 0.0, "change-left") is None


@pytest.mark.parametrize(
    ("x", "speed", "lane", "change", "kind"),
    [
        (0.0, 10.0, 2, "change-left", "lane-beside"),
        (6.8, 10.0, 2, "change-left", "lane-beside"),  # 6.9 m of room and lengths
        (-6.8, 10.0, 2, "change-left", "lane-beside"),
        (7.0, 10.0, 2, "change-left", None),
        (0.0, 10.0, 2, "change-right", None),
        (0.0, 10.0, 0, "change-right", "lane-beside"),
        (40.0, 8.0, 2, "change-left", "lane-ahead"),
        (40.0, 8.1, 2, "change-left", None),
        (84.7, 8.0, 2, "change-left", "lane-ahead"),
        (84.9, 8.0, 2, "change-left", None),
        (-40.0, 5.0, 2, "change-left", None),
    ],
)
def test_who_is_in_the_lane_beside_ours(
    x: float, speed: float, lane: int, change: str, kind: str | None
) -> None:
    whole = lanes((x, 3.5 * (lane - 1), speed, lane))
    found = in_lane_beside(whole, World(whole), 0.0, change)  # type: ignore[arg-type]
    assert (None if found is None else (found.kind, found.vehicle)) == (kind and (kind, 1))
    if kind == "lane-ahead":
        assert found is not None
        assert found.speed == speed
        assert found.value == pytest.approx(math.hypot(x - 4.8, 1.7), abs=0.01)


def test_standing_we_look_as_if_we_drove_slowly() -> None:
    whole = lanes((60.0, 3.5, 6.0, 2), (30.0, 3.5, 6.0, 2), ours=0.0)
    found = in_lane_beside(whole, World(whole), 0.0, "change-left")
    assert found is not None
    assert (found.kind, found.vehicle) == ("lane-ahead", 2)  # the nearer
    inside = made(
        {0: Actor(straight(0.0, 0.0, 5.0))}, 0.0, roads=lambda _: RoadFacts({0: place(lane=None)})
    )
    assert in_lane_beside(inside, World(inside), 0.0, "change-left") is None
    assert in_lane_beside(with_road(None), World(with_road(None)), 0.0, "change-left") is None


@pytest.mark.parametrize(
    ("x", "y", "turn", "told"),
    [
        (20.0, 1.9, 0.0, True),
        (20.0, 2.1, 0.0, False),
        (-20.0, 0.0, 0.0, False),
        (0.5, 0.0, 0.0, True),
        (20.0, 0.0, 180.0, False),
    ],
)
def test_who_leads_us(x: float, y: float, turn: float, told: bool) -> None:
    heading = math.radians(turn)
    whole = made({0: Actor(straight(0.0, 0.0, 5.0)), 1: Actor(straight(x, y, 5.0, heading))}, 0.0)
    assert leads(World(whole), 1, 0.0) is told
    assert not leads(World(whole), None, 0.0)
    assert not leads(World(whole), 5, 0.0)
