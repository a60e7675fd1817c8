"""Reading of a SUMO net file (.net.xml, also gzipped) into a `Network`, with sumolib.

The format is SUMO's: https://sumo.dlr.de/docs/Networks/SUMO_Road_Networks.html

    NetworkError
    ├── NetworkUnreadable    the file is missing, damaged, not XML, or not a SUMO net
    ├── NetworkInvalid       an element is incomplete or refers to a thing that does not exist
    └── DrivesOnTheLeft      the net is one of left-hand traffic
"""

import gzip
import hashlib
import xml.etree.ElementTree as ET
import zlib
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from xml.sax import SAXParseException

from sim.errors import SimError
from sim.roads.netgraph import graph_of
from sim.roads.netreader import Broken, Read, read_sumo_net
from sim.roads.network import Network
from sim.scene import Point

GZIP = b"\x1f\x8b"  # first bytes of a gzipped file (RFC 1952)
KEPT = 4  # greatest number of networks in memory


class NetworkError(SimError):
    """A road network cannot be read."""


class NetworkUnreadable(NetworkError):
    """The file is missing, damaged, not XML, or not a SUMO net."""


class NetworkInvalid(NetworkError):
    """An element of the net is incomplete or refers to a thing that does not exist."""


class DrivesOnTheLeft(NetworkError):
    """The net is one of left-hand traffic."""


def read_network(path: Path) -> Network:
    """Read a network from a SUMO net file, which may be gzipped.

    Raises:
        NetworkError: it cannot be read; see the kinds above.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise NetworkUnreadable(f"{path}: cannot be read: {error.strerror}") from error
    return parse_network(data, str(path))


@lru_cache(maxsize=KEPT)
def parse_network(data: bytes, name: str) -> Network:
    """Return the network in a SUMO net file; errors call the file `name`.

    Raises:
        NetworkError: it cannot be read; see the kinds above.
    """
    text, read = _parsed(data, name)
    if read.left_hand:
        raise DrivesOnTheLeft(
            f'{name}: its traffic keeps to the left (lefthand="true"), and the car drives on the'
            " right only; build the net with netconvert without --lefthand"
        )
    try:
        network = graph_of(read)
    except Broken as error:
        raise NetworkInvalid(f"{name}: {error}") from error
    # The canonical form leaves out comments, among them netconvert's time stamp.
    canonical = ET.canonicalize(text, strip_text=True)
    return replace(network, hash=hashlib.sha256(canonical.encode()).hexdigest()[:16])


def parse_outlines(data: bytes, name: str) -> tuple[tuple[Point, ...], ...]:
    """Return the outlines [m] of the junctions in a SUMO net file, in file order.

    Outlines of fewer than three points are left out.

    Raises:
        NetworkUnreadable: it is not XML, or not a SUMO net.
        NetworkInvalid: an element is incomplete or refers to a thing that does not exist.
    """
    _, read = _parsed(data, name)
    outlines = (tuple(node.getShape() or ()) for node in read.net.getNodes())
    return tuple(outline for outline in outlines if len(outline) > 2)


def _parsed(data: bytes, name: str) -> tuple[str, Read]:
    """Return the text of a net file, and the net that sumolib reads from it."""
    try:
        text = (gzip.decompress(data) if data.startswith(GZIP) else data).decode()
    except (OSError, EOFError, zlib.error) as error:
        raise NetworkUnreadable(f"{name}: a damaged gzip file: {error}") from error
    except UnicodeDecodeError as error:
        raise NetworkUnreadable(f"{name}: not an XML file: {error}") from error
    try:
        read = read_sumo_net(text)
    except SAXParseException as error:
        where = f"{error.getMessage()}: line {error.getLineNumber()}"
        raise NetworkUnreadable(f"{name}: not an XML file: {where}") from error
    except Broken as error:
        raise NetworkInvalid(f"{name}: {error}") from error
    if read.root != "net":
        problem = f"not a SUMO net: its root is <{read.root}>, not <net>"
        raise NetworkUnreadable(f"{name}: {problem}")
    return text, read
