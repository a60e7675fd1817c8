"""Reads a SUMO net file (.net.xml) into a `Network`.

Only lanes open to passenger cars are kept. The format is SUMO's:
https://sumo.dlr.de/docs/Networks/SUMO_Road_Networks.html

    NetworkError
    ├── NetworkUnreadable    the file is missing, not XML, or not a SUMO net
    └── NetworkInvalid       an element of the net is incomplete or refers to nothing
"""

import hashlib
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from sim.network import UNSIGNALLED, Control, Direction, Lane, Link, Network, cumulative
from sim.rings import find_rings
from sim.scene import Point, Signal

CAR = "passenger"
DEFAULT_WIDTH = 3.2  # [m] SUMO's width of a lane that states none
EQUAL = "right_before_left"
RAIL = "rail_crossing"
NOT_FOR_VEHICLES = ("crossing", "walkingarea")

_DIRECTIONS: dict[str, Direction] = {
    "s": "straight",
    "l": "left",
    "L": "left",
    "r": "right",
    "R": "right",
    "t": "turnaround",
}


class NetworkError(Exception):
    """A road network cannot be read."""


class NetworkUnreadable(NetworkError):
    """The file is missing, not XML, or not a SUMO net."""


class NetworkInvalid(NetworkError):
    """An element of the net is incomplete or refers to nothing."""


@dataclass(frozen=True, slots=True)
class _Request:
    """One row of a junction's right-of-way matrix."""

    response: frozenset[int]
    foes: frozenset[int]
    waits_inside: bool


def read_network(path: Path) -> Network:
    """Read a network from a SUMO net file.

    Raises:
        NetworkUnreadable: the file is missing, not XML, or not a SUMO net.
        NetworkInvalid: an element lacks an attribute or refers to nothing.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise NetworkUnreadable(f"{path}: cannot be read: {error.strerror}") from error
    return parse_network(data, str(path))


def parse_network(data: bytes, name: str) -> Network:
    """The network in a SUMO net file; `name` is what errors call the file.

    Raises:
        NetworkUnreadable: it is not XML, or not a SUMO net.
        NetworkInvalid: an element lacks an attribute or refers to nothing.
    """
    text, root = _parsed(data, name)
    try:
        lanes = {lane.id: lane for lane in _lanes(root)}
        links = tuple(_links(root, lanes))
    except NetworkInvalid as error:
        raise NetworkInvalid(f"{name}: {error}") from error
    # The canonical form leaves out comments, among them netconvert's time stamp.
    canonical = ET.canonicalize(text, strip_text=True)
    digest = hashlib.sha256(canonical.encode()).hexdigest()[:16]
    rings = _roundabouts(root, lanes) or find_rings(lanes, links)
    return Network(lanes, links, digest, rings, _of_type(root, EQUAL), _of_type(root, RAIL))


def parse_outlines(data: bytes, name: str) -> tuple[tuple[Point, ...], ...]:
    """The outlines [m] of the junctions in a SUMO net file, in file order; none of a line only.

    Raises:
        NetworkUnreadable: it is not XML, or not a SUMO net.
        NetworkInvalid: an outline holds what is no point.
    """
    _, root = _parsed(data, name)
    drawn = [j for j in root.iter("junction") if j.get("shape") and j.get("type") != "internal"]
    try:
        found = [_points(junction) for junction in drawn]
    except NetworkInvalid as error:
        raise NetworkInvalid(f"{name}: {error}") from error
    return tuple(outline for outline in found if len(outline) > 2)


def _parsed(data: bytes, name: str) -> tuple[str, ET.Element]:
    try:
        text = data.decode()
        root = ET.fromstring(text)
    except (ET.ParseError, UnicodeDecodeError) as error:
        raise NetworkUnreadable(f"{name}: not an XML file: {error}") from error
    if root.tag != "net":
        raise NetworkUnreadable(f"{name}: not a SUMO net: its root is <{root.tag}>, not <net>")
    return text, root


def _attribute(element: ET.Element, key: str) -> str:
    value = element.get(key)
    if value is None:
        name = element.get("id") or element.get("from") or element.get("index") or "?"
        raise NetworkInvalid(f"<{element.tag}> {name!r} has no attribute {key!r}")
    return value


def _number(element: ET.Element, key: str, default: float | None = None) -> float:
    value = _attribute(element, key) if default is None else element.get(key, str(default))
    try:
        return float(value)
    except ValueError as error:
        name = element.get("id", "?")
        what = f"{key}={value!r} is not a number"
        raise NetworkInvalid(f"<{element.tag}> {name!r}: {what}") from error


def _lanes(root: ET.Element) -> Iterator[Lane]:
    for edge in root.iter("edge"):
        if edge.get("function") in NOT_FOR_VEHICLES:
            continue
        for lane in edge.iter("lane"):
            if not _open_to_cars(lane):
                continue
            centreline = _shape(lane)
            yield Lane(
                id=_attribute(lane, "id"),
                edge=_attribute(edge, "id"),
                index=int(_number(lane, "index")),
                width=_number(lane, "width", DEFAULT_WIDTH),
                speed_limit=_number(lane, "speed"),
                centreline=centreline,
                internal=edge.get("function") == "internal",
                length=cumulative(centreline)[-1],
            )


def _roundabouts(root: ET.Element, lanes: dict[str, Lane]) -> tuple[frozenset[str], ...]:
    """The rings that the file names, as far as they are open to cars."""
    edges = {lane.edge for lane in lanes.values()}
    named = (frozenset(x.get("edges", "").split()) & edges for x in root.iter("roundabout"))
    return tuple(ring for ring in named if ring)


def _of_type(root: ET.Element, kind: str) -> frozenset[str]:
    """The junctions of a type."""
    return frozenset(x.get("id", "") for x in root.iter("junction") if x.get("type") == kind)


def _open_to_cars(lane: ET.Element) -> bool:
    allowed = lane.get("allow", "").split()
    forbidden = lane.get("disallow", "").split()
    if allowed:
        return CAR in allowed or "all" in allowed
    return CAR not in forbidden and "all" not in forbidden


def _shape(lane: ET.Element) -> tuple[Point, ...]:
    points = _points(lane)
    if len(points) < 2:
        raise NetworkInvalid(f"<lane> {lane.get('id', '?')!r}: its shape has fewer than 2 points")
    return points


def _points(element: ET.Element) -> tuple[Point, ...]:
    points: list[Point] = []
    for text in _attribute(element, "shape").split():
        try:
            x, y = (float(part) for part in text.split(",")[:2])
        except ValueError as error:
            what = f"<{element.tag}> {element.get('id', '?')!r}"
            raise NetworkInvalid(f"{what}: {text!r} in its shape is no point") from error
        points.append((x, y))
    return tuple(points)


def _links(root: ET.Element, lanes: dict[str, Lane]) -> Iterator[Link]:
    """The links that cars can use, in file order."""
    connections = list(root.iter("connection"))
    ends = {edge.get("id", ""): edge.get("to", "") for edge in root.iter("edge")}
    inside = {_from_lane(x): x.get("via") for x in connections if _is_internal(x)}
    outside = [connection for connection in connections if not _is_internal(connection)]
    indices = _link_indices(root, outside)
    links = []
    for connection in outside:
        start, end = _from_lane(connection), _to_lane(connection)
        via = _via_chain(connection.get("via"), inside)
        if not all(lane in lanes for lane in (start, end, *via)):
            continue  # not for cars
        junction = ends.get(_attribute(connection, "from"), "")
        direction = _DIRECTIONS.get(_attribute(connection, "dir"), "straight")
        index = indices.get(id(connection))
        if index is None:
            raise NetworkInvalid(f"junction {junction!r} does not list incoming lane {start!r}")
        control = _control(connection)
        links.append(Link(junction, index, start, end, via, direction, (), (), False, control))
    yield from _with_right_of_way(links, _requests(root))


def _control(connection: ET.Element) -> Control:
    """The place of a connection in a traffic light, if it has one."""
    controller = connection.get("tl")
    if not controller:
        return UNSIGNALLED
    return Signal(controller, int(_number(connection, "linkIndex")))


def _is_internal(connection: ET.Element) -> bool:
    return _attribute(connection, "from").startswith(":")


def _from_lane(connection: ET.Element) -> str:
    return f"{_attribute(connection, 'from')}_{_attribute(connection, 'fromLane')}"


def _to_lane(connection: ET.Element) -> str:
    return f"{_attribute(connection, 'to')}_{_attribute(connection, 'toLane')}"


def _via_chain(first: str | None, inside: dict[str, str | None]) -> tuple[str, ...]:
    """Internal lanes in driving order: a waiting place splits the way into two lanes."""
    chain: list[str] = []
    while first is not None and first not in chain:
        chain.append(first)
        first = inside.get(first)
    return tuple(chain)


def _link_indices(root: ET.Element, connections: list[ET.Element]) -> dict[int, int]:
    """Index in the right-of-way matrix by `id()` of the connection element.

    SUMO numbers a junction's links by incoming lane as listed, then in file order.
    """
    by_lane: dict[str, list[ET.Element]] = {}
    for connection in connections:
        by_lane.setdefault(_from_lane(connection), []).append(connection)
    indices: dict[int, int] = {}
    for junction in root.iter("junction"):
        if junction.get("type") == "internal":
            continue
        incoming = junction.get("incLanes", "").split()
        ordered = [link for lane in incoming for link in by_lane.get(lane, [])]
        indices.update({id(link): index for index, link in enumerate(ordered)})
    return indices


def _requests(root: ET.Element) -> dict[tuple[str, int], _Request]:
    """The right-of-way matrices, row by junction and link index."""
    rows: dict[tuple[str, int], _Request] = {}
    for junction in root.iter("junction"):
        name = _attribute(junction, "id")
        for request in junction.iter("request"):
            rows[name, int(_number(request, "index"))] = _Request(
                response=_bits(_attribute(request, "response")),
                foes=_bits(_attribute(request, "foes")),
                waits_inside=request.get("cont") == "1",
            )
    return rows


def _bits(text: str) -> frozenset[int]:
    """Indices of the ones; the rightmost character has index 0."""
    return frozenset(index for index, bit in enumerate(reversed(text)) if bit == "1")


def _with_right_of_way(
    links: list[Link], requests: dict[tuple[str, int], _Request]
) -> Iterator[Link]:
    nobody = _Request(frozenset(), frozenset(), False)
    kept: dict[str, set[int]] = {}
    for link in links:
        kept.setdefault(link.junction, set()).add(link.index)
    for link in links:
        row = requests.get((link.junction, link.index), nobody)
        known = kept[link.junction]
        yield replace(
            link,
            yields_to=tuple(sorted(row.response & known)),
            foes=tuple(sorted(row.foes & known)),
            waits_inside=row.waits_inside,
        )
