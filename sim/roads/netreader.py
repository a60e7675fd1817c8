"""The content of a SUMO net file: what sumolib reads, and what it leaves out.

Only this module imports sumolib. Its only error is Broken.
"""

import xml.sax
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NoReturn

import sumolib.net
from sumolib.net.lane import SUMO_VEHICLE_CLASSES

from sim.errors import SimError


class Broken(SimError):
    """An element of the net is incomplete or refers to a thing that does not exist."""


@dataclass(frozen=True, slots=True)
class Request:
    """One row of a junction's right-of-way matrix."""

    response: frozenset[int]  # links that go first
    foes: frozenset[int]  # links whose paths cross or merge
    waits_inside: bool


@dataclass
class Read:
    """A net as sumolib reads it, with what sumolib does not keep."""

    net: Any
    root: str = ""  # the name of the root element
    left_hand: bool = False
    connections: list[Any] = field(default_factory=list)  # in file order
    incoming: dict[str, tuple[str, ...]] = field(default_factory=dict)  # lanes by junction
    requests: dict[tuple[str, int], Request] = field(default_factory=dict)  # by junction and link
    # Speed limits [m/s] by type of edge, then by vehicle class.
    restrictions: dict[str, dict[str, float]] = field(default_factory=dict)


def read_sumo_net(text: str) -> Read:
    """Read the text of a net file.

    Raises:
        SAXParseException: it is not XML.
        Broken: an element of it is incomplete or refers to a thing that does not exist.
    """
    net = _Net()
    reader = _Reader(net)
    xml.sax.parseString(text, reader)
    reader.read.connections = net.connections
    return reader.read


def permissions(lane: Any) -> frozenset[str]:
    """Return the vehicle classes that may use a lane, given as an object of sumolib."""
    allowed = frozenset(lane.getPermissions())
    return frozenset(SUMO_VEHICLE_CLASSES) if "all" in allowed else allowed


class _Net(sumolib.net.Net):  # type: ignore[misc]
    """A net of sumolib that remembers the order of connections in the file."""

    def __init__(self) -> None:
        super().__init__()
        self.connections: list[Any] = []

    def addConnection(self, *arguments: Any) -> Any:  # noqa: N802 - sumolib's name
        made = super().addConnection(*arguments)
        self.connections.append(made)
        return made


class _Reader(sumolib.net.NetReader):  # type: ignore[misc]
    """A reader that keeps what sumolib does not read, and names the element if reading fails."""

    def __init__(self, net: _Net) -> None:
        super().__init__(net=net, withInternal=True, withPedestrianConnections=True)
        self.read = Read(net)
        self._junction = ""
        self._type = ""

    def startElement(self, name: str, attrs: Mapping[str, str]) -> None:  # noqa: N802 - SAX's name
        self.read.root = self.read.root or name
        try:
            match name:
                case "net":
                    self.read.left_hand = attrs.get("lefthand") in ("1", "true")
                case "request":
                    self._request(attrs)
                case "restriction":
                    limits = self.read.restrictions.setdefault(self._type, {})
                    limits[attrs["vClass"]] = float(attrs["speed"])
                case _:
                    self._remember(name, attrs)
                    super().startElement(name, attrs)
        except (KeyError, ValueError, IndexError, AttributeError) as error:
            _refuse(name, attrs, error)

    def _remember(self, name: str, attrs: Mapping[str, str]) -> None:
        if name == "junction":
            self._junction = attrs["id"]
            self.read.incoming[self._junction] = tuple(attrs["incLanes"].split())
        elif name == "type":
            self._type = attrs["id"]

    def _request(self, attrs: Mapping[str, str]) -> None:
        self.read.requests[self._junction, int(attrs["index"])] = Request(
            response=_bits(attrs["response"]),
            foes=_bits(attrs["foes"]),
            waits_inside=attrs.get("cont") == "1",
        )


def _bits(text: str) -> frozenset[int]:
    """Return the indices of the ones; the rightmost character has index 0."""
    return frozenset(index for index, bit in enumerate(reversed(text)) if bit == "1")


def _refuse(name: str, attrs: Mapping[str, str], error: Exception) -> NoReturn:
    """Raise an error that states what is wrong with an element that sumolib could not read.

    Raises:
        Broken: always.
    """
    who = next((attrs[key] for key in ("id", "from", "index") if key in attrs), "?")
    missing = error.args[0] if isinstance(error, KeyError) else None
    if missing is not None and missing not in attrs.values():
        problem = f"it has no attribute {missing!r}"
    elif missing is not None:
        problem = f"there is no {missing!r} that it refers to"
    elif isinstance(error, ValueError):
        problem = f"{error}"
    else:
        problem = "it refers to what there is not"
    raise Broken(f"<{name}> {who!r}: {problem}") from error
