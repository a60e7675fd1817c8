"""Worlds by number: roads, story and bystanders are determined by the seed."""

from collections.abc import Callable, Mapping
from random import Random

from benchmarks.worlds import plots, reactions, roads, stories
from benchmarks.worlds.bystanders import MOST, bystanders
from benchmarks.worlds.values import KINDS, Family, Kind, Sketch, World

STORIES: Mapping[Kind, Callable[[Random], Sketch]] = {
    "one": stories.one,
    "both": plots.both,
    "either": plots.either,
    "pre-empted": plots.pre_empted,
    "distractor": plots.distractor,
    "none": plots.nobody,
    "interactive": reactions.interactive,
}


def kind_of(seed: int) -> Kind:
    """Return the kind of a world; kinds alternate with the seed."""
    return KINDS[seed % len(KINDS)]


def draw(seed: int, attempt: int, family: Family = "straight") -> World:
    """Draw a world whose kind is not confirmed yet; the same numbers give the same world."""
    kind = kind_of(seed)
    chance = Random(f"{kind}/{seed}/{attempt}")
    sketch = STORIES[kind](chance)
    rest = bystanders(chance, sketch)
    names = chance.sample(range(1, MOST + 4), len(sketch.cast) + len(rest))
    others = dict(sorted(zip(names, [*sketch.cast, *rest], strict=True)))
    planted, idle = names[: len(sketch.planted)], names[len(sketch.planted) : len(sketch.cast)]
    net = roads.bent(chance, sketch.roads) if family == "bent" else sketch.roads
    return World(kind, seed, net, sketch.ego, others, tuple(planted), tuple(idle))
