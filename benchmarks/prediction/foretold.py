"""Predictions of a vehicle at one moment of its approach, with what it then did.

The roads are those that it could choose from when its approach began, and any others that were
predicted. A road that recognition has dropped has the probability 0.
"""

from collections.abc import Iterator, Sequence

import msgspec

from benchmarks.prediction.approach import Approach
from benchmarks.prediction.displacement import Error, errors
from benchmarks.prediction.ride_scenes import Recording
from planner.prediction.goals import Goal
from planner.prediction.recognise import Belief
from planner.record.trace import SAMPLE_PERIOD, Action

EVERY = 5  # samples between two moments: 1 s


class Foretold(msgspec.Struct, frozen=True):
    """One vehicle at one moment."""

    network: str  # scenario or number, with the seed
    family: str  # of the network
    vehicle: int
    roads: str  # the choice of roads, in words
    seen: float  # [s] for which it has been seen
    left: float  # [s] until it enters the road that it takes
    chances: tuple[float, ...]  # probability of each road that it may take; their sum is up to 1
    kinds: tuple[Action, ...]  # of the roads, in the same order
    truth: int  # index of the road that it takes
    errors: tuple[Error, ...] = ()  # of the trajectories predicted


def foretold(
    recording: Recording, approach: Approach, network: str, family: str
) -> Iterator[Foretold]:
    """Yield the predictions in an approach, once a second, in the order of time."""
    first = -(-approach.first // EVERY) * EVERY
    for sample in range(first, approach.last + 1, EVERY):
        beliefs = recording.beliefs(sample)[approach.vehicle]
        chances, kinds, truth = spread(beliefs, approach.choices, approach.truth)
        yield Foretold(
            network=network,
            family=family,
            vehicle=approach.vehicle,
            roads=roads_of(approach.choices),
            seen=recording.track(sample, approach.vehicle).elapsed * SAMPLE_PERIOD,
            left=(approach.last - sample) * SAMPLE_PERIOD,
            chances=chances,
            kinds=kinds,
            truth=truth,
            errors=errors(recording, sample, approach.vehicle, beliefs),
        )


def spread(
    beliefs: Sequence[Belief], choices: Sequence[Goal], truth: str
) -> tuple[tuple[float, ...], tuple[Action, ...], int]:
    """Return the probability of each road, its kind, and the index of the one that was taken.

    Args:
        beliefs: of one vehicle.
        choices: the goals when the approach began, including the road that was taken.
        truth: edge of that road.
    """
    kinds: dict[str, Action] = {}
    for goal in (*choices, *(belief.goal for belief in beliefs)):
        if goal.target is not None:
            kinds.setdefault(goal.target.edge, goal.kind)
    sums = dict.fromkeys(kinds, 0.0)
    for belief in beliefs:
        if belief.goal.target is not None:
            sums[belief.goal.target.edge] += belief.probability
    return tuple(sums.values()), tuple(kinds.values()), list(kinds).index(truth)


def roads_of(choices: Sequence[Goal]) -> str:
    """Return words for the choice of roads."""
    if any("roundabout" in goal.place for goal in choices):
        return "roundabout"
    edges = {goal.target.edge for goal in choices if goal.target is not None}
    return "two roads" if len(edges) == 2 else "three roads or more"
