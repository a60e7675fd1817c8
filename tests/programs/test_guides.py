"""Every command line of the documents is run, and the site shows all pages and all public names."""

import importlib.util
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pyarrow.parquet as pq
import pytest

import xavi_dialogue as xavi
from tests.test_repository import targets

ROOT = Path(__file__).parents[2]
GUIDES = sorted((ROOT / "docs" / "guides").glob("*.md"))
OTHERS = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
PATIENCE = 300.0  # [s] before a test gives up on what never ends
#: Why some are not run here. The targets of make are looked up.
ELSEWHERE = {
    "git clone": "the repository itself",
    "printf": "talks through a pipe; test_chat_processes.py does",
    "xavi chat": "talks; test_chat_processes.py does",
    "xavi forget": "erases what the commands before kept; tests/storage/test_turn_log.py forgets",
    "xavi serve": "never ends; test_client_example.py and test_connection.py start it",
    "xavi drive --connect": "needs the service; the same tests start it",
    "xavi drive --zenoh": "needs keys and the service; tests/drills drive so",
    "xavi ask --zenoh": "needs keys and the service; tests/drills ask so",
    "xavi ask --connect": "needs the service; tests/drills ask there",
    "xavi doctor --connect": "needs the service; tests/drills ask for a diagnosis there",
    "xavi doctor --zenoh": "needs keys and the service; tests/cli/test_doctor.py diagnoses",
    "xavi keys ~": "writes to the home folder; the guide for operators has one that is run",
    "zenohd": "a router of Zenoh itself; tests/drills/test_router_keys.py runs routers",
    "xavi record": "needs the service; tests/drills/test_recordings.py records there",
    "xavi replay": "talks; tests/drills/test_recordings.py replays",
    "xavi audit --dask": "needs a cluster; test_audit_processes.py starts one",
    "dask": "never ends; test_audit_processes.py starts both",
    ".venv/bin/python -m tests.simulated": "tests/simulated runs seeds",
    "python examples/igp2_traces.py": "needs a checkout of IGP2, which is not a dependency",
    "xavi trace check igp2.jsonl": "a file of the command before; guides check another",
    "xavi explain igp2.jsonl": "likewise",
}
#: Exit statuses other than 0 that a command is shown for.
STATUSES = {"xavi trace check": {0, 1}, "xavi doctor": {0, 1}}
#: What is run instead, to the same effect in less time.
SHORTER = {
    "--seeds 0-9": "--seeds 0",
    # tests/audit/test_report.py writes reports, and test_audit_processes.py has several processes
    "xavi audit": "xavi audit --reports 0 --jobs 1",
    ".venv/bin/xavi": "xavi",
}
RIDES = ("s1-0", "s2-2")  # saved rides that are there, beside those that a page names


def commands(page: Path) -> list[str]:
    """The command lines of a page, in order."""
    blocks = re.findall(r"^```sh\n(.*?)^```", page.read_text(encoding="utf-8"), re.M | re.S)
    return [line.strip() for block in blocks for line in block.splitlines() if line.strip()]


def reason(command: str) -> str | None:
    """Why a command is not run here; None if it is."""
    words = command.split()
    for known in ELSEWHERE:
        begins, _, option = known.partition(" --")
        if command.startswith(begins) and (not option or f"--{option}" in words):
            return ELSEWHERE[known]
    return None


def run(command: str, folder: Path) -> None:
    """Run a command line of a page in a folder; it has to end as it should."""
    for shown, instead in SHORTER.items():
        command = command.replace(shown, instead)
    program, *arguments = shlex.split(command, comments=True)
    assert program == "xavi", command
    done = subprocess.run(
        [sys.executable, "-m", "xavi_dialogue", *arguments],
        cwd=folder,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    allowed = next((s for begins, s in STATUSES.items() if command.startswith(begins)), {0})
    assert done.returncode in allowed, f"{command}\n{done.stdout}\n{done.stderr}"
    assert done.stdout or done.stderr or "drive" in arguments, command


Run = Callable[[Path], tuple[Path, int]]


@pytest.fixture(scope="module")
def run_all(tmp_path_factory: pytest.TempPathFactory) -> Run:
    """Runs the command lines of a page, once; gives the folder with the results, and how many."""

    @cache
    def ran(page: Path) -> tuple[Path, int]:
        return run_page(page, tmp_path_factory.mktemp(page.stem))

    return ran


def run_page(page: Path, folder: Path) -> tuple[Path, int]:
    """One after the other in one folder, so that files that one writes are there for the next."""
    here = folder / "transcripts" / "rides"
    here.mkdir(parents=True)
    for ride in (ROOT / "transcripts" / "rides").iterdir():
        name = ride.name.partition(".")[0]
        if name in RIDES or ride.name in page.read_text(encoding="utf-8"):
            shutil.copy(ride, here)
    (folder / "questions.txt").write_text("Why did you brake? @ braking\n", encoding="utf-8")
    ran = 0
    for command in commands(page):
        if command.startswith("make "):
            target = next(word for word in command.split()[1:] if not word.startswith("-"))
            assert target in targets(ROOT), command
        elif reason(command) is None:
            run(command, folder)
            ran += 1
    return folder, ran


@pytest.mark.slow
@pytest.mark.parametrize("page", [*GUIDES, *OTHERS], ids=lambda page: page.stem)
def test_the_command_lines_of_a_page_run(page: Path, run_all: Run) -> None:
    _, ran = run_all(page)
    assert ran >= 2 or page not in GUIDES


@pytest.mark.slow
def test_the_question_to_many_rides_is_asked_and_answered(run_all: Run) -> None:
    folder, _ = run_all(ROOT / "docs" / "guides" / "researchers.md")
    (answer,) = pq.read_table(folder / "audits" / "answers.parquet").to_pylist()
    assert answer["kind"] == "answer"


@cache
def help_of(name: str) -> str:
    """What a command says of its options."""
    return subprocess.run(
        [sys.executable, "-m", "xavi_dialogue", name, "--help"],
        capture_output=True,
        text=True,
        check=True,
    ).stdout


@pytest.mark.parametrize("page", [*GUIDES, *OTHERS], ids=lambda page: page.stem)
def test_options_of_commands_that_are_not_run_exist(page: Path) -> None:
    for command in filter(reason, commands(page)):
        program, name, *arguments = shlex.split(command, comments=True)
        if program != "xavi":
            continue
        for option in (one for one in arguments if one.startswith("--")):
            assert re.search(rf"(?<!\S){option}\b", help_of(name)), command


def test_every_page_is_in_the_site() -> None:
    index = ROOT / "docs" / "index.md"
    listed = set()
    for block in re.findall(r"^```\{toctree\}\n(.*?)^```", index.read_text(), re.M | re.S):
        names = [line for line in block.splitlines() if line and not line.startswith(":")]
        listed |= {(index.parent / name).resolve() for name in names}
    pages = {*(ROOT / "docs").glob("*.md"), *GUIDES, *(ROOT / "examples").glob("*.ipynb")} - {index}
    assert {page.with_suffix("") for page in pages} <= listed
    for page in listed:
        assert any(page.with_suffix(ending).exists() for ending in (".md", ".ipynb")), page


def test_the_reference_has_every_public_name() -> None:
    page = (ROOT / "docs" / "reference.md").read_text(encoding="utf-8")
    named = re.findall(r"^\.\. auto\w+:: (\w+)$", page, re.M)
    assert sorted(named) == sorted(set(xavi.__all__) - {"__version__"})
    assert all(getattr(xavi, name).__doc__ for name in named)


def test_the_reference_describes_every_field_with_its_unit() -> None:
    path = ROOT / "docs" / "site" / "fields.py"
    spec = importlib.util.spec_from_file_location("site_fields", path)
    assert spec is not None
    assert spec.loader is not None
    shown = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(shown)
    values = [getattr(xavi, name) for name in xavi.__all__ if name[0].isupper()]
    known = {value.__name__: shown.fields(value) for value in values}
    assert {name for name, fields in known.items() if fields} >= {
        "Answer", "Belief", "Curves", "Decision", "Event", "Evidence", "Option", "Picture",
        "Report", "Ride", "Scene", "Trajectory",
    }  # fmt: skip
    for name, fields in known.items():
        for field, kind, comment in fields:
            assert comment, f"{name}.{field}"
            if kind in ("float", "float | None") and field not in ("probability", "collision"):
                assert re.search(r"\[(s|m|m/s)\]", comment), f"{name}.{field}: {comment}"
    assert "Fields" in "".join(shown.described(xavi.Answer))
