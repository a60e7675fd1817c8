"""Car, service and chat as processes that speak Zenoh; none is left behind."""

import fcntl
import json
import os
import pty
import select
import shutil
import signal
import struct
import subprocess
import sys
import termios
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from xavi_dialogue.bus.sanitize import clean
from xavi_dialogue.chat.vehicle_supervisor import AGAIN

pytestmark = pytest.mark.slow

PATIENCE = 60.0  # [s] before a test gives up on what never comes


def children(pid: int) -> list[int]:
    """The processes that a process has started."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[1]) == pid:
            found.append(int(stat.parent.name))
    return sorted(found)


def alive(pid: int) -> bool:
    """Whether a process is there, and no zombie that its new parent has not noticed yet."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def until(condition: Callable[[], bool]) -> bool:
    give_up = time.monotonic() + PATIENCE
    while time.monotonic() < give_up:
        if condition():
            return True
        time.sleep(0.05)
    return False


class Chat:
    """A chat through a pipe."""

    def __init__(self, *arguments: str) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-m", "xavi_dialogue", "chat", *arguments],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )

    def say(self, line: str) -> None:
        assert self.process.stdin is not None
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def hear(self) -> str:
        assert self.process.stdout is not None
        return self.process.stdout.readline().rstrip("\n")

    def end(self) -> tuple[int, str, str]:
        out, err = self.process.communicate(timeout=PATIENCE)
        return self.process.returncode, out, err


@pytest.fixture
def chat() -> Iterator[Chat]:
    """A chat that has answered once, so that all its processes are up."""
    begun = Chat("--scenario", "s2")
    begun.say("Hello!")
    assert begun.hear()
    yield begun
    begun.process.kill()
    begun.process.communicate()


def test_a_conversation_through_a_pipe() -> None:
    chat = Chat("--scenario", "s1", "--json")
    chat.say("What are you doing?")
    first = json.loads(chat.hear())
    left_behind = children(chat.process.pid)
    assert len(left_behind) == 2
    for line in ("@ 1.0s", "", "What are you doing?", "/frob", "@ 8.0 s", "What are you doing?"):
        chat.say(line)
    status, out, err = chat.end()
    later = [json.loads(line) for line in out.splitlines()]
    assert status == 0
    assert [reply["sim_time"] for reply in later] == [1.0, 8.0]
    assert first["text"] not in {reply["text"] for reply in later}
    assert "/frob" in err
    assert "Traceback" not in err
    assert until(lambda: not any(map(alive, left_behind)))


def test_the_same_questions_get_the_same_bytes_over_the_bus_and_in_one_process() -> None:
    question = "Why did you do that?"
    asked = subprocess.run(
        [sys.executable, "-m", "xavi_dialogue", "ask", question, "--scenario", "s1"],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PYTHONHASHSEED": "7"},
    )
    chat = Chat("--scenario", "s1")
    chat.say(question)
    status, out, _ = chat.end()
    assert (status, out) == (0, asked.stdout)


@pytest.mark.parametrize(
    ("number", "status"), [(signal.SIGKILL, -9), (signal.SIGTERM, 143), (signal.SIGINT, 130)]
)
def test_no_process_outlives_the_chat(chat: Chat, number: signal.Signals, status: int) -> None:
    started = children(chat.process.pid)
    assert len(started) == 2
    chat.process.send_signal(number)
    assert chat.process.wait(PATIENCE) == status
    assert until(lambda: not any(map(alive, started)))


def test_the_ride_of_a_car_that_is_killed_is_driven_on_and_told_the_same(chat: Chat) -> None:
    car = child(chat, b"drive")
    os.kill(car, signal.SIGKILL)
    chat.say("Where are you going?")  # answered from the record, or from that of the new car
    assert chat.hear()
    chat.say("@ 11s")
    chat.say("What if you had not turned right?")
    assert "destination" in chat.hear()
    assert child(chat, b"drive") != car
    os.kill(child(chat, b"serve"), signal.SIGKILL)  # and the next one goes on as well
    chat.say("What if you had not turned right?")
    assert chat.hear().startswith("As I said, ")
    status, _, err = chat.end()
    assert status == 0
    assert err.count(AGAIN) == 1
    assert "Traceback" not in err


def test_others_ask_a_car_that_is_under_way_over_its_hub(chat: Chat, tmp_path: Path) -> None:
    words = command(child(chat, b"serve")).decode().split("\0")
    there = ["--connect", words[words.index("--listen") + 1], "--json"]
    answer = xavi("ask", "What are you doing?", "--at", "2", "--session", "bea", *there)
    told = json.loads(answer.stdout)
    assert (answer.returncode, told["kind"], told["sim_time"]) == (0, "answer", 2.0)
    other = {**os.environ, "XDG_STATE_HOME": str(tmp_path)}
    foreign = xavi("ask", "Why?", "--session", "bea", *there, env=other)
    assert foreign.returncode == 3
    assert "belongs to somebody else" in json.loads(foreign.stdout)["text"]
    nobody = xavi("ask", "Why?", "--vehicle", "bus-7", *there)
    assert (nobody.returncode, json.loads(nobody.stdout)["reason"]) == (5, "planner-unavailable")
    assert "there is car" in json.loads(nobody.stdout)["text"]


def test_a_child_that_cannot_start_is_named(root: Path, tmp_path: Path) -> None:
    folder = tmp_path / "mine"
    shutil.copytree(root / "sim" / "scenarios" / "s1", folder)
    routes = folder / "s1.rou.xml"
    routes.write_text(routes.read_text().replace('departLane="0"', 'departLane="9"', 1))
    status, out, err = Chat("--scenario", str(folder)).end()
    assert (status, out) == (1, "")
    [message] = [line for line in err.splitlines() if "has ended" in line]
    assert message.startswith("xavi: the car has ended (exit status 1): ")
    assert "s1.rou.xml: SUMO refuses it: " in message
    assert "Traceback" not in err


def test_a_conversation_at_a_terminal(tmp_path: Path) -> None:
    keyboard, line = pty.openpty()
    fcntl.ioctl(line, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 100, 0, 0))
    chat = subprocess.Popen(
        [sys.executable, "-m", "xavi_dialogue", "chat", "--scenario", "s2", "--speed", "4"],
        stdin=line,
        stdout=line,
        stderr=line,
        start_new_session=True,
        env={**os.environ, "XDG_STATE_HOME": str(tmp_path), "TERM": "xterm", "NO_COLOR": "1"},
    )
    os.close(line)
    screen = Screen(keyboard)
    try:
        assert screen.shows("Ask about the ride")
        assert screen.shows("/pause")
        started = children(chat.pid)
        assert len(started) == 2
        assert screen.shows(" km/h")
        screen.type("What are you doing?\r")
        assert screen.shows("I am ")
        assert screen.shows("I turn right.")
        assert screen.shows("We have arrived.")
        screen.type("Where are we going?\r")
        assert screen.shows("We have arrived at our destination.")
        screen.type("\x04")
        assert chat.wait(PATIENCE) == 0
        assert until(lambda: not any(map(alive, started)))
        history = (tmp_path / "xavi-dialogue" / "history").read_text()
        assert "+What are you doing?" in history
    finally:
        chat.kill()
        chat.wait()
        os.close(keyboard)


class Screen:
    """The far end of a terminal."""

    def __init__(self, end: int) -> None:
        self.end = end
        self.seen = ""

    def type(self, keys: str) -> None:
        os.write(self.end, keys.encode())

    def shows(self, text: str) -> bool:
        """Whether a text appears, after what was looked for before."""

        def appears() -> bool:
            if select.select([self.end], [], [], 0.05)[0]:
                came = os.read(self.end, 65536).decode(errors="replace")
                assert "\x1b[6n" not in came, "the terminal is asked where its cursor is"
                self.seen += clean(came)
            return text in self.seen

        found = until(appears)
        assert found, f"{text!r} is not shown in:\n{self.seen}"
        self.seen = self.seen.partition(text)[2]
        return True


def xavi(*arguments: str, env: dict[str, str] | None = None) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "xavi_dialogue", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False, env=env)


def child(chat: Chat, word: bytes) -> int:
    """The process that was started with a command."""
    return next(pid for pid in children(chat.process.pid) if word in command(pid))


def command(pid: int) -> bytes:
    return Path(f"/proc/{pid}/cmdline").read_bytes()
