"""The paper's own factorisation, beside ours for comparison: nothing is explained from it.

XAVI (Gyevnar et al. 2022) estimates p(Omega | S) by visit counts, averages rewards over whatever
the search tried (Equations 3-4), and multiplies the presence of components as if they were
independent given the actions (Equations 5-6). Where half of the rollouts reach the goal, each of
the four components that belong to it is present in half of them, and p(done) comes out as 0.5^4.
"""

import math
from collections import Counter

from planner.record.trace import OUTCOMES, Action, Component, Outcome, PlanTrace, Rollout
from xavi_dialogue.causal.influence import SMOOTHING
from xavi_dialogue.causal.model import Actions, Choice

DONE: tuple[Component, ...] = ("time", "jerk", "angular-acceleration", "curvature")


class PaperNetwork:
    """The network as the paper factorises it, from the rollouts of one decision."""

    def __init__(self, trace: PlanTrace) -> None:
        self.trace = trace

    def outcomes(self, actions: Actions) -> dict[Outcome, float]:
        """Return p(O_k = 1 | actions), each outcome for itself: they need not sum to 1."""
        rollouts = self._through(actions)
        found = {}
        for outcome in OUTCOMES:
            shares = [_share(rollouts, outcome, component) for component in _depends_on(outcome)]
            found[outcome] = math.prod(shares) if rollouts else 0.0
        return found

    def difference(self, fact: Actions, foil: Actions, component: Component) -> float | None:
        """Return E[R_c | fact] - E[R_c | foil], as Equation 8 is printed; None if c is absent."""
        one, other = self._mean(fact, component), self._mean(foil, component)
        return None if one is None or other is None else one - other

    def divergence(self, vehicle: int, choice: Choice) -> float:
        """Return D_KL[p(Omega) || p(Omega | G_i, S_i)] [bit], Equation 9, smoothed to be finite."""
        every = Counter(_plan(rollout) for rollout in self.trace.rollouts)
        some = Counter(
            _plan(rollout)
            for rollout in self.trace.rollouts
            if any(
                s.vehicle == vehicle and (s.goal, s.trajectory) == choice for s in rollout.samples
            )
        )
        p, q = (_smoothed(counts, list(every)) for counts in (every, some))
        return sum(a * math.log2(a / b) for a, b in zip(p, q, strict=True))

    def _through(self, actions: Actions) -> list[Rollout]:
        depth = len(actions)
        return [r for r in self.trace.rollouts if _plan(r)[:depth] == actions]

    def _mean(self, actions: Actions, component: Component) -> float | None:
        values = [
            v for r in self._through(actions) if (v := r.components.get(component)) is not None
        ]
        return sum(values) / len(values) if values else None


def _plan(rollout: Rollout) -> tuple[Action, ...]:
    return tuple(timed.action for timed in rollout.actions)


def _depends_on(outcome: Outcome) -> tuple[Component | None, ...]:
    """Return the components whose presence makes an outcome; None: the outcome's own penalty."""
    return DONE if outcome == "done" else (None,)


def _share(rollouts: list[Rollout], outcome: Outcome, component: Component | None) -> float:
    if component is None:
        return sum(r.outcome == outcome for r in rollouts) / max(len(rollouts), 1)
    present = sum(r.components.get(component) is not None for r in rollouts)
    return present / max(len(rollouts), 1)


def _smoothed(counts: Counter[Actions], support: list[Actions]) -> list[float]:
    total = sum(counts.values()) + SMOOTHING * len(support)
    return [(counts[plan] + SMOOTHING) / total for plan in support]
