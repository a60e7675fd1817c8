"""Whether a lane is free, and when we come to a place or draw level with a vehicle."""

from typing import Any

import pytest

from planner.record.places import RoadFacts
from tests.explain.answers.given import NOW, Given, look, place, step
from xavi_dialogue.domain.terms import (
    At,
    Destination,
    Ego,
    Event,
    Is,
    Junction,
    Lane,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.explain.answers.ride.reaching import reaching
from xavi_dialogue.explain.answers.sight.room import free


def room(
    which: Any, *others: tuple[float, int | None], own: int | None = 0, lanes: int = 3, **more: Any
) -> Any:
    """Whether a lane is free, with others who are so far ahead in a lane each."""
    places = {0: place(lane=own, lanes=lanes)}
    looks = {}
    for vehicle, (ahead, lane) in enumerate(others, 1):
        looks[vehicle] = look(vehicle, ahead=ahead, distance=abs(ahead), **more)
        places[vehicle] = place(lane=lane, lanes=lanes)
    measures = {("lane", Ego()): 1.0}
    given = Given(looks=looks, road=RoadFacts(places), measures=measures)
    return free(Is("free", Lane(which)), given.asked())


@pytest.mark.parametrize(
    ("which", "own", "lane"),
    [
        ("own", 0, 0),
        ("own", 1, 1),
        ("left", 0, 1),
        ("left", 1, 2),
        ("right", 2, 1),
        ("right", 1, 0),
        ("rightmost", 2, 0),
        ("leftmost", 0, 2),
        ("other", 0, 1),
        ("other", 1, 2),
        ("other", 2, 1),
        ("any", 1, 1),
    ],
)
def test_a_lane_is_free_of_those_in_it_alone(which: Any, own: int, lane: int) -> None:
    for there in range(3):
        found = room(which, (10.0, there), own=own)
        assert found.holds is (there != lane)
        assert len(found.facts) == (there == lane)


@pytest.mark.parametrize(
    ("ahead", "free_"),
    [(29.9, False), (30.1, True), (30.0, False), (-14.9, False), (-15.0, False), (-15.1, True)],
)
def test_a_lane_is_free_from_15_m_behind_to_30_m_ahead(ahead: float, free_: bool) -> None:
    assert room("left", (ahead, 1)).holds is free_


def test_the_nearest_in_a_lane_is_told_first() -> None:
    assert [one.vehicle for one in room("left", (25.0, 1), (-5.0, 1)).facts] == [2, 1]
    assert room("left", (10.0, 1), oncoming=True).holds is True
    assert room("left", (10.0, None)).holds is True


@pytest.mark.parametrize(("which", "own"), [("left", 2), ("right", 0), ("own", None)])
def test_where_there_is_no_such_lane_it_is_told_which_is_ours(which: Any, own: Any) -> None:
    found = room(which, (10.0, 1), own=own)
    assert found.holds is False
    assert [(f.attribute, f.value) for f in found.facts] == [("lane", 1.0)]


def test_another_road_is_no_lane_of_ours_and_no_road_tells_nothing() -> None:
    places = {0: place(lane=0), 1: place("side", lane=0)}
    lane = Is("free", Lane("own"))
    asked = Given(looks={1: look(1)}, road=RoadFacts(places)).asked()
    assert free(lane, asked).holds is True
    assert free(lane, Given(looks={2: look(2)}, road=RoadFacts(places)).asked()).holds is True
    for road in (None, RoadFacts({1: place()})):
        found = free(lane, Given(looks={1: look(1)}, road=road).asked())
        assert (found.holds, found.gap) == (None, "not-recorded")


@pytest.mark.parametrize(
    ("seen", "clear"),
    [
        ({}, False),
        ({"distance": 30.0}, False),
        ({"distance": 30.1}, True),
        ({"oncoming": True}, True),
        ({"bearing": "behind"}, True),
        ({"bearing": "ahead-left"}, True),
        ({"bearing": "crossing-left"}, False),
        ({"bearing": "crossing-right", "speed": 0.0}, True),
        ({"bearing": "crossing-right", "ahead": -1.0}, True),
    ],
)
def test_our_road_is_clear_of_those_close_ahead_of_us_or_crossing(seen: Any, clear: bool) -> None:
    known = RoadFacts({0: place(lane=None)})
    found = free(Is("free"), Given(looks={1: look(1, **seen)}, road=known).asked())
    assert (found.holds, len(found.facts)) == (clear, not clear)


def test_our_road_is_not_clear_of_who_holds_us_up() -> None:
    held = {("in-the-way-of", Vehicle(1), Ego()): True}
    seen = {1: look(1, bearing="left", distance=40.0)}
    given = Given(looks=seen, road=RoadFacts({0: place()}), relations=held)
    assert [f.vehicle for f in free(Is("free"), given.asked()).facts] == [1]


def test_room_is_told_of_the_time_asked_about() -> None:
    places = {0: place(lane=0), 1: place(lane=0)}
    given = Given(looks={1: lambda t: look(1, ahead=80.0 - 10.0 * t)}, road=RoadFacts(places))
    assert free(Is("free", Lane("own"), time=At(6.0), tense="past"), given.asked()).holds is False
    assert free(Is("free", Lane("own"), time=At(2.0), tense="past"), given.asked()).holds is True


# --- when we come to somewhere ------------------------------------------------------------------


def reached(event: Event, speed: float | None = 10.0, **more: Any) -> Any:
    """In how many seconds we come to it at our speed, or how far [m] it is."""
    measures = {("speed", Ego()): speed}
    found: Any = reaching(Given(measures=measures, **more).asked(), event)
    if found is None:
        return None
    (one,) = found.measures
    assert (one.thing, one.time) == (Ego(), NOW)
    return one.attribute, one.value, one.to


JUNCTION = Junction("junction", 1)


def test_we_come_to_a_junction_at_the_speed_of_now() -> None:
    road = RoadFacts({}, (step(60.0),))
    for action in ("arrive", "enter", "approach", "head", "come"):
        event = Event(action, object=JUNCTION)
        assert reached(event, road=road) == ("time-to-go", 6.0, JUNCTION)
    event = Event("arrive", object=JUNCTION)
    assert reached(event, 1.5, road=road) == ("time-to-go", 40.0, JUNCTION)
    assert reached(event, 1.4, road=road) == ("distance", 60.0, JUNCTION)
    assert reached(event, None, road=road) == ("distance", 60.0, JUNCTION)
    assert reached(event, road=RoadFacts({})) is None
    assert reached(event, 1.0, road=RoadFacts({})) is None
    assert reached(Event("stop", object=JUNCTION), road=road) is None
    assert reached(Event("arrive", Vehicle(1), JUNCTION), road=road) is None
    assert reached(Event("arrive", object=Destination()), road=road) is None


@pytest.mark.parametrize(
    ("seen", "seconds"),
    [
        ({"left": -3.5, "speed": 6.0, "ahead": 20.0}, 5.0),
        ({"left": 3.5, "speed": 6.0, "ahead": 20.0}, 5.0),
        ({"left": 2.0, "speed": 6.0, "ahead": 20.0}, 5.0),
        ({"left": 1.9, "speed": 6.0, "ahead": 20.0}, None),  # we are behind it
        ({"left": 3.5, "speed": 9.5, "ahead": 20.0}, 40.0),
        ({"left": 3.5, "speed": 9.6, "ahead": 20.0}, None),
        ({"left": 3.5, "speed": 6.0, "ahead": -1.0}, None),
        ({"left": 3.5, "speed": 6.0, "ahead": 20.0, "in_view": False}, None),
        ({"left": 0.0, "speed": 6.0, "ahead": 32.0, "oncoming": True}, 2.0),
        ({"left": 3.5, "speed": 6.0, "ahead": -5.0, "oncoming": True}, None),
    ],
)
def test_we_draw_level_with_whom_we_are_faster_than(seen: Any, seconds: Any) -> None:
    for action in ("overtake", "pass", "approach"):
        event = Event(action, object=Vehicle(1))
        found = reached(event, looks={1: look(1, **seen)})
        assert found == (None if seconds is None else ("time-to-go", seconds, Vehicle(1)))
    assert reached(Event("follow", object=Vehicle(1)), looks={1: look(1, **seen)}) is None


def test_who_stands_and_comes_towards_us_is_passed_at_a_crawl() -> None:
    stood = look(1, speed=0.0, ahead=30.0, oncoming=True)
    found = reached(Event("pass", object=Vehicle(1)), 0.0, looks={1: stood})
    assert found == ("time-to-go", 20.0, Vehicle(1))
    assert reached(Event("pass", object=Vehicle(7)), looks={}) is None
    assert reached(Event("pass", object=Vehicles((1, 2))), looks={1: stood}) is None
