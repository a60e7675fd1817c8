"""Samples of all decisions as one motion: what is added, filled in, and kept."""

from dataclasses import replace as changed
from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.places import LightChange, RoadFacts
from planner.record.trace import Track
from sim.scene import Scene, VehicleState
from tests.explain.answers.given import place, plan, step
from xavi_dialogue.explain.history import joining
from xavi_dialogue.explain.history.joining import Joined, Seen, joined
from xavi_dialogue.explain.history.motion import Motion
from xavi_dialogue.explain.history.nearing import (
    driven,
    junctions_ahead,
    speed_at,
    still_to,
    to_destination,
)
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride


def track(start: float, *xs: float, lights: Any = (), speed: float = 10.0) -> Track:
    count = len(xs)
    return Track(start, tuple((x, 0.0) for x in xs), (0.0,) * count, (speed,) * count, lights)


def decision(time: float, *tracks: Track, **more: Any) -> Any:
    """A decision that knows vehicles 1, 2, ... by their tracks."""
    found = plan(time)
    known = dict(enumerate(tracks, 1))
    state = found.scene[0]
    scene = {v: changed(state) for v in (0, *known)}
    return replace(found, history=found.history | known, scene=scene, **more)


def seen(*traces: Any, vehicle: int = 1) -> Seen:
    return Joined().extended(traces).seen[vehicle]


def test_samples_that_are_known_already_are_left_out() -> None:
    first = decision(1.0, track(0.6, 0.0, 2.0, 4.0))
    second = decision(1.4, track(0.8, 90.0, 91.0, 6.0, 8.0))
    found = seen(first, second).motion
    assert found.time == (0.6, 0.8, 1.0, 1.2, 1.4)
    assert [x for x, _ in found.position] == [0.0, 2.0, 4.0, 6.0, 8.0]
    assert len(found.heading) == len(found.speed) == 5
    assert seen(first, first).motion == seen(first).motion
    later = decision(2.0, track(1.6, 9.0, 10.0, 11.0))
    assert seen(first, later).motion.time == (0.6, 0.8, 1.0, 1.6, 1.8, 2.0)
    off = decision(1.4, track(0.9, 5.0, 6.0, 7.0))  # its samples lie between those known
    assert seen(first, off).motion.time == (0.6, 0.8, 1.0, 1.3)


def test_further_decisions_are_added_to_what_is_known() -> None:
    first, second = decision(1.0, track(0.8, 0.0, 2.0)), decision(1.2, track(1.0, 2.0, 4.0))
    known = Joined().extended((first,))
    more = known.extended((first, second))
    assert more.seen[1].motion.time == (0.8, 1.0, 1.2)
    assert known.seen[1].motion.time == (0.8, 1.0)
    back = more.until((first,))
    assert back.seen[1].motion.time == (0.8, 1.0)
    came = decision(1.2, track(1.0, 2.0, 4.0), track(1.2, 7.0))
    both = Joined().extended((first, came))
    assert set(both.seen) == {0, 1, 2}
    assert set(both.until((first,)).seen) == {0, 1}


def lit(time: float, *shown: str) -> LightChange:
    return LightChange(time, shown)


def test_lights_are_told_where_they_change() -> None:
    first = decision(1.0, track(0.6, 0.0, lights=(lit(0.6), lit(0.8, "left"))))
    second = decision(2.0, track(1.0, 0.0, lights=(lit(0.8, "right"), lit(1.5, "left"), lit(1.8))))
    assert seen(first, second).lights == (lit(0.6), lit(0.8, "left"), lit(1.8))
    assert seen(first, second).until(1.0).lights == (lit(0.6), lit(0.8, "left"))
    assert seen(first, second).until(0.8).lights == (lit(0.6), lit(0.8, "left"))
    assert seen(first, second).until(0.7).lights == (lit(0.6),)


def test_without_lights_in_the_history_those_of_the_scene_are_told() -> None:
    shown = changed(plan(1.0).scene[0], signals=("brake",))

    def at(time: float, road: Any = None) -> Any:
        found = decision(time, track(time, 0.0), road=road)
        return replace(found, scene={0: shown, 1: shown})

    road = RoadFacts({0: place()})
    assert seen(at(1.0)).lights == (lit(1.0, "brake"),)
    assert seen(at(1.0), at(2.0)).lights == (lit(1.0, "brake"),)
    assert seen(at(1.0, road)).lights == ()
    assert seen(at(1.0, road), vehicle=0).lights == (lit(1.0, "brake"),)
    gone = replace(at(1.0), scene={})
    assert seen(gone).lights == ()


def test_stretches_behind_something_run_on_while_it_is_not_seen() -> None:
    def hidden(time: float, since: float) -> Any:
        return decision(time, track(time, 0.0), unseen={1: since})

    assert seen(hidden(3.0, 2.0)).hidden == ((2.0, 3.0),)
    assert seen(hidden(3.0, 2.0), hidden(4.0, 2.0)).hidden == ((2.0, 4.0),)
    two = seen(hidden(3.0, 2.0), hidden(4.0, 2.0), hidden(8.0, 7.0))
    assert two.hidden == ((2.0, 4.0), (7.0, 8.0))
    assert seen(hidden(3.0, 3.0)).hidden == ()
    assert two.until(3.5).hidden == ((2.0, 3.5),)
    assert two.until(7.0).hidden == ((2.0, 4.0),)
    assert two.until(9.0).hidden == two.hidden


# --- what was seen after the last decision ------------------------------------------------------

STATE = VehicleState((0.0, 0.0), 0.0, 10.0, 0.0, 4.5, 1.8)


def reaching(time: float, *traces: Any, vehicle: int = 1, **state: Any) -> Seen:
    scene = Scene(time, {0: STATE, vehicle: changed(STATE, **state)})
    return Joined().extended(traces).reaching(scene).seen[vehicle]


def test_what_lies_between_is_filled_in_evenly() -> None:
    known = decision(1.0, track(0.8, 0.0, 2.0))
    found = reaching(1.5, known, position=(5.0, 3.0), speed=4.0, heading=0.6).motion
    assert found.time == (0.8, 1.0, 1.2, 1.4, 1.5)
    assert found.position == ((0.0, 0.0), (2.0, 0.0), *(
        pytest.approx(p) for p in ((3.2, 1.2), (4.4, 2.4), (5.0, 3.0))))  # fmt: skip
    assert found.speed == pytest.approx((10.0, 10.0, 7.6, 5.2, 4.0))
    assert found.heading == pytest.approx((0.0, 0.0, 0.24, 0.48, 0.6))
    over = reaching(1.4, known, heading=6.0).motion.heading  # the short way round
    assert over[2] == pytest.approx((6.0 - 6.283185307) / 2.0)


def test_one_sample_is_added_where_nothing_is_to_be_filled_in() -> None:
    known = decision(1.0, track(0.8, 0.0, 2.0))
    assert reaching(1.1, known).motion.time == (0.8, 1.0, 1.1)
    assert reaching(1.2, known).motion.time == (0.8, 1.0, 1.2)
    assert reaching(3.0, known).motion.time[-3:] == (2.6, 2.8, 3.0)
    assert reaching(3.1, known).motion.time == (0.8, 1.0, 3.1)  # too long ago
    assert reaching(1.0, known).motion.time == (0.8, 1.0)
    assert reaching(0.9, known).motion.time == (0.8, 1.0)
    fresh = reaching(1.5, known, vehicle=2).motion
    assert (fresh.time, fresh.position) == ((1.5,), ((0.0, 0.0),))


def test_lights_and_hidden_stretches_reach_up_to_the_scene() -> None:
    known = decision(1.0, track(0.8, 0.0, 2.0, lights=(lit(0.8, "left"),)))
    assert reaching(1.5, known, signals=("left",)).lights == (lit(0.8, "left"),)
    assert reaching(1.5, known).lights == (lit(0.8, "left"), lit(1.5))
    assert reaching(1.5, known, vehicle=2).lights == (lit(1.5),)
    hidden = replace(known, unseen={1: 0.9})
    gone = Joined().extended((hidden,)).reaching(Scene(1.5, {0: STATE})).seen[1]
    assert gone.hidden == ((0.9, 1.5),)
    assert gone.motion.time == (0.8, 1.0)
    back = reaching(1.5, hidden)
    assert back.hidden == ((0.9, 1.0),)
    before = replace(decision(0.6, track(0.4, 0.0)), unseen={1: 0.3})
    both = Joined().extended((before, hidden)).reaching(Scene(1.5, {0: STATE})).seen[1]
    assert both.hidden == ((0.3, 0.6), (0.9, 1.5))
    other = replace(known, unseen={7: 0.9})
    assert 7 not in Joined().extended((other,)).reaching(Scene(1.5, {0: STATE})).seen


def test_rides_asked_about_last_are_kept() -> None:
    joining._kept.clear()
    rides = [(decision(1.0 + k, track(1.0 + k, 0.0)),) for k in range(5)]
    found = [joined(one) for one in rides]
    assert joined(rides[4]) is found[4]
    assert joined(rides[1]) is found[1]
    assert joined(rides[0]) is not found[0]  # of five, four are kept
    on = (*rides[4], decision(9.0, track(9.0, 0.0)))
    assert joined(on).seen[1].motion.time == (5.0, 9.0)
    assert joined(on) is joined(on)
    assert joined(rides[4]).seen[1].motion.time == (5.0,)
    assert len(joining._kept) == 4
    assert joined(()).traces == ()
    other = (decision(5.0, track(5.0, 1.0)), on[1])
    assert joined(other).seen[1].motion.position[0] == (1.0, 0.0)
    assert joined(other[:1]).seen[1].motion.position == ((1.0, 0.0),)


# --- distances and speeds between decisions -----------------------------------------------------

TWO_A_SAMPLE = Motion(
    (0.0, 0.2, 0.4, 1.2), ((0.0, 0.0), (2.0, 0.0), (4.0, 0.0), (9.0, 0.0)), (0.0,) * 4,
    (10.0, 10.0, 8.0, 4.0),
)  # fmt: skip


def test_the_way_driven_is_told_between_samples() -> None:
    assert driven(TWO_A_SAMPLE, 0.1, 0.3) == pytest.approx(2.0)
    assert driven(TWO_A_SAMPLE, 0.0, 1.2) == pytest.approx(9.0)
    assert driven(TWO_A_SAMPLE, 1.0, 0.2) == 0.0
    assert driven(Motion((), (), (), ()), 0.0, 1.0) == 0.0


def test_a_speed_between_samples_is_that_of_both_unless_it_was_not_seen() -> None:
    history = Track(18.0, ((0.0, 0.0),) * 3, (0.0,) * 3, (10.0, 8.0, 4.0))
    gap = Track(19.5, ((9.0, 0.0),) * 2, (0.0,) * 2, (2.0, 2.0))
    first = replace(plan(18.5), history={0: history})
    second = replace(plan(19.8), history={0: gap})
    ride = Ride(Record(20.0, (first, second)))
    assert [speed_at(ride, t) for t in (18.0, 18.1, 18.3, 18.4)] == pytest.approx(
        [10.0, 9.0, 6.0, 4.0]
    )
    assert speed_at(ride, 19.0) == 4.0  # a second without a sample
    assert speed_at(ride, 20.0) == 2.0
    assert speed_at(ride, 17.9) is None
    assert still_to(ride, 30.0, 17.0) == 30.0


def test_what_was_assumed_of_somebody_hidden_goes_once_he_is_seen_again() -> None:
    speeds = (6.0, 6.0, 6.0, 6.0, 4.0)  # the three in the middle are assumed
    places = tuple((1.2 * k, 0.0) for k in range(5))
    tracks = [
        {0: Track(17.2, ((0.0, 0.0),) * n, (0.0,) * n, (0.0,) * n),
         1: Track(17.2, places[:n], (0.0,) * n, speeds[:n], (), ((17.2, until),))}
        for n, until in ((3, 17.6), (5, 18.0))
    ]  # fmt: skip
    first = replace(plan(17.6), history=tracks[0], unseen={1: 17.2})
    second = replace(plan(18.0), history=tracks[1])
    later = Ride(Record(18.0, (first, second)))
    assert later.motion(1).time == (17.2, 18.0)
    assert later.motion(1).speed == (6.0, 4.0)
    before = Ride(Record(17.7, (first, second)))  # what was known then, whatever came later
    assert before.motion(1).time == (17.2, 17.4, 17.6)
    assert Ride(Record(17.7, (first,))).motion(1) == before.motion(1)


def test_a_way_to_the_destination_may_be_that_of_an_earlier_decision() -> None:
    knows = RoadFacts({0: place()}, (step(60.0),), 200.0)
    lost = RoadFacts({0: place()}, (step(90.0),), None)
    tracks = {0: Track(16.0, tuple((2.0 * k, 0.0) for k in range(21)), (0.0,) * 21, (10.0,) * 21)}
    begun = Track(15.8, ((-2.0, 0.0), (0.0, 0.0)), (0.0,) * 2, (10.0,) * 2)
    first = replace(plan(16.0, road=knows), history={0: begun})
    second = replace(plan(18.0, road=lost), history=tracks)

    def ahead(*traces: Any, at: float = 20.0) -> list[float]:
        ride = Ride(Record(20.0, traces))
        return [one.distance for one in junctions_ahead(ride, at)]

    assert ahead(replace(second, road=knows)) == [pytest.approx(40.0)]
    assert ahead(first, second) == [pytest.approx(20.0)]
    assert ahead(second) == [pytest.approx(70.0)]
    assert ahead(replace(second, road=None)) == []
    assert ahead() == []
    near = replace(knows, route=(step(19.0), step(17.0), step(30.0)))
    assert ahead(replace(second, road=near)) == [0.0, pytest.approx(10.0)]
    far = Ride(Record(20.0, (replace(second, road=replace(knows, distance=15.0)),)))
    assert to_destination(far, 20.0) == 0.0
    assert to_destination(far, 19.0) == pytest.approx(5.0)
    assert to_destination(Ride(Record(20.0, (second,))), 20.0) is None
    assert to_destination(Ride(Record(20.0)), 20.0) is None
