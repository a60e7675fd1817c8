"""Conversations outlive their processes, killed at any moment."""

import json
import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from tests.vehicle.pool_jobs import children, there, until
from xavi_dialogue.__main__ import app
from xavi_dialogue.process.subprocesses import Child, ChildFailed, RestartedChild
from xavi_dialogue.storage.conversations import Store

PATIENCE = 120.0  # [s] before a test gives up on what never comes
WHY = "Why did you do that?"
SURE = "Are you sure?"
RIDE = ("--scenario", "s1", "--seed", "4")


def xavi(*arguments: str) -> Result:
    return CliRunner().invoke(app, list(arguments))


class Chat:
    """A chat through a pipe, with the file it keeps its words in."""

    def __init__(self, store: Path, *arguments: str) -> None:
        command = [sys.executable, "-m", "xavi_dialogue", "chat", "--store", str(store)]
        self.process = subprocess.Popen(
            [*command, *arguments],
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

    def ask(self, line: str) -> str:
        self.say(line)
        assert self.process.stdout is not None
        return self.process.stdout.readline().rstrip("\n")

    def kill(self) -> str:
        """End the chat and all that it has started, at once; what it had still printed."""
        pids = [self.process.pid, *children(self.process.pid)]
        for pid in pids:
            os.kill(pid, signal.SIGKILL)
        out, _ = self.process.communicate()
        assert until(lambda: not any(map(there, pids)))
        return out

    def end(self) -> tuple[int, str, str]:
        out, err = self.process.communicate(timeout=PATIENCE)
        return self.process.returncode, out, err


@pytest.fixture
def chats(tmp_path: Path) -> Iterator[list[Chat]]:
    """Those that are to be ended in the end."""
    begun: list[Chat] = []
    yield begun
    for chat in begun:
        chat.process.kill()
        chat.process.communicate()


@pytest.fixture(scope="module")
def wanted(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    """What is answered where nothing is killed."""
    calm = Chat(tmp_path_factory.mktemp("calm") / "dialogue.sqlite3", *RIDE)
    answers = [calm.ask(line) for line in (WHY, SURE, SURE)]
    calm.end()
    return answers


def kept(store: Path, session: str) -> list[tuple[str, str]]:
    """Questions and answers on disk."""
    with Store(store) as file:
        return [(turn.text, turn.reply.text) for turn in file.turns(session, 200)]


@pytest.mark.slow
@pytest.mark.parametrize("moment", range(3))
def test_what_was_shown_is_there_after_a_kill_and_leant_on(
    tmp_path: Path, chats: list[Chat], wanted: list[str], moment: int
) -> None:
    store = tmp_path / "dialogue.sqlite3"
    first = Chat(store, *RIDE, "--session", "ada")
    chats.append(first)
    shown = [first.ask(WHY)]
    first.say(SURE)
    time.sleep(random.Random(moment).uniform(0.0, 0.1))
    shown += first.kill().splitlines()
    known = kept(store, "ada")
    assert known[: len(shown)] == list(zip((WHY, SURE), shown, strict=False))
    lines = xavi("sessions", "ada", "--export", "--store", str(store)).stdout.splitlines()
    said = [line["turn"] for line in map(json.loads, lines) if "turn" in line]
    assert [turn["reply"]["text"] for turn in said] == wanted[: len(known)]
    later = Chat(store, "--session", "ada")
    chats.append(later)
    assert later.ask(SURE) == wanted[len(known)]
    status, _, err = later.end()
    assert status == 0
    assert "driving s1, seed 4" in err
    assert "going on with ada" in err


@pytest.mark.slow
def test_a_conversation_goes_on_at_the_moment_of_its_last_question(
    tmp_path: Path, chats: list[Chat]
) -> None:
    store = tmp_path / "dialogue.sqlite3"
    for lines, noted in (
        (["Hello!", "@ 2.0s", "Hello!"], "driving s1"),
        (["Hello!"], "asking at 2.0 s"),
    ):
        chats.append(Chat(store, *RIDE, "--session", "ada"))
        for line in lines:
            chats[-1].say(line)
        status, _, err = chats[-1].end()
        assert (status, noted in err) == (0, True)
    with Store(store) as file:
        assert [turn.reply.sim_time for turn in file.turns("ada", 9)][1:] == [2.0, 2.0]


@pytest.mark.slow
def test_when_the_service_is_killed_the_conversation_goes_on(
    tmp_path: Path, chats: list[Chat], wanted: list[str]
) -> None:
    store = tmp_path / "dialogue.sqlite3"
    chat = Chat(store, *RIDE, "--session", "ada")
    chats.append(chat)
    said = [chat.ask(WHY)]
    for pid in children(chat.process.pid):
        if b"serve" in Path(f"/proc/{pid}/cmdline").read_bytes():
            os.kill(pid, signal.SIGKILL)
    said.append(chat.ask(SURE))
    status, _, _ = chat.end()
    assert (status, said) == (0, wanted[:2])
    assert kept(store, "ada") == list(zip((WHY, SURE), said, strict=True))


@pytest.mark.slow
def test_nothing_is_written_where_nothing_is_to_be_kept(tmp_path: Path, chats: list[Chat]) -> None:
    store = tmp_path / "dialogue.sqlite3"
    chat = Chat(store, "--scenario", "s1", "--keep-days", "0")
    chats.append(chat)
    assert chat.ask("Hello!")
    status, _, err = chat.end()
    assert (status, store.exists()) == (0, False)
    assert "nothing of this conversation is kept" in err


@pytest.mark.slow
def test_the_passenger_is_warned_where_nothing_can_be_kept(
    tmp_path: Path, chats: list[Chat]
) -> None:
    store = tmp_path / "dialogue.sqlite3"
    store.write_bytes(b"no database at all " * 500)
    chat = Chat(store, "--scenario", "s1")
    chats.append(chat)
    assert chat.ask("Hello!")
    status, _, err = chat.end()
    assert status == 0
    [warning] = [line for line in err.splitlines() if "warning" in line]
    assert str(store) in warning


@pytest.mark.slow
def test_a_child_is_started_anew_only_so_often() -> None:
    def gone() -> bool:
        try:
            steady.check()
        except ChildFailed as error:
            return str(error).startswith("the hub has ended")
        return False

    with RestartedChild(lambda: Child("the hub", ["serve", "--listen", "nonsense"])) as steady:
        first = steady.pid
        assert until(gone)
        assert steady.pid == first
        steady.spare = 1
        steady.check()
        assert steady.pid != first
        assert until(gone)
