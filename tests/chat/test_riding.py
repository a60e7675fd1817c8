"""The options of `xavi chat` and `xavi ask`: what becomes of them before anything is started."""

from contextlib import ExitStack, nullcontext
from dataclasses import replace
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from xavi_dialogue.__main__ import app
from xavi_dialogue.chat import local_backend
from xavi_dialogue.chat import main as chat
from xavi_dialogue.chat.local_backend import LocalOptions
from xavi_dialogue.chat.main import ChatOptions


@pytest.fixture
def rides(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[ChatOptions]:
    """The rides that would have been begun."""
    begun: list[ChatOptions] = []
    monkeypatch.setattr(chat, "through_pipe", lambda ride, *_, **__: begun.append(ride))
    for kind in ("DATA", "STATE", "CONFIG"):
        monkeypatch.setenv(f"XDG_{kind}_HOME", str(tmp_path))
    return begun


def xavi(*arguments: str) -> Result:
    return CliRunner().invoke(app, arguments, catch_exceptions=False)


def test_a_recording_is_begun_over_another_only_if_that_is_said(
    rides: list[ChatOptions], tmp_path: Path
) -> None:
    file = tmp_path / "ride.mcap"
    assert xavi("chat", "--record", str(file)).exit_code == 0
    file.write_bytes(b"")
    refused = xavi("chat", "--record", str(file))
    assert refused.exit_code == 2
    assert "--force overwrites it" in refused.stderr
    assert xavi("chat", "--record", str(file), "--force").exit_code == 0
    assert [(ride.record, ride.overwrite) for ride in rides] == [(file, False), (file, True)]
    assert xavi("chat", "--force", "--connect", "tcp/127.0.0.1:1").exit_code == 2


@pytest.mark.parametrize("seconds", [None, 8.5])
def test_the_car_is_told_how_long_to_drive(
    monkeypatch: pytest.MonkeyPatch, rides: list[ChatOptions], seconds: float | None
) -> None:
    started: list[list[str]] = []

    def start(car: list[str], *_: object) -> nullcontext[None]:
        started.append(car)
        return nullcontext()

    monkeypatch.setattr(local_backend, "start_processes", start)
    asked = () if seconds is None else ("--duration", str(seconds))
    assert xavi("chat", *asked).exit_code == 0
    [ride] = rides
    with chat.start_backend(ride, 0.0, LocalOptions()):
        pass
    [car] = started
    assert ("--duration" in car) == (seconds is not None)
    assert car[-1] == str(seconds) or seconds is None


@pytest.mark.parametrize(
    ("resume", "until"),
    [(None, "up to the end of the first lane change or turn"), (65.0, "up to 1:05")],
)
def test_it_is_said_what_is_waited_for_before_anything_starts(
    rides: list[ChatOptions], resume: float | None, until: str
) -> None:
    assert xavi("chat", "--scenario", "s2").exit_code == 0
    said = chat._announced(replace(rides[0], resume=resume))
    assert "driving s2, seed 0" in said
    assert until in said
    assert said.endswith("answers follow")


@pytest.mark.parametrize("overwrite", [False, True])
def test_the_recorder_is_told_whether_to_overwrite(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, overwrite: bool
) -> None:
    commands: list[list[str]] = []

    class FakeChild(ExitStack):
        def __init__(self, _: str, arguments: list[str], warn: object) -> None:
            super().__init__()
            commands.append(arguments)

    monkeypatch.setattr(local_backend, "Child", FakeChild)
    with ExitStack() as stack:
        local_backend._recorder(
            stack, LocalOptions(tmp_path / "ride.mcap", overwrite), "tcp/127.0.0.1:1"
        )
    [command] = commands
    assert command[:2] == ["record", str(tmp_path / "ride.mcap")]
    assert ("--force" in command) == overwrite


def test_who_names_a_conversation_is_not_told_its_name(rides: list[ChatOptions]) -> None:
    assert "goes on with it" in xavi("chat").stderr
    assert "sunday" not in xavi("chat", "--session", "sunday").stderr
    assert [ride.passenger.session == "sunday" for ride in rides] == [False, True]
    unkept = xavi("chat", "--session", "sunday", "--keep-days", "0")
    assert "nothing of this conversation is kept" in unkept.stderr
