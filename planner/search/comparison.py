"""Joint samples of others and lights: drawn to search; with weights, to compare first actions.

Where few joint samples make up nearly all of the probability, they are enumerated, and the mean
reward of an action is its exact expectation. Where there are more, the likeliest are enumerated
and draws of the search stand for the rest: a stratified estimate without bias.
"""

import heapq
import itertools
import math
import random
from bisect import bisect
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from typing import TypeAlias

from planner.prediction.recognise import Belief
from planner.record.hidden_record import Phantom, PhantomSample
from planner.record.light_record import LightPrediction, LightSample
from planner.record.trace import Sample
from planner.traffic_lights.signals import DARK, Outlook

#: Of vehicles, then of lights, then of those who are imagined.
Samples: TypeAlias = tuple[Sample | LightSample | PhantomSample, ...]

COVERED = 0.99  # probability from which on what is left is left out
INEXACT = 0.5  # of the bound: joint samples where that does not suffice to cover enough


def draw(
    beliefs: Mapping[int, Sequence[Belief]],
    draws: Mapping[int | str, random.Random],
    lights: Outlook = DARK,
    phantoms: Sequence[Phantom] = (),
) -> Samples:
    """Draw a goal and a trajectory for every other vehicle, and a course for every controller.

    Of everybody who is imagined, draw whether he comes. Each is drawn from its own generator.
    """
    found: list[Sample | LightSample | PhantomSample] = []
    for vehicle, known in beliefs.items():
        rng, (goals, ways) = draws[vehicle], _summed(tuple(known))
        goal = _drawn_by(rng, goals)
        found.append(Sample(vehicle, goal, _drawn_by(rng, ways[goal])))
    for one in lights.varying:
        shares = [course.probability for course in one.courses]
        found.append(LightSample(one.controller, _drawn(draws[one.controller], shares)))
    for k, phantom in enumerate(phantoms):
        chance = phantom.probability
        found.append(PhantomSample(k, _drawn(draws[source_of(k)], [1.0 - chance, chance]) == 1))
    return tuple(found)


def source_of(phantom: int) -> str:
    """Return the name of the generator of one who is imagined."""
    return f"phantom {phantom}"


@lru_cache(maxsize=256)
def _summed(known: tuple[Belief, ...]) -> tuple[list[float], list[list[float]]]:
    """Return the running sums of the probabilities of goals, and of the ways to each."""
    goals = list(itertools.accumulate(belief.probability for belief in known))
    ways = [
        list(itertools.accumulate(way.probability for way in belief.trajectories))
        for belief in known
    ]
    return goals, ways


def _drawn_by(rng: random.Random, sums: list[float]) -> int:
    return bisect(sums, rng.random() * sums[-1], 0, len(sums) - 1)  # as `choices` does


def _drawn(rng: random.Random, probabilities: Sequence[float]) -> int:
    return rng.choices(range(len(probabilities)), weights=probabilities)[0]


def weighted(
    beliefs: Mapping[int, Sequence[Belief]],
    drawn: Sequence[Samples],
    most: int,
    lights: Outlook = DARK,
    phantoms: Sequence[Phantom] = (),
) -> list[tuple[Samples, float]]:
    """Joint samples with weights that sum to 1; the likeliest first.

    Where they cannot all be enumerated, as many are as make the error least: with n draws for
    the mass q that is left, its variance is that of the rewards times q squared over n.

    Args:
        beliefs: of every other vehicle.
        drawn: by the search, independently of one another.
        most: joint samples that are enumerated at most.
        lights: how they may go on.
        phantoms: who might come out of what is hidden.
    """
    found: dict[Samples, float] = {}
    mass = [0.0]  # of the first 0, 1, 2, ... of them
    for samples, probability in itertools.islice(likeliest(beliefs, lights, phantoms), most):
        found[samples] = probability
        mass.append(mass[-1] + probability)
        if mass[-1] >= COVERED:
            return [(samples, weight / mass[-1]) for samples, weight in found.items()]
    budget = max(1, round(INEXACT * most))
    kept = min(range(min(budget, len(mass))), key=lambda m: (1.0 - mass[m]) ** 2 / (budget - m))
    found = dict(itertools.islice(found.items(), kept if drawn else budget))
    rest = [samples for samples in drawn if samples not in found][: budget - kept]
    for samples in rest:
        found[samples] = found.get(samples, 0.0) + (1.0 - mass[kept]) / len(rest)
    total = sum(found.values())
    return [(samples, weight / total) for samples, weight in found.items()]


def standard_error(weights: Sequence[float], values: Sequence[float]) -> float:
    """Return the standard error of the mean of values whose weights sum to 1 (Hajek 1971)."""
    pairs = list(zip(weights, values, strict=True))
    mean = sum(weight * value for weight, value in pairs)
    return math.sqrt(sum((weight * (value - mean)) ** 2 for weight, value in pairs))


def likeliest(
    beliefs: Mapping[int, Sequence[Belief]],
    lights: Outlook = DARK,
    phantoms: Sequence[Phantom] = (),
) -> Iterator[tuple[Samples, float]]:
    """Yield the joint samples of others that are independent, with probabilities, likeliest first.

    Best-first over ranks: a vehicle's next choice is considered once all before it are.
    """
    choices: list[_Choices] = [_choices(vehicle, known) for vehicle, known in beliefs.items()]
    choices += [_courses(one) for one in lights.varying]
    choices += [_comings(k, one) for k, one in enumerate(phantoms)]
    ranks = (0,) * len(choices)
    waiting = [(-math.prod(own[0][1] for own in choices), ranks, 0)]
    while waiting:
        probability, ranks, since = heapq.heappop(waiting)
        yield tuple(own[k][0] for own, k in zip(choices, ranks, strict=True)), -probability
        for i in range(since, len(choices)):
            k = ranks[i] + 1
            if k < len(choices[i]):
                after = probability * choices[i][k][1] / choices[i][k - 1][1]
                heapq.heappush(waiting, (after, (*ranks[:i], k, *ranks[i + 1 :]), i))


_Choices: TypeAlias = list[tuple[Sample | LightSample | PhantomSample, float]]


def _comings(index: int, one: Phantom) -> _Choices:
    """Return whether somebody who is imagined comes, the likelier first."""
    chance = one.probability
    found: _Choices = [(PhantomSample(index, True), chance)]
    found.append((PhantomSample(index, False), 1.0 - chance))
    return sorted((pair for pair in found if pair[1] > 0.0), key=lambda pair: -pair[1])


def _courses(known: LightPrediction) -> _Choices:
    """Return how one controller may go on, the likeliest first."""
    found: _Choices = [
        (LightSample(known.controller, k), course.probability)
        for k, course in enumerate(known.courses)
        if course.probability > 0.0
    ]
    return sorted(found, key=lambda pair: -pair[1])


def _choices(vehicle: int, known: Sequence[Belief]) -> _Choices:
    """Return what one vehicle may do, the likeliest first; what cannot be is left out."""
    found: _Choices = [
        (Sample(vehicle, goal, way), belief.probability * trajectory.probability)
        for goal, belief in enumerate(known)
        for way, trajectory in enumerate(belief.trajectories)
        if belief.probability * trajectory.probability > 0.0
    ]
    return sorted(found, key=lambda pair: -pair[1])
