"""Evidence: the parts of answers: what they rest on, effects, causes and contrasts."""

from typing import Literal, TypeAlias

from planner.record.trace import OUTCOMES, Component, HoldUp, Outcome
from planner.record.trace import Action as MacroAction
from xavi_dialogue.domain.base import Value


class Evidence(Value, frozen=True):
    """What an answer rests on."""

    method: Literal["record", "tree", "rollouts"] = "record"
    rollouts: int = 0
    distinct_samples: int = 0
    traces: tuple[str, ...] = ()  # trace ids


def calibrated(
    probability: float, model_error: float, unforeseen: float = 1.0 / len(OUTCOMES)
) -> float:
    """Return how probable an outcome is, of its probability among rollouts.

    Rollouts do not know the error of their own model. With the probability `model_error` they
    tell nothing, and the outcome is as likely as it is among what they did not foresee; by
    default each outcome is (label smoothing, Szegedy et al. 2016).
    """
    return (1.0 - model_error) * probability + model_error * unforeseen


class OutcomeEstimate(Value, frozen=True):
    """The likeliest outcome of a plan."""

    name: Outcome
    probability: float  # as far as the rollouts are to be trusted
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


class Causation(Value, frozen=True):
    """Which vehicles a deed hangs on, tried by planning again without one, two, and all."""

    kind: Literal[
        "one",  # without it the deed would not have come about
        "both",  # each of them had to be there
        "either",  # one of them would have been enough
        "pre-empted",  # the first; had it not been there, the second
        "several",  # none of them alone, but all of them together
        "none",  # no vehicle, and not all of them together
        "open",  # that could not be planned
    ]
    vehicles: tuple[int, ...] = ()
    cleared: tuple[int, ...] = ()  # tried, and of no matter
    decides: bool = True  # without them something else is done; else the same, for less of a reason
    alters: tuple[int, ...] = ()  # of "both": without each of these, something else is done
    minimal: bool = True  # False: "several" are together enough, but maybe not all of them needed

    @property
    def jointly(self) -> tuple[int, ...]:
        """The vehicles that are causes together, or of which each would have been enough."""
        return self.vehicles if self.is_joint and self.minimal else ()

    @property
    def is_joint(self) -> bool:
        """Tell whether several are causes together, or each would have been enough."""
        return self.kind in ("both", "either", "several")


#: What the planner reckons with, in seconds: the components of the reward, what other outcomes cost
#: (collision, dead: off the way to the goal, late: not there in the time foreseen), and effort.
Term: TypeAlias = Component | Literal["collision", "dead", "late", "effort"]


#: Whether the fact is better by the record as it is known now, or the two are as good within the
#: error of the comparison; "alone": there is nothing beside the fact.
Weighing: TypeAlias = Literal["better", "close", "worse", "alone"]
CHANGES = frozenset[MacroAction](("change-left", "change-right"))
MOST = 2  # further manoeuvres that are named
EXITS = frozenset[MacroAction](("exit-left", "exit-right", "exit-straight", "continue-next-exit"))


class Share(Value, frozen=True):
    """One term of a difference."""

    term: Term
    cost: float  # [s] that the foil costs more
    chance: float | None = None  # of an outcome: how probable it is under the foil ...
    fact_chance: float | None = None  # ... and under the fact


class Aim(Value, frozen=True):
    """What plans lead to, and their times are to."""

    edge: str
    position: float  # [m] along the edge
    destination: bool  # False: a place on the way to it
    time: float | None = None  # [s] that the fact takes to it


class TimeRange(Value, frozen=True):
    """How much later a foil comes to the destination, as it held in so many cases of its kind."""

    low: float  # [s] foil minus fact
    high: float
    coverage: float  # share of cases that lay within
    cases: int


class Contrast(Value, frozen=True):
    """A fact and a foil compared: the heart of causal answers about our own choice.

    Raises:
        ValueError: what is stated of the terms does not bear the verdict out.
    """

    fact: tuple[MacroAction, ...]  # the whole plan
    foil: tuple[MacroAction, ...]  # as asked; with `continued`, the whole plan
    outcome: OutcomeEstimate | None  # of the foil
    effects: tuple[Effect, ...]  # largest first
    causes: tuple[Cause, ...]  # most important first
    evidence: Evidence
    decided: float  # [s] time of the decision
    fact_outcome: OutcomeEstimate | None = None
    collision: float = 0.0  # probability of one under the foil, from 1 % on ...
    fact_collision: float = 0.0  # ... and under the fact
    collided_with: int | None = None  # the likeliest vehicle, where the foil may collide
    continued: tuple[MacroAction, ...] = ()  # what the foil would be followed by
    aim: Aim | None = None
    cleared: tuple[int, ...] = ()  # vehicles that make no difference: it was planned without them
    causation: Causation | None = None  # None: nobody was suspected
    way: bool = False  # the fact is the way to the destination, and no other way is known to be
    verdict: Weighing = "alone"
    terms: tuple[Share, ...] = ()  # the difference of the rewards, taken apart; largest first
    told: tuple[Share, ...] = ()  # those that are stated, the decisive one first
    error: float = 0.0  # [s] standard error of the difference
    likely: TimeRange | None = None  # None: what was calibrated does not reach this
    route: MacroAction | None = None  # what comes next on our way, where the foil misses it
    horizon: float | None = None  # [s] that is looked ahead: what takes longer is late
    exceeds: float | None = None  # [s] by which the one that is surely late takes longer, at least

    def __post_init__(self) -> None:
        """Refuse reasons that speak for the other side."""
        weight = sum(share.cost for share in self.told)
        if (self.verdict == "better" and weight <= 0.0) or (
            self.verdict == "worse" and weight >= 0.0
        ):
            raise ValueError(f"told terms weigh {weight:.3f} s, but the fact is {self.verdict}")

    @property
    def value(self) -> float | None:
        """By how much [s] the expected reward of the fact is higher; None: nothing is beside it."""
        return None if self.verdict == "alone" else sum(share.cost for share in self.terms)

    @property
    def late(self) -> bool:
        """Whether the foil probably does not arrive within the time that is looked ahead."""
        return self.outcome is not None and self.outcome.name == "termination"

    @property
    def spares_delay(self) -> bool:
        """Whether the foil probably arrives within the time that is looked ahead, the fact not."""
        arrives = self.outcome is not None and self.outcome.name == "done"
        late = self.fact_outcome is not None and self.fact_outcome.name == "termination"
        return arrives and late

    @property
    def lane_for(self) -> MacroAction | None:
        """The turn for which the fact changes lanes: the foil does so later, or misses the turn."""
        change, *rest = self.fact or ("continue",)
        turn = next((action for action in rest if action in EXITS), None)
        if change not in CHANGES or turn is None or self.foil != ("continue",):
            return None
        to_side = turn.removeprefix("exit-") == change.removeprefix("change-")
        lost = self.outcome is not None and self.outcome.name == "dead"
        return turn if (to_side and change in self.continued) or lost else None

    @property
    def close(self) -> bool:
        """Whether the two are as good within the error of the comparison."""
        return self.verdict == "close"

    @property
    def decisive(self) -> Term | None:
        """What speaks most for the fact, in the planner's own reckoning."""
        return self.told[0].term if self.verdict == "better" else None

    @property
    def waypoint(self) -> bool:
        """Whether times are to a place on the way, and not to the destination."""
        return self.aim is not None and not self.aim.destination

    @property
    def further(self) -> tuple[MacroAction, ...]:
        """The manoeuvres that the foil holds beyond what was asked, and the fact does not.

        Changes of lanes; after one of them or going on, also the way taken at the next junction.
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
