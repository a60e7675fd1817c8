"""Beliefs about other road users: goals with probabilities, and the ways to each."""

from collections.abc import Sequence
from dataclasses import dataclass

from planner.motion.obstacles import Motions, Obstacle
from planner.prediction.goals import Goal
from planner.record.light_record import HeldByLight
from planner.record.trace import Action, HeldUp

NEGLIGIBLE = 0.01  # probability below which a goal or a way is dropped


@dataclass(frozen=True, slots=True, eq=False)
class Trajectory:
    """One way in which a road user may go on, as an obstacle from now (step 0) on."""

    probability: float  # given the goal
    actions: tuple[Action, ...]
    motions: Motions
    held_up: tuple[HeldUp, ...] = ()  # by whom, on the way to the goal
    held_by_lights: tuple[HeldByLight, ...] = ()

    @property
    def motion(self) -> Obstacle:
        """The motion if lights take their likeliest courses."""
        return self.motions.usual


@dataclass(frozen=True, slots=True, eq=False)
class Belief:
    """One goal of one vehicle or person, and how likely it is."""

    goal: Goal
    likelihood: float
    probability: float
    trajectories: tuple[Trajectory, ...]
    indicators: float = 1.0  # p(shown | goal), a factor of the likelihood


def likeliest(beliefs: Sequence[Belief]) -> Motions:
    """Return the likeliest motion of a road user."""
    pairs = (
        (belief.probability * way.probability, way.motions)
        for belief in beliefs
        for way in belief.trajectories
    )
    return max(pairs, key=lambda pair: pair[0])[1]
