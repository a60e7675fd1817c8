"""What we are going to do, when, and how long it takes, read off drives that were imagined."""

from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.events import Event as Recorded
from planner.record.trace import EgoGoal, HeldUp
from tests.explain.answers.given import NOW, Given, plan
from tests.explain.answers.imagined import Drive, decided
from tests.traces import End
from xavi_dialogue.domain.answers import PlanAhead
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import Destination, Ego, Event, Junction
from xavi_dialogue.explain.answers.expectations import plans
from xavi_dialogue.explain.answers.ride import places

STEADY = (10.0,) * 26  # for 5 s
STOPS = tuple(max(10.0 - 0.8 * k, 0.0) for k in range(26))  # stands after 13 samples
STARTS = (0.0,) * 5 + tuple(0.4 * k for k in range(21))


def asked(*traces: Any, **more: Any) -> Any:
    return Given(traces=traces, **more).asked()


def foreseen(action: Any, *drives: Drive, steps: Any = ("continue",), **more: Any) -> Any:
    found = plans.foreseen(asked(decided(steps, *drives)), Event(action, **more))
    return None if found is None else (found.share, found.moment)


def test_what_happens_in_the_drives_of_the_plan_is_foreseen_with_its_share() -> None:
    halts, goes = Drive(0.75, STOPS), Drive(0.25, STEADY)
    assert foreseen("stop", halts, goes) == (0.75, NOW + 2.6)
    assert foreseen("stand", halts, goes) == (0.75, NOW + 2.6)
    share, moment = foreseen("slow-down", halts, goes)
    assert (share, moment) == (0.75, pytest.approx(NOW, abs=0.21))
    assert foreseen("brake", halts, goes) == (share, moment)
    assert foreseen("speed-up", halts, goes) is None
    share, moment = foreseen("speed-up", Drive(1.0, STARTS))
    assert (share, moment) == (1.0, pytest.approx(NOW + 1.0, abs=0.21))
    assert foreseen("slow-down", Drive(1.0, STARTS)) is None
    assert foreseen("go", Drive(1.0, STARTS)) == (1.0, NOW + 1.6)  # 1.2 m/s


def test_giving_way_is_foreseen_where_somebody_goes_first() -> None:
    yields = HeldUp(1, NOW + 3.0, NOW + 5.0, "right-of-way", 8.0, 8.0)
    behind = replace(yields, how="leader", since=NOW + 1.0)
    first = Drive(0.75, STEADY, held_up=(behind, yields))
    assert foreseen("give-way", first, Drive(0.25, STEADY)) == (0.75, NOW + 3.0)
    assert foreseen("wait", first) == (1.0, NOW + 3.0)
    assert foreseen("let-go", Drive(1.0, STEADY, held_up=(behind,))) is None


def test_the_end_of_a_drive_is_an_arrival_or_a_collision() -> None:
    ends = Drive(0.75, STEADY), Drive(0.25, STEADY[:6], End("collision", collided_with=1))
    assert foreseen("arrive", *ends) == (0.75, NOW + 5.0)
    assert foreseen("collide", *ends) == (0.25, NOW + 1.0)


def test_another_action_is_foreseen_when_the_plan_comes_to_it() -> None:
    turns = Drive(1.0, STEADY, starts=(NOW, NOW + 3.0))
    steps = ("change-left", "exit-right")
    assert foreseen("change-left", turns, steps=steps) == (1.0, NOW)
    assert foreseen("turn", turns, steps=steps, side="right") == (1.0, NOW + 3.0)
    assert foreseen("turn", turns, steps=steps, side="left") is None
    assert foreseen("enter", Drive(1.0, STARTS), steps=steps) == (1.0, NOW + 1.6)


def test_without_a_decision_nothing_is_foreseen() -> None:
    assert plans.current_plan(asked()) is None
    assert plans.foreseen(asked(), Event("stop")) is None
    assert plans.horizon(asked()) is None
    assert plans.current_plan(asked(plan(NOW, "continue"))) is None  # nothing was imagined


def test_the_plan_is_known_as_far_as_its_longest_drive() -> None:
    two = decided(("continue",), Drive(0.75, STEADY[:6]), Drive(0.25, STEADY))
    assert plans.horizon(asked(two)) == NOW + 5.0
    trace, found = plans.current_plan(asked(plan(2.0, "stop"), two))  # type: ignore[misc]
    assert trace is two
    assert list(found.weights) == pytest.approx([0.75, 0.25])
    bare = replace(two, rollouts=tuple(replace(r, path=(), speed=()) for r in two.rollouts))
    assert plans.horizon(asked(bare)) is None


def test_who_stands_drives_on_at_a_walking_pace() -> None:
    found = plans.moving_on(asked(decided(("continue",), Drive(1.0, STARTS))))
    assert found is not None
    assert found.moment == NOW + 1.6


# --- what comes next ----------------------------------------------------------------------------


def begun(action: Any, committed: float | None = None, ended: float | None = None) -> Any:
    events = [Recorded("action-started", 15.0, action, 15)]
    if committed is not None:
        events.append(Recorded("action-committed", committed, action))
    if ended is not None:
        events.append(Recorded("action-ended", ended, action))
    return tuple(events)


TWO = decided(("change-left", "exit-right"), Drive(1.0, STEADY, starts=(NOW - 2.0, NOW + 3.0)))


def test_the_steps_to_come_are_told_in_time_and_none_earlier_than_now() -> None:
    assert plans.steps(asked(TWO)) == (("change-left", NOW), ("exit-right", NOW + 3.0))
    waits = asked(TWO, events=begun("change-left"))
    assert plans.steps(waits) == (("change-left", NOW), ("exit-right", NOW + 3.0))
    moving = asked(TWO, events=begun("change-left", 16.0))
    assert plans.steps(moving) == (("exit-right", NOW + 3.0),)
    other = asked(TWO, events=begun("stop"))
    assert len(plans.steps(other)) == 2


def test_going_on_is_told_where_nothing_else_comes() -> None:
    goes = decided(("continue",), Drive(1.0, STEADY))
    assert plans.steps(asked(goes)) == (("continue", NOW),)
    assert plans.steps(asked(goes, events=begun("continue"))) == (("continue", NOW),)
    stops = decided(("stop",), Drive(1.0, STOPS))
    assert plans.steps(asked(stops)) == (("stop", NOW + 2.6),)
    assert plans.steps(asked(stops, events=begun("stop"))) == ()
    then = decided(("stop", "continue"), Drive(1.0, STOPS, starts=(NOW, NOW + 4.0)))
    going = asked(then, events=begun("continue"))
    assert plans.steps(going) == (("stop", NOW + 2.6),)


def test_the_same_step_twice_is_told_once() -> None:
    twice = decided(("continue", "change-left", "continue"), Drive(1.0, STEADY))
    assert [step for step, _ in plans.steps(asked(twice))] == ["continue", "change-left"]


def test_what_is_ahead_has_the_measures_that_are_known() -> None:
    measures = {
        ("turn", Ego()): 60.0,
        ("distance", Ego(), Junction("roundabout", 1)): 90.0,
        ("time-to-go", Ego(), Destination()): 30.0,
    }
    found = plans.plan_ahead(asked(TWO, measures=measures))
    assert [(m.attribute, m.value) for m in found.measures] == [
        ("turn", 60.0), ("distance", 90.0), ("time-to-go", 30.0),
    ]  # fmt: skip
    assert found.steps == plans.steps(asked(TWO))
    assert found.begun is None
    assert plans.plan_ahead(asked(TWO, measures=measures), measures=False).measures == ()


@pytest.mark.parametrize(
    ("events", "told"),
    [
        (begun("change-left"), "change-left"),
        (begun("exit-right", 16.0), "exit-right"),
        (begun("continue"), None),
        (begun("change-left", 16.0, 18.0), None),
        ((), None),
    ],
)
def test_a_move_that_is_under_way_is_told(events: Any, told: Any) -> None:
    assert plans.plan_ahead(asked(TWO, events=events)).begun == told


def test_who_is_there_or_has_decided_nothing_has_no_plan() -> None:
    arrived = (Recorded("arrived", 19.0),)
    assert plans.plan_ahead(asked(TWO, events=arrived)) == PlanAhead((), arrived=True)
    assert plans.plan_ahead(asked()) == PlanAhead((), arrived=False)
    assert plans.plan_ahead(asked(TWO)).arrived is False


# --- how long it still takes --------------------------------------------------------------------


def time_to_go(*drives: Drive, at: float = NOW, waypoint: bool = False, **more: Any) -> Any:
    trace = decided(("continue",), *drives, time=18.0)
    if waypoint:
        trace = replace(trace, waypoint=EgoGoal("half", 10.0, None))
    found = places.time_to_go(asked(trace, **more), at)
    assert (found.attribute, found.thing, found.time) == ("time-to-go", Ego(), at)
    return found.value, found.low, found.high, found.at_least


def test_the_time_to_go_is_what_was_recorded_or_what_the_drives_took() -> None:
    known = {("time-to-go", Ego(), Destination()): 30.0}
    takes = Drive(0.75, end=End(time=10.0)), Drive(0.25, end=End(time=18.0))
    assert time_to_go(*takes, measures=known) == (30.0, None, None, False)
    value, low, high, at_least = time_to_go(*takes)
    # 12 s on average from 18 s on, of which 2 s are over
    assert (value, low, high, at_least) == (pytest.approx(10.0), 8.0, 16.0, False)
    soon = time_to_go(Drive(0.75, end=End(time=1.0)), Drive(0.25, end=End(time=1.5)))
    assert soon == (0.0, 0.0, 0.0, False)
    assert time_to_go(*takes, at=18.4)[0] is None
    assert time_to_go(*takes, at=18.5)[0] == pytest.approx(11.5)
    assert time_to_go(*takes, events=(Recorded("arrived", 19.0),))[0] == 0.0


def test_where_the_drives_do_not_arrive_it_takes_at_least_so_long() -> None:
    takes = Drive(0.75, end=End(time=10.0)), Drive(0.25, end=End(time=18.0))
    assert time_to_go(*takes, waypoint=True) == (8.0, 8.0, None, True)
    late = Drive(0.75, end=End("termination")), Drive(0.25, end=End(time=18.0))
    assert time_to_go(*late) == (28.0, 28.0, None, True)  # of 30 s that were looked ahead
    hit = Drive(0.75, end=End("collision")), Drive(0.25, end=End(time=18.0))
    assert time_to_go(*hit) == (16.0, 16.0, None, True)
    never = Drive(1.0, end=End("dead"))
    assert time_to_go(never) == (None, None, None, False)
    assert places.time_to_go(asked(decided(("continue",), never)), NOW).gap == "no-way"
    quick = Drive(1.0, end=End(time=1.0))
    assert time_to_go(quick, waypoint=True) == (0.0, 0.0, None, True)


def test_without_a_plan_the_time_to_go_is_not_known() -> None:
    found = places.time_to_go(asked(), NOW)
    assert found == Measure("time-to-go", Ego(), NOW, to=Destination(), gap="not-recorded")


@pytest.mark.parametrize(
    ("brakes", "speeds", "halts"),
    [(True, STOPS, True), (False, STOPS, False), (True, STEADY, False)],
)
def test_braking_that_ends_in_standing_is_a_halt(
    brakes: bool, speeds: Any, halts: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(plans, "occasion", lambda _, event: event if brakes else None)
    assert plans.is_halting(asked(decided(("continue",), Drive(1.0, speeds)))) is halts
    half = decided(("continue",), Drive(0.4, STOPS), Drive(0.6, STEADY))
    assert not plans.is_halting(asked(half))
