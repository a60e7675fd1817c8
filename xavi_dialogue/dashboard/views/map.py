"""Roads and scenes for browsers to draw."""

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

from sim.roads.lanes import Control, Lane
from sim.roads.netfile import NetworkError, parse_network, parse_outlines
from sim.roads.network import Network
from sim.scene import Light, PersonState, Point, Signal, Unseen, VehicleState
from xavi_dialogue.bus.messages import SceneReport
from xavi_dialogue.dashboard.web.http_documents import (
    CrossingShown,
    LaneShown,
    Line,
    LinkShown,
    Roads,
)
from xavi_dialogue.dashboard.web.websocket_messages import HiddenShown, LightShown, SceneShown, Seen
from xavi_dialogue.storage.recording_format import unpacked

CENTIMETRES = 2  # decimals of metres, and of speeds [m/s]
ANGLES = 3  # decimals of headings [rad]
FARTHEST = 1e6  # [m] from the origin to the farthest road
LONG = 100.0  # [m] greatest length of a vehicle
LONGEST = 1e7  # [m] greatest total length of all lanes
USES = {  # by class of vehicles, the first that a lane permits
    "bicycle": "bicycles",
    "pedestrian": "people",
    "tram": "rails",
    "rail_urban": "rails",
    "rail": "rails",
}

Outline: TypeAlias = tuple[Point, ...]


def read(packed: bytes) -> tuple[Network, tuple[Outline, ...]]:
    """Convert the network and the outlines of junctions, from a gzipped net file.

    Raises:
        NetworkError: it is damaged, or larger than any that a car drives on.
    """
    data = unpacked(packed)
    if data is None:
        raise NetworkError("the roads are damaged, or too large")
    network, outlines = parse_network(data, "the roads"), parse_outlines(data, "the roads")
    lanes = [*network.lanes.values(), *network.other_lanes.values()]
    crossings = [crossing.line for crossing in network.crossings]
    lines = [*(lane.centreline for lane in lanes), *crossings, *outlines]
    if not all(abs(value) <= FARTHEST for line in lines for point in line for value in point):
        raise NetworkError(f"the roads go farther than {FARTHEST / 1000.0:.0f} km")
    if not sum(lane.length for lane in lanes) <= LONGEST:
        raise NetworkError(f"the roads are longer than {LONGEST / 1000.0:.0f} km")
    widths = [*(lane.width for lane in lanes), *(one.width for one in network.crossings)]
    if not all(map(math.isfinite, widths)):
        raise NetworkError("the roads have lanes of no width")
    return network, outlines


def shown(network: Network, outlines: Sequence[Outline]) -> Roads:
    """Convert the network; the id of a link is its place in `network.links`."""
    numbers = link_ids(network)
    lanes = [_lane(lane, "cars") for lane in network.lanes.values()]
    others = [_lane(lane, _use(lane)) for lane in network.other_lanes.values()]
    crossings = [
        CrossingShown(
            line=line(crossing.line),
            width=round(crossing.width, CENTIMETRES),
            signal=_signal(crossing.control),
        )
        for crossing in network.crossings
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
            signal=_signal(link.control),
        )
        for k, link in enumerate(network.links)
    ]
    junctions = tuple(map(line, outlines))
    return Roads(
        hash=network.hash,
        bounds=_bounds([*(lane.line for lane in (*lanes, *others)), *junctions]),
        lanes=tuple(lanes),
        links=tuple(links),
        junctions=junctions,
        others=tuple(others),
        crossings=tuple(crossings),
    )


def link_ids(network: Network) -> dict[tuple[str, int], int]:
    """Return the ids of links by junction and index there."""
    return {(link.junction, link.index): k for k, link in enumerate(network.links)}


def _lane(lane: Lane, use: str) -> LaneShown:
    return LaneShown(
        id=lane.id,
        edge=lane.edge,
        index=lane.index,
        width=round(lane.width, CENTIMETRES),
        internal=lane.internal,
        line=line(lane.centreline),
        use=use,
    )


def _use(lane: Lane) -> str:
    return next((use for kind, use in USES.items() if kind in lane.permits), "others")


def _signal(control: Control) -> str | None:
    return _signal_id(control) if isinstance(control, Signal) else None


def _signal_id(signal: Signal) -> str:
    return f"{signal.controller} {signal.index}"


def line(points: Iterable[Point]) -> Line:
    """Return points [m] as a row of numbers."""
    return tuple([round(value, CENTIMETRES) for point in points for value in point])


def scene(report: SceneReport) -> SceneShown:
    """Convert a scene for browsers."""
    return SceneShown(
        seq=report.seq,
        t=report.sim_time,
        wall=report.wall_time,
        state=report.state,
        speed=report.speed_factor,
        plan=report.plan,
        vehicles=seen({**report.vehicles, **report.people}),
        lights=lights(report.lights),
        hidden=hidden(report.unseen),
    )


def lights(known: Iterable[Light]) -> tuple[LightShown, ...]:
    """Return the states of the lights in view."""
    return tuple((_signal_id(one.signal), one.state.name.lower()) for one in known)


def hidden(stretches: Iterable[Unseen]) -> tuple[HiddenShown, ...]:
    """Return the stretches of lanes that the ego cannot see."""
    return tuple(
        (one.lane, round(one.begin, 1), round(one.end, 1))
        for one in stretches
        if 0.0 <= one.begin < one.end <= FARTHEST
    )


def within(points: Iterable[Point]) -> bool:
    """Check whether points [m] are plausible positions of a car, so that they can be drawn."""
    return all(abs(x) <= FARTHEST and abs(y) <= FARTHEST for x, y in points)


def seen(road_users: Mapping[int, VehicleState | PersonState]) -> tuple[Seen, ...]:
    """Return vehicles and people in the order of their names, without implausible ones."""
    return tuple(
        (
            name,
            round(state.position[0], CENTIMETRES),
            round(state.position[1], CENTIMETRES),
            round(state.heading, ANGLES),
            round(state.speed, CENTIMETRES),
            round(state.length, CENTIMETRES),
            round(state.width, CENTIMETRES),
            state.kind,
            state.colour if isinstance(state, VehicleState) else None,
            state.signals if isinstance(state, VehicleState) else (),
        )
        for name, state in sorted(road_users.items())
        if within([state.position]) and 0.0 < state.length < LONG and 0.0 < state.width < LONG
    )


def _bounds(lines: Sequence[Line]) -> tuple[float, float, float, float]:
    xs = [x for one in lines for x in one[0::2]] or [0.0]
    ys = [y for one in lines for y in one[1::2]] or [0.0]
    return min(xs), min(ys), max(xs), max(ys)
