"""Where everybody is at a time: between samples, behind something, out of view, not on record."""

import math
from dataclasses import replace

import pytest

from planner.record.places import LightChange, RoadFacts, RoadPlace, RouteStep
from sim.scene import VehicleState
from tests.explain.facts.scenes import Actor, Pose, glimpsed, kept, made, speeds, straight
from xavi_dialogue.explain.facts.states import States, states_of
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride

OURS = Actor(straight(0.0, 0.0, 10.0))
BEHIND = Actor(straight(40.0, 0.0, 10.0), hidden=(4.0, 7.0))  # something hides it
PASSING = Actor(straight(-40.0, 3.5, 10.0), since=3.0, until=6.0)


def states(*others: Actor, until: float = 10.0) -> States:
    return States(made(dict(enumerate((OURS, *others))), until))


def car(x: float, y: float, speed: float = 10.0, acceleration: float = 0.0) -> VehicleState:
    return VehicleState((x, y), 0.0, speed, acceleration, 4.8, 1.8, "car", "blue")


def test_the_record_begins_with_the_first_decision_or_what_that_knew() -> None:
    ride = made({0: OURS}, 8.0)
    assert States(ride).begin == 0.0
    assert States(kept(ride, lambda t: t >= 3.0)).begin == 0.0  # its history goes back so far
    late = made({0: replace(OURS, since=5.0), 1: Actor(straight(9.0, 0.0, 9.0))}, 8.0)
    assert States(kept(late, lambda t: t < 5.0)).begin == 0.0
    assert States(Ride(Record(now=7.0))).begin == 7.0


def test_what_is_worked_out_is_kept() -> None:
    known = states()
    assert known.memo("a", lambda: "first") == "first"
    assert known.memo("a", lambda: "second") == "first"
    ride = made({0: OURS}, 2.0)
    assert states_of(ride).ride is ride
    assert states_of(ride) is states_of(ride)


@pytest.mark.parametrize(
    ("time", "since"), [(4.0, None), (4.1, 4.0), (6.0, 4.0), (7.0, 4.0), (7.5, 4.0), (8.0, None)]
)
def test_since_when_somebody_is_hidden(time: float, since: float | None) -> None:
    """The decision at 7 s has it hidden still, and the next one sees it again."""
    found = states(BEHIND)
    assert found.hidden(1, time) == since
    assert found.visible(1, time) is (since is None)
    assert found.known(1, time)


@pytest.mark.parametrize(("time", "since"), [(9.4, 4.0), (9.6, None)])
def test_a_decision_tells_who_is_hidden_for_a_while_only(time: float, since: float | None) -> None:
    found = States(kept(made({0: OURS, 1: BEHIND}, 12.0), lambda t: t <= 7.0))
    assert found.hidden(1, time) == since


def test_a_glimpse_since_then_tells_who_is_hidden_no_longer() -> None:
    ride = kept(made({0: OURS, 1: BEHIND}, 7.0), lambda t: t <= 7.0)
    seen = States(glimpsed(ride, 7.6, {0: car(76.0, 0.0), 1: car(116.0, 0.0)}))
    assert seen.hidden(1, 7.6) is None
    assert seen.hidden(1, 7.4) == 4.0
    unseen = States(glimpsed(ride, 7.6, {0: car(76.0, 0.0)}))
    assert unseen.hidden(1, 7.6) == 4.0
    assert unseen.known(1, 7.6)


@pytest.mark.parametrize(
    ("time", "known"),
    [(2.9, False), (3.0, True), (4.5, True), (6.2, True), (6.9, True), (7.0, False), (9.0, False)],
)
def test_from_when_to_when_somebody_is_known(time: float, known: bool) -> None:
    """The last decision that knew it was at 6 s."""
    found = states(PASSING)
    assert found.known(1, time) is known
    assert (found.state(1, time) is not None) is known


def test_who_is_not_in_the_newest_scene_is_known_no_longer() -> None:
    ride = made({0: OURS, 1: Actor(straight(30.0, 0.0, 10.0))}, 6.0)
    gone = States(glimpsed(ride, 6.8, {0: car(68.0, 0.0)}))
    assert not gone.known(1, 6.8)
    assert gone.known(1, 6.6)
    assert States(glimpsed(ride, 6.2, {0: car(62.0, 0.0)})).known(1, 6.2)  # one sample may lack
    assert not States(glimpsed(ride, 6.24, {0: car(62.4, 0.0)})).known(1, 6.24)
    here = States(glimpsed(ride, 6.8, {0: car(68.0, 0.0), 1: car(98.0, 0.0)}))
    assert here.known(1, 6.8)
    assert here.motion(1).position[-1] == (98.0, 0.0)


def test_a_break_in_the_record_is_not_filled_in() -> None:
    """Decisions until 3 s and from 20 s on, of which each knows ten seconds."""
    ride = kept(made({0: OURS, 1: Actor(straight(9.0, 0.0, 10.0))}, 24.0), lambda t: not 3 < t < 20)
    found = States(ride)
    assert [found.known(1, t) for t in (3.1, 5.4, 5.6, 9.9, 10.0)] == [
        True,
        True,  # the decision of 3 s is fresh enough
        False,
        False,
        True,
    ]
    pair = found.pair(0, 1)
    assert pair is not None
    assert min(t for t in pair.time if t > 3.0) == pytest.approx(10.0, abs=0.21)


def test_when_somebody_was_in_view_last() -> None:
    both = Actor(straight(-40.0, 3.5, 10.0), since=3.0, until=6.0, hidden=(4.0, 6.0))
    found = states(BEHIND, PASSING, both)
    assert found.last_seen(1, 3.0) == 3.0
    assert found.last_seen(1, 5.5) == 4.0
    assert found.last_seen(2, 9.0) == 6.0
    assert found.last_seen(2, 2.0) is None
    assert found.last_seen(3, 9.0) == 4.0  # it was hidden before it was lost
    assert found.in_view(5.0) == (2,)
    assert found.in_view(9.0) == (1,)
    there = found.lately(2, 9.0)
    assert there is not None
    assert there.position == (20.0, 3.5)
    assert found.lately(2, 2.0) is None


def circling(t: float) -> Pose:
    """Turning past due west, at a speed that grows."""
    heading = math.remainder(3.0 + 0.7 * t, math.tau)
    return 10.0 * t, -5.0 * t, heading, 4.0 + t


def test_between_samples_all_is_in_between() -> None:
    found = States(made({0: OURS, 1: Actor(circling, length=9.0, colour="red")}, 4.0))
    at = found.state(1, 0.3)  # the heading passes from 3.14 to -3.003
    assert at is not None
    assert at.position == pytest.approx((3.0, -1.5))
    assert at.heading == pytest.approx(3.21 - math.tau, abs=1e-3)
    assert at.speed == pytest.approx(4.3)
    assert at.acceleration == pytest.approx(1.0)
    assert (at.length, at.colour) == (9.0, "red")
    on_sample = found.state(1, 0.4)
    assert on_sample is not None
    assert on_sample.position == pytest.approx((4.0, -2.0))
    after = found.state(1, 4.1)
    assert after is not None
    assert after.position == pytest.approx((40.0, -20.0))


def test_what_is_seen_now_has_its_own_acceleration() -> None:
    ride = made({0: OURS, 1: Actor(straight(30.0, 0.0, 10.0))}, 6.0)
    found = States(glimpsed(ride, 6.4, {0: car(64.0, 0.0), 1: car(94.0, 0.0, 9.0, -2.5)}))
    now, before = found.state(1, 6.4), found.state(1, 5.0)
    assert now is not None
    assert before is not None
    assert (now.acceleration, now.speed) == (-2.5, 9.0)
    assert before.acceleration == pytest.approx(0.0)


def test_an_offset_needs_both() -> None:
    found = states(PASSING, Actor(straight(30.0, -2.0, 10.0)))
    there = found.offset(0, 2, 4.5)
    assert there is not None
    assert (there.ahead, there.left) == pytest.approx((30.0, -2.0))
    back = found.offset(2, 0, 4.5)
    assert back is not None
    assert back.ahead == pytest.approx(-30.0)
    assert found.offset(0, 1, 9.0) is None
    assert found.offset(1, 0, 9.0) is None


def test_lights_are_those_of_the_last_change() -> None:
    lights = (LightChange(2.4, ("left",)), LightChange(5.0, ("left", "brake")))
    found = states(replace(BEHIND, hidden=None, lights=lights))
    shown = [found.lights(1, t) for t in (2.3, 2.4, 4.9, 5.0, 9.0)]
    assert found.lights(7, 5.0) is None
    assert shown == [(), ("left",), ("left",), ("left", "brake"), ("left", "brake")]
    at = found.state(1, 5.5)
    assert at is not None
    assert at.signals == ("left", "brake")


def road(time: float) -> RoadFacts:
    """A new road each second; the other vehicle is on it only in every third one."""
    place = RoadPlace(f"at {time:g}", 0, 1, 10.0, False, False)
    return RoadFacts({0: place, 1: place} if time % 3.0 == 0.0 else {0: place})


@pytest.mark.parametrize(
    ("vehicle", "time", "edge"),
    [
        (0, 4.0, "at 4"),
        (0, 4.4, "at 4"),
        (0, 4.6, "at 5"),
        (0, 10.5, "at 8"),  # the last decision, 2.5 s old
        (0, 10.6, None),
        (0, -2.4, "at 0"),
        (0, -2.6, None),
        (1, 5.6, "at 6"),
        (1, 5.4, "at 6"),  # the nearest decision does not know it, the next nearest does
        (1, 3.4, "at 3"),
        (1, 4.4, None),
        (2, 3.0, None),
    ],
)
def test_a_place_is_that_of_the_nearest_decision(
    vehicle: int, time: float, edge: str | None
) -> None:
    actors = {0: OURS, 1: Actor(straight(9.0, 0.0, 10.0))}
    found = States(made(actors, 8.0, roads=road, now=12.0)).place(vehicle, time)
    assert (None if found is None else found.edge) == edge


def crossing(time: float) -> RoadFacts:
    """From 3 s to 6 s we are inside the first junction; from 9 s on, in a ring."""
    inside, ring = 3.0 <= time <= 6.0, time >= 9.0
    ahead = ("give-way", "equal") if time < 3.0 else ("equal",)
    steps = tuple(RouteStep(9.0, "junction", "exit-left", None, None, 4, rule) for rule in ahead)
    place = RoadPlace("ours", None if inside else 0, 1, 10.0, inside or ring, ring)
    return RoadFacts({} if time == 12.0 else {0: place}, steps)


@pytest.mark.parametrize(
    ("time", "rule"),
    [(2.0, "give-way"), (3.5, "give-way"), (6.9, "give-way"), (7.0, "equal"), (9.0, "equal"),
     (12.0, "equal"), (-1.0, None)],
)  # fmt: skip
def test_the_junction_that_we_are_in_comes_before_the_next(time: float, rule: str | None) -> None:
    found = States(made({0: OURS}, 12.0, roads=crossing)).junction(time)
    assert (None if found is None else found.rule) == rule


def test_a_pair_is_one_vehicle_in_the_frame_of_the_other() -> None:
    """We head north; a lorry comes from the right and turns its back on nobody."""
    actors = {
        0: Actor(straight(0.0, 0.0, 10.0, math.pi / 2.0)),
        1: Actor(straight(60.0, 80.0, 5.0, math.pi), length=10.0, since=2.0),
    }
    pair = States(made(actors, 6.0)).pair(0, 1)
    assert pair is not None
    assert pair.time[0] == 2.0
    assert pair.time[-1] == 6.0
    k = 5  # at 3 s: our middle at (0, 27.6), the lorry's at (50, 80)
    assert pair.time[k] == 3.0
    assert pair.ahead[k] == pytest.approx(52.4, abs=0.01)
    assert pair.left[k] == pytest.approx(-50.0, abs=0.01)
    assert pair.turn[k] == pytest.approx(math.pi / 2.0, abs=1e-3)
    assert (pair.speed[k], pair.eye_speed[k]) == pytest.approx((5.0, 10.0), abs=0.01)
    assert pair.clear == pytest.approx(7.4)


def test_a_slanted_pair() -> None:
    """Both head 30 degrees off east; the other drives 20 m along and 5 m to the left of us."""
    cos, sin = math.cos(math.pi / 6.0), 0.5
    actors = {
        0: Actor(straight(3.0, 4.0, 9.0, math.pi / 6.0)),
        1: Actor(straight(3.0 + 20 * cos - 5 * sin, 4.0 + 20 * sin + 5 * cos, 9.0, math.pi / 6.0)),
    }
    pair = States(made(actors, 2.0)).pair(0, 1)
    assert pair is not None
    assert list(pair.ahead) == pytest.approx([20.0] * 11, abs=0.03)
    assert list(pair.left) == pytest.approx([5.0] * 11, abs=0.03)
    assert list(pair.turn) == pytest.approx([0.0] * 11, abs=1e-3)


def test_who_was_never_seen_together_makes_no_pair() -> None:
    found = States(
        made(
            {
                0: OURS,
                1: Actor(straight(9.0, 0.0, 10.0), until=2.0),
                2: Actor(straight(9.0, 0.0, 10.0), since=4.0),
            },
            8.0,
        )
    )
    assert found.pair(1, 2) is None
    assert found.pair(0, 3) is None
    assert found.pair(0, 1) is not None
    assert found.pair(0, 2) is found.pair(0, 2)


@pytest.mark.parametrize(
    ("vehicle", "time", "gap"),
    [
        (0, 11.0, "in-future"),
        (0, -1.0, "before-record"),
        (0, 5.0, None),
        (1, 5.0, "hidden"),
        (1, 3.0, None),
        (2, 9.0, "out-of-view"),
        (9, 5.0, "out-of-view"),
    ],
)
def test_why_it_is_not_known_where_somebody_is(vehicle: int, time: float, gap: str | None) -> None:
    assert states(BEHIND, PASSING).gap(vehicle, time) == gap


def test_what_was_lost_on_its_way_is_a_gap() -> None:
    ride = kept(made({0: OURS, 1: BEHIND}, 24.0, gaps=((3.0, 9.9),)), lambda t: not 3 < t < 20)
    found = States(ride)
    assert found.gap(0, 7.0) == "gap-in-record"
    assert found.gap(1, 7.0) == "gap-in-record"
    spans = ((0.0, 2.9), (0.0, 3.0), (4.0, 5.0), (9.9, 12.0), (10.0, 12.0))
    assert [found.lost(a, b) for a, b in spans] == [False, True, True, True, False]
    told_nothing = States(kept(made({0: OURS, 1: BEHIND}, 24.0), lambda t: not 3 < t < 20))
    assert told_nothing.gap(0, 7.0) == "gap-in-record"
    assert told_nothing.gap(1, 7.0) == "out-of-view"


def test_the_decision_of_a_time() -> None:
    found = states()
    assert [None if (t := found.trace(x)) is None else t.decision for x in (-1.0, 0.0, 3.9)] == [
        None,
        0,
        3,
    ]
    assert found.road(-1.0) is None
    assert found.road(3.0) is None
    facts = States(made({0: OURS}, 4.0, roads=road)).road(3.5)
    assert facts is not None
    assert facts.places[0].edge == "at 3"


def test_a_shape_is_that_seen_last() -> None:
    assert states().shape(5) is None
    ride = made({0: OURS, 1: Actor(speeds(9.0, 0.0, ((0.0, 9.0), (5.0, 4.0))))}, 5.0)
    known = States(ride).shape(1)
    assert known is not None
    assert known.speed == 4.0
    glimpse = States(glimpsed(ride, 5.4, {0: car(54.0, 0.0), 1: car(60.0, 0.0, 3.5)})).shape(1)
    assert glimpse is not None
    assert glimpse.speed == 3.5
