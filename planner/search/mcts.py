"""MCTS over macro actions: sample the others, simulate the ego, update the tree.

The same seed gives the same rollouts, since random generators depend on arguments alone.
"""

import random
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeAlias

from planner.hidden_areas.caution import coming, held_by_hidden, name_of
from planner.kernels.limits import GAP_HORIZON
from planner.manoeuvres.actions import ActionPlan, Situation, expand
from planner.motion.forward import Motion
from planner.motion.obstacles import Obstacle, Pool, Traffic
from planner.prediction.recognise import Belief
from planner.record.hidden_record import HeldByHidden, Phantom, PhantomSample
from planner.record.light_record import LightSample
from planner.record.trace import (
    ACTIONS,
    Action,
    Component,
    NotApplicable,
    Outcome,
    PlannedAction,
    Sample,
    Settings,
)
from planner.roads.routes import Refusal
from planner.rollouts.reward import EFFORT, absent, reward, terms
from planner.rollouts.rollout import Leg, Task, held_by_lights, held_up, hindered, summarise, take
from planner.rollouts.waypoints import cost_by, cost_left
from planner.search.comparison import Samples, draw, source_of, standard_error, weighted
from planner.search.inputs import Root
from planner.search.simulated import Simulated, braking
from planner.search.tree import Edge, Node, Tree
from planner.search.trees import GrownTree
from planner.traffic_lights.signals import DARK, Lights, Outlook
from sim.roads.network import Location

Choose: TypeAlias = Callable[[Node, Sequence[Action]], Action]  # one of several, at a node
#: The plans of actions that apply at a node, and the order in which these are tried.
Options: TypeAlias = tuple[Mapping[Action, ActionPlan], tuple[Action, ...]]

LATE = 1e3  # [s] added to the cost of a stop, so that it is tried last
ENOUGH = 0.05  # minimum share of the rollouts for the first action of a plan
FATAL: tuple[Outcome, ...] = ("collision", "dead")


@dataclass
class Search:
    """One search, from which rollouts are drawn until the budget is spent."""

    task: Task
    root: Root
    beliefs: Mapping[int, Sequence[Belief]]
    settings: Settings
    seed: str  # of all random draws
    lights: Outlook = DARK
    phantoms: tuple[Phantom, ...] = ()
    rollouts: list[Simulated] = field(default_factory=list)
    tree: Tree = field(default_factory=Tree)
    refusals: dict[tuple[Node, Action], str] = field(default_factory=dict)
    compared: dict[Action, float] = field(default_factory=dict)  # expected reward by action
    _plans: dict[tuple[Samples, Node], Options] = field(default_factory=dict)
    _expanded: dict[tuple[Situation, Action], ActionPlan | Refusal] = field(default_factory=dict)
    _legs: dict[tuple[Samples, Node], Leg] = field(default_factory=dict)
    _known: dict[tuple[Samples, Node], Simulated] = field(default_factory=dict)
    _motions: dict[Samples, Traffic] = field(default_factory=dict)
    _lit: dict[tuple[int, ...], Lights] = field(default_factory=dict)  # by courses
    _pool: Pool = field(default_factory=Pool)
    _imagined: dict[int, Obstacle] = field(default_factory=dict)  # by index
    # By road user, controller and phantom, so that one's draws do not shift another's.
    _draws: dict[int | str, random.Random] = field(init=False)

    def __post_init__(self) -> None:
        names: tuple[int | str, ...] = (
            *self.beliefs,
            *(one.controller for one in self.lights.varying),
            *(source_of(k) for k in range(len(self.phantoms))),
        )
        self._draws = {name: random.Random(f"{self.seed}/{name}") for name in names}

    def grow(self, rollouts: int) -> None:
        """Run rollouts that the tree learns from."""
        for _ in range(rollouts):
            drawn = draw(self.beliefs, self._draws, self.lights, self.phantoms)
            self._learn(self.tree, drawn, (), forced=False)

    def join(self, other: GrownTree) -> None:
        """Add the rollouts of another tree, as if this one had learnt from them."""
        for one in other.rollouts:
            self.rollouts.append(one)
            self.tree.back_up(one.actions[: self.settings.depth], one.reward)
        for where, reason in other.refusals.items():
            self.refusals.setdefault(where, reason)

    def conclude(self) -> None:
        """Compare the first actions, and force missing rollouts."""
        self._compare()
        tried = Counter(rollout.actions[0] for rollout in self.rollouts if rollout.legs)
        for action in self._first_actions():
            self.force((action,), self.settings.min_rollouts - tried[action])

    def force(self, actions: Node, count: int) -> None:
        """Run rollouts that begin with given actions, without an effect on the search tree.

        If one of the actions does not apply, the rollout is dropped and the reason kept.
        """
        apart = self.tree.copy()
        for _ in range(max(count, 0)):
            drawn = draw(self.beliefs, self._draws, self.lights, self.phantoms)
            self._learn(apart, drawn, actions, forced=True)

    def _compare(self) -> None:
        """Drive the best continuation of every first action under the same samples.

        Values in the tree are distorted by exploration, and each action met other samples there.
        The choice therefore depends on expected rewards under common samples.
        """
        rivals = self._first_actions()
        if len(rivals) < 2:
            return
        drawn = [rollout.drawn for rollout in self.rollouts]
        most = self.settings.comparisons
        common = weighted(self.beliefs, drawn, most, self.lights, self.phantoms)
        for action in rivals:
            self.compared[action] = 0.0
            for samples, weight in common:
                one = self._roll(samples, self._greedily(action), forced=True, weight=weight)
                assert one is not None  # a first action applies whatever the others do
                self.compared[action] += weight * one.reward

    def _greedily(self, first: Action) -> Choose:
        return lambda node, options: self.tree.greedy(node, options) if node else first

    def _first_actions(self) -> list[Action]:
        """Return the first actions that were tried, in a fixed order."""
        known = self.tree.edges.get((), {})
        return [action for action in ACTIONS if action in known]

    def plan(self) -> tuple[PlannedAction, ...]:
        """Return the chosen macro actions."""
        enough = max(1, int(ENOUGH * self.settings.rollouts))
        if not self.compared:
            return _planned(self.tree.best(enough))
        first = self._preferred()
        visits = self.tree.edges[()][first].visits
        rest = self.tree.best(1, (first,))
        return (
            PlannedAction(first, round(self.compared[first], 3), visits),
            *_planned(rest),
        )

    def _preferred(self) -> Action:
        """Return the best first action, or the one that is being driven if it is as good.

        It is as good if the best one leads by no more than the standard error of the difference
        and is no safer.
        """
        best, kept = max(self.compared, key=lambda action: self.compared[action]), self.root.driving
        if kept is None or kept not in self.compared:
            return best
        tried = [one for one in self.rollouts if one.weight is not None]
        ours, theirs = ([one for one in tried if one.actions[0] == a] for a in (kept, best))
        losses = [b.reward - a.reward for a, b in zip(ours, theirs, strict=True)]
        weights = [one.weight or 0.0 for one in ours]
        ahead = self.compared[best] - self.compared[kept]
        if ahead <= standard_error(weights, losses) and _risk(ours) <= _risk(theirs):
            return kept
        return best

    def not_applicable(self) -> tuple[NotApplicable, ...]:
        """Return why actions did not apply, by node in the order of first visit."""
        return tuple(
            NotApplicable(node, action, reason) for (node, action), reason in self.refusals.items()
        )

    def _learn(self, tree: Tree, samples: Samples, begin: Node, *, forced: bool) -> None:
        """Run a rollout that begins with given actions and follows a tree; then update the tree."""

        def choose(node: Node, options: Sequence[Action]) -> Action:
            if len(node) < len(begin):
                return begin[len(node)]
            return tree.select(node, options)

        one = self._roll(samples, choose, forced=forced)
        if one is not None:
            tree.back_up(one.actions[: self.settings.depth], one.reward)

    def _roll(
        self, samples: Samples, choose: Choose, *, forced: bool, weight: float | None = None
    ) -> Simulated | None:
        """Run and keep a rollout; return None, and keep nothing, if an action does not apply."""
        legs: list[Leg] = []
        outcome: Outcome | None = None
        while outcome is None:
            node = tuple(leg.action for leg in legs)
            options, inviting = self._options(samples, node, legs)
            if not inviting:
                outcome = "dead"
                break
            searched = len(legs) < self.settings.depth
            action = choose(node, inviting) if searched else inviting[0]
            if action not in options:
                return None
            legs.append(self._leg(samples, (*node, action), options[action], legs))
            outcome = legs[-1].outcome
        one = replace(self._simulated(samples, legs, outcome), forced=forced, weight=weight)
        self.rollouts.append(one)
        return one

    def _simulated(self, samples: Samples, legs: Sequence[Leg], outcome: Outcome) -> Simulated:
        """Return the result of a rollout; equal actions under equal samples share one result."""
        key = (samples, tuple(leg.action for leg in legs))
        found = self._known.get(key)
        if found is None:
            parts = summarise(self.task, legs)
            effort = sum(EFFORT.get(leg.action, 0.0) for leg in legs)
            left = self._left(() if outcome == "dead" else legs)
            spent = terms(outcome, parts, left, effort)
            gained = round(reward(spent), 3)
            stretches = held_up(legs, self.task.start)
            stops = held_by_lights(legs, self.task.start)
            slow = self._held_by_hidden(legs)
            shown: dict[Component, float | None] = absent() if outcome != "done" else {**parts}
            row = tuple(legs)
            brakes = braking(row)
            found = Simulated(
                samples, row, outcome, shown, gained, spent, stretches, stops, slow, brakes
            )
            self._known[key] = found
        return found

    def _invites(self, plan: ActionPlan) -> float:
        """Return an estimate of the cost [s] of a plan and the way from its end if all is free.

        The search tries actions in this order. Beyond its depth, a rollout takes the first one.
        """
        effort = EFFORT.get(plan.action, 0.0)
        if plan.stops:
            return effort + LATE
        lane, begin = plan.path.lane_at(plan.end)
        pace = self.task.roads.network.lanes[lane].speed_limit
        if plan.goal is not None:
            return effort + plan.goal / pace
        end = Location(lane, plan.end - begin, 0.0)
        return effort + plan.end / pace + cost_left(self.task.roads, end, self.task.goal)

    def _left(self, legs: Sequence[Leg]) -> float:
        """Return the cost [s] of the way to the goal after these legs if nobody is in the way.

        If time ran out within an action, that is the rest of the action and the way from its end.
        """
        end, ahead = (legs[-1].end, legs[-1].ahead) if legs else (self.root.here, ())
        return cost_by(self.task.roads, end.location, ahead, self.task.goal)

    def _options(self, samples: Samples, node: Node, legs: Sequence[Leg]) -> Options:
        """Return the options at a node that was reached under these samples.

        Costs are ordered to the microsecond, since their last digits differ between processors.
        """
        key = (samples, node) if legs else ((), node)
        found = self._plans.get(key)
        if found is None:
            options = {}
            for action in ACTIONS:
                plan = self._expand((*node, action), legs)
                if isinstance(plan, Refusal):
                    self.refusals.setdefault((node, action), plan.reason)
                else:
                    options[action] = plan
            inviting = sorted(options, key=lambda action: round(self._invites(options[action]), 6))
            found = self._plans[key] = (options, tuple(inviting))
        return found

    def _expand(self, branch: Node, legs: Sequence[Leg]) -> ActionPlan | Refusal:
        action = branch[-1]
        if not legs and self.root.under_way is not None:
            plan = self.root.under_way[0]
            return plan if plan.action == action else Refusal("another manoeuvre is under way")
        if branch[-2:] == ("stop", "stop"):
            return Refusal("it is standing already")
        here = legs[-1].end if legs else self.root.here
        found = self._expanded.get((here, action))
        if found is None:
            found = expand(self.task.roads, here, action, self.task.goal, self.task.view)
            self._expanded[here, action] = found
        return found

    def _leg(self, samples: Samples, branch: Node, plan: ActionPlan, legs: Sequence[Leg]) -> Leg:
        """Return the leg of the last action of a branch; the same samples give the same leg."""
        found = self._legs.get((samples, branch))
        if found is None:
            here, first, traffic = self.root.here, 0, self._traffic(samples)
            if legs:
                last = legs[-1]
                here, first, traffic = last.end, last.first + len(last.speed) - 1, last.traffic
            motion = Motion(0.0, here.speed, here.acceleration)
            if not legs and self.root.under_way is not None:
                motion = self.root.under_way[1]
            found = self._legs[samples, branch] = take(self.task, plan, motion, first, traffic)
        return found

    def _traffic(self, samples: Samples) -> Traffic:
        """Return the others' motions as sampled."""
        found = self._motions.get(samples)
        if found is None:
            courses = self.lights.courses(s for s in samples if isinstance(s, LightSample))
            motions = [
                self.beliefs[s.vehicle][s.goal].trajectories[s.trajectory].motions.under(courses)
                for s in samples
                if isinstance(s, Sample)
            ]
            motions += [
                self._comes(s.phantom) for s in samples if isinstance(s, PhantomSample) and s.comes
            ]
            if courses not in self._lit:
                self._lit[courses] = self.lights.lights(courses, self.task.horizon + GAP_HORIZON)
            found = self._motions[samples] = Traffic.of(motions, self._lit[courses], self._pool)
        return found

    def _held_by_hidden(self, legs: Sequence[Leg]) -> tuple[HeldByHidden, ...]:
        if not self.phantoms:
            return ()
        careful = tuple(pair for leg in legs for pair in leg.careful)
        start = self.task.start
        return held_by_hidden(self.phantoms, hindered(legs, start), careful, start)

    def _comes(self, phantom: int) -> Obstacle:
        """Return the motion of a phantom that comes."""
        found = self._imagined.get(phantom)
        if found is None:
            steps = self.task.horizon + GAP_HORIZON
            one, roads = self.phantoms[phantom], self.task.roads
            found = self._imagined[phantom] = coming(roads, one, name_of(phantom), steps)
        return found


def _risk(tried: Sequence[Simulated]) -> float:
    """Return the probability of a collision, or of losing the way."""
    return round(sum(one.weight or 0.0 for one in tried if one.outcome in FATAL), 6)


def _planned(best: Sequence[tuple[Action, Edge]]) -> tuple[PlannedAction, ...]:
    return tuple(PlannedAction(action, round(edge.value, 3), edge.visits) for action, edge in best)
