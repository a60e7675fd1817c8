"""The golden conversations: same bytes from the recordings, from SUMO, and on any hash seed."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from xavi_dialogue.app.golden import replay_driven, replay_recorded, ride_path, transcripts_in
from xavi_dialogue.transports import ride_file
from xavi_dialogue.transports.transcript import Exchange, read

FOLDER = Path(__file__).parents[1] / "transcripts"
TRANSCRIPTS = transcripts_in(FOLDER)

each = pytest.mark.parametrize("path", TRANSCRIPTS, ids=lambda path: path.stem)

REPLAY = """
import sys
from pathlib import Path
from xavi_dialogue.app.golden import replay_recorded, ride_path
from xavi_dialogue.transports import ride_file
from xavi_dialogue.transports.transcript import read
for path in map(Path, sys.argv[1:]):
    ride = ride_file.load(ride_path(path).read_bytes())
    sys.stdout.write(replay_recorded(read(path.read_text(encoding="utf-8")), ride))
"""


@each
def test_a_conversation_comes_out_of_its_recording(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    ride = ride_file.load(ride_path(path).read_bytes())
    assert replay_recorded(read(text), ride) == text


@pytest.mark.parametrize("hash_seed", ["1", "2"])
def test_conversations_do_not_depend_on_the_hash_seed(hash_seed: str, root: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-c", REPLAY, *map(str, TRANSCRIPTS)],
        capture_output=True,
        check=True,
        cwd=root,
        env={**os.environ, "PYTHONHASHSEED": hash_seed, "PYTHONPATH": str(root)},
    )
    assert done.stdout.decode() == "".join(p.read_text(encoding="utf-8") for p in TRANSCRIPTS)


@pytest.mark.slow
@each
def test_a_conversation_and_its_recording_come_out_of_sumo(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    now = replay_driven(read(text))
    assert now.text == text
    assert now.ride == ride_file.load(ride_path(path).read_bytes())


def test_both_stories_are_told() -> None:
    told = {read(path.read_text(encoding="utf-8")).get("scenario") for path in TRANSCRIPTS}
    assert {"s1", "s2"} <= told


@each
def test_every_question_has_its_reply(path: Path) -> None:
    steps = read(path.read_text(encoding="utf-8")).steps
    exchanges = [step for step in steps if isinstance(step, Exchange)]
    assert len(exchanges) >= 4
    assert all(exchange.reply for exchange in exchanges)


def test_the_conversation_in_the_readme_is_a_real_one(root: Path) -> None:
    header, _, body = (FOLDER / "tour.txt").read_text(encoding="utf-8").partition("\n\n")
    assert header.startswith("scenario:")
    assert body.strip() in (root / "README.md").read_text(encoding="utf-8")
