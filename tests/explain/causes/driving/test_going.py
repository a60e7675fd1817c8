"""Whose way crosses ours, and who was let go."""

import math

import pytest

from planner.record.events import Event as Told
from planner.record.places import PriorityFact, RoadFacts
from tests.explain.causes.rides import recorded
from tests.explain.facts.scenes import Actor, made, speeds, straight
from xavi_dialogue.domain.answers import CrossingVehicle
from xavi_dialogue.explain.causes.driving.going import bystanders, reckoned_with
from xavi_dialogue.explain.causes.driving.yielding import goes_first
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride


def with_road(
    road: RoadFacts | None, until: float = 8.0, speed: float = 10.0, **other: object
) -> Ride:
    """At a steady speed; each decision has the same road."""
    path = other.pop("path", straight(0.0, 0.0, speed))
    return made({0: Actor(path)}, until, roads=lambda _: road, **other)  # type: ignore[arg-type]


RULES = (PriorityFact(1, "ego"), PriorityFact(2, "vehicle"))


def test_those_whose_way_crosses_ours() -> None:
    actors = {
        0: Actor(straight(0.0, 0.0, 5.0)),
        1: Actor(straight(30.0, 40.0, 0.0)),
        2: Actor(speeds(30.0, 20.0, ((0.0, 9.0), (8.0, 1.0)))),
    }
    whole = made(actors, 6.0, roads=lambda _: RoadFacts({}, priority=RULES))
    one, two = bystanders(whole, World(whole), 5.0)
    assert (one.vehicle, one.first, one.trend, one.gone) == (1, "ego", "standing", False)
    assert (two.vehicle, two.first, two.trend, two.gone) == (2, "vehicle", "slowing", False)
    assert one.distance == pytest.approx(38.2, abs=0.3)
    assert goes_first(whole.latest, 2)
    assert not goes_first(whole.latest, 1)
    assert not goes_first(whole.latest, 3)
    assert bystanders(with_road(None), World(with_road(None)), 5.0) == ()


@pytest.mark.parametrize(
    ("waited", "y", "speed", "gone"),
    [
        (2.0, 40.0, 5.0, True),  # 20 m farther off
        (2.0, 40.0, 0.7, False),  # hardly farther
        (2.0, 40.0, 0.8, True),  # by 3.2 m
        (2.0, 20.0, 0.6, True),  # 17.9 m off
        (2.0, 20.3, 0.6, False),
        (2.0, 10.0, 0.6, True),  # it is just passing
        (2.0, 10.0, 0.4, False),  # it waits for somebody else
        (2.0, 70.0, -5.0, False),  # it comes nearer
    ],
)
def test_who_was_let_go_is_gone_once_it_is_past(
    waited: float, y: float, speed: float, gone: bool
) -> None:
    turn = math.pi / 2.0 if speed > 0.0 else -math.pi / 2.0
    actors = {0: Actor(straight(0.0, 0.0, 0.0)), 2: Actor(straight(0.0, y, abs(speed), turn))}
    events = (Told("gave-way", waited, vehicle=2), Told("gave-way", 3.0))
    whole = made(actors, 8.0, roads=lambda _: RoadFacts({}, priority=RULES[1:]), events=events)
    (found,) = bystanders(whole, World(whole), 6.0)
    assert found.gone is gone
    assert (found == CrossingVehicle(2, "vehicle", gone=True)) is gone


@pytest.mark.parametrize(
    ("waited", "known"), [(2.1, True), (1.9, False), (8.1, False), (8.0, True)]
)
def test_who_was_let_go_lately(waited: float, known: bool) -> None:
    """At most six seconds before; whoever is no longer met is gone."""
    actors = {0: Actor(straight(0.0, 0.0, 0.0)), 2: Actor(straight(0.0, 40.0, 0.0))}
    whole = made(actors, 9.0, events=(Told("gave-way", waited, vehicle=2),))
    found = bystanders(whole, World(whole), 8.0)
    assert found == ((CrossingVehicle(2, "vehicle", gone=True),) if known else ())


@pytest.mark.parametrize(("vehicle", "time", "found"), [(5, 28.0, True), (99, 28.0, False)])
def test_who_is_reckoned_with_was_in_the_way_in_a_drive_imagined(
    vehicle: int, time: float, found: bool
) -> None:
    drive = recorded("town-0")
    ride = Ride(Record(40.0, tuple(drive.traces), tuple(drive.events)))
    assert reckoned_with(ride, vehicle, time) is found


def test_where_nothing_was_imagined_anybody_may_have_been_reckoned_with() -> None:
    assert reckoned_with(with_road(None), 99, -9.0)
