"""Vehicles that may meet the ego, by the ways that each may take within the horizon.

Another vehicle is assumed to drive along its road, out of the next junction by any of its links,
and then straight on, up to the distance covered at the highest speed limit. The ego may choose at
every junction on its way. A vehicle that can neither enter a road that the ego may take nor cross
its way in a junction is ignored.
"""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field

from planner.motion.tracks import lanes_at
from planner.record.trace import EgoGoal, Settings
from planner.roads.routes import approach, onward
from planner.roads.trajectory import Roads
from sim.roads.network import Link, Location, Network
from sim.scene import VehicleState

FEW = 8  # maximum number of others for which all of them count
ASIDE = frozenset({"bicycle", "tram", "bus"})  # kinds that have ways of their own


@dataclass(slots=True)
class Reach:
    """The roads and links that a vehicle may reach."""

    edges: set[str] = field(default_factory=set)
    links: dict[str, set[int]] = field(default_factory=dict)  # indices, by junction

    def meets(self, network: Network, other: "Reach") -> bool:
        """Check whether the ways of two vehicles share a road, or cross in a junction."""
        if not self.edges.isdisjoint(other.edges):
            return True
        return any(
            _cross(network, junction, own, other.links[junction])
            for junction, own in self.links.items()
            if junction in other.links
        )


def relevant(
    roads: Roads,
    others: Mapping[int, VehicleState],
    here: Location,
    goal: EgoGoal,
    settings: Settings,
) -> frozenset[int]:
    """Return the vehicles that may meet the ego; all of them if there are no more than FEW.

    Vehicles on no lane, and those with lanes of their own, always count.

    Args:
        roads: the road network.
        others: the vehicles in view, by number.
        here: where the ego is.
        goal: the ego's goal.
        settings: horizon [s], and how far ahead [m] junctions are seen.
    """
    if len(others) <= FEW:
        return frozenset(others)
    view, reach = settings.view_radius, settings.horizon * roads.fastest
    own = _of_ego(roads, here, goal, reach, view)
    return frozenset(
        name
        for name, state in others.items()
        if state.kind in ASIDE or _may_meet(roads, state, own, settings)
    )


def _may_meet(roads: Roads, state: VehicleState, own: Reach, settings: Settings) -> bool:
    """Check whether a vehicle may come onto the ways of the ego."""
    starts = lanes_at(roads, state.position, state.heading)
    reach = settings.horizon * max(roads.fastest, state.speed)
    theirs = (_of_other(roads, start, reach, settings.view_radius) for start in starts)
    return not starts or any(own.meets(roads.network, one) for one in theirs)


def _of_ego(roads: Roads, here: Location, goal: EgoGoal, reach: float, view: float) -> Reach:
    """Return the reach of the ego: out of every junction on its ways by any link."""
    network, found = roads.network, Reach()
    ahead = approach(roads, here, view)
    _add(network, found, ahead.lanes)
    for first in _beside(network, ahead.lanes):
        row = onward(roads, (first,), reach, goal)
        _add(network, found, row)
        for lane in _beside(network, row):
            for link in network.links_from(lane):
                if network.lanes[link.from_lane].edge in found.edges:
                    _add(network, found, (link.from_lane, *link.via, link.to_lane), (link,))
    for lane in _beside(network, ahead.lanes):
        for link in network.links_from(lane):
            beyond = onward(roads, (link.to_lane,), reach, goal)
            _add(network, found, (*link.via, *beyond), (link,))
    return found


def _of_other(roads: Roads, here: Location, reach: float, view: float) -> Reach:
    """Return the reach of another: out of the next junction by any link, and straight on."""
    network, found = roads.network, Reach()
    ahead = approach(roads, here, view)
    _add(network, found, onward(roads, ahead.lanes, reach + here.offset))
    inside = network.link_via(here.lane)
    left = max(reach - ahead.distance, 0.0)
    for lane in _beside(network, ahead.lanes[-1:]):
        for link in network.links_from(lane):
            beyond = onward(roads, (link.to_lane,), left)
            _add(network, found, (*link.via, *beyond), (link,))
    rings = [ring for ring in network.roundabouts if not ring.isdisjoint(found.edges)]
    for ring in rings:  # it may go round, and leave by any exit
        for edge in sorted(ring):
            for around in network.edge_lanes(edge):
                for link in network.links_from(around.id):
                    _add(network, found, onward(roads, (link.to_lane,), left), (link,))
    return found if inside is None else _with(found, inside)


def _add(
    network: Network, found: Reach, lanes: Collection[str], links: Iterable[Link] = ()
) -> None:
    """Add the roads of lanes, and the links that they are part of."""
    for name in lanes:
        lane, link = network.lanes[name], network.link_via(name)
        if link is not None:
            _with(found, link)
        elif not lane.internal:
            found.edges.add(lane.edge)
    for link in links:
        _with(found, link)


def _with(found: Reach, link: Link) -> Reach:
    found.links.setdefault(link.junction, set()).add(link.index)
    return found


def _beside(network: Network, lanes: Iterable[str]) -> list[str]:
    """Return all lanes of the roads of some lanes, except for lanes inside junctions."""
    edges = dict.fromkeys(
        network.lanes[lane].edge for lane in lanes if not _internal(network, lane)
    )
    return [lane.id for edge in edges for lane in network.edge_lanes(edge)]


def gives_way(
    network: Network, links: Iterable[tuple[str, int]], others: Collection[tuple[str, int]]
) -> bool:
    """Check whether one of some links (junction, index) has to give way to one of others."""
    return any(
        (junction, first) in others
        for junction, index in links
        if (link := network.junction_links(junction).get(index)) is not None
        for first in link.yields_to
    )


def _internal(network: Network, lane: str) -> bool:
    return network.lanes[lane].internal


def _cross(network: Network, junction: str, own: Iterable[int], theirs: Collection[int]) -> bool:
    """Check whether links of a junction cross, or are the same."""
    links = network.junction_links(junction)
    return any(
        k == i or k in links[i].foes or i in links[k].foes
        for i in own
        for k in theirs
        if i in links and k in links
    )
