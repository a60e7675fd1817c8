"""The lane graph in a net that sumolib has read: lanes, crossings, links with right of way."""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import chain
from typing import Any

from sim.roads.lanes import UNSIGNALLED, Control, Crossing, Direction, Lane, Link
from sim.roads.lines import cumulative
from sim.roads.netreader import Broken, Read, Request, permissions
from sim.roads.network import Network
from sim.roads.rings import find_rings
from sim.scene import Point, Signal

CAR = "passenger"
EQUAL = "right_before_left"
RAIL = "rail_crossing"
SHORTEST = 0.01  # [m] of an internal lane; shorter ones are left out, and the lanes touch
CROSSING, WALKING_AREA = "crossing", "walkingarea"

_DIRECTIONS: dict[str, Direction] = {
    "s": "straight",
    "l": "left",
    "L": "left",
    "r": "right",
    "R": "right",
    "t": "turnaround",
    "T": "turnaround",
}
_NOBODY = Request(frozenset(), frozenset(), False)


def graph_of(read: Read) -> Network:
    """Return the network of a net that was read, without its hash.

    Raises:
        Broken: a lane has no shape, or a junction does not know a lane that leads to it.
    """
    every = {lane.id: lane for lane in _lanes(read) if not lane.internal or lane.length >= SHORTEST}
    indices = _link_indices(read)
    cars, others = _links(read, every, indices)
    served = set(chain.from_iterable(link.via for link in cars))
    lanes = {x.id: x for x in every.values() if _open(x) and (not x.internal or x.id in served)}
    crossings = tuple(_crossings(read, indices))
    ways, other_ways = _with_right_of_way(read, cars, others, crossings)
    edges = {lane.edge for lane in lanes.values()}
    named = (frozenset(ring.getEdges()) & edges for ring in read.net.getRoundabouts())
    return Network(
        lanes=lanes,
        links=ways,
        hash="",
        roundabouts=tuple(ring for ring in named if ring) or find_rings(lanes, ways),
        equal=_of_type(read, EQUAL),
        rail_crossings=_of_type(read, RAIL),
        other_lanes={x.id: x for x in every.values() if x.id not in lanes},
        other_links=other_ways,
        crossings=crossings,
    )


def _open(lane: Lane) -> bool:
    return CAR in lane.permits


def _of_type(read: Read, kind: str) -> frozenset[str]:
    """Return the junctions of a type."""
    return frozenset(node.getID() for node in read.net.getNodes() if node.getType() == kind)


def _lanes(read: Read) -> Iterator[Lane]:
    """Yield all lanes of edges and of ways through junctions, also those not for cars."""
    for edge in read.net.getEdges():
        if edge.getFunction() in (CROSSING, WALKING_AREA):
            continue
        special = read.restrictions.get(edge.getType(), {})
        for lane in edge.getLanes():
            line, limit = _shape(lane), lane.getSpeed()
            permits = permissions(lane)
            own = special.get(CAR, limit)
            speeds = {kind: special.get(kind, limit) for kind in permits}
            yield Lane(
                id=lane.getID(),
                edge=edge.getID(),
                index=lane.getIndex(),
                width=lane.getWidth(),
                speed_limit=own,
                centreline=line,
                internal=edge.getFunction() == "internal",
                length=cumulative(line)[-1],
                stated_length=lane.getLength(),
                permits=permits,
                limits=tuple(sorted((k, v) for k, v in speeds.items() if v != own)),
            )


def _shape(lane: Any) -> tuple[Point, ...]:
    points = tuple(lane.getShape())
    if len(points) < 2:
        raise Broken(f"<lane> {lane.getID()!r}: its shape has fewer than 2 points")
    return points


def _links(
    read: Read, lanes: dict[str, Lane], indices: dict[Any, int]
) -> tuple[list[Link], list[Link]]:
    """Return the ways of vehicles through junctions, in file order, without their right of way.

    Returns:
        Those for cars, and those for others only.
    """
    inside = {x.getFromLane().getID(): x.getViaLaneID() for x in read.connections if _internal(x)}
    cars: list[Link] = []
    others: list[Link] = []
    for connection in read.connections:
        if _internal(connection) or _on_foot(connection):
            continue
        link = _link(connection, inside, indices)
        link = replace(link, via=tuple(lane for lane in link.via if lane in lanes))
        used = [lanes[x] for x in (link.from_lane, *link.via, link.to_lane) if x in lanes]
        for_cars = connection.allows(CAR) and all(map(_open, used))
        (cars if for_cars else others).append(link)
    return cars, others


def _link(connection: Any, inside: dict[str, str], indices: dict[Any, int]) -> Link:
    start, end = connection.getFromLane().getID(), connection.getToLane().getID()
    junction = connection.getFrom().getToNode().getID()
    index = indices.get(connection)
    if index is None:
        raise Broken(f"junction {junction!r} does not list incoming lane {start!r}")
    return Link(
        junction=junction,
        index=index,
        from_lane=start,
        to_lane=end,
        via=_via_chain(connection.getViaLaneID(), inside),
        direction=_DIRECTIONS.get(connection.getDirection(), "straight"),
        yields_to=(),
        foes=(),
        waits_inside=False,
        control=_control(connection),
    )


def _control(connection: Any) -> Control:
    """Return the signal of a connection, if any; rails at a crossing have none."""
    controller, index = connection.getTLSID(), connection.getTLLinkIndex()
    return Signal(controller, index) if controller and index >= 0 else UNSIGNALLED


def _internal(connection: Any) -> bool:
    return bool(connection.getFrom().getFunction() == "internal")


def _on_foot(connection: Any) -> bool:
    ends = (connection.getFrom().getFunction(), connection.getTo().getFunction())
    return CROSSING in ends or WALKING_AREA in ends


def _via_chain(first: str, inside: dict[str, str]) -> tuple[str, ...]:
    """Return internal lanes in driving order: a waiting place splits the way into two lanes."""
    chain: list[str] = []
    while first and first not in chain:
        chain.append(first)
        first = inside.get(first, "")
    return tuple(chain)


def _link_indices(read: Read) -> dict[Any, int]:
    """Return the index in the right-of-way matrix by connection.

    SUMO numbers a junction's links by incoming lane as listed, then in file order. Of the ways of
    pedestrians, only those onto a crossing have a number.
    """
    indices: dict[Any, int] = {}
    for node in read.net.getNodes():
        leading = (read.net.getLane(lane).getOutgoing() for lane in _incoming(read, node))
        ordered = [link for links in leading for link in links if _numbered(link)]
        indices.update({link: index for index, link in enumerate(ordered)})
    return indices


def _incoming(read: Read, node: Any) -> Iterator[str]:
    """Yield the lanes that a junction lists as leading to it."""
    for lane in read.incoming.get(node.getID(), ()):
        edge, _, index = lane.rpartition("_")
        known = read.net.hasEdge(edge) and index.isdigit()
        if not known or int(index) >= read.net.getEdge(edge).getLaneNumber():
            raise Broken(f"<junction> {node.getID()!r}: there is no {lane!r} that it refers to")
        yield lane


def _numbered(connection: Any) -> bool:
    start: str = connection.getFrom().getFunction()
    end: str = connection.getTo().getFunction()
    return end != WALKING_AREA and (start != WALKING_AREA or end == CROSSING)


def _crossings(read: Read, indices: dict[Any, int]) -> Iterator[Crossing]:
    """Yield the crossings for pedestrians, in file order."""
    for connection in read.connections:
        lane = connection.getToLane()
        if connection.getTo().getFunction() == CROSSING and connection in indices:
            yield Crossing(
                id=lane.getID(),
                junction=connection.getFrom().getToNode().getID(),
                index=indices[connection],
                line=_shape(lane),
                width=lane.getWidth(),
                edges=tuple(edge.getID() for edge in connection.getTo().getCrossingEdges()),
                control=_control(connection),
            )


def _with_right_of_way(
    read: Read, cars: list[Link], others: list[Link], crossings: Iterable[Crossing]
) -> tuple[tuple[Link, ...], tuple[Link, ...]]:
    """Return the same links with the right of way that the junctions' matrices give."""
    for_cars = {(link.junction, link.index) for link in cars}
    aside = {(link.junction, link.index) for link in others}
    aside |= {(crossing.junction, crossing.index) for crossing in crossings}

    def ruled(link: Link) -> Link:
        row = read.requests.get((link.junction, link.index), _NOBODY)

        def known(indices: frozenset[int], kept: set[tuple[str, int]]) -> tuple[int, ...]:
            return tuple(sorted(x for x in indices if (link.junction, x) in kept))

        return replace(
            link,
            yields_to=known(row.response, for_cars),
            foes=known(row.foes, for_cars),
            waits_inside=row.waits_inside,
            other_yields_to=known(row.response, aside),
            other_foes=known(row.foes, aside),
        )

    return tuple(map(ruled, cars)), tuple(map(ruled, others))
