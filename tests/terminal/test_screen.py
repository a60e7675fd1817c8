"""What the chat writes: wrapping, and when there are colours."""

import subprocess
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st
from prompt_toolkit.utils import get_cwidth

from xavi_dialogue.bus.sanitize import clean
from xavi_dialogue.terminal.screen import cut, has_colours, wrap


def test_lines_break_between_words() -> None:
    assert wrap("one two three\n\nfour", 7) == "one two\nthree\n\nfour"


def test_wide_characters_count_twice() -> None:
    assert wrap("車車 車", 6) == "車車\n車"
    assert wrap("車車 車", 7) == "車車 車"


def test_combining_characters_count_nothing_and_stay() -> None:
    word = "e\u0301" * 4
    assert wrap(f"{word} {word}", 9) == f"{word} {word}"
    assert wrap(word, 3) == "e\u0301" * 3 + "\n" + "e\u0301"


def test_escapes_are_stripped() -> None:
    assert wrap("\x1b[31mred\x1b[0m \x1b]0;title\x07word\x9b2J", 80) == "red word"


@given(st.text(max_size=200), st.integers(2, 40))
def test_no_line_is_too_wide_and_no_character_is_lost(text: str, width: int) -> None:
    wrapped = wrap(text, width)
    assert max(map(get_cwidth, wrapped.split("\n"))) <= width
    assert "".join(wrapped.split()) == "".join(clean(text).split())


def test_a_line_is_cut_where_it_does_not_fit() -> None:
    assert cut("status", 6) == "status"
    assert cut("status", 5) == "stat…"
    assert cut("車車", 3) == "車…"


@pytest.mark.parametrize(
    ("environment", "expected"),
    [
        ({"TERM": "xterm"}, True),
        ({"TERM": "xterm", "NO_COLOR": ""}, True),
        ({"TERM": "xterm", "NO_COLOR": "0"}, False),
        ({"TERM": "dumb"}, False),
        ({"TERM": ""}, False),
        ({}, False),
        ({"TERM": "vt100"}, False),
    ],
)
def test_colours_only_where_there_are_any_and_nobody_minds(
    environment: dict[str, str], *, expected: bool
) -> None:
    count = {"xterm": 8, "vt100": 0, "dumb": 8, "": 8}.__getitem__
    assert has_colours(environment, count) is expected


@pytest.mark.parametrize(("terminal", "some"), [("linux", True), ("vt100", False), ("what", False)])
def test_colours_are_looked_up_by_the_name_of_the_terminal(terminal: str, *, some: bool) -> None:
    script = f"from xavi_dialogue.terminal.screen import *; print(known_colours({terminal!r}))"
    counted = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert (int(counted.stdout) > 0) is some
