"""Landmarks: when the ego came through junctions and roundabouts, or is to come through them.

The record holds no map: a junction is where the ego turned, crossed or gave way; a roundabout is
one where the roads that others may take were its exits, or where the ego went past one.
"""

from collections.abc import Sequence

from xavi_dialogue.explain.deeds import Span
from xavi_dialogue.explain.present import CROSSINGS, upcoming
from xavi_dialogue.explain.query import QueryAction
from xavi_dialogue.explain.ride import Deed, Ride

SAME = 15.0  # [s] between giving way and the turn that it was for
APART = 5.0  # [s] between two parts of the way round a roundabout, at the most


def junctions(ride: Ride, last: float) -> list[Span]:
    """When the ego came through junctions [s], oldest first.

    Where it has not come through any, but is on its way to one, that begins at the last moment.

    Args:
        ride: the record.
        last: [s] up to which it goes.
    """
    turns = [_span(deed, last) for deed in _crossed(ride)]
    waits = [
        (event.sim_time, event.sim_time)
        for event in ride.events
        if event.kind == "gave-way"
        and not any(s - SAME <= event.sim_time <= e for s, e in turns)
        and not _approaching(ride)
    ]
    found = sorted([*turns, *waits])
    return [(last, last)] if not found and _approaching(ride) else found


def roundabouts(ride: Ride, last: float) -> list[Span]:
    """The same of roundabouts; to go past exits and to take one is one stretch."""
    merged: list[Span] = []
    for deed in _crossed(ride):
        start, end = _span(deed, last)
        if not _is_ring(ride, deed.action, start):
            continue
        if merged and start - merged[-1][1] <= APART:
            merged[-1] = (merged[-1][0], end)
        else:
            merged.append((start, end))
    coming = ride.under_way if _approaching(ride) else None
    if not merged and coming is not None and _is_ring(ride, coming.action, last):
        return [(last, last)]
    return merged


def crossing_ahead(ride: Ride, *, ring: bool) -> Span | None:
    """When [s] the plan leads through the next junction, or roundabout; None where it does not."""
    steps = [step for step in upcoming(ride) if step.action in CROSSINGS]
    if not steps or (ring and not any(_is_ring(ride, s.action, ride.now) for s in steps)):
        return None
    last = steps[0]
    for step in steps[1:]:
        if last.action != "continue-next-exit":
            break
        last = step
    return steps[0].moment, last.moment


def _crossed(ride: Ride) -> Sequence[Deed]:
    return [d for d in ride.deeds if d.action in CROSSINGS and d.committed is not None]


def _approaching(ride: Ride) -> bool:
    deed = ride.under_way
    return deed is not None and deed.action in CROSSINGS and deed.committed is None


def _span(deed: Deed, last: float) -> Span:
    return deed.time, last if deed.ended is None else deed.ended


def _is_ring(ride: Ride, action: QueryAction, time: float) -> bool:
    """Whether a turn at a time [s] is at a roundabout."""
    trace = ride.at(time)
    known = () if trace is None else trace.predictions
    places = [goal.place for one in known for goal in one.goals]
    return action == "continue-next-exit" or any("roundabout" in place for place in places)
