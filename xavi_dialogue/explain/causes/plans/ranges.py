"""Calibrated ranges of times and probabilities of outcomes, learnt from foils driven in SUMO.

`xavi bench fidelity --learn` makes the table, ranges.json, which records its sources. Cases
are distinguished by the kind of foil and of road (Mondrian conformal prediction, Vovk et al. 2005).
If a kind of road had too few rides, the range for all roads is used; if those are too few as well,
or nothing similar was tried, no range is given.
"""

from collections.abc import Sequence
from functools import cache
from importlib.resources import files
from typing import Literal, NamedTuple, TypeAlias

import msgspec

from planner.record.trace import Outcome, PlanTrace
from sim.scene import EGO
from xavi_dialogue.causal.conformal import COVERAGE, reach
from xavi_dialogue.causal.effects import ComponentEffect
from xavi_dialogue.causal.model import CausalModel, Intervention
from xavi_dialogue.domain.evidence import TimeRange, calibrated
from xavi_dialogue.explain.causes.vehicles.actions import EXITS

FoilKind: TypeAlias = Literal["stop", "exit", "manoeuvre"]
RoadKind: TypeAlias = Literal["junction", "lanes", "road"]

NEAR = 80.0  # [m] before a junction in which a road counts as leading to it
LEAST = 20  # minimum number of rides for a kind to have a range of its own


class Error(NamedTuple):
    """The time by which one foil arrived later than predicted."""

    foil: FoilKind
    road: RoadKind
    ride: str
    error: float  # [s] infinite if it never arrived


class Group(msgspec.Struct, frozen=True):
    """The errors of one kind of cases."""

    foil: FoilKind
    road: RoadKind | None  # None: all roads
    rides: int
    cases: int
    reach: float  # [s] half the width of the range around the predicted time


class Source(msgspec.Struct, frozen=True):
    """What ranges were made of."""

    command: str
    worlds: dict[str, tuple[int, int]]  # the first and the last seed, by scenario or family
    rides: int
    cases: int
    missed: int  # cases in which the foil never came to the destination
    foils: int = 0  # foils whose outcomes were predicted
    model_error: float | None = None  # as fitted, without the margin of the bound


class Ranges(msgspec.Struct, frozen=True):
    """The table of ranges."""

    coverage: float
    constant: float  # [s] half the width of a single range for all, for comparison in the bench
    groups: tuple[Group, ...]
    source: Source
    model_error: float = 0.0  # highest probability that rollouts show nothing of an outcome
    unforeseen: dict[Outcome, float] = {}  # probability of each in that case; empty: all equal

    def trusted(self, outcome: Outcome, probability: float) -> float:
        """Return the probability of an outcome, calibrated from that among the rollouts."""
        if not self.unforeseen:
            return calibrated(probability, self.model_error)
        return calibrated(probability, self.model_error, self.unforeseen.get(outcome, 0.0))

    def group(self, foil: FoilKind, road: RoadKind) -> Group | None:
        """Find the group of a kind of case; None if too few rides had it."""
        found = {one.road: one for one in self.groups if one.foil == foil}
        return found.get(road, found.get(None))


def foil_kind(action: str) -> FoilKind:
    """Return the kind of a foil, by its first action."""
    if action == "stop":
        return "stop"
    return "exit" if action in EXITS else "manoeuvre"


def road_kind(trace: PlanTrace) -> RoadKind:
    """Return the kind of road of a decision: towards a junction, of several lanes, or of one."""
    road = trace.road
    if road is not None and road.route and road.route[0].distance <= NEAR:
        return "junction"
    place = None if road is None else road.places.get(EGO)
    return "lanes" if place is not None and place.lanes > 1 else "road"


def group_errors(errors: Sequence[Error], coverage: float = COVERAGE) -> tuple[Group, ...]:
    """Find the ranges of the kinds of cases.

    Args:
        errors: the error of each case.
        coverage: the share of cases that each range must cover.
    """
    found = []
    for foil in dict.fromkeys(one.foil for one in errors):
        for road in (None, *dict.fromkeys(one.road for one in errors)):
            rides: dict[str, list[float]] = {}
            for one in errors:
                if one.foil == foil and road in (None, one.road):
                    rides.setdefault(one.ride, []).append(one.error)
            size = reach(list(rides.values()), coverage) if len(rides) >= LEAST else None
            if size is not None:
                cases = sum(map(len, rides.values()))
                found.append(Group(foil, road, len(rides), cases, round(size, 3)))
    return tuple(found)


@cache
def table() -> Ranges:
    """Return the table that comes with the program.

    Raises:
        ValueError: the file is not such a table.
    """
    text = (files("xavi_dialogue.explain.causes") / "ranges.json").read_bytes()
    return msgspec.json.decode(text, type=Ranges)


def likely(
    model: CausalModel,
    here: Intervention,
    there: Intervention,
    found: Sequence[ComponentEffect],
    known: Ranges | None = None,
) -> TimeRange | None:
    """Return the range of how much later [s] a foil comes to the destination.

    None if the calibration does not apply: arrival is not the likeliest outcome of the foil, its
    first action is also that of the fact, others are supposed to act differently, or too few rides
    had its kind.

    Args:
        model: the causal model of the decision.
        here: the fact.
        there: the foil.
        found: the effects of doing the foil instead of the fact.
        known: the table; None for the one that comes with the program.
    """
    effect = next((one for one in found if one.component == "time"), None)
    supposed = model.trace.what_if
    other = supposed is not None and bool(
        supposed.gone or supposed.vehicle is not None or supposed.faster
    )
    if effect is None or other or model.given or there.likeliest != "done":
        return None
    if not there.plan or there.plan[:1] == here.plan[:1]:
        return None
    ranges = table() if known is None else known
    group = ranges.group(foil_kind(there.plan[0]), road_kind(model.trace))
    if group is None:
        return None
    low, high = effect.delta - group.reach, effect.delta + group.reach
    return TimeRange(low, high, ranges.coverage, group.cases)
