"""The first actions that a decision compared, by the weights of samples and as answers state them.

The decision weighs the rollouts that carry a weight alone. Answers rest on all rollouts of the same
plan, so their estimates differ where not all samples could be tried; docs/causal.md says how.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from planner.record.trace import ACTIONS, OUTCOMES, Action, Outcome, PlanTrace, Rollout
from xavi_dialogue.causal.model import CausalError, CausalModel, Intervention
from xavi_dialogue.explain.causes.plans.chances import chances


@dataclass(frozen=True, slots=True)
class Option:
    """A first action that a decision weighed."""

    action: Action  # the first one
    value: float  # [s] mean reward by the weights; higher is better
    chances: Mapping[Outcome, float]  # of each outcome that occurred, by the weights
    time: float | None  # [s] mean to the goal of what reaches it, by the weights
    samples: int  # of what others do that were tried
    told: float | None  # [s] the mean reward that answers rest on; None if they have none
    collision: float | None  # the probability of a collision that answers state
    chosen: bool  # by the decision

    def __hash__(self) -> int:
        return hash((self.action, self.value, self.samples, self.chosen))


def comparison(trace: PlanTrace) -> tuple[Option, ...]:
    """Return the first actions that a decision compared, best first; none for older traces."""
    model = CausalModel(trace)
    weighed: dict[Action, list[tuple[Rollout, float]]] = {}
    for one in trace.rollouts:
        if one.weight is not None and one.actions:
            weighed.setdefault(one.actions[0].action, []).append((one, one.weight))
    chosen = trace.plan[0].action if trace.plan else None
    found = [_compared(model, action, rows, chosen) for action, rows in weighed.items()]
    return tuple(sorted(found, key=lambda one: (-one.value, ACTIONS.index(one.action))))


def _compared(
    model: CausalModel, action: Action, rows: list[tuple[Rollout, float]], chosen: Action | None
) -> Option:
    timed = [(time, w) for one, w in rows if (time := one.components.get("time")) is not None]
    mass = sum(weight for _, weight in timed)
    known = _told(model, action)
    shares = {o: sum(w for one, w in rows if one.outcome == o) for o in OUTCOMES}
    return Option(
        action=action,
        value=sum(weight * one.reward for one, weight in rows),
        chances={outcome: min(share, 1.0) for outcome, share in shares.items() if share > 0.0},
        time=sum(time * weight for time, weight in timed) / mass if mass > 0.0 else None,
        samples=len({(one.samples, one.lights, one.phantoms) for one, _ in rows}),
        told=None if known is None else known.value,
        collision=None if known is None else chances(known).collision,
        chosen=action == chosen,
    )


def _told(model: CausalModel, action: Action) -> Intervention | None:
    try:
        return model.intervene((action,))
    except CausalError:
        return None
