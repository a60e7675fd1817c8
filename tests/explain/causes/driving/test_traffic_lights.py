"""A traffic light is a cause where planning again with it green would save time."""

import pytest
from msgspec.structs import replace

from planner.record.events import Event as RideEvent
from planner.record.trace import Track
from sim.scene import VehicleState
from tests.explain.lit import GREEN, LINE, OBEYS, STANDS, answer, driven, record
from xavi_dialogue.domain.answers import Evidence, MotionCause, MotionReason, NeedRollout
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.meaning import Ask, Why
from xavi_dialogue.domain.terms import Ego, Event, Feature, Happens, Not
from xavi_dialogue.explain.answers.engine import explain
from xavi_dialogue.explain.causes.driving.slowness import with_nearest
from xavi_dialogue.explain.causes.driving.stated_reasons import Reasons
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride

STOPPED = Ask(Why(Happens(Event("stop", tense="past"))))


def causes(found):
    assert isinstance(found, MotionReason)
    return [(c.kind, c.necessary, c.shown and c.shown.colour) for c in found.causes]


def test_it_is_asked_what_would_be_were_it_green():
    need = explain(GroundedAct(STOPPED), record(25.0))
    assert isinstance(need, NeedRollout)
    assert [(x.controller, x.place, x.state) for x in need.lights] == [("J", 0, "G")]


def test_we_stopped_because_it_is_red():
    assert causes(answer(STOPPED, 25.0)) == [("light", True, "red")]


def test_we_slowed_down_for_it_and_do_not_go_because_of_it():
    slowed = answer(Ask(Why(Happens(Event("slow-down", tense="past")))), 25.0)
    assert causes(slowed)[0] == ("light", True, "red")
    waits = answer(Ask(Why(Not(Happens(Event("go", tense="present"))))), 25.0)
    assert causes(waits)[0] == ("light", True, "red")


def test_what_goes_on_is_told_as_of_now():
    """Braking from 4 s on, 62 m before the line; at 9 s the car is 27 m before it."""
    slows = Ask(Why(Happens(Event("slow-down", tense="present"))))
    (light, *_) = answer(slows, 9.0).causes
    assert light.value == pytest.approx(LINE - driven(OBEYS)[1][45], abs=1.0)
    assert light.value < 30.0


def test_a_light_that_makes_no_difference_is_no_cause():
    found = answer(STOPPED, 25.0, frees=False)
    assert isinstance(found, MotionReason)
    assert all(cause.kind != "light" for cause in found.causes)


def test_without_the_planner_it_is_left_open():
    known = record(25.0)
    need = explain(GroundedAct(STOPPED), known)
    found = explain(GroundedAct(STOPPED), record(25.0, refused=(need,)))
    assert causes(found) == [("light", None, "red")]


def test_what_is_over_is_told_by_what_it_showed_then():
    found = answer(STOPPED, 40.0)
    assert causes(found) == [("light", True, "red")]
    assert found.deed.begin == pytest.approx(STANDS, abs=1.0)


def test_nobody_is_held_once_it_is_green():
    found = answer(Ask(Why(Happens(Event("speed-up", tense="past")))), 34.0)
    lights = [cause for cause in found.causes if cause.kind == "light"]
    assert [light.shown.colour for light in lights] == ["green"]  # it is what freed us


def test_who_goes_while_a_light_holds_us_is_not_given_way_to():
    known = record(25.0)
    gave = tuple(RideEvent("gave-way", time, vehicle=7) for time in (17.0, 20.0))
    found = World(Ride(Record(25.0, known.traces, gave)))
    assert found.episodes(Ego(), "give-way") == found.episodes(Ego(), "wait")
    assert all(e.object == Feature("light") for e in found.episodes(Ego(), "wait"))


def behind_one_at(place: float, now: float) -> MotionCause:
    """The reason that somebody stands ahead of us, whose front is at a place [m]."""
    known = record(now)
    state = VehicleState((place, 0.0), 0.0, 0.0, 0.0, 4.5, 1.8)
    track = Track(0.0, ((place, 0.0),) * 2, (0.0, 0.0), (0.0, 0.0))
    traces = [
        replace(t, scene={**t.scene, 5: state}, history={**t.history, 5: track})
        for t in known.traces
    ]
    ride = Ride(Record(now, tuple(traces)))
    reasons = Reasons((MotionCause("blocked", 5),), None, Evidence(), ride.traces[-1])
    (found,) = with_nearest(ride, World(ride), reasons, now)
    return found


def test_who_stands_before_us_at_a_red_light_is_told_with_it():
    led = behind_one_at(LINE - 1.0, 12.0)
    assert (led.vehicle, led.shown and led.shown.colour) == (5, "red")
    assert behind_one_at(LINE + 10.0, 12.0).shown is None  # beyond the light
    assert behind_one_at(LINE - 1.0, GREEN + 1.0).shown is None
