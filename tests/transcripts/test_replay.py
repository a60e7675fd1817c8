"""Golden conversations in a folder: which ride they are about, and what is wrong with them."""

import gzip
from pathlib import Path

import pytest

from planner.record.trace import PlanTrace, encode
from tests.planted import decision, without
from tests.stories import squeezed
from tests.traces import s1_ride
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.service.in_process import make_pipeline
from xavi_dialogue.storage import ride_file
from xavi_dialogue.storage.ride_file import RecordedRide, RideFileError
from xavi_dialogue.transcripts.replay import (
    BESIDE,
    by_ride,
    recording,
    replay_all,
    replay_recorded,
    transcripts_in,
)
from xavi_dialogue.transcripts.transcript import TranscriptError

QUESTION = "\n> What if vehicle 1 hadn't been there?\n"


def folder_of(folder: Path, **texts: str) -> Path:
    for name, text in texts.items():
        (folder / f"{name}.txt").write_text(text, encoding="utf-8")
    return folder


def test_transcripts_about_one_ride_share_its_recording(tmp_path: Path) -> None:
    head = "scenario: {}\nseed: {}\n\n> Hello!\n"
    texts = {"a": ("s1", 0), "b": ("s2", 0), "c": ("s1", 0), "d": ("s1", 3), "e": ("/maps/s2", 0)}
    folder = folder_of(tmp_path, **{name: head.format(*what) for name, what in texts.items()})
    found = by_ride(transcripts_in(folder))
    assert {path.name: [one.path.stem for one in about] for path, about in found.items()} == {
        "s1-0.ride.jsonl.gz": ["a", "c"],
        "s1-3.ride.jsonl.gz": ["d"],
        "s2-0.ride.jsonl.gz": ["b", "e"],
    }


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("colour: blue\n", r"bad\.txt: line 1"),
        ("seed: 1\n", r"bad\.txt: the header lacks 'scenario'"),
        ("scenario: s1\nseed: one\n", r"bad\.txt: 'one' is no seed"),
    ],
)
def test_a_wrong_transcript_is_named(text: str, problem: str, tmp_path: Path) -> None:
    with pytest.raises(TranscriptError, match=problem):
        by_ride(transcripts_in(folder_of(tmp_path, bad=text)))


def test_an_empty_folder_and_a_missing_recording_are_told(tmp_path: Path) -> None:
    with pytest.raises(TranscriptError, match="no transcripts"):
        transcripts_in(tmp_path)
    with pytest.raises(RideFileError, match="cannot read"):
        recording(tmp_path / "s1-0.ride.jsonl.gz")


MADE_UP = squeezed(10.0)


def decision_in(folder: Path) -> PlanTrace:
    """A decision, recorded in a folder as one that a transcript may name."""
    trace = decision(MADE_UP)
    (folder / "traces").mkdir()
    (folder / "traces" / "one.json.gz").write_bytes(gzip.compress(encode(trace), mtime=0))
    return trace


def test_a_transcript_about_one_decision_needs_no_road(tmp_path: Path) -> None:
    trace = decision_in(tmp_path)
    head, question = (
        "trace: traces/one.json.gz\n\n! planner gone\n",
        "> Why don't you change lanes?\n",
    )
    folder = folder_of(tmp_path, one=head + question, two=head + "> Hello!\n")
    [(path, about)] = by_ride(transcripts_in(folder)).items()
    assert [one.driven for one in about] == [False, False]
    ride = recording(path)
    assert (ride.traces, ride.events, ride.halt) == ([trace], [], trace.sim_time)
    notes: list[str] = []
    assert replay_all(folder, accept=True, note=notes.append) == 2
    assert replay_all(folder, accept=False, note=notes.append) == 0
    [reply] = replay_recorded(about[0].transcript, ride, make_pipeline()).replies
    assert (reply.trace_id, reply.sim_time) == (trace.trace_id, trace.sim_time)
    assert reply.text in (folder / "one.txt").read_text(encoding="utf-8")


def test_what_was_planned_from_one_decision_lies_beside_it(tmp_path: Path) -> None:
    trace = decision_in(tmp_path)
    folder = folder_of(tmp_path, one=f"trace: traces/one.json.gz\n{QUESTION}")
    need, plan = without(MADE_UP, 1)
    assert need.trace_id == trace.trace_id
    with pytest.raises(RideFileError, match="! planner gone") as missing:
        replay_all(folder, accept=True, note=print)
    name = BESIDE.format(ride_file.key(need))
    assert name in str(missing.value)
    (folder / "traces" / name).write_bytes(gzip.compress(encode(plan), mtime=0))
    assert replay_all(folder, accept=True, note=print) == 1
    assert "I would" in (folder / "one.txt").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    "content",
    [None, b"no gzip", gzip.compress(b"{}", mtime=0)],
    ids=["missing", "no gzip", "no decision"],
)
def test_a_file_without_a_decision_is_told(content: bytes | None, tmp_path: Path) -> None:
    if content is not None:
        (tmp_path / "one.json.gz").write_bytes(content)
    with pytest.raises(RideFileError, match=r"cannot read .*one\.json\.gz"):
        recording(tmp_path / "one.json.gz")


def test_plans_come_from_the_recording_and_failures_too(tmp_path: Path) -> None:
    [one] = transcripts_in(folder_of(tmp_path, one=f"scenario: s1\nseed: 0\n{QUESTION}"))
    ride = s1_ride()
    recorded = RecordedRide("s1", 0, 7.0, list(ride.traces), list(ride.events))
    with pytest.raises(RideFileError, match="holds no plan for NeedRollout") as missing:
        replay_recorded(one.transcript, recorded, make_pipeline())
    assert "removed=1" in str(missing.value)
    wanted = (NeedRollout(trace_id=trace.trace_id, removed=1) for trace in ride.traces)
    recorded.failures.update({ride_file.key(need): "no way" for need in wanted})
    [failed] = replay_recorded(one.transcript, recorded, make_pipeline()).replies
    assert failed.reason == "planner-failed"
