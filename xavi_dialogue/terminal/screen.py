"""Terminal output of the chat: wrapped at words, with colours if the terminal has them."""

import curses
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, nullcontext
from typing import TextIO

from prompt_toolkit import print_formatted_text
from prompt_toolkit.application import get_app_session
from prompt_toolkit.formatted_text import FormattedText
from prompt_toolkit.input.vt100 import Vt100Input
from prompt_toolkit.output import ColorDepth
from prompt_toolkit.output.vt100 import Vt100_Output
from prompt_toolkit.styles import BaseStyle, Style
from prompt_toolkit.utils import get_cwidth, is_dumb_terminal

from xavi_dialogue.bus.sanitize import clean

MAX_WIDTH = 100  # columns of an answer
STANDARD_OUTPUT = 1
PLAIN = Style([("bottom-toolbar", "noreverse")])


def known_colours(terminal: str) -> int:
    """Return the number of colours in the description of this process's terminal; 0 without one.

    Args:
        terminal: its name. Descriptions are read once: only the first name counts.
    """
    try:
        curses.setupterm(terminal, STANDARD_OUTPUT)
    except curses.error:
        return 0
    return max(curses.tigetnum("colors"), 0)


def has_colours(
    environment: Mapping[str, str], count: Callable[[str], int] = known_colours
) -> bool:
    """Decide whether to write in colours.

    Args:
        environment: NO_COLOR forbids them unless it is empty (no-color.org); TERM names the
            terminal.
        count: number of colours of the terminal.
    """
    terminal = environment.get("TERM", "")
    if environment.get("NO_COLOR") or not terminal or is_dumb_terminal(terminal):
        return False
    return count(terminal) > 0


class SilentScreen(Vt100_Output):
    """A terminal that is never asked for its cursor position.

    The answer comes in among the keys, and while lines are printed above the prompt either may
    get lost.
    """

    @property
    def responds_to_cpr(self) -> bool:
        """See Output."""
        return False

    def get_rows_below_cursor_position(self) -> int:
        """Return the least number: without a number no status line would be shown."""
        return 1


def silent_screen(stdout: TextIO, terminal: str | None) -> SilentScreen:
    """Return the terminal that a stream writes to."""
    screen = SilentScreen.from_pty(stdout, term=terminal)
    assert isinstance(screen, SilentScreen)
    return screen


def wrap(text: str, width: int) -> str:
    """Return the text without terminal escapes, in lines of at most `width` columns.

    Lines break between words; a word wider than a line breaks where it must. Wide characters
    count twice, combining ones not at all and stay with what they combine with.
    """
    return "\n".join(
        part for line in clean(text).split("\n") for part in _lines(line, max(width, 1))
    )


def _lines(line: str, width: int) -> Iterator[str]:
    current = ""
    for word in line.split():
        longer = f"{current} {word}" if current else word
        if get_cwidth(longer) <= width:
            current = longer
            continue
        if current:
            yield current
        *whole, current = _pieces(word, width)
        yield from whole
    yield current


def _pieces(word: str, width: int) -> Iterator[str]:
    piece, taken = "", 0
    for character in word:
        columns = get_cwidth(character)
        if piece and taken + columns > width:
            yield piece
            piece, taken = "", 0
        piece, taken = piece + character, taken + columns
    yield piece


class Keyboard(Vt100Input):
    """A terminal's keyboard, which is read key by key at all times.

    Otherwise, what is typed at the moment at which something is printed would be echoed by the
    terminal a second time, and Ctrl-D be lost.
    """

    def cooked_mode(self) -> AbstractContextManager[None]:
        """See Input."""
        return nullcontext()


class Screen:
    """The output above the line that is being typed, if any."""

    def __init__(self, *, colours: bool) -> None:
        self.depth = None if colours else ColorDepth.DEPTH_1_BIT  # None: as for the terminal
        self.style: BaseStyle | None = None if colours else PLAIN
        self.faint = "fg:ansibrightblack" if colours else ""

    @property
    def columns(self) -> int:
        """The present width of the terminal, in columns."""
        return get_app_session().output.get_size().columns

    @property
    def width(self) -> int:
        """The width of an answer, in columns."""
        return min(self.columns, MAX_WIDTH)

    def say(self, text: str) -> None:
        """Write an answer, and an empty line."""
        self._print(wrap(text, self.width) + "\n", "")

    def tell(self, text: str) -> None:
        """Write the result of a command."""
        self._print(wrap(text, self.width), "")

    def lay_out(self, text: str) -> None:
        """Write lines that are wrapped already."""
        self._print(clean(text), "")

    def dim(self, text: str) -> None:
        """Write a note."""
        self._print(wrap(text, self.width), self.faint)

    def _print(self, text: str, style: str) -> None:
        print_formatted_text(FormattedText([(style, text)]), color_depth=self.depth)


def cut(text: str, width: int) -> str:
    """Cut a line to `width` columns, with a sign if something is left out."""
    if get_cwidth(text) <= width:
        return text
    return next(_pieces(text, max(width - 1, 1))) + "…"
