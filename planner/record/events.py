"""The events of a ride: what the car did, in addition to the traces of decisions."""

from typing import Literal

import msgspec

from planner.record.trace import Action

SCHEMA = "xavi.event/1"

EventKind = Literal[
    "action-started",  # the ego begins a macro action; `decision` names the trace that chose it
    "action-committed",  # it can no longer be taken back: the lane change or turn itself begins
    "action-ended",
    "gave-way",  # the ego slowed down or waited for `vehicle` at a junction
    "stopped-at-light",  # it came to a stop at `light`, or in a queue before it
    "arrived",  # the goal is reached
    "collided",  # with `vehicle`
    "ended",  # the ride is over for another reason (duration)
]


class LightPlace(msgspec.Struct, frozen=True):
    """One place in a traffic light."""

    controller: str
    place: int


class Event(msgspec.Struct, frozen=True):
    """One thing that happened to the ego."""

    kind: EventKind
    sim_time: float  # [s]
    action: Action | None = None
    decision: int | None = None  # running number of the trace in which the action was chosen
    vehicle: int | None = None
    schema: str = SCHEMA
    light: LightPlace | msgspec.UnsetType = msgspec.UNSET
