"""Rides as tables of pandas, where it is installed."""

from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, get_args

from msgspec import UnsetType

from planner.record.events import Event
from planner.record.trace import OUTCOMES
from xavi_dialogue.library.decisions import Decision
from xavi_dialogue.library.errors import LibraryError

if TYPE_CHECKING:
    from pandas import DataFrame as DataFrame

TableName: TypeAlias = Literal["decisions", "options", "beliefs", "events"]
Row: TypeAlias = Mapping[str, Any]

NUMBERS = ("decision", "vehicle")  # of events, whole where there are some
MISSING = "tables need pandas: pip install 'xavi-dialogue[tables]'"


def table(name: TableName, decisions: Iterable[Decision], events: Iterable[Event]) -> "DataFrame":
    """Return a table of a ride.

    Raises:
        LibraryError: there is no such table, or pandas is not installed.
    """
    try:
        from pandas import DataFrame
    except ImportError as error:
        raise LibraryError(MISSING) from error
    if name not in get_args(TableName):
        raise LibraryError(f"there is no table {name!r}; use one of {get_args(TableName)}")
    if name == "events":
        found = DataFrame([_event(one) for one in events])
        return found.astype(dict.fromkeys(NUMBERS, "Int64")) if len(found) else found
    return DataFrame([row for one in decisions for row in _ROWS[name](one)])


def _decision(one: Decision) -> Iterable[Row]:
    best, *others = one.options or (None,)
    margin = best.value - others[0].value if best is not None and others else None
    yield {
        "time": one.time,
        "decision": one.number,
        "action": one.plan[0] if one.plan else "stop",
        "plan": ", ".join(one.plan),
        "value": None if best is None else best.value,
        "margin": margin,
        "rollouts": len(one.trace.rollouts),
        "trace_id": one.trace_id,
    }


def _options(one: Decision) -> Iterable[Row]:
    for option in one.options:
        yield {
            "time": one.time,
            "decision": one.number,
            "action": option.action,
            "value": option.value,
            "chosen": option.chosen,
            "arrival": option.time,
            "collision": option.collision,
            **{f"p_{name}": option.chances.get(name, 0.0) for name in OUTCOMES},
        }


def _beliefs(one: Decision) -> Iterable[Row]:
    for belief in one.beliefs:
        yield {
            "time": one.time,
            "decision": one.number,
            "vehicle": belief.vehicle,
            "goal": belief.goal,
            "place": belief.place,
            "probability": belief.probability,
        }


def _event(one: Event) -> Row:
    return {
        "time": one.sim_time,
        "event": one.kind,
        "action": one.action,
        "decision": one.decision,
        "vehicle": one.vehicle,
        "by": None if isinstance(one.by, UnsetType) else one.by,
    }


_ROWS: Mapping[str, Callable[[Decision], Iterable[Row]]] = MappingProxyType(
    {"decisions": _decision, "options": _options, "beliefs": _beliefs}
)
