"""Plant one-line faults, and count those that a fast test notices."""

import argparse
import json
import random
import tempfile
from dataclasses import asdict
from pathlib import Path

import pytest

from tests.mutants import report, rooms
from tests.mutants.faults import drawn, every
from tests.mutants.plugin import Planter, Trial, note


def main() -> int:
    """Run the command; 0 where enough faults are noticed."""
    asked = _parser().parse_args()
    faults = [f for f in drawn(every(), asked.count, asked.seed) if asked.only in f.name]
    random.Random(asked.seed).shuffle(faults)  # so that any part of the run stands for the whole
    planter = Planter(faults, asked.reach)
    planter.start()
    with tempfile.TemporaryDirectory() as folder:
        options = ["-q", "-p", "no:cacheprovider", "--basetemp", f"{folder}/tests"]
        ignored = [f"--ignore={path}" for path in rooms.GOLDEN]
        status = pytest.main([*options, "-m", "not slow", *ignored, *rooms.TESTS], [planter])
    if status != 0 or planter.reach.failed:
        note(f"with nothing planted the tests fail: {' '.join(planter.reach.failed)}")
        return 2
    if asked.json:
        asked.json.write_text(_as_json(planter.trials), encoding="utf-8")
    page = report.PAGE.read_text(encoding="utf-8") if report.PAGE.is_file() else ""
    note("\n".join(report.survivors(planter.trials, report.reasons(page))))
    note("\n".join(report.table(planter.trials)))
    return 0 if report.share(planter.trials) >= report.ENOUGH else 1


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m tests.mutants", description=__doc__)
    add = parser.add_argument
    add("--seed", type=int, default=0, help="of the faults that are drawn")
    add("--count", type=int, default=320, help="how many are planted")
    add("--only", default="", help="of these, those whose name has this text")
    add("--json", type=Path, metavar="FILE", help="write there what came of each")
    add(
        "--reach",
        type=Path,
        metavar="FILE",
        help="keep there what the tests run; good as long as the code stays as it is",
    )
    return parser


def _as_json(trials: list[Trial]) -> str:
    told = [
        asdict(trial.fault) | {"by": trial.by, "tried": trial.tried, "seconds": trial.seconds}
        for trial in trials
    ]
    return json.dumps(told, indent=1, ensure_ascii=False)
