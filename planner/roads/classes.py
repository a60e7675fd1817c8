"""The roads as others than cars may use them: bicycle and bus lanes, rails, and shared lanes.

Links keep their indices, so the right of way between a car and a bicycle can be seen from either.
"""

from collections.abc import Iterable
from dataclasses import replace

from planner.roads.trajectory import Roads
from sim.roads.network import Lane, Link, Network

#: The classes of vehicles that something of a kind may belong to, in the words of permissions.
CLASSES: dict[str, tuple[str, ...]] = {
    "bicycle": ("bicycle",),
    "bus": ("bus",),
    "tram": ("tram", "rail_urban"),
}


def roads_of(roads: Roads, kind: str) -> Roads:
    """Return the roads for a kind of vehicle; those for cars if they are the same, or unknown."""
    found = roads.classes.get(kind)
    if found is None:
        found = _for(roads, CLASSES.get(kind, ()))
        found.classes = roads.classes
        roads.classes[kind] = found
    return found


def links_beside(network: Network, link: Link, indices: Iterable[int]) -> tuple[Link, ...]:
    """Return the links for others only among some of a junction, by index."""
    beside = network.junction_others(link.junction)
    met = (beside.get(index) for index in indices)
    return tuple(way for way in met if isinstance(way, Link))


def _for(roads: Roads, classes: tuple[str, ...]) -> Roads:
    for kind in classes:
        if any(kind in lane.permits for lane in roads.network.other_lanes.values()):
            own = _network(roads.network, kind)
            if own.lanes:
                return Roads(own)
    return roads


def _network(network: Network, kind: str) -> Network:
    """Return the part of a network that vehicles of a class may use; the rest is kept aside."""
    every = {**network.lanes, **network.other_lanes}
    lanes = {
        name: replace(lane, speed_limit=lane.limit_for(kind), limits=())
        for name, lane in every.items()
        if kind in lane.permits
    }
    links = [*network.links, *network.other_links]
    own = [x for x in links if all(y in lanes for y in (x.from_lane, *x.via, x.to_lane))]
    known = {(x.junction, x.index) for x in own}
    served = _served(lanes, own)
    return replace(
        network,
        lanes=served,
        links=tuple(_ruled(x, known) for x in own),
        other_lanes={name: lane for name, lane in every.items() if name not in served},
        other_links=tuple(_ruled(x, known) for x in links if (x.junction, x.index) not in known),
    )


def _served(lanes: dict[str, Lane], links: Iterable[Link]) -> dict[str, Lane]:
    """Return the lanes without those inside junctions that no link leads along."""
    via = {lane for link in links for lane in link.via}
    return {name: lane for name, lane in lanes.items() if not lane.internal or name in via}


def _ruled(link: Link, known: set[tuple[str, int]]) -> Link:
    """Return a link that tells apart which links of its junction are among some."""

    def split(ours: tuple[int, ...], others: tuple[int, ...]) -> tuple[tuple[int, ...], ...]:
        every = sorted({*ours, *others})
        return (
            tuple(x for x in every if (link.junction, x) in known),
            tuple(x for x in every if (link.junction, x) not in known),
        )

    yields_to, other_yields_to = split(link.yields_to, link.other_yields_to)
    foes, other_foes = split(link.foes, link.other_foes)
    return replace(
        link,
        yields_to=yields_to,
        other_yields_to=other_yields_to,
        foes=foes,
        other_foes=other_foes,
    )
