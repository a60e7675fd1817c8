"""The events of a ride: what the car did, in addition to the traces of decisions."""

from typing import Annotated, Literal

import msgspec

from planner.record.trace import Action

SCHEMA = "xavi.event/1"
SETTLED = 0.3  # [s] that a restraint lasts before it is recorded

EventKind = Literal[
    "action-started",  # the ego begins a macro action; `decision` names the trace that chose it
    "action-committed",  # it can no longer be taken back: the lane change or turn itself begins
    "action-ended",
    "gave-way",  # the ego slowed down or waited for `vehicle`, and no light held it
    "stopped-at-light",  # it came to a stop at `light`, or in a queue before it
    "restrained",  # from now on `by` keeps the ego from driving faster
    "arrived",  # the goal is reached
    "collided",  # with `vehicle`
    "ended",  # the ride is over for another reason (duration)
]


#: What keeps the ego from driving faster in a step: another road user (`vehicle`), as in HoldUp ...
RestraintKind = Literal[
    "leader",
    "right-of-way",
    "cut-in",
    "blocked",
    "moves-in",  # `vehicle` is expected to come into the lane
    "stands-first",  # `vehicle` stands at a junction ahead, and has the right of way
    "beside-crossing",  # a vehicle waits on the next lane at a crossing, and may hide people
    # ... or what is on the road, or was decided.
    "light",  # `light`; with `vehicle`, the queue before it
    "hidden",  # a part of the road that cannot be seen
    "bend",  # a bend or a turn
    "limit",  # the speed limit
    "road-end",  # the lane ends
    "stop",  # the macro action is to stop
    "nothing",  # it speeds up freely
]


class LightPlace(msgspec.Struct, frozen=True):
    """One place in a traffic light."""

    controller: str
    place: int


class Event(msgspec.Struct, frozen=True, repr_omit_defaults=True):
    """One thing that happened to the ego."""

    kind: EventKind  # what happened
    sim_time: Annotated[float, msgspec.Meta(ge=0.0, le=1e7)]  # [s] when it happened
    action: Action | None = None  # of the ego, which it began, ended or carried out
    decision: int | None = None  # running number of the trace in which the action was chosen
    vehicle: int | None = None  # the number of the other one
    schema: str = SCHEMA  # of this record
    light: LightPlace | msgspec.UnsetType = msgspec.UNSET  # of a stop or restraint, if any
    by: RestraintKind | msgspec.UnsetType = msgspec.UNSET  # of "restrained"
