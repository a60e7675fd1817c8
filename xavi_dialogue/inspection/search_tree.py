"""The search tree of a decision, rebuilt from its recorded rollouts.

Rewards are recorded as the search learned them, so replaying its back-ups gives the same values.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from planner.record.trace import ACTIONS, OUTCOMES, Action, HoldUp, Outcome, PlanTrace, Rollout
from planner.search.tree import Node, Tree
from xavi_dialogue.process.exit_status import UsageFault

DEEPEST = 32  # macro actions in a row; the search takes far fewer


class TreeError(UsageFault):
    """Rollouts that cannot come from a search."""


@dataclass(frozen=True, slots=True)
class Hindrance:
    """The frequency and duration of hold-ups by one vehicle in one way."""

    vehicle: int
    how: HoldUp
    share: float  # of the rollouts
    seconds: float  # [s] mean of those rollouts


@dataclass(frozen=True, slots=True)
class Branch:
    """A node of the search tree, with the results of the rollouts through it."""

    actions: Node  # actions that lead to it; () for the root
    visits: int  # rollouts of the search
    forced: int  # rollouts that were added
    value: float | None  # in the search; None at the root, and if all were forced
    alike: float | None  # of first actions only: mean reward over the samples tried with all
    mean: float | None  # mean reward, including forced rollouts; None without rollouts
    outcomes: Mapping[Outcome, int]
    time: float | None  # [s] mean time to the goal of those that reach it
    held_up: tuple[Hindrance, ...]  # the most frequent first
    refused: tuple[tuple[str, tuple[Action, ...]], ...]  # reason, and the actions that it bars
    chosen: bool  # whether it is part of the plan
    children: tuple["Branch", ...]  # the chosen one first, then the most visited


@dataclass(frozen=True, slots=True)
class _Record:
    """A trace, ordered for the tree."""

    trace: PlanTrace
    through: Mapping[Node, Sequence[Rollout]]
    below: Mapping[Node, Sequence[Action]]
    tree: Tree
    alike: Mapping[Action, float]
    plan: Node


def grow(trace: PlanTrace) -> Branch:
    """Return the root of a trace's search tree.

    Raises:
        TreeError: a rollout takes more actions than any search does.
    """
    nodes = [_actions(rollout) for rollout in trace.rollouts]
    longest = max((len(node) for node in nodes), default=0)
    if longest > DEEPEST:
        raise TreeError(f"{longest} actions in a row; at most {DEEPEST} can be shown")
    through: dict[Node, list[Rollout]] = {(): []}
    below: dict[Node, list[Action]] = {}
    for node, rollout in zip(nodes, trace.rollouts, strict=True):
        for depth in range(len(node) + 1):
            prefix = node[:depth]
            if prefix not in through:
                below.setdefault(prefix[:-1], []).append(prefix[-1])
            through.setdefault(prefix, []).append(rollout)
    plan = tuple(planned.action for planned in trace.plan)
    return _branch(_Record(trace, through, below, replayed(trace), compared(trace), plan), ())


def replayed(trace: PlanTrace) -> Tree:
    """Return the search's own tree: its rollouts backed up once more."""
    tree = Tree()
    for rollout in trace.rollouts:
        if not rollout.forced:
            tree.back_up(_actions(rollout), rollout.reward)
    return tree


def compared(trace: PlanTrace) -> dict[Action, float]:
    """Return the expected reward of each first action over the joint samples tried with all.

    Older traces hold no weights: there, these rollouts follow upon those of the search, so many
    of each first action in turn, and count alike. Where the record holds none, the result is
    empty.
    """
    found: dict[Action, float] = {}
    for one in trace.rollouts:
        action = _first(one)
        if one.weight is not None and action is not None:
            found[action] = found.get(action, 0.0) + one.weight * one.reward
    return found or _alike(trace)


def _alike(trace: PlanTrace) -> dict[Action, float]:
    """Return the same from a trace without weights."""
    drawn = [rollout for rollout in trace.rollouts if not rollout.forced]
    added = trace.rollouts[len(drawn) :]
    rivals = [action for action in ACTIONS if any(_first(one) == action for one in drawn)]
    if len(rivals) < 2 or not added:
        return {}
    count = min(max(trace.settings.comparisons, 1), len(drawn)) if trace.predictions else 1
    blocks = [added[k * count : (k + 1) * count] for k in range(len(rivals))]
    firsts = [{_first(one) for one in block} for block in blocks]
    if firsts != [{action} for action in rivals]:
        return {}
    return {
        action: sum(one.reward for one in block) / len(block)
        for action, block in zip(rivals, blocks, strict=True)
    }


def _branch(record: _Record, node: Node) -> Branch:
    rollouts = record.through[node]
    drawn = sum(not rollout.forced for rollout in rollouts)
    edge = record.tree.edges.get(node[:-1], {}).get(node[-1]) if node else None
    times = [time for one in rollouts if (time := one.components.get("time")) is not None]
    children = [_branch(record, (*node, action)) for action in record.below.get(node, ())]
    return Branch(
        actions=node,
        visits=drawn,
        forced=len(rollouts) - drawn,
        value=None if edge is None else edge.value,
        alike=record.alike.get(node[0]) if len(node) == 1 else None,
        mean=_mean([rollout.reward for rollout in rollouts]),
        outcomes=_outcomes(rollouts),
        time=_mean(times),
        held_up=hindrances(rollouts),
        refused=_refused(record.trace, node),
        chosen=bool(node) and record.plan[: len(node)] == node,
        children=tuple(sorted(children, key=_rank)),
    )


def _rank(branch: Branch) -> tuple[bool, int, int]:
    return not branch.chosen, -branch.visits, ACTIONS.index(branch.actions[-1])


def _actions(rollout: Rollout) -> Node:
    return tuple(step.action for step in rollout.actions)


def _first(rollout: Rollout) -> Action | None:
    return rollout.actions[0].action if rollout.actions else None


def _outcomes(rollouts: Sequence[Rollout]) -> dict[Outcome, int]:
    counted = Counter(rollout.outcome for rollout in rollouts)
    return {outcome: counted[outcome] for outcome in OUTCOMES if counted[outcome]}


def hindrances(rollouts: Sequence[Rollout]) -> tuple[Hindrance, ...]:
    """Return who held the ego up in some rollouts, and how, the most frequent first."""
    seconds: dict[tuple[int, HoldUp], list[float]] = {}
    for rollout in rollouts:
        each: dict[tuple[int, HoldUp], float] = {}
        for stretch in rollout.held_up:
            key = (stretch.vehicle, stretch.how)
            each[key] = each.get(key, 0.0) + stretch.until - stretch.since
        for key, long in each.items():
            seconds.setdefault(key, []).append(long)
    found = [
        Hindrance(vehicle, how, len(long) / len(rollouts), sum(long) / len(long))
        for (vehicle, how), long in seconds.items()
    ]
    return tuple(sorted(found, key=lambda one: (-one.share, one.vehicle, one.how)))


def _refused(trace: PlanTrace, node: Node) -> tuple[tuple[str, tuple[Action, ...]], ...]:
    by_reason: dict[str, list[Action]] = {}
    for entry in trace.not_applicable:
        if entry.node == node:
            by_reason.setdefault(entry.reason, []).append(entry.action)
    return tuple((reason, tuple(actions)) for reason, actions in by_reason.items())


def _mean(values: Sequence[float]) -> float | None:
    return sum(values) / len(values) if values else None
