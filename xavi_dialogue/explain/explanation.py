"""The three things that come of a query: Explanation, NoExplanation, NeedRollout.

No text here: `language.realise` puts these values into words.
"""

from typing import Literal, TypeAlias

import msgspec

from planner.trace import Action, Component, HoldUp, Outcome
from xavi_dialogue.explain.details import (
    Avoidance,
    Certainty,
    Choices,
    Contrary,
    Grounds,
    Impact,
    Need,
    Pivot,
    Ranking,
    Sight,
    Staying,
    Step,
    Suspect,
)
from xavi_dialogue.explain.query import Query, QueryAction

Reason = Literal[
    "not-understood",
    "ambiguous",
    "out-of-scope",
    "not-an-action",
    "unknown-vehicle",
    "did-not-happen",
    "not-applicable",
    "no-influence",
    "too-little-evidence",
    "effect-too-small",
    "outside-record",
    "trace-gap",
    "planner-unavailable",
    "timed-out",
    "busy",
    "planner-failed",
]


Facts: TypeAlias = dict[str, str | float | int | bool | tuple[str, ...] | None]


class OutcomeEstimate(msgspec.Struct, frozen=True):
    """The likeliest outcome of the counterfactual (or of the plan, where there is none)."""

    name: Outcome
    probability: float
    collided_with: int | None = None  # the likeliest vehicle, where the outcome is collision


class Effect(msgspec.Struct, frozen=True):
    """How a component would differ: counterfactual minus factual, in natural units."""

    component: Component
    unit: str
    delta: float
    low: float  # weighted 5 % point over distinct samples
    high: float  # weighted 95 % point
    n: int  # rollouts behind it, both sides
    n_distinct: int  # distinct samples behind it


class Mechanism(msgspec.Struct, frozen=True):
    """How the vehicle held the ego up in the rollouts of the counterfactual."""

    how: HoldUp | Literal["collision"]
    speed_from: float | None  # [m/s] its speed when the hold-up began
    speed_to: float | None  # [m/s] its lowest speed within it
    delay: float | None  # [s] mean duration of the hold-up
    share: float  # weight of the rollouts of the counterfactual in which it occurred
    present: bool = False  # it was going on when the decision was taken


class Cause(msgspec.Struct, frozen=True):
    """A vehicle because of which the counterfactual would have turned out so."""

    vehicle: int
    actions: tuple[Action, ...]  # what it is expected to do
    probability: float  # that it does so
    mechanism: Mechanism | None
    influence: float | None  # [bit] mutual information with the choice of actions
    decision_changes: bool | None  # planning again without it; None: not tried
    necessary: bool | None = None  # whether that changes the decision, or what speaks for it


class Evidence(msgspec.Struct, frozen=True):
    """What the explanation rests on."""

    method: Literal["tree", "rollouts"]
    rollouts: int
    distinct_samples: int
    traces: tuple[str, ...]  # trace ids


class Activity(msgspec.Struct, frozen=True):
    """What a vehicle is, was or will be doing: the content of answers to "what"."""

    vehicle: int
    actions: tuple[QueryAction, ...]  # done, under way or planned, in order
    probability: float | None  # of a prediction; None where it is known
    speed: float | None  # [m/s] at the time asked about
    trend: Literal["slowing", "steady", "speeding-up", "standing"] | None


class Destination(msgspec.Struct, frozen=True):
    """Where a vehicle is going: the content of answers to "where"."""

    vehicle: int
    edge: str | None  # None for stopping
    kind: Action | None = None  # the macro action that ends there; None for the ego
    place: str | None = None  # in words; None for the ego
    probability: float | None = None  # None where it is known


class Explanation(msgspec.Struct, frozen=True, kw_only=True):
    """A derived answer. The contract's fields first; the rest serve the wording.

    By what was asked:

    - About the ego and a foil (why, why not, what if, compare): all contract fields. Where no
      foil was named, the counterfactual is the best alternative first action.
    - Why the ego slowed down, stopped or gave way: no counterfactual, no effects; the causes are
      the vehicles that hold it up under its own plan, and `activity` is the ego's at that time.
    - What if another vehicle did otherwise: the counterfactual is what the ego would then plan,
      outcome and effects are those of that plan then, against its plan as things were; the one
      cause is that vehicle, with the prior probability of what was supposed, and
      `decision_changes` tells whether the two plans differ.
    - Why or what about another vehicle: `activity` holds what it is expected to do, or what its
      track shows (probability None); `destination` the goal under which that is rational;
      `rival` what goes with another goal that is nearly as probable; where it is seen to brake or
      stand, the causes are those it gives way to or has in its way, the ego (0) among them, with
      the probability of that over its goals and ways as the mechanism's share.
    - Where: `destination`, and arrival 0 once the ego is there.
    - When: `moment`, with `span` where it is only expected, or `arrival` for the way to the goal;
      `least` where no more is known than that it takes longer. With `activity` standing, `moment`
      is when we go on.
    - How sure: `activity` of another vehicle with its probability, or `certainty`.
    - How about another vehicle: `grounds`. How about the ego: `options` with the best of them
      as a contrast, or the `steps` that are still to come.
    - Which is safer or smoother: as for a foil, with a `ranking` by that measure.
    - Of a collision that happened: `impact` at `moment`; why, with the `avoidance` too.
    - How to avoid, what matters: `avoidance` or `pivot`, with the alternative as a contrast.

    By the aspect that a question has beside its type:

    - How fast, how far, where, which colour, how many, that nobody is at a place: `sight`.
    - What else, the second best, the worst: `choices`, with the one named as the counterfactual.
    - Did you have to: `need`, with the best alternative as the counterfactual, or the causes.
    - Why in this lane: `staying`, with what speaks against another as the counterfactual.
    - Why another vehicle did not: `contrary`, beside what is said of why it did otherwise.

    A question that names a suspect has `suspect`; one about a vehicle that is out of view, `seen`.
    """

    factual: tuple[Action, ...]
    counterfactual: tuple[Action, ...]  # () where the question has none
    outcome: OutcomeEstimate | None
    effects: tuple[Effect, ...]  # largest first, relative to each component's scale
    causes: tuple[Cause, ...]  # most important first
    evidence: Evidence
    activity: Activity | None = None  # answers to "what"
    sim_time: float = 0.0  # [s] when the explained decision was taken, or the moment asked about
    arrival: float | None = None  # [s] expected time to the goal, if the plan gets there
    destination: Destination | None = None  # answers to "where", goals behind "why"
    rival: tuple[QueryAction, ...] = ()  # what that vehicle is expected to do almost as probably
    moment: float | None = None  # [s] when what was asked about happened, or is expected to
    span: tuple[float, float] | None = None  # [s] between which it probably is, at 90 %
    least: float | None = None  # [s] what it takes at least
    seen: float | None = None  # [s] when a vehicle that is out of view was seen last
    options: tuple[Action, ...] = ()  # first actions that were compared, the chosen one first
    steps: tuple[Step, ...] = ()
    grounds: Grounds | None = None
    certainty: Certainty | None = None
    avoidance: Avoidance | None = None
    impact: Impact | None = None
    pivot: Pivot | None = None
    ranking: Ranking | None = None
    suspect: Suspect | None = None
    sight: Sight | None = None
    choices: Choices | None = None
    need: Need | None = None
    staying: Staying | None = None
    contrary: Contrary | None = None
    done: tuple[QueryAction, ...] = ()  # what the ego did, where the question calls it otherwise
    cleared: int | None = None  # a vehicle in our way without which all would have been the same
    then: float | None = None  # [s] when that was or will be, where the question speaks of a time
    instant: bool = False  # the activity is what goes on at that time, whenever it began


class NoExplanation(msgspec.Struct, frozen=True, kw_only=True):
    """A refusal with the facts behind it.

    Facts, by reason:

    - did-not-happen: vehicle (0 is the ego), asked; did (True where the foil is what was done),
      happened and time [s] of what was done instead, planned (True where it is yet to come),
      what (crash, mishap, junction, roundabout, where that is what did not happen); elsewhere,
      where `happened` is the same at another time than the one asked about; times, where it
      happened less often than the question says; coming, the turn up to which the ego drives on.
    - not-applicable: asked, reason (a clause in words), time [s] of the decision.
    - unknown-vehicle: vehicle, known; where there is nobody at a place, that (as described), and
      then (True where a time was named).
    - too-little-evidence: asked, distinct, needed, coverage, rollouts.
    - effect-too-small: asked, chosen (what was done or is planned instead), delta [s].
    - outside-record, trace-gap: vehicle, time [s]; since and until [s] when there is a record;
      ahead, where the plan does not go so far.
    - out-of-scope: what.
    """

    reason: Reason
    facts: Facts = {}
    suggestions: tuple[Query, ...] = ()  # what could be asked instead


class NeedRollout(msgspec.Struct, frozen=True, kw_only=True):
    """The record lacks this foil: the app plans again from the trace and asks once more.

    See planner.trace.WhatIf. What is supposed of another vehicle is left out where it is not
    set, so that the names under which plans are kept stay what they are.
    """

    trace_id: str
    actions: tuple[Action, ...] = ()  # forced for the ego, in order
    removed: int | None = None  # a vehicle to plan without
    rollouts: int = 40
    vehicle: int | msgspec.UnsetType = msgspec.UNSET  # another vehicle that acts as supposed:
    goal: str | msgspec.UnsetType = msgspec.UNSET  # where it goes: kind of a goal, or its edge
    vehicle_actions: tuple[Action, ...] | msgspec.UnsetType = msgspec.UNSET  # what it does first
