"""One ride of `xavi bench foreign`, by SUMO's own driver and by our planner with the same seed."""

import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import msgspec

from benchmarks.drive.monitor import Drive
from benchmarks.drive.runs import Decided, by_planner, by_sumo, warm
from benchmarks.foreign.conduct import Conduct, Conducting
from benchmarks.foreign.rides import Chosen, NoRide, ride
from benchmarks.foreign.sites import Site
from sim.roads.network import Network
from sim.setup.scenario import Scenario, load
from sim.sumo import Simulation
from xavi_dialogue.vehicle.episode import network_of

LONGEST = 240.0  # [s] greatest duration of a ride
PATIENCE = (2.0, 90.0)  # limit of our time: factor on that of SUMO's driver, and [s] added


class Task(msgspec.Struct, frozen=True):
    """A ride to be driven."""

    site: Site
    seed: int
    keep: str | None  # folder for traffic that is made up; None: it is not kept


class Driven(msgspec.Struct, frozen=True):
    """The results of one driver."""

    drive: Drive
    conduct: Conduct


class Ridden(msgspec.Struct, frozen=True):
    """The results of a ride."""

    site: str
    seed: int
    place: str | None = None  # to load it from; None: there is no ride
    refused: tuple[str, ...] = ()  # reasons why configurations were skipped
    ours: Driven | None = None
    sumo: Driven | None = None
    error: str | None = None  # of a ride that failed
    decisions: tuple[Decided, ...] = ()
    start_up: float | None = None  # [s] from loading the place to the first scene

    @property
    def reproduce(self) -> str:
        """The command that repeats the ride."""
        if self.place is None:
            return ""
        file, _, wishes = self.place.partition("?")
        return f"xavi drive --scenario '{file}?{wishes}' --seed {self.seed}"


def rode(task: Task) -> Ridden:
    """Choose a ride and drive it; errors are part of the result."""
    name, seed = task.site.name, task.seed
    with _folder(task) as folder:
        try:
            chosen = ride(task.site, seed, folder)
        except NoRide as error:
            return Ridden(name, seed, error=str(error))
        except Exception as error:
            return Ridden(name, seed, error=f"{type(error).__name__}: {error}")
        found = Ridden(name, seed, chosen.place, chosen.refused)
        try:
            return _driven(found, chosen)
        except Exception as error:
            return msgspec.structs.replace(found, error=f"{type(error).__name__}: {error}")


@contextmanager
def _folder(task: Task) -> Iterator[Path]:
    """Yield the folder for traffic that is made up."""
    part = Path(task.site.name) / str(task.seed)
    if task.keep is not None:
        yield Path(task.keep) / part
        return
    with tempfile.TemporaryDirectory() as scratch:
        yield Path(scratch) / part


def _driven(found: Ridden, chosen: Chosen) -> Ridden:
    warm()
    began = time.perf_counter()
    scenario = replace(load(chosen.place, found.seed), duration=LONGEST)
    network = network_of(scenario)
    with Simulation(scenario) as world:
        start_up = time.perf_counter() - began
        sumo = _by_sumo(world, scenario, network)
    if sumo.drive.ended == "arrived":
        longest = min(LONGEST, PATIENCE[0] * sumo.drive.time + PATIENCE[1])
        scenario = replace(scenario, duration=longest)
    with Simulation(scenario) as world:
        ours, decisions = _by_planner(world, scenario, network)
    return msgspec.structs.replace(
        found, ours=ours, sumo=sumo, decisions=decisions, start_up=round(start_up, 3)
    )


def _by_sumo(world: Simulation, scenario: Scenario, network: Network) -> Driven:
    conducting = Conducting(network, scenario.step)
    drive = by_sumo(world, scenario, network, conducting.see)
    return Driven(drive, conducting.conduct())


def _by_planner(
    world: Simulation, scenario: Scenario, network: Network
) -> tuple[Driven, tuple[Decided, ...]]:
    conducting = Conducting(network, scenario.step)
    drive, decisions = by_planner(world, scenario, network, conducting.see)
    return Driven(drive, conducting.conduct()), decisions
