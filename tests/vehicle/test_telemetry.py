"""What is reported of a ride, and how the car fares meanwhile."""

import pytest

from tests.fakes import s1_moments
from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import Keys
from xavi_dialogue.bus.memory_bus import MemoryHub
from xavi_dialogue.bus.messages import (
    EventReport,
    SceneReport,
    TraceReport,
    schema_name,
    unpack,
)
from xavi_dialogue.vehicle.telemetry import LATELY, RateMeter, Reporter

KEYS = Keys("shuttle-3")


def test_reports_are_numbered_without_gaps_and_counted() -> None:
    hub, alive = MemoryHub(), HealthReporter("car")
    heard: dict[str, list[bytes]] = {KEYS.of(name): [] for name in ("scene", "trace", "event")}
    for key in heard:
        hub.connect().subscribe(key, lambda key, told: heard[key].append(told))
    reporter = Reporter(hub.connect(), KEYS, "s1", 4, alive)
    for moment in s1_moments():
        reporter.record(moment)
        reporter.show(moment, "driving", 2.0)
    scenes = [unpack(told, SceneReport) for told in heard[KEYS.of("scene")]]
    traces = [unpack(told, TraceReport) for told in heard[KEYS.of("trace")]]
    events = [unpack(told, EventReport) for told in heard[KEYS.of("event")]]
    for reports in (scenes, traces, events):
        assert [report.seq for report in reports] == list(range(len(reports)))
        assert {report.ride for report in reports} == {scenes[0].ride}
    last = scenes[-1]
    assert (last.traces, last.events) == (len(traces), len(events))
    assert (last.scenario, last.seed) == ("s1", 4)
    told = alive.report()
    assert told.sim_time == last.sim_time
    counts = {"scenes": len(scenes), "decisions": len(traces), "events": len(events)}
    assert {name: told.counters[name] for name in counts} == counts
    assert min(counts.values()) > 0


def test_every_report_says_what_it_is() -> None:
    hub = MemoryHub()
    hub.connect().subscribe(
        KEYS.of("*"), lambda key, told: seen.update({key.rpartition("/")[2]: told})
    )
    seen: dict[str, bytes] = {}
    reporter = Reporter(hub.connect(), KEYS)
    for moment in s1_moments():
        reporter.record(moment)
        reporter.show(moment, "driving", 1.0)
    for name, kind in (("scene", SceneReport), ("trace", TraceReport), ("event", EventReport)):
        assert f'"schema":"{schema_name(kind)}"'.encode() in seen[name]


def test_the_speed_of_the_simulation_is_measured_over_the_latest_seconds() -> None:
    now = [100.0]
    meter = RateMeter(lambda: now[0])
    assert meter.read() == 0.0
    meter.note(0.0)
    assert meter.read() == 0.0
    for step in range(1, 201):  # 20 s, at twice the time
        now[0] += 0.1
        meter.note(0.2 * step)
    assert meter.read() == pytest.approx(2.0)
    now[0] += 0.5 * LATELY  # it halts
    assert meter.read() == pytest.approx(1.0, abs=0.05)
    now[0] += LATELY
    assert meter.read() == 0.0
