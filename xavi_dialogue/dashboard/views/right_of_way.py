"""Right of way at the junction that the ego comes to next."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from planner.record.trace import PlanTrace
from sim.roads.network import Direction, Link, Network
from sim.scene import EGO, Point
from xavi_dialogue.dashboard.views.map import link_ids
from xavi_dialogue.dashboard.web.http_documents import RightOfWay

NEAR = 2.5  # [m] greatest distance of a line from both ends of a way that it takes
AT_LINE = 5.0  # [m] greatest distance to the stop line for a plan that ends waiting there
SOON = 60.0  # [m] from a junction, within which a vehicle without a known line counts
LIKELY = 0.05  # least probability of a prediction that counts
HOPS = 10  # junctions without crossing traffic that are skipped
TURNS: dict[str, Direction] = {"exit-left": "left", "exit-right": "right"}


def right_of_way(
    trace: PlanTrace, network: Network, path: Sequence[float] | None
) -> RightOfWay | None:
    """Return who goes first at the next junction where others cross the ego's way; None: none.

    Args:
        trace: the decision.
        network: the roads.
        path: [m] x, y, x, y, ... of the ego under its plan; None: not in the record.
    """
    line = None if path is None else np.array(path).reshape(-1, 2)
    link = _next_link(trace, network, line)
    if link is None:
        return None
    ids, around = link_ids(network), network.junction_links(link.junction)
    first = [around[index] for index in link.yields_to if index in around]
    return RightOfWay(
        junction=link.junction,
        ego=ids[link.junction, link.index],
        goes_first=tuple(ids[one.junction, one.index] for one in first),
        vehicles=_heading_there(trace, network, first),
    )


def _next_link(trace: PlanTrace, network: Network, line: NDArray[np.float64] | None) -> Link | None:
    ego = trace.scene[EGO]
    lanes = [location.lane for location in network.locate(ego.position, ego.heading)]
    for _ in range(HOPS):
        if not lanes:
            return None
        inside = [link for lane in lanes if (link := network.link_via(lane)) is not None]
        if inside:
            link = _left_by(network, inside, line)
        else:
            beside = network.edge_lanes(network.lanes[lanes[0]].edge)
            ahead = [link for lane in beside for link in network.links_from(lane.id)]
            link = _taken(trace, network, ahead, lanes, line)
        if link is None or link.foes:
            return link
        lanes = [link.to_lane]
    return None


def _left_by(network: Network, links: Sequence[Link], line: NDArray[np.float64] | None) -> Link:
    """Return our ways through a junction that we may be on, likeliest first."""
    along = [x for x in links if line is not None and _distance(line, _end(network, x)) <= NEAR]
    return (along or links)[0]


def _taken(
    trace: PlanTrace,
    network: Network,
    links: Sequence[Link],
    lanes: Sequence[str],
    line: NDArray[np.float64] | None,
) -> Link | None:
    """Return the way that is taken: the one along the line, or else the one that fits the plan."""
    if line is not None:
        missed = [(_distance(line, _end(network, link)), link) for link in links]
        missed = [pair for pair in missed if pair[0] <= NEAR]
        if missed:
            both = [(gap + _distance(line, _start(network, link)), link) for gap, link in missed]
            return min(both, key=lambda pair: pair[0])[1]
        starts = [_distance(line, _start(network, link)) for link in links]
        if min(starts, default=math.inf) > AT_LINE:
            return None  # the plan ends before
    wanted = next((TURNS[p.action] for p in trace.plan if p.action in TURNS), "straight")
    own = [link for link in links if link.from_lane in lanes] or list(links)
    fitting = [link for link in own if link.direction == wanted] or own
    return fitting[0] if fitting else None


def _heading_there(trace: PlanTrace, network: Network, links: Sequence[Link]) -> tuple[int, ...]:
    """Return the other vehicles on some ways through a junction, or probably heading there."""
    ways = {
        known.vehicle: [
            np.array(way.path)
            for goal in known.goals
            for way in goal.trajectories
            if way.path and goal.probability * way.probability >= LIKELY
        ]
        for known in trace.predictions
    }
    found = []
    for vehicle, state in trace.scene.items():
        if vehicle == EGO:
            continue
        on = {location.lane for location in network.locate(state.position, state.heading)}
        there = any(on & set(link.via) for link in links)
        lines = ways.get(vehicle)
        if lines:
            there |= any(_passes(network, link, way) for way in lines for link in links)
        else:
            there |= any(
                link.from_lane in on and math.dist(state.position, _start(network, link)) <= SOON
                for link in links
            )
        if there:
            found.append(vehicle)
    return tuple(sorted(found))


def _passes(network: Network, link: Link, way: NDArray[np.float64]) -> bool:
    start, end = _start(network, link), _end(network, link)
    return _distance(way, end) <= NEAR and _distance(way, start) <= NEAR


def _start(network: Network, link: Link) -> Point:
    return network.lanes[link.from_lane].centreline[-1]


def _end(network: Network, link: Link) -> Point:
    return network.lanes[link.to_lane].centreline[0]


def _distance(line: NDArray[np.float64], point: Point) -> float:
    """Return the distance [m] from a point to the nearest point of a line."""
    return float(np.min(np.hypot(line[:, 0] - point[0], line[:, 1] - point[1])))
