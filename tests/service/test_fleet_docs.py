"""What docs/fleet.md says of settings, logs and counters is what there is."""

import json
import logging
import re
from pathlib import Path

import pytest
import typer
from typer.testing import CliRunner

from xavi_dialogue.__main__ import app
from xavi_dialogue.bus.health import MEMORY
from xavi_dialogue.dashboard import controller
from xavi_dialogue.process.log_setup import LineFormatter, LogOptions
from xavi_dialogue.recording import recorder
from xavi_dialogue.service import server
from xavi_dialogue.vehicle import node


@pytest.fixture(scope="module")
def page(root: Path) -> str:
    return (root / "docs" / "fleet.md").read_text(encoding="utf-8")


def variables() -> dict[str, tuple[str, set[str]]]:
    """Every environment variable, with its option and the commands that take it."""
    found: dict[str, tuple[str, set[str]]] = {}
    group = typer.main.get_command(app)
    commands = {"xavi": group, **group.commands}  # type: ignore[attr-defined]
    for name, command in commands.items():
        for option in command.params:
            variable = getattr(option, "envvar", None)
            if variable:
                longest = max(option.opts, key=len)
                found.setdefault(str(variable), (longest, set()))[1].add(name)
    return found


def test_every_variable_is_in_the_table(page: str) -> None:
    rows = re.findall(r"^\| `(XAVI_\w+)` \| `(--[\w-]+)` \| (.*) \|", page, flags=re.MULTILINE)
    told = {name: (option, set(re.findall(r"`([\w]+)`", of))) for name, option, of in rows}
    assert told == variables()
    assert [name for name, _, _ in rows] == sorted(told)


def test_the_settings_shown_can_be_read(page: str, tmp_path: Path) -> None:
    [example] = re.findall(r"^```toml\n(.*?)^```", page, flags=re.MULTILINE | re.DOTALL)
    file = tmp_path / "config.toml"
    file.write_text(example)
    assert CliRunner().invoke(app, ["--config", str(file), "scenarios"]).exit_code == 0


def test_the_log_line_shown_is_one(page: str) -> None:
    [example] = re.findall(r"^```json\n(.*?)\n```", page, flags=re.MULTILINE | re.DOTALL)
    shown = json.loads(example)
    record = logging.makeLogRecord({"name": shown["logger"], "levelname": "INFO"})
    record.msg = shown["event"]
    record.created = 1_795_289_506.949
    standard = {"time", "level", "component", "event", "logger"}
    vars(record).update({name: shown[name] for name in shown if name not in standard})
    assert LineFormatter(LogOptions("json", "info", "service")).format(record) == example


def test_every_counter_is_in_the_table(page: str) -> None:
    told = set()
    owner = "(?:service|car|recorder|dashboard|each)"
    for row in re.findall(rf"^\| (`.*?`) \| {owner}", page, re.MULTILINE):
        told |= set(re.findall(r"`(\w+)`", row))
    assert told >= {
        *server.COUNTERS,
        *node.COUNTERS,
        *recorder.COUNTERS,
        *controller.COUNTERS,
        MEMORY,
    }
