"""Costs of whole processes: the time to start, and memory over hours of driving."""

import os
import subprocess
import sys
import time
from multiprocessing import get_context
from pathlib import Path

import msgspec

from sim.setup.scenario import load
from xavi_dialogue.vehicle.episode import network_of, start

STARTS = 3
ROADS = ("motorway", "town")  # scenarios that are driven in turn
HOUR = 3600.0  # [s]
MEGABYTE = 1024.0 * 1024.0
FIRST = ("-m", "xavi_dialogue", "drive", "--scenario", "s1", "--seed", "0", "--duration", "0.1")


class Memory(msgspec.Struct, frozen=True):
    """The memory of a process after some driving."""

    hours: float  # [h] of simulated driving so far
    decisions: int  # so far
    resident: float  # [MB]


def start_up() -> list[float]:
    """Return times [ms] of a fresh process, from its start to its end after one decision."""
    taken = []
    for _ in range(STARTS):
        began = time.perf_counter()
        subprocess.run((sys.executable, *FIRST), check=True, capture_output=True)
        taken.append(1000.0 * (time.perf_counter() - began))
    return taken


def memory(hours: float) -> tuple[Memory, ...]:
    """Drive in a separate process for some simulated hours; return its memory after each ride."""
    with get_context("spawn").Pool(1) as pool:
        return pool.apply(rides, (hours, ROADS))


def rides(hours: float, scenarios: tuple[str, ...]) -> tuple[Memory, ...]:
    """Drive scenarios in turn, with a new seed each time, in this process."""
    found: list[Memory] = []
    driven, decisions, seed = 0.0, 0, 0
    while driven < hours * HOUR:
        scenario = load(scenarios[seed % len(scenarios)], seed)
        with start(scenario, network_of(scenario)) as ride:
            before = driven
            for moment in ride:
                decisions += moment.trace is not None
                driven = before + moment.scene.time
                if driven >= hours * HOUR:
                    break
        seed += 1
        found.append(Memory(round(driven / HOUR, 4), decisions, round(resident(), 1)))
    return tuple(found)


def resident() -> float:
    """Return the memory [MB] of this process now."""
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / MEGABYTE
