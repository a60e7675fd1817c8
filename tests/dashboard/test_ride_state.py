"""What a dashboard hears of a ride, and what it tells browsers of it."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import msgspec
import pytest
from msgspec import structs

from planner.record.light_record import LightCourse, LightPrediction, Showing
from sim.scene import Light, LightState, PersonState, Scene, Signal, Unseen
from tests.fakes import s1_moments
from tests.traces import s1_ride
from xavi_dialogue.bus.interface import Keys
from xavi_dialogue.bus.memory_bus import MemoryHub
from xavi_dialogue.bus.messages import EventReport, SceneReport, TraceReport, unpack
from xavi_dialogue.dashboard import scene_history
from xavi_dialogue.dashboard.ride_state import RideState
from xavi_dialogue.dashboard.scene_history import SceneHistory
from xavi_dialogue.dashboard.trace_cache import TraceCache
from xavi_dialogue.dashboard.web.http_documents import Past
from xavi_dialogue.dashboard.web.websocket_messages import Decisions, Events, Ride, SceneShown
from xavi_dialogue.service.reorder_buffer import ReportOfRide
from xavi_dialogue.vehicle.telemetry import Reporter

KEYS = Keys()


def reports() -> list[ReportOfRide]:
    """All that the car of a made-up ride says, in its order."""
    hub, said = MemoryHub(), []
    listener, car = hub.connect(), hub.connect()
    kinds = {"trace": TraceReport, "event": EventReport, "scene": SceneReport}
    for name, kind in kinds.items():
        hear = lambda _, data, kind=kind: said.append(unpack(data, kind))  # noqa: E731
        listener.subscribe(KEYS.of(name), hear)
    reporter = Reporter(car, KEYS, "s1", 4)
    for moment in s1_moments():
        reporter.record(moment)
        reporter.show(moment, "ended" if moment.ending else "driving", 1.0)
    return said


def past(record: RideState) -> Past:
    return msgspec.json.decode(record.past(), type=Past)


def told(record: RideState, heard: list[ReportOfRide]) -> Iterator[object]:
    for report in heard:
        yield from record.hear(report)[1]


def test_a_ride_is_told_as_it_comes() -> None:
    record = RideState()
    messages = list(told(record, reports()))
    assert sum(isinstance(one, Ride) for one in messages) == 1
    decisions = [d for one in messages if isinstance(one, Decisions) for d in one.decisions]
    assert [d.id for d in decisions] == [trace.trace_id for trace in s1_ride().traces]
    assert [d.changed for d in decisions][:2] == [True, True]
    events = [e for one in messages if isinstance(one, Events) for e in one.events]
    assert [(e.t, e.kind) for e in events] == [(e.sim_time, e.kind) for e in s1_ride().events]
    assert sum(isinstance(one, SceneShown) for one in messages) == 15


def test_who_comes_later_is_told_the_same() -> None:
    record = RideState()
    messages = list(told(record, reports()))
    ride, decisions, events, scene = record.all()
    assert isinstance(decisions, Decisions)
    assert isinstance(events, Events)
    known = [one for one in messages if isinstance(one, Decisions)]
    assert decisions.decisions == tuple(d for one in known for d in one.decisions)
    assert [ride] == [one for one in messages if isinstance(one, Ride)]
    assert scene == [one for one in messages if isinstance(one, SceneShown)][-1]
    assert len(events.events) == len(s1_ride().events)


def test_every_decision_can_be_had_whole() -> None:
    record = RideState()
    list(told(record, reports()))
    for trace in s1_ride().traces:
        assert record.trace_cache.get(trace.trace_id) == trace
    assert record.up_to(4.5) == s1_ride().traces[1]
    assert record.up_to(1.0) is None


def test_another_ride_begins_anew() -> None:
    record, heard = RideState(), reports()
    list(told(record, heard))
    scene = next(one for one in heard if isinstance(one, SceneReport))
    other = msgspec.structs.replace(scene, ride="other", traces=0, events=0)
    begun, messages = record.hear(other)
    assert begun
    assert isinstance(messages[0], Ride)
    assert messages[0].ride == "other"
    assert record.decisions == record.happened == []
    assert len(past(record).scenes) == 1


def test_nothing_is_told_of_a_ride_that_nobody_has_seen() -> None:
    record = RideState()
    assert record.all() == []
    assert past(record).scenes == ()
    trace = next(one for one in reports() if isinstance(one, TraceReport))
    record.hear(trace)
    assert record.ride is None


def test_what_was_missed_is_filled_in_from_histories() -> None:
    moments, trace = SceneHistory(), s1_ride().traces[1]
    ego = trace.scene[0]
    moments.see(Scene(4.0, {0: ego}))
    moments.learn(trace)
    scenes = msgspec.json.decode(moments.document("r"), type=Past).scenes
    times = [time for time, *_ in scenes]
    assert times == moments.times == sorted(times)
    assert times[0] == min(track.start for track in trace.history.values())
    assert times[-1] == 4.0
    assert min(b - a for a, b in pairwise(times)) > 0.15
    assert [vehicle[0] for vehicle in scenes[0][1]] == [
        vehicle for vehicle, track in sorted(trace.history.items()) if track.start <= times[0]
    ]
    before = moments.document("r")
    moments.learn(trace)
    assert moments.document("r") == before


def test_lights_and_hidden_stretches_are_kept() -> None:
    moments, trace = SceneHistory(), s1_ride().traces[1]
    person = PersonState((5.0, 1.0), 0.5, 1.4, 0.2, 0.5)
    light = Light(Signal("J", 3), LightState.RED, 1.0, change_seen=True)
    unseen = Unseen("a_0", 10.0, 22.0)
    moments.see(Scene(4.0, {0: trace.scene[0]}, (light,), {9: person}, (unseen,)))
    green = trace.sim_time - 0.5
    seen = (Showing(0.0, "r?!"), Showing(green, "G?!"))
    course = LightCourse(1.0, seen[1:])
    moments.learn(
        structs.replace(trace, lights=(LightPrediction("K", (0, 1, 2), seen, (course,)),))
    )
    *earlier, last = msgspec.json.decode(moments.document("r"), type=Past).scenes
    assert [one[0] for one in last[1]] == [0, 9]
    assert last[2:] == ((("J 3", "red"),), (("a_0", 10.0, 22.0),))
    for time, _, lights, hidden in earlier:  # from the history; what was hidden is not in it
        assert lights == (("K 0", "green" if time >= green else "red"),)
        assert hidden is None


def test_moments_that_come_too_often_or_late_are_left_out() -> None:
    moments, ego = SceneHistory(), s1_ride().traces[0].scene[0]
    for time in (0.0, 0.1, 0.2, 0.3, 0.4, 0.1):
        moments.see(Scene(time, {0: replace(ego, speed=time)}))
    assert moments.times == [0.0, 0.2, 0.4]


def test_of_very_many_moments_the_latest_are_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(scene_history, "MAX_MOMENTS", 100)
    moments, ego = SceneHistory(), s1_ride().traces[0].scene[0]
    for k in range(1000):
        moments.see(Scene(0.2 * k, {0: ego}))
    assert 80 <= len(moments.times) <= 100
    assert moments.times[-1] == 0.2 * 999
    monkeypatch.setattr(scene_history, "MAX_BYTES", 2000)
    moments.see(Scene(1000.0, {0: ego}))
    for k in range(100):
        moments.see(Scene(1001.0 + k, {0: ego}))
    assert len(moments.document("r")) < 2200


def test_a_shelf_has_room_for_so_much() -> None:
    traces = s1_ride().traces
    trace_cache = TraceCache(room=1)
    for trace in traces:
        trace_cache.put(trace)
    assert all(trace_cache.get(trace.trace_id) is None for trace in traces)
    trace_cache = TraceCache()
    for trace in traces * 2:
        trace_cache.put(trace)
    assert [trace_cache.get(trace.trace_id) for trace in traces] == list(traces)
    assert trace_cache.get("unknown") is None
