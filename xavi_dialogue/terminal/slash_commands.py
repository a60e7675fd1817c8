"""Slash commands: commands of the chat besides questions."""

import difflib
import math
import textwrap
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Literal, TypeAlias

from xavi_dialogue.errors import XaviError

Place: TypeAlias = Literal["terminal", "pipe"]
MIN_TWO_COLUMNS = 60  # columns from which usage and meaning fit side by side
MAX_SPEED = 1000.0  # simulated seconds per second

WHY = "Why?"  # about the latest answer
WHY_DONE = "Why did you do that?"  # about the latest action
MORE = "Tell me more."


class CommandError(XaviError):
    """A command that does not exist, is used wrongly, or cannot be carried out."""


@dataclass(frozen=True, slots=True)
class Form:
    """The syntax of a command."""

    name: str
    does: str
    takes: str = ""  # the argument: "X"; "[FILE]" if optional; empty: none
    terminal: bool = False  # whether it needs a terminal

    @property
    def usage(self) -> str:
        """The usage, such as "/speed X"."""
        return f"/{self.name} {self.takes}".rstrip()


@dataclass(frozen=True, slots=True)
class Command:
    """One command as typed."""

    name: str
    argument: str = ""


def forms(place: Place) -> tuple[Form, ...]:
    """Return the commands that work in a place."""
    return tuple(form for form in _forms().values() if place == "terminal" or not form.terminal)


def read(line: str, place: Place) -> Command:
    """Parse a line that begins with a slash.

    Raises:
        CommandError: the command does not exist, or not here, or not with this argument.
    """
    word, _, argument = line.strip().removeprefix("/").partition(" ")
    name, argument = word.lower(), argument.strip()
    form = _forms().get(name)
    if form is None:
        raise CommandError(
            f"There is no command /{word}. The nearest is /{_nearest(name, forms(place))};"
            " /help lists all."
        )
    if form.terminal and place != "terminal":
        raise CommandError(f"/{name} needs a terminal. /help lists what works without one.")
    if argument and not form.takes:
        raise CommandError(f"/{name} takes nothing after it.")
    if not argument and form.takes and not form.takes.startswith("["):
        raise CommandError(f"/{name} is written {form.usage}. /help says more.")
    return Command(name, argument)


def factor(argument: str) -> float:
    """Parse the argument of /speed: simulated seconds per second.

    Raises:
        CommandError: it is not a number from 0 to 1000.
    """
    try:
        number = float(argument)
    except ValueError:
        number = -1.0
    if not 0.0 <= number <= MAX_SPEED:
        raise CommandError(f"/speed takes one number from 0 to {MAX_SPEED:g}, not {argument!r}.")
    return number


def moment(argument: str) -> float:
    """Parse the argument of /seek: a time [s] of the ride.

    Raises:
        CommandError: it is not a number of 0 or more.
    """
    try:
        number = float(argument.removesuffix("s"))
    except ValueError:
        number = -1.0
    if not 0.0 <= number < math.inf:
        raise CommandError(f"/seek takes a moment in seconds, such as 8.0, not {argument!r}.")
    return number


def listed(place: Place, width: int) -> str:
    """Return the commands, in lines of at most `width` columns."""
    usages = {form.usage: form.does for form in forms(place)}
    column = max(map(len, usages)) + 2
    lines = []
    for usage, does in usages.items():
        if width >= MIN_TWO_COLUMNS:
            hanging, first = " " * column, f"{usage:{column}}"
        else:
            lines.append(usage)
            hanging = first = "  "
        lines.append(wrapper(width, first, hanging).fill(does))
    return "\n".join(lines)


def wrapper(width: int, first: str = "", hanging: str = "") -> textwrap.TextWrapper:
    """Break text into lines of up to `width` columns, at spaces only: `--session` stays whole."""
    return textwrap.TextWrapper(
        width, first, hanging, break_on_hyphens=False, break_long_words=False
    )


def _nearest(name: str, among: Iterable[Form]) -> str:
    """Return the command with the same beginning, else the most similar one."""
    names = [form.name for form in among]
    alike = difflib.get_close_matches(name, names, n=1, cutoff=0.0)
    begun = [known for known in names if name and known.startswith(name)]
    return (begun or alike)[0]


@cache
def _forms() -> Mapping[str, Form]:
    text = files("grammars").joinpath("commands.toml").read_text(encoding="utf-8")
    return {entry["name"]: Form(**entry) for entry in tomllib.loads(text)["command"]}
