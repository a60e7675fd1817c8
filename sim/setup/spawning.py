"""Starts that vary with the seed: drawn for vehicles that depart at 0 s and move then.

A start stays within its lane, before the vehicle's own first stop and clear of the others. Its
speed is not higher than type and lane allow, and lets the vehicle stop where it has to. Vehicles
that depart at a standstill are left as they are.
"""

import math
import random
import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from sim.roads.network import Lane, Network
from sim.setup.routes import Departure, RoutesError, departures, number, vehicles

GAP = 2.5  # [m] between vehicles: SUMO's own least gap at a standstill
BRAKING = 3.0  # [m/s2] of types that state no decel
LENGTH = 5.0  # [m] of a car that states none
#: Lengths [m] of types that state none, by class:
#: https://sumo.dlr.de/docs/Vehicle_Type_Parameter_Defaults.html
LENGTHS = {
    "delivery": 6.5,
    "emergency": 6.5,
    "truck": 7.1,
    "trailer": 16.5,
    "bus": 12.0,
    "coach": 14.0,
    "tram": 22.0,
    "motorcycle": 2.2,
    "moped": 2.1,
    "bicycle": 1.6,
}
#: Speeds [m/s] of types that state none: the top speed of a class, and the speed it wishes for.
FASTEST = {"truck": 36.1, "trailer": 36.1, "bus": 27.7, "coach": 27.7, "tram": 22.2, "moped": 16.6}
WISHED = {"bicycle": 5.55}


@dataclass(frozen=True, slots=True)
class Spawn:
    """The ranges in which starts vary with the seed, for vehicles that depart at 0 s."""

    longitudinal: float  # [m] length of the interval, centred on departPos
    speed: tuple[float, float]  # [m/s] least and greatest


@dataclass(frozen=True, slots=True)
class _Kind:
    """The properties of a vehicle type that matter for starts."""

    length: float  # [m]
    top_speed: float  # [m/s]
    wished: float  # [m/s] greatest speed that it wishes to drive, before its factor
    factor: float  # mean ratio of its speed to the limit
    braking: float  # [m/s2]
    name: str  # name of its class


@dataclass(frozen=True, slots=True)
class _Start:
    """The place of a vehicle at 0 s."""

    lanes: tuple[str, ...]  # on which it may be
    front: float  # [m] along the lane
    length: float  # [m]


def with_spawn(root: ET.Element, spawn: Spawn, seed: int, network: Network) -> bytes:
    """Return a route file in which the starts at 0 s vary; the same seed gives the same file.

    Place and speed are drawn uniformly, vehicle by vehicle in file order. SUMO's insertion
    checks are off for these vehicles, since they would delay or slow a start.

    Raises:
        RoutesError: a vehicle that departs at 0 s has no departPos as a number.
    """
    copy = ET.fromstring(ET.tostring(root))
    known = departures(copy)
    kinds = {x.get("id", ""): _kind(x) for x in copy.iter("vType")}
    starting = [
        (element, departure)
        for element, departure in zip(vehicles(copy), known, strict=True)
        if departure.at_start
    ]
    places = [_start(x, departure, kinds, network) for x, departure in starting]
    draw = random.Random(seed)
    for k, (element, departure) in enumerate(starting):
        if not _moves(element, departure, places[k], network):
            continue
        half = spawn.longitudinal / 2.0
        shifted = places[k].front + draw.uniform(-half, half)
        speed = draw.uniform(*spawn.speed)
        others = [place for j, place in enumerate(places) if j != k]
        lanes = [network.lanes[x] for x in places[k].lanes if x in network.lanes]
        stop = _first_stop(element, departure, network)
        front = _within(shifted, places[k], others, lanes, stop)
        kind = kinds.get(departure.kind or "", CAR)
        places[k] = _Start(places[k].lanes, front, places[k].length)
        element.set("departPos", repr(front))
        kind = replace(kind, factor=_factor(element) or kind.factor)
        element.set("departSpeed", repr(min(speed, *_caps(kind, lanes, stop - front))))
        element.set("insertionChecks", "none")
    varied: bytes = ET.tostring(copy, encoding="utf-8", xml_declaration=True)
    return varied


CAR = _Kind(LENGTH, math.inf, math.inf, 1.0, BRAKING, "passenger")


def _kind(element: ET.Element) -> _Kind:
    name = element.get("vClass", CAR.name)
    return _Kind(
        length=number(element.get("length")) or LENGTHS.get(name, LENGTH),
        top_speed=number(element.get("maxSpeed")) or FASTEST.get(name, math.inf),
        wished=number(element.get("desiredMaxSpeed")) or WISHED.get(name, math.inf),
        factor=_factor(element) or 1.0,
        braking=number(element.get("decel")) or BRAKING,
        name=name,
    )


def _factor(element: ET.Element) -> float | None:
    """Return the mean of a speedFactor, a number or a distribution such as norm(1,0.1)."""
    text = element.get("speedFactor", "")
    return number(text.partition("(")[2].partition(",")[0] if "(" in text else text)


def _start(
    element: ET.Element, departure: Departure, kinds: Mapping[str, _Kind], network: Network
) -> _Start:
    """Return where the file puts a vehicle."""
    index = number(element.get("departLane"))
    every = _lanes(departure, network)
    lanes = tuple(x for x in every if index is None or x.index == index)
    if departure.position is None:
        raise RoutesError(f"vehicle {departure.id!r} has no departPos in metres")
    stated = min((lane.stated_length for lane in lanes), default=0.0)
    front = departure.position + (stated if departure.position < 0.0 else 0.0)
    kind = kinds.get(departure.kind or "", CAR)
    return _Start(tuple(lane.id for lane in lanes), front, kind.length)


def _lanes(departure: Departure, network: Network) -> tuple[Lane, ...]:
    """Return the lanes of the edge where a vehicle departs."""
    both = (*network.lanes.values(), *network.other_lanes.values())
    return tuple(lane for lane in both if lane.edge == departure.edges[0] and not lane.internal)


def _moves(element: ET.Element, departure: Departure, start: _Start, network: Network) -> bool:
    """Check whether a vehicle moves at 0 s: it does not depart at speed 0 or at a stop."""
    if number(element.get("departSpeed")) == 0.0:
        return False
    return not any(low <= start.front <= high for low, high in _stops(element, departure, network))


def _first_stop(element: ET.Element, departure: Departure, network: Network) -> float:
    """Return the offset [m] of the first stop on a vehicle's first edge; infinite if none."""
    return min((high for _, high in _stops(element, departure, network)), default=math.inf)


def _stops(
    element: ET.Element, departure: Departure, network: Network
) -> list[tuple[float, float]]:
    """Return the interval [m] of each stop on the first edge."""
    lengths = {lane.id: lane.stated_length for lane in _lanes(departure, network)}
    found = []
    for stop in element.iter("stop"):
        lane = stop.get("lane", f"{stop.get('edge')}_0")
        if lane in lengths:
            high = _along(stop.get("endPos"), lengths[lane], lengths[lane])
            low = _along(stop.get("startPos"), lengths[lane], max(0.0, high - GAP))
            found.append((low, high))
    return found


def _along(text: str | None, length: float, default: float) -> float:
    """Return a place [m] along a lane; a negative number counts from the lane's end."""
    value = number(text)
    if value is None:
        return default
    return value + length if value < 0.0 else value


def _within(
    front: float, start: _Start, others: Sequence[_Start], lanes: Sequence[Lane], stop: float
) -> float:
    """Return the place [m] nearest to the one drawn that is on the lane and clear of the others."""
    low, high = 0.0, min([stop, *(lane.stated_length for lane in lanes)])
    for other in others:
        if not set(other.lanes) & set(start.lanes):
            continue
        if other.front > start.front:
            high = min(high, other.front - other.length - GAP)
        else:
            low = max(low, other.front + start.length + GAP)
    return min(max(front, low), high) if low <= high else start.front


def _caps(kind: _Kind, lanes: Sequence[Lane], room: float) -> tuple[float, ...]:
    """Return the speeds [m/s] not to be exceeded: of the type, of the lanes, and to stop in time.

    The caps use the mean factor. SUMO lets a vehicle whose own factor is higher drive faster later.
    """
    wishes = (kind.wished, *(lane.limit_for(kind.name) for lane in lanes))
    factor = min(1.0, kind.factor)
    stopping = math.sqrt(2.0 * kind.braking * max(0.0, room))
    return (kind.top_speed, stopping, *(factor * wish for wish in wishes))
