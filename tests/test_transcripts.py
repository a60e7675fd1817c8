"""The golden conversations: same bytes from the recordings, from SUMO, and on any hash seed."""

import gzip
import os
import subprocess
import sys
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import msgspec
import pytest

from planner.record.trace import encode
from planner.record.trace_reading import decode
from tests import stories
from xavi_dialogue.service.in_process import make_pipeline
from xavi_dialogue.transcripts.coverage import Coverage, Item
from xavi_dialogue.transcripts.replay import (
    BESIDE,
    ENDING,
    RIDES,
    TRACES,
    Written,
    by_ride,
    recording,
    replay_driven,
    replay_recorded,
    transcripts_in,
)
from xavi_dialogue.transcripts.runner import Played
from xavi_dialogue.transcripts.transcript import Comment, Exchange, write

FOLDER = Path(__file__).parents[1] / "transcripts"
TRANSCRIPTS = transcripts_in(FOLDER)
ABOUT = by_ride(TRANSCRIPTS)
DRIVEN = [path for path, about in ABOUT.items() if about[0].driven]
MAX_SIZE = 8 << 20  # [byte] of the whole folder
RULES_READ, RULES_SAID = 0.8, 0.7  # shares of the rules that conversations have to exercise

each = pytest.mark.parametrize("one", TRANSCRIPTS, ids=lambda one: one.path.stem)

# It measures coverage, and prints it after each text and its replies as they come out meanwhile.
REPLAY = """
import sys
from pathlib import Path
import msgspec
from xavi_dialogue.transcripts import coverage
from xavi_dialogue.transcripts.replay import transcripts_in
from xavi_dialogue.transcripts.transcript import write
replay = coverage.replay_recorded
def shown(*given):
    played = replay(*given)
    one = [write(played.transcript), msgspec.json.encode(played.replies).decode()]
    sys.stdout.buffer.write(msgspec.json.encode(one) + b"\\n")
    return played
coverage.replay_recorded = shown
found = coverage.measure(transcripts_in(Path(sys.argv[1])))
sys.stdout.buffer.write(msgspec.json.encode(list(found.counts.items())))
"""


@cache
def played(path: Path) -> Played:
    """What a conversation comes to in this process."""
    [one] = (one for one in TRANSCRIPTS if one.path == path)
    return replay_recorded(one.transcript, recording(one.ride), make_pipeline())


@each
def test_a_conversation_comes_out_of_its_recording(one: Written) -> None:
    assert write(played(one.path).transcript) == one.text


@dataclass(frozen=True)
class Elsewhere:
    """What conversations come to in a process with another hash seed."""

    texts: tuple[str, ...]
    replies: tuple[str, ...]  # all that clients get, to the last digit
    coverage: Coverage


@pytest.fixture(scope="module")
def elsewhere(root: Path) -> Elsewhere:
    """All conversations, replayed once in another process, by ride."""
    run = subprocess.run(
        [sys.executable, "-c", REPLAY, str(FOLDER)],
        capture_output=True,
        check=True,
        cwd=root,
        env={**os.environ, "PYTHONHASHSEED": other_seed(), "PYTHONPATH": str(root)},
    )
    *lines, counts = run.stdout.splitlines()
    each = msgspec.json.decode(b"[" + b",".join(lines) + b"]", type=list[tuple[str, str]])
    found = msgspec.json.decode(counts, type=list[tuple[Item, int]])
    return Elsewhere(tuple(a for a, _ in each), tuple(b for _, b in each), Coverage(dict(found)))


def test_conversations_do_not_depend_on_the_hash_seed(elsewhere: Elsewhere) -> None:
    written = [one for about in ABOUT.values() for one in about]
    assert elsewhere.texts == tuple(one.text for one in written)
    ours = [msgspec.json.encode(played(one.path).replies).decode() for one in written]
    differing = [
        one.path.stem for one, a, b in zip(written, ours, elsewhere.replies, strict=True) if a != b
    ]
    assert not differing


def other_seed() -> str:
    """A hash seed that this process does not have; it has one at random unless it is told."""
    return "2" if os.environ.get("PYTHONHASHSEED") == "1" else "1"


@pytest.mark.slow
@pytest.mark.parametrize("ride", DRIVEN, ids=lambda path: path.name.removesuffix(ENDING))
def test_conversations_and_their_recording_come_out_of_sumo(ride: Path) -> None:
    now = replay_driven(ABOUT[ride])
    assert now.texts == tuple(one.text for one in ABOUT[ride])
    assert now.ride == recording(ride)


def test_every_recording_is_talked_about() -> None:
    held = sorted([*(FOLDER / RIDES).iterdir(), *(FOLDER / TRACES).iterdir()])
    assert [path for path in held if not path.name.startswith(BESIDE.partition("{}")[0])] == sorted(
        ABOUT
    )


def test_what_is_made_up_is_as_it_was_made_and_said_to_be() -> None:
    found = {path.name: path.read_bytes() for path in (FOLDER / TRACES).iterdir()}
    assert {name: gzip.decompress(data) for name, data in found.items()} == {
        name: gzip.decompress(data) for name, data in stories.files().items()
    }
    for one in TRANSCRIPTS:
        said = any(isinstance(s, Comment) and " is made up" in s.text for s in one.transcript.steps)
        assert said != one.driven


@pytest.mark.parametrize("path", sorted((FOLDER / TRACES).iterdir()), ids=lambda path: path.name)
def test_what_is_made_up_keeps_to_the_format_of_traces(path: Path) -> None:
    ride = recording(path)
    for trace in (*ride.traces, *ride.whatifs.values()):
        assert decode(encode(trace)) == trace  # strictly by the type that the schema is made from


def test_every_type_and_reason_is_exercised_and_most_rules(elsewhere: Elsewhere) -> None:
    coverage = elsewhere.coverage
    assert coverage.missing == ()
    assert coverage.share("rules of nlu_") >= RULES_READ
    assert coverage.share("rules of answer_") >= RULES_SAID


def test_the_folder_stays_small() -> None:
    sizes = [path.stat().st_size for path in FOLDER.rglob("*") if path.is_file()]
    assert sum(sizes) <= MAX_SIZE


@each
def test_every_question_has_its_reply(one: Written) -> None:
    exchanges = [step for step in one.transcript.steps if isinstance(step, Exchange)]
    assert 4 <= len(exchanges) <= 12
    assert all(exchange.reply for exchange in exchanges)


def test_the_conversation_in_the_readme_is_a_real_one(root: Path) -> None:
    header, _, body = (FOLDER / "tour.txt").read_text(encoding="utf-8").partition("\n\n")
    assert header.startswith("scenario:")
    assert body.strip() in (root / "README.md").read_text(encoding="utf-8")
