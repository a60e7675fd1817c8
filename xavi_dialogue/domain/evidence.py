"""Evidence: the parts of answers: what they rest on, effects, causes and contrasts."""

from typing import Literal, TypeAlias

from planner.trace import Action as MacroAction
from planner.trace import Component, HoldUp, Outcome
from xavi_dialogue.domain.base import Value


class Evidence(Value, frozen=True):
    """What an answer rests on."""

    method: Literal["record", "tree", "rollouts"] = "record"
    rollouts: int = 0
    distinct_samples: int = 0
    traces: tuple[str, ...] = ()  # trace ids


class OutcomeEstimate(Value, frozen=True):
    """The likeliest outcome of a plan."""

    name: Outcome
    probability: float
    collided_with: int | None = None


class Effect(Value, frozen=True):
    """How a component would differ: foil minus fact, in natural units."""

    component: Component
    unit: str
    delta: float
    low: float  # weighted 5 % point over distinct samples
    high: float  # weighted 95 % point
    n: int
    n_distinct: int


class Mechanism(Value, frozen=True):
    """How a vehicle held the ego up in the rollouts of the foil, or under the plan."""

    how: HoldUp | Literal["collision"]
    speed_from: float | None  # [m/s] its speed when the hold-up began
    speed_to: float | None  # [m/s] its lowest speed within it
    delay: float | None  # [s] mean duration of the hold-up
    share: float  # weight of the rollouts in which it occurred
    present: bool = False  # it was going on when the decision was taken


class Cause(Value, frozen=True):
    """A vehicle because of which something came about, or would have."""

    vehicle: int
    actions: tuple[MacroAction, ...]  # what it was expected to do
    probability: float  # that it does so
    mechanism: Mechanism | None = None
    influence: float | None = None  # [bit] mutual information with the choice of actions
    decision_changes: bool | None = None  # planning again without it; None: not tried
    necessary: bool | None = None


#: What the planner reckons with, in seconds: the components of the reward, what other outcomes cost
#: (collision, dead: off the way to the goal, late: not there in the time foreseen), and effort.
Term: TypeAlias = Component | Literal["collision", "dead", "late", "effort"]


class Contrast(Value, frozen=True):
    """A fact and a foil compared: the heart of causal answers about our own choice."""

    fact: tuple[MacroAction, ...]
    foil: tuple[MacroAction, ...]
    outcome: OutcomeEstimate | None  # of the foil
    effects: tuple[Effect, ...]  # largest first
    causes: tuple[Cause, ...]  # most important first
    evidence: Evidence
    decided: float  # [s] time of the decision
    fact_outcome: OutcomeEstimate | None = None
    close: bool = False  # nothing that can be told speaks for the fact
    collision: float = 0.0  # probability of one under the foil, from 1 % on ...
    fact_collision: float = 0.0  # ... and under the fact
    collided_with: int | None = None  # the likeliest vehicle, where the foil may collide
    effort: float = 0.0  # [s] that the planner holds against the foil's actions as such
    value: float | None = None  # [s] by which the fact's expected reward is higher
    continued: tuple[MacroAction, ...] = ()  # what the foil would be followed by
    waypoint: bool = False  # "there" is a place on the way, not the destination
    cleared: tuple[int, ...] = ()  # vehicles that make no difference: it was planned without them
    decisive: Term | None = None  # what speaks most for the fact, in the planner's own reckoning
    way: bool = False  # the fact is the way to the destination, and no other way is known to be
