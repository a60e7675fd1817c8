"""Chances: how probable the outcomes of an option of a decision are.

There is one estimate for each option, which all answers state. It follows from the mixture of the
option's rollouts alone, whatever it is compared with, and from the error of the model behind the
rollouts, which enters here and nowhere else.
"""

from dataclasses import dataclass

from planner.record.trace import Outcome
from xavi_dialogue.causal.mixtures import Mixture
from xavi_dialogue.domain.evidence import OutcomeEstimate
from xavi_dialogue.explain.causes.plans.ranges import Ranges, table

ALONE = 0.9  # share of the collisions that must be with one vehicle to name it


@dataclass(frozen=True, slots=True)
class Chances:
    """How probable the outcomes are, by a mixture of rollouts and how far these are trusted."""

    rollouts: Mixture
    known: Ranges  # with the error of the model behind them

    def of(self, outcome: Outcome) -> float:
        """Return the probability of an outcome; "dead" is not calibrated: the roads are known."""
        found = min(self.rollouts.outcomes[outcome], 1.0)
        return found if outcome == "dead" else self.known.trusted(outcome, found)

    @property
    def collision(self) -> float:
        """The probability of a collision with anybody."""
        return self.of("collision")

    def collision_with(self, vehicle: int) -> float:
        """Return the probability of a collision with a vehicle, as if errors affected it alone."""
        found = self.rollouts.collisions().get(vehicle, 0.0)
        return self.known.trusted("collision", min(found, 1.0))

    @property
    def struck(self) -> int | None:
        """The vehicle that nearly all collisions are with, by weight; None if several are hit.

        One of several vehicles is not named with the probability of any collision.
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
    """Calibrate a probability that rollouts give to one of two results.

    With the probability of the model error, the rollouts show nothing, and both are as likely.
    """
    error = table().model_error
    return (1.0 - error) * probability + error / 2.0


def surely(probability: float) -> float:
    """Lower a bound from below that rollouts give, since it holds only if their model does."""
    return (1.0 - table().model_error) * probability


def chances(plan: Mixture) -> Chances:
    """Estimate how probable the outcomes of an option are."""
    return Chances(plan, table())
