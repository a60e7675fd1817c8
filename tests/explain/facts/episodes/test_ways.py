"""Lane changes, turns, junctions and roundabouts of others, on made roads."""

import math
from collections.abc import Callable, Sequence

import pytest

from planner.record.places import RoadFacts, RoadPlace, RouteStep
from tests.explain.facts.scenes import Actor, Pose, made, shifted, straight
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Junction, Vehicle
from xavi_dialogue.explain.facts.episodes.ways import ways
from xavi_dialogue.explain.facts.states import States

OURS = Actor(straight(0.0, -50.0, 5.0))


def place(edge: str, lane: int | None = 0, ring: bool = False, inside: bool = False) -> RoadPlace:
    return RoadPlace(edge, lane, 3, 14.0, inside, ring)


Where = Callable[[float], RoadPlace | None]


def of_other(
    path: Callable[[float], Pose], where: Where = lambda _: None, until: float = 12.0
) -> list[Episode]:
    """Where another vehicle went, which at each time [s] is at such a place."""

    def roads(time: float) -> RoadFacts | None:
        here = where(time)
        return None if here is None else RoadFacts({1: here})

    return ways(States(made({0: OURS, 1: Actor(path)}, until, roads=roads)), 1)


SHIFT = shifted(straight(0.0, 0.0, 10.0), 3.0, 6.0, -3.5)


def test_a_lane_change_begins_as_it_moves_over() -> None:
    """It is 0.3 m aside at 3.56 s, so at 3.4 s not yet begun to be; sure by its lanes only."""
    (found,) = of_other(SHIFT)
    assert (found.action, found.side, found.sure) == ("change-right", "right", False)
    assert found.begin == pytest.approx(3.4, abs=0.21)
    assert found.end == pytest.approx(5.8, abs=0.3)
    assert (found.speed_from, found.speed_to) == (10.0, 10.0)
    (sure,) = of_other(SHIFT, lambda t: place("main", 1 if t < 4.5 else 0))
    assert sure.sure
    (road,) = of_other(SHIFT, lambda t: place("main" if t < 4.5 else "next", 1))
    assert road.sure


def test_who_stays_in_its_lane_has_not_changed_it() -> None:
    assert of_other(SHIFT, lambda _: place("main", 1)) == []


@pytest.mark.parametrize(("until", "told"), [(0.0, True), (2.0, False)])
def test_nobody_changes_lanes_around_a_roundabout(until: float, told: bool) -> None:
    """From 0 s on the ring, until half a second after the last decision that has it so."""
    found = of_other(SHIFT, lambda t: place(f"{t:g}", ring=t <= until))
    assert ("change-right" in [e.action for e in found]) is told


def test_lanes_are_looked_up_right_before_and_after() -> None:
    """It was in the right lane up to 1 s, and changed over again at 8 s, unseen."""
    found = of_other(SHIFT, lambda t: place("main", 0 if t < 1.0 or 4.5 < t < 8.0 else 1))
    assert [(e.action, e.sure) for e in found] == [("change-right", True)]


def turning(t: float) -> Pose:
    """North for 4 s at 6 m/s, to the left within 2 s, and on to the west."""
    radius = 12.0 / (math.pi / 2.0)
    if t <= 4.0:
        return 0.0, 6.0 * t, math.pi / 2.0, 6.0
    turned = math.pi / 2.0 * min((t - 4.0) / 2.0, 1.0)
    x, y = -radius * (1.0 - math.cos(turned)), 24.0 + radius * math.sin(turned)
    return x - max(t - 6.0, 0.0) * 6.0, y, math.pi / 2.0 + turned, 6.0


@pytest.mark.parametrize(
    ("where", "told", "sure"),
    [
        (lambda _: None, True, False),
        (lambda _: place("bend"), False, False),
        (lambda _: place("bend", None, inside=True), True, True),
        (lambda t: place("a" if t < 5.0 else "b"), True, True),
        (lambda t: place("a" if t < 3.0 else "b"), False, False),  # long before the turn
        (lambda t: place("b" if t < 8.0 else "c"), False, False),  # long after it
        (lambda t: place(f"{t:g}", ring=2.0 <= t <= 8.0), False, False),
    ],
)
def test_a_turn_is_none_where_the_road_bends(where: Where, told: bool, sure: bool) -> None:
    found = [e for e in of_other(turning, where) if e.action == "exit-left"]
    assert [(e.side, e.sure, e.speed_from, e.speed_to) for e in found] == (
        [("left", sure, 6.0, 6.0)] if told else []
    )
    assert all(e.place == Junction("junction", time=e.begin) for e in found)


def through(begin: float, end: float) -> Where:
    """Inside a junction at the decisions from one time to another [s]."""

    def where(time: float) -> RoadPlace:
        if begin <= time <= end:
            return place("inside", None, inside=True)
        return place("before" if time < begin else "after")

    return where


def test_a_junction_without_a_turn_is_gone_straight_through() -> None:
    steady = straight(0.0, 0.0, 8.0)
    (found,) = of_other(steady, through(4.0, 5.0))
    assert (found.action, found.begin, found.end) == ("exit-straight", 3.5, 5.5)
    assert (found.actor, found.side) == (Vehicle(1), "straight")
    assert found.place == Junction("junction", time=3.5)
    assert of_other(steady, through(0.0, 5.0)) == []  # it was there at first
    assert of_other(steady, through(4.0, 99.0)) == []  # and still is
    assert of_other(steady, lambda _: place("a")) == []


@pytest.mark.parametrize(
    ("begin", "end", "straight_on"),
    [(4.0, 6.0, False), (7.0, 8.0, False), (9.0, 10.0, True), (1.0, 2.0, True)],
)
def test_a_turn_tells_the_junction(begin: float, end: float, straight_on: bool) -> None:
    """It turns from 4.4 to 6 s; a junction within 1.5 s of that is where it turned."""
    found = of_other(turning, through(begin, end))
    assert ("exit-straight" in [e.action for e in found]) is straight_on


def test_the_entry_of_a_roundabout_is_part_of_it() -> None:
    """Inside the junction at 3 s, on the ring from 4 to 7 s, in the junction after it at 8 s."""

    def where(time: float) -> RoadPlace:
        if time in (3.0, 8.0):
            return place("entry" if time == 3.0 else "leaving", None, inside=True)
        return place(f"{time:g}", ring=4.0 <= time <= 7.0)

    found = of_other(straight(0.0, 0.0, 8.0), where)
    assert [(e.action, e.begin) for e in found] == [
        ("enter", 2.5),
        ("leave", 7.5),
        ("exit-straight", 7.5),
    ]
    assert found[0].place == found[1].place == Junction("roundabout", time=2.5)
    assert (found[0].exit, found[1].exit) == (None, None)


@pytest.mark.parametrize(
    ("first", "last", "told"),
    [(3.0, 7.0, ["enter", "leave"]), (0.0, 7.0, ["leave"]), (3.0, 99.0, ["enter"])],
)
def test_who_is_on_a_roundabout_at_first_or_last(
    first: float, last: float, told: Sequence[str]
) -> None:
    found = of_other(straight(0.0, 0.0, 8.0), lambda t: place(f"{t:g}", ring=first <= t <= last))
    assert [e.action for e in found] == list(told)


def ring(begin: float, end: float, numbers: dict[float, int]) -> Callable[[float], RoadFacts]:
    """On the ring at some decisions; which exit the route has at others."""

    def roads(time: float) -> RoadFacts:
        number = next((n for since, n in sorted(numbers.items(), reverse=True) if since <= time), 9)
        step = RouteStep(20.0, "roundabout", "exit-left", number, 4, 4, "give-way")
        first = RouteStep(10.0, "junction", "exit-left", None, None, 4, "give-way")
        return RoadFacts({0: place("a", ring=begin <= time <= end)}, (first, step))

    return roads


def test_a_turn_has_the_speeds_of_its_beginning_and_end() -> None:
    """It slows by 0.5 m/s in each second, from 8 m/s."""

    def slowing(t: float) -> Pose:
        x, y, heading, _ = turning(t)
        return x, y, heading, 8.0 - 0.5 * t

    (found,) = (e for e in of_other(slowing) if e.action == "exit-left")
    assert found.end is not None
    assert found.speed_from == pytest.approx(8.0 - 0.5 * found.begin, abs=0.01)
    assert found.speed_to == pytest.approx(8.0 - 0.5 * found.end, abs=0.01)

    def leaning(t: float) -> Pose:
        x, y, heading, _ = SHIFT(t)
        return x, y, heading, 12.0 - 0.1 * t

    (moved,) = of_other(leaning)
    assert moved.end is not None
    assert moved.speed_from == pytest.approx(12.0 - 0.1 * moved.begin, abs=0.01)
    assert moved.speed_to == pytest.approx(12.0 - 0.1 * moved.end, abs=0.01)
