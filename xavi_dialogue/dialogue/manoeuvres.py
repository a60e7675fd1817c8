"""Manoeuvres: the lane changes and turns that the ego carried out, derived from its events."""

from collections.abc import Iterable

from planner.record.events import Event
from planner.record.trace import Action

MANOEUVRES: tuple[Action, ...] = ("change-left", "change-right", "exit-left", "exit-right")


def carried_out(events: Iterable[Event]) -> tuple[Event, ...]:
    """Return the ends of the manoeuvres that were carried out, oldest first.

    An action that ends before it is committed was given up, and is left out.
    """
    committed = False
    ends = []
    for event in events:
        if event.kind == "action-started":
            committed = False
        elif event.kind == "action-committed":
            committed = True
        elif event.kind == "action-ended" and committed and event.action in MANOEUVRES:
            ends.append(event)
            committed = False
    return tuple(ends)
