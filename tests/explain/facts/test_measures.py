"""Measures: values against what was put in, and the true reason where there is none."""

from dataclasses import replace
from typing import get_args

import pytest

from planner.record.events import Event
from planner.record.places import PriorityFact, RoadFacts, RoadPlace, RouteStep
from tests.explain.facts.scenes import Actor, made, recorded, speeds, straight
from xavi_dialogue.domain.facts import Gap
from xavi_dialogue.domain.terms import Destination, Ego, Junction, Lane, Vehicle
from xavi_dialogue.domain.terms import Event as Doing
from xavi_dialogue.domain.vocabulary import Attribute, Relation
from xavi_dialogue.explain.causes.plans.options import options_at
from xavi_dialogue.explain.facts.world import World, world_of

TWO = {0: Actor(straight(0.0, 0.0, 12.0)), 1: Actor(straight(40.0, 3.5, 9.0), colour="red")}


def roads(time: float) -> RoadFacts:
    """Two lanes, and a junction and a roundabout ahead."""
    places = {
        0: RoadPlace("main", 0, 2, 13.89, False, False),
        1: RoadPlace("main", 1, 2, 13.89, False, False),
    }
    steps = (
        RouteStep(100.0 - 12.0 * time, "junction", "exit-right", None, None, 4, "give-way"),
        RouteStep(200.0 - 12.0 * time, "roundabout", "exit-straight", 2, 4, 4, "give-way"),
    )
    left = 300.0 - 12.0 * time
    return RoadFacts(places, steps, left, left / 12.0, (PriorityFact(1, "vehicle"),))


def test_every_attribute_has_a_value_or_a_reason() -> None:
    for ride in (made(TWO, 5.0), made(TWO, 5.0, roads=roads), recorded("s3-0", 12.0)):
        world = World(ride)
        for attribute in get_args(Attribute):
            for thing in (Ego(), Vehicle(1)):
                found = world.measure(attribute, thing, world.now)
                told = (found.value, found.word, found.gap)
                assert any(part is not None for part in told), (attribute, thing)
                assert found.gap is None or found.value is None
                assert found.gap is None or found.gap in get_args(Gap)


def test_every_relation_can_be_asked() -> None:
    world = World(made(TWO, 5.0, roads=roads))
    for relation in get_args(Relation):
        assert world.relation(relation, Vehicle(1), Ego(), 5.0) in (True, False, None)


def test_speed_limit_and_excess() -> None:
    marks = ((0.0, 10.0), (2.0, 10.0), (6.0, 16.0))
    world = World(made({0: Actor(speeds(0.0, 0.0, marks))}, 8.0, roads=roads))
    assert world.measure("speed", Ego(), 4.0).value == pytest.approx(13.0, abs=0.05)
    assert world.measure("limit", Ego(), 4.0).value == 13.89
    assert world.measure("excess", Ego(), 8.0).value == pytest.approx(2.11, abs=0.01)
    assert world.measure("acceleration", Ego(), 4.0).value == pytest.approx(1.5, abs=0.1)
    highest = world.extreme("speed", Ego(), "highest", 0.0, 8.0)
    assert highest.value == 16.0
    assert highest.time == pytest.approx(6.0, abs=0.25)
    mean = world.extreme("speed", Ego(), "mean", 0.0, 2.0)
    assert mean.value == pytest.approx(10.0, abs=0.01)


def test_the_hardest_braking_is_where_it_was() -> None:
    marks = ((0.0, 14.0), (2.0, 14.0), (4.0, 12.0), (6.0, 4.0), (9.0, 4.0))
    world = World(made({0: Actor(speeds(0.0, 0.0, marks))}, 10.0))
    found = world.extreme("comfort", Ego(), "highest", 0.0, 10.0)
    assert found.value == pytest.approx(4.0, abs=0.1)
    assert 4.0 <= found.time <= 6.0
    assert world.extreme("comfort", Ego(), "highest", 0.0, 3.9).value == pytest.approx(1.0, abs=0.1)


def test_road_facts_are_read_off_the_nearest_decision() -> None:
    world = World(made(TWO, 5.0, roads=roads))
    lane = world.measure("lane", Ego(), 5.0)
    assert (lane.value, lane.word, lane.count) == (1.0, "right", 2)
    assert world.measure("lane", Vehicle(1), 5.0).word == "left"
    assert world.relation("on", Vehicle(1), Lane("left"), 5.0) is True
    assert world.measure("turn", Ego(), 5.0).word == "exit-right"
    assert world.measure("exit-number", Ego(), 5.0).value == 2.0
    assert world.measure("right-of-way", Ego(), 5.0, Vehicle(1)).rule == "give-way"
    assert world.measure("right-of-way", Vehicle(1), 5.0).rule == "priority"
    assert world.measure("distance-to-go", Ego(), 5.0).value == pytest.approx(240.0)
    assert world.measure("distance", Ego(), 5.0, Destination()).value == pytest.approx(240.0)
    ring = world.measure("distance", Ego(), 5.0, Junction("roundabout"))
    assert ring.value == pytest.approx(140.0)
    assert world.measure("lane", Ego(), 5.0) == World(made(TWO, 5.0, roads=roads)).measure(
        "lane", Ego(), 5.0
    )


@pytest.mark.parametrize(
    ("attribute", "thing", "at", "gap"),
    [
        ("speed", Ego(), 9.0, "in-future"),
        ("speed", Vehicle(7), 3.0, "out-of-view"),
        ("speed", Ego(), -1.0, "before-record"),
        ("limit", Ego(), 3.0, "not-recorded"),
        ("weather", Ego(), 3.0, "not-sensed"),
        ("time-to-go", Vehicle(1), 3.0, "others-thoughts"),
        ("gap", Ego(), 3.0, "not-applicable"),
        ("origin", Ego(), 3.0, "not-recorded"),
    ],
)
def test_gaps_have_their_true_reasons(
    attribute: Attribute, thing: Ego | Vehicle, at: float, gap: str
) -> None:
    assert World(made(TWO, 5.0)).measure(attribute, thing, at).gap == gap


def test_what_was_lost_on_its_way_says_so() -> None:
    ride = made(TWO, 9.0)
    kept = tuple(t for t in ride.traces if t.sim_time <= 3.0)
    lost = type(ride)(replace(ride.record, traces=kept, gaps=((3.5, 9.0),)))
    assert World(lost).measure("speed", Vehicle(1), 8.0).gap == "gap-in-record"


def test_a_bound_of_the_time_to_go() -> None:
    world = World(made(TWO, 5.0, roads=roads))
    found = world.measure("time-to-go", Ego(), 5.0)
    assert found.value == pytest.approx(10.0)
    assert world.measure("arrival-time", Ego(), 5.0).value == pytest.approx(15.0)
    over = World(made(TWO, 5.0, events=(Event("arrived", 5.0),), ended=True))
    assert over.measure("arrival-time", Ego(), 5.0).value == 5.0
    assert over.measure("time-to-go", Ego(), 5.0).value == 0.0


def test_beliefs_and_options_add_up() -> None:
    world = World(recorded("s1-0", 5.0))
    belief = world.belief(1, 5.0)
    assert belief is not None
    assert sum(e.probability for e in belief.expectations) == pytest.approx(1.0, abs=0.01)
    assert list(belief.expectations) == sorted(belief.expectations, key=lambda e: -e.probability)
    assert world.beliefs(1, 0.0, 5.0)[-1] == belief
    turn = world.probability(Doing("turn", actor=Vehicle(1)), 5.0)
    right = world.probability(Doing("exit-right", actor=Vehicle(1)), 5.0)
    assert turn is not None
    assert right is not None
    assert 0.0 <= right <= turn <= 1.0
    options = options_at(world.ride, 5.0)
    assert [o.chosen for o in options].count(True) == 1
    assert options[0].chosen
    assert options_at(world.ride, -1.0) == ()


def test_one_question_has_one_world() -> None:
    record = made(TWO, 3.0).record
    assert world_of(record) is world_of(record)
    assert world_of(replace(record, now=2.0)) is not world_of(record)


def test_speeds_are_told_to_the_hundredth() -> None:
    world = World(made({0: Actor(straight(0.0, 0.0, 8.26))}, 3.0, roads=roads))
    assert world.measure("speed", Ego(), 2.0).value == 8.26
    assert world.measure("excess", Ego(), 2.0).value == -5.63
    assert world.extreme("speed", Ego(), "highest", 0.0, 3.0).value == 8.26
