"""Several search trees for one decision, grown apart and joined (root parallelisation).

See Chaslot et al. 2008, "Parallel Monte-Carlo Tree Search". The number of trees is a setting, not
the number of cores at hand, so the same seed gives the same decision on every machine.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import msgspec

from planner.motion.obstacles import NOBODY
from planner.record.trace import Action, Settings
from planner.rollouts.rollout import Leg
from planner.search.simulated import Simulated
from planner.search.tree import Node


@dataclass(frozen=True, slots=True, eq=False)
class GrownTree:
    """One tree, as the rollouts that it learnt from, and why actions did not apply in them."""

    rollouts: tuple[Simulated, ...]  # whose legs are without traffic
    refusals: Mapping[tuple[Node, Action], str]


def trees_of(settings: Settings) -> int:
    """Return the number of trees of a search."""
    return 1 if settings.trees is msgspec.UNSET else settings.trees


def share(rollouts: int, trees: int, tree: int) -> int:
    """Return the number of rollouts of one of several trees."""
    return rollouts // trees + (tree < rollouts % trees)


def detached(
    rollouts: Sequence[Simulated], refusals: Mapping[tuple[Node, Action], str]
) -> GrownTree:
    """Return a tree to be joined with another one, without the others' motions: they are large."""
    legs: dict[int, Leg] = {}  # by identity, as rollouts share them
    for one in rollouts:
        for leg in one.legs:
            if id(leg) not in legs:
                legs[id(leg)] = replace(leg, traffic=NOBODY)
    alone = (replace(one, legs=tuple(legs[id(leg)] for leg in one.legs)) for one in rollouts)
    return GrownTree(tuple(alone), refusals)
