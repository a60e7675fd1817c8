"""What is kept on disk: kept whole, erased for good, and never trusted blindly."""

import errno
import json
import os
import sqlite3
import stat
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.record.events import Event
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.state.turn import Turn
from xavi_dialogue.storage.conversations import (
    DAY,
    MAX_TURN,
    New,
    NewEvent,
    NewTurn,
    RideName,
    Store,
)
from xavi_dialogue.storage.database import Database
from xavi_dialogue.storage.store_errors import (
    Damaged,
    Newer,
    NotStorable,
    StoreError,
    Unpurged,
    Unwritable,
)

RIDE = RideName("r1", "s1", 4)
SECRET = "xyzzy-plugh"


def turn(text: str = "Why?", at: float = 8.0, answer: str = "So.") -> Turn:
    reply = Reply(text=answer, kind="answer", sim_time=at)
    return Turn(text=text, reply=reply, mentioned=(1,))


def new(text: str = "Why?", session: str = "ada", wall: float = 100.0, **more: object) -> NewTurn:
    fields = {"ride": RIDE, "turn": turn(text), **more}
    return NewTurn(session, wall_time=wall, **fields)  # type: ignore[arg-type]


def event(seq: int = 0, ride: RideName = RIDE) -> NewEvent:
    return NewEvent(ride, seq, 100.0, Event("gave-way", 3.0 + seq, vehicle=2))


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "mine" / "dialogue.sqlite3"


def lines(store: Store, session: str | None = None) -> list[dict[str, object]]:
    return [json.loads(line) for line in store.export(session)]


def test_what_is_kept_is_there_after_opening_again(path: Path) -> None:
    with Store(path) as store:
        store.keep([new("Why?"), new("Are you sure?", wall=101.0)])
        store.keep([new("Hello!", "bob", turn=turn("Hello!", 9.0))])
    with Store(path) as store:
        assert [one.text for one in store.turns("ada", 200)] == ["Why?", "Are you sure?"]
        assert store.turns("ada", 1) == (turn("Are you sure?"),)
        assert store.turns("eve", 200) == ()
        bob, ada = store.sessions()
    assert (ada.name, ada.turns, ada.first, ada.last) == ("ada", 2, 100.0, 101.0)
    assert (ada.scenario, ada.seed, ada.sim_time, ada.question) == ("s1", 4, 8.0, "Are you sure?")
    assert (bob.name, bob.turns, bob.sim_time) == ("bob", 1, 9.0)


def test_a_session_is_listed_with_its_last_turn(path: Path) -> None:
    with Store(path) as store:
        store.keep([new("late by the clock", wall=200.0), new("last", wall=50.0)])
        [listed] = store.sessions()
    assert (listed.question, listed.first, listed.last) == ("last", 50.0, 200.0)


def test_an_event_is_kept_once(path: Path) -> None:
    with Store(path) as store:
        store.keep([new(), event(0), event(1), event(0)])
        store.keep([event(1), event(0, RideName("r2"))])
        kept = [line for line in lines(store) if "event" in line]
    assert [(line["ride"], line["seq"]) for line in kept] == [("r1", 0), ("r1", 1)]


def test_a_ride_learns_what_it_is_later(path: Path) -> None:
    with Store(path) as store:
        store.keep([event(ride=RideName("r9"))])
        store.keep([new(ride=RideName("r9", "town", 3)), new(ride=RideName("r9"))])
        [listed] = store.sessions()
    assert (listed.scenario, listed.seed) == ("town", 3)


def test_a_turn_without_a_ride_is_kept_too(path: Path) -> None:
    with Store(path) as store:
        store.keep([new("Hello?", ride=None)])
        [alone] = store.sessions()
        store.keep(
            [new("Why?"), new("Are you there?", ride=None, turn=turn("Are you there?", 0.0))]
        )
        [listed] = store.sessions()
        assert store.forget("ada") == 3
    assert (alone.scenario, alone.seed, alone.sim_time, alone.question) == (
        None,
        None,
        None,
        "Hello?",
    )
    assert (listed.scenario, listed.seed, listed.sim_time) == ("s1", 4, 8.0)
    assert listed.question == "Are you there?"


def test_exported_lines_say_what_they_are(path: Path) -> None:
    with Store(path) as store:
        store.keep([event(), new("Why?"), new("Hm?", "bob", ride=RideName("r2"))])
        every, bobs = lines(store), lines(store, "bob")
    assert {line["schema"] for line in every} == {"xavi.memory/2"}
    assert [line.get("session") for line in every] == ["ada", "bob", None]
    assert every[0]["number"] == 1
    assert every[0]["wall_time"] == 100.0
    assert every[0]["turn"]["reply"]["text"] == "So."  # type: ignore[index]
    assert every[2]["event"]["kind"] == "gave-way"  # type: ignore[index]
    assert bobs == every[1:2]


def test_all_is_kept_or_nothing(path: Path) -> None:
    big = new(turn=turn(answer="x" * MAX_TURN))
    with Store(path) as store:
        with pytest.raises(NotStorable, match="at most"):
            store.keep([new(), event(), big])
        assert lines(store) == []


def test_nobody_else_can_read_it(path: Path) -> None:
    with Store(path) as store:
        store.keep([new()])
        files = list(path.parent.iterdir())
        assert len(files) > 1
        assert {stat.S_IMODE(file.stat().st_mode) for file in files} == {0o600}
    assert stat.S_IMODE(path.parent.stat().st_mode) == 0o700


def everything(path: Path) -> bytes:
    return b"".join(file.read_bytes() for file in path.parent.iterdir())


@pytest.mark.parametrize("session", ["ada", None])
def test_what_is_forgotten_is_gone_from_the_files(path: Path, session: str | None) -> None:
    with Store(path) as store, Store(path) as other:
        store.keep([new(f"{SECRET} {k} " + "long " * k, wall=k) for k in range(300)])
        other.keep([new("harmless", "bob", ride=RideName("r2")), event(7)])
        assert SECRET.encode() in everything(path)
        assert b"gave-way" in everything(path)
        assert store.forget(session) == (300 if session else 301)
        assert SECRET.encode() not in everything(path)
        assert b"gave-way" not in everything(path)
        assert [one.name for one in other.sessions()] == (["bob"] if session else [])


def reader_of(path: Path) -> sqlite3.Connection:
    """Another program in the middle of reading."""
    reader = sqlite3.connect(path, isolation_level=None)
    reader.execute("BEGIN")
    reader.execute("SELECT * FROM turns").fetchall()
    return reader


def owing(path: Path) -> sqlite3.Connection:
    """A file out of which a session was erased while somebody was reading it."""
    with Store(path, patience=0.05) as store:
        store.keep([new(f"{SECRET} {k} " + "long " * k) for k in range(50)])
        store.keep([new("Hello!", "bob")])
        reader = reader_of(path)
        for _ in range(3):
            with pytest.raises(Unpurged, match="erase again"):
                store.forget("ada")
            assert store.names() == ("bob",)
            assert SECRET.encode() in everything(path)
    return reader


def test_what_is_erased_while_somebody_reads_is_purged_by_the_next_to_forget(path: Path) -> None:
    with Store(path, patience=0.05) as other:
        reader = owing(path)
        size = len(everything(path))
        for _ in range(3):
            with pytest.raises(Unpurged):
                other.forget("eve")
        assert len(everything(path)) < size + 2 * 4096 * 50
        reader.close()
        assert other.forget("eve") == 0
        assert SECRET.encode() not in everything(path)
        assert other.names() == ("bob",)
        assert other.forget("bob") == 1


@pytest.mark.parametrize("next_one", ["opens", "closes", "purges"])
def test_what_is_erased_while_somebody_reads_is_purged_as_soon_as_it_can_be(
    path: Path, next_one: str
) -> None:
    with Store(path, patience=0.05) as other, Store(path) as third:
        reader = owing(path)
        reader.close()
        assert SECRET.encode() in everything(path)
        match next_one:
            case "opens":
                with Store(path):
                    assert SECRET.encode() not in everything(path)
            case "closes":
                third.close()
            case _:
                other.purge()
        assert SECRET.encode() not in everything(path)


def test_what_a_power_cut_left_in_the_log_is_gone_when_a_session_is_erased(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with Store(path) as store:
        store.keep([new("Hello!", "bob")])
        before = path.with_name(f"{path.name}-wal").stat().st_size
        store.keep([new(SECRET)])
        base, log = path.read_bytes(), path.with_name(f"{path.name}-wal").read_bytes()
    torn = bytearray(log)
    torn[before + 8 : before + 24] = bytes(16)  # of the frame, which counts no more
    path.write_bytes(base)
    path.with_name(f"{path.name}-wal").write_bytes(torn)
    monkeypatch.setattr(Database, "_purge_in_passing", lambda _: None)  # somebody was reading
    with Store(path) as store:
        assert store.names() == ("bob",)
        assert SECRET.encode() in everything(path)
        assert store.forget("ada") == 0
        assert SECRET.encode() not in everything(path)


@dataclass
class Flaky:
    """A connection that can neither commit nor roll back at times."""

    real: sqlite3.Connection
    failing: bool = True

    def execute(self, sql: str, *arguments: Any) -> Any:
        if self.failing and sql in ("COMMIT", "ROLLBACK"):
            raise sqlite3.OperationalError("disk I/O error")
        return self.real.execute(sql, *arguments)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.real, name)


def test_a_transaction_that_cannot_be_rolled_back_spoils_none_after_it(path: Path) -> None:
    with Store(path) as store:
        flaky = Flaky(store._file._connection)
        store._file._connection = flaky  # type: ignore[assignment]
        for _ in range(2):
            with pytest.raises(Unwritable, match="I/O error"):
                store.keep([new("lost")])
        flaky.failing = False
        assert store.turns("ada", 9) == ()
        store.keep([new("kept")])
        assert [turn.text for turn in store.turns("ada", 9)] == ["kept"]


def test_what_is_erased_on_a_full_disk_is_purged_when_there_is_room(path: Path) -> None:
    with Store(path) as store, Store(path) as other:
        store.keep([new(f"{SECRET} {k} " + "long " * k) for k in range(50)])
        other.keep([new("Hello!", "bob")])
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(Database, "_compact", no_room)
            with pytest.raises(Unpurged, match="full"):
                store.forget("ada")
        assert store.forget("eve") == 0
        assert SECRET.encode() not in everything(path)


def no_room(_: Database, __: int) -> None:
    raise Unwritable("the disk is full")


def test_what_is_too_old_goes(path: Path) -> None:
    now = 100 * DAY
    with Store(path) as store:
        store.keep([new("old", wall=now - 31 * DAY), event()])
        store.keep([new("young", wall=now - 29 * DAY, ride=RideName("r2"))])
        assert store.expire(30, now) == 1
        assert [one.text for one in store.turns("ada", 9)] == ["young"]
        assert [line for line in lines(store) if "event" in line] == []
        assert store.expire(30, now) == 0


def test_what_was_written_is_brought_to_the_disk(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    synced: list[bytes] = []
    monkeypatch.setattr(os, "fsync", lambda file: synced.append(os.pread(file, 10**6, 0)))
    with Store(path) as store:
        store.keep([new(SECRET)])
        store.sync()
        [log] = synced
        assert SECRET.encode() in log
        monkeypatch.setattr(os, "fsync", fails)
        with pytest.raises(Unwritable, match="Input/output error"):
            store.sync()


def fails(_: int) -> None:
    raise OSError(errno.EIO, os.strerror(errno.EIO))


def test_a_ride_that_others_spoke_of_stays(path: Path) -> None:
    with Store(path) as store:
        store.keep([event(), new(), new("Hm?", "bob")])
        store.forget("ada")
        assert [line.get("session") for line in lines(store)] == ["bob", None]


@dataclass
class Model:
    """What the store should hold."""

    turns: dict[str, list[tuple[int, float, str]]] = field(default_factory=dict)

    def keep(self, name: str, wall: float, text: str) -> None:
        kept = self.turns.setdefault(name, [])
        kept.append((kept[-1][0] + 1 if kept else 1, wall, text))

    def forget(self, name: str | None, before: float | None) -> int:
        erased = 0
        for session in [*self.turns] if name is None else [name] if name in self.turns else []:
            kept = self.turns.pop(session)
            left = [one for one in kept if before is not None and one[1] >= before]
            erased += len(kept) - len(left)
            if left:
                self.turns[session] = left
        return erased


NAMES = st.sampled_from(["ada", "bob", "eve"])
TIMES = st.integers(0, 20).map(float)
STEPS = st.one_of(
    st.tuples(st.just("keep"), NAMES, TIMES, st.text(max_size=20), st.sampled_from(["r1", "r2"])),
    st.tuples(st.just("forget"), st.none() | NAMES, st.none() | TIMES),
    st.tuples(st.just("expire"), st.integers(0, 20), TIMES),
    st.tuples(st.just("reopen")),
)


@given(st.lists(STEPS, max_size=12))
def test_the_store_does_what_a_dictionary_would(
    tmp_path_factory: pytest.TempPathFactory, steps: list[tuple[object, ...]]
) -> None:
    path = tmp_path_factory.mktemp("store") / "d.sqlite3"
    model, store = Model(), Store(path)
    for step in steps:
        match step:
            case ("keep", str(name), float(wall), str(text), str(ride)):
                model.keep(name, wall, text)
                store.keep([new(text, name, wall, ride=RideName(ride)), event(0, RideName(ride))])
            case ("forget", name, before):
                assert store.forget(name, before) == model.forget(name, before)  # type: ignore[arg-type]
            case ("expire", int(days), float(now)):
                gone = model.forget(None, now - days * DAY)
                assert store.expire(days, now) == gone
            case _:
                store.close()
                store = Store(path)
        told = {
            (line["session"], line["number"]): (line["wall_time"], line["turn"]["text"])  # type: ignore[index]
            for line in lines(store)
            if "turn" in line
        }
        assert told == {
            (name, number): (wall, text)
            for name, kept in model.turns.items()
            for number, wall, text in kept
        }
        assert {one.name: one.turns for one in store.sessions()} == {
            name: len(kept) for name, kept in model.turns.items()
        }
    store.close()


WRITER = """
import sys
from pathlib import Path
from tests.storage.test_conversations import new, event
from xavi_dialogue.storage.conversations import Store
with Store(Path(sys.argv[1])) as store:
    for k in range(40):
        store.keep([new(f"{sys.argv[2]} {k}"), event(k)])
"""


def test_two_processes_write_at_once(path: Path, root: Path) -> None:
    writers = [
        subprocess.Popen([sys.executable, "-c", WRITER, str(path), name], cwd=root)
        for name in ("left", "right")
    ]
    assert [writer.wait() for writer in writers] == [0, 0]
    with Store(path) as store:
        said = [one.text for one in store.turns("ada", 200)]
        numbers = [line["number"] for line in lines(store) if "turn" in line]
    assert numbers == list(range(1, 81))
    for name in ("left", "right"):
        assert [text for text in said if name in text] == [f"{name} {k}" for k in range(40)]


def test_a_process_that_is_killed_leaves_whole_turns(path: Path, root: Path) -> None:
    endless = WRITER.replace("range(40)", "range(10**9)").replace(
        "event(k)])", 'event(k)]); print(f"{sys.argv[2]} {k}", flush=True)'
    )
    writer = subprocess.Popen(
        [sys.executable, "-c", endless, str(path), "said"],
        cwd=root,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert writer.stdout is not None
    told = [writer.stdout.readline().strip() for _ in range(50)]
    writer.kill()
    told += writer.stdout.read().splitlines()
    writer.wait()
    writer.stdout.close()
    with Store(path) as store:
        kept = [one.text for one in store.turns("ada", 10**6)]
    whole = [line for line in told if line.startswith("said ")]
    assert len(whole) >= 50
    assert kept[: len(whole) - 1] == whole[:-1]  # the last may have been cut short on its way


def fill(path: Path) -> None:
    with Store(path) as store:
        store.keep([new("long " * 200) for _ in range(100)])


def garbage(path: Path) -> None:
    path.parent.mkdir()
    path.write_bytes(b"no database at all " * 500)


def truncated(path: Path) -> None:
    fill(path)
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def scrambled(path: Path) -> None:
    fill(path)
    data = bytearray(path.read_bytes())
    data[4096:] = bytes(byte ^ 0x55 for byte in data[4096:])
    path.write_bytes(data)


def foreign(path: Path) -> None:
    path.parent.mkdir()
    with sqlite3.connect(path) as other:
        other.execute("CREATE TABLE bookmarks (address)")
    other.close()


def newer(path: Path) -> None:
    fill(path)
    with sqlite3.connect(path) as other:
        other.execute("PRAGMA user_version = 9")
    other.close()


def folder(path: Path) -> None:
    path.mkdir(parents=True)


def no_folder(path: Path) -> None:
    path.parent.write_text("a file in its place")


@pytest.mark.parametrize(
    ("spoil", "error", "words"),
    [
        (garbage, Damaged, "not a database"),
        (truncated, Damaged, "damaged|malformed|not a database"),
        (scrambled, Damaged, "damaged|malformed"),
        (foreign, Damaged, "another program"),
        (newer, Newer, "later version"),
        (folder, Unwritable, "unable to open"),
        (no_folder, Unwritable, "unable to open"),
    ],
)
def test_a_file_that_cannot_be_used_is_named_and_left_alone(
    path: Path, spoil: object, error: type[StoreError], words: str
) -> None:
    spoil(path)  # type: ignore[operator]
    before = path.read_bytes() if path.is_file() else b""
    with pytest.raises(error, match=words) as raised, Store(path) as store:
        store.export()
    assert str(path) in str(raised.value)
    assert "--store" in str(raised.value)
    assert (path.read_bytes() if path.is_file() else b"") == before


def spoil(path: Path, sql: str, *given: object) -> None:
    with sqlite3.connect(path) as other:
        other.execute(sql, given)
    other.close()


def flip(path: Path, before: bytes, after: bytes) -> None:
    """Let bytes decay on the disk."""
    data = path.read_bytes()
    assert before in data
    path.write_bytes(data.replace(before, after))


SPOILT = {
    "another shape": ("UPDATE turns SET turn = '{}' WHERE session = 'ada'", "{turns}{listed}"),
    "no JSON": ("UPDATE turns SET turn = '{]' WHERE session = 'ada'", "{turns}{listed}{lines}"),
    "bytes": ("UPDATE turns SET turn = x'ff' WHERE session = 'ada'", "{turns}{listed}{lines}"),
    "no time": ("UPDATE turns SET sim_time = 'xyz' WHERE session = 'ada'", "{listed}"),
    "no date": ("UPDATE turns SET wall_time = 9e99 WHERE session = 'ada'", "{listed}{lines}"),
    "infinite": ("UPDATE turns SET wall_time = 1e999 WHERE session = 'ada'", "{listed}{lines}"),
    "a place of bytes": ("UPDATE rides SET scenario = x'00'", "{listed}"),
    "an odd number": ("UPDATE turns SET number = 'x' WHERE session = 'ada'", "{lines}"),
    "no event": ("UPDATE events SET event = x'ff'", "{lines}"),
    "a damaged byte": (None, "{turns}{listed}{lines}"),
}


@pytest.mark.parametrize("spoilt", SPOILT)
def test_what_is_damaged_of_a_session_names_it_and_can_be_forgotten(
    path: Path, spoilt: str
) -> None:
    with Store(path) as store:
        store.keep([new(SECRET), event(), new("Hello!", "bob", ride=None)])
    sql, where = SPOILT[spoilt]
    if sql is None:
        flip(path, SECRET.encode(), b"\xff" + SECRET.encode()[1:])
    else:
        spoil(path, sql)
    with Store(path) as store:
        reads = {
            "{turns}": lambda: store.turns("ada", 9),
            "{listed}": store.sessions,
            "{lines}": lambda: lines(store),
        }
        for name, read in reads.items():
            if name in where:
                with pytest.raises(Damaged, match=f"`xavi forget ada --store {path}`"):
                    read()
        assert [one.text for one in store.turns("bob", 9)] == ["Hello!"]
        assert [one.question for one in store.sessions("bob")] == ["Hello!"]
        assert store.names() == ("ada", "bob")
        assert store.forget("ada") == 1
        assert [line.get("session") for line in lines(store)] == ["bob"]


@pytest.mark.parametrize("name", [b"\xff", "a\x1b[31m", ""])
def test_a_damaged_name_can_be_forgotten_with_all_others(path: Path, name: object) -> None:
    with Store(path) as store:
        store.keep([new()])
    spoil(path, "UPDATE turns SET session = CAST(? AS TEXT)", name)
    with Store(path) as store:
        for read in (store.names, store.sessions, lambda: lines(store)):
            with pytest.raises(Damaged, match="`xavi forget --all --store"):
                read()  # type: ignore[operator]
        assert store.forget() == 1


@pytest.mark.parametrize(
    "odd",
    [
        NewEvent(RIDE, 2**63, 100.0, Event("arrived", 3.0)),
        NewTurn("ada", RideName("r1", "s1", 2**63), 100.0, turn()),
        NewTurn("ada", RideName("\udcff"), 100.0, turn()),
        NewTurn("ada", RIDE, 100.0, turn("\udcff")),
        NewTurn("ada", RIDE, float("nan"), turn()),
    ],
    ids=["sequence", "seed", "ride", "text", "time"],
)
def test_what_no_file_can_hold_is_refused_with_all_that_came_with_it(path: Path, odd: New) -> None:
    with Store(path) as store:
        with pytest.raises(StoreError):
            store.keep([new(), odd])
        assert lines(store) == []
        store.keep([new()])
        assert len(lines(store)) == 1


def test_a_folder_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    with pytest.raises(Unwritable, match=r"/proc/none.*--store"):
        Store(Path("/proc/none/dialogue.sqlite3"))


def test_a_full_disk_loses_nothing_that_was_kept(path: Path) -> None:
    with Store(path) as store:
        store.keep([new("first")])
        store.cap(60_000)
        with pytest.raises(Unwritable, match="full"):
            store.keep([new("long " * 300) for _ in range(100)])
        assert [one.text for one in store.turns("ada", 9)] == ["first"]
        store.cap(10**8)
        store.keep([new("second")])
        assert [one.text for one in store.turns("ada", 9)] == ["first", "second"]


def test_who_writes_too_long_is_not_waited_for(path: Path) -> None:
    with Store(path, patience=0.05) as store:
        other = sqlite3.connect(path, isolation_level=None)
        other.execute("BEGIN IMMEDIATE")
        with pytest.raises(Unwritable, match="locked"):
            store.keep([new()])
        other.execute("ROLLBACK")
        other.close()
        store.keep([new()])
        assert len(store.turns("ada", 9)) == 1


def test_a_file_of_the_version_before_is_brought_to_this_one(path: Path) -> None:
    with Store(path) as store:
        store.keep([new("before")])
    with sqlite3.connect(path) as old:  # as the version before had it
        old.execute("DROP TABLE owners")
        old.execute("ALTER TABLE turns DROP COLUMN request")
        old.execute("PRAGMA user_version = 1")
    old.close()
    with Store(path) as store:
        store.keep([new("after", owner="0" * 64, request="q1")])
        assert [one.text for one in store.turns("ada", 9)] == ["before", "after"]
        assert store.owner("ada") == "0" * 64
        found = store.answered("ada", "q1", 0.0)
        assert found is not None
        assert found.text == "after"
        assert store.answered("ada", "q2", 0.0) is None
        assert store.answered("ada", "q1", 1e9) is None


def test_an_owner_is_forgotten_with_the_session_and_is_a_digest(path: Path) -> None:
    with Store(path) as store:
        store.keep([new(owner="0" * 64), new(session="bob", owner="1" * 64)])
        for owner in ("2" * 64, None):
            with pytest.raises(NotStorable, match="somebody else"):
                store.keep([new(owner=owner)])
        assert [store.owner(name) for name in ("ada", "bob", "cat")] == ["0" * 64, "1" * 64, None]
        store.forget("ada")
        assert [store.owner(name) for name in ("ada", "bob")] == [None, "1" * 64]
        store.keep([new(session="cat", owner="no digest")])
        with pytest.raises(Damaged, match="cat"):
            store.owner("cat")


def test_of_turns_that_were_understood_otherwise_text_and_reply_are_kept(path: Path) -> None:
    with Store(path) as store:
        store.keep([new("before")])
    reply = {"text": "So.", "kind": "answer", "sim_time": 8.0, "query": {"type": "why"}}
    turn = {"text": "before", "query": {"type": "why"}, "reply": reply, "focus": {"begin": 1.0}}
    with sqlite3.connect(path) as old:  # as the version before had it
        old.execute("UPDATE turns SET turn = ?", (json.dumps(turn),))
        old.execute("PRAGMA user_version = 2")
    old.close()
    with Store(path) as store:
        [kept] = store.turns("ada", 9)
    assert (kept.text, kept.reply) == ("before", Reply(text="So.", kind="answer", sim_time=8.0))
