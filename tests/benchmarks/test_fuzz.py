"""Texts made at random: the parser has a result for each, and faults are told as they are."""

from pathlib import Path
from random import Random

import pytest
from typer.testing import CliRunner

from benchmarks.errors import FaultFound
from benchmarks.language import fuzz
from benchmarks.language.fuzz import Batch, Case, Tried, asked, attempt, case, measure, together
from benchmarks.language.latency import RIDE as RECORDED
from benchmarks.language.latency import understood
from benchmarks.language.mutations import anything, mutated
from benchmarks.language.questions import FOLDER
from benchmarks.language.sentences import FORMS, sentence
from xavi_dialogue.__main__ import app
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import Ask
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.nlu.grammar.lexicon import lexicon
from xavi_dialogue.nlu.grounding.result import Grounding
from xavi_dialogue.nlu.parse import Parser

RUNS = 600
COMMAND = ["bench", "fuzz", "--runs", "1", "--ride", str(Path(__file__).parents[2] / RECORDED)]
COMMAND += ["--questions"]
RIDE = Path(__file__).parents[2] / RECORDED


@pytest.fixture
def questions(root: Path) -> Path:
    return root / FOLDER


def test_no_text_makes_the_parser_fail(questions: Path) -> None:
    tried = attempt(Batch(questions, RIDE, seed=7, begin=0, end=RUNS, limit=None))
    assert tried.faults == ()
    assert sum(tried.runs.values()) == RUNS
    assert tried.understood["forms"] > tried.understood["anything"]


def test_texts_follow_from_seed_and_number(questions: Path) -> None:
    known = asked(questions)
    texts = [case(3, number, known) for number in range(30)]
    assert texts == [case(3, number, known) for number in range(30)]
    assert texts != [case(4, number, known) for number in range(30)]
    assert {one.source for one in texts} == set(fuzz.SOURCES)
    assert any(one.context for one in texts)


def test_sentences_hold_only_what_the_lexicon_holds() -> None:
    rng, known = Random(0), lexicon().vocabulary.words
    for _ in range(200):
        text = sentence(rng).replace("n't", " not").replace(",", "").replace(":", "")
        strange = [word for word in text.casefold().split() if word not in known]
        assert all(word.isdecimal() or "-" in word or word.endswith("s") for word in strange), text


def test_each_form_of_question_is_drawn() -> None:
    drawn = [sentence(Random(k)) for k in range(300)]
    acts = [act for text in drawn for act in Parser().read(text)[0].acts]
    types = {type(act.question).__name__ for act in acts if isinstance(act, Ask)}
    assert types >= {"Why", "WhatIf", "Whether", "When", "Which", "HowMuch", "HowLong", "Where"}
    assert len(set(drawn)) > len(FORMS)


def test_mutations_change_and_anything_is_made() -> None:
    rng = Random(0)
    texts = [mutated(rng, ["Why did you stop?", "Are you sure?"]) for _ in range(200)]
    assert len(set(texts)) > 100
    assert any(not text.isascii() for text in texts)
    assert len({anything(rng) for _ in range(100)}) > 80


def broken(text: str, record: Record, discourse: Discourse) -> Grounding:
    if "stop" in text:
        raise KeyError("stop")
    return understood(text, record, discourse)


def test_a_fault_is_told_with_as_little_text_as_it_takes(
    questions: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(fuzz, "understood", broken)
    [fault] = attempt(Batch(questions, RIDE, 0, 0, 200, limit=None)).faults
    assert fuzz.told(fault) == "understanding 'stop': KeyError: 'stop'"


def test_a_result_that_is_no_valid_one_is_a_fault(
    questions: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    wrong = Grounding(reading="whence")  # type: ignore[arg-type]
    monkeypatch.setattr(fuzz, "understood", lambda *_: wrong)
    [fault] = attempt(Batch(questions, RIDE, 0, 0, 9, limit=None)).faults
    assert "ValidationError" in fault.what


def test_a_text_is_slow_only_if_it_is_so_twice(
    questions: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    again = iter((1.0,) * 100)
    monkeypatch.setattr(fuzz, "hearing_time", lambda *_: next(again))
    assert attempt(Batch(questions, RIDE, 0, 0, 20, limit=2.0)).faults == ()
    monkeypatch.setattr(fuzz, "hearing_time", lambda *_: 1e6)
    [fault] = attempt(Batch(questions, RIDE, 0, 0, 20, limit=0.0)).faults
    assert "no more than 0 is fine" in fault.what


def test_a_turn_before_is_left_out_where_it_does_not_matter() -> None:
    one = Case("anything", "why? x", ("why x", "y"))
    assert fuzz.shorter(one, lambda c: "x" in c.text) == Case("anything", "x", ())
    kept = fuzz.shorter(one, lambda c: "x" in c.text and len(c.context) == 2)
    assert kept == Case("anything", "x", ("why x", "y"))


def test_batches_make_one_report_of_one_line() -> None:
    one = Tried({"forms": 20, "anything": 20}, {"forms": 15}, 3.25, "'one'")
    other = Tried({"forms": 20, "mutations": 10}, {"forms": 15, "mutations": 1}, 2.0, "'other'")
    whole = together([one, other])
    table, _, targets = fuzz.FuzzReport("fuzz", 1, whole).table().partition("\n\n")
    assert targets.startswith("targets")
    assert table == (
        "70 texts of seed 1, none fails; understood: forms 75.0 %, mutations 10.0 %,"
        " anything 0.0 %; slowest 3.2 ms: 'one'"
    )


def test_the_command_ends_with_1_and_the_text_where_one_fails(
    questions: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    said = fuzz.Fault("'stop \\u2776'", "()", "ValueError: no number")
    failed = Tried({"anything": 1}, {}, 0.0, "", (said,))
    monkeypatch.setattr(fuzz, "in_processes", lambda *_: iter([failed]))
    ran = CliRunner().invoke(app, [*COMMAND, str(questions)])
    assert ran.exit_code == 1
    assert ran.stderr == "xavi: understanding 'stop \\u2776': ValueError: no number\n"


def test_a_process_that_dies_is_a_fault(questions: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        fuzz, "in_processes", lambda _, tasks, __, died: (died(task) for task in tasks)
    )
    with pytest.raises(FaultFound, match="texts 0 to 9 of seed 5: the process died"):
        measure(questions, RIDE, 10, 5, 1, lambda _: None)
