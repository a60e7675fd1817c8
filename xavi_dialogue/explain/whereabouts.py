"""Who is in front, behind or at a side: descriptions that hold at one moment only.

Who fits one is found in the scene of that moment; in another scene it may be somebody else.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Literal, TypeAlias

from planner.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.explain.bearings import (
    SAME_LANE,
    Bearing,
    Place,
    Vehicles,
    bearing,
    nearest_at,
    nearest_first,
    place,
)
from xavi_dialogue.explain.query import Query

ABREAST = (math.radians(65.0), math.radians(115.0))  # bearings that are to one side
BEFORE_US = math.radians(20.0)  # bearings at which whoever crosses does so before us
STANDING = 0.1  # [m/s] slower than this a vehicle stands

Side: TypeAlias = Literal[
    "ahead",
    "behind",
    "ahead-left",
    "ahead-right",
    "left",
    "right",
    "behind-left",
    "behind-right",
]


def who_is(description: str, vehicles: Vehicles) -> tuple[int, ...] | None:
    """The vehicles that such a description fits in a scene, lowest name first.

    Of places it fits the nearest vehicle there; "front-1" and "behind-1" are next to another one,
    and may be our car.

    Returns:
        None for other descriptions, such as "truck".
    """
    search = _SEARCHES.get(description)
    if search is not None:
        return tuple(sorted(search(vehicles)))
    side, _, other = description.rpartition("-")
    if side not in ("front", "behind") or not other.isdecimal():
        return None
    return _next_to(vehicles, int(other), "ahead" if side == "front" else "behind")


def is_place(description: str) -> bool:
    """Whether it says where a vehicle is or how it moves, which may be another one later."""
    side, _, other = description.rpartition("-")
    return description in _SEARCHES or (side in ("front", "behind") and other.isdecimal())


def place_asked(query: Query) -> str | None:
    """The place where it is asked who is there; None for other questions, and once it is known."""
    kind, _, description = query.actor.partition(":")
    plain = query.type == "what" and not query.factual and query.event is None
    return description if plain and kind == "vehicle" and is_place(description) else None


def seen_at(traces: Sequence[PlanTrace], moment: float) -> PlanTrace | None:
    """The decision that shows a moment [s] of the ride best: the nearest to it."""
    return min(traces, key=lambda trace: abs(trace.sim_time - moment), default=None)


def side_of(where: Bearing) -> Side:
    """On which side of us a vehicle is, whichever way it heads."""
    if abs(where.left) <= SAME_LANE and abs(where.ahead) > where.clear:
        return "ahead" if where.ahead > 0.0 else "behind"
    side: Literal["left", "right"] = "left" if where.left > 0.0 else "right"
    angle = abs(math.atan2(where.left, where.ahead))
    if angle > ABREAST[1]:
        return "behind-left" if side == "left" else "behind-right"
    if angle >= ABREAST[0]:
        return side
    return "ahead-left" if side == "left" else "ahead-right"


def _next_to(vehicles: Vehicles, name: int, wanted: Place) -> tuple[int, ...]:
    if name not in vehicles:
        return ()
    seen = ((n, bearing(vehicles[name], state)) for n, state in vehicles.items() if n != name)
    fits = [(where.distance, n) for n, where in seen if place(where) == wanted]
    return tuple(n for _, n in sorted(fits))[:1]


def _first(vehicles: Vehicles, fits: Callable[[Bearing], bool]) -> tuple[int, ...]:
    return tuple(name for name, seen in nearest_first(vehicles) if fits(seen))[:1]


def _front(vehicles: Vehicles) -> tuple[int, ...]:
    """On our line; else what goes our way further to the side; else what crosses before us."""
    return (
        nearest_at(vehicles, ("ahead",))
        or nearest_at(vehicles, ("ahead-left", "ahead-right"))
        or _first(vehicles, _crosses_before_us)
    )


def _crosses_before_us(seen: Bearing) -> bool:
    crossing = place(seen) in ("crossing-left", "crossing-right")
    angle = abs(math.atan2(seen.left, seen.ahead))
    return side_of(seen) == "ahead" or (crossing and angle <= BEFORE_US)


def _behind(vehicles: Vehicles) -> tuple[int, ...]:
    return (
        nearest_at(vehicles, ("behind",))
        or nearest_at(vehicles, ("behind-left", "behind-right"))
        or _first(vehicles, lambda seen: side_of(seen) == "behind")
    )


def _at_left(vehicles: Vehicles) -> tuple[int, ...]:
    places: tuple[Place, ...] = ("beside-left", "ahead-left", "behind-left", "crossing-left")
    left = ("left", "ahead-left", "behind-left")
    return nearest_at(vehicles, places) or _first(vehicles, lambda seen: side_of(seen) in left)


def _at_right(vehicles: Vehicles) -> tuple[int, ...]:
    places: tuple[Place, ...] = ("beside-right", "ahead-right", "behind-right", "crossing-right")
    right = ("right", "ahead-right", "behind-right")
    return nearest_at(vehicles, places) or _first(vehicles, lambda seen: side_of(seen) in right)


def _beside(vehicles: Vehicles) -> tuple[int, ...]:
    return nearest_at(vehicles, ("beside-left", "beside-right")) or _first(
        vehicles, lambda seen: abs(seen.ahead) <= seen.clear and abs(seen.left) > SAME_LANE
    )


def _parked(vehicles: Vehicles) -> tuple[int, ...]:
    return tuple(n for n, seen in vehicles.items() if n != EGO and seen.speed < STANDING)


_SEARCHES: Mapping[str, Callable[[Vehicles], tuple[int, ...]]] = {
    "nearest": lambda vehicles: _first(vehicles, lambda _: True),
    "front": _front,
    "behind": _behind,
    "left": _at_left,
    "right": _at_right,
    "from-left": lambda v: nearest_at(v, ("crossing-left",)) or _at_left(v),
    "from-right": lambda v: nearest_at(v, ("crossing-right",)) or _at_right(v),
    "beside": _beside,
    "oncoming": lambda vehicles: nearest_at(vehicles, ("oncoming",)),
    "parked": _parked,
}
