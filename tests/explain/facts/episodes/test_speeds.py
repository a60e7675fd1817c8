"""What somebody did with its speed: from when to when, how hard, and whether it goes on."""

from dataclasses import replace

import pytest

from planner.record.trace import TimedAction
from sim.scene import VehicleState
from tests.explain.facts.scenes import Actor, glimpsed, kept, made, speeds, straight
from tests.planted import Moment, Seen, decision
from tests.traces import End
from tests.traces import World as Plain
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego
from xavi_dialogue.explain.facts.episodes.speeds import moves
from xavi_dialogue.explain.facts.episodes.speeds import speeds as changes
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride

Marks = tuple[tuple[float, float], ...]  # [s] and [m/s]


def told(marks: Marks, until: float = 12.0, ended: bool = False) -> list[Episode]:
    """What another vehicle did with its speed."""
    actors = {0: Actor(straight(0.0, 9.0, 5.0)), 1: Actor(speeds(0.0, 0.0, marks))}
    return changes(States(made(actors, until, ended=ended)), 1)


@pytest.mark.parametrize(
    ("slower", "action", "peak"), [(7.2, "slow-down", 0.7), (6.0, "brake", 1.0)]
)
def test_slowing_down_and_braking(slower: float, action: str, peak: float) -> None:
    """From 10 m/s within four seconds from 4 s on."""
    (found,) = told(((0.0, 10.0), (4.0, 10.0), (8.0, slower)))
    assert (found.action, found.peak, found.standing) == (action, peak, False)
    assert found.speed_from == pytest.approx(10.0, abs=0.2)
    assert found.speed_to == slower
    assert found.begin == pytest.approx(4.0, abs=0.3)
    assert found.end == 8.0


def test_a_speed_that_stays_ends_a_slowing() -> None:
    """Two brakings with some seconds between them are two, though the speed never grew."""
    marks = ((0.0, 12.0), (2.0, 12.0), (4.0, 9.0), (9.0, 9.0), (11.0, 5.0))
    first, second = told(marks, until=14.0)
    assert (first.action, first.speed_to, second.speed_to) == ("brake", 9.0, 5.0)
    assert first.end == pytest.approx(4.0, abs=0.3)
    assert second.begin == pytest.approx(9.0, abs=0.3)


def test_speeding_up_has_no_peak() -> None:
    (found,) = told(((0.0, 4.0), (4.0, 4.0), (8.0, 8.0)))
    assert (found.action, found.peak, found.standing) == ("speed-up", None, False)
    assert (found.speed_to, found.end) == (8.0, 8.0)


@pytest.mark.parametrize(("ended", "end"), [(False, None), (True, 8.0)])
def test_what_goes_on_has_no_end_unless_the_ride_has(ended: bool, end: float | None) -> None:
    for marks in (((0.0, 12.0), (4.0, 12.0), (8.0, 8.0)), ((0.0, 4.0), (4.0, 4.0), (8.0, 8.0))):
        (found,) = told(marks, 8.0, ended)
        assert found.end == end


def test_what_is_over_by_the_end_of_the_record_has_an_end() -> None:
    (found,) = told(((0.0, 12.0), (4.0, 12.0), (7.6, 8.0), (8.0, 8.0)), 8.0)
    assert found.end == 7.6


@pytest.mark.parametrize(
    ("marks", "rate", "over"),
    [
        (((0.0, 12.0), (4.0, 12.0), (8.0, 8.0)), -0.3, False),
        (((0.0, 12.0), (4.0, 12.0), (8.0, 8.0)), -0.1, True),
        (((0.0, 4.0), (4.0, 4.0), (8.0, 8.0)), 0.3, False),
        (((0.0, 4.0), (4.0, 4.0), (8.0, 8.0)), 0.1, True),
    ],
)
def test_a_glimpse_tells_whether_a_speed_still_changes(
    marks: Marks, rate: float, over: bool
) -> None:
    actors = {0: Actor(straight(0.0, 9.0, 5.0)), 1: Actor(speeds(0.0, 0.0, marks))}
    ride = made(actors, 8.0)
    last = ride.latest.scene
    there = replace(last[1], speed=last[1].speed + 0.2 * rate, acceleration=rate)
    (found,) = changes(States(glimpsed(ride, 8.2, {0: last[0], 1: there})), 1)
    assert (found.end is not None) is over


STOPPED: Marks = ((0.0, 8.0), (4.0, 0.0), (8.0, 0.0), (12.0, 8.0))


def test_a_stop_lasts_until_it_moves_off() -> None:
    """It brakes at 2 m/s2, stands from 4 s on, and has 0.4 m/s again at 8.2 s."""
    brake, up, stop, go = told(STOPPED, 14.0)
    assert (brake.action, brake.begin, brake.end, brake.standing) == ("brake", 0.0, 4.0, True)
    assert (brake.speed_to, brake.peak) == (0.0, 2.0)
    assert (up.action, up.begin, up.end) == ("speed-up", 8.0, 12.0)
    assert (stop.action, stop.begin, stop.end) == ("stop", 4.0, 8.2)
    assert (stop.speed_to, stop.standing) == (0.0, True)
    assert (go.action, go.begin, go.end) == ("go", 8.2, 12.0)
    assert (go.speed_from, go.speed_to) == (0.0, 8.0)


def test_setting_off_goes_on_while_the_speed_grows() -> None:
    (go,) = (e for e in told(STOPPED, 11.0) if e.action == "go")
    assert go.end is None
    assert go.speed_to == pytest.approx(6.0)
    (over,) = (e for e in told(STOPPED, 11.0, ended=True) if e.action == "go")
    assert over.end == 11.0


@pytest.mark.parametrize(("ended", "end"), [(False, None), (True, 7.0)])
def test_standing_goes_on_unless_the_ride_has_ended(ended: bool, end: float | None) -> None:
    stop = told(STOPPED, 7.0, ended)[-1]
    assert (stop.action, stop.begin, stop.end) == ("stop", 4.0, end)


def test_a_short_roll_is_part_of_a_standstill() -> None:
    rolled: Marks = ((0.0, 8.0), (4.0, 0.0), (6.0, 0.0), (6.4, 0.8), (6.8, 0.0), (9.0, 0.0))
    stops = [e for e in told(rolled, 9.0) if e.action in ("stop", "go")]
    assert [(e.action, e.begin, e.end) for e in stops] == [("stop", 4.0, None)]
    rolled = (*rolled[:3], (6.4, 1.2), (6.8, 0.0), (9.0, 0.0))
    stops = [e for e in told(rolled, 9.0) if e.action in ("stop", "go")]
    assert [(e.action, e.begin) for e in stops] == [("stop", 4.0), ("go", 6.2), ("stop", 6.8)]


def test_who_stands_at_first_stands_and_did_not_stop() -> None:
    found = told(((0.0, 0.0), (3.0, 0.0), (6.0, 6.0)), 9.0)
    stood = [(e.action, e.begin, e.end) for e in found if e.action != "speed-up"]
    assert stood == [("stand", 0.0, 3.2), ("go", 3.2, 6.0)]


def test_a_break_in_the_record_ends_a_standstill() -> None:
    actors = {0: Actor(straight(0.0, 9.0, 5.0)), 1: Actor(straight(0.0, 0.0, 0.0))}
    ride = kept(made(actors, 24.0), lambda t: not 3 < t < 20)
    stood = [e for e in changes(States(ride), 1) if e.standing]
    assert [(e.begin, e.end) for e in stood] == [(0.0, 3.0), (10.0, None)]


def test_when_somebody_was_in_motion() -> None:
    actors = {0: Actor(straight(0.0, 9.0, 5.0)), 1: Actor(speeds(0.0, 0.0, STOPPED))}
    found = moves(States(made(actors, 14.0)), 1)
    assert [(e.action, e.begin, e.end) for e in found] == [("move", 0.0, 4.0), ("move", 8.2, None)]
    over = moves(States(made(actors, 14.0, ended=True)), 1)
    assert [(e.begin, e.end) for e in over] == [(0.0, 4.0), (8.2, 14.0)]
    assert [(e.begin, e.end) for e in moves(States(made(actors, 7.0)), 1)] == [(0.0, 4.0)]
    still = {0: Actor(straight(0.0, 9.0, 5.0)), 1: Actor(straight(0.0, 0.0, 0.0))}
    assert moves(States(made(still, 5.0)), 1) == []
    assert moves(States(made(still, 5.0)), 7) == []


# What the ego is about to do ---------------------------------------------------------------


def planning(*pace: float, now: float = 4.0, speed: float = 10.0, ended: bool = False) -> States:
    """A decision at 4 s to go on at such speeds at 5 Hz."""
    plain = Plain({}, (("continue",), ("stop", "continue")), lambda plan, _: (End(), len(plan)))
    drive = (*pace, *(pace[-1:] * 20))

    def paced(plan: tuple[str, ...]) -> tuple[float, ...]:
        return drive if plan == ("continue",) else (0.0,) * 20

    seen = Seen(0.0, 0.0, ((0.0, speed), (3.0, speed), (4.0, pace[0])))
    trace = decision(Moment(plain, {0: seen}, 4.0, pace=paced))
    return States(Ride(Record(now, (trace,), ended=ended)))


@pytest.mark.parametrize(
    ("pace", "now", "told"),
    [
        ((10.0, 9.7, 9.4), 4.0, ("brake", 4.0, 10.0, 9.4, 1.2)),
        ((10.0, 10.0, 9.5), 4.0, ("brake", 4.2, 10.0, 9.5, 1.0)),
        ((10.0, 9.9, 9.65), 4.0, None),  # only 0.35 m/s
        ((10.0, 9.8, 9.55), 4.0, ("brake", 4.0, 10.0, 9.55, 0.9)),
        (tuple(10.0 - 0.1 * k for k in range(9)), 5.0, ("slow-down", 4.0, 10.0, 9.2, 0.53)),
        ((10.0, 9.7, 9.4), 5.4, ("slow-down", 4.0, 10.0, 9.4, 0.32)),
        ((10.0, 9.7, 9.4), 5.6, None),  # the plan is too old
        ((10.0, 10.3, 10.6), 4.0, None),
    ],
)
def test_slowing_down_may_begin_with_the_plan(
    pace: tuple[float, ...], now: float, told: tuple[object, ...] | None
) -> None:
    found = changes(planning(*pace, now=now), 0)
    assert [(e.action, e.begin, e.speed_from, e.speed_to, e.peak) for e in found] == (
        [] if told is None else [(*told[:3], pytest.approx(told[3]), told[4])]
    )
    assert all(e.end is None and e.actor == Ego() for e in found)


def test_a_plan_counts_for_nothing_once_the_ride_is_over_or_while_the_speed_grows() -> None:
    assert changes(planning(10.0, 9.7, 9.4, ended=True), 0) == []
    growing = changes(planning(10.0, 9.7, 9.4, speed=8.0), 0)
    assert [e.action for e in growing] == ["speed-up"]


def test_the_rollouts_of_other_plans_do_not_count() -> None:
    found = planning(10.0, 10.0, 10.0)
    assert changes(found, 0) == []
    trace = found.ride.latest
    assert {r.actions[0] for r in trace.rollouts} == {
        TimedAction("continue", 4.0),
        TimedAction("stop", 4.0),
    }


@pytest.mark.parametrize(
    ("speed", "signals", "ended", "brakes"),
    [
        (8.0, ("brake",), False, True),
        (1.1, ("left", "brake"), False, True),
        (0.9, ("brake",), False, False),
        (8.0, ("left",), False, False),
        (8.0, ("brake",), True, False),
    ],
)
def test_the_brake_light_tells_first(
    speed: float, signals: tuple[str, ...], ended: bool, brakes: bool
) -> None:
    ride = made({0: Actor(straight(0.0, 0.0, speed))}, 6.0, ended=ended)
    now = VehicleState((6.4 * speed, 0.0), 0.0, speed, 0.0, 4.8, 1.8, "car", "blue", signals)
    found = changes(States(glimpsed(ride, 6.4, {0: now})), 0)
    told = [(e.action, e.begin, e.end, e.speed_from, e.speed_to) for e in found]
    assert told == ([("brake", 6.4, None, speed, speed)] if brakes else [])
