"""Finding the way through the lane graph: which link comes, and where a lane leads."""

from dataclasses import dataclass

from planner.trajectory import Roads
from sim.network import Direction, Link, Location


@dataclass(frozen=True, slots=True)
class Refusal:
    """Why an action does not apply: a clause in words."""

    reason: str


def straight_on(roads: Roads, lane: str) -> Link | Refusal:
    """The link straight on from a lane, if it needs no giving way."""
    straight = [link for link in roads.network.links_from(lane) if link.direction == "straight"]
    if not straight:
        return Refusal("the lane does not lead straight on")
    if straight[0].yields_to:
        return Refusal("a junction comes first, where it has to give way")
    return straight[0]


def link_ahead(roads: Roads, here: Location, direction: Direction, view: float) -> Link | Refusal:
    """The link in a direction at the junction ahead, or the one that is being driven.

    Args:
        roads: the road network.
        here: where the vehicle is.
        direction: where the link leads.
        view: [m] how far ahead a junction is seen.
    """
    network = roads.network
    lane = network.lanes[here.lane]
    inside = network.link_via(here.lane)
    if inside is not None:
        return (
            inside
            if inside.direction == direction
            else Refusal("it is already inside the junction")
        )
    words = "straight on" if direction == "straight" else f"to the {direction}"
    if lane.length - here.offset > view or not network.links_from(here.lane):
        return Refusal("there is no junction in view ahead")
    for link in network.links_from(here.lane):
        if link.direction == direction:
            return link
    elsewhere = any(
        link.direction == direction
        for other in network.edge_lanes(lane.edge)
        for link in network.links_from(other.id)
    )
    return Refusal(f"its lane does not lead {words}" if elsewhere else f"there is no road {words}")


def onward(roads: Roads, lanes: tuple[str, ...], reach: float) -> tuple[str, ...]:
    """Extend connected lanes, straight on where that is possible, to `reach` [m] in all."""
    network, row = roads.network, list(lanes)
    total = sum(network.lanes[lane].length for lane in row)
    while total < reach:
        links = network.links_from(row[-1])
        if not links:
            break
        link = next((link for link in links if link.direction == "straight"), links[0])
        row += [*link.via, link.to_lane]
        total += sum(network.lanes[lane].length for lane in row[-1 - len(link.via) :])
    return tuple(row)
