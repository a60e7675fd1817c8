"""Settings: the command line, then the environment, then the file, then what is built in."""

from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner, Result

from xavi_dialogue.__main__ import app
from xavi_dialogue.bus.link import Link
from xavi_dialogue.process import config
from xavi_dialogue.service import main as hub

OPTIONS = {"serve": {"listen": "listen", "keep-days": "keep_days"}, "chat": {"speed": "speed"}}


@pytest.fixture
def served(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[Link]:
    """The links of services that would have been started; no settings but those of the test."""
    links: list[Link] = []
    monkeypatch.setattr(hub, "serve", lambda link, *_, **__: links.append(link))
    monkeypatch.setattr(config, "default_path", lambda: tmp_path / "config.toml")
    for name in ("XAVI_LISTEN", "XAVI_CONFIG", "XAVI_ZENOH", "XAVI_CONNECT"):
        monkeypatch.delenv(name, raising=False)
    return links


def xavi(*arguments: str, **environment: str) -> Result:
    return CliRunner().invoke(app, [*arguments], env=environment, catch_exceptions=False)


def test_each_way_of_saying_it_counts_more_than_the_next(
    served: list[Link], tmp_path: Path
) -> None:
    serve = ("serve", "--keep-days", "0")
    assert xavi(*serve).exit_code == 0
    (tmp_path / "config.toml").write_text('[serve]\nlisten = "tcp/127.0.0.1:1"\n')
    assert xavi(*serve).exit_code == 0
    assert xavi(*serve, XAVI_LISTEN="tcp/127.0.0.1:2").exit_code == 0
    flag = (*serve, "--listen", "tcp/127.0.0.1:3")
    assert xavi(*flag, XAVI_LISTEN="tcp/127.0.0.1:2").exit_code == 0
    places = [*(link.listen for link in served)]
    assert places == [(f"tcp/127.0.0.1:{port}",) for port in (7447, 1, 2, 3)]


def test_a_file_may_be_named(served: list[Link], tmp_path: Path) -> None:
    file = tmp_path / "other.toml"
    file.write_text('listen = "tcp/127.0.0.1:4"\nkeep-days = 0\n')
    assert xavi("--config", str(file), "serve").exit_code == 0
    assert xavi("serve", XAVI_CONFIG=str(file)).exit_code == 0
    assert [link.listen for link in served] == [("tcp/127.0.0.1:4",)] * 2


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("lsten = 1", "lsten is not an option; the nearest is listen, and xavi COMMAND --help"),
        ("[serve]\nspeed = 1", "speed of [serve] is not an option; xavi serve --help lists all"),
        ("[serve]\nkeepdays = 1", "nearest is keep-days, and xavi serve --help lists all"),
        ("[srve]\nlisten = 'x'", "[srve] is not a command; the commands are"),
        ("listen = 1979-05-27", "has to be a text"),
        ("listen =", "cannot be read"),
    ],
)
def test_a_file_that_cannot_be_used_is_told(
    served: list[Link], tmp_path: Path, text: str, problem: str
) -> None:
    file = tmp_path / "config.toml"
    file.write_text(text)
    result = xavi("serve")
    assert result.exit_code == 2
    assert str(file) in result.stderr
    assert problem in result.stderr
    assert served == []


@pytest.mark.parametrize(
    ("text", "arguments", "told"),
    [
        ("[drive]\nspeed = 'fast'", ("drive",), "'--speed' in {file}, [drive]: "),
        ("speed = 5000", ("drive",), "'--speed' in {file}: "),
        ("vehicle = 'a/b'", ("drive",), "'--vehicle' in {file}: a name has"),
        ("[drive]\nspeed = 1", ("drive", "--speed", "fast"), "'--speed': "),
        ("[chat]\nspeed = 'fast'", ("drive", "--speed", "fast"), "'--speed': "),
    ],
)
def test_a_value_that_cannot_be_used_is_told_with_the_file_that_sets_it(
    tmp_path: Path, text: str, arguments: tuple[str, ...], told: str
) -> None:
    file = tmp_path / "config.toml"
    file.write_text(text)
    for given in (("--config", str(file)), ()):
        named = {"XAVI_CONFIG": "" if given else str(file)}
        result = xavi(*given, *arguments, **named)
        assert result.exit_code == 2
        assert f"Invalid value for {told.format(file=file)}" in result.stderr


def test_a_file_that_is_named_has_to_be_there(tmp_path: Path) -> None:
    result = xavi("--config", str(tmp_path / "none.toml"), "scenarios")
    assert result.exit_code == 2
    assert "cannot be read" in result.stderr


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("", {"serve": {}, "chat": {}}),
        ("speed = 2", {"serve": {}, "chat": {"speed": 2}}),
        ("keep-days = 1\n[serve]\nkeep-days = 2", {"serve": {"keep_days": 2}, "chat": {}}),
    ],
)
def test_what_stands_at_the_top_is_for_all_who_have_it(
    tmp_path: Path, text: str, found: dict[str, Any]
) -> None:
    file = tmp_path / "config.toml"
    file.write_text(text)
    assert config.read(file, OPTIONS) == found
