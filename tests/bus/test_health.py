import threading
from concurrent.futures import ThreadPoolExecutor

from xavi_dialogue import __version__
from xavi_dialogue.bus.health import MEMORY, HealthReporter
from xavi_dialogue.bus.interface import Keys, call
from xavi_dialogue.bus.memory_bus import MemoryHub
from xavi_dialogue.bus.messages import AliveReport, unpack

KEYS = Keys("shuttle-3")


def test_a_component_tells_how_it_fares() -> None:
    now = [100.0]
    alive = HealthReporter("car", ["scenes", "events"], clock=lambda: now[0])
    hub, seen = MemoryHub(), []
    alive.serve(hub.connect(), KEYS)
    hub.connect().watch(KEYS.of("alive/*"), lambda key, there: seen.append((key, there)))
    assert seen == [("xavi/v1/shuttle-3/alive/car", True)]
    alive.count("scenes", 3)
    alive.count("what_ifs_busy")
    alive.gauge("speed", lambda: 2.5)
    alive.at(8.0)
    alive.at(7.0)
    now[0] = 112.5
    told = [
        unpack(call(hub.connect(), KEYS.of("alive/car"), b"", 1.0), AliveReport) for _ in range(2)
    ]
    assert [report.seq for report in told] == [0, 1]
    report = told[0]
    assert (report.component, report.version) == ("car", __version__)
    assert (report.sim_time, report.uptime_s) == (8.0, 12.5)
    assert 1e6 < report.counters[MEMORY] < 1e12
    assert report.counters == {
        "events": 0.0,
        MEMORY: report.counters[MEMORY],
        "scenes": 3.0,
        "speed": 2.5,
        "what_ifs_busy": 1.0,
    }
    assert list(report.counters) == sorted(report.counters)


def test_a_component_that_withdraws_is_not_alive() -> None:
    hub, seen = MemoryHub(), []
    hub.connect().watch(KEYS.of("alive/car"), lambda _, there: seen.append(there))
    HealthReporter("car").serve(hub.connect(), KEYS).withdraw()
    assert seen == [True, False]


def test_no_count_of_any_thread_is_lost() -> None:
    alive, start = HealthReporter("car"), threading.Barrier(4)

    def count() -> None:
        start.wait()
        for _ in range(2000):
            alive.count("scenes")

    with ThreadPoolExecutor(4) as threads:
        for _ in range(4):
            threads.submit(count)
    assert alive.counted("scenes") == 8000
