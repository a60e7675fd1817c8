"""Deeds: the macro actions that the ego carried out, from its events."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from planner.record.events import Event
from planner.record.trace import Action


@dataclass(frozen=True, slots=True)
class Deed:
    """One macro action of the ego, from its events."""

    action: Action
    decision: int | None  # the decision that chose it
    started: float  # [s]
    committed: float | None = None  # [s] when it could no longer be taken back
    ended: float | None = None  # [s] None while it is under way

    @property
    def time(self) -> float:
        """The time [s] at which it was decided for good."""
        return self.started if self.committed is None else self.committed

    @property
    def span(self) -> tuple[float, float]:
        """The begin and end [s]; the end is infinite as long as it is under way."""
        return self.time, math.inf if self.ended is None else self.ended

    @property
    def carried_out(self) -> bool:
        """Whether it was done or is being done; a turn still to come is neither."""
        if self.committed is not None or self.action in ("continue", "stop"):
            return True
        return self.ended is None and not self.action.startswith("exit")


def read_deeds(events: Sequence[Event]) -> list[Deed]:
    """Return the actions that the ego began, oldest first, including those that it gave up."""
    found: list[Deed] = []
    for event in events:
        last = found[-1] if found and found[-1].ended is None else None
        if event.kind == "action-started" and event.action is not None:
            if last is not None:
                found[-1] = replace(last, ended=event.sim_time)
            found.append(Deed(event.action, event.decision, event.sim_time))
        elif last is None or event.action not in (None, last.action):
            continue
        elif event.kind == "action-committed":
            chosen = last.decision if event.decision is None else event.decision
            found[-1] = replace(last, committed=event.sim_time, decision=chosen)
        elif event.kind in ("action-ended", "arrived", "collided", "ended"):
            found[-1] = replace(last, ended=event.sim_time)
    return found
