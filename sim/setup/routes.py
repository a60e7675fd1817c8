"""Route files, also gzipped: their vehicles, and where these start.

The only error is RoutesError.
"""

import gzip
import xml.etree.ElementTree as ET
import zlib
from dataclasses import dataclass
from pathlib import Path

from sim.errors import SimError

VEHICLES = ("vehicle", "trip")
GZIP = b"\x1f\x8b"  # first bytes of a gzipped file (RFC 1952)


class RoutesError(SimError):
    """A route file is not XML, or a vehicle in it lacks what its start needs."""


@dataclass(frozen=True, slots=True)
class Departure:
    """A vehicle or trip of a route file."""

    id: str
    depart: float | None  # [s] None if not a time
    edges: tuple[str, ...]  # of its route as written; of a trip, its ends and the edges via
    position: float | None  # [m] departPos along the first edge; None if not a number
    coloured: bool  # whether it states a colour of its own, besides that of its type
    kind: str | None  # its vehicle type; None for SUMO's default
    trip: bool  # whether SUMO finds the edges between its ends

    @property
    def at_start(self) -> bool:
        """Whether it departs at 0 s."""
        return self.depart == 0.0


def parse(path: Path) -> ET.Element:
    """Return the root element of a route file.

    Raises:
        RoutesError: it cannot be read, or is not an XML file of routes.
    """
    try:
        data = path.read_bytes()
        root = ET.fromstring(gzip.decompress(data) if data.startswith(GZIP) else data)
    except (EOFError, gzip.BadGzipFile, zlib.error) as error:
        raise RoutesError(f"a damaged gzip file: {error}") from error
    except OSError as error:
        raise RoutesError(f"cannot be read: {error.strerror}") from error
    except ET.ParseError as error:
        raise RoutesError(f"not an XML file: {error}") from error
    if root.tag != "routes":
        raise RoutesError(f"its root is <{root.tag}>, not <routes>")
    return root


def departures(root: ET.Element) -> tuple[Departure, ...]:
    """Return the vehicles and trips of a route file, in file order.

    Raises:
        RoutesError: a vehicle has no id, or no depart.
    """
    routes = {route.get("id"): route for route in root.iter("route") if route.get("id")}
    found = []
    for element in vehicles(root):
        name = element.get("id")
        if not name:
            raise RoutesError(f"a <{element.tag}> has no id")
        if element.get("depart") is None:
            raise RoutesError(f"vehicle {name!r} has no depart")
        route = element.find("route")
        if route is None:
            route = routes.get(element.get("route"))
        edges = _edges(element) if route is None else _edges(route)
        found.append(
            Departure(
                id=name,
                depart=seconds(element.get("depart")),
                edges=edges,
                position=number(element.get("departPos")),
                coloured=bool(element.get("color")),
                kind=element.get("type"),
                trip=route is None,
            )
        )
    return tuple(found)


def coloured_types(root: ET.Element) -> frozenset[str]:
    """Return the vehicle types whose colour the file states."""
    return frozenset(kind.get("id", "") for kind in root.iter("vType") if kind.get("color"))


def types(root: ET.Element) -> frozenset[str]:
    """Return the vehicle types and their distributions that the file defines."""
    kinds = (*root.iter("vType"), *root.iter("vTypeDistribution"))
    return frozenset(kind.get("id", "") for kind in kinds)


def mentioned_edges(root: ET.Element) -> dict[str, str]:
    """Return every edge that a route, trip or flow names, with the id of the first that does."""
    parents = {child: parent for parent in root.iter() for child in parent}
    found: dict[str, str] = {}
    for element in root.iter():
        if element.tag in ("route", "trip", "flow"):
            owner = element if element.get("id") else parents.get(element, element)
            for edge in _edges(element):
                found.setdefault(edge, owner.get("id", "?"))
    return found


def vehicles(root: ET.Element) -> list[ET.Element]:
    """Return the elements of the vehicles and trips, in file order."""
    return [element for element in root if element.tag in VEHICLES]


def number(text: str | None) -> float | None:
    """Return the number in an attribute; None if it is absent or not a number."""
    try:
        return None if text is None else float(text)
    except ValueError:
        return None


def seconds(text: str | None) -> float | None:
    """Return the time [s] in an attribute: seconds, [days:]hours:minutes:seconds; None if none."""
    parts = [number(part) for part in (text or "").split(":")]
    if len(parts) not in (1, 3, 4):
        return None
    total = 0.0
    for part, unit in zip(reversed(parts), (1.0, 60.0, 3600.0, 86400.0), strict=False):
        if part is None:
            return None
        total += part * unit
    return total


def _edges(element: ET.Element) -> tuple[str, ...]:
    if element.tag == "route":
        return tuple(element.get("edges", "").split())
    ends = (element.get("from", ""), *element.get("via", "").split(), element.get("to", ""))
    return tuple(edge for edge in ends if edge)
