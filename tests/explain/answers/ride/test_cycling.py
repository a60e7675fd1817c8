"""Whether a bicycle beside us has right of way, and what answers say of it."""

from types import SimpleNamespace
from typing import Any

import pytest

from planner.record.events import Event as Recorded
from planner.record.places import LightAhead, RoadFacts
from tests.explain.answers.given import NOW, Given, look, place, plan, step
from tests.traces import Aim, End, Way, World, trace_of
from xavi_dialogue.domain.answers import Priority
from xavi_dialogue.domain.meaning import Whether
from xavi_dialogue.domain.terms import Ego, Event, Happens, Now, Vehicle
from xavi_dialogue.explain.answers import causal, owing, turns
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.ride import cycling
from xavi_dialogue.explain.answers.ride.priority import priority_at

PRESENT = Window(NOW, NOW)


def turning(
    state: str = "r", aim: Any = "exit-straight", turn: Any = "exit-right", **more: Any
) -> Given:
    """A bicycle that comes up at our right as we stand at a light where we turn."""
    distance = more.pop("distance", 0.0)
    light = LightAhead(distance, "lights", 0, state, 0.0, False)
    road = RoadFacts({0: place()}, (step(distance, turn=turn),), lights=(light,))
    plain = World({1: (Aim(aim, 1.0, (Way((aim,)),)),)}, (("continue",),), lambda *_: (End(), 1))
    near: Any = {"kind": "bicycle", "ahead": -6.0, "left": -2.0, "distance": 4.0} | more
    trace = plan(NOW, road=road, predictions=trace_of(plain).predictions)
    return Given(looks={1: look(**near)}, road=road, traces=(trace,))


@pytest.mark.parametrize(
    ("given", "first"),
    [
        ({}, True),
        ({"state": "G"}, False),  # rollouts tell it then
        ({"aim": "exit-right"}, False),
        ({"turn": "exit-straight"}, False),
        ({"distance": 40.0}, False),
        ({"kind": "car"}, False),
        ({"in_view": False}, False),
        ({"left": 2.0}, False),
        ({"left": -0.5}, False),
        ({"left": -5.0}, False),
        ({"oncoming": True}, False),
        ({"ahead": -20.0}, False),
        ({"ahead": 8.0}, False),  # past the line
    ],
)
def test_who_rides_straight_on_beside_us_where_we_turn_right_goes_first(
    given: Any, first: bool
) -> None:
    asked = turning(**given).asked()
    assert cycling.about_to_ride(asked, 1) is first
    told = priority_at(asked, 1, PRESENT)
    assert (told.rule, told.vehicle) == ("give-way" if first else "none", 1)


def test_by_the_rollouts_it_goes_first_wherever_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = turning("G", left=-8.0).asked()
    monkeypatch.setattr(cycling, "let_first", lambda *_: 0.5)
    assert cycling.about_to_ride(asked, 1)
    monkeypatch.setattr(cycling, "let_first", lambda *_: 0.4)
    assert not cycling.about_to_ride(asked, 1)
    assert not cycling.about_to_ride(asked, None)


def test_whoever_asks_who_must_wait_is_told_of_the_bicycle() -> None:
    given = turning()
    given.looks = {**given.looks, 2: look(2)}
    asked = given.asked()
    told = priority_at(asked, None, PRESENT)
    assert (told.rule, told.vehicle, told.light) == ("give-way", 1, True)
    event = Event("wait", Ego(), Vehicle(1), time=Now(), tense="present", modal="must")
    assert owing.must_let(event, asked)
    assert not owing.must_let(event, turning("G").asked())
    order = turns.order(asked, (Vehicle(1), Vehicle(2)))
    assert isinstance(order, Priority)
    assert (order.rule, order.vehicle, order.why) == ("give-way", 1, "beside")


def test_whom_our_driving_let_go_first_went_first_by_the_rule() -> None:
    let = Recorded("restrained", 10.0, vehicle=1, by="right-of-way")
    over = Recorded("restrained", 13.0, by="nothing")
    given = Given(looks={1: look(kind="bicycle")}, events=(let, over), traces=(plan(NOW),))
    assert cycling.rides_first(given.asked(), 1, Window(8.0, 12.0))
    assert not cycling.rides_first(given.asked(), 1, Window(14.0, 16.0))
    given.looks = {1: look()}
    assert not cycling.rides_first(given.asked(), 1, Window(8.0, 12.0))


def test_whether_we_must_wait_for_it_is_answered_by_the_rule(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The light is why we stand now, which is no reason to deny that it goes first."""
    light = SimpleNamespace(suspected="none")
    monkeypatch.setattr(causal, "_because_of", lambda *_: light)
    event = Event("wait", Ego(), Vehicle(1), time=Now(), tense="present", modal="must")
    question = Whether(Happens(event))
    assert causal.explainer(question, turning().asked()) is None
    assert causal.explainer(question, turning("G").asked()) is not None
