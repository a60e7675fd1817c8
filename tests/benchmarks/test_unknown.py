"""Words that nobody knows: made up, put into questions, and owned up to or not."""

import json
from pathlib import Path
from random import Random

import pytest

from benchmarks.language import unknown
from benchmarks.language.latency import RIDE as RECORDED
from benchmarks.language.unknown import (
    Fate,
    Heard,
    fate,
    made_up,
    plain_questions,
    report,
    tried,
)
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.domain.answers import Reason
from xavi_dialogue.nlu.grammar.lexicon import lexicon
from xavi_dialogue.storage import ride_file
from xavi_dialogue.storage.ride_file import RecordedRide


@pytest.fixture(scope="module")
def ride() -> RecordedRide:
    return ride_file.load((Path(__file__).parents[2] / RECORDED).read_bytes())


def test_made_up_words_are_unknown_and_differ() -> None:
    rng = Random(0)
    words = {made_up(rng) for _ in range(50)}
    assert len(words) > 40
    assert not words & lexicon().vocabulary.words.keys()
    assert made_up(Random(3)) == made_up(Random(3))


@pytest.mark.parametrize(
    ("kind", "reason", "text", "expected"),
    [
        ("answer", None, "We are doing 40 km/h.", "plain answer"),
        ("answer", None, 'I do not know "Zorb". We are doing 40 km/h.', "owned up"),
        ("refusal", "not-understood", "I do not know that.", "not understood"),
        ("refusal", "out-of-scope", "I cannot say.", "declined"),
        ("clarification", "ambiguous", "Which one?", "asked back"),
    ],
)
def test_what_comes_of_such_a_question(
    kind: str, reason: Reason | None, text: str, expected: Fate
) -> None:
    reply = Reply(text=text, kind=kind, reason=reason, sim_time=1.0)  # type: ignore[arg-type]
    assert fate(reply, "zorb") == expected


def test_only_questions_that_are_answered_as_they_stand_are_taken(ride: RecordedRide) -> None:
    texts = ("How fast are we going?", "Why is the frobnicator on?", "Hello!", "Honk please.")
    assert list(plain_questions(texts, ride)) == ["How fast are we going?"]


def test_the_word_is_in_the_question(ride: RecordedRide) -> None:
    found = tried("How fast are we going?", Random(0), ride)
    assert found.word in found.text.split()
    assert [word for word in found.text.split() if word != found.word] == [
        *("How", "fast", "are", "we", "going?")
    ]


def test_plain_answers_are_counted_and_told() -> None:
    good = Heard("How zorb fast?", "zorb", "not understood", "What?")
    bad = Heard("How fast zorb?", "zorb", "plain answer", "40 km/h.")
    found = report([good, bad])
    assert (found.questions, found.plain_answers, found.met) == (2, 1, False)
    assert "How fast zorb?" in found.table()
    assert report([good]).met
    assert not report([]).met


def test_a_row_of_questions_is_measured(tmp_path: Path, root: Path) -> None:
    learn = tmp_path / "learn"
    learn.mkdir()
    line = {"id": "a", "text": "How fast are we going?", "style": "clean"}
    (learn / "some.jsonl").write_text(json.dumps({**line, "query": {"type": "what"}}))
    notes: list[str] = []
    found = unknown.measure(tmp_path, root / RECORDED, 3, 0, notes.append)
    assert found.questions == 1
    assert notes == ["only 1 questions are understood and answered as they stand"]
