"""What a decision recorded, brought to the time spoken of: distances ahead, and speeds."""

from dataclasses import replace

import pytest
from msgspec.structs import replace as with_fields

from planner.record.places import RoadFacts, RoadPlace, RouteStep
from sim.scene import Scene
from tests.explain.facts.scenes import Actor, made, speeds, straight
from xavi_dialogue.domain.answers import MotionCause
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Junction
from xavi_dialogue.explain.causes.driving.driving import as_of
from xavi_dialogue.explain.causes.driving.roadside import road_causes
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.nearing import (
    driven,
    junctions_ahead,
    speed_at,
    still_to,
    tellable,
    to_destination,
    with_speeds,
)
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride

ACTORS = {
    0: Actor(straight(0.0, 0.0, 10.0)),
    1: Actor(speeds(20.0, 0.0, ((0.0, 9.0), (5.0, 9.0), (6.0, 4.0)))),
}


def roads(time: float) -> RoadFacts:
    """A line to give way at in 80 m and another junction behind it, the destination in 200 m."""
    steps = (
        RouteStep(80.0 - 10.0 * time, "junction", "exit-straight", None, None, 4, "give-way"),
        RouteStep(150.0 - 10.0 * time, "junction", "exit-right", None, None, 4, "priority"),
    )
    places = {v: RoadPlace("main", 0, 1, 13.89, False, False) for v in ACTORS}
    return RoadFacts(places, steps, 200.0 - 10.0 * time, 20.0)


def between(now: float = 5.8) -> Ride:
    """A ride with its last decision at 5 s, and what was seen of everybody after it."""
    ride = made(ACTORS, 5.0, roads=roads)
    states = {}
    for vehicle, state in ride.latest.scene.items():
        x, y, heading, speed = ACTORS[vehicle].path(now)
        states[vehicle] = replace(state, position=(x, y), heading=heading, speed=speed)
    return Ride(Record(now, ride.traces, ride.events, scene=Scene(now, states)))


def test_the_way_driven_counts_between_samples() -> None:
    motion = made(ACTORS, 5.0).motion(0)
    assert driven(motion, 1.07, 3.31) == pytest.approx(22.4, abs=0.01)
    assert driven(motion, 4.0, 9.0) == pytest.approx(10.0, abs=0.01)
    assert driven(made(ACTORS, 5.0).motion(7), 0.0, 5.0) == 0.0


def test_distances_are_from_where_we_are_now() -> None:
    ride = between()
    assert still_to(ride, 30.0, 5.8) == pytest.approx(22.0, abs=0.01)
    assert [s.distance for s in junctions_ahead(ride, 5.8)] == pytest.approx([22.0, 92.0], abs=0.1)
    assert to_destination(ride, 5.8) == pytest.approx(142.0, abs=0.1)
    assert to_destination(ride, 4.5) == pytest.approx(155.0, abs=0.1)
    assert to_destination(made(ACTORS, 5.0), 5.0) is None


def test_a_junction_that_was_passed_since_is_none_ahead() -> None:
    near = made(ACTORS, 5.0, roads=lambda t: with_fields(roads(t + 2.7), places=roads(t).places))
    ride = Ride(Record(5.8, near.traces, scene=between().record.scene))
    assert [s.turn for s in junctions_ahead(ride, 5.8)] == ["exit-right"]
    assert [s.turn for s in junctions_ahead(ride, 5.0)] == ["exit-straight", "exit-right"]


def test_the_speed_of_another_is_that_seen_at_the_time() -> None:
    ride = between()
    assert speed_at(ride, 5.0, 1) == pytest.approx(9.0)
    assert speed_at(ride, 5.8, 1) == pytest.approx(5.0, abs=0.01)
    assert speed_at(ride, 5.8) == pytest.approx(10.0)
    assert speed_at(ride, 5.8, 7) is None
    stale = (MotionCause("leader", vehicle=1, speed=9.0), MotionCause("plan"))
    assert [c.speed for c in with_speeds(ride, stale, 5.8)] == [pytest.approx(5.0, abs=0.01), None]
    assert as_of(ride, stale, 5.8)[0].speed == pytest.approx(5.0, abs=0.01)


@pytest.mark.parametrize(
    ("action", "end", "time"),
    [("brake", 5.0, 5.0), ("slow-down", 5.0, 5.0), ("stop", 5.0, 2.0), ("brake", None, 8.0)],
)
def test_speeds_tell_why_at_the_end_of_slowing_down(
    action: str, end: float | None, time: float
) -> None:
    assert tellable(Episode(Ego(), action, 2.0, end), 8.0) == time  # type: ignore[arg-type]
    assert tellable(None, 8.0) == 8.0


def test_reasons_of_the_road_tell_how_far_it_is_now() -> None:
    ride = between()
    deed = Episode(Ego(), "brake", 4.6, speed_from=10.0, speed_to=9.0)
    (line,) = road_causes(ride, ride.latest, deed)
    assert line.kind == "give-way-line"
    assert line.value == pytest.approx(22.0, abs=0.1)


def test_measures_of_the_way_tell_how_far_it_is_now() -> None:
    world = World(between())
    turn = world.measure("turn", Ego(), 5.8)
    rule = world.measure("right-of-way", Ego(), 5.8)
    far = world.measure("distance", Ego(), 5.8, Junction("junction", 1))
    for found in (turn, rule, far):
        assert found.value == pytest.approx(22.0, abs=0.1)


def test_braking_to_a_standstill_ends_where_it_stands() -> None:
    marks = ((0.0, 10.0), (2.0, 10.0), (4.0, 0.1), (6.0, 0.0), (9.0, 0.0))
    world = World(made({0: Actor(speeds(0.0, 0.0, marks))}, 9.0))
    (brake,) = world.episodes(Ego(), "brake")
    assert brake.standing
    assert brake.end == pytest.approx(4.0, abs=0.21)


def test_a_decision_that_knows_no_way_has_that_of_the_last_one_that_did() -> None:
    """At first we meant to turn left; the decisions from 4 s on lead elsewhere."""
    facts = {}
    for time in range(6):
        road = roads(float(time))
        turn = "exit-left" if time < 2 else "exit-straight"
        route = (with_fields(road.route[0], turn=turn), *road.route[1:])
        lost = with_fields(road, route=(), distance=None)
        facts[time] = lost if time >= 4 else with_fields(road, route=route)
    ride = made(ACTORS, 5.0, roads=lambda t: facts[int(t)])
    found = junctions_ahead(ride, 5.0)
    assert [s.turn for s in found] == ["exit-straight", "exit-right"]
    assert [s.distance for s in found] == pytest.approx([30.0, 100.0], abs=0.1)
    assert [s.turn for s in junctions_ahead(ride, 1.0)] == ["exit-left", "exit-right"]
    nowhere = made(ACTORS, 5.0, roads=lambda t: facts[4])
    assert junctions_ahead(nowhere, 5.0) == ()
    assert junctions_ahead(made(ACTORS, 5.0), 5.0) == ()
