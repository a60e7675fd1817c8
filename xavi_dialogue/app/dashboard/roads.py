"""What a car drives on and sees, as browsers draw it."""

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

from sim.netfile import NetworkError, parse_network, parse_outlines
from sim.network import Network
from sim.scene import Point, VehicleState
from xavi_dialogue.transports.messages import SceneReport
from xavi_dialogue.transports.recording import unpacked
from xavi_dialogue.transports.web.documents import LaneShown, Line, LinkShown, Roads
from xavi_dialogue.transports.web.wire import SceneShown, Seen

CENTIMETRES = 2  # decimals of what is told in metres, and of speeds [m/s]
ANGLES = 3  # decimals of headings [rad]
FARTHEST = 1e6  # [m] from the origin at which a road may lie
LONG = 100.0  # [m] of a vehicle
LONGEST = 1e7  # [m] of all lanes together

Outline: TypeAlias = tuple[Point, ...]


def read(packed: bytes) -> tuple[Network, tuple[Outline, ...]]:
    """The network and the outlines of its junctions, from a net file as a car tells it, gzipped.

    Raises:
        NetworkError: it is damaged, or larger than any that a car drives on.
    """
    data = unpacked(packed)
    if data is None:
        raise NetworkError("the roads are damaged, or too large")
    network, outlines = parse_network(data, "the roads"), parse_outlines(data, "the roads")
    lines = [*(lane.centreline for lane in network.lanes.values()), *outlines]
    if not all(abs(value) <= FARTHEST for line in lines for point in line for value in point):
        raise NetworkError(f"the roads go farther than {FARTHEST / 1000.0:.0f} km")
    if not sum(lane.length for lane in network.lanes.values()) <= LONGEST:
        raise NetworkError(f"the roads are longer than {LONGEST / 1000.0:.0f} km")
    if not all(math.isfinite(lane.width) for lane in network.lanes.values()):
        raise NetworkError("the roads have lanes of no width")
    return network, outlines


def shown(network: Network, outlines: Sequence[Outline]) -> Roads:
    """The network as browsers draw it; the id of a link is its place in `network.links`."""
    numbers = link_ids(network)
    lanes = [
        LaneShown(
            id=lane.id,
            edge=lane.edge,
            index=lane.index,
            width=round(lane.width, CENTIMETRES),
            internal=lane.internal,
            line=line(lane.centreline),
        )
        for lane in network.lanes.values()
    ]
    links = [
        LinkShown(
            id=k,
            junction=link.junction,
            from_lane=link.from_lane,
            to_lane=link.to_lane,
            via=link.via,
            direction=link.direction,
            yields_to=tuple(numbers[link.junction, index] for index in link.yields_to),
        )
        for k, link in enumerate(network.links)
    ]
    junctions = tuple(map(line, outlines))
    return Roads(
        hash=network.hash,
        bounds=_bounds([*(lane.line for lane in lanes), *junctions]),
        lanes=tuple(lanes),
        links=tuple(links),
        junctions=junctions,
    )


def link_ids(network: Network) -> dict[tuple[str, int], int]:
    """The ids of links by their junction and their index there."""
    return {(link.junction, link.index): k for k, link in enumerate(network.links)}


def line(points: Iterable[Point]) -> Line:
    """Points [m] as a row of numbers."""
    return tuple([round(value, CENTIMETRES) for point in points for value in point])


def scene(report: SceneReport) -> SceneShown:
    """A scene as browsers get it."""
    return SceneShown(
        seq=report.seq,
        t=report.sim_time,
        wall=report.wall_time,
        state=report.state,
        speed=report.speed_factor,
        plan=report.plan,
        vehicles=seen(report.vehicles),
    )


def within(points: Iterable[Point]) -> bool:
    """Whether points [m] lie where a car can be, so that they can be drawn."""
    return all(abs(x) <= FARTHEST and abs(y) <= FARTHEST for x, y in points)


def seen(vehicles: Mapping[int, VehicleState]) -> tuple[Seen, ...]:
    """The vehicles of a scene, in the order of their names; not those that nothing can be."""
    return tuple(
        (
            vehicle,
            round(state.position[0], CENTIMETRES),
            round(state.position[1], CENTIMETRES),
            round(state.heading, ANGLES),
            round(state.speed, CENTIMETRES),
            round(state.length, CENTIMETRES),
            round(state.width, CENTIMETRES),
            state.kind,
            state.colour,
            state.signals,
        )
        for vehicle, state in sorted(vehicles.items())
        if within([state.position]) and 0.0 < state.length < LONG and 0.0 < state.width < LONG
    )


def _bounds(lines: Sequence[Line]) -> tuple[float, float, float, float]:
    xs = [x for one in lines for x in one[0::2]] or [0.0]
    ys = [y for one in lines for y in one[1::2]] or [0.0]
    return min(xs), min(ys), max(xs), max(ys)
