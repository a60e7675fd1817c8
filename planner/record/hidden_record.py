"""The record of hidden parts of the road: phantoms that might come, and hold-ups by them.

SI units. `planner.hidden_areas.phantoms` computes it.
"""

from collections.abc import Collection

import msgspec

from sim.scene import Point


class Phantom(msgspec.Struct, frozen=True, omit_defaults=True):
    """A road user who may come, unseen as yet, out of a hidden stretch of a lane.

    It is imagined at the hidden place that is nearest to the junction, driving at the limit.
    """

    lanes: tuple[str, ...]  # from where it is imagined, into the junction; never empty
    begin: float  # [m] along the first of them: the hidden stretch that it is at the end of
    end: float  # [m]
    position: Point  # [m] of its front
    heading: float  # [rad]
    speed: float  # [m/s] at which it would come
    distance: float  # [m] along its lanes to the junction's line
    hidden: float  # [m] of its road from which a vehicle would arrive before the ego is across
    rate: float  # [1/s] of vehicles on its lane
    probability: float  # that a vehicle is on that part
    junction: str
    link: int  # its way through the junction
    yields: tuple[int, ...]  # the links of the junction by which the ego would give way to it
    meets: tuple[float, ...]  # [m] behind the line, at which each of them comes to its way
    behind: int | None = None  # the vehicle that hides it, the nearest one; None: a building
    beyond: tuple[int, ...] = ()  # other vehicles that hide it, too
    walled: bool = False  # a building hides it, too, behind that vehicle

    def seen_without(self, vehicles: Collection[int]) -> bool:
        """Check whether it would be in view without some vehicles."""
        hiders = () if self.behind is None or self.walled else (self.behind, *self.beyond)
        return bool(hiders) and all(one in vehicles for one in hiders)

    @property
    def met(self) -> dict[tuple[str, int], float]:
        """Where [m] behind the line the links, as (junction, index), come to its way."""
        pairs = zip(self.yields, self.meets, strict=True)
        return {(self.junction, index): meets for index, meets in pairs}


class PhantomSample(msgspec.Struct, frozen=True):
    """Whether somebody was drawn to come, of one imagined road user."""

    phantom: int  # index into the trace's
    comes: bool


class HeldByHidden(msgspec.Struct, frozen=True):
    """A stretch of a drive that was slower because part of the road was out of sight."""

    phantom: int  # index into the trace's
    comes: bool  # True: it came and went first; False: not to be too fast if it did
    since: float = msgspec.field(name="from")  # [s] simulation time
    until: float = msgspec.field(name="to")  # [s]
