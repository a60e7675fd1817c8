"""The test of whether an action vanishes when our planner drives a world without vehicles.

Driving slowly is compared place by place with driving alone. The question is about some place; the
action vanishes if only a small share of the speed lost there is still lost, and stays if most of
it is. Anything between is neither, and such a world is drawn again.
"""

from collections.abc import Callable, Collection
from dataclasses import dataclass, field

import numpy as np

from benchmarks.causes.deed_question import Question, Ridden

BEFORE, BEYOND, GRID = 25.0, 60.0, 2.0  # [m] of road before and beyond the place, and steps
VANISHED, STAYED = 0.35, 0.65  # greatest share of the loss for vanishing, least for staying
LEAST = 1.0  # [m/s] lower bound of the whole ride's loss, by which the share is computed


@dataclass
class Deeds:
    """An action of one ride, and rides without some vehicles."""

    asked: Question
    whole: Ridden
    alone: Ridden
    everybody: frozenset[int]
    drive: Callable[[frozenset[int]], Ridden]  # drives without these vehicles
    _known: dict[frozenset[int], Ridden] = field(default_factory=dict)

    def vanishes(self, gone: Collection[int]) -> bool | None:
        """Check whether the action vanishes without some vehicles; None: neither yes nor no."""
        other = self._without(frozenset(gone) & self.everybody)
        deed = self.asked.deed
        if deed in ("change-left", "change-right"):
            usual = self.alone.manoeuvres.count(deed)
            return other.manoeuvres.count(deed) <= usual
        share = self._loss(other) / max(self._loss(self.whole), LEAST)
        if VANISHED < share < STAYED:
            return None
        return share <= VANISHED

    def holds(self, named: Collection[int]) -> bool:
        """Check whether the action vanishes without those named, and stays with them alone.

        If nobody is named, check whether it stays with nobody there.
        """
        rest = self.everybody - frozenset(named)
        return (not named or self.vanishes(named) is True) and self.vanishes(rest) is False

    def _without(self, gone: frozenset[int]) -> Ridden:
        if not gone:
            return self.whole
        if gone == self.everybody:
            return self.alone
        if gone not in self._known:
            self._known[gone] = self.drive(gone)
        return self._known[gone]

    def _loss(self, ridden: Ridden) -> float:
        """Return the greatest loss of speed [m/s], relative to driving alone, around the place.

        If the ego also acts so when alone, the loss is relative to the highest speed there.
        """
        places = np.arange(self._place - BEFORE, self._place + BEYOND, GRID)
        places = places[(places >= 0.0) & (places <= self.alone.gone[-1])]
        free = np.interp(places, self.alone.gone, self.alone.speed)
        if self.asked.usual:
            free = np.full(len(places), float(np.max(free)))
        ours = np.interp(places, ridden.gone, ridden.speed)
        return float(np.max(free - ours)) if len(places) else 0.0

    @property
    def _place(self) -> float:
        return float(np.interp(self.asked.moment, self.whole.time, self.whole.gone))


def agrees(
    deeds: Deeds, planted: tuple[int, ...], idle: tuple[int, ...], expected: tuple[bool, ...]
) -> bool:
    """Drive until it is clear whether an action depends on vehicles as expected.

    Args:
        deeds: the action, and its rides.
        planted: the vehicles that are to matter.
        idle: other vehicles of the story.
        expected: whether the action vanishes without each idle vehicle, each planted one, and all
            planted ones if there are several; if there are none, without everybody.
    """
    rest = deeds.everybody - {*planted, *idle}
    if rest and deeds.vanishes(rest) is not False:
        return False
    groups = [frozenset((one,)) for one in (*idle, *planted)]
    if len(planted) != 1:
        groups.append(frozenset(planted) or deeds.everybody)
    pairs = zip(groups, expected, strict=True)
    return all(deeds.vanishes(group) is wanted for group, wanted in pairs)
