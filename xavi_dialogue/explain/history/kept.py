"""Kept: results that depend on one decision alone, computed once for all questions."""

from collections.abc import Callable, Hashable
from typing import TypeVar

from planner.record.trace import PlanTrace

Value = TypeVar("Value")
_NAME = "kept"  # of the attribute that holds them: traces are frozen, but have a __dict__


def of_decision(trace: PlanTrace, key: Hashable, work_out: Callable[[], Value]) -> Value:
    """Return the result for a decision under a key, computed now unless it is known.

    It is freed together with the decision.
    """
    known: dict[Hashable, Value] = vars(trace).setdefault(_NAME, {})
    if key not in known:
        known[key] = work_out()
    return known[key]
