"""The options of `xavi dashboard`: what becomes of them before anything is started."""

from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from tests.fakes import s1_moments
from tests.recording.test_player import recorded_in
from tests.storage.test_turn_log import new
from xavi_dialogue.__main__ import app
from xavi_dialogue.chat.main import ChatOptions
from xavi_dialogue.dashboard import main
from xavi_dialogue.dashboard.main import DashboardOptions
from xavi_dialogue.storage.conversations import RideName, Store

TOKEN = "correct-horse-battery-staple"
OTHER = "another-horse-of-the-stable"
HERE = ("--connect", "tcp/127.0.0.1:1")
SEEN = "every user of this machine can see --token"


@pytest.fixture
def tasks(monkeypatch: pytest.MonkeyPatch) -> list[DashboardOptions]:
    """What would have been shown."""
    begun: list[DashboardOptions] = []
    monkeypatch.setattr(main, "run", lambda task, _: begun.append(task))
    monkeypatch.delenv("XAVI_DASHBOARD_TOKEN", raising=False)
    return begun


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """A file with a token, for its owner alone."""
    made = tmp_path / "token"
    made.write_text(f"{TOKEN}\n")
    made.chmod(0o600)
    return made


def dashboard(*arguments: str, token: str | None = None) -> Result:
    extra = {} if token is None else {"XAVI_DASHBOARD_TOKEN": token}
    runner = CliRunner(env={"COLUMNS": "200", **extra})
    return runner.invoke(app, ["dashboard", *arguments], catch_exceptions=False)


def test_a_token_in_the_command_is_used_and_warned_of(tasks: list[DashboardOptions]) -> None:
    done = dashboard(*HERE, "--token", TOKEN)
    assert done.exit_code == 0
    [warning] = [line for line in done.stderr.splitlines() if SEEN in line]
    assert warning.startswith("xavi: warning: ")
    assert "--token-file" in warning
    assert "XAVI_DASHBOARD_TOKEN" in warning
    assert TOKEN not in done.stderr
    assert [task.listen.token for task in tasks] == [TOKEN]


def test_a_token_that_nobody_sees_is_not_warned_of(
    tasks: list[DashboardOptions], file: Path
) -> None:
    for done in (dashboard(*HERE, token=TOKEN), dashboard(*HERE, "--token-file", str(file))):
        assert (done.exit_code, done.stderr) == (0, "")
    assert [task.listen.token for task in tasks] == [TOKEN, TOKEN]


def test_started_again_with_a_file_the_token_is_the_same(
    tasks: list[DashboardOptions], tmp_path: Path
) -> None:
    there = (*HERE, "--listen", "0.0.0.0:0", "--token-file", str(tmp_path / "new"))
    first, second = dashboard(*there), dashboard(*there)
    assert (first.exit_code, second.exit_code) == (0, 0)
    assert "has a new token" in first.stderr
    assert second.stderr == ""
    one, other = (task.listen.token for task in tasks)
    assert one == other
    assert one is not None


def test_of_two_tokens_the_one_counts_that_was_set_nearer(
    tasks: list[DashboardOptions], file: Path, tmp_path: Path
) -> None:
    both = dashboard(*HERE, "--token", OTHER, "--token-file", str(file))
    assert both.exit_code == 2
    assert "either --token or --token-file" in both.stderr
    assert dashboard(*HERE, "--token-file", str(file), token=OTHER).exit_code == 0
    settings = tmp_path / "config.toml"
    settings.write_text(f'[dashboard]\ntoken-file = "{file}"\n')
    with_settings = ["--config", str(settings), "dashboard", *HERE]
    for extra in ({}, {"XAVI_DASHBOARD_TOKEN": OTHER}):
        assert CliRunner(env=extra).invoke(app, with_settings).exit_code == 0
    assert [task.listen.token for task in tasks] == [TOKEN, TOKEN, OTHER]


def test_what_is_no_token_starts_nothing(tasks: list[DashboardOptions], file: Path) -> None:
    file.write_text("short")
    refused = dashboard(*HERE, "--token-file", str(file))
    assert refused.exit_code == 2
    assert f"{file} holds no token" in refused.stderr
    assert tasks == []


def test_no_browser_is_opened_at_an_address_with_a_token(tasks: list[DashboardOptions]) -> None:
    dashboard(*HERE)
    dashboard(*HERE, "--no-open")
    dashboard(*HERE, token=TOKEN)
    dashboard(*HERE, "--listen", "0.0.0.0:0")
    assert [task.opens_browser for task in tasks] == [True, False, False, False]


def test_a_recording_goes_on_where_it_was_asked_about(
    tasks: list[DashboardOptions], tmp_path: Path
) -> None:
    recording, store = tmp_path / "ride.mcap", tmp_path / "store.sqlite3"
    recorded_in(recording, s1_moments())
    with Store(store) as kept:
        kept.keep([new("ada", "Why?", RideName("r1", "s1", 4), at=6.0)])
        kept.keep([new("bob", "Why?", RideName("r2", "s1", 7), at=5.0)])
    played = ("--replay", str(recording), "--store", str(store), "--session")
    told = [dashboard(*played, session).stderr for session in ("ada", "bob", "eve")]
    rides = [task.source for task in tasks if isinstance(task.source, ChatOptions)]
    assert [ride.resume for ride in rides] == [6.0, None, None]
    assert "going on with ada: 1 turn, at 0:06" in told[0]
    assert "of another ride" in told[1]
    assert told[2] == ""
