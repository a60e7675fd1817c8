"""`xavi bench parse`: its figures, and that hostile texts are what they claim to be."""

import json
from pathlib import Path
from random import Random

import pytest
from typer.testing import CliRunner

from benchmarks.language import latency, parse
from benchmarks.language.hostile import (
    FRAMES,
    ambiguous,
    capped,
    families,
    half,
    repeated,
)
from benchmarks.language.parse import ParseReport, hardest, measure, scored
from benchmarks.language.scoring import Question
from xavi_dialogue.__main__ import app
from xavi_dialogue.nlu.parse import Parser
from xavi_dialogue.nlu.projection import QueryFields
from xavi_dialogue.nlu.text import spelling
from xavi_dialogue.nlu.text.tokens import MAX_CHARACTERS, MAX_TOKENS, tokenise

STOPPED = {"type": "why", "factual": ["stop"]}
RIGHT = {"id": "a", "text": "Why did you stop?", "style": "clean", "query": STOPPED}
WRONG = {**RIGHT, "id": "b", "text": "Why did vehicle 1 stop?", "style": "terse"}
FOLLOWS = {
    **RIGHT,
    "id": "c",
    "text": "Why not?",
    "context": ["Why did you stop?"],
    "query": {"type": "smalltalk"},
}
RIDE = Path(__file__).parents[2] / latency.RIDE
COMMAND = ("bench", "parse", "--ride", str(RIDE), "--questions")
FEW = {"few": lambda _: [repeated("why"), repeated("stop and")]}


def write(folder: Path, *lines: dict[str, object]) -> None:
    folder.mkdir()
    (folder / "some.jsonl").write_text("\n".join(map(json.dumps, lines)))


@pytest.fixture(scope="module")
def questions(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("questions")
    write(folder / "learn", RIGHT, WRONG)
    write(folder / "blind", RIGHT, FOLLOWS)
    return folder


@pytest.fixture(scope="module")
def report(questions: Path) -> ParseReport:
    return measure(questions, RIDE, lambda _: None, FEW)


def test_questions_are_scored_by_folder_and_group(report: ParseReport) -> None:
    learn, blind = report.sets
    assert (learn.name, learn.all.n, learn.all.type) == ("learn", 2, 100.0)
    assert (learn.all.exact, learn.all.false_confident) == (50.0, 50.0)
    assert [(g.group, g.n, g.exact) for g in learn.styles] == [("clean", 1, 100), ("terse", 1, 0)]
    assert [g.group for g in blind.types] == ["smalltalk", "why"]
    assert [(g.group, g.exact) for g in blind.turns] == [("follow-up", 0.0), ("single", 100.0)]


def test_the_report_is_held_against_its_targets(report: ParseReport) -> None:
    exact, confident, median, *_, worst = report.targets
    assert (exact.value, exact.bound, exact.met) == (50.0, 95.0, False)
    assert confident.value == report.sets[-1].all.false_confident
    assert median.value == report.figures[-1].p50
    assert worst.value == report.hostile[0].most
    assert not report.met
    assert "blind, exact" in report.table()


def test_blind_questions_that_stand_elsewhere_too_are_told_apart(report: ParseReport) -> None:
    assert report.unseen is not None
    assert (report.unseen.n, report.unseen.exact) == (1, 0.0)


def test_latency_and_hostile_texts_are_reported(report: ParseReport) -> None:
    assert [(f.name, f.n) for f in report.figures] == [
        ("learn questions", 2),
        ("blind questions", 2),
    ]
    [few] = report.hostile
    assert (few.family, few.n) == ("few", 2)
    assert few.worst in {repeated("why"), repeated("stop and")}
    assert few.most >= few.p50 > 0
    assert few.growth is None or few.growth > 0


def test_the_table_shows_every_group(report: ParseReport) -> None:
    shown = report.table()
    for name in ("learn", "blind, not in learn", "smalltalk", "terse", "follow-up", "few"):
        assert name in shown


def test_without_blind_questions_there_are_no_figures_of_them(tmp_path: Path) -> None:
    write(tmp_path / "learn", RIGHT)
    notes: list[str] = []
    report = measure(tmp_path, RIDE, notes.append, {})
    assert [one.name for one in report.sets] == ["learn"]
    assert report.unseen is None
    assert "blind holds no .jsonl files" in notes[0]


def test_the_command_prints_json(questions: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(parse, "families", lambda: FEW)
    ran = CliRunner().invoke(app, [*COMMAND, str(questions), "--json"])
    assert ran.exit_code == 0
    found = json.loads(ran.stdout)
    assert found["bench"] == "parse"
    assert found["sets"][0]["all"]["exact"] == 50.0


@pytest.mark.parametrize(
    ("content", "told"), [(None, "no .jsonl files there"), ("{", "some.jsonl, line 1: ")]
)
def test_what_is_missing_or_broken_is_told_in_one_line(
    tmp_path: Path, content: str | None, told: str
) -> None:
    if content is not None:
        (tmp_path / "learn").mkdir()
        (tmp_path / "learn" / "some.jsonl").write_text(content)
    ran = CliRunner().invoke(app, [*COMMAND, str(tmp_path)])
    assert ran.exit_code == 2
    assert told in ran.stderr
    assert ran.stderr.count("\n") == 1


def test_a_prediction_is_scored_in_its_conversation() -> None:
    query = QueryFields(type="why", actor="vehicle:2", factual=("stop",))
    context = ("Why did vehicle 1 stop?",)
    question = Question("q", "And vehicle 2?", query, "ellipsis", context=context)
    assert scored(Parser(), "one", [question]).all.exact == 100.0


def test_every_hostile_text_is_within_the_caps_and_the_same_again() -> None:
    for name, family in families().items():
        texts = family(Random(1))
        assert texts, name
        assert texts == family(Random(1)), name
        assert all(0 < len(text) <= MAX_CHARACTERS for text in texts), name
        assert all(len(text.split()) <= MAX_TOKENS for text in texts), name


def test_repeated_words_reach_the_caps_and_all_of_them_are_read() -> None:
    assert [token.text for token in tokenise(repeated("why")).tokens] == ["why"] * MAX_TOKENS
    assert len(repeated("overtaking")) > MAX_CHARACTERS - len(" overtaking")
    for frame in FRAMES:
        assert not tokenise(repeated(frame)).shortened


def test_a_text_is_cut_at_words_and_halved() -> None:
    assert capped(["a"] * 60) == " ".join("a" * MAX_TOKENS)
    assert capped(["a" * 200, "b" * 55, "c"]) == "a" * 200 + " " + "b" * 55
    assert (half("one two three four"), half("word"), half("x")) == ("one two", "wo", "")


def test_ambiguous_words_are_known_ones() -> None:
    assert {"had", "left"} <= set(ambiguous())
    assert "lane" not in ambiguous()


def test_no_text_profits_from_those_before_it() -> None:
    latency.hearing_time("why did you braek?", latency.record_of(RIDE))
    assert spelling.corrections.cache_info().currsize > 0
    latency.forget()
    assert spelling.corrections.cache_info().currsize == 0


def test_growth_needs_texts_that_take_long_enough(monkeypatch: pytest.MonkeyPatch) -> None:
    times = {"ab ab": 4.0, "ab": 1.0}
    record = latency.record_of(RIDE)
    monkeypatch.setattr(
        parse, "hearing_time", lambda text, record, times=1, known=times: known[text]
    )
    found = hardest("pairs", lambda _: ["ab ab"], record)
    assert (found.most, found.growth, found.growth_most) == (4.0, 4.0, 4.0)
    times["ab"] = 0.1
    assert hardest("pairs", lambda _: ["ab ab"], record).growth is None
