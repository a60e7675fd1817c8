import pytest

from planner.record.events import Event
from tests.traces import s1_ride
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.storage import ride_file
from xavi_dialogue.storage.ride_file import RecordedRide, RideFileError
from xavi_dialogue.transcripts.transcript import (
    At,
    Comment,
    Exchange,
    Incident,
    TranscriptError,
    moment,
    read,
    write,
)

TEXT = """\
scenario: s1
seed: 3

> Why?
Because.

# Later.
# On a bridge.

@ 8.0s

! planner fails

> Which one?
This one or that one?
1. this
2. that

> 2

"""


def test_a_transcript_is_read_step_by_step() -> None:
    transcript = read(TEXT)
    assert transcript.get("scenario") == "s1"
    assert transcript.steps == (
        Exchange("Why?", "Because."),
        Comment("# Later."),
        Comment("# On a bridge."),
        At(8.0, "@ 8.0s"),
        Incident("planner fails"),
        Exchange("Which one?", "This one or that one?\n1. this\n2. that"),
        Exchange("2", ""),
    )


def test_what_is_written_is_read_again() -> None:
    once = write(read(TEXT))
    assert read(once) == read(TEXT)
    assert write(read(once)) == once
    assert "# Later.\n# On a bridge.\n\n@ 8.0s\n\n! planner fails\n\n> Which" in once


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("colour: blue\n", "line 1: the header"),
        ("scenario: s1\n\nno question\n", "line 3: a reply without a question"),
        ("scenario: s1\n\n@ noon\n", "line 3: a moment"),
        ("scenario: s1\n\n! the sky falls\n", "line 3: after ! comes one of planner answers, "),
    ],
)
def test_a_wrong_line_is_named(text: str, problem: str) -> None:
    with pytest.raises(TranscriptError, match=problem):
        read(text)


@pytest.mark.parametrize(
    ("line", "time"),
    [("@ 8.0s", 8.0), ("@12", 12.0), ("  @ 3.25 s ", 3.25), ("@", None), ("8.0", None)],
)
def test_moments(line: str, time: float | None) -> None:
    assert moment(line) == time


def test_a_recorded_ride_comes_back_whole() -> None:
    ride = s1_ride(draws=10)
    need = NeedRollout(trace_id="t", actions=("stop",))
    recorded = RecordedRide(
        "s1",
        3,
        7.0,
        list(ride.traces),
        list(ride.events),
        7.0,
        {ride_file.key(need): ride.traces[0]},
        {"0123456789abcdef": "it cannot stop there"},
    )
    data = ride_file.dump(recorded)
    assert ride_file.load(data) == recorded
    assert ride_file.dump(ride_file.load(data)) == data


def test_requests_have_keys_of_their_own() -> None:
    one, other = NeedRollout(trace_id="t", removed=1), NeedRollout(trace_id="t", removed=2)
    assert ride_file.key(one) == ride_file.key(NeedRollout(trace_id="t", removed=1))
    assert ride_file.key(one) != ride_file.key(other)


CUT_OFF = ride_file.dump(RecordedRide("s1", 0, 1.0, events=[Event("ended", 1.0)]))[:40]


@pytest.mark.parametrize("data", [b"", b"junk", CUT_OFF])
def test_what_is_no_recorded_ride_is_refused(data: bytes) -> None:
    with pytest.raises(RideFileError, match="not a recorded ride"):
        ride_file.load(data)
