"""Evidence: the parts of causal answers, such as effects, causes and contrasts."""

from typing import Literal, TypeAlias

from planner.record.trace import OUTCOMES, Component, HoldUp, Outcome
from planner.record.trace import Action as MacroAction
from xavi_dialogue.domain.base import Value


class Evidence(Value, frozen=True):
    """The evidence for an answer."""

    method: Literal["record", "tree", "rollouts"] = "record"  # rollouts: planned again
    rollouts: int = 0  # that it rests on
    distinct_samples: int = 0  # of what others do, among these
    traces: tuple[str, ...] = ()  # trace ids


def calibrated(
    probability: float, model_error: float, unforeseen: float = 1.0 / len(OUTCOMES)
) -> float:
    """Return the probability of an outcome, given its probability among rollouts.

    Rollouts do not know the error of their own model. With probability `model_error` they say
    nothing about the outcome, and its probability is then `unforeseen`. By default all outcomes
    are equally likely in that case (label smoothing, Szegedy et al. 2016).
    """
    return (1.0 - model_error) * probability + model_error * unforeseen


class OutcomeEstimate(Value, frozen=True):
    """The likeliest outcome of a plan."""

    name: Outcome
    probability: float  # calibrated
    collided_with: int | None = None


class Effect(Value, frozen=True):
    """The difference in a component: foil minus fact, in natural units."""

    component: Component
    unit: str
    delta: float
    low: float  # weighted 5 % point over distinct samples
    high: float  # weighted 95 % point
    n: int
    n_distinct: int


class Mechanism(Value, frozen=True):
    """The way a vehicle held the ego up in the rollouts of the foil, or under the plan."""

    how: HoldUp | Literal["collision"]
    speed_from: float | None  # [m/s] its speed when the hold-up began
    speed_to: float | None  # [m/s] its lowest speed within it
    delay: float | None  # [s] mean duration of the hold-up
    share: float  # weight of the rollouts in which it occurred
    present: bool = False  # it was going on when the decision was made


class Cause(Value, frozen=True):
    """A vehicle because of which something came about, or would have."""

    vehicle: int
    actions: tuple[MacroAction, ...]  # what it was expected to do
    probability: float  # that it does so
    mechanism: Mechanism | None = None
    influence: float | None = None  # [bit] mutual information with the choice of actions
    decision_changes: bool | None = None  # planning again without it; None: not tried
    necessary: bool | None = None


class Causation(Value, frozen=True):
    """The vehicles that an action depends on, tested by planning without one, two, and all."""

    kind: Literal[
        "one",  # without it the action would not have come about
        "both",  # each of the two was needed
        "either",  # one of the two would have been enough
        "pre-empted",  # the first is the cause; without it, the second would have been
        "several",  # not one of them alone, but all of them together
        "none",  # no vehicle, nor all of them together
        "open",  # the plans for the test could not be made
    ]
    vehicles: tuple[int, ...] = ()
    cleared: tuple[int, ...] = ()  # tested, and without effect
    decides: bool = True  # without them something else is done; else the same, for weaker reasons
    alters: tuple[int, ...] = ()  # of "both": without any of these, something else is done
    minimal: bool = True  # False: "several" are enough together, but maybe not all are needed

    @property
    def jointly(self) -> tuple[int, ...]:
        """Return the vehicles that are causes together, or each of which would have sufficed."""
        return self.vehicles if self.is_joint and self.minimal else ()

    @property
    def is_joint(self) -> bool:
        """Check whether several are causes together, or each would have been enough."""
        return self.kind in ("both", "either", "several")


#: What the planner counts as cost, in seconds: the components of the reward, the outcomes other
#: than arrival (collision; dead: off the way to the goal; late: after the horizon), and effort.
Term: TypeAlias = Component | Literal["collision", "dead", "late", "effort"]


#: Whether the fact is better or worse than the foil, as far as the record shows by now; "close":
#: equally good within the error of the comparison; "alone": there is nothing to compare with.
Weighing: TypeAlias = Literal["better", "close", "worse", "alone"]
CHANGES = frozenset[MacroAction](("change-left", "change-right"))
MOST = 2  # maximum of further manoeuvres that are named
EXITS = frozenset[MacroAction](("exit-left", "exit-right", "exit-straight", "continue-next-exit"))


class Share(Value, frozen=True):
    """One term of a difference."""

    term: Term
    cost: float  # [s] that the foil costs more
    chance: float | None = None  # of an outcome: how probable it is under the foil ...
    fact_chance: float | None = None  # ... and under the fact


class Aim(Value, frozen=True):
    """The place that plans lead to; their times are times of arrival there."""

    edge: str
    position: float  # [m] along the edge
    destination: bool  # False: a place on the way to it
    time: float | None = None  # [s] that the fact takes to it


class TimeRange(Value, frozen=True):
    """The range of how much later a foil arrives, calibrated by earlier cases of its kind."""

    low: float  # [s] foil minus fact
    high: float
    coverage: float  # share of the cases that lay within the range
    cases: int


class Contrast(Value, frozen=True):
    """A comparison of fact and foil: the main part of causal answers about our own choice.

    Raises:
        ValueError: the terms that are stated contradict the verdict.
    """

    fact: tuple[MacroAction, ...]  # the whole plan
    foil: tuple[MacroAction, ...]  # as asked; with `continued`, the whole plan
    outcome: OutcomeEstimate | None  # of the foil
    effects: tuple[Effect, ...]  # largest first
    causes: tuple[Cause, ...]  # most important first
    evidence: Evidence
    decided: float  # [s] time of the decision
    fact_outcome: OutcomeEstimate | None = None
    collision: float = 0.0  # probability of a collision under the foil, from 1 % on ...
    fact_collision: float = 0.0  # ... and under the fact
    collided_with: int | None = None  # the likeliest vehicle, where the foil may collide
    continued: tuple[MacroAction, ...] = ()  # actions that would follow the foil
    aim: Aim | None = None
    cleared: tuple[int, ...] = ()  # vehicles that make no difference, tested by planning again
    causation: Causation | None = None  # None: nobody was suspected
    way: bool = False  # the fact is the way to the destination, and no other way is known to be
    verdict: Weighing = "alone"
    terms: tuple[Share, ...] = ()  # terms of the difference of the rewards, largest first
    told: tuple[Share, ...] = ()  # those that the answer states, the decisive one first
    error: float = 0.0  # [s] standard error of the difference
    likely: TimeRange | None = None  # None: there is no calibration for this
    route: MacroAction | None = None  # the next turn on our way, if the foil misses it
    horizon: float | None = None  # [s] of the planner: a plan that takes longer is late
    exceeds: float | None = None  # [s] minimum by which the plan that is surely late takes longer

    def __post_init__(self) -> None:
        """Refuse stated terms that speak against the verdict."""
        weight = sum(share.cost for share in self.told)
        if (self.verdict == "better" and weight <= 0.0) or (
            self.verdict == "worse" and weight >= 0.0
        ):
            raise ValueError(f"told terms weigh {weight:.3f} s, but the fact is {self.verdict}")

    @property
    def value(self) -> float | None:
        """Return how much higher [s] the expected reward of the fact is; None: no foil."""
        return None if self.verdict == "alone" else sum(share.cost for share in self.terms)

    @property
    def late(self) -> bool:
        """Check whether the foil probably does not arrive within the horizon."""
        return self.outcome is not None and self.outcome.name == "termination"

    @property
    def spares_delay(self) -> bool:
        """Check whether the foil probably arrives within the horizon, but the fact does not."""
        arrives = self.outcome is not None and self.outcome.name == "done"
        late = self.fact_outcome is not None and self.fact_outcome.name == "termination"
        return arrives and late

    @property
    def lane_for(self) -> MacroAction | None:
        """Return the turn for which the fact changes lanes; None: another reason, or no change.

        The foil goes on in the lane, and changes later or misses the turn.
        """
        change, *rest = self.fact or ("continue",)
        turn = next((action for action in rest if action in EXITS), None)
        if change not in CHANGES or turn is None or self.foil != ("continue",):
            return None
        to_side = turn.removeprefix("exit-") == change.removeprefix("change-")
        lost = self.outcome is not None and self.outcome.name == "dead"
        return turn if (to_side and change in self.continued) or lost else None

    @property
    def close(self) -> bool:
        """Check whether the two are equally good within the error of the comparison."""
        return self.verdict == "close"

    @property
    def decisive(self) -> Term | None:
        """Return the term that speaks most for the fact; None unless the fact is better."""
        return self.told[0].term if self.verdict == "better" else None

    @property
    def waypoint(self) -> bool:
        """Check whether times are to a place on the way, and not to the destination."""
        return self.aim is not None and not self.aim.destination

    @property
    def further(self) -> tuple[MacroAction, ...]:
        """Return manoeuvres that follow the foil, but not the fact.

        They are lane changes. If the foil ends with a lane change or with going on, the way taken
        at the next junction is one too.
        """
        rest = [action for action in self.continued if action in CHANGES]
        for action in reversed(self.fact[len(self.foil) :]):
            if rest and action == rest[-1]:
                rest.pop()
        exits = [action for action in self.continued if action in EXITS]
        free = self.foil[-1:] and (self.foil[-1] in CHANGES or self.foil[-1] == "continue")
        if free and exits and exits[0] not in self.fact:
            rest.append(exits[0])
        return tuple(rest[:MOST])
