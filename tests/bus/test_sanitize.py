import pytest
from hypothesis import given
from hypothesis import strategies as st

from xavi_dialogue.bus.sanitize import clean, one_line


@pytest.mark.parametrize(
    ("text", "harmless"),
    [
        ("why?", "why?"),
        ("\x1b[31mred\x1b[0m", "red"),
        ("\x1b]0;title\x07why", "why"),
        ("\x1b]52;c;ZXZpbA==\x1b\\why", "why"),
        ("\x9b2Jwhy", "why"),
        ("a\x1bcb", "ab"),
        ("w\x08h\x00y\x7f", "why"),
        ("\u202ewhy\u202c", "why"),
        ("why\r\nnot", "why\nnot"),
        ("naïve 東京 ß", "naïve 東京 ß"),
    ],
)
def test_nothing_steers_the_terminal(text: str, harmless: str) -> None:
    assert clean(text) == harmless


def test_one_line_has_one_line() -> None:
    assert one_line("  why\n\tdid   you \r\n stop ") == "why did you stop"


@given(st.text())
def test_no_control_character_is_left(text: str) -> None:
    cleaned = clean(text)
    assert all(c == "\n" or (c >= " " and c not in "\x7f\x9b\x9d") for c in cleaned)
    assert clean(cleaned) == cleaned
