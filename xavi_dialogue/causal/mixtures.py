"""Mixtures: p(R, O), the results of rollouts with their weights, and statistics of them."""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, TypeAlias

from planner.record.trace import OUTCOMES, Component, Outcome, Rollout

#: The joint sample S: a choice for every predicted vehicle, as (vehicle, goal, trajectory), and
#: for every traffic light that was drawn, as (-1 - index in the trace, course, 0). Phantoms follow
#: the lights, as (-1 - lights - index in the trace, comes, 0).
Joint: TypeAlias = tuple[tuple[int, int, int], ...]


class Result(NamedTuple):
    """The result of one action sequence under one joint sample."""

    joint: Joint
    rollout: Rollout  # the first one recorded
    draws: int  # how often it was recorded
    searched: int  # of these, those that the search drew by itself: not forced


@dataclass(frozen=True)
class Mixture:
    """p(R, O): results with their weights."""

    results: tuple[Result, ...]  # each (actions, sample) once, in order of first record
    weights: tuple[float, ...]  # of the results; they sum to 1

    @property
    def draws(self) -> int:
        """Recorded rollouts behind it, repeats included."""
        return sum(result.draws for result in self.results)

    @cached_property
    def outcomes(self) -> dict[Outcome, float]:
        """p(O): exclusive, sums to 1."""
        found = dict.fromkeys(OUTCOMES, 0.0)
        for result, weight in zip(self.results, self.weights, strict=True):
            found[result.rollout.outcome] += weight
        return found

    @cached_property
    def value(self) -> float:
        """Expected reward."""
        pairs = zip(self.results, self.weights, strict=True)
        return sum(weight * result.rollout.reward for result, weight in pairs)

    @property
    def likeliest(self) -> Outcome:
        """The likeliest outcome; ties go to the earlier one in the order of OUTCOMES."""
        return max(OUTCOMES, key=lambda outcome: self.outcomes[outcome])

    def present(self, component: Component) -> list[tuple[Joint, float, float]]:
        """Return (sample, weight, value) of the results in which a component is present."""
        return [
            (result.joint, weight, value)
            for result, weight in zip(self.results, self.weights, strict=True)
            if (value := result.rollout.components.get(component)) is not None
        ]

    def presence(self, component: Component) -> float:
        """Return p(R_c is present)."""
        return sum(weight for _, weight, _ in self.present(component))

    def expectation(self, component: Component) -> float | None:
        """Return E[R_c] over the results in which c is present; None if it never is."""
        present = self.present(component)
        mass = sum(weight for _, weight, _ in present)
        return sum(weight * value for _, weight, value in present) / mass if mass > 0.0 else None

    def collisions(self) -> dict[int, float]:
        """Return the probability of a collision with each vehicle, by vehicle."""
        found: dict[int, float] = {}
        for result, weight in zip(self.results, self.weights, strict=True):
            vehicle = result.rollout.collided_with
            if result.rollout.outcome == "collision" and vehicle is not None:
                found[vehicle] = found.get(vehicle, 0.0) + weight
        return dict(sorted(found.items()))
