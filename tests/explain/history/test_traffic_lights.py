"""What lights showed over a ride, and when a line was passed."""

import pytest

from sim.scene import EGO, Light, LightState, Scene, Signal
from tests.explain.lit import GREEN, LINE, OBEYS, PASSED, SIGNAL, VIEW, Story, record
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride
from xavi_dialogue.explain.history.traffic_lights import ahead, passings, shown, stretches


def ride(now, story=OBEYS, **more):
    return Ride(record(now, story, **more))


def test_what_was_seen_is_joined_over_decisions():
    red, green = stretches(ride(35.0), SIGNAL)
    assert (red.state, red.begin, red.end, red.begun, red.changed) == (
        "r",
        VIEW,
        GREEN,
        False,
        True,
    )
    assert (green.state, green.begin, green.begun, green.changed) == ("G", GREEN, True, False)


def test_what_has_not_been_seen_is_not_known():
    known = ride(20.0)
    assert shown(known, SIGNAL, 1.0) is None
    assert shown(known, Signal("J", 1), 10.0) is None
    assert shown(known, SIGNAL, 25.0) is None
    assert shown(known, SIGNAL, 20.0).state == "r"


def test_a_light_that_went_out_of_view_is_known_up_to_then():
    known = ride(45.0)
    gone = stretches(known, SIGNAL)[-1]
    assert not gone.changed
    assert gone.end < 40.0
    assert shown(known, SIGNAL, 44.0) is None


def test_the_scene_of_the_question_adds_what_came_since():
    plain = record(29.0)
    seen = Light(SIGNAL, LightState.GREEN, 29.4, True)
    scene = Scene(29.6, {EGO: plain.traces[-1].scene[EGO]}, (seen,))
    red, green = stretches(Ride(Record(29.6, plain.traces, scene=scene)), SIGNAL)
    assert red.end == 29.4
    assert (green.state, green.begin, green.end) == ("G", 29.4, 29.6)


def test_a_line_is_passed_when_the_front_reaches_it():
    (one,) = passings(ride(40.0))
    assert one.time == pytest.approx(PASSED, abs=0.15)
    assert one.shown is not None
    assert one.shown.state == "G"
    assert one.speed == pytest.approx(2.0 * (PASSED - GREEN), abs=0.4)


def test_who_stands_before_the_line_has_not_passed_it():
    assert passings(ride(25.0)) == ()


def test_who_drives_on_at_red_passed_it_at_red():
    (one,) = passings(ride(14.0, Story(obeys=False)))
    assert one.time == pytest.approx(LINE / 10.0, abs=0.15)
    assert one.shown.state == "r"


def test_a_line_is_as_far_away_as_we_have_not_driven_since():
    near = ahead(ride(20.5), 20.5)
    assert near[0].distance == pytest.approx(5.0, abs=0.1)
    moving = ride(3.4)
    assert ahead(moving, 3.0)[0].distance == pytest.approx(70.0, abs=0.1)
