"""The scorer of predicted queries, and the reader of annotated questions."""

import json
from pathlib import Path

import pytest
from msgspec.structs import replace

from benchmarks.errors import QuestionFileError
from benchmarks.language.questions import read, read_folder
from benchmarks.language.scoring import Question, Verdict, agreement, verdict
from xavi_dialogue.nlu.projection import QueryFields

WHY = QueryFields(type="why", actor="vehicle:1", factual=("exit-right",), tense="past")
DECLINED = QueryFields(type="out_of_scope", reason="off-topic")
RIGHT = Verdict(type=True, exact=True, exact_primary=True, false_confident=False)


def asked(
    query: QueryFields, *alternatives: QueryFields, underspecified: str | None = None
) -> Question:
    return Question("q", "text", query, "clean", alternatives, (), underspecified)


def test_the_annotated_query_is_right_and_an_alternative_is_as_good() -> None:
    other = replace(WHY, tense="present")
    assert verdict(asked(WHY, other), WHY) == RIGHT
    found = verdict(asked(WHY, other), other)
    assert (found.exact, found.exact_primary, found.false_confident) == (True, False, False)


@pytest.mark.parametrize(
    "wrong",
    [
        replace(WHY, factual=("exit-left",)),
        replace(WHY, factual=None),
        replace(WHY, counterfactual=("stop",)),
        replace(WHY, tense="future"),
        replace(WHY, detail="more"),
    ],
)
def test_a_wrong_field_is_not_exact_and_not_yet_a_confident_error(wrong: QueryFields) -> None:
    expected = Verdict(type=True, exact=False, exact_primary=False, false_confident=False)
    assert verdict(asked(WHY), wrong) == expected


@pytest.mark.parametrize("wrong", [replace(WHY, actor="ego"), replace(WHY, negated=True)])
def test_another_vehicle_or_the_opposite_is_a_confident_error(wrong: QueryFields) -> None:
    assert verdict(asked(WHY), wrong).false_confident
    assert not verdict(asked(WHY, replace(wrong, tense="future")), wrong).false_confident


def test_what_is_not_compared_makes_no_difference() -> None:
    told = replace(WHY, time="just now", event="influence", refers_to_previous=True)
    assert verdict(asked(WHY), told) == RIGHT
    assert verdict(asked(replace(WHY, factual=())), replace(WHY, factual=None)) == RIGHT


def test_a_direction_left_open_is_not_compared() -> None:
    left = replace(WHY, factual=("exit-left",))
    assert verdict(asked(WHY, underspecified="direction"), left).exact
    assert verdict(asked(WHY, underspecified="actor"), left).exact is False


def test_declining_is_never_confident_and_answering_what_has_no_answer_is() -> None:
    assert verdict(asked(DECLINED), replace(DECLINED, reason="command", actor="vehicle:2")) == RIGHT
    declined = verdict(asked(WHY), DECLINED)
    assert not declined.exact
    assert not declined.false_confident
    assert verdict(asked(DECLINED), WHY).false_confident
    assert not verdict(asked(DECLINED, replace(WHY, tense="future")), WHY).false_confident


def test_agreement_is_in_percent() -> None:
    wrong = Verdict(type=True, exact=False, exact_primary=False, false_confident=True)
    found = agreement("all", [RIGHT, RIGHT, RIGHT, wrong])
    assert (found.n, found.type, found.exact, found.false_confident) == (4, 100, 75, 25)


def line(**changes: object) -> str:
    return json.dumps(
        {"id": "a", "text": "Why?", "style": "terse", "query": {"type": "why"}} | changes
    )


def test_lines_are_read_in_order_and_empty_ones_passed_over(tmp_path: Path) -> None:
    (tmp_path / "b.jsonl").write_text(line(id="2") + "\n\n" + line(id="3", context=["Stop!"]))
    (tmp_path / "a.jsonl").write_text(line(id="1", text="Why\u2028not?") + "\n")
    found = read_folder(tmp_path)
    assert [question.id for question in found] == ["1", "2", "3"]
    assert found[2].context == ("Stop!",)


@pytest.mark.parametrize(
    "broken",
    [
        "{",
        "[]",
        line(text=None),
        line(query={"type": "whence"}),
        line(query={"type": "why", "factual": ["fly"]}),
        '{"id": "a"}',
    ],
)
def test_a_broken_line_is_named(tmp_path: Path, broken: str) -> None:
    file = tmp_path / "a.jsonl"
    file.write_text(f"{line()}\n{broken}\n")
    with pytest.raises(QuestionFileError, match=r"a\.jsonl, line 2: .*mend the line"):
        read(file)


def test_a_missing_folder_an_empty_one_and_a_file_of_bytes_are_named(tmp_path: Path) -> None:
    with pytest.raises(QuestionFileError, match=r"nowhere: no \.jsonl files"):
        read_folder(tmp_path / "nowhere")
    file = tmp_path / "a.jsonl"
    file.write_text("\n")
    with pytest.raises(QuestionFileError, match="hold no questions"):
        read_folder(tmp_path)
    file.write_bytes(b"\xff\xfe")
    with pytest.raises(QuestionFileError, match=r"a\.jsonl: cannot be read"):
        read_folder(tmp_path)
