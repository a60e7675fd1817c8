"""`xavi bench causes`: whether answers name the vehicles without which the action vanishes in SUMO.

Our planner drives in each world. The question is about the most marked action (see
`deed_question`). Causes are found by driving the same world again without vehicles (see
`removal`). A world counts only if the action vanishes and stays as the kind of world demands;
otherwise the next one is drawn. The answer is scored by the vehicles that it names, as are two
simple rivals.
"""

import shutil
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import msgspec

from benchmarks.causes.cause_scores import OURS, Case, CausesReport, report
from benchmarks.causes.deed_question import (
    Question,
    Ridden,
    ask,
    decision_of,
    question,
    ride,
    slowing,
)
from benchmarks.causes.naming import RIVALS, kind_told, named_by
from benchmarks.causes.removal import Deeds, agrees
from benchmarks.drive.runs import in_processes
from benchmarks.worlds.folder import without, write
from benchmarks.worlds.generate import draw, kind_of
from benchmarks.worlds.values import Family, Kind, World
from sim.roads.network import Network
from sim.setup.scenario import Scenario
from xavi_dialogue.dialogue.standing import reason_of
from xavi_dialogue.service.in_process import planner_for
from xavi_dialogue.vehicle.episode import network_of

EVERY = 5  # worlds between notes on progress
LATELY = 4.0  # [s] before the action, within which causes must have been seen
TRIES = 25  # greatest number of worlds drawn for one seed

#: Whether the action vanishes without vehicles of the story; see `removal.agrees` for their order.
EXPECTED: dict[Kind, tuple[bool, ...]] = {
    "one": (True,),
    "both": (True, True, True),
    "either": (False, False, True),
    "pre-empted": (False, False, True),
    "distractor": (False, True),
    "none": (False, False),
    "interactive": (True, True, True),
}

Task = tuple[int, Family, str | None]


class NoWorld(Exception):
    """No world that was drawn is of its kind."""


def measure(
    worlds: int,
    seed: int,
    family: Family,
    jobs: int,
    keep: Path | None,
    note: Callable[[str], None],
) -> CausesReport:
    """Drive worlds and ask about them.

    Args:
        worlds: number of worlds; the k-th has the seed `seed + k`.
        seed: of the first.
        family: of roads.
        jobs: number of parallel processes.
        keep: folder in which the scenario folders are left; None: they are not kept.
        note: is called with notes on progress.
    """
    folder = None if keep is None else str(keep)
    tasks: list[Task] = [(seed + k, family, folder) for k in range(worlds)]
    done: list[Case] = []
    for case in in_processes(examine, tasks, jobs, _died):
        done.append(case)
        if len(done) % EVERY == 0:
            note(f"{len(done)} of {worlds} worlds")
    return report(done)


def examine(task: Task) -> Case:
    """Examine one world by its seed; errors are part of the result."""
    seed, family, keep = task
    scratch = Path(tempfile.mkdtemp(prefix="xavi-world-"))
    folder = scratch / "world" if keep is None else Path(keep) / f"{kind_of(seed)}-{seed}"
    try:
        for attempt in range(TRIES):
            shutil.rmtree(folder, ignore_errors=True)
            world = draw(seed, attempt, family)
            found = _examined(world, family, write(world, folder))
            if found is not None:
                return msgspec.structs.replace(found, rejected=attempt)
        raise NoWorld(f"none of {TRIES} worlds drawn is confirmed by SUMO")
    except Exception as error:
        return Case(seed, kind_of(seed), family, error=f"{type(error).__name__}: {error}")
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


def _examined(world: World, family: Family, scenario: Scenario) -> Case | None:
    """Return the case of a world; None if the world is not of its kind."""
    network = network_of(scenario)
    whole = ride(scenario, network)
    alone = ride(without(world, scenario, world.others), network)
    asked = slowing(whole, alone) if world.kind == "none" else question(whole, alone)
    if asked is None or asked.deed == "continue":
        return None
    deeds = Deeds(
        asked,
        whole,
        alone,
        frozenset(world.others),
        lambda gone: ride(without(world, scenario, gone), network),
    )
    if not (_are_seen(world, whole, asked) and _is_of_its_kind(world, deeds)):
        return None
    return _answered(world, family, network, whole, deeds)


def _are_seen(world: World, whole: Ridden, asked: Question) -> bool:
    """Check whether a decision shortly before the action shows all planted vehicles."""
    near = [t for t in whole.traces if asked.moment - LATELY <= t.sim_time <= asked.moment]
    return any(all(one in trace.scene for one in world.planted) for trace in near)


def _is_of_its_kind(world: World, deeds: Deeds) -> bool:
    """Check whether the action depends on the vehicles that the story intends."""
    alone = world.kind == "interactive" and len(world.planted) == 1
    kind: Kind = "one" if alone else world.kind
    besides = len(world.idle) if kind == "one" else 0
    expected = (False,) * besides + EXPECTED[kind]
    return agrees(deeds, world.planted, world.idle, expected)


def _answered(world: World, family: Family, network: Network, whole: Ridden, deeds: Deeds) -> Case:
    """Ask the question, and return the case with the claims of our answer and of the rivals."""
    asked = deeds.asked
    began = time.perf_counter()
    found, extra = ask(asked, whole, planner_for(network))
    took = 1000.0 * (time.perf_counter() - began)
    trace = decision_of(whole, found, asked.now)
    ours = named_by(found)
    claims = {OURS: ours, **{name: rival(trace) for name, rival in RIVALS.items()}}
    return Case(
        world.seed,
        world.kind,
        family,
        causes=tuple(sorted(world.planted)),
        others=len(world.others) - len(world.planted),
        asked=asked.deed,
        at=round(asked.now, 3),
        claims=claims,
        holds={name: deeds.holds(claim) for name, claim in claims.items()},
        told=kind_told(found),
        refused=reason_of(found),
        seen=all(vehicle in trace.scene for vehicle in world.planted),
        replans=len(extra),
        took=round(took, 1),
    )


def _died(task: Task) -> Case:
    return Case(task[0], kind_of(task[0]), task[1], error="its process died")
