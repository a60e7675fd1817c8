"""Chances: how probable the outcomes of an option of a decision are.

There is one estimate for each option, and all answers tell it: from the mixture of its rollouts
alone, whatever it is compared with, and with the error of the model behind the rollouts, which
enters here and nowhere else.
"""

from dataclasses import dataclass

from planner.record.trace import Outcome
from xavi_dialogue.causal.mixtures import Mixture
from xavi_dialogue.domain.evidence import OutcomeEstimate
from xavi_dialogue.explain.causes.plans.ranges import Ranges, table

ALONE = 0.9  # of the probability of a collision that must be with one vehicle to name it


@dataclass(frozen=True, slots=True)
class Chances:
    """How probable the outcomes are, by a mixture of rollouts and how far these are trusted."""

    rollouts: Mixture
    known: Ranges  # with the error of the model behind them

    def of(self, outcome: Outcome) -> float:
        """Give the probability of an outcome; where roads lead (dead) is no guess."""
        found = min(self.rollouts.outcomes[outcome], 1.0)
        return found if outcome == "dead" else self.known.trusted(outcome, found)

    @property
    def collision(self) -> float:
        """The probability of a collision with anybody."""
        return self.of("collision")

    def collision_with(self, vehicle: int) -> float:
        """Give the probability of a collision with a vehicle, as if errors struck it alone."""
        found = self.rollouts.collisions().get(vehicle, 0.0)
        return self.known.trusted("collision", min(found, 1.0))

    @property
    def struck(self) -> int | None:
        """The vehicle that nearly all collisions are with, by weight; None where several are hit.

        A probability of any collision is not told of one of several vehicles.
        """
        found = self.rollouts.collisions()
        first = max(found, key=lambda vehicle: found[vehicle], default=None)
        alone = first is not None and found[first] >= ALONE * sum(found.values())
        return first if alone else None

    @property
    def likeliest(self) -> OutcomeEstimate:
        """The likeliest outcome among the rollouts."""
        name = self.rollouts.likeliest
        return OutcomeEstimate(name, self.of(name), self.struck if name == "collision" else None)


def either_way(probability: float) -> float:
    """Trust the rollouts with which of two comes out better, as far as their model goes.

    Where they tell nothing, either does as often.
    """
    error = table().model_error
    return (1.0 - error) * probability + error / 2.0


def surely(probability: float) -> float:
    """Bound a probability that the rollouts bound from below by what holds if their model does."""
    return (1.0 - table().model_error) * probability


def chances(plan: Mixture) -> Chances:
    """Estimate how probable the outcomes of an option are."""
    return Chances(plan, table())
