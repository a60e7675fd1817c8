"""What else might have been: changes of the world, and other options, as frozen values.

SI units, seconds of simulation time.
"""

from typing import Literal

import msgspec

from planner.record.light_record import LightSupposed
from planner.record.trace import Action, HoldUp
from xavi_dialogue.report.figures import Figure, Source

Mishap = Literal["collide", "brake", "stop"]  # stop: at a traffic light


class Supposed(msgspec.Struct, frozen=True, omit_defaults=True):
    """One change of the world: a vehicle is away or does something else, a light differs."""

    kind: Literal["absent", "pair", "empty", "goal", "light", "in-view"]
    vehicle: int | None = None
    goal: Action | None = None
    place: str = ""  # of the goal, in words
    lights: tuple[LightSupposed, ...] = ()
    phantoms: tuple[int, ...] = ()
    prior: Figure | None = None  # its probability in the decision
    pair: tuple[int, ...] = ()  # those that are away together


class Tested(msgspec.Struct, frozen=True):
    """What planning again with a change gives."""

    supposed: Supposed
    decision: int
    plan: tuple[Action, ...]  # () if it could not be planned
    same: bool | None  # whether the first action stays the same
    reward: Figure | None  # [s] expected
    collision: Figure | None
    braking: Figure | None  # [m/s2] hardest
    time: Figure | None  # [s] to the goal
    trace: str | None  # id of the plan made again
    refused: str = ""  # why it could not be planned


class Holding(msgspec.Struct, frozen=True):
    """Who or what holds the car up under the plan of a decision, by its rollouts."""

    vehicle: int | None  # None: a light, or a hidden part of the road
    how: HoldUp | Literal["light", "hidden"]
    expected: Figure  # [s]
    share: Figure  # probability that it does
    speeds: tuple[float, float] | None = None  # [m/s] of that vehicle: when it begins, lowest


class Cases(msgspec.Struct, frozen=True):
    """The changes that were tested at one decision, with what it was without any."""

    decision: int
    time: float  # [s]
    plan: tuple[Action, ...]
    reward: Figure | None  # [s] expected
    collision: Figure | None
    braking: Figure | None
    arrival: Figure | None  # [s] to the goal
    held: tuple[Holding, ...]  # longest first
    tested: tuple[Tested, ...]
    reproduced: bool | None = None  # whether this program plans it as recorded; None: not tried


class Way(msgspec.Struct, frozen=True):
    """An option of an earlier decision, and whether it leads to the mishap."""

    action: Action
    chosen: bool
    believed: Figure | None  # probability of the mishap by the rollouts
    replayed: Figure | None  # share of its lines that touch the others as they drove
    clearance: Figure | None  # [m] least distance to them, in its likeliest line
    braking: Figure | None  # [m/s2] hardest
    collision: Figure | None  # probability of a collision with anybody by the rollouts
    off_route: Figure | None  # probability that it loses the way to the goal
    planned: bool  # whether rollouts were added by planning again
    avoids: bool | None


class Chance(msgspec.Struct, frozen=True):
    """One earlier decision, with its options."""

    number: int
    time: float  # [s]
    ways: tuple[Way, ...]
    unknown: dict[Action, str]  # options that could not be judged, and why


class Emergency(msgspec.Struct, frozen=True):
    """The last moment from which braking at a rate would have avoided the contact."""

    rate: float  # [m/s2]
    latest: float | None  # [s] None: not within the seconds that were looked at
    before: float | None  # [s] before the contact
    looked_from: float  # [s]
    source: Source


class Passing(msgspec.Struct, frozen=True):
    """How fast the car would have had to drive from a decision on to pass a light without a stop.

    Distances are to the light; the mean speeds follow from them and from when it changed.
    """

    number: int  # of the decision
    time: float  # [s]
    distance: Figure  # [m] to the light
    speed: Figure  # [m/s] then
    limit: Figure | None  # [m/s]
    before: Figure | None  # [m/s] least mean speed to pass before it turned; None: not seen
    after: Figure | None  # [m/s] greatest mean speed to come when it let traffic go again


class LightStop(msgspec.Struct, frozen=True):
    """The light of a stop: when it turned, and how it could have been passed without one."""

    controller: str
    place: int
    turned: float | None  # [s] when its green was seen to end; None: it was not
    again: float | None  # [s] when it was seen to turn green again; None: it was not
    queue: tuple[int, ...]  # those that stood or drove between the car and the light
    passing: tuple[Passing, ...]  # oldest first


class Avoidability(msgspec.Struct, frozen=True):
    """From when the mishap could have been avoided, and how."""

    mishap: Mishap
    threshold: float | None  # [m/s2] from which braking counts
    at: float  # [s] of the mishap
    vehicle: int | None
    chances: tuple[Chance, ...]  # oldest first
    last: int | None  # the last decision with an option that avoids it ...
    last_on_route: int | None  # ... and does not lose the way to the goal
    emergency: tuple[Emergency, ...]  # of collisions
    supposed_from: float | None = None  # [s] from which on the other is not recorded any more
    light: LightStop | None = None  # of stops at a light
