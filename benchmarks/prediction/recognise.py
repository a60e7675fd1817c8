"""`xavi bench recognise`: how well we predict which roads others take, and where they will be.

Every vehicle's approach to a choice of roads (see `approach`) is observed. Once a second the
prediction is made from the track that the car has seen, up to ten seconds. The scenarios of the
package were used while recognition was developed (development); random networks by number were
not (held out).
"""

import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

import msgspec

from benchmarks.drive.runs import in_processes
from benchmarks.prediction.approach import approaches
from benchmarks.prediction.constants import Varied, vary
from benchmarks.prediction.foretold import Foretold, foretold
from benchmarks.prediction.ride_scenes import Recording, record, record_by_sumo
from benchmarks.prediction.stories import Story, tell
from benchmarks.worlds.generated import family_of, write
from sim.setup.scenario import load

SCENARIOS = ("s1", "s2", "s3", "s4", "motorway", "town")


class Task(msgspec.Struct, frozen=True):
    """One ride to observe."""

    scenario: str | None  # name or folder; None: a network made by the number that is the seed
    seed: int
    constants: bool = False  # whether to change each constant

    @property
    def name(self) -> str:
        """The name of the ride's scenario or network."""
        return f"network {self.seed}" if self.scenario is None else self.scenario


class Watched(msgspec.Struct, frozen=True):
    """The observations of one ride."""

    task: Task
    moments: tuple[Foretold, ...] = ()
    varied: tuple[Varied, ...] = ()
    story: Story | None = None
    error: str | None = None


def tasks(
    scenarios: Sequence[str], seeds: int, networks: int, first: int, constants: int
) -> list[Task]:
    """Return the rides: scenarios with seeds from 0 on, and networks by number from `first` on.

    In the first `constants` networks the constants are changed.
    """
    found = [Task(name, seed) for name in scenarios for seed in range(seeds)]
    return found + [Task(None, first + k, k < constants) for k in range(networks)]


def measure(asked: Sequence[Task], jobs: int, note: Callable[[str], None]) -> list[Watched]:
    """Observe the others of rides.

    Args:
        asked: the rides.
        jobs: number of parallel processes.
        note: is called with notes on progress.
    """
    found: list[Watched] = []
    for one in in_processes(watch, asked, jobs, lambda t: Watched(t, error="its process died")):
        found.append(one)
        note(f"{len(found)} of {len(asked)}: {one.task.name}, seed {one.task.seed}")
    return found


def watch(task: Task) -> Watched:
    """Drive a ride and observe the others; errors are part of the result.

    Our planner drives the ego of a scenario, since the stories depend on it; SUMO drives that of a
    network.
    """
    try:
        if task.scenario is not None:
            return _watched(task, record(load(task.scenario, task.seed)), task.scenario)
        with tempfile.TemporaryDirectory() as folder:
            scenario = write(task.seed, Path(folder))
            recording = record_by_sumo(scenario)
        return _watched(task, recording, family_of(task.seed))
    except Exception as error:
        return Watched(task, error=f"{type(error).__name__}: {error}")


def _watched(task: Task, recording: Recording, family: str) -> Watched:
    found = approaches(recording.roads, recording.scenes, recording.settings.view_radius)
    network = f"{task.name}/{task.seed}"
    return Watched(
        task=task,
        moments=tuple(
            moment
            for approach in found
            for moment in foretold(recording, approach, network, family)
        ),
        varied=vary(recording, found) if task.constants else (),
        story=tell(task.scenario or "", task.seed, recording),
    )
