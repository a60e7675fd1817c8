"""The causal network of a decision as dense tables, for a general library of Bayesian networks.

The library is pgmpy, from the extra `compare`; making the tables does not need it. Combinations
that were not tried have the last outcome, `unknown`; our own model needs no entries for them. An
intervention sets the actions, so their tables have no effect and are uniform.
"""

import time
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.util import find_spec

import numpy as np
from numpy.typing import NDArray

from planner.record.trace import OUTCOMES, Action, PlanTrace
from xavi_dialogue.causal.model import CausalModel, Choice, plan_of

Array = NDArray[np.float64]


class Uneven(ValueError):
    """A record whose plans differ in length, so that variables would have no value."""


@dataclass(frozen=True)
class Tables:
    """One table per variable, the variable itself along the first axis, then its parents."""

    goals: tuple[Array, ...]  # p(G_i) [goals]
    choices: tuple[Array, ...]  # p(S_i | G_i) [choices, goals]
    actions: tuple[Array, ...]  # p(Omega_d | Omega_1..d-1, S) [actions, actions.., choices..]
    outcome: Array  # p(O | Omega, S) [outcomes + 1, actions.., choices..]
    names: tuple[Action, ...]  # of the actions

    @property
    def entries(self) -> int:
        """The number of entries in all tables."""
        every = (*self.goals, *self.choices, *self.actions, self.outcome)
        return sum(table.size for table in every)


def available() -> bool:
    """Check whether pgmpy can be imported."""
    return find_spec("pgmpy") is not None


def tables(trace: PlanTrace) -> Tables:
    """Return the tables of a record.

    Raises:
        Uneven: its plans differ in length.
    """
    model = CausalModel(trace)
    sides = [tuple(model.choices(vehicle)) for vehicle in model.vehicles]
    places = [{choice: k for k, choice in enumerate(side)} for side in sides]
    plans = [plan_of(rollout) for rollout in trace.rollouts]
    if len({len(plan) for plan in plans}) != 1:
        raise Uneven("plans of one length are needed")
    names = tuple(dict.fromkeys(action for plan in plans for action in plan))
    depth, sizes = len(plans[0]), [len(side) for side in sides]
    outcome = np.zeros((len(OUTCOMES) + 1, *(len(names),) * depth, *sizes))
    outcome[-1] = 1.0
    for plan, rollout in zip(plans, trace.rollouts, strict=True):
        drawn = [
            place[one.goal, one.trajectory]
            for place, one in zip(places, rollout.samples, strict=True)
        ]
        cell: tuple[int, ...] = (*(names.index(action) for action in plan), *drawn)
        outcome[-1][cell] = 0.0
        outcome[OUTCOMES.index(rollout.outcome)][cell] = 1.0
    even = (np.full((len(names),) * (d + 1) + tuple(sizes), 1.0 / len(names)) for d in range(depth))
    pairs = zip(model.vehicles, sides, strict=True)
    marginals = [_marginals(model, vehicle, side) for vehicle, side in pairs]
    return Tables(
        tuple(goal for goal, _ in marginals),
        tuple(choice for _, choice in marginals),
        tuple(even),
        outcome,
        names,
    )


def _marginals(model: CausalModel, vehicle: int, side: Sequence[Choice]) -> tuple[Array, Array]:
    """Return p(G_i) and p(S_i | G_i)."""
    chances = model.choices(vehicle)
    goals = np.zeros(1 + max(goal for goal, _ in side))
    ways = np.zeros((len(side), len(goals)))
    for k, choice in enumerate(side):
        goals[choice[0]] += chances[choice]
        ways[k, choice[0]] = chances[choice]
    return goals, ways / goals


def done_by_pgmpy(trace: PlanTrace, plan: Sequence[Action]) -> tuple[Array, float, float, int]:
    """Return p(O | do(plan)) by pgmpy, the times [s] to build and to query, and the entries.

    Raises:
        Uneven: its plans differ in length.
    """
    from pgmpy.factors.discrete import TabularCPD
    from pgmpy.inference import VariableElimination
    from pgmpy.models import DiscreteBayesianNetwork

    began = time.perf_counter()
    known = tables(trace)
    vehicles, depth = range(len(known.goals)), range(len(known.actions))
    samples = [f"S{i}" for i in vehicles]
    acts = [f"W{d}" for d in depth]
    parents = {f"W{d}": [*acts[:d], *samples] for d in depth} | {"O": [*acts, *samples]}
    parents |= {f"S{i}": [f"G{i}"] for i in vehicles}
    of = {f"G{i}": known.goals[i] for i in vehicles} | {"O": known.outcome}
    of |= {f"S{i}": known.choices[i] for i in vehicles}
    of |= {f"W{d}": known.actions[d] for d in depth}
    network = DiscreteBayesianNetwork([(a, b) for b, found in parents.items() for a in found])
    for name, table in of.items():
        size = table.shape[0]
        flat, others = table.reshape(size, -1), list(table.shape[1:])
        network.add_cpds(TabularCPD(name, size, flat, parents.get(name), others or None))
    network.check_model()
    built = time.perf_counter()
    given = {f"W{d}": known.names.index(plan[d]) for d in depth}
    query = VariableElimination(network.do(acts)).query
    values = np.asarray(query(["O"], evidence=given, show_progress=False).values)
    return values, built - began, time.perf_counter() - built, known.entries
