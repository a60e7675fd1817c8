"""Files that are too much: refused before they are taken in."""

import json
import sys
from pathlib import Path

import pytest

from planner.record import trace_reading
from planner.record.trace import encode
from xavi_dialogue.cli.errors import failure
from xavi_dialogue.inspection import trace_files
from xavi_dialogue.inspection.trace_files import TraceFileError, content, read
from xavi_dialogue.storage import ride_file

SAVED = Path(__file__).parents[2] / "transcripts" / "rides" / "s1-0.ride.jsonl.gz"


def test_a_file_is_read_up_to_the_limit_only(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(trace_files, "MAX_RIDE_BYTES", 100)
    path = tmp_path / "large"
    path.write_bytes(b"x" * 100)
    assert content(str(path)) == b"x" * 100
    path.write_bytes(b"x" * 101)
    with pytest.raises(TraceFileError, match="larger than 100 bytes"):
        content(str(path))
    with pytest.raises(TraceFileError, match="larger than 100 bytes"):
        content("/dev/zero")


def test_a_ride_of_endless_lines_is_refused() -> None:
    with pytest.raises(TraceFileError, match="more than 20000 lines"):
        read(b'{"scenario": "s1"}\n' + b"{}\n" * 20_001)


def test_a_closed_standard_input_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", None)
    with pytest.raises(TraceFileError, match="standard input is closed"):
        content("-")


def test_nothing_in_a_file_name_can_steer_a_terminal() -> None:
    with pytest.raises(TraceFileError) as caught:
        content("no\x1b[31mwhere")
    told = failure(caught.value)
    assert told is not None
    assert "nowhere" in told.message
    assert "\x1b" not in told.message


def test_a_saved_ride_is_found_without_its_ending(tmp_path: Path) -> None:
    (tmp_path / "mine.ride.jsonl.gz").write_bytes(b"saved")
    assert content(str(tmp_path / "mine")) == b"saved"
    (tmp_path / "mine").write_bytes(b"another")
    assert content(str(tmp_path / "mine")) == b"another"


def test_spaces_do_not_make_a_trace_too_large(monkeypatch: pytest.MonkeyPatch) -> None:
    trace = ride_file.load(SAVED.read_bytes()).traces[0]
    plain = encode(trace)
    monkeypatch.setattr(trace_files, "MAX_BYTES", len(plain))
    monkeypatch.setattr(trace_reading, "MAX_BYTES", len(plain))
    spaced = json.dumps(json.loads(plain)).encode()
    assert len(spaced) > len(plain)
    assert read(spaced).traces == (trace,)


def test_an_array_of_traces_is_told_to_be_one() -> None:
    with pytest.raises(TraceFileError, match="each trace in a line of its own"):
        read(b'[{"schema": 1}]')
