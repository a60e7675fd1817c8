"""The search tree of MCTS: selection by UCB1, back-up by Q-learning.

Nodes are sequences of macro actions, since the others' motions differ from rollout to rollout
(open-loop search). The back-up is that of IGP2 (Albrecht et al. 2021, Algorithm 2): the last
action of a rollout learns its reward, an earlier one the value of the best action after it.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

from planner.record.trace import Action

EXPLORATION = math.sqrt(2.0)

Node = tuple[Action, ...]


@dataclass(slots=True)
class Edge:
    """The estimate of one action at one node."""

    visits: int = 0
    value: float = 0.0


@dataclass(slots=True)
class Tree:
    """Visits and values of the actions at every node."""

    edges: dict[Node, dict[Action, Edge]] = field(default_factory=dict)
    low: float = math.inf  # lowest reward so far
    high: float = -math.inf  # highest reward so far

    def select(self, node: Node, actions: Sequence[Action]) -> Action:
        """Choose the action with the highest UCB1 bound; untried ones first, in their order."""
        known = self.edges.setdefault(node, {})
        fresh = [action for action in actions if action not in known]
        if fresh:
            return fresh[0]
        total = sum(known[action].visits for action in actions)
        span = max(self.high - self.low, 1e-9)

        def bound(action: Action) -> float:
            edge = known[action]
            explore = math.sqrt(math.log(total) / edge.visits)
            return (edge.value - self.low) / span + EXPLORATION * explore

        return max(actions, key=bound)

    def back_up(self, actions: Node, reward: float) -> None:
        """Update the tree with a rollout that took `actions` and earned `reward`."""
        self.low, self.high = min(self.low, reward), max(self.high, reward)
        target = reward
        for depth in range(len(actions) - 1, -1, -1):
            node, action = actions[:depth], actions[depth]
            edge = self.edges.setdefault(node, {}).setdefault(action, Edge())
            edge.visits += 1
            edge.value += (target - edge.value) / edge.visits
            target = max(e.value for e in self.edges[node].values())

    def copy(self) -> "Tree":
        """Return an independent copy."""
        edges = {
            node: {action: Edge(edge.visits, edge.value) for action, edge in known.items()}
            for node, known in self.edges.items()
        }
        return Tree(edges, self.low, self.high)

    def greedy(self, node: Node, actions: Sequence[Action]) -> Action:
        """Return the tried action of highest value; if none was tried, the first."""
        known = self.edges.get(node, {})
        tried = [action for action in actions if action in known]
        return max(tried, key=lambda action: known[action].value, default=actions[0])

    def best(self, enough: int, node: Node = ()) -> list[tuple[Action, Edge]]:
        """Return the plan from a node on: at each node, the tried action of highest value."""
        plan: list[tuple[Action, Edge]] = []
        while self.edges.get(node):
            known = self.edges[node]
            tried = {a: e for a, e in known.items() if e.visits >= enough} or known
            action = max(tried, key=lambda a: tried[a].value)
            plan.append((action, known[action]))
            node = (*node, action)
            enough = 1
        return plan
