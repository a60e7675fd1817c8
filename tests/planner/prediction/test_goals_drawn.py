"""Goals on roads drawn by hand: where they lie, and what they are called."""

import math
from dataclasses import replace

import pytest

from planner.prediction.goals import PLACES, Goal, goals_in_view, stopping_time
from planner.record.trace import EgoGoal
from planner.roads.trajectory import Roads
from sim.scene import Point
from tests.planner.drives import avenue, crossing
from tests.planner.nets import drawn, lane, link, on_lane

VIEW = 100.0


def known(roads: Roads, name: str, offset: float, view: float = VIEW) -> list[Goal]:
    """The goals of a vehicle on a lane, without stopping."""
    *found, stop = goals_in_view(roads, (on_lane(roads, name, offset),), view)
    assert (stop.kind, stop.place, stop.target) == ("stop", PLACES["stop"], None)
    return found


def target(roads: Roads, name: str, offset: float, view: float = VIEW) -> tuple[str, float]:
    """Edge and position [m] of the only goal but stopping."""
    (on,) = known(roads, name, offset, view)
    assert on.target is not None
    assert on.target.lane is None
    return on.target.edge, on.target.position


@pytest.mark.parametrize(
    ("offset", "position"),
    [(50.0, 150.0), (0.0, 100.0), (498.0, 598.0), (550.0, 599.0), (599.5, 599.5)],
)
def test_on_an_open_road_the_goal_lies_as_far_ahead_as_one_sees(
    offset: float, position: float
) -> None:
    assert target(avenue(), "road_0", offset) == ("road", position)


@pytest.mark.parametrize(
    ("name", "offset", "view", "place"),
    [
        ("in_0", 30.0, 60.0, ("in", 90.0)),
        ("in_0", 30.0, 100.0, ("out", 20.0)),  # 70 m to the junction and 10 m across it
        (":J_0", 2.0, 100.0, ("out", 92.0)),
        ("out_0", 280.0, 100.0, ("out", 289.0)),
    ],
)
def test_where_a_road_just_goes_on_its_goal_lies_beyond_the_joint(
    name: str, offset: float, view: float, place: tuple[str, float]
) -> None:
    assert target(crossing(yields=False), name, offset, view) == place


def test_a_goal_is_never_before_the_start_of_its_road() -> None:
    lanes = [lane("in_0", [(0.0, 0.0), (50.0, 0.0)]), lane("stub_0", [(50.0, 0.0), (50.5, 0.0)])]
    roads = drawn(lanes, [link("in_0", "stub_0")])
    assert target(roads, "in_0", 10.0) == ("stub", 0.0)


def test_straight_on_with_giving_way_is_an_exit() -> None:
    (on,) = known(crossing(), "in_0", 30.0)
    assert (on.kind, on.place) == ("exit-straight", "the road straight on")
    assert on.target == EgoGoal("out", 4.0, None)
    (inside,) = known(crossing(), ":J2_0", 1.0)
    assert (inside.kind, inside.target) == ("exit-straight", EgoGoal("out", 4.0, None))


def junction(beyond: float = 80.0) -> Roads:
    """A road with two lanes, from which one turns right or goes straight on, or turns left."""
    lanes = [
        lane("in_0", [(0.0, 0.0), (90.0, 0.0)]),
        lane("in_1", [(0.0, 3.5), (90.0, 3.5)]),
        lane("on_0", [(100.0, 0.0), (100.0 + beyond, 0.0)]),
        lane("south_0", [(95.0, -5.0), (95.0, -5.0 - beyond)]),
        lane("north_0", [(95.0, 8.0), (95.0, 8.0 + beyond)]),
        lane("west_0", [(90.0, 7.0), (90.0 - beyond, 7.0)]),
    ]
    links = [
        link("in_0", "south_0", "right", index=0),
        link("in_0", "on_0", "straight", index=1),
        link("in_1", "north_0", "left", index=2),
        link("in_1", "west_0", "turnaround", index=3),
    ]
    return drawn(lanes, links)


def test_the_roads_of_a_junction_share_what_stopping_leaves() -> None:
    roads = junction()
    both = tuple(on_lane(roads, name, 20.0) for name in ("in_0", "in_1"))
    goals = goals_in_view(roads, both, VIEW)
    assert {(g.kind, g.target.edge): g.prior for g in goals if g.target} == pytest.approx(
        {("exit-right", "south"): 0.33, ("continue", "on"): 0.33, ("exit-left", "north"): 0.33}
    )
    assert goals[-1].prior == 0.01
    assert len(goals) == 4


@pytest.mark.parametrize(("beyond", "position"), [(80.0, 4.0), (8.0, 4.0), (6.0, 3.0), (1.0, 0.5)])
def test_an_exit_is_taken_a_little_beyond_the_junction(beyond: float, position: float) -> None:
    for goal in known(junction(beyond), "in_0", 20.0):
        assert goal.target is not None
        assert goal.target.position == position


@pytest.mark.parametrize(("away", "view", "exits"), [(70.0, 75.0, 3), (70.0, 65.0, 1)])
def test_a_junction_counts_once_it_is_in_view(away: float, view: float, exits: int) -> None:
    assert len(known(junction(), "in_0", 90.0 - away, view)) == exits


def test_who_may_be_nowhere_can_but_stop() -> None:
    assert goals_in_view(avenue(), (), VIEW) == (Goal("stop", PLACES["stop"], None, 1.0),)


def parting(*ramp: Point) -> Roads:
    """A road of two lanes: the left one leads on to a road of two lanes, the other to a ramp."""
    lanes = [
        lane("in_0", [(0.0, 0.0), (50.0, 0.0)]),
        lane("in_1", [(0.0, 3.5), (50.0, 3.5)]),
        lane("on_0", [(50.0, 0.0), (300.0, 0.0)]),
        lane("on_1", [(50.0, 3.5), (300.0, 3.5)]),
        lane("ramp_0", [(50.0, 0.0), *ramp]),
    ]
    return drawn(lanes, [link("in_0", "ramp_0"), link("in_1", "on_1", index=1)])


@pytest.mark.parametrize(
    ("ramp", "side"),
    [
        ([(150.0, -30.0)], "right"),
        ([(150.0, 30.0)], "left"),
        ([(90.0, 8.0), (130.0, -60.0)], "left"),  # where it leads 40 m on counts
        ([(90.0, -8.0), (130.0, 60.0)], "right"),
    ],
)
def test_the_narrower_of_two_roads_straight_on_branches_off(ramp: list[Point], side: str) -> None:
    found = {g.target.edge: g.place for g in known(parting(*ramp), "in_0", 20.0) if g.target}
    assert found == {"ramp": f"the exit on the {side}", "on": "the road straight on"}


def _towards(point: Point, other: Point) -> Point:
    """One metre from a point towards another: there a lane of a ring ends, before it bends."""
    share = 1.0 / math.dist(point, other)
    return (
        point[0] + share * (other[0] - point[0]),
        point[1] + share * (other[1] - point[1]),
    )


def ring(entry: list[Point], *outs: list[Point], right: bool = True) -> Roads:
    """A square ring driven anticlockwise (else clockwise), entered at (0, 0) from the south."""
    corners = [(0.0, 0.0), (15.0, 0.0), (15.0, 30.0), (-15.0, 30.0), (-15.0, 0.0)]
    if not right:
        corners = [(-x, y) for x, y in corners]
    row = ["a", "b", "c", "d", "e"]
    begins = [_towards(corners[k], corners[k - 1]) for k in range(5)]
    lanes = [
        lane(f"{name}_0", [begins[k], corners[k], begins[(k + 1) % 5]], 8.0)
        for k, name in enumerate(row)
    ]
    lanes.append(lane("in_0", entry))
    lanes += [lane(f"out{k}_0", line) for k, line in enumerate(outs)]
    links = [link(f"{one}_0", f"{row[(k + 1) % 5]}_0", index=k) for k, one in enumerate(row)]
    links.append(link("in_0", "a_0", "right" if right else "left", yields_to=(4,), index=5))
    links += [
        link(f"{row[k + 1]}_0", f"out{k}_0", "right" if right else "left", index=6 + k)
        for k in range(len(outs))
    ]
    roads = drawn(lanes, links)
    return Roads(replace(roads.network, roundabouts=(frozenset(row),)))


EAST = [(15.0, 30.0), (80.0, 30.0)]
NORTH = [(-15.0, 30.0), (-15.0, 90.0)]
FROM_SOUTH = [(0.0, -80.0), (0.0, 0.0)]


def leaving(bearing: float, x: float = -15.0) -> list[Point]:
    """A road from the last corner of the ring that leads off at a bearing [deg] from north."""
    angle = math.radians(bearing)
    ways = [x + r * math.sin(angle) for r in (0.0, 60.0)]
    return list(zip(ways, [r * math.cos(angle) for r in (0.0, 60.0)], strict=True))


@pytest.mark.parametrize(
    ("out", "back"),
    [
        (leaving(180.0), True),
        (leaving(180.0, -5.0), True),
        (leaving(155.0), True),  # 2.7 rad, and 7 m aside 20 m on
        (leaving(145.0, -5.0), False),  # 2.5 rad
        (leaving(180.0, -25.0), False),  # another road beside it
        ([(-15.0, 0.0), (-15.0, -25.0), (-90.0, -25.0)], True),  # it bends away later
    ],
)
def test_a_road_that_leads_back_along_the_entry_is_no_goal(out: list[Point], back: bool) -> None:
    found = [
        g.target.edge for g in known(ring(FROM_SOUTH, EAST, NORTH, out), "in_0", -30.0) if g.target
    ]
    assert found == ["out0", "out1"] + ["out2"] * (not back)


def test_the_bearing_of_the_entry_is_that_some_way_before_the_ring() -> None:
    bent = [(-8.0, -80.0), (-8.0, -6.0), (0.0, 0.0)]
    found = known(ring(bent, EAST, NORTH, leaving(180.0)), "in_0", -30.0)
    assert [g.target.edge for g in found if g.target] == ["out0", "out1"]


@pytest.mark.parametrize(("right", "kind"), [(True, "exit-right"), (False, "exit-left")])
def test_exits_of_a_ring_are_counted_from_the_entry(right: bool, kind: str) -> None:
    side = 1.0 if right else -1.0
    outs = [[(side * x, y) for x, y in line] for line in (EAST, NORTH)]
    roads = ring(FROM_SOUTH, *outs, right=right)
    ordinals = ["first", "second"]
    assert [(g.kind, g.place, g.target) for g in known(roads, "in_0", -30.0)] == [
        (kind, f"the {which} exit of the roundabout", EgoGoal(f"out{k}", 4.0, None))
        for k, which in enumerate(ordinals)
    ]
    assert [g.place for g in known(roads, "c_0", 5.0)] == [
        "the next exit of the roundabout",
        "the second exit of the roundabout",
    ]


def test_no_more_exits_are_goals_than_can_be_named() -> None:
    count = 7
    corners = [(20.0 * math.cos(0.7 * k), 20.0 * math.sin(0.7 * k)) for k in range(count + 2)]
    lanes = [lane(f"r{k}_0", corners[k : k + 2], 8.0) for k in range(count + 1)]
    lanes += [
        lane(f"o{k}_0", [corners[k + 1], (3.0 * corners[k + 1][0], 3.0 * corners[k + 1][1])])
        for k in range(count)
    ]
    links = [link(f"r{k}_0", f"r{k + 1}_0", index=k) for k in range(count)]
    links += [link(f"r{k}_0", f"o{k}_0", "right", index=20 + k) for k in range(count)]
    rings = (frozenset(f"r{k}" for k in range(count + 1)),)
    roads = Roads(replace(drawn(lanes, links).network, roundabouts=rings))
    places = [g.place for g in known(roads, "r0_0", 3.0)]
    assert places == [
        f"the {which} exit of the roundabout"
        for which in ("next", "second", "third", "fourth", "fifth", "sixth")
    ]


@pytest.mark.parametrize(
    ("distance", "speed", "limit", "up", "down", "time"),
    [
        (100.0, 4.0, 30.0, 1.0, 3.0, 2.0 * math.sqrt(162.0) * 2.0 / 3.0 - 4.0),  # peak^2 = 162
        (100.0, 4.0, 8.0, 1.0, 3.0, 4.0 + 8.0 / 3.0 + (100.0 - 24.0 - 32.0 / 3.0) / 8.0),
        (10.0, 10.0, 20.0, 2.0, 2.0, 2.0),  # too near to stop: at the mean of 10 and 0 m/s
        (0.0, 10.0, 20.0, 2.0, 2.0, 0.0),
        (0.0, 0.0, 20.0, 2.0, 2.0, 0.001),
    ],
)
def test_the_shortest_time_to_come_to_rest(
    distance: float, speed: float, limit: float, up: float, down: float, time: float
) -> None:
    found = stopping_time(distance, speed, limit, up, down)
    assert found == pytest.approx(time, abs=5e-4)
