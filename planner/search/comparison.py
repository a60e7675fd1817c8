"""Joint samples of other road users, lights and phantoms.

The search draws them at random. The comparison of first actions takes a weighted set of them. If
few joint samples cover nearly all of the probability, they are enumerated, and the weighted mean
reward of an action is its expectation. If there are more, the likeliest are enumerated, and draws
of the search represent the rest: a stratified estimate without bias.
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

#: Samples of road users, then of lights, then of phantoms.
Samples: TypeAlias = tuple[Sample | LightSample | PhantomSample, ...]

COVERED = 0.99  # total probability of samples from which the remaining ones are ignored
INEXACT = 0.5  # share of the maximum number that is used if it does not suffice for COVERED


def draw(
    beliefs: Mapping[int, Sequence[Belief]],
    draws: Mapping[int | str, random.Random],
    lights: Outlook = DARK,
    phantoms: Sequence[Phantom] = (),
) -> Samples:
    """Draw a goal and a trajectory for every other road user, and a course for every controller.

    For every phantom, draw whether it comes. Each draw uses a random generator of its own.
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
    """Return the name of the random generator of a phantom."""
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
    """Return joint samples with weights that sum to 1: the likeliest in order, then drawn ones.

    If enumeration does not reach COVERED, the number of enumerated samples is the one with the
    least error. With n draws for the remaining probability q, the variance is that of the
    rewards times q squared over n.

    Args:
        beliefs: those about every other road user.
        drawn: joint samples that the search drew independently of one another.
        most: maximum number of joint samples.
        lights: the courses that the lights may take.
        phantoms: road users that may come out of hidden areas.
    """
    found: dict[Samples, float] = {}
    mass = [0.0]  # probability of the first 0, 1, 2, ... samples
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
    """Yield joint samples with their probabilities, likeliest first; all choices are independent.

    This is a best-first search over tuples of ranks, one rank for each road user, controller or
    phantom. A tuple is considered once its parent, with one rank lower by 1, has been yielded.
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
    """Return the choices of a phantom, to come or not to come, the likelier first."""
    chance = one.probability
    found: _Choices = [(PhantomSample(index, True), chance)]
    found.append((PhantomSample(index, False), 1.0 - chance))
    return sorted((pair for pair in found if pair[1] > 0.0), key=lambda pair: -pair[1])


def _courses(known: LightPrediction) -> _Choices:
    """Return the possible courses of one controller, the likeliest first."""
    found: _Choices = [
        (LightSample(known.controller, k), course.probability)
        for k, course in enumerate(known.courses)
        if course.probability > 0.0
    ]
    return sorted(found, key=lambda pair: -pair[1])


def _choices(vehicle: int, known: Sequence[Belief]) -> _Choices:
    """Return the possible goals and ways of a road user, the likeliest first."""
    found: _Choices = [
        (Sample(vehicle, goal, way), belief.probability * trajectory.probability)
        for goal, belief in enumerate(known)
        for way, trajectory in enumerate(belief.trajectories)
        if belief.probability * trajectory.probability > 0.0
    ]
    return sorted(found, key=lambda pair: -pair[1])
