"""Whether we stop or slow down for somebody, read off drives that were imagined."""

from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.trace import GoalPrediction, HeldUp, TrajectoryPrediction, VehiclePrediction
from tests.explain.answers.given import NOW, Given
from tests.explain.answers.imagined import Drive, decided
from xavi_dialogue.domain.answers import Slowing
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import Ego, Event, Vehicle
from xavi_dialogue.explain.answers.expectations import slowing as room

STEADY = (10.0,) * 26
SLOWS = tuple(max(10.0 - 0.5 * k, 5.0) for k in range(26))
STOPS = tuple(max(10.0 - 0.8 * k, 0.0) for k in range(26))
HELD = (HeldUp(1, NOW, NOW + 3.0, "right-of-way", 1.0, 1.0),)
ONE = Vehicle(1)


@pytest.fixture
def told(monkeypatch: pytest.MonkeyPatch) -> Any:
    def ask(action: Any, *drives: Drive, whom: Any = ONE, speed: float = 10.0) -> Any:
        asked = Given(traces=(decided(("continue",), *drives),)).asked()
        known = Measure("speed", Ego(), NOW, value=speed)
        monkeypatch.setattr(type(asked.world), "measure", lambda *args: known, raising=False)
        monkeypatch.setattr(room, "somebodies", lambda asked, thing, at: [thing])
        return room.slowing(asked, Event(action, object=whom, tense="future"))

    return ask


def test_who_holds_us_up_is_stopped_for(told: Any) -> None:
    found = told("stop", Drive(0.75, STOPS, held_up=HELD), Drive(0.25, STEADY))
    assert (found.others, found.stops, found.held, found.slow) == ((1,), True, 0.75, 0.0)
    assert found.share == 0.75
    assert found.time == pytest.approx(NOW + 2.6)


def test_slowing_is_told_of_what_is_no_stop(told: Any) -> None:
    found = told("stop", Drive(0.75, SLOWS), Drive(0.25, SLOWS, held_up=HELD))
    assert (found.stops, found.held, found.slow) == (False, 0.25, 5.0)
    assert told("slow-down", Drive(1.0, SLOWS)).slows


def test_who_is_out_of_the_way_is_told_to_be(told: Any) -> None:
    found = told("stop", Drive(1.0, STEADY))
    assert isinstance(found, Slowing)
    assert (found.stops, found.held, found.slow, found.time) == (False, 0.0, None, None)


def test_nothing_is_told_of_what_is_not_asked(told: Any) -> None:
    assert told("turn", Drive(1.0, STEADY)) is None
    assert told("stop", Drive(1.0, STOPS), whom=None) is None  # the plan tells when
    assert told("stop", Drive(1.0, STOPS), speed=0.0) is None  # we stand already


def test_who_is_likely_to_be_first_is_not_known_of_who_is_not_predicted() -> None:
    ours = decided(("continue",), Drive(1.0, (10.0,) * 31))
    count = 40  # samples of somebody who drives north across our way at 10 m/s
    way = TrajectoryPrediction(
        1.0, ("continue",), tuple((40.0, -20.0 + 2.0 * k) for k in range(count)), (10.0,) * count
    )
    goal = GoalPrediction("continue", "the road", "a", 1.0, 1.0, 1.0, (way,))
    trace = replace(ours, predictions=(VehiclePrediction(1, (goal,)),))
    assert room._likeliest_order(trace, 1) == "they"
    assert room._likeliest_order(trace, 2) is None
    unsure = replace(goal, probability=0.5)
    trace = replace(ours, predictions=(VehiclePrediction(1, (unsure,)),))
    assert room._likeliest_order(trace, 1) is None
