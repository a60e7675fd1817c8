"""The result of one rollout."""

from collections.abc import Sequence
from dataclasses import dataclass

from planner.record.hidden_record import HeldByHidden, PhantomSample
from planner.record.light_record import HeldByLight, LightSample
from planner.record.trace import Component, HeldUp, Outcome, RewardTerm, Sample
from planner.rollouts.rollout import Leg
from planner.search.comparison import Samples
from planner.search.tree import Node


@dataclass(frozen=True, slots=True, eq=False)
class Simulated:
    """A rollout with its samples, its outcome and its reward."""

    drawn: Samples
    legs: tuple[Leg, ...]
    outcome: Outcome
    components: dict[Component, float | None]
    reward: float
    terms: dict[RewardTerm, float]  # [s] costs that the reward consists of
    held_up: tuple[HeldUp, ...]
    held_by_lights: tuple[HeldByLight, ...]
    held_by_hidden: tuple[HeldByHidden, ...]
    braking: tuple[int, ...]  # vehicles that brake for the ego, or for another that does
    forced: bool = False
    weight: float | None = None  # in the comparison of the first actions

    @property
    def samples(self) -> tuple[Sample, ...]:
        """The goals and trajectories drawn for the others."""
        return tuple(one for one in self.drawn if isinstance(one, Sample))

    @property
    def lights(self) -> tuple[LightSample, ...]:
        """The courses drawn for the lights."""
        return tuple(one for one in self.drawn if isinstance(one, LightSample))

    @property
    def phantoms(self) -> tuple[PhantomSample, ...]:
        """The draws of whether each phantom comes."""
        return tuple(one for one in self.drawn if isinstance(one, PhantomSample))

    @property
    def actions(self) -> Node:
        """The macro actions, in order."""
        return tuple(leg.action for leg in self.legs)


def braking(legs: Sequence[Leg]) -> tuple[int, ...]:
    """Return the vehicles that brake for the ego in a rollout, or for another that does, sorted."""
    if not legs:
        return ()
    traffic = legs[-1].traffic
    pairs = zip(traffic.vehicles, traffic.braking.tolist(), strict=True)
    return tuple(sorted(vehicle for vehicle, brakes in pairs if brakes and vehicle >= 0))
