"""The command line: what it prints, and how it ends."""

import gzip
import io
import json
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from msgspec.structs import replace as replace_field
from typer.testing import CliRunner, Result

from benchmarks.drive import drive as bench_drive
from benchmarks.drive.runs import Run
from planner.record.trace import encode
from sim.setup import scenario
from tests.recording.test_player import recorded_in, ride_moments
from tests.sim.setup.test_configuration import configured
from xavi_dialogue.__main__ import _note, app
from xavi_dialogue.chat import main as chat
from xavi_dialogue.cli import ask
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.domain.answers import Reason
from xavi_dialogue.inspection.trace_files import read
from xavi_dialogue.process.exit_status import status_of
from xavi_dialogue.storage import ride_file
from xavi_dialogue.vehicle import main as drive

KEYS = [
    *("schema", "text", "kind", "reason", "query", "explanation", "acts", "answers", "choices"),
    *("suggestions", "trace_id", "sim_time", "timing_ms"),
]


def xavi(*arguments: str, stdin: str | None = None) -> Result:
    return CliRunner().invoke(app, list(arguments), input=stdin)


@pytest.mark.parametrize(
    ("kind", "reason", "status"),
    [
        ("answer", None, 0),
        ("refusal", "did-not-happen", 3),
        ("clarification", "ambiguous", 3),
        ("refusal", "not-understood", 4),
        ("refusal", "planner-unavailable", 5),
        ("refusal", "timed-out", 6),
    ],
)
def test_replies_have_exit_statuses(kind: str, reason: Reason | None, status: int) -> None:
    reply = Reply(text="", kind=kind, reason=reason, sim_time=0.0)  # type: ignore[arg-type]
    assert status_of(reply) == status


def test_the_version_is_told() -> None:
    done = xavi("--version")
    assert (done.exit_code, done.stdout.split()[0]) == (0, "xavi")


@pytest.mark.parametrize(
    "arguments",
    [
        ["fly"],
        ["ask"],
        ["ask", "Why?", "--seed", "-1"],
        ["ask", "Why?", "--at", "noon"],
        ["ask", "Why?", "--style", "pirate"],
        ["parse"],
        ["parse", "Why?", "--vehicles", "all"],
        ["bench", "nothing"],
        ["drive", "--scenario", "nowhere"],
        ["chat", "--scenario", "nowhere"],
        ["chat", "--session", "a b"],
        ["chat", "--vehicle", "a/b", "--connect", "tcp/127.0.0.1:1"],
        ["chat", "--scenario", "s1", "--connect", "tcp/127.0.0.1:1"],
        ["chat", "--record", "README.md"],
        ["chat", "--record", "x.mcap", "--connect", "tcp/127.0.0.1:1"],
        ["ask", "Why?", "--seed", "1", "--connect", "tcp/127.0.0.1:1"],
        ["ask", "Why?", "--zenoh", "nowhere.json5"],
        ["ask", "Why?", "--connect", "nonsense"],
        ["transcripts", "--folder", "nowhere"],
    ],
)
def test_wrong_usage_ends_with_2_and_no_traceback(arguments: list[str]) -> None:
    done = xavi(*arguments)
    assert done.exit_code == 2
    assert done.stdout == ""
    assert "Traceback" not in done.stderr
    assert done.stderr.strip()


def test_a_missing_scenario_lists_those_that_exist() -> None:
    told = xavi("ask", "Why?", "--scenario", "nowhere").stderr
    assert "s1" in told
    assert "s2" in told
    assert len(told.splitlines()) == 1


def test_a_broken_scenario_folder_names_file_and_key(root: Path, tmp_path: Path) -> None:
    folder = tmp_path / "mine"
    shutil.copytree(root / "sim" / "scenarios" / "s1", folder)
    config = folder / "scenario.toml"
    config.write_text(config.read_text().replace("step = 0.1", 'step = "often"'))
    done = xavi("ask", "Why?", "--scenario", str(folder))
    assert done.exit_code == 2
    assert "scenario.toml" in done.stderr
    assert "step" in done.stderr


def test_scenarios_are_listed() -> None:
    listed = json.loads(xavi("scenarios", "--json").stdout)
    assert {"s1", "s2"} <= {one["name"] for one in listed}
    assert "s1" in xavi("scenarios").stdout


def test_scenarios_are_listed_without_netconvert(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    without_netconvert(monkeypatch, tmp_path)
    listed = json.loads(xavi("scenarios", "--json").stdout)
    assert "bend" in {one["name"] for one in listed}


def test_a_benchmark_of_all_scenarios_leaves_out_what_needs_netconvert(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    without_netconvert(monkeypatch, tmp_path)
    monkeypatch.setattr(bench_drive, "run", lambda task: Run(*task, error="not driven"))
    monkeypatch.setattr(bench_drive, "in_processes", lambda work, tasks, *_: map(work, tasks))
    done = xavi("bench", "drive", "--runs", "7", "--json")
    found = json.loads(done.stdout)
    assert found["left_out"] == ["bend"]
    assert {"s1", "s2"} <= {row["scenario"] for row in found["scenarios"]}
    assert "leaving out bend" in done.stderr
    assert "bend" in xavi("bench", "drive", "--runs", "7").stdout.splitlines()[-1]
    asked = xavi("bench", "drive", "--scenario", "bend", "--runs", "1")
    assert (asked.exit_code, asked.stdout) == (2, "")
    assert "`maps`" in asked.stderr


def without_netconvert(monkeypatch: pytest.MonkeyPatch, folder: Path) -> None:
    monkeypatch.setattr(sys, "executable", str(folder / "python"))
    monkeypatch.setenv("PATH", str(folder))
    monkeypatch.setenv("XDG_CACHE_HOME", str(folder / "cache"))


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["drive"], 1),
        (["drive", "--control"], 0),  # whoever started it has told
        (["ask", "Why?"], 1),
        (["chat"], 1),
    ],
)
def test_what_looks_wrong_in_a_scenario_is_told_once(
    monkeypatch: pytest.MonkeyPatch, arguments: list[str], told: int
) -> None:
    doubtful = replace(scenario.load("s1"), warnings=("a road ends",))
    reply = Reply(text="", kind="answer", reason=None, sim_time=0.0)
    monkeypatch.setattr(scenario, "load", lambda *_: doubtful)
    monkeypatch.setattr(drive, "drive", lambda *_: drive.Summary("s1", 0, "arrived"))
    monkeypatch.setattr(ask, "ask_once", lambda *_: reply)
    monkeypatch.setattr(chat, "through_pipe", lambda *_, **__: None)
    done = xavi(*arguments)
    assert done.exit_code == 0
    warnings = [line for line in done.stderr.splitlines() if "warning" in line]
    assert warnings == ["xavi: warning: a road ends"] * told


@pytest.mark.parametrize(
    "arguments", [["--help"], ["parse", "Why did you change left?"], ["scenarios"]]
)
def test_what_does_not_plan_does_not_load_the_planner(arguments: list[str]) -> None:
    code = (
        "import sys\nfrom xavi_dialogue.__main__ import app\n"
        "try: app(sys.argv[1:])\nexcept SystemExit as end: assert not end.code\n"
        "print(*sys.modules, file=sys.stderr)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, *arguments], capture_output=True, text=True, check=True
    )
    assert done.stdout
    loaded = set(done.stderr.split())
    assert "xavi_dialogue.__main__" in loaded
    assert not loaded & {"numba", "scipy", "libsumo", "zenoh"}


def test_a_question_is_parsed() -> None:
    text = "Please, why did you change left?"
    meaning = json.loads(xavi("parse", text, "--json").stdout)
    assert (meaning["query"]["type"], meaning["query"]["factual"]) == ("why", ["change-left"])
    assert [act["is"] for act in meaning["acts"]] == ["Ask"]
    shares = json.loads(xavi("parse", text, "--json", "--explain").stdout)["readings"][0]["shares"]
    assert [share["share"] for share in shares][:2] == ["politeness", "meaning"]
    shown = xavi("parse", text, "--explain").stdout.splitlines()
    assert shown[0].split()[:2] == ["please", "politeness"]
    assert "no such vehicle      9" in xavi("parse", "Why did vehicle 9 brake?").stdout
    assert xavi("parse", "asdf qwer").exit_code == 4


def test_question_lines_are_parsed_line_by_line() -> None:
    lines = [
        {"id": "a", "text": "Why did you change left?"},
        {"id": "b", "text": "And vehicle 2?", "context": ["Why did vehicle 1 stop?"]},
        {"id": "c", "text": "asdf qwer"},
    ]
    done = xavi("parse", "--jsonl", stdin="\n".join(map(json.dumps, lines)))
    answers = [json.loads(line) for line in done.stdout.splitlines()]
    assert done.exit_code == 0
    assert [answer["id"] for answer in answers] == ["a", "b", "c"]
    assert answers[1]["query"]["actor"] == "vehicle:2"
    assert answers[2]["query"]["type"] == "ambiguous"
    assert xavi("parse", "--jsonl", stdin="Why?\n").exit_code == 2


@pytest.mark.slow
def test_a_ride_ends_with_its_figures() -> None:
    done = xavi("drive", "--scenario", "s1", "--seed", "0", "--json")
    assert done.exit_code == 0
    figures = json.loads(done.stdout)
    assert (figures["scenario"], figures["seed"]) == ("s1", 0)
    assert (figures["ended"], figures["goal_reached"], figures["collisions"]) == (
        "arrived",
        True,
        0,
    )
    assert figures["events"][-1]["kind"] == "arrived"
    assert figures["arrival_time"] == figures["events"][-1]["sim_time"]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "status", "reason"),
    [
        ("What are you doing?", 0, None),
        ("Hello!", 0, None),
        ("Why did you not fly?", 3, "not-an-action"),
        ("asdf qwer", 4, "not-understood"),
    ],
)
def test_one_question_is_answered(text: str, status: int, reason: str | None) -> None:
    done = xavi("ask", text, "--scenario", "s2", "--at", "1.0", "--json")
    reply = json.loads(done.stdout)
    assert list(reply) == KEYS
    assert (done.exit_code, reply["reason"]) == (status, reason)
    assert (reply["explanation"] is not None) == (text == "What are you doing?")
    assert reply["sim_time"] == 1.0
    assert xavi("ask", text, "--scenario", "s2", "--at", "1.0").stdout == reply["text"] + "\n"


def test_a_ride_is_saved_to_be_shown(tmp_path: Path) -> None:
    file = tmp_path / "mine.ride.jsonl.gz"
    saving = ("--save", str(tmp_path / "mine"))
    driven = xavi("drive", "--scenario", "s2", "--duration", "2", *saving)
    assert driven.exit_code == 0
    assert str(file) in driven.stderr.replace("\n", "")
    shown = xavi("trace", "show", str(file))
    assert shown.exit_code == 0
    assert "exit-right" in shown.stdout
    refused = xavi("drive", "--scenario", "s2", "--save", str(tmp_path / "nowhere" / "x.gz"))
    assert refused.exit_code == 2


def test_traces_are_checked_and_explained_without_a_car(tmp_path: Path) -> None:
    ride = "transcripts/rides/s1-0.ride.jsonl.gz"
    why = "Why did you change left?"
    assert xavi("explain", ride, why).stdout.startswith("I moved to the left lane, because")
    told = xavi("explain", ride, why, "--json", "--style", "paper")
    assert list(json.loads(told.stdout)) == KEYS
    checked = xavi("trace", "check", ride)
    assert checked.exit_code == 0
    assert checked.stdout.startswith("19 decisions of 'car', from 0 to 18 s, xavi.plan_trace/2\n")
    known = read(Path(ride).read_bytes()).traces[3]
    (tmp_path / "roadless.json").write_bytes(encode(replace_field(known, road=None)))
    checked = xavi("trace", "check", str(tmp_path / "roadless.json"), "--json")
    assert checked.exit_code == 1
    parts = [(one["part"], one["decisions"]) for one in json.loads(checked.stdout)]
    assert parts == [("road", 1), ("events", 1), ("under_way or road", 1)]
    what_if = "What if vehicle 1 had not been there?"
    declined = xavi("explain", str(tmp_path / "roadless.json"), what_if)
    assert declined.exit_code == 5
    assert "no roads of it are known here; --scenario names" in " ".join(declined.stderr.split())
    assert xavi("explain", ride, why, "--car", "car").exit_code == 0
    other = xavi("explain", ride, why, "--car", "other")
    assert (other.exit_code, "is a ride of 'car', not of 'other'" in other.stderr) == (2, True)


RIDE = Path(__file__).parents[2] / "transcripts" / "rides" / "s1-0.ride.jsonl.gz"


@pytest.mark.parametrize(
    ("data", "told"),
    [
        (b"{}", "not a plan trace"),
        (b"", "the file is empty"),
        (gzip.decompress(RIDE.read_bytes()).partition(b"\n")[0], "the ride holds no decision"),
        (gzip.decompress(RIDE.read_bytes())[:30] + b"\n", "not a recorded ride: line 1: "),
        (gzip.decompress(RIDE.read_bytes())[:-9], "not a recorded ride: line 38: "),
        (RIDE.read_bytes()[:500], "it is cut off; copy the file again"),
        (b"\x89MCAP0\r\n", "it is a recording, which `xavi explain` and `xavi report` read"),
    ],
)
def test_files_without_traces_are_named_with_how_to_mend_it(
    data: bytes, told: str, tmp_path: Path
) -> None:
    (tmp_path / "bad").write_bytes(data)
    for command in (("trace", "check"), ("trace", "show"), ("explain",)):
        asked = ("Why?",) if command == ("explain",) else ()
        failed = xavi(*command, str(tmp_path / "bad"), *asked)
        assert failed.exit_code == 2
        assert f"{tmp_path / 'bad'}: " in failed.stderr
        assert told in failed.stderr
        assert "; give " in failed.stderr


def test_a_warning_is_told_in_a_line(tmp_path: Path) -> None:
    path = tmp_path / "cut.mcap"
    recorded_in(path, ride_moments(ride_file.load(RIDE.read_bytes())))
    path.write_bytes(path.read_bytes()[:-30])
    done = subprocess.run(
        [sys.executable, "-m", "xavi_dialogue", "explain", str(path), "What are you doing?"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0
    [line] = done.stderr.splitlines()
    assert line.startswith(f"xavi: warning: {path}: it was cut off")


def test_notes_at_a_terminal_break_at_spaces_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    note = "this conversation is 20261121-164210-3f9c: --session 20261121-164210-3f9c goes on"
    for width in ("50", "60"):
        monkeypatch.setenv("COLUMNS", width)
        monkeypatch.setattr("sys.stderr", terminal := Terminal())
        _note(note)
        lines = terminal.getvalue().splitlines()
        assert max(map(len, lines)) <= int(width)
        assert [word for line in lines for word in line.split()] == ["xavi:", *note.split()]


def test_wishes_for_the_ego_need_a_configuration() -> None:
    for options in (("--ego", "x"), ("--scenario", "s1", "--ego-from", "a", "--ego-to", "b")):
        done = xavi("ask", "Why?", *options)
        assert done.exit_code == 2
        assert "go with --scenario FILE.sumocfg" in done.stderr


def test_a_configuration_without_an_ego_lists_who_departs(tmp_path: Path) -> None:
    file = configured(tmp_path)
    done = xavi("drive", "--scenario", str(file))
    assert done.exit_code == 2
    assert "the first cars that depart: other" in done.stderr


def test_a_folder_is_written_about_a_configuration(tmp_path: Path) -> None:
    file, folder = configured(tmp_path), tmp_path / "mine"
    done = xavi("scenario", "new", str(file), str(folder), "--ego", "late")
    assert done.exit_code == 0
    assert done.stdout.strip() == str(folder / "scenario.toml")
    assert 'ego = "late"' in (folder / "scenario.toml").read_text()
    assert xavi("scenario", "new", str(file), str(folder), "--ego", "late").exit_code == 2


def test_a_car_drives_in_a_configuration(tmp_path: Path) -> None:
    ego = ("--ego-from", "top0A0", "--ego-to", "A0left0", "--begin", "60")
    done = xavi("drive", "--scenario", str(configured(tmp_path)), *ego, "--duration", "2", "--json")
    assert done.exit_code == 0
    summary = json.loads(done.stdout)
    assert (summary["scenario"], summary["ended"], summary["decisions"]) == ("cross", "duration", 2)
