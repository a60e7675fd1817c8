"""Values of plans in a recorded decision, from its rollouts and the reward's weights alone.

It shares no code with causal, explain or nlg. Since some situations were never drawn, any mean
over a plan is an estimate. There are three common estimators, and a stated figure must agree with
one of them.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, TypeAlias, get_args

from planner.record.trace import (
    Action,
    Component,
    Costs,
    Outcome,
    PlanTrace,
    RewardTerm,
    Rollout,
)

Comfort: TypeAlias = Literal["jerk", "angular-acceleration", "curvature"]
Term: TypeAlias = Literal[
    "time", "jerk", "angular-acceleration", "curvature", "effort", "collision", "dead", "late"
]
Actions: TypeAlias = tuple[Action, ...]
Joint: TypeAlias = tuple[tuple[int, int, int] | tuple[str, int], ...]
Estimator: TypeAlias = Literal["prior", "shared", "even"]

ESTIMATORS: tuple[Estimator, ...] = ("prior", "shared", "even")
COMFORT: tuple[Comfort, ...] = ("jerk", "angular-acceleration", "curvature")
#: The reward as documented, for traces that do not record their own.
DOCUMENTED = Costs(
    {"time": 1.0, "jerk": 0.05, "angular-acceleration": 4.0, "curvature": 20.0},
    {"collision": 200.0, "dead": 150.0, "termination": 10.0},
    {"stop": 2.0, "change-left": 1.0, "change-right": 1.0},
)
OUTCOMES: dict[Outcome, Term] = {"collision": "collision", "dead": "dead", "termination": "late"}
HIDDEN = "hidden {}"  # name of a phantom, by its index in the trace
SUPPORT = 0.5  # least prior mass of a candidate, relative to the continuation with the most


@dataclass(frozen=True)
class Side:
    """A plan followed to its end: one rollout per distinct situation, with weights."""

    plan: Actions
    drives: tuple[tuple[Rollout, float], ...]  # weights sum to 1
    mass: float  # prior mass of the situations behind it
    costs: Costs  # of the reward

    @property
    def value(self) -> float:
        """Return the expected reward."""
        return sum(weight * drive.reward for drive, weight in self.drives)

    def chance(self, outcome: Outcome, struck: tuple[int, ...] = ()) -> float:
        """Return the probability of an outcome; `struck` limits whom a collision is with."""
        return sum(
            weight
            for drive, weight in self.drives
            if drive.outcome == outcome and (not struck or drive.collided_with in struck)
        )

    def mean(self, component: Component) -> float | None:
        """Return the mean time or the mean cost of a component [s], over rollouts that arrive."""
        weights = self.costs.weights
        known = [
            (weight, time if component == "time" else weights[component] * value * time)
            for drive, weight in self.drives
            if (time := drive.components["time"]) is not None
            and (value := drive.components[component]) is not None
        ]
        mass = sum(weight for weight, _ in known)
        return sum(weight * cost for weight, cost in known) / mass if mass > 0.0 else None

    @property
    def effort(self) -> float:
        """Return the mean effort [s]: what the actions of the rollouts cost by themselves."""
        return sum(weight * self.effort_of(drive) for drive, weight in self.drives)

    def effort_of(self, drive: Rollout) -> float:
        """Return what the actions of a rollout cost by themselves [s]."""
        return sum(self.costs.effort.get(step.action, 0.0) for step in drive.actions)


def recorded(fact: Side, foil: Side) -> dict[Term, float] | None:
    """Return the advantage [s] of a plan over a foil by term, as the rollouts record it.

    None if a rollout records no terms, as in old traces.
    """
    if not all(drive.terms for side in (fact, foil) for drive, _ in side.drives):
        return None
    found: dict[Term, float] = {}
    for term in get_args(RewardTerm):
        share = _recorded(foil, term) - _recorded(fact, term)
        name: Term = "late" if term == "left" else term
        found[name] = found.get(name, 0.0) + share
    return found


def _recorded(side: Side, term: RewardTerm) -> float:
    return sum(weight * drive.terms.get(term, 0.0) for drive, weight in side.drives)


def gains(fact: Side, foil: Side) -> dict[Term, float]:
    """Return the advantage [s] of a plan over a foil by the terms that answers state.

    An outcome other than arrival counts as the difference of its probabilities, times its cost
    beyond that of a rollout that arrives. Time and comfort are those of rollouts that arrive.
    """
    arrives = min(fact.chance("done"), foil.chance("done"))
    found: dict[Term, float] = {"effort": foil.effort - fact.effort}
    names: tuple[Literal["time"] | Comfort, ...] = ("time", *COMFORT)
    for name in names:
        here, there = fact.mean(name), foil.mean(name)
        found[name] = 0.0 if here is None or there is None else arrives * (there - here)
    usual = _usual(fact, foil)
    for outcome, term in OUTCOMES.items():
        found[term] = _excess(foil, outcome, usual) - _excess(fact, outcome, usual)
    return found


def _usual(fact: Side, foil: Side) -> float:
    """Return the mean cost [s] of the rollouts that arrive, on the first side that has some."""
    for side in (fact, foil):
        known = [
            (weight, -drive.reward) for drive, weight in side.drives if drive.outcome == "done"
        ]
        mass = sum(weight for weight, _ in known)
        if mass > 0.0:
            return sum(weight * cost for weight, cost in known) / mass
    return 0.0


def _excess(side: Side, outcome: Outcome, usual: float) -> float:
    return sum(
        weight * (-drive.reward - side.effort_of(drive) - usual)
        for drive, weight in side.drives
        if drive.outcome == outcome
    )


def joint(drive: Rollout) -> Joint:
    """Return the situation of a rollout: samples of vehicles, traffic lights and phantoms."""
    others = sorted((s.vehicle, s.goal, s.trajectory) for s in drive.samples)
    hidden = sorted((HIDDEN.format(s.phantom), int(s.comes)) for s in drive.phantoms)
    return (*others, *sorted((s.controller, s.course) for s in drive.lights), *hidden)


class Reckoning:
    """One recorded decision, with its rollouts by the actions that they take."""

    def __init__(self, trace: PlanTrace) -> None:
        self.trace = trace

    @property
    def plan(self) -> Actions:
        """Return the actions that were chosen."""
        return tuple(step.action for step in self.trace.plan)

    @property
    def first_actions(self) -> Actions:
        """Return the first actions that were tried, in order of first record."""
        return tuple(dict.fromkeys(r.actions[0].action for r in self.trace.rollouts if r.actions))

    def chosen(self) -> list[Side]:
        """Return the plan, as far as it was tried, by each estimator."""
        for length in range(len(self.plan), 0, -1):
            if found := self.sides(self.plan[:length]):
                return found
        return []

    def sides(self, prefix: Actions) -> list[Side]:
        """Return a plan with its best continuation, by each estimator; [] if not tried."""
        found: list[Side] = []
        for how in ESTIMATORS:
            plans = [plan for plan in self._ended if plan[: len(prefix)] == prefix]
            known = [side for plan in plans if (side := self._follow(plan, how)) is not None]
            known = [side for side in known if side.plan in self._compared] or known
            most = max((side.mass for side in known), default=0.0)
            known = [side for side in known if side.mass >= SUPPORT * most]
            if known:
                found.append(max(known, key=lambda side: (side.value, side.mass)))
        return found

    def paired(self, fact: Side, foil: Side) -> tuple[Side, Side] | None:
        """Return both sides limited to the situations tried with both, weighted by their prior."""
        here = {joint(drive): drive for drive, _ in fact.drives}
        there = {joint(drive): drive for drive, _ in foil.drives}
        both = {key: self._prior(key) for key in here if key in there}
        mass = sum(both.values())
        if mass <= 0.0:
            return None
        return (
            Side(fact.plan, tuple((here[k], w / mass) for k, w in both.items()), mass, fact.costs),
            Side(foil.plan, tuple((there[k], w / mass) for k, w in both.items()), mass, foil.costs),
        )

    @cached_property
    def situations(self) -> int:
        """Return the number of distinct situations that were simulated."""
        return len({joint(drive) for drive in self.trace.rollouts})

    @cached_property
    def _chances(self) -> dict[tuple[int, int, int] | tuple[str, int], float]:
        found: dict[tuple[int, int, int] | tuple[str, int], float] = {}
        for known in self.trace.predictions:
            for g, goal in enumerate(known.goals):
                for t, way in enumerate(goal.trajectories):
                    found[known.vehicle, g, t] = goal.probability * way.probability
        for light in self.trace.lights:
            for k, course in enumerate(light.courses):
                found[light.controller, k] = course.probability
        for k, one in enumerate(self.trace.phantoms):
            found[HIDDEN.format(k), 0] = 1.0 - one.probability
            found[HIDDEN.format(k), 1] = one.probability
        return found

    @cached_property
    def _compared(self) -> set[Actions]:
        drives = (drive for drive in self.trace.rollouts if drive.weight is not None)
        return {tuple(step.action for step in drive.actions) for drive in drives}

    @cached_property
    def _ended(self) -> dict[Actions, dict[Joint, Rollout]]:
        found: dict[Actions, dict[Joint, Rollout]] = {}
        for drive in self.trace.rollouts:
            steps = tuple(step.action for step in drive.actions)
            found.setdefault(steps, {}).setdefault(joint(drive), drive)
        return found

    @cached_property
    def _reached(self) -> dict[Actions, dict[Joint, int]]:
        found: dict[Actions, dict[Joint, int]] = {}
        for drive in self.trace.rollouts:
            steps, here = tuple(step.action for step in drive.actions), joint(drive)
            for depth in range(len(steps) + 1):
                node = found.setdefault(steps[:depth], {})
                node[here] = node.get(here, 0) + 1
        return found

    def _prior(self, key: Joint) -> float:
        return math.prod(self._chances[one] for one in key)

    def _follow(self, plan: Actions, how: Estimator) -> Side | None:
        """Follow a plan; share the mass that continues at each depth among known situations."""
        if self._reached[plan].keys() - self._ended[plan].keys():
            return None
        drives: list[tuple[Rollout, float]] = []
        mass, known = 1.0, 0.0
        for depth in range(len(plan) + 1):
            shares = self._shares(self._reached.get(plan[:depth], {}), mass, how)
            over = self._ended.get(plan[:depth], {})
            drives += [(drive, shares[key]) for key, drive in over.items()]
            known += sum(self._prior(key) for key in over)
            mass = sum(share for key, share in shares.items() if key not in over)
        total = sum(weight for _, weight in drives)
        if total <= 0.0:
            return None
        scaled = tuple((drive, weight / total) for drive, weight in drives)
        return Side(plan, scaled, known, self.trace.costs or DOCUMENTED)

    def _shares(
        self, drawn: Mapping[Joint, int], mass: float, how: Estimator
    ) -> dict[Joint, float]:
        """Share a mass among drawn situations by an estimator.

        The estimators are by prior, by draws ("even"), and that of Horvitz and Thompson.
        """
        draws = sum(drawn.values())
        if how == "even":
            return {key: mass * n / draws for key, n in drawn.items()}
        priors = {key: self._prior(key) for key in drawn}
        total = sum(priors.values())
        if how == "prior":
            return {key: mass * p / total if total else 0.0 for key, p in priors.items()}
        missing = max(mass - total, 0.0)
        odds = {key: _missed(p / mass, draws) for key, p in priors.items()} if mass > 0.0 else {}
        scale = sum(odds.values())
        if missing <= 1e-9 or scale <= 0.0:
            return priors
        return {key: p + missing * odds[key] / scale for key, p in priors.items()}


def _missed(prior: float, draws: int) -> float:
    """Return the mass of undrawn situations that a drawn one of this prior represents."""
    gone = (1.0 - min(prior, 1.0)) ** draws
    return prior * gone / (1.0 - gone) if gone < 1.0 else 0.0
