"""Recordings as files: what was written is read, also of files cut off or made to harm."""

import json
import os
import re
import resource
import struct
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import msgspec
import pytest
import zstandard
from mcap.reader import make_reader
from mcap.writer import CompressionType, Writer

from planner.record.events import Event
from sim.scene import VehicleState
from tests.traces import s1_ride
from xavi_dialogue.bus.messages import (
    EventReport,
    PastTurn,
    SceneReport,
    TraceReport,
    TurnReport,
    pack,
    schema_name,
)
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.storage import mcap_file, recording_format
from xavi_dialogue.storage.mcap_file import McapWriter, read
from xavi_dialogue.storage.message_format import schema_to_view
from xavi_dialogue.storage.recording_format import (
    RECORDED,
    AttachedFile,
    Entry,
    FileThere,
    NotARecording,
    NothingToPlay,
    Piece,
    TooMuch,
    Truncation,
    Unwritable,
    read_ride,
)

EGO = VehicleState((0.0, 0.0), 0.0, 10.0, 0.0, 4.5, 1.8)
OTHER = VehicleState((20.0, 0.5), 0.1, 5.0, -1.0, 4.5, 1.8, "truck", "red", ("left",))
NOW = 1_800_000_000 * 10**9


def scene(k: int, ride: str = "r1") -> SceneReport:
    return SceneReport(
        ride=ride,
        seq=k,
        sim_time=k / 10,
        wall_time=1.8e9 + k / 10,
        vehicles={0: EGO, 1: OTHER},
        state="driving",
        speed_factor=1.0,
        plan=("continue", "exit-left"),
        traces=min(k, 2),
        events=min(k, 1),
        scenario="s1",
        seed=3,
    )


def entry(key: str, report: Any, logged: int | None = None) -> Entry:
    published = round(report.wall_time * 1e9)
    return Entry(f"xavi/v1/{key}", pack(report), report.seq, published, logged or NOW + report.seq)


def entries(vehicle: str = "car", ride: str = "r1") -> list[Entry]:
    common = {"ride": ride, "wall_time": 1.8e9}
    traces = [
        TraceReport(seq=k, sim_time=trace.sim_time, trace=trace, **common)
        for k, trace in enumerate(s1_ride().traces[:2])
    ]
    event = EventReport(seq=0, sim_time=0.1, event=Event("gave-way", 0.1, vehicle=1), **common)
    reply = Reply(text="Yes.", kind="answer", sim_time=0.2)
    turn = TurnReport(
        session="ada", seq=0, sim_time=0.2, wall_time=1.8e9, turn=PastTurn("Why?", reply)
    )
    return [
        *(entry(f"{vehicle}/scene", scene(k, ride)) for k in range(5)),
        *(entry(f"{vehicle}/trace", trace) for trace in traces),
        entry(f"{vehicle}/event", event),
        entry(f"{vehicle}/dialogue/ada/turn", turn),
    ]


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "ride.mcap"


def write(path: Path, what: Sequence[Entry], networks: dict[str, bytes] | None = None) -> None:
    with McapWriter(path, "1.2.3") as file:
        for one in what:
            assert file.add(one)
        for name, data in (networks or {}).items():
            file.attach(name, data, NOW)
        file.describe("xavi.ride", {"vehicle": "car", "seed": "3"})


def test_what_is_written_is_read_by_us_and_by_the_library(path: Path) -> None:
    written = entries()
    write(path, written, {"car/r1.net.xml.gz": b"roads"})
    pieces = list(read(path))
    assert [one for one in pieces if isinstance(one, Entry)] == written
    assert [one for one in pieces if not isinstance(one, Entry)] == [
        AttachedFile("car/r1.net.xml.gz", b"roads")
    ]
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        assert reader.get_header().profile == "xavi"
        found = [
            Entry(
                channel.topic,
                message.data,
                message.sequence,
                message.publish_time,
                message.log_time,
            )
            for _, channel, message in reader.iter_messages(log_time_order=False)
        ]
        assert found == written
        summary = reader.get_summary()
        assert summary is not None
        assert summary.statistics is not None
        assert summary.statistics.message_count == len(written)
        assert len(summary.chunk_indexes) == 1
        [facts] = reader.iter_metadata()
        assert (facts.name, facts.metadata) == ("xavi.ride", {"vehicle": "car", "seed": "3"})
        [attached] = reader.iter_attachments()
        assert attached.data == b"roads"


def test_every_message_fits_the_schema_that_stands_in_the_file(path: Path) -> None:
    write(path, entries())
    seen = set()
    with path.open("rb") as file:
        for schema, channel, message in make_reader(file).iter_messages():
            assert schema is not None
            assert (schema.encoding, channel.message_encoding) == ("jsonschema", "json")
            assert faults(json.loads(message.data), json.loads(schema.data)) == []
            broken = json.loads(message.data) | {"seq": "one", "schema": 7}
            assert len(faults(broken, json.loads(schema.data))) == 2
            seen.add(schema.name)
    assert seen == {schema_name(kind) for kind in RECORDED.values()}


@pytest.mark.parametrize("kind", RECORDED.values(), ids=lambda kind: kind.__name__)
def test_viewers_can_read_the_schemas(kind: type[msgspec.Struct]) -> None:
    """They know scalars, objects with properties, and lists of either, each by its one `type`."""
    schema = schema_to_view(kind)
    assert "$ref" not in json.dumps(schema)
    assert datatypes(schema) > 5
    assert {"schema", "seq", "sim_time", "wall_time"} <= set(schema["properties"])


def datatypes(schema: dict[str, Any]) -> int:
    """How many fields a viewer sees."""
    assert schema["type"] == "object"
    count = 0
    for one in schema["properties"].values():
        kind = one["type"]
        if kind == "array":
            one = one["items"]
            kind = one["type"]
            assert kind != "array"
        count += datatypes(one) if kind == "object" else 1
        assert kind in ("object", "string", "number", "integer", "boolean")
    return count


def faults(value: Any, schema: dict[str, Any]) -> list[str]:
    """What is wrong with a value, as far as our schemas go; refuses keywords it does not know."""
    known = {"$schema", "title", "description", "default", "type", "enum", "const", "properties"}
    known |= {"required", "items", "additionalProperties", "minimum", "maximum", "minLength"}
    known |= {"maxLength", "pattern", "minItems", "maxItems", "anyOf", "prefixItems"}
    assert set(schema) <= known
    if "anyOf" in schema:
        return [] if any(not faults(value, one) for one in schema["anyOf"]) else [str(value)]
    types = {"object": dict, "array": list, "string": str, "integer": int, "boolean": bool}
    types |= {"number": (int, float), "null": type(None)}
    if "type" in schema and not isinstance(value, types[schema["type"]]):
        return [f"{value!r} is no {schema['type']}"]
    if "const" in schema and value != schema["const"]:
        return [f"{value!r} is not {schema['const']!r}"]
    if "enum" in schema and value not in schema["enum"]:
        return [f"{value!r} is none of {schema['enum']}"]
    found: list[str] = []
    if isinstance(value, dict):
        found += [name for name in schema.get("required", ()) if name not in value]
        rest = schema.get("additionalProperties", {})
        for name, one in value.items():
            found += faults(one, schema.get("properties", {}).get(name, rest))
    if isinstance(value, list) and isinstance(schema.get("items"), dict):
        found += [fault for one in value for fault in faults(one, schema["items"])]
    return found


def test_the_file_is_the_owners_alone_and_no_other_is_overwritten(path: Path) -> None:
    write(path, entries())
    assert path.stat().st_mode & 0o777 == 0o600
    before = path.read_bytes()
    with pytest.raises(FileThere, match="--force"):
        McapWriter(path, "1")
    assert path.read_bytes() == before
    McapWriter(path, "1", overwrite=True).close()
    assert list(read(path)) == []
    with pytest.raises(Unwritable, match="No such file"):
        McapWriter(path.parent / "no" / "such", "1")


KILLED = """
import os, signal, sys
from pathlib import Path
from tests.storage.test_mcap_file import entries
from xavi_dialogue.storage.mcap_file import McapWriter
file = McapWriter(Path(sys.argv[1]), "1")
first, *rest = entries()
file.add(first)
file.flush()
for one in rest[:-1]:
    file.add(one)
file.flush()
file.add(rest[-1])
os.kill(os.getpid(), signal.SIGKILL)
"""


def test_what_was_flushed_outlives_a_kill_and_any_reader_opens_it(path: Path, root: Path) -> None:
    done = subprocess.run([sys.executable, "-c", KILLED, str(path)], cwd=root, check=False)
    assert done.returncode == -9
    assert list(read(path)) == entries()[:-1]
    with path.open("rb") as file:
        found = make_reader(file).iter_messages(log_time_order=False)
        assert [message.data for _, _, message in found] == [e.payload for e in entries()[:-1]]


def test_what_is_whole_is_read_of_a_file_that_is_cut_off_anywhere(path: Path) -> None:
    with McapWriter(path, "1") as file:
        for one in entries():
            file.add(one)
            file.flush()
    whole = path.read_bytes()
    counts = []
    for size in range(60, len(whole), 97):
        path.write_bytes(whole[:size])
        *pieces, last = read(path)
        assert isinstance(last, Truncation)
        assert pieces == entries()[: len(pieces)]
        counts.append(len(pieces))
    assert counts == sorted(counts)
    assert set(counts) == set(range(len(entries()) + 1))


def test_damage_in_the_middle_ends_what_is_read(path: Path) -> None:
    with McapWriter(path, "1") as file:
        for one in entries():
            file.add(one)
            file.flush()
    whole = path.read_bytes()
    for place in range(60, len(whole), 61):
        path.write_bytes(whole[:place] + bytes([whole[place] ^ 0x5A]) + whole[place + 1 :])
        found = [one for one in pieces_of(path) if isinstance(one, Entry)]
        assert len(found) <= len(entries())
        assert {(one.key, one.payload) for one in found} <= {
            (one.key, one.payload) for one in entries()
        }


def pieces_of(path: Path) -> list[Piece]:
    try:
        return list(read(path))
    except NotARecording:
        return []


def fill(file: McapWriter) -> None:
    for k in range(10_000):
        file.add(entry("car/scene", scene(k)))
        file.flush()


def test_a_full_disk_is_one_error_and_what_was_written_is_there(path: Path) -> None:
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    file = McapWriter(path, "1")
    try:
        resource.setrlimit(resource.RLIMIT_FSIZE, (40_000, hard))
        with pytest.raises(Unwritable, match=r"cannot write .* any further") as caught:
            fill(file)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert "\n" not in str(caught.value)
    file.close()
    pieces = list(read(path))
    assert len(pieces) == file.messages - 1 > 10
    assert all(isinstance(one, Entry) for one in pieces)


def test_numbers_that_no_file_holds_are_cut(path: Path) -> None:
    write(path, [Entry("xavi/v1/car/scene", b"{}", 2**53, -5, 2**70)])
    [found] = read(path)
    assert isinstance(found, Entry)
    assert (found.seq, found.published, found.logged) == (2**32 - 1, 0, 2**63 - 1)


def test_there_is_a_limit_to_keys(path: Path) -> None:
    limit, turn = mcap_file.MAX_CHANNELS, entries()[-1].payload
    with McapWriter(path, "1") as file:
        keys = [f"xavi/v1/car/dialogue/s{k}/turn" for k in range(limit + 5)]
        taken = [file.add(Entry(key, turn, 0, 0, 0)) for key in keys]
    assert taken == [True] * limit + [False] * 5


def test_what_is_not_to_be_recorded_is_a_fault(path: Path) -> None:
    with McapWriter(path, "1") as file, pytest.raises(ValueError, match="is not recorded"):
        file.add(Entry("xavi/v1/car/@rpc/ask", b"", 0, 0, 0))


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (b"", "is not an MCAP file"),
        (b"x" * 1000, "is not an MCAP file"),
        (mcap_file.MCAP0_MAGIC, "is damaged at its beginning"),
        (mcap_file.MCAP0_MAGIC + b"\x05" + struct.pack("<Q", 2**60), "is damaged"),
        (mcap_file.MCAP0_MAGIC + b"\x01" + struct.pack("<QI", 100, 2**31), "is damaged"),
        (mcap_file.MCAP0_MAGIC + mcap_file.ENDING, "begins without a header"),
    ],
)
def test_what_is_no_recording_is_refused(path: Path, content: bytes, why: str) -> None:
    path.write_bytes(content)
    with pytest.raises(NotARecording, match=why):
        list(read(path))


def test_a_folder_and_nothing_at_all_are_no_recordings(tmp_path: Path) -> None:
    for path in (tmp_path, tmp_path / "missing"):
        with pytest.raises(NotARecording, match="cannot read"):
            list(read(path))


def test_recordings_of_others_are_refused(path: Path) -> None:
    writer = Writer(str(path))
    writer.start("ros2")
    writer.finish()
    with pytest.raises(NotARecording, match="its profile is 'ros2'"):
        list(read(path))


def foreign(path: Path, payload: bytes = b"{}", **options: Any) -> None:
    writer = Writer(str(path), **options)
    writer.start("xavi")
    schema = writer.register_schema("xavi.scene/1", "jsonschema", b"{}")
    channel = writer.register_channel("xavi/v1/car/scene", "json", schema)
    writer.add_message(channel, 1, payload, 1)
    writer.finish()


def test_other_packing_is_told(path: Path) -> None:
    foreign(path, compression=CompressionType.NONE)
    assert [type(one) for one in read(path)] == [Entry]
    foreign(path, use_chunking=False)
    assert [type(one) for one in read(path)] == [Entry]
    foreign(path, compression=CompressionType.LZ4)
    assert list(read(path)) == [Truncation("it is damaged: a chunk packed by 'lz4'")]


@pytest.mark.parametrize("claim", [1000, 2**62])
def test_a_chunk_takes_no_more_memory_than_it_says(
    path: Path, monkeypatch: pytest.MonkeyPatch, claim: int
) -> None:
    """Of a gigabyte of noughts that pack into some bytes, nothing is unpacked."""
    bomb = zstandard.ZstdCompressor().compress(bytes(20 * 1024 * 1024))
    monkeypatch.setattr(zstandard, "compress", lambda _: bomb)
    foreign(path)
    data = path.read_bytes()
    start = data.index(b"\x06", 8 + 9)  # the chunk: opcode, length, two times, size
    size = struct.pack("<Q", claim)
    path.write_bytes(data[: start + 25] + size + data[start + 33 :])
    monkeypatch.undo()
    [broken] = read(path)
    assert isinstance(broken, Truncation)
    assert ("of another size" in broken.why) == (claim == 1000)


def test_a_ride_is_read_as_a_tape(path: Path) -> None:
    write(path, [*entries("car", "old"), *entries("car", "new")], {"car/new.net.xml.gz": b"n"})
    recorded, why = read_ride(read(path))
    assert (recorded.vehicle, recorded.ride, why) == ("car", "new", None)
    assert recorded.times == (0.0, 0.1, 0.2, 0.3, 0.4)
    assert recorded.scene(3) == scene(3, "new")
    assert [recorded.trace(k) for k in range(2)] == list(s1_ride().traces[:2])
    assert (len(recorded.events), recorded.networks, recorded.finished) == (1, (b"n",), False)
    assert [recorded.known(scene(k)) for k in range(3)] == [(0, 0), (1, 1), (2, 1)]
    assert [recorded.index_at(time) for time in (0.0, 0.1, 0.15, 99.0)] == [0, 1, 2, 4]


def test_of_several_cars_one_is_named(path: Path) -> None:
    write(path, [*entries("a"), *entries("b")])
    with pytest.raises(NothingToPlay, match=r"several cars.*a, b"):
        read_ride(read(path))
    with pytest.raises(NothingToPlay, match="no car 'c'; there is: a, b"):
        read_ride(read(path), "c")
    assert read_ride(read(path), "b")[0].vehicle == "b"


@pytest.mark.parametrize(
    ("what", "why"),
    [
        ([], "it holds no ride"),
        (entries()[5:], "it holds no scene of car"),
        ([Entry("xavi/v1/car/scene", b"[]", 0, 0, 0)], "no xavi.scene/1"),
        ([Entry("xavi/v1/car/trace", b'{"schema": "xavi.trace/9"}', 0, 0, 0)], "xavi.trace/9"),
    ],
)
def test_what_cannot_be_played_is_refused(what: list[Entry], why: str) -> None:
    with pytest.raises((NothingToPlay, NotARecording), match=why):
        read_ride(what)


def test_decisions_of_an_unknown_schema_are_refused() -> None:
    trace = json.loads(entries()[5].payload)
    trace["trace"]["schema"] = "xavi.plan_trace/3"
    strange = Entry("xavi/v1/car/trace", json.dumps(trace).encode(), 0, 0, 0)
    with pytest.raises(NotARecording, match=r"unknown schema 'xavi.plan_trace/3'"):
        read_ride([strange])


def test_a_scene_without_the_car_is_refused() -> None:
    empty = msgspec.structs.replace(scene(0), vehicles={1: OTHER})
    with pytest.raises(NotARecording, match="without the car itself"):
        read_ride([entry("car/scene", empty)])


def test_a_recording_too_large_to_be_held_is_refused_before_it_is(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(recording_format, "MAX_TAPE", 20_000)
    given = 0

    def endless() -> Iterator[Piece]:
        nonlocal given
        while True:
            given += 1
            yield entry("car/scene", scene(given))

    with pytest.raises(TooMuch, match="--car"):
        read_ride(endless())
    assert given < 100


def test_a_cut_off_recording_is_played_as_far_as_it_goes(path: Path) -> None:
    write(path, entries())
    path.write_bytes(path.read_bytes()[:-20])
    recorded, why = read_ride(read(path))
    assert len(recorded.scenes) == 5
    assert why == "it was cut off while it was written"


def test_the_latest_of_several_scenes_at_one_moment_counts() -> None:
    first = scene(1)
    then = msgspec.structs.replace(first, seq=7, state="paused", traces=9)
    recorded, _ = read_ride([entry("car/scene", first), entry("car/scene", then)])
    assert recorded.scene(0) == then


def test_the_example_in_the_docs_reads_a_recording(
    path: Path, root: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    page = (root / "docs" / "recording.md").read_text(encoding="utf-8")
    [example] = re.findall(r"^```python\n(.*?)^```", page, flags=re.MULTILINE | re.DOTALL)
    write(path, entries())
    monkeypatch.chdir(path.parent)
    exec(compile(example, "recording.md", "exec"), {})
    told = [f"{trace.sim_time} {len(trace.rollouts)}" for trace in s1_ride().traces[:2]]
    lines = capsys.readouterr().out.splitlines()
    assert [line.rpartition(" ")[0] for line in lines] == told


def test_what_is_no_file_is_not_written_to(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe.mcap"
    os.mkfifo(pipe)
    for overwrite in (False, True):
        with pytest.raises((Unwritable, FileThere)):
            McapWriter(pipe, "1", overwrite=overwrite)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    with pytest.raises(Unwritable, match="not a file"):
        McapWriter(pipe, "1", overwrite=True)
    os.close(reader)


def test_a_file_that_is_written_over_is_its_owners_alone(tmp_path: Path) -> None:
    path = tmp_path / "ride.mcap"
    path.write_bytes(b"x" * 10_000)
    path.chmod(0o644)
    McapWriter(path, "1", overwrite=True).close()
    assert path.stat().st_mode & 0o777 == 0o600
    assert path.stat().st_size < 10_000
