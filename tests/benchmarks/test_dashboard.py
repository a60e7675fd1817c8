"""Made-up traffic and reports, the browser that is looked for, and how figures are told."""

import math
import sys
from pathlib import Path

import msgspec
import pytest

from benchmarks.figures import figure
from benchmarks.service import browser
from benchmarks.service.browser import NoBrowser
from benchmarks.service.dashboard import Frames, Memory, Report
from benchmarks.service.synthetic_vehicle import SyntheticVehicle, Traffic
from planner.record.events import Event
from sim.roads.network import Network
from sim.setup import scenario
from tests.traces import s1_ride
from xavi_dialogue.bus.interface import Keys, call
from xavi_dialogue.bus.memory_bus import MemoryHub
from xavi_dialogue.bus.messages import (
    EventReport,
    SceneReport,
    TraceReport,
    unpack,
)
from xavi_dialogue.cli.errors import failure
from xavi_dialogue.storage.recording_format import unpacked
from xavi_dialogue.vehicle.episode import network_of


@pytest.fixture(scope="module")
def town() -> Network:
    return network_of(scenario.load("town"))


@pytest.mark.parametrize("count", [3, 300])
def test_traffic_keeps_to_the_roads(town: Network, count: int) -> None:
    traffic = Traffic(town, count, 0)
    for _ in range(50):
        before = traffic.vehicles
        traffic.go_on(0.1)
        after = traffic.vehicles
        assert list(after) == list(range(count))
        for name, state in after.items():
            assert town.locate(state.position, state.heading, reach=0.1), name
            same = before[name]
            assert (state.kind, state.colour, state.speed) == (same.kind, same.colour, same.speed)
    moved = [math.dist(before[name].position, after[name].position) for name in after]
    assert sum(0.3 < distance < 1.5 for distance in moved) > 0.9 * count  # no map goes on forever


def test_traffic_of_a_seed_is_the_same(town: Network) -> None:
    rides = [Traffic(town, 20, seed) for seed in (1, 1, 2)]
    for ride in rides:
        for _ in range(100):
            ride.go_on(0.1)
    one, same, other = (ride.vehicles for ride in rides)
    assert one == same != other


def test_more_vehicles_than_the_roads_hold(town: Network) -> None:
    with pytest.raises(ValueError, match="these roads have room for"):
        Traffic(town, 1_000_000, 0)


def test_a_forged_car_reports_as_a_real_one(town: Network) -> None:
    hub, keys = MemoryHub(), Keys()
    with hub.connect() as bus, hub.connect() as other:
        heard: list[bytes] = []
        there: list[bool] = []
        other.watch(keys.of("alive/car"), lambda _, alive: there.append(alive))
        other.subscribe(keys.of("scene"), lambda _, payload: heard.append(payload))
        car = SyntheticVehicle(bus, keys, scenario.load("town").network)
        car.appear()
        trace = s1_ride().traces[0]
        car.decide(trace)
        car.experience(Event("arrived", 1.0))
        car.see(1.0, Traffic(town, 300, 0).vehicles)
        kept: list[bytes] = []
        other.subscribe(keys.of("trace"), lambda _, payload: kept.append(payload), kept=True)
        other.subscribe(keys.of("event"), lambda _, payload: kept.append(payload), kept=True)
        roads = unpacked(call(other, keys.of("@blob/network"), b"", 1.0))
        car.vanish()
    scene = unpack(heard[0], SceneReport)
    assert (len(scene.vehicles), scene.traces, scene.events) == (300, 1, 1)
    assert unpack(kept[0], TraceReport).trace == trace
    assert unpack(kept[1], EventReport).event == Event("arrived", 1.0)
    assert roads == scenario.load("town").network.read_bytes()
    assert there == [True, False]


def test_which_browser_is_taken(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("XAVI_CHROMIUM", raising=False)
    with pytest.raises(NoBrowser, match="there is no Chromium"):
        browser.program()
    for name in ("google-chrome", "chromium-browser", "chromium"):
        (tmp_path / name).write_text("#!/bin/sh\n")
        (tmp_path / name).chmod(0o755)
        assert browser.program() == str(tmp_path / name)
    monkeypatch.setenv("XAVI_CHROMIUM", str(tmp_path / "google-chrome"))
    assert browser.program() == str(tmp_path / "google-chrome")
    monkeypatch.setenv("XAVI_CHROMIUM", "/nowhere/browser")
    with pytest.raises(NoBrowser, match="'/nowhere/browser', which was not found"):
        browser.program()


@pytest.mark.parametrize(("user", "wanted"), [(0, ["--no-sandbox"]), (1000, [])])
def test_only_root_s_browser_has_no_sandbox(
    monkeypatch: pytest.MonkeyPatch, user: int, wanted: list[str]
) -> None:
    monkeypatch.setattr("os.geteuid", lambda: user)
    assert browser.options() == wanted


def test_without_playwright_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "playwright.sync_api", None)
    with pytest.raises(NoBrowser, match=r"xavi-dialogue\[browser\]") as found, browser.opened():
        raise AssertionError
    known = failure(found.value)
    assert known is not None
    assert known.status == 1


def test_the_report_as_json_and_for_people() -> None:
    report = Report(
        bench="dashboard",
        scenario="town",
        figures=(figure("3 vehicles", "ms", [80.0, 120.0]),),
        frames=(Frames(3, 20.0, 200, 199, 1, 59.9, 1.2, 8.0),),
        vehicles=60,
        memory=(Memory(0.0, 90.0, 3.0), Memory(10.0, 95.0, 4.0)),
        dropped=2,
    )
    assert msgspec.json.decode(msgspec.json.encode(report), type=Report) == report
    table = report.table()
    assert "100.00" in table
    assert "59.9" in table
    assert "95.0" in table
