"""The actions that a car carried out, as far as plan traces alone show them.

A recorded ride holds events of its own car. Other planners write no events; what was begun then
follows from the plans, what could no longer be taken back from `under_way` and from places on the
road. Times are those of the decisions, so that an event may have been up to one decision earlier.
"""

from collections.abc import Iterator, Sequence
from itertools import pairwise

from planner.record.events import Event
from planner.record.trace import Action, PlanTrace
from sim.scene import EGO

CHANGES: dict[Action, int] = {"change-left": 1, "change-right": -1}  # lanes, from the right
EXITS: tuple[Action, ...] = ("exit-left", "exit-right", "exit-straight", "continue-next-exit")


def events_of(traces: Sequence[PlanTrace]) -> tuple[Event, ...]:
    """Return the events of macro actions that traces in order of time show; none of bare plans."""
    return tuple(_events(traces)) if any(one.shows_deeds for one in traces) else ()


def _events(traces: Sequence[PlanTrace]) -> Iterator[Event]:
    if not traces or first_action(traces[0]) is None:
        return
    action, chosen, committed = first_action(traces[0]), traces[0].decision, False
    yield Event("action-started", traces[0].sim_time, action, chosen)
    for before, trace in pairwise(traces):
        if not committed and action is not None and _under_way(action, before, trace):
            committed, chosen = True, before.decision
            yield Event("action-committed", trace.sim_time, action, chosen)
        following = first_action(trace)
        done = committed and before.under_way is not None and trace.under_way is None
        if following is None or (following == action and not done):
            continue
        yield Event("action-ended", trace.sim_time, action, chosen)
        action, chosen, committed = following, trace.decision, False
        yield Event("action-started", trace.sim_time, action, chosen)


def first_action(trace: PlanTrace) -> Action | None:
    """Return the action that a decision set out on."""
    if trace.under_way is not None:
        return trace.under_way.action
    return trace.plan[0].action if trace.plan else None


def _under_way(action: Action, before: PlanTrace, trace: PlanTrace) -> bool:
    """Check whether an action that was chosen before could no longer be taken back by a trace."""
    if trace.under_way is not None and trace.under_way.action == action:
        return True
    then = None if before.road is None else before.road.places.get(EGO)
    now = None if trace.road is None else trace.road.places.get(EGO)
    if then is None or now is None:
        return False
    if action in EXITS:
        return now.in_junction and not then.in_junction
    lanes = None if then.lane is None or now.lane is None else now.lane - then.lane
    return then.edge == now.edge and lanes is not None and lanes == CHANGES.get(action)
