"""The lines that a passenger typed, and how they are forgotten."""

from datetime import datetime
from pathlib import Path

from xavi_dialogue.transports.typed import TypedLines


def lines(file: Path) -> list[str]:
    return [*TypedLines(file).load_history_strings()][::-1]


def test_what_is_typed_is_there_again_for_its_owner_alone(tmp_path: Path) -> None:
    file = tmp_path / "history"
    TypedLines(file).append_string("Why?")
    TypedLines(file).append_string("a\nb")
    assert lines(file) == ["Why?", "a\nb"]
    assert file.stat().st_mode & 0o077 == 0


def test_forgetting_erases_what_was_typed_here_and_the_questions_typed_before(
    tmp_path: Path,
) -> None:
    file = tmp_path / "history"
    before = TypedLines(file)
    for line in ("Where  are we?", "Who is that?", "one\nWhere are we?"):
        before.append_string(line)
    now = TypedLines(file)
    now.append_string("/plan")
    now.forget(["Where are we?"])
    assert lines(file) == ["Who is that?"]
    assert "Where" not in file.read_text()
    assert now.get_strings() == ["Who is that?"]
    assert [path.name for path in tmp_path.iterdir()] == ["history"]
    assert file.stat().st_mode & 0o077 == 0
    now.append_string("Why?")
    assert lines(file) == ["Who is that?", "Why?"]


def test_what_was_typed_long_ago_goes(tmp_path: Path) -> None:
    file = tmp_path / "history"
    file.write_text(
        "\n# 2026-01-01 10:00:00.5\n+old\n+# 2026-09-09 09:09:09\n"
        "\n# 2026-03-01 10:00:00\n+young\n\n# whenever\n+odd\n"
    )
    TypedLines(file).expire(datetime(2026, 2, 1))
    assert lines(file) == ["young", "odd"]
    TypedLines(file.with_name("none")).expire(datetime(2026, 2, 1))


def test_what_stays_keeps_the_time_at_which_it_was_typed(tmp_path: Path) -> None:
    file = tmp_path / "history"
    old = "\n# 2026-01-01 10:00:00.5\n+Who is that?\n+Really?\n"
    file.write_text(old)
    typed = TypedLines(file)
    typed.append_string("Why?")
    typed.forget(["Why?"])
    assert file.read_text().strip() == old.strip()
    typed.expire(datetime(2026, 2, 1))
    assert lines(file) == []
