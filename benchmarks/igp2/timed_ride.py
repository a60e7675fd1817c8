"""Decisions of IGP2 in a ride of its own, with the time that each took.

This runs as a script, in an environment with what IGP2 requires; it needs no package of ours:

    python timed_ride.py EXAMPLES CHECKOUT SCENARIO SEED DECISIONS

EXAMPLES is the folder with `igp2_traces.py`, which runs the scenario. Each decision is written as
one line of JSON after the mark `DECISION `: `trace` (a plan trace), `recognition` (processor time
[s] for each other vehicle), `search` (processor time [s]) and `goal` (the place [m, m] where the
ego is to go). IGP2 prints lines of its own between them.
"""

import importlib
import itertools
import json
import logging
import os
import sys
import time
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

MARK = "DECISION "


def timed(function: Callable[..., Any], taken: list[float]) -> Callable[..., Any]:
    """Return a function that adds the processor time [s] of each call to a list."""

    def call(*arguments: Any, **named: Any) -> Any:
        began = time.process_time()
        try:
            return function(*arguments, **named)
        finally:
            taken.append(time.process_time() - began)

    return call


def main() -> None:
    """Run a scenario, and write its first decisions."""
    examples, checkout, scenario, seed, decisions = sys.argv[1:]
    folder = Path(checkout).resolve()
    sys.path[:0] = [examples, str(folder), str(folder / "scripts")]
    logging.disable(logging.WARNING)
    warnings.simplefilter("ignore")
    os.chdir(folder)
    traces = importlib.import_module("igp2_traces")
    planner = importlib.import_module("igp2.planning.mcts").MCTS
    recogniser = importlib.import_module("igp2.recognition.goalrecognition").GoalRecognition
    recognition: list[float] = []
    search: list[float] = []
    planner.search = timed(planner.search, search)
    known = recogniser.update_goals_probabilities
    recogniser.update_goals_probabilities = timed(known, recognition)
    config = json.loads((folder / "scenarios" / "configs" / f"{scenario}.json").read_text())
    agents = [one for one in config["agents"] if one["type"] == "MCTSAgent"]
    ride = traces.run(folder, scenario, int(seed), None)
    for trace in itertools.islice(ride, int(decisions)):
        found = {
            "trace": trace,
            "recognition": list(recognition),
            "search": search[-1],
            "goal": agents[0]["goal"]["box"]["center"],
        }
        recognition.clear()
        sys.stdout.write(f"{MARK}{json.dumps(found)}\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
