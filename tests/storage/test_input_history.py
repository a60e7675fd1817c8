"""The lines that a passenger typed, and how they are forgotten."""

from datetime import datetime
from pathlib import Path

from xavi_dialogue.storage.input_history import InputHistory, erase, sessions


def lines(file: Path) -> list[str]:
    return [*InputHistory(file, "ada").load_history_strings()][::-1]


def test_what_is_typed_is_there_again_for_its_owner_alone(tmp_path: Path) -> None:
    file = tmp_path / "history"
    InputHistory(file, "ada").append_string("Why?")
    InputHistory(file, "ada").append_string("a\nb")
    assert lines(file) == ["Why?", "a\nb"]
    assert file.stat().st_mode & 0o077 == 0
    assert sessions(file) == {"ada"}


def test_forgetting_erases_what_was_typed_in_the_session_and_nothing_else(tmp_path: Path) -> None:
    file = tmp_path / "history"
    InputHistory(file, "bob").append_string("Where are we?")
    InputHistory(file, "ada").append_string("/save secret.txt")  # no turn came of this ...
    long = "long " * 1000
    for line in (long, "one\n\x1b[31mtwo", "Where are we?"):
        InputHistory(file, "ada").append_string(line)
    now = InputHistory(file, "ada")
    now.append_string("/plan")
    assert lines(file) == [
        "Where are we?",
        "/save secret.txt",
        long,
        "one\n\x1b[31mtwo",
        "Where are we?",
        "/plan",
    ]
    now.forget()
    assert lines(file) == now.get_strings() == ["Where are we?"]
    assert [word in file.read_text() for word in ("secret", "long", "two", "ada")] == [False] * 4
    assert sessions(file) == {"bob"}
    assert [path.name for path in tmp_path.iterdir()] == ["history"]
    assert file.stat().st_mode & 0o077 == 0
    now.append_string("Why?")
    assert lines(file) == ["Where are we?", "Why?"]


def test_all_that_was_typed_can_be_erased(tmp_path: Path) -> None:
    file = tmp_path / "history"
    InputHistory(file, "ada").append_string("Why?")
    with file.open("ab") as other:
        other.write(b"no entry at all\n")
    erase(file)
    assert file.read_bytes() == b""
    erase(tmp_path / "none")
    assert not (tmp_path / "none").exists()


OLD = """
# 2026-01-01 10:00:00.5
+old
+# 2026-09-09 09:09:09

# 2026-01-03 10:00:00 ada
+older

# 2026-03-01 10:00:00 ada
+young

# 2026-03-01 10:00:00 bob
+other

# whenever
+odd
"""


def test_what_was_typed_long_ago_goes(tmp_path: Path) -> None:
    file = tmp_path / "history"
    file.write_text(OLD)
    erase(file, before=datetime(2026, 2, 1))
    assert lines(file) == ["young", "other", "odd"]
    erase(file.with_name("none"), before=datetime(2026, 2, 1))
    file.write_text(OLD)
    erase(file, "bob", datetime(2026, 2, 1))
    assert lines(file) == ["older", "young", "other", "odd"]


def test_a_line_of_which_the_session_is_not_known_goes_with_any(tmp_path: Path) -> None:
    file = tmp_path / "history"
    file.write_text(OLD)
    erase(file, "bob")
    assert lines(file) == ["older", "young"]


def test_what_stays_keeps_the_time_at_which_it_was_typed(tmp_path: Path) -> None:
    file = tmp_path / "history"
    old = "\n# 2026-01-01 10:00:00.5 bob\n+Who is that?\n+Really?\n"
    file.write_text(old)
    typed = InputHistory(file, "ada")
    typed.append_string("Why?")
    typed.forget()
    assert file.read_text().strip() == old.strip()
    erase(file, before=datetime(2026, 2, 1))
    assert lines(file) == []
