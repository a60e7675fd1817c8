"""What is kept of conversations: listed, gone on with, forgotten."""

import json
import sqlite3
import time
from datetime import UTC, datetime
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from planner.record.events import Event
from sim.setup.scenario import load
from xavi_dialogue.__main__ import app
from xavi_dialogue.cli.commands.sessions import typed_file
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.state.turn import Turn
from xavi_dialogue.storage import resume
from xavi_dialogue.storage.conversations import DAY, NewEvent, NewTurn, RideName, Store
from xavi_dialogue.storage.input_history import InputHistory
from xavi_dialogue.storage.turn_log import Retention

SURE = "Are you sure?"


def xavi(*arguments: str, stdin: str | None = None) -> Result:
    return CliRunner().invoke(app, list(arguments), input=stdin)


def new(
    session: str, text: str, ride: RideName | None, wall: float = 0.0, at: float = 8.0
) -> NewTurn:
    reply = Reply(text="So.", kind="answer", sim_time=at)
    return NewTurn(session, ride, wall or time.time(), Turn(text=text, reply=reply))


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """A file with two conversations."""
    file = tmp_path / "dialogue.sqlite3"
    ride, other = RideName("r1", "s1", 4), RideName("r2", "town", 0)
    with Store(file) as store:
        store.keep([new("ada", "Why?", ride, time.time() - 9 * DAY), new("ada", SURE, ride)])
        store.keep([NewEvent(ride, 0, 1.0, Event("arrived", 9.0))])
        store.keep([new("bob", "Tell me " + "more " * 30, other)])
    return file


def test_conversations_are_listed(path: Path) -> None:
    lines = xavi("sessions", "--store", str(path)).stdout.splitlines()
    assert lines[0].split()[:3] == ["session", "turns", "last"]
    assert [line.split()[:2] for line in lines[1:]] == [["ada", "2"], ["bob", "1"]]
    assert lines[1].split()[4:] == ["s1", "4", "at", "0:08", *SURE.split()]
    assert lines[2].endswith(" more ...")
    listed = json.loads(xavi("sessions", "--json", "--store", str(path)).stdout)
    assert [(one["name"], one["turns"], one["scenario"]) for one in listed] == [
        *(("ada", 2, "s1"), ("bob", 1, "town"))
    ]


def test_where_nothing_is_kept_nothing_is_made(tmp_path: Path) -> None:
    file = tmp_path / "none.sqlite3"
    assert xavi("sessions", "--store", str(file)).stdout == "No conversation is kept.\n"
    assert xavi("sessions", "--json", "--store", str(file)).stdout == "[]\n"
    assert xavi("sessions", "--export", "--store", str(file)).stdout == ""
    assert "Nothing" in xavi("forget", "--all", "--yes", "--store", str(file)).stdout
    assert not file.exists()


def test_conversations_are_exported(path: Path) -> None:
    every = xavi("sessions", "--export", "--store", str(path)).stdout.splitlines()
    bobs = xavi("sessions", "bob", "--export", "--store", str(path)).stdout.splitlines()
    assert [json.loads(line).get("session") for line in every] == ["ada", "ada", "bob", None]
    assert bobs == every[2:3]


@pytest.mark.parametrize(
    ("arguments", "erased", "left"),
    [
        (["ada"], "2 turns were", ["bob"]),
        (["bob"], "1 turn was", ["ada"]),
        (["--all"], "3 turns were", []),
        (["--older-than", "7"], "1 turn was", ["ada", "bob"]),
        (["ada", "--older-than", "0"], "2 turns were", ["bob"]),
    ],
)
def test_conversations_are_forgotten(
    path: Path, arguments: list[str], erased: str, left: list[str]
) -> None:
    done = xavi("forget", *arguments, "--yes", "--store", str(path))
    assert (done.exit_code, done.stdout) == (0, f"{erased} erased.\n")
    with Store(path) as store:
        assert [one.name for one in store.sessions()] == left


def test_what_was_typed_is_forgotten_as_well(path: Path) -> None:
    typed_file().parent.mkdir(parents=True, exist_ok=True)
    typed_file().unlink(missing_ok=True)
    for line in ("Why?", SURE, "/save secret.txt", "long " * 1000):
        InputHistory(typed_file(), "ada").append_string(line)
    InputHistory(typed_file(), "bob").append_string("Why?")
    for _ in range(2):  # a question that was cancelled is no turn
        assert xavi("forget", "ada", "--yes", "--store", str(path)).exit_code == 0
        assert typed() == ["Why?"]
        InputHistory(typed_file(), "ada").append_string("cancelled")
    assert xavi("forget", "--older-than", "1", "--yes", "--store", str(path)).exit_code == 0
    assert typed() == ["Why?", "cancelled"]
    assert xavi("forget", "--all", "--yes", "--store", str(path)).exit_code == 0
    assert typed_file().read_bytes() == b""
    InputHistory(typed_file(), "ada").append_string("cancelled")
    path.unlink()
    assert "Nothing" in xavi("forget", "--all", "--yes", "--store", str(path)).stdout
    assert typed_file().read_bytes() == b""


def typed() -> list[str]:
    """What was typed, oldest first."""
    return [*InputHistory(typed_file(), "any").load_history_strings()][::-1]


def test_what_was_typed_and_cannot_be_erased_is_told(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise PermissionError(13, "Permission denied")

    InputHistory(typed_file(), "ada").append_string("Why?")
    monkeypatch.setattr("xavi_dialogue.storage.input_history.erase", fail)
    done = xavi("forget", "ada", "--yes", "--store", str(path))
    assert (done.exit_code, done.stdout) == (1, "")
    assert "typed cannot be erased: Permission denied" in done.stderr


def test_erasing_succeeds_only_when_the_words_are_gone(path: Path) -> None:
    reader = sqlite3.connect(path, isolation_level=None)
    reader.execute("BEGIN")
    reader.execute("SELECT * FROM turns").fetchall()
    for _ in range(2):
        done = xavi("forget", "ada", "--yes", "--store", str(path))
        assert (done.exit_code, done.stdout) == (1, "")
        assert "erase again" in done.stderr
        assert SURE.encode() in words(path)
    reader.close()
    done = xavi("forget", "ada", "--yes", "--store", str(path))
    assert (done.exit_code, SURE.encode() in words(path)) == (2, False)
    assert "there are: bob" in done.stderr


def words(path: Path) -> bytes:
    return b"".join(file.read_bytes() for file in path.parent.glob(f"{path.name}*"))


@pytest.mark.parametrize(
    "arguments",
    [["sessions"], ["sessions", "--export"], ["sessions", "ada"], ["chat", "--session", "ada"]],
)
def test_a_damaged_turn_is_one_clear_line_that_says_how_to_forget_it(
    path: Path, arguments: list[str]
) -> None:
    path.write_bytes(path.read_bytes().replace(SURE.encode(), b"\xff" + SURE.encode()[1:]))
    done = xavi(*arguments, "--store", str(path))
    assert (done.exit_code, "you sure" in done.stdout) == (1, False)
    [line] = done.stderr.splitlines()
    assert f"`xavi forget ada --store {path}`" in line
    assert xavi("sessions", "--json", "bob", "--store", str(path)).exit_code == 0
    assert xavi("forget", "ada", "--yes", "--store", str(path)).stdout == "2 turns were erased.\n"
    assert json.loads(xavi("sessions", "--json", "--store", str(path)).stdout)[0]["name"] == "bob"


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["forget"], "name a session"),
        (["forget", "ada"], "--yes"),  # there is no terminal
        (["forget", "--all", "--older-than", "3", "--yes"], "--all"),
        (["forget", "--all", "ada", "--yes"], "--all"),
        (["forget", "eve", "--yes"], "there are: ada, bob"),
        (["sessions", "eve"], "there are: ada, bob"),
        (["sessions", "eve", "--export"], "there are: ada, bob"),
    ],
)
def test_what_makes_no_sense_erases_nothing(path: Path, arguments: list[str], told: str) -> None:
    done = xavi(*arguments, "--store", str(path))
    assert (done.exit_code, done.stdout) == (2, "")
    assert told in done.stderr
    with Store(path) as store:
        assert [one.turns for one in store.sessions()] == [2, 1]


@pytest.mark.parametrize(
    "arguments", [["sessions"], ["forget", "--all", "--yes"], ["chat", "--session", "ada"]]
)
def test_a_damaged_file_is_one_clear_line(tmp_path: Path, arguments: list[str]) -> None:
    file = tmp_path / "broken"
    file.write_bytes(b"no database at all " * 500)
    done = xavi(*arguments, "--store", str(file))
    assert (done.exit_code, done.stdout) == (1, "")
    [line] = done.stderr.splitlines()
    assert str(file) in line
    assert "--store" in line


def test_the_ride_of_before_is_gone_on_with(path: Path) -> None:
    keeping = Retention(path, 30)
    going = resume.find(keeping, "ada")
    assert (going.place(None), going.place("s2")) == ("s1", "s2")
    assert (going.seed(None, "s1"), going.seed(7, "s1")) == (4, 7)
    assert going.seed(None, "s2") is None
    assert (going.moment(load("s1", 4)), going.moment(load("s1", 7))) == (8.0, None)
    assert going.moment(load("s2", 4)) is None
    assert going.note(8.0, keeping) == "going on with ada: 2 turns, at 0:08"
    assert "of another ride" in going.note(None, keeping)


def test_a_conversation_that_nobody_knows_begins(path: Path) -> None:
    going = resume.find(Retention(path, 30), "eve")
    assert (going.place(None), going.before) == ("s1", None)
    assert going.seed(None, "s1") is None
    fresh = resume.fresh(datetime(2026, 11, 21, 16, 42, 10, tzinfo=UTC), "3f9c")
    assert fresh.session == "20261121-164210-3f9c"
    assert "--session 20261121-164210-3f9c" in fresh.note(None, Retention(path, 30))
    assert "nothing" in fresh.note(None, None)


def test_a_scenario_is_found_again_by_name_or_folder(root: Path, tmp_path: Path) -> None:
    assert resume.known_as(load("s1").place) == "s1"
    assert resume.known_as(load(root / "sim" / "scenarios" / "s1").place) == "s1"
    for source in (root / "sim" / "scenarios" / "s1").iterdir():
        if source.is_file():
            (tmp_path / source.name).write_bytes(source.read_bytes())
    assert resume.known_as(load(tmp_path).place) == str(tmp_path)  # though it says that it is s1
