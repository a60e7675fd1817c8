"""Seeds of the simulated world, in which all must hold."""

import gc
import subprocess
import sys

import pytest

from tests.simulated.plan import plan_of
from tests.simulated.world import run

SEEDS = 200
GROUP = 20  # seeds of one test


@pytest.mark.parametrize("begin", range(0, SEEDS, GROUP))
def test_what_must_hold_holds_whatever_goes_wrong(begin: int) -> None:
    failed = {}
    for seed in range(begin, begin + GROUP):
        outcome = run(plan_of(seed))
        if outcome.problems:
            failed[seed] = outcome.problems
    gc.collect()  # what complains as it is collected does so here, and not in another test
    assert failed == {}, "python -m tests.simulated --seed N shows and shrinks one"


def test_many_seeds_run_in_processes_of_their_own() -> None:
    command = (sys.executable, "-m", "tests.simulated", "--seeds", "2", "--jobs", "2")
    ended = subprocess.run(command, capture_output=True, check=True, text=True)
    assert ended.stdout.startswith("2 seeds in ")
    assert ": 0 failed;" in ended.stdout
