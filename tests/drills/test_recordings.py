"""`xavi record` and `xavi replay` as processes on a real bus; without SUMO."""

import os
import resource
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.fakes import s1_moments
from tests.recording.test_player import Listeners, recorded_in
from tests.recording.test_recorder import FakeCar, turn
from xavi_dialogue.bus.interface import Keys, call
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.messages import AliveReport, unpack
from xavi_dialogue.bus.zenoh_bus import ZenohBus, host
from xavi_dialogue.storage.mcap_file import read
from xavi_dialogue.storage.recording_format import Entry

pytestmark = pytest.mark.slow

PATIENCE = 30.0  # [s] that a process may take to get anywhere
KEYS = Keys()


class Hub:
    """A hub in this process, and programs that join it."""

    def __init__(self, folder: Path, root: Path) -> None:
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            self.endpoint = f"tcp/127.0.0.1:{probe.getsockname()[1]}"
        self.folder, self.root = folder, root
        self.bus: ZenohBus = host(Link.of_hub(self.endpoint))
        self.running: list[subprocess.Popen[str]] = []

    def start(self, *arguments: str, **options: object) -> "subprocess.Popen[str]":
        command = [sys.executable, "-m", "xavi_dialogue", *arguments, "--connect", self.endpoint]
        homes = {f"XDG_{kind}_HOME": str(self.folder) for kind in ("DATA", "STATE", "CONFIG")}
        process = subprocess.Popen(
            command,
            cwd=self.root,
            env={**os.environ, **homes},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            **options,  # type: ignore[call-overload]
        )
        self.running.append(process)
        return process  # type: ignore[no-any-return]

    def await_alive(self, component: str, vehicle: str = "car") -> None:
        seen: list[bool] = []
        self.bus.watch(Keys(vehicle).of(f"alive/{component}"), lambda _, up: seen.append(up))
        wait(lambda: any(seen))

    def close(self) -> None:
        for process in self.running:
            process.kill()
            process.communicate()
        self.bus.close()


def wait(there: Callable[[], bool]) -> None:
    give_up = time.monotonic() + PATIENCE
    while not there():
        assert time.monotonic() < give_up, "nothing comes"
        time.sleep(0.02)


@pytest.fixture
def hub(tmp_path: Path, root: Path) -> Iterator[Hub]:
    hub = Hub(tmp_path, root)
    yield hub
    hub.close()


def counted(hub: Hub) -> float:
    payload = call(hub.bus, KEYS.of("alive/recorder"), b"", 5.0)
    return unpack(payload, AliveReport).counters["messages"]


def drive(hub: Hub) -> FakeCar:
    car = FakeCar(hub.bus)
    for moment in s1_moments():
        car.drive(moment)
        time.sleep(0.005)  # scenes may drop
    turns = hub.bus.publisher(KEYS.of("dialogue/ada/turn"), keep=1)
    turns.put(turn(0))
    car.said.append((KEYS.of("dialogue/ada/turn"), turn(0)))
    return car


def entries(path: Path) -> list[Entry]:
    return [one for one in read(path) if isinstance(one, Entry)]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_recording_ends_properly(hub: Hub, tmp_path: Path, number: signal.Signals) -> None:
    path = tmp_path / "ride.mcap"
    recorder = hub.start("record", str(path))
    hub.await_alive("recorder")
    car = drive(hub)
    wait(lambda: counted(hub) >= len(car.said))
    recorder.send_signal(number)
    _, told = recorder.communicate(timeout=PATIENCE)
    assert recorder.returncode == 0
    assert f"{len(car.said)} messages are in {path}" in told
    assert sorted((one.key, one.payload) for one in entries(path)) == sorted(car.said)
    again = hub.start("record", str(path))
    _, told = again.communicate(timeout=PATIENCE)
    assert (again.returncode, told.count("\n")) == (2, 1)
    assert "is there already; --force overwrites it" in told


def test_killed_it_leaves_what_it_had_written(hub: Hub, tmp_path: Path) -> None:
    path = tmp_path / "ride.mcap"
    recorder = hub.start("record", str(path))
    hub.await_alive("recorder")
    car = drive(hub)
    wait(lambda: len(entries(path)) == len(car.said))
    recorder.kill()
    recorder.communicate(timeout=PATIENCE)
    assert sorted((one.key, one.payload) for one in entries(path)) == sorted(car.said)


def test_a_full_disk_is_told_in_one_line(hub: Hub, tmp_path: Path) -> None:
    path = tmp_path / "ride.mcap"
    limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))  # noqa: E731
    recorder = hub.start("record", str(path), "--log", "off", preexec_fn=limit)
    hub.await_alive("recorder")
    drive(hub)
    _, told = recorder.communicate(timeout=PATIENCE)
    assert recorder.returncode == 1
    *before, last = told.splitlines()
    assert "any further" in last
    assert all("recording into" in line or "does not tell its roads" in line for line in before)
    list(read(path))


def test_a_recording_is_played_to_others(hub: Hub, tmp_path: Path) -> None:
    path = tmp_path / "ride.mcap"
    recorded_in(path, s1_moments())
    listeners = Listeners(hub.bus)
    player = hub.start("replay", str(path), "--speed", "0")
    hub.await_alive("car")
    assert player.stdin is not None
    wait(lambda: any(scene.state == "ended" for scene in listeners.scenes))
    player.stdin.write("seek 2.0\n")
    player.stdin.flush()
    wait(lambda: listeners.scenes[-1].orders == 1)
    second = hub.start("replay", str(path))
    _, told = second.communicate(timeout=PATIENCE)
    assert (second.returncode, told.count("\n")) == (1, 1)
    assert "there is a car named 'car' on this bus already" in told
    other = hub.start("replay", str(path), "--vehicle", "other")
    hub.await_alive("car", "other")
    other.send_signal(signal.SIGTERM)
    other.communicate(timeout=PATIENCE)
    player.communicate("quit\n", timeout=PATIENCE)
    assert player.returncode == other.returncode == 0
    traces = [moment.trace for moment in s1_moments() if moment.trace is not None]
    assert [report.trace for report in listeners.traces] == traces
    assert [report.seq for report in listeners.scenes] == sorted(r.seq for r in listeners.scenes)


@pytest.mark.parametrize("connected", [True, False])
def test_what_is_no_recording_is_told_in_one_line(
    hub: Hub, tmp_path: Path, root: Path, connected: bool
) -> None:
    path = tmp_path / "ride.mcap"
    path.write_bytes(b"\x00" * 1000)
    if connected:
        process = hub.start("replay", str(path))
    else:
        command = [sys.executable, "-m", "xavi_dialogue", "replay", str(path), "--keep-days", "0"]
        process = subprocess.Popen(
            command, cwd=root, stdin=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        hub.running.append(process)
    _, told = process.communicate(timeout=PATIENCE)
    assert (process.returncode, told) == (2, f"xavi: {path} is not an MCAP file\n")


def asked(hub: Hub, root: Path, lines: str, *arguments: str) -> tuple[str, str]:
    """What `xavi replay` answers through a pipe, and what it notes."""
    command = [sys.executable, "-m", "xavi_dialogue", "replay", *arguments, "--keep-days", "0"]
    process = subprocess.Popen(
        command,
        cwd=root,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    hub.running.append(process)
    told = process.communicate(lines, timeout=2 * PATIENCE)
    assert process.returncode == 0, told[1]
    return told


def test_past_its_end_a_recording_is_asked_about_its_last_moment(
    hub: Hub, tmp_path: Path, root: Path
) -> None:
    path, whole = tmp_path / "ride.mcap", tmp_path / "whole.mcap"
    recorded_in(path, iter(list(s1_moments())[:5]))
    recorded_in(whole, s1_moments())
    question = "What are you doing?\n"
    said, notes = asked(hub, root, f"@ 2.0s\n{question}@ 15s\n{question}", str(path))
    first, second = said.splitlines()
    assert first.endswith("at 36 km/h.")
    assert second.endswith("at 36 km/h.")
    assert notes.count("the recording ends at 0:02") == 1
    from_there, notes = asked(hub, root, question, str(path), "--from", "15")
    assert from_there == f"{first}\n"
    assert "the recording ends at 0:02" in notes
    [over] = asked(hub, root, f"@ 99s\n{question}", str(whole))[0].splitlines()
    assert "longer than I may keep you waiting" not in over


def test_lines_that_are_no_orders_are_told(hub: Hub, tmp_path: Path) -> None:
    path = tmp_path / "ride.mcap"
    recorded_in(path, iter(list(s1_moments())[:5]))
    player = hub.start("replay", str(path), "--log", "off")
    _, told = player.communicate("bogus\nspeed -3\nseek 15\nquit\n", timeout=PATIENCE)
    assert player.returncode == 0
    lines = told.splitlines()
    for line in (
        "xavi: 'bogus' is not a command; write one such as pause, resume or speed 2.0",
        "xavi: '-3' is not a number of 0 or more",
        "xavi: the recording ends at 0:02",
    ):
        assert lines.count(line) == 1
