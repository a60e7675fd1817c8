"""Slash commands as they are written."""

import re

import pytest

from xavi_dialogue.terminal import slash_commands
from xavi_dialogue.terminal.slash_commands import Command, CommandError, forms


def test_a_command_is_read_with_what_it_takes() -> None:
    assert slash_commands.read("/why", "pipe") == Command("why")
    assert slash_commands.read(" /SAVE  a file.txt ", "pipe") == Command("save", "a file.txt")
    assert slash_commands.read("/save", "terminal") == Command("save")


@pytest.mark.parametrize(
    ("line", "problem"),
    [
        ("/hist", "There is no command /hist. The nearest is /history; /help lists all."),
        ("/forgte", "There is no command /forgte. The nearest is /forget; /help lists all."),
        ("/", "There is no command /. The nearest is /"),
        ("/plan b", "/plan takes nothing after it."),
        ("/speed", "/speed is written /speed X. /help says more."),
    ],
)
def test_errors_name_what_would_be_right(line: str, problem: str) -> None:
    with pytest.raises(CommandError, match=re.escape(problem)):
        slash_commands.read(line, "terminal")


def test_what_needs_a_terminal_is_refused_without_one() -> None:
    with pytest.raises(CommandError, match="/pause needs a terminal"):
        slash_commands.read("/pause", "pipe")
    with pytest.raises(CommandError, match="nearest is /plan;"):
        slash_commands.read("/paus", "pipe")


@pytest.mark.parametrize("argument", ["fast", "nan", "-1", "1001", ""])
def test_a_speed_is_a_number_in_range(argument: str) -> None:
    with pytest.raises(CommandError, match="from 0 to 1000"):
        slash_commands.factor(argument)


@pytest.mark.parametrize("argument", ["back", "nan", "-1", "inf", ""])
def test_a_moment_is_a_number_of_seconds(argument: str) -> None:
    with pytest.raises(CommandError, match="a moment in seconds"):
        slash_commands.moment(argument)


def test_moments() -> None:
    assert (slash_commands.moment("0"), slash_commands.moment("2.5s")) == (0.0, 2.5)


def test_speeds() -> None:
    assert (slash_commands.factor("0"), slash_commands.factor("2.5")) == (0.0, 2.5)


@pytest.mark.parametrize("width", [40, 50, 59, 60, 120])
def test_every_command_is_listed_within_the_width(width: int) -> None:
    lines = slash_commands.listed("terminal", width).splitlines()
    assert max(map(len, lines)) <= width
    starts = [line.split()[0] for line in lines if line.startswith("/")]
    assert starts == [f"/{form.name}" for form in forms("terminal")]
    assert {form.name for form in forms("terminal")} - {form.name for form in forms("pipe")} == {
        *("pause", "resume", "speed", "seek")
    }


def test_lines_break_at_spaces_alone() -> None:
    note = (
        "this conversation is 20261121-164210-3f9c: --session 20261121-164210-3f9c goes on with it"
    )
    for width in range(10, 100):
        lines = slash_commands.wrapper(width).wrap(note)
        assert [word for line in lines for word in line.split()] == note.split()
        assert max(map(len, lines)) <= max(width, len("20261121-164210-3f9c:"))
