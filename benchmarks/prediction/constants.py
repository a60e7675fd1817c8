"""The constants of recognition, and the effect of changing one of them on its scores.

Constants of driving (accelerations, gaps, sideways comfort) belong to the driver and stay fixed.
Constants that only shape trajectories do not change the probabilities of goals.
"""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from types import ModuleType

import msgspec

from benchmarks.prediction import ride_scenes
from benchmarks.prediction.approach import Approach
from benchmarks.prediction.foretold import EVERY, spread
from benchmarks.prediction.goal_scores import score
from benchmarks.prediction.ride_scenes import Recording
from planner.motion import tracks
from planner.prediction import astar, goals, indication, likelihood, recognise

FACTORS = (0.5, 0.8, 1.25, 2.0)
RATIONALITY = "rationality"  # of the settings
THINNED = 4  # one of this many moments is used
#: The constants, with the modules that read each.
CONSTANTS: Mapping[str, tuple[ModuleType, ...]] = {
    "UNEXPLAINED": (likelihood,),
    "NO_WAY": (likelihood,),
    "CLUTCH": (likelihood,),
    "PAUSE": (likelihood,),
    "LANE_CHANGE_COST": (astar, likelihood),
    "SLOW": (astar, likelihood),
    "DEPTH": (astar,),
    "NEGLIGIBLE": (recognise,),
    "STOP_PRIOR": (goals,),
    "BEYOND": (goals,),
    "TREND": (tracks,),
    "STEADY": (tracks,),
    "RIPPLE": (tracks,),
    "LEAST_PACE": (tracks,),
    "CRAWLING": (tracks,),
    "QUEUE": (tracks,),
    "FAR_ASIDE": (tracks,),
    "AT_LINE": (tracks,),
    "ON_CENTRELINE": (tracks,),
    "SOON": (indication,),
    "RAMP": (indication,),
    "BRANCHING": (indication,),
    "WRONG": (indication,),
    "MEMORY": (ride_scenes,),
}


class Varied(msgspec.Struct, frozen=True):
    """The summed scores of one ride with one constant changed."""

    constant: str
    factor: float
    moments: int
    log: float
    top: float


class VariedRow(msgspec.Struct, frozen=True):
    """The changes of the mean scores if one constant is multiplied."""

    constant: str
    moments: int
    log: dict[str, float | None]  # change by factor; None if the constant stays the same number
    top: dict[str, float | None]


def vary(recording: Recording, approaches: Sequence[Approach]) -> tuple[Varied, ...]:
    """Score a ride unchanged (factor 1), and with each constant changed in turn."""
    found = [_scored(recording, approaches, RATIONALITY, 1.0)]
    for constant in (RATIONALITY, *CONSTANTS):
        for factor in FACTORS:
            settings = recording.settings
            if constant == RATIONALITY:
                value = factor * settings.rationality
                settings = msgspec.structs.replace(settings, rationality=value)
            with changed(constant, factor) as different:
                if different:
                    again = replace(recording, settings=settings, _known={})
                    found.append(_scored(again, approaches, constant, factor))
    return tuple(found)


@contextmanager
def changed(constant: str, factor: float) -> Iterator[bool]:
    """Multiply a constant while the block runs; yield whether that makes it another number.

    A count stays a whole number.
    """
    kept = [(module, constant) for module in CONSTANTS.get(constant, ())]
    values = [getattr(module, name) for module, name in kept]
    scaled = [times(value, factor) for value in values]
    for (module, name), value in zip(kept, scaled, strict=True):
        setattr(module, name, value)
    try:
        yield scaled != values or not kept
    finally:
        for (module, name), value in zip(kept, values, strict=True):
            setattr(module, name, value)


def times(value: object, factor: float) -> object:
    """Multiply a number, or each of several; a whole number stays whole, with minimum 1."""
    if isinstance(value, tuple):
        return tuple(times(one, factor) for one in value)
    if isinstance(value, int):
        return max(round(value * factor), 1)
    assert isinstance(value, float)
    return value * factor


def varied_rows(varied: Sequence[Varied]) -> tuple[VariedRow, ...]:
    """Return the changes of the mean scores over all rides."""
    plain = [one for one in varied if one.factor == 1.0]
    if not plain:
        return ()
    base = _means(plain)
    rows = []
    for constant in (RATIONALITY, *CONSTANTS):
        log: dict[str, float | None] = {}
        top: dict[str, float | None] = {}
        for factor in FACTORS:
            those = [v for v in varied if (v.constant, v.factor) == (constant, factor)]
            means = _means(those) if those else None
            log[f"{factor:g}"] = None if means is None else means[0] - base[0]
            top[f"{factor:g}"] = None if means is None else means[1] - base[1]
        rows.append(VariedRow(constant, sum(one.moments for one in plain), log, top))
    return tuple(rows)


def _means(varied: Sequence[Varied]) -> tuple[float, float]:
    count = sum(one.moments for one in varied) or 1
    return sum(one.log for one in varied) / count, sum(one.top for one in varied) / count


def _scored(
    recording: Recording, approaches: Sequence[Approach], constant: str, factor: float
) -> Varied:
    scores = []
    for approach in approaches:
        first = -(-approach.first // (EVERY * THINNED)) * EVERY * THINNED
        for sample in range(first, approach.last + 1, EVERY * THINNED):
            beliefs = recording.beliefs(sample)[approach.vehicle]
            chances, _, truth = spread(beliefs, approach.choices, approach.truth)
            scores.append(score(chances, truth))
    logs, tops = sum(s.log for s in scores), sum(s.top for s in scores)
    return Varied(constant, factor, len(scores), logs, tops)
