"""Texts made at random: the parser has a result for each, and faults are told as they are."""

from pathlib import Path
from random import Random

import pytest
from typer.testing import CliRunner

from xavi_dialogue.__main__ import app
from xavi_dialogue.app.bench import fuzz
from xavi_dialogue.app.bench.fuzz import Batch, Case, Tried, asked, attempt, case, measure, together
from xavi_dialogue.app.bench.mutations import anything, mutated
from xavi_dialogue.app.bench.questions import FOLDER
from xavi_dialogue.app.bench.sentences import phrase, sentence
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.grammar import STARTS
from xavi_dialogue.language.lattice import build
from xavi_dialogue.language.parse import explained
from xavi_dialogue.language.report import ParseReport
from xavi_dialogue.language.wordlists import vocabulary

RUNS = 2000


@pytest.fixture
def questions(root: Path) -> Path:
    return root / FOLDER


def test_no_text_makes_the_parser_fail(questions: Path) -> None:
    tried = attempt(Batch(questions, seed=7, begin=0, end=RUNS, limit=None))
    assert tried.faults == ()
    assert sum(tried.runs.values()) == RUNS
    assert tried.understood["grammar"] > tried.understood["anything"]


def test_texts_follow_from_seed_and_number(questions: Path) -> None:
    known = asked(questions)
    texts = [case(3, number, known) for number in range(30)]
    assert texts == [case(3, number, known) for number in range(30)]
    assert texts != [case(4, number, known) for number in range(30)]
    assert {one.source for one in texts} == set(fuzz.SOURCES)
    assert any(one.context for one in texts)


def test_a_phrase_stands_for_its_terminal() -> None:
    rng = Random(0)
    for terminal in sorted(vocabulary().terminals):
        words = tuple(phrase(rng, terminal).split())
        found = dict(vocabulary().phrases.all_from(words, 0))
        assert terminal in {sense.terminal for sense in found[len(words)]}


def test_sentences_hold_only_what_the_word_lists_hold() -> None:
    rng = Random(0)
    for _ in range(200):
        words = sentence(rng).replace(",", "").split()
        known = vocabulary().words
        assert all(word in known or word.isdecimal() for word in words)
        assert build(tuple(words)) is not None


def test_each_kind_of_question_is_drawn_from_the_grammar() -> None:
    drawn = [sentence(Random(k)) for k in range(400)]
    types = {r.type for text in drawn if isinstance(r := explained(text).result, Query)}
    assert types >= {"why", "why_not", "what_if", "what", "when", "compare", "help"}
    assert len(set(drawn)) > len(STARTS)


def test_mutations_change_and_anything_is_made() -> None:
    rng = Random(0)
    texts = [mutated(rng, ["Why did you stop?", "Are you sure?"]) for _ in range(200)]
    assert len(set(texts)) > 100
    assert any(not text.isascii() for text in texts)
    assert len({anything(rng) for _ in range(100)}) > 80


def broken(text: str, *_: object) -> ParseReport:
    if "stop" in text:
        raise KeyError("stop")
    return explained(text)


def test_a_fault_is_told_with_as_little_text_as_it_takes(
    questions: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(fuzz, "explained", broken)
    [fault] = attempt(Batch(questions, 0, 0, 200, limit=None)).faults
    assert fuzz.told(fault) == "parsing 'stop': KeyError: 'stop'"


def test_a_result_that_is_no_valid_query_is_a_fault(
    questions: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    wrong = ParseReport((), (), False, (), Query(type="whence"))  # type: ignore[arg-type]
    monkeypatch.setattr(fuzz, "explained", lambda *_: wrong)
    [fault] = attempt(Batch(questions, 0, 0, 9, limit=None)).faults
    assert "whence" in fault.what


def test_a_text_is_slow_only_if_it_is_so_twice(
    questions: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    again = iter((1.0,) * 100)
    monkeypatch.setattr(fuzz, "parse_time", lambda *_: next(again))
    assert attempt(Batch(questions, 0, 0, 20, limit=2.0)).faults == ()
    monkeypatch.setattr(fuzz, "parse_time", lambda *_: 1e6)
    [fault] = attempt(Batch(questions, 0, 0, 20, limit=0.0)).faults
    assert "no more than 0 is fine" in fault.what


def test_a_turn_before_is_left_out_where_it_does_not_matter() -> None:
    one = Case("anything", "why? x", ("why x", "y"))
    assert fuzz.shorter(one, lambda c: "x" in c.text) == Case("anything", "x", ())
    kept = fuzz.shorter(one, lambda c: "x" in c.text and len(c.context) == 2)
    assert kept == Case("anything", "x", ("why x", "y"))


def test_batches_make_one_report_of_one_line() -> None:
    one = Tried({"grammar": 20, "anything": 20}, {"grammar": 15}, 3.25, "'one'")
    other = Tried({"grammar": 20, "mutations": 10}, {"grammar": 15, "mutations": 1}, 2.0, "'other'")
    whole = together([one, other])
    assert fuzz.FuzzReport("fuzz", 1, whole).table() == (
        "70 texts of seed 1, none fails; understood: grammar 75.0 %, mutations 10.0 %,"
        " anything 0.0 %; slowest 3.2 ms: 'one'"
    )


def test_the_command_ends_with_1_and_the_text_where_one_fails(
    questions: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    said = fuzz.Fault("'stop \\u2776'", "()", "ValueError: no number")
    failed = Tried({"anything": 1}, {}, 0.0, "", (said,))
    monkeypatch.setattr(fuzz, "in_processes", lambda *_: iter([failed]))
    ran = CliRunner().invoke(app, ["bench", "fuzz", "--runs", "1", "--questions", str(questions)])
    assert ran.exit_code == 1
    assert ran.stderr == "xavi: parsing 'stop \\u2776': ValueError: no number\n"


def test_a_process_that_dies_is_a_fault(questions: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        fuzz, "in_processes", lambda _, tasks, __, died: (died(task) for task in tasks)
    )
    with pytest.raises(fuzz.FaultFound, match="texts 0 to 9 of seed 5: the process died"):
        measure(questions, 10, 5, 1, lambda _: None)
