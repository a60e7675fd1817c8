"""Questions of an audit, with their moments."""

from pathlib import Path

import pytest

from xavi_dialogue.audit.errors import AuditError
from xavi_dialogue.audit.questions import Question, read, read_file


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("Why did you brake?", Question("Why did you brake?")),
        ("Why did you brake? @ 8", Question("Why did you brake?", 8.0)),
        ("Why did you brake? @8.5 s", Question("Why did you brake?", 8.5)),
        ("Why did you brake? @ braking", Question("Why did you brake?", "braking")),
        ("Was that close? @ closest", Question("Was that close?", "closest")),
        ("Are you there? @ end", Question("Are you there?", "end")),
    ],
)
def test_a_question_may_name_its_moment(line: str, expected: Question) -> None:
    assert read(line) == expected
    assert read(str(expected)) == expected


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("Why? @ noon", "'noon' is no moment; give a time"),
        ("Why? @ -1", "is no moment"),
        ("@ 8", "has no question before the moment"),
        ("", "has no question"),
        ("x" * 5000, "a question has at most"),
    ],
)
def test_what_is_wrong_with_a_question_is_said(line: str, message: str) -> None:
    with pytest.raises(AuditError, match=message):
        read(line)


def test_a_file_has_a_question_in_each_line_and_comments(tmp_path: Path) -> None:
    file = tmp_path / "questions.txt"
    file.write_text("# what we ask\n\nWhy? @ end\nWhat are you doing?\n", encoding="utf-8")
    assert read_file(file) == (Question("Why?", "end"), Question("What are you doing?"))


def test_what_is_wrong_with_a_file_is_said(tmp_path: Path) -> None:
    file = tmp_path / "questions.txt"
    with pytest.raises(AuditError, match="cannot read the questions of"):
        read_file(file)
    file.write_text("# nothing\n", encoding="utf-8")
    with pytest.raises(AuditError, match="has no question"):
        read_file(file)
    file.write_text("Why?\nWhy? @ never\n", encoding="utf-8")
    with pytest.raises(AuditError, match=r"line 2: .*'never' is no moment"):
        read_file(file)
