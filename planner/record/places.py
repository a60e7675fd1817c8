"""The record of the road: the places of all road users, and the way ahead of the ego.

SI units. All of it follows from the network, the scene and the ego's plan;
`planner.search.road_facts` works it out.
"""

from typing import Literal

import msgspec

Turn = Literal["exit-left", "exit-right", "exit-straight"]
Rule = Literal["priority", "give-way", "equal"]
First = Literal["ego", "vehicle", "depends"]
JunctionKind = Literal["junction", "roundabout"]


class LightChange(msgspec.Struct, frozen=True):
    """The lights that a vehicle shows from a moment on."""

    time: float  # [s] simulation time
    shown: tuple[str, ...]  # of left, right, brake; () none


class RoadPlace(msgspec.Struct, frozen=True):
    """The place of a vehicle on the road; inside a junction, on the road that it leads to."""

    edge: str
    lane: int | None  # from the right, 0 the rightmost for cars; None inside a junction
    lanes: int  # that cars may use in this direction
    limit: float  # [m/s] speed limit
    in_junction: bool  # inside a junction in the sense of passengers
    roundabout: bool  # on the ring of a roundabout, including its junctions


class RouteStep(msgspec.Struct, frozen=True):
    """A junction on the ego's way to its destination; a roundabout is one of them."""

    distance: float  # [m] from the front bumper to its entry; from within a ring, to the exit
    kind: JunctionKind
    turn: Turn  # of a roundabout, how the road after it leads on from the one before
    exit: int | None  # of a roundabout: number of the exit taken, 1 for the first one
    exits: int | None  # of a roundabout: how many there are once round
    arms: int  # roads that lead away, including the one back
    rule: Rule  # the ego goes first; has to give way to some; right before left


class PriorityFact(msgspec.Struct, frozen=True):
    """The right of way where the ways of the ego and of another may cross or merge."""

    vehicle: int
    who: First  # depends: on where that vehicle goes, or on who comes first


class LightAhead(msgspec.Struct, frozen=True):
    """A traffic light in view on the ego's way."""

    distance: float  # [m] from the front bumper to the junction's entry
    controller: str
    place: int  # in the controller's state
    state: str  # a letter; see planner.traffic_lights.signals
    since: float  # [s] when it was first seen to be so
    change_seen: bool  # whether it changed to this then, or only came into view


class RoadFacts(msgspec.Struct, frozen=True, omit_defaults=True):
    """The road around the ego at one decision, and ahead of it."""

    places: dict[int, RoadPlace]  # of those in the scene that are on a lane
    route: tuple[RouteStep, ...] = ()  # nearest first, at most 8
    distance: float | None = None  # [m] along the road to the destination; None: no way there
    free_time: float | None = None  # [s] to it at the limits, and as bends allow
    priority: tuple[PriorityFact, ...] = ()  # at the junction that the ego is in or comes to next
    lights: tuple[LightAhead, ...] = ()  # nearest first
