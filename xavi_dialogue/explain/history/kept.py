"""Kept: what follows from one decision alone, worked out once for all questions about the ride."""

from collections.abc import Callable, Hashable
from typing import TypeVar

from planner.record.trace import PlanTrace

Value = TypeVar("Value")
_NAME = "kept"  # of the attribute that holds it: traces are frozen, but have room for such


def of_decision(trace: PlanTrace, key: Hashable, work_out: Callable[[], Value]) -> Value:
    """Return what was worked out of a decision under a key before, or is now.

    It is given up together with the decision.
    """
    known: dict[Hashable, Value] = vars(trace).setdefault(_NAME, {})
    if key not in known:
        known[key] = work_out()
    return known[key]
