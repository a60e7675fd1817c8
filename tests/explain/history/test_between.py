"""What was seen between two decisions: the same as the scenes of that time."""

from dataclasses import replace

import msgspec
import pytest

from planner.record.light_record import LightCourse, LightPrediction, Showing
from planner.record.places import LightChange
from planner.record.trace import PlanTrace
from sim.scene import LightState, Signal
from tests.explain.facts.scenes import Actor, made, recorded, straight
from xavi_dialogue.dialogue.state.state import up_to
from xavi_dialogue.explain.facts.states import states_of
from xavi_dialogue.explain.history.between import seen_between
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride

ACTORS = {
    0: Actor(straight(0.0, 0.0, 10.0)),
    1: Actor(straight(30.0, 4.0, 5.0)),
    2: Actor(straight(80.0, 4.0, 5.0), hidden=(3.0, 9.0)),
}


def decisions(*times: float) -> tuple[PlanTrace, ...]:
    """The decisions of a straight drive at some times [s]."""
    return tuple(t for t in made(ACTORS, max(times)).traces if t.sim_time in times)


@pytest.mark.parametrize("time", [2.2, 2.5, 2.9])
def test_places_and_speeds_are_those_of_that_time(time: float) -> None:
    scene = seen_between(decisions(2.0, 3.0), time)
    assert scene is not None
    assert scene.time == time
    assert scene.vehicles[0].position == pytest.approx((10.0 * time, 0.0))
    assert scene.vehicles[1].position == pytest.approx((30.0 + 5.0 * time, 4.0))
    assert scene.vehicles[1].speed == pytest.approx(5.0)


@pytest.mark.parametrize("time", [1.5, 2.0, 3.0, 3.5])
def test_nothing_is_known_before_between_or_after_that(time: float) -> None:
    assert seen_between(decisions(2.0, 3.0), time) is None


def test_nothing_is_known_where_a_decision_is_missing() -> None:
    assert seen_between(decisions(2.0, 4.0), 2.5) is None


def test_who_is_hidden_is_not_seen() -> None:
    traces = decisions(2.0, 3.0, 4.0, 5.0)
    before, after = seen_between(traces, 2.5), seen_between(traces, 4.5)
    assert before is not None
    assert after is not None
    assert (2 in before.vehicles, 2 in after.vehicles) == (True, False)


def test_who_is_out_of_view_at_the_next_decision_drove_straight_on() -> None:
    before, after = decisions(2.0, 3.0)
    gone = {v: track for v, track in after.history.items() if v != 1}
    scene = seen_between((before, msgspec.structs.replace(after, history=gone)), 2.6)
    assert scene is not None
    assert scene.vehicles[1].position == pytest.approx((43.0, 4.0))


def test_indicators_are_those_of_that_time() -> None:
    before, after = decisions(2.0, 3.0)
    lights = (LightChange(0.0, ()), LightChange(2.4, ("left",)))
    track = msgspec.structs.replace(after.history[1], lights=lights)
    traces = (before, msgspec.structs.replace(after, history={**after.history, 1: track}))
    early, late = seen_between(traces, 2.3), seen_between(traces, 2.5)
    assert early is not None
    assert late is not None
    assert (early.vehicles[1].signals, late.vehicles[1].signals) == ((), ("left",))


def test_traffic_lights_are_those_of_that_time() -> None:
    before, after = decisions(2.0, 3.0)
    course = (LightCourse(1.0, (Showing(3.0, "G"),)),)
    red = LightPrediction("tl", (4,), (Showing(1.0, "r"),), course)
    green = LightPrediction("tl", (4,), (Showing(1.0, "r"), Showing(2.4, "G")), course)
    traces = (
        msgspec.structs.replace(before, lights=(red,)),
        msgspec.structs.replace(after, lights=(green,)),
    )
    early, late = seen_between(traces, 2.3), seen_between(traces, 2.7)
    assert early is not None
    assert late is not None
    for scene, state, since, seen in (
        (early, LightState.RED, 1.0, False),
        (late, LightState.GREEN, 2.4, True),
    ):
        light = scene.light(Signal("tl", 4))
        assert light is not None
        assert (light.state, light.since, light.change_seen) == (state, since, seen)


@pytest.mark.parametrize("name", ["s1-0", "junction-0"])
def test_what_is_known_looking_back_is_where_everybody_was(name: str) -> None:
    whole = recorded(name)
    last = whole.traces[-3]
    time = round((last.sim_time + whole.traces[-2].sim_time) / 2.0, 1)
    assert time > last.sim_time
    back = Ride(up_to(Record(whole.now, whole.traces, whole.events), time))
    assert back.motion(0).time[-1] == time
    for vehicle in last.scene:
        then, known = states_of(back).state(vehicle, time), states_of(whole).state(vehicle, time)
        if then is not None and known is not None and vehicle in whole.traces[-2].scene:
            assert then.position == pytest.approx(known.position, abs=0.05)


def test_a_scene_that_was_kept_counts_rather() -> None:
    traces = decisions(2.0, 3.0)
    kept = seen_between(traces, 2.5)
    assert kept is not None
    moved = replace(kept, vehicles={0: replace(kept.vehicles[0], speed=7.0)})
    known = up_to(Record(3.0, traces, scene=moved), 2.5)
    assert known.scene == moved
    assert Ride(known).motion(0).speed[-1] == 7.0


def test_an_older_scene_that_was_kept_does_not_count() -> None:
    traces = decisions(2.0, 3.0)
    kept = seen_between(traces, 2.2)
    now = up_to(Record(3.0, traces, scene=kept), 2.8).scene
    assert now is not None
    assert now.vehicles[0].position == pytest.approx((28.0, 0.0))


def test_an_older_scene_counts_where_no_later_decision_is_known() -> None:
    traces = decisions(2.0, 3.0)
    kept = seen_between(traces, 2.2)
    assert Ride(Record(2.8, traces[:1], scene=kept)).scene == kept
