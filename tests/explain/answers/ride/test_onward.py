"""Our way ahead: junctions, exits, turns; asked at 20 s, 300 m before the destination."""

from typing import Any

import pytest

from planner.record.places import RouteStep
from tests.explain.answers.stated import decision, did, place, result, roads, scene, step
from xavi_dialogue.domain.answers import Course, Measures, NotRecorded
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.journeys import WayStep
from xavi_dialogue.domain.terms import (
    At,
    Ego,
    Event,
    Junction,
    Measured,
    Next,
    Vehicle,
)
from xavi_dialogue.explain.answers.expectations import steering
from xavi_dialogue.explain.answers.ride import onward as room

US = Ego()
SAID = Span(4.0, 6.0, said=True)
OVER = step(40.04, "exit-straight")
RIGHT = step(90.0, "exit-right")
RING = step(150.0, "exit-straight", kind="roundabout", exit=2, exits=4)
LEFT = step(200.0, "exit-left")
LEFT_THERE = step(90.0, "exit-left")


def ahead(*route: RouteStep, span: Span | None = None, inside: bool = False, **more: Any) -> Any:
    """A ride with junctions ahead of it."""
    known = roads(route=route, places={0: place(roundabout=inside)})
    values = {("distance-to-go", 0): 300.0} | more.pop("values", {})
    return scene(span, road=known, traces=(decision(20.0, road=known),), values=values, **more)


def way(*steps: tuple[RouteStep, int], form: Any = "way", inside: bool = False, **more: Any) -> Course:  # fmt: skip  # noqa: E501
    """What is told of some junctions, each with its rank."""
    told = tuple(
        WayStep(s.kind, s.turn, round(s.distance, 1), rank, s.exit, inside and rank == 1)
        for s, rank in steps
    )
    return Course(form, told, left=300.0, **more)


def test_junctions_are_told_nearest_first() -> None:
    found = room.steps_ahead(ahead(OVER, RING, LEFT))
    assert found == way((OVER, 1), (RING, 2), (LEFT, 3)).steps
    assert found[0].distance == 40.0
    assert not any(one.inside for one in room.steps_ahead(ahead(OVER, RING, inside=True)))
    on_it = room.steps_ahead(ahead(RING, RING, inside=True))
    assert [one.inside for one in on_it] == [True, False]
    assert room.steps_ahead(ahead(inside=True)) == ()
    unknown = result(room.steps_ahead, scene())
    assert unknown == NotRecorded("not-recorded", about="route")
    nowhere = roads(route=(RING,))
    asked = scene(road=nowhere, traces=(decision(20.0, road=nowhere),))
    assert [one.inside for one in room.steps_ahead(asked)] == [False]


@pytest.mark.parametrize(
    ("of", "inside", "found"),
    [
        (Measured("turn"), False, way((OVER, 1))),
        (Measured("turn", to=Junction(rank=2)), False, way((RIGHT, 2), then=True)),
        (Measured("turn", to=Junction(rank=-1)), False, way((LEFT, 4))),
        (Measured("turn", to=Junction(rank=1)), False, way((OVER, 1))),
        (Measured("turn", to=Junction("roundabout")), False, way((RING, 3))),
        (Measured("turn", to=Junction("roundabout", 2)), False, way(then=True)),
        (Measured("exit-number"), False, way((RING, 3))),
        (Measured("exit-number", to=Junction("roundabout", 2)), False, way((RIGHT, 2))),
        (Measured("turn", event=Event("turn")), False, way((RIGHT, 2))),
        (Measured("turn", event=Event("exit-left")), False, way((RING, 3))),
        (Measured("turn", tense="future"), False, way((OVER, 1))),
        (Measured("turn", tense="past", time=Next()), False, way((OVER, 1))),
    ],
)
def test_the_way_is_told_of_the_junction_asked_about(
    of: Measured, inside: bool, found: Course
) -> None:
    assert room.which_way(of, ahead(OVER, RIGHT, RING, LEFT)) == found


def test_where_there_is_no_roundabout_the_next_turn_is_told() -> None:
    exit_ = Measured("exit-number")
    assert room.which_way(exit_, ahead(OVER, RIGHT, LEFT)) == way((RIGHT, 2))
    assert room.which_way(exit_, ahead(OVER)) == way(form="road")


TURNED = did("exit-left", 5.0, 8.0)


@pytest.mark.parametrize(
    ("of", "span", "episodes", "time"),
    [
        (Measured("turn", tense="past"), None, (TURNED,), 3.5),
        (Measured("turn", tense="past"), None, (TURNED, did("exit-right", 12.0, 14.0)), 10.5),
        (Measured("turn", tense="past", time=At(6.0)), None, (TURNED, did("leave", 12.0)), 3.5),
        (Measured("turn", tense="past", time=At(9.4)), None, (TURNED, did("leave", 12.0)), 3.5),
        (Measured("turn", tense="past", time=At(9.6)), None, (TURNED, did("leave", 12.0)), 10.5),
        (Measured("turn"), SAID, (TURNED,), 3.5),
        (Measured("turn", time=At(18.4)), None, (TURNED,), 3.5),
        (Measured("turn", tense="past"), None, (did("brake", 5.0, 8.0),), 20.0),
        (Measured("turn", tense="past", time=At(6.0)), None, (), 6.0),
    ],
)
def test_in_the_past_it_is_the_way_that_we_took(
    of: Measured, span: Any, episodes: Any, time: float
) -> None:
    turns = {("turn", 0): lambda t: t}
    found = room.which_way(of, ahead(RIGHT, span=span, episodes=episodes, values=turns))
    assert found == Measures((Measure("turn", US, time, value=time),))


def test_just_now_is_the_way_ahead() -> None:
    of = Measured("turn", time=At(18.6))
    assert room.which_way(of, ahead(RIGHT)) == way((RIGHT, 1))


@pytest.mark.parametrize(
    ("event", "left"),
    [
        (Event("turn"), ((RIGHT, 2), (RING, 3), (LEFT, 4))),
        (Event("exit-left"), ((RING, 3), (LEFT, 4))),
        (Event("exit-straight"), ((OVER, 1), (RING, 3))),
    ],
)
def test_turns_are_counted_with_roundabouts(event: Event, left: Any) -> None:
    found = room.turns_left(ahead(OVER, RIGHT, RING, LEFT), event)
    assert found == way(*left, form="turns")


def test_junctions_are_counted() -> None:
    asked = ahead(OVER, RING, LEFT)
    every = room.junctions_left(asked, Junction())
    assert every == way((OVER, 1), (RING, 2), (LEFT, 3), form="junctions")
    rings = room.junctions_left(asked, Junction("roundabout"))
    assert rings == way((RING, 2), form="roundabouts")


def test_a_plan_that_leaves_the_route_leaves_the_number_of_turns_open(monkeypatch: Any) -> None:
    """What comes after the junction where it leaves the route is not recorded."""
    asked, planned = ahead(OVER, RIGHT, RING, LEFT), (OVER, LEFT_THERE)
    assert not room.turns_left(asked, Event("turn")).onward
    for module in (room, steering):
        monkeypatch.setattr(module, "as_planned", lambda asked, route: planned)
    found = room.turns_left(asked, Event("turn"))
    assert found == way((LEFT_THERE, 2), form="turns", onward=True)
    assert room.junctions_left(asked, Junction()).onward


NOW = Event("leave", tense="present")


@pytest.mark.parametrize(
    ("event", "route", "found"),
    [
        (NOW, (OVER, RING, RING), way((RING, 2))),
        (Event("leave", tense="future"), (OVER, RIGHT, RING), way((RING, 3))),
        (NOW, (OVER, RIGHT, LEFT), way((RIGHT, 2))),
        (NOW, (OVER,), way(form="road")),
        (Event("leave"), (OVER, RING), None),
        (Event("leave", Vehicle(1), tense="present"), (RING,), None),
        (Event("leave", object=Vehicle(1), tense="present"), (RING,), None),
        (Event("turn", tense="present"), (RING,), None),
    ],
)
def test_we_get_off_at_an_exit_or_a_turn(event: Event, route: Any, found: Any) -> None:
    assert room.leaves_when(ahead(*route), event) == found


@pytest.mark.parametrize(
    ("route", "span", "stays"),
    [
        ((OVER,), None, True),
        ((RIGHT,), None, False),
        ((OVER,), SAID, False),
        ((OVER,), Span(12.0, 18.4, said=True), False),
        ((OVER,), Span(12.0, 18.6, said=True), True),
    ],
)
def test_we_stay_on_the_road_where_nothing_turns_off(route: Any, span: Any, stays: bool) -> None:
    found = room.stays_on(ahead(*route, span=span), NOW)
    assert found == (way(form="road") if stays else None)


def test_the_route_is_stated_where_we_turn_more_than_once() -> None:
    assert room.route_ahead(ahead(OVER, RIGHT, RING, LEFT)) == way(
        (RIGHT, 2), (RING, 3), (LEFT, 4), form="route"
    )
    assert room.route_ahead(ahead(OVER, RIGHT)) is None
    assert room.route_ahead(ahead()) is None
    assert room.way_chosen(ahead(OVER, RIGHT)) == way((RIGHT, 2), form="choice")
