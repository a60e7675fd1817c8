"""Log lines: what they hold, what they leave out, and that they hold nobody up."""

import contextlib
import io
import json
import logging
import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from typing import Any

import pytest
import typer
from hypothesis import given
from hypothesis import strategies as st
from typer.testing import CliRunner

from xavi_dialogue.cli.commands.log_options import logged
from xavi_dialogue.process.log_setup import (
    MAX_LINE,
    OURS,
    WAITING,
    Form,
    LineFormatter,
    LogOptions,
    ThreadedHandler,
    begin,
    is_log,
)
from xavi_dialogue.process.subprocesses import last_words

SECRET = "my aunt Berta lives there"


def record(message: str = "question answered", error: Any = None, **extra: Any) -> Any:
    made = logging.makeLogRecord({"name": "xavi_dialogue.service.server", "levelname": "INFO"})
    made.msg, made.created, made.exc_info = message, 1_800_000_000.25, error
    vars(made).update(extra)
    return made


def told(form: Form, made: logging.LogRecord, **telling: Any) -> str:
    return LineFormatter(LogOptions(form, component="service", **telling)).format(made)


def test_a_line_of_json_holds_what_was_given_in_a_fixed_order() -> None:
    line = told("json", record(timing_ms=12.5, trace_id="abc", session="sunday", request="r1"))
    assert list(json.loads(line).items()) == [
        ("time", "2027-01-15T08:00:00.250Z"),
        ("level", "info"),
        ("component", "service"),
        ("event", "question answered"),
        ("logger", "xavi_dialogue.service.server"),
        ("session", "sunday"),
        ("request", "r1"),
        ("trace_id", "abc"),
        ("timing_ms", 12.5),
    ]


def test_a_line_of_text_is_for_people() -> None:
    line = told("text", record(session="sunday", found="two words"), vehicle="shuttle")
    assert line == (
        "2027-01-15T08:00:00.250Z info service question answered"
        ' vehicle=shuttle session=sunday found="two words"'
    )


@pytest.mark.parametrize("form", ["text", "json"])
def test_what_passengers_say_is_told_only_where_that_is_asked_for(form: Form) -> None:
    try:
        raise ValueError(SECRET)
    except ValueError as error:
        raised = (type(error), error, error.__traceback__)
    made = record("not understood: %s", raised, text=SECRET, detail=SECRET, question=SECRET)
    made.args = (SECRET,)
    line = told(form, made)
    assert SECRET not in line
    assert "ValueError" in line
    assert "test_log_setup.py" in line
    assert told(form, made, dialogue=True).count(SECRET) == 5


class Unprintable:
    def __str__(self) -> str:
        raise RuntimeError("no")


VALUES = st.one_of(
    *(st.text(), st.integers(), st.floats(), st.none(), st.booleans(), st.binary()),
    *(st.lists(st.text()), st.just(Unprintable()), st.text(min_size=2000, max_size=3000)),
)


@given(st.dictionaries(st.from_regex(r"x[a-z_]{1,12}", fullmatch=True), VALUES, max_size=40))
def test_any_values_make_one_line_of_printable_characters(values: dict[str, Any]) -> None:
    for form in ("text", "json"):
        line = told(form, record(**values))
        assert len(line) < MAX_LINE
        assert line.isascii()
        assert line.isprintable()
        assert is_log(line)
        assert "question answered" in line


def test_words_that_do_not_fit_their_arguments_are_told_as_such() -> None:
    made = record("%d questions")
    made.args = ("many",)
    assert "unprintable" in told("json", made, dialogue=True)


def test_control_characters_of_a_vehicle_s_name_are_escaped() -> None:
    line = told("text", record(vehicle="a\x1b[2J\nxavi: warning: gone"))
    assert "\\u001b" in line
    assert "\n" not in line


@pytest.mark.parametrize("line", ["xavi: warning: nothing is kept", "", "Traceback (most recent"])
def test_lines_for_the_passenger_are_no_log(line: str) -> None:
    assert not is_log(line)


def test_the_last_words_of_a_child_are_none_of_its_log() -> None:
    said = ["xavi: cannot go on", *(told(form, record()) for form in ("text", "json")), ""]
    assert last_words(said) == "xavi: cannot go on"
    assert last_words(said[1:]) == ""


@pytest.fixture
def fresh() -> Iterator[None]:
    """The logging of this process as it was before."""
    root = logging.getLogger()
    handlers, levels = list(root.handlers), [logging.getLogger(name).level for name in OURS]
    yield
    for handler in [one for one in root.handlers if one not in handlers]:
        root.removeHandler(handler)
        handler.close()
    for name, level in zip(OURS, levels, strict=True):
        logging.getLogger(name).setLevel(level)


@pytest.mark.usefixtures("fresh")
def test_the_level_is_for_our_own_records() -> None:
    out = io.StringIO()
    handler = begin(out, LogOptions("json", "info"))
    logging.getLogger("xavi_dialogue.service.vehicle_session").info("heard")
    logging.getLogger("xavi_dialogue.service.vehicle_session").debug("unheard")
    logging.getLogger("numba").info("unheard")
    logging.getLogger("numba").warning("foreign")
    handler.close()
    assert [json.loads(line)["event"] for line in out.getvalue().splitlines()] == [
        "heard",
        "foreign",
    ]


@pytest.mark.usefixtures("fresh")
def test_to_begin_again_takes_the_place_of_what_was_before() -> None:
    first, second = io.StringIO(), io.StringIO()
    begin(first, LogOptions())
    handler = begin(second, LogOptions())
    logging.getLogger("xavi_dialogue").warning("once")
    handler.close()
    assert first.getvalue() == ""
    assert second.getvalue().count("once") == 1


class Stuck(io.StringIO):
    """A reader that reads nothing until it is told to."""

    def __init__(self) -> None:
        super().__init__()
        self.read_on, self.reached = threading.Event(), threading.Event()

    def write(self, text: str) -> int:
        self.reached.set()
        self.read_on.wait()
        return super().write(text)


def test_nobody_waits_for_a_reader_and_what_is_lost_is_counted() -> None:
    stuck = Stuck()
    outlet = ThreadedHandler(stuck, LogOptions("json"))
    outlet.handle(record("first"))
    stuck.reached.wait()
    for _ in range(WAITING + 5):
        outlet.handle(record("one of many"))
    stuck.read_on.set()
    while outlet._lines.qsize():  # the thread empties it now
        stuck.reached.wait(0.001)
    outlet.handle(record("last"))
    outlet.close()
    lines = [json.loads(line) for line in stuck.getvalue().splitlines()]
    assert len(lines) == 1 + WAITING + 2
    assert (lines[-2]["event"], lines[-2]["lines"]) == ("log lines lost", 5)
    assert lines[-1]["event"] == "last"


def test_a_reader_that_is_gone_stops_nothing() -> None:
    far, near = os.pipe()
    os.close(far)
    stream = os.fdopen(near, "w")
    outlet = ThreadedHandler(stream, LogOptions())
    for _ in range(3):
        outlet.handle(record())
    outlet.close()
    assert not outlet._writer.is_alive()
    with contextlib.suppress(BrokenPipeError):
        stream.close()


def test_the_last_lines_of_a_process_are_written() -> None:
    code = (
        "import logging, sys; from xavi_dialogue.process.log_setup import *\n"
        "begin(sys.stderr, LogOptions('json', 'info'))\n"
        "for i in range(500): logging.getLogger('planner').info('line', extra={'i': i})\n"
        "sys.exit(3)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 3
    assert [json.loads(line)["i"] for line in done.stderr.splitlines()] == list(range(500))


def command() -> typer.Typer:
    app = typer.Typer()

    @app.command()
    @logged("car")
    def drive(fast: bool = False, vehicle: str = "car") -> None:
        """Drive."""
        logging.getLogger("xavi_dialogue").info("driving", extra={"fast": fast, "text": SECRET})
        logging.getLogger().handlers[-1].close()

    return app


@pytest.mark.usefixtures("fresh")
@pytest.mark.parametrize(
    ("arguments", "environment", "lines"),
    [
        ([], {}, 0),
        (["--log-level", "info"], {}, 1),
        ([], {"XAVI_LOG": "json", "XAVI_LOG_LEVEL": "info"}, 1),
        (["--log", "off"], {"XAVI_LOG_LEVEL": "info"}, 0),
    ],
)
def test_a_command_logs_as_options_and_environment_say(
    arguments: list[str], environment: dict[str, str], lines: int
) -> None:
    done = CliRunner().invoke(command(), ["--fast", "--vehicle", "a", *arguments], env=environment)
    assert done.exit_code == 0, done.output
    found = done.stderr.splitlines()
    assert len(found) == lines
    assert all("fast=true" in line or '"fast": true' in line for line in found)
    assert all(" car driving vehicle=a " in line or '"vehicle": "a"' in line for line in found)
    assert SECRET not in done.stderr


@pytest.mark.usefixtures("fresh")
def test_a_wrong_form_is_wrong_usage() -> None:
    assert CliRunner().invoke(command(), ["--log", "xml"]).exit_code == 2
