"""Controls: whether this program plans a decision as it is recorded, with nothing changed.

Where it does not, the ride is of another version of the planner, and a plan that is made again with
a change differs from the record by that, too.
"""

from typing import Final

from planner.counterfactuals.whatif import WhatIfError, decide_again
from planner.record.trace import Action, PlanTrace
from xavi_dialogue.report.decisions.compared import compared
from xavi_dialogue.report.ridden import Ridden

NEAR: Final = 1.0  # [s] of an expected reward: records are rounded, and leave out some of the state


def reproduced(ridden: Ridden, trace: PlanTrace) -> bool | None:
    """Check whether a decision is planned as it is recorded; None if that cannot be tried."""
    network = ridden.network
    if network is None or not trace.plan:
        return None
    try:
        again = decide_again(trace, network, trace.settings)
    except WhatIfError:
        return None
    first, there = trace.plan[0].action, _values(again)
    return first in there and abs(there[first] - _values(trace)[first]) <= NEAR


def _values(trace: PlanTrace) -> dict[Action, float]:
    """Return the expected rewards [s] of first actions, as far as the decision states them."""
    found = {
        action: sum(weight * one.reward for one, weight in rows)
        for action, rows in compared(trace).items()
    }
    for step in trace.plan[:1]:
        found.setdefault(step.action, step.value)
    return found
