"""MCTS over macro actions: sample the others, roll out the ego, learn.

The same seed gives the same rollouts: the generator is made from arguments alone.
"""

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from planner.actions import ActionPlan, Situation, expand
from planner.forward import Motion
from planner.recognise import Belief
from planner.reward import reward
from planner.rollout import Leg, Task, held_up, summarise, take
from planner.routes import Refusal
from planner.trace import (
    ACTIONS,
    Action,
    Component,
    HeldUp,
    NotApplicable,
    Outcome,
    PlannedAction,
    Sample,
    Settings,
)
from planner.tree import Node, Tree

ENOUGH = 0.05  # share of the rollouts that an action of the plan must have had


@dataclass(frozen=True, slots=True)
class Root:
    """Where the search begins."""

    here: Situation
    under_way: tuple[ActionPlan, Motion] | None = None  # must be finished first


@dataclass(frozen=True, slots=True, eq=False)
class Simulated:
    """One rollout."""

    forced: bool
    samples: tuple[Sample, ...]
    legs: tuple[Leg, ...]
    outcome: Outcome
    components: dict[Component, float | None]
    reward: float
    held_up: tuple[HeldUp, ...]

    @property
    def actions(self) -> Node:
        """The macro actions, in order."""
        return tuple(leg.action for leg in self.legs)


@dataclass
class Search:
    """One search, from which rollouts are drawn until the budget is spent."""

    task: Task
    root: Root
    beliefs: Mapping[int, Sequence[Belief]]
    settings: Settings
    rng: random.Random
    rollouts: list[Simulated] = field(default_factory=list)
    tree: Tree = field(default_factory=Tree)
    refusals: dict[tuple[Node, Action], str] = field(default_factory=dict)
    _plans: dict[tuple[tuple[Sample, ...], Node], ActionPlan | Refusal] = field(
        default_factory=dict
    )
    _legs: dict[tuple[tuple[Sample, ...], Node], Leg] = field(default_factory=dict)

    def run(self) -> None:
        """Draw the rollouts of the search, then those that rarely tried first actions lack."""
        for _ in range(self.settings.rollouts):
            self._roll(self.tree, (), forced=False)
        known = self.tree.edges.get((), {})
        visits = {action: edge.visits for action, edge in known.items()}
        for action in ACTIONS:
            if action in visits:
                self.force((action,), self.settings.min_rollouts - visits[action])

    def force(self, actions: Node, count: int) -> None:
        """Draw rollouts that begin with given actions, without teaching the search.

        Where one of the actions does not apply, the rollout is dropped and the reason kept.
        """
        apart = self.tree.copy()
        for _ in range(max(count, 0)):
            self._roll(apart, actions, forced=True)

    def plan(self) -> tuple[PlannedAction, ...]:
        """The chosen macro actions."""
        enough = max(1, int(ENOUGH * self.settings.rollouts))
        return tuple(
            PlannedAction(action, round(edge.value, 3), edge.visits)
            for action, edge in self.tree.best(enough)
        )

    def not_applicable(self) -> tuple[NotApplicable, ...]:
        """Why actions did not apply, by node in the order of first visit."""
        return tuple(
            NotApplicable(node, action, reason) for (node, action), reason in self.refusals.items()
        )

    def _roll(self, tree: Tree, forced_actions: Node, *, forced: bool) -> None:
        samples = self._sample()
        legs: list[Leg] = []
        outcome: Outcome | None = None
        while outcome is None:
            node = tuple(leg.action for leg in legs)
            if len(legs) >= self.settings.depth:
                outcome = "termination"
                break
            options = self._options(samples, node, legs)
            if len(node) < len(forced_actions):
                wanted = forced_actions[len(node)]
                if wanted not in options:
                    return
                options = {wanted: options[wanted]}
            if not options:
                outcome = "dead"
                break
            action = tree.select(node, list(options), self.rng)
            legs.append(self._leg(samples, (*node, action), options[action], legs))
            outcome = legs[-1].outcome
        parts = summarise(legs, outcome)
        gained = round(reward(outcome, parts), 3)
        tree.back_up(tuple(leg.action for leg in legs), gained)
        stretches = held_up(legs, self.task.start)
        self.rollouts.append(
            Simulated(forced, samples, tuple(legs), outcome, parts, gained, stretches)
        )

    def _sample(self) -> tuple[Sample, ...]:
        """Draw a goal and a trajectory for every other vehicle."""
        drawn = []
        for vehicle, beliefs in self.beliefs.items():
            goal = _draw(self.rng, [belief.probability for belief in beliefs])
            ways = [way.probability for way in beliefs[goal].trajectories]
            drawn.append(Sample(vehicle, goal, _draw(self.rng, ways)))
        return tuple(drawn)

    def _options(
        self, samples: tuple[Sample, ...], node: Node, legs: Sequence[Leg]
    ) -> dict[Action, ActionPlan]:
        """What can be done at a node that was reached under these samples."""
        options = {}
        for action in ACTIONS:
            plan = self._plan(samples, (*node, action), legs)
            if isinstance(plan, Refusal):
                self.refusals.setdefault((node, action), plan.reason)
            else:
                options[action] = plan
        return options

    def _plan(
        self, samples: tuple[Sample, ...], branch: Node, legs: Sequence[Leg]
    ) -> ActionPlan | Refusal:
        key = (samples, branch) if legs else ((), branch)
        found = self._plans.get(key)
        if found is None:
            found = self._plans[key] = self._expand(branch, legs)
        return found

    def _expand(self, branch: Node, legs: Sequence[Leg]) -> ActionPlan | Refusal:
        action = branch[-1]
        if not legs and self.root.under_way is not None:
            plan = self.root.under_way[0]
            return plan if plan.action == action else Refusal("another manoeuvre is under way")
        if branch[-2:] == ("stop", "stop"):
            return Refusal("it is standing already")
        here = legs[-1].end if legs else self.root.here
        return expand(self.task.roads, here, action, self.task.goal, self.task.view)

    def _leg(
        self, samples: tuple[Sample, ...], branch: Node, plan: ActionPlan, legs: Sequence[Leg]
    ) -> Leg:
        """The last action of a branch, driven; the same samples give the same leg."""
        found = self._legs.get((samples, branch))
        if found is None:
            obstacles = [
                self.beliefs[s.vehicle][s.goal].trajectories[s.trajectory].motion for s in samples
            ]
            if legs:
                here, first = legs[-1].end, legs[-1].first + len(legs[-1].speed) - 1
            else:
                here, first = self.root.here, 0
            motion = Motion(0.0, here.speed, here.acceleration)
            if not legs and self.root.under_way is not None:
                motion = self.root.under_way[1]
            found = self._legs[samples, branch] = take(self.task, plan, motion, first, obstacles)
        return found


def _draw(rng: random.Random, probabilities: Sequence[float]) -> int:
    return rng.choices(range(len(probabilities)), weights=probabilities)[0]
