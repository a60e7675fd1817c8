"""Worlds by number: drawn from a seed until SUMO confirms that one vehicle alone matters."""

import shutil
from dataclasses import dataclass
from pathlib import Path
from random import Random

from sim.scenario import Scenario
from xavi_dialogue.app.bench.worlds.bystanders import MOST, bystanders
from xavi_dialogue.app.bench.worlds.folder import write
from xavi_dialogue.app.bench.worlds.stories import STORIES
from xavi_dialogue.app.bench.worlds.values import KINDS, Kind, World
from xavi_dialogue.app.bench.worlds.verify import Check, verify

TRIES = 60


class NoWorld(Exception):
    """None of the worlds that were drawn is confirmed by SUMO."""


@dataclass(frozen=True, slots=True)
class Planted:
    """A world with its planted cause, confirmed."""

    world: World
    scenario: Scenario
    check: Check
    rejected: int  # worlds drawn before that SUMO did not confirm


def kind_of(seed: int) -> Kind:
    """The kind of a world: they take turns."""
    return KINDS[seed % len(KINDS)]


def draw(seed: int, attempt: int) -> World:
    """A world that is not confirmed yet; the same numbers give the same world."""
    kind = kind_of(seed)
    chance = Random(f"{kind}/{seed}/{attempt}")
    sketch = STORIES[kind](chance)
    tall = [sketch.occluder] if sketch.occluder is not None else []
    rest = bystanders(chance, sketch)
    names = chance.sample(range(1, MOST + 2), 1 + len(tall) + len(rest))
    others = dict(sorted(zip(names, [sketch.planted, *tall, *rest], strict=True)))
    occluder = names[1] if tall else None
    return World(kind, seed, sketch.roads, sketch.ego, others, names[0], occluder)


def generate(seed: int, folder: Path) -> Planted:
    """The world of a seed, written to a folder.

    Raises:
        NoWorld: none of many that were drawn is confirmed.
        NetconvertError: netconvert is not installed.
        SimulationError: SUMO is not installed or fails.
    """
    for attempt in range(TRIES):
        shutil.rmtree(folder, ignore_errors=True)
        world = draw(seed, attempt)
        scenario = write(world, folder)
        check = verify(world, scenario)
        if check is not None:
            return Planted(world, scenario, check, attempt)
    raise NoWorld(f"none of {TRIES} worlds drawn for seed {seed} is confirmed by SUMO")
