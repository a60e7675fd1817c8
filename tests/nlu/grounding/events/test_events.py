"""Events matched with the record: who is meant, which time of several, and at which cost."""

from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.places import RoadFacts, RoadPlace, RouteStep
from tests.nlu.grounding.fakes import Car, FakeWorld, did, talk
from xavi_dialogue.domain.discourse import Discourse, Span
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Ego,
    Event,
    Now,
    Pronoun,
    Rank,
    Relative,
    Unsaid,
    Vehicle,
    WholeRide,
)
from xavi_dialogue.nlu.grounding.context import Context, Mode
from xavi_dialogue.nlu.grounding.grounder import TermGrounder

NOW = 40.0
CARS = {
    1: Car(20.0, colour="red"),
    2: Car(-15.0, kind="bus", colour="yellow"),
    3: Car(40.0, 3.5, kind="truck", colour="white"),
}


class Said:
    """An event grounded, and what was found out meanwhile."""

    def __init__(
        self,
        spoken: Event,
        *happened: Any,
        mode: Mode = "presupposed",
        discourse: Discourse | None = None,
        facts: RoadFacts | None = None,
    ) -> None:
        world = FakeWorld(CARS, happened, now=NOW, facts=facts)
        g = TermGrounder(Context(world, discourse or Discourse()))
        self.event = g.event(spoken, mode)
        self.cost: Any = g.notes.cost
        self.holds = g.notes.presupposed
        self.span = g.notes.span
        self.leaned = g.notes.leaned
        self.missing = len(g.notes.missing)


BRAKE = Event("brake", tense="past")
TWO = (did("brake", 5.0, 7.0), did("brake", 20.0, 22.0))
GOING_ON = did("brake", 38.0, going_on=True)


@pytest.mark.parametrize(
    ("time", "begin"),
    [
        (Unsaid(), 20.0),
        (Rank(1), 5.0),
        (Rank(2), 20.0),
        (Rank(5), 20.0),
        (Rank(-2), 5.0),
        (Rank(-5), 5.0),
        (At(9.0), 5.0),
        (At(18.0), 20.0),
        (Relative("after", Event("stop")), 20.0),
        (Relative("before", Event("stop")), 5.0),
    ],
)
def test_of_several_times_one_is_meant(time: Any, begin: float) -> None:
    found = Said(replace(BRAKE, time=time), *TWO, did("stop", 10.0, 12.0))
    assert found.event.time == Between(begin, begin + 2.0)
    assert found.span == Span(begin, begin + 2.0, said=time != Unsaid())
    assert (found.cost, found.holds) == (0.0, True)


@pytest.mark.parametrize(
    ("focus", "asked_at", "begin"),
    [
        ((4.0, 5.0), 39.0, 5.0),
        ((7.0, 9.0), 39.0, 5.0),
        ((8.0, 9.0), 39.0, 20.0),
        ((4.0, 4.9), 39.0, 20.0),
        ((4.0, 5.0), 19.0, 20.0),  # it happened since
        ((4.0, 5.0), None, 5.0),
    ],
)
def test_the_time_in_focus_is_meant(
    focus: tuple[float, float], asked_at: float | None, begin: float
) -> None:
    discourse = talk(episode=focus, asked_at=asked_at)
    assert Said(BRAKE, *TWO, discourse=discourse).event.time == Between(begin, begin + 2.0)


def test_what_goes_on_is_now() -> None:
    brake = replace(BRAKE, tense="present")
    found = Said(brake, *TWO, GOING_ON)
    assert (found.event.time, found.span) == (Now(), Span(38.0, 40.0))
    past = Said(BRAKE, *TWO, GOING_ON)
    assert (past.event.time, past.span) == (Between(38.0, 40.0), Span(38.0, 40.0))


@pytest.mark.parametrize(
    ("end", "held"), [(39.6, True), (39.5, True), (39.4, False), (37.5, False)]
)
def test_whether_we_speed_up_is_of_this_moment(end: float, held: bool) -> None:
    for action in ("speed-up", "slow-down", "brake"):
        spoken = Event(action, tense="present")
        found = Said(spoken, did(action, 30.0, end), mode="asked")
        assert found.cost == pytest.approx(0.0 if held else 0.05)
        assert found.event.time == Now()
    turned = Said(Event("signal", tense="present"), did("signal", 30.0, 38.0), mode="asked")
    assert turned.cost == 0.0
    assert turned.event.time == Between(30.0, 38.0)


@pytest.mark.parametrize(("end", "time"), [(29.0, Between(27.0, 29.0)), (27.9, Now())])
def test_what_is_taken_for_granted_may_be_just_over(end: float, time: Any) -> None:
    found = Said(replace(BRAKE, tense="present"), did("brake", end - 2.0, end))
    assert found.event.time == time
    assert found.holds is (time != Now())


def test_what_never_happened_costs_by_how_it_is_said() -> None:
    asked = Said(BRAKE, mode="asked")
    assert (asked.cost, asked.holds) == (pytest.approx(0.05), True)
    granted = Said(BRAKE)
    assert (granted.cost, granted.holds) == (pytest.approx(0.5), False)
    like = Said(BRAKE, did("slow-down", 5.0, 7.0))
    assert (like.cost, like.holds) == (pytest.approx(0.2), False)
    assert like.event == replace(BRAKE, time=Between(5.0, 7.0))
    elsewhen = Said(replace(BRAKE, time=At(30.0)), *TWO)
    assert (elsewhen.cost, elsewhen.holds) == (pytest.approx(0.3), False)
    assert elsewhen.event.time == At(30.0)
    supposed = Said(BRAKE, mode="supposed")
    assert (supposed.cost, supposed.holds, supposed.span) == (0.0, True, None)


def test_only_times_that_were_said_or_are_now_are_spans_of_what_never_happened() -> None:
    assert Said(BRAKE, mode="asked").span is None
    assert Said(replace(BRAKE, time=At(30.0)), mode="asked").span == Span(30.0, 30.0, said=True)
    assert Said(replace(BRAKE, tense="present"), mode="asked").span == Span(40.0, 40.0)


def denied(spoken: Event, *happened: Any, **more: Any) -> tuple[bool, float]:
    found = Said(spoken, *happened, mode="denied", **more)
    return found.holds, round(found.cost, 6)


@pytest.mark.parametrize(
    ("spoken", "discourse", "holds"),
    [
        (BRAKE, Discourse(), True),  # within the last 10 s nothing
        (BRAKE, talk(episode=(6.0, 8.0)), False),
        (BRAKE, talk(episode=(8.0, 9.0)), True),
        (replace(BRAKE, time=At(6.0)), Discourse(), False),
        (replace(BRAKE, time=At(12.0)), talk(episode=(6.0, 8.0)), True),
        (replace(BRAKE, time=WholeRide()), Discourse(), False),
    ],
)
def test_that_something_did_not_happen_is_checked(
    spoken: Event, discourse: Discourse, holds: bool
) -> None:
    assert denied(spoken, TWO[0], discourse=discourse) == (holds, 0.0 if holds else 0.2)


def test_what_did_not_happen_is_of_the_last_ten_seconds_or_of_the_focus() -> None:
    assert denied(BRAKE, did("brake", 29.0, 30.0)) == (False, 0.2)
    assert denied(BRAKE, did("brake", 28.0, 29.9)) == (True, 0.0)
    focus = Said(BRAKE, mode="denied", discourse=talk(episode=(6.0, 8.0)))
    assert focus.span == Span(6.0, 8.0)
    now = Said(replace(BRAKE, tense="present"), mode="denied", discourse=talk(episode=(6.0, 8.0)))
    assert now.span is None
    said = Said(replace(BRAKE, time=At(6.0)), mode="denied")
    assert said.span == Span(6.0, 6.0, said=True)


def test_going_left_is_a_lane_change_where_we_did_not_turn() -> None:
    left = Event("exit-left", tense="past")
    changed = did("change-left", 5.0, 8.0, side="left")
    found = Said(left, changed)
    assert found.event == replace(left, action="change-left", time=Between(5.0, 8.0))
    turned = did("exit-left", 15.0, 18.0, side="left")
    assert Said(left, changed, turned).event.action == "exit-left"
    assert Said(left, changed, mode="asked").event.action == "exit-left"
    now = replace(left, tense="present")
    changing = did("change-left", 38.0, side="left", going_on=True)
    assert Said(now, changing, mode="asked").event == replace(now, action="change-left", time=Now())
    theirs = replace(left, actor=Vehicle(1))
    assert Said(theirs, did("change-left", 5.0, who=1)).event.action == "exit-left"
    right = Event("exit-right", tense="past")
    assert Said(right, did("change-right", 5.0, 8.0)).event.action == "change-right"


def route(turn: Any) -> RoadFacts:
    mine = RoadPlace("e", 0, 1, 13.9, False, False)
    return RoadFacts({0: mine}, (RouteStep(50.0, "junction", turn, None, None, 4, "priority"),))


@pytest.mark.parametrize(
    ("spoken", "cost"),
    [
        (Event("exit-left", tense="present"), 0.0),
        (Event("exit-right", tense="present"), 0.5),
        (Event("exit-left", tense="past"), 0.5),
        (Event("exit-left", Vehicle(1), tense="present"), 0.5),
    ],
)
def test_why_we_turn_is_asked_of_our_next_turn(spoken: Event, cost: float) -> None:
    assert Said(spoken, facts=route("exit-left")).cost == pytest.approx(cost)


def test_what_is_slowing_down_is_our_car_if_no_other_is_named() -> None:
    """While we brake, "what's it slowing down for?" is of us."""
    spoken = Event("brake", Pronoun("it"), tense="present")
    theirs, named = did("brake", 38.0, who=1, going_on=True), talk(Vehicle(1))
    fresh = replace(named, mentions=(replace(named.mentions[0], salience=1.5),))
    assert Said(spoken, GOING_ON).event.actor == Ego()
    assert Said(spoken, GOING_ON, discourse=named).event.actor == Ego()
    assert Said(spoken, GOING_ON, theirs, discourse=named).event.actor == Vehicle(1)
    assert Said(spoken, GOING_ON, discourse=fresh).event.actor == Vehicle(1)
    assert Said(spoken, theirs, discourse=named).event.actor == Vehicle(1)
