"""What we did ourselves, as our events tell it."""

import math
from collections.abc import Callable

import pytest

from planner.record.events import Event
from planner.record.places import RoadFacts, RoadPlace, RouteStep
from planner.record.trace import Action
from tests.explain.facts.scenes import Actor, Pose, made, speeds
from xavi_dialogue.domain.terms import Destination, Ego, Junction, Vehicle
from xavi_dialogue.explain.facts.episodes.own import bearing, driving_on, struck, told
from xavi_dialogue.explain.facts.episodes.ways import ways
from xavi_dialogue.explain.facts.states import States


def place(edge: str, lane: int | None = 0, ring: bool = False, inside: bool = False) -> RoadPlace:
    return RoadPlace(edge, lane, 3, 14.0, inside, ring)


def done(action: Action, begin: float, end: float) -> tuple[Event, ...]:
    return (
        Event("action-started", begin - 1.0, action, 1),
        Event("action-committed", begin, action, 1),
        Event("action-ended", end, action, 1),
    )


SLOWING = Actor(speeds(0.0, 0.0, ((0.0, 12.0), (12.0, 0.0))))


@pytest.mark.parametrize(
    ("action", "side", "at"),
    [
        ("change-left", "left", None),
        ("exit-right", "right", Junction("junction", time=4.0)),
        ("exit-straight", "straight", Junction("junction", time=4.0)),
        ("continue-next-exit", None, Junction("junction", time=4.0)),
    ],
)
def test_what_we_did_stands_in_our_events(
    action: Action, side: str | None, at: Junction | None
) -> None:
    (found,) = ways(States(made({0: SLOWING}, 10.0, events=done(action, 4.0, 7.0))), 0)
    assert (found.actor, found.action, found.begin, found.end) == (Ego(), action, 4.0, 7.0)
    assert (found.side, found.place) == (side, at)
    assert (found.speed_from, found.speed_to) == pytest.approx((8.0, 5.0))


def test_driving_on_and_stopping_are_no_ways() -> None:
    for action in ("continue", "stop"):
        assert ways(States(made({0: SLOWING}, 12.0, events=done(action, 4.0, 7.0))), 0) == []


def test_what_we_are_doing_has_the_speed_of_now() -> None:
    (found,) = ways(States(made({0: SLOWING}, 8.0, events=done("exit-left", 4.0, 7.0)[:2])), 0)
    assert found.end is None
    assert (found.speed_from, found.speed_to) == pytest.approx((8.0, 4.0))


def ring(begin: float, end: float, numbers: dict[float, int]) -> Callable[[float], RoadFacts]:
    """On the ring at some decisions; which exit the route has at others."""

    def roads(time: float) -> RoadFacts:
        number = next((n for since, n in sorted(numbers.items(), reverse=True) if since <= time), 9)
        step = RouteStep(20.0, "roundabout", "exit-left", number, 4, 4, "give-way")
        first = RouteStep(10.0, "junction", "exit-left", None, None, 4, "give-way")
        return RoadFacts({0: place("a", ring=begin <= time <= end)}, (first, step))

    return roads


def test_an_exit_is_that_which_was_planned_before_the_roundabout() -> None:
    numbers = {0.0: 1, 2.0: 2, 5.0: 3, 9.0: 4}
    enter, leave = ways(States(made({0: SLOWING}, 11.0, roads=ring(6.0, 8.0, numbers))), 0)
    assert (enter.action, enter.begin, enter.exit) == ("enter", 5.5, 3)
    assert (leave.action, leave.begin, leave.exit) == ("leave", 8.5, 3)


def test_a_route_of_long_before_tells_no_exit() -> None:
    """Only decisions of the last four seconds before the ring count: 1.5 s is too early."""

    def roads(time: float) -> RoadFacts:
        facts = ring(6.0, 8.0, {0.0: 1})(time)
        return facts if time <= 1.0 else RoadFacts(facts.places)

    enter, _ = ways(States(made({0: SLOWING}, 11.0, roads=roads)), 0)
    assert enter.exit is None


def test_a_turn_on_a_ring_is_at_the_roundabout() -> None:
    roads = ring(4.0, 8.0, {0.0: 2})
    for begin, end, form in ((5.0, 6.0, "roundabout"), (9.0, 10.0, "junction")):
        ride = made({0: SLOWING}, 11.0, roads=roads, events=done("exit-right", begin, end))
        (found,) = (e for e in ways(States(ride), 0) if e.action == "exit-right")
        assert found.place == Junction(form, time=3.5 if form == "roundabout" else begin)  # type: ignore[arg-type]


def test_what_our_events_tell() -> None:
    events = (
        Event("action-started", 1.0, "continue", 1),
        Event("collided", 5.0, vehicle=3),
        Event("collided", 6.0),
        Event("arrived", 7.0),
    )
    states = States(made({0: SLOWING}, 8.0, events=events))
    found = [*told(states), *driving_on(states)]
    assert [(e.actor, e.action, e.begin, e.end, e.object) for e in found] == [
        (Ego(), "collide", 5.0, 5.0, Vehicle(3)),
        (Ego(), "collide", 6.0, 6.0, None),
        (Ego(), "arrive", 7.0, 7.0, Destination()),
        (Ego(), "continue", 1.0, 5.0, None),
    ]


def test_a_collision_is_one_of_the_other_with_us_too() -> None:
    events = (Event("collided", 5.0, vehicle=3), Event("collided", 6.0))
    states = States(made({0: SLOWING}, 8.0, events=events))
    (found,) = struck(states, 3)
    assert (found.actor, found.begin, found.object) == (Vehicle(3), 5.0, Ego())
    assert struck(states, 4) == []


def bearing_by(angle: float) -> Actor:
    """We drive east, bear to a side by an angle [rad] between 4 and 5 s, and go on so."""

    def pose(t: float) -> Pose:
        share = min(max(t - 4.0, 0.0), 1.0)
        along = max(t - 5.0, 0.0) * 10.0
        x = 10.0 * min(t, 5.0) + along * math.cos(angle)
        return x, along * math.sin(angle), angle * share, 10.0

    return Actor(pose)


@pytest.mark.parametrize(("angle", "side"), [(0.6, "left"), (-0.6, "right"), (1.3, "left")])
def test_bearing_to_a_side_is_told_with_that_side(angle: float, side: str) -> None:
    (found,) = bearing(States(made({0: bearing_by(angle)}, 9.0)))
    assert (found.actor, found.action, found.side) == (Ego(), "swerve", side)
    assert (found.begin, found.end) == (pytest.approx(4.0, abs=0.21), pytest.approx(5.0, abs=0.21))


@pytest.mark.parametrize(
    ("action", "begin", "end", "part"),
    [
        ("exit-left", 3.0, 6.0, True),
        ("change-left", 1.0, 3.2, True),  # within a second of it
        ("change-left", 0.5, 2.5, False),
        ("change-left", 5.8, 8.0, True),
        ("change-left", 7.0, 8.0, False),
        ("exit-straight", 3.0, 6.0, False),  # along the lane
        ("continue", 3.0, 6.0, False),
    ],
)
def test_bearing_to_a_side_within_a_turn_is_part_of_that(
    action: Action, begin: float, end: float, part: bool
) -> None:
    events = tuple(
        Event(kind, time, action, 1)
        for kind, time in (
            ("action-started", begin), ("action-committed", begin), ("action-ended", end)
        )
    )  # fmt: skip
    found = list(bearing(States(made({0: bearing_by(0.6)}, 9.0, events=events))))
    assert (found == []) is part
