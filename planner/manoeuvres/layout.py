"""The way that a macro action takes: its path, and the junctions and lights on it."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from planner.kernels.limits import COMFORT
from planner.manoeuvres.footways import lines_over
from planner.manoeuvres.plans import (
    ActionPlan,
    Foe,
    GiveWay,
    KeepClear,
    LaneFollow,
    LetCross,
    Manoeuvre,
    ObeyLight,
    Situation,
    Turn,
)
from planner.record.trace import Action, EgoGoal
from planner.roads.classes import links_beside
from planner.roads.routes import direction_of, lane_end, onward
from planner.roads.trajectory import Path, Roads
from sim.roads.network import Direction, Lane, Link, Network, point_at
from sim.scene import Signal

STRAIGHTEN = 12.0  # [m] over which a vehicle beside its centreline returns to it
AHEAD = 80.0  # [m] least length of path beyond the end of an action, to see leaders and bends
FAR = 400.0  # [m] beyond which no action reaches
CLEAR = 5.0  # [m] beyond a junction, where crossing it counts as over
BEFORE_LINE = 0.5  # [m] before a line at which a vehicle waits
INSIDE = 1.0  # [m] beyond its line; farther on, a vehicle blocks those with priority
Wait = GiveWay | KeepClear | LetCross | ObeyLight  # manoeuvres in which a vehicle may have to wait
SHORT = 10.0  # [m] no action ends this close before the goal: the next would begin beyond it


@dataclass(frozen=True, slots=True)
class Crossing:
    """A junction on the way, or a light."""

    link: Link
    enter: float  # [m] arc at which the crossing begins; 0 if the path begins inside it
    out: float  # [m] arc at which the crossing ends
    line: float | None  # [m] arc of the waiting line ahead; None: no need to give way there
    inside: bool
    turns: bool  # whether it leaves the road that the vehicle follows
    direction: Direction
    firsts: tuple[int, ...]  # indices of the links of its junction that have priority
    foes: tuple[Foe, ...]  # the links that cross its way; () unless a light controls it
    on_foot: tuple[LetCross, ...]  # the crossings for people on it


@dataclass(frozen=True, slots=True, eq=False)
class Layout:
    """A path along connected lanes, and beyond them."""

    path: Path
    end: float  # [m] arc at which the last of the lanes ends
    crossings: tuple[Crossing, ...]  # of the junctions between the lanes
    row: tuple[str, ...]  # the lanes of the path from the last of the lanes on

    @classmethod
    def of(
        cls, roads: Roads, here: Situation, lanes: tuple[str, ...], goal: EgoGoal | None
    ) -> "Layout":
        """Lay out the way along lanes that begin with the present one."""
        length = sum(roads.network.lanes[lane].length for lane in lanes)
        reach = length + lookahead(roads, here)
        row = onward(roads, lanes, reach, goal)
        path = roads.path(row, here.position, here.heading, STRAIGHTEN, reach, 1.0)
        begins = _begins(path, row)[: len(lanes)]
        end = begins[-1] + roads.network.lanes[lanes[-1]].length
        crossings = tuple(_crossings(roads, lanes, begins))
        return cls(path, end, crossings, row[len(lanes) - 1 :])

    def manoeuvres(self) -> tuple[Manoeuvre, ...]:
        """Return what is done up to the last turn, in order."""
        return _manoeuvres(self.crossings)


def waits_after(roads: Roads, way: Layout, end: float) -> tuple[Wait, ...]:
    """Return where to wait beyond the lanes of an action that ends at an arc [m].

    A vehicle has to know of these before the action ends: afterwards, it is too late to brake.
    """
    path = way.path
    speed = float(path.cap[min(int(np.searchsorted(path.arc, end)), len(path.cap) - 1)])
    near = end + speed**2 / (2.0 * COMFORT)
    if way.end - BEFORE_LINE > near:
        return ()
    return tuple(m for m in waits_along(roads, path, way.row) if m.stop <= near)


def waits_along(roads: Roads, path: Path, row: tuple[str, ...]) -> tuple[Wait, ...]:
    """Return where to wait along the lanes of a path, assuming that it goes straight on after them.

    Args:
        roads: the road network.
        path: along the lanes; it may begin anywhere on them.
        row: the lanes.
    """
    crossings = _crossings(roads, row, _begins(path, row))
    return tuple(m for m in _manoeuvres(crossings) if isinstance(m, Wait))


def lookahead(roads: Roads, here: Situation) -> float:
    """Return how much path [m] to see beyond an action: enough to brake to a standstill."""
    fastest = max(here.speed, roads.network.lanes[here.location.lane].speed_limit)
    return max(AHEAD, fastest**2 / (2.0 * COMFORT))


def finish(
    roads: Roads,
    action: Action,
    path: Path,
    manoeuvres: tuple[Manoeuvre, ...],
    end: float,
    commit: float,
    goal: EgoGoal | None,
) -> ActionPlan:
    """Return the plan of an action; if it reaches the goal, or nearly so, it ends there."""
    reached = None if goal is None else _goal_arc(roads, path, goal, end)
    return ActionPlan(
        action, path, manoeuvres, end if reached is None else reached, commit, reached
    )


def _manoeuvres(crossings: Iterable[Crossing]) -> tuple[Manoeuvre, ...]:
    """Return what is done at junctions and between them, up to the last turn, in order."""
    found: list[Manoeuvre] = []
    at = 0.0
    for x in crossings:
        if x.turns and not x.inside:
            found.append(LaneFollow(at, x.enter))
        if (x.link.foes or x.link.other_foes) and not x.inside:
            found.append(KeepClear(x.enter - BEFORE_LINE, x.out))
        if isinstance(x.link.control, Signal) and not x.inside:
            found.append(ObeyLight(x.enter - BEFORE_LINE, x.link.control))
        if x.line is not None:
            first = frozenset((x.link.junction, index) for index in x.firsts)
            found.append(GiveWay(x.line, x.out, x.link, first, x.foes))
        found += x.on_foot
        if x.turns:
            found.append(Turn(x.enter, x.out, x.direction))
            at = x.out
    return tuple(found)


def _goal_arc(roads: Roads, path: Path, goal: EgoGoal, end: float) -> float | None:
    for name, start in path.lanes:
        lane = roads.network.lanes[name]
        wanted = lane.edge == goal.edge and goal.lane in (None, lane.index)
        if wanted and 0.0 <= start + goal.position <= min(end + SHORT, path.length):
            return start + goal.position
    return None


def _begins(path: Path, row: tuple[str, ...]) -> list[float]:
    """Return the arc [m] at which each lane of a row begins; passed lanes get the first one's."""
    passed = len(row) - len(path.lanes)
    return [path.lanes[max(k - passed, 0)][1] for k in range(len(row))]


def _crossings(roads: Roads, lanes: tuple[str, ...], begins: list[float]) -> Iterator[Crossing]:
    network, k = roads.network, 0
    while k < len(lanes) - 1:
        inside = network.link_via(lanes[k])
        link = inside or _link_between(roads, lanes, k)
        if link is None:
            return
        gone = link.via.index(lanes[k]) if inside else -1  # index of the lane in the link
        ahead = len(link.via) - gone
        out = begins[min(k + ahead, len(lanes) - 1)]
        enter = 0.0 if inside else begins[k] + network.lanes[lanes[k]].length
        if not inside and link.via:
            enter = begins[k + 1]
        waits = link.waits_inside and len(link.via) > 1
        line = begins[k + 1 - gone] if waits and gone <= 1 else enter
        firsts, foes = _firsts(roads, link), _foes(roads, link)
        due = (firsts or foes) and (not inside or (waits and gone <= 1))
        yield Crossing(
            link,
            enter,
            out,
            line - BEFORE_LINE if due else None,
            inside is not None,
            _turns(roads, link),
            direction_of(roads, link),
            firsts,
            foes,
            tuple(lines_over(roads, link, _beginning(roads, link, begins[k], gone, enter))),
        )
        k += ahead


def _beginning(roads: Roads, link: Link, here: float, gone: int, enter: float) -> float:
    """Return the arc [m] at which a link begins.

    Args:
        roads: the road network.
        link: the link.
        here: [m] arc at which its lane number `gone` begins.
        gone: index of that lane in the link; -1 before the link.
        enter: [m] the arc to return before the link.
    """
    passed = sum(roads.network.lanes[lane].length for lane in link.via[: max(gone, 0)])
    return here - passed if gone >= 0 else enter


def _firsts(roads: Roads, link: Link) -> tuple[int, ...]:
    """Return the links that have priority over a link, including those that are not for cars."""
    beside = links_beside(roads.network, link, link.other_yields_to)
    return (*link.yields_to, *(other.index for other in beside))


def _foes(roads: Roads, link: Link) -> tuple[Foe, ...]:
    """Return the links that cross the way of a link; () unless a light controls it."""
    if not isinstance(link.control, Signal):
        return ()
    found = roads.foes.get((link.junction, link.index))
    if found is None:
        others = roads.network.junction_links(link.junction)
        known = [others[k] for k in link.foes if k in others]
        known += links_beside(roads.network, link, link.other_foes)
        firsts = _firsts(roads, link)
        found = tuple(_foe(roads, other, other.index in firsts) for other in known)
        roads.foes[link.junction, link.index] = found
    return found


def _foe(roads: Roads, link: Link, first: bool) -> Foe:
    begin = link.via[1] if link.waits_inside and len(link.via) > 1 else (*link.via, "")[0]
    network = roads.network
    before = _any_lane(network, link.from_lane)
    (x, y), heading = (
        point_at(_any_lane(network, begin).centreline, 0.0)
        if begin
        else point_at(before.centreline, before.length)
    )
    signal = link.control if isinstance(link.control, Signal) else None
    line = (x, y, math.cos(heading), math.sin(heading))
    return Foe((link.junction, link.index), first, signal, line)


def _any_lane(network: Network, name: str) -> Lane:
    """Return a lane, whether it is for cars or not."""
    return network.lanes[name] if name in network.lanes else network.other_lanes[name]


def _link_between(roads: Roads, lanes: tuple[str, ...], k: int) -> Link | None:
    following = lanes[k + 1 :]
    for link in roads.network.links_from(lanes[k]):
        if (*link.via, link.to_lane) == following[: len(link.via) + 1]:
            return link
    return None


def _turns(roads: Roads, link: Link) -> bool:
    """Check whether a link leaves the road; going on around a roundabout does not count."""
    network = roads.network
    start, end = network.lanes[link.from_lane].edge, network.lanes[link.to_lane].edge
    ring = network.roundabout(start)
    around = ring is not None and end in ring
    return not around and lane_end(roads, link.from_lane).joint != link
