"""Rules of the road that a drive keeps or breaks: traffic lights, crossings, limits, the road.

- A light is passed when the ego's front comes to the end of its lane before a link that the
  light controls; it is passed on red if it shows red in that step and in the one before.
- A crossing is violated if the ego's front comes onto it while somebody on foot is there who may
  cross by its light, if it has one, and who is in the ego's way now or, by walking on, within two
  seconds.
- A limit is violated if the ego drives 0.5 m/s above it for half a second. If the ego may be on
  any of several lanes, inside a junction, the highest limit counts.
- The ego is off the road if a corner of its box is on no lane that vehicles may use and in no
  junction.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from sim.boxes import corners
from sim.roads.network import Crossing, Lane, Link, Location, Network, cumulative, point_at, project
from sim.scene import LightState, PersonState, Point, Scene, Signal

RED = (LightState.RED, LightState.RED_AMBER)
PAST = 0.3  # [m] beyond its line, from which on a light counts as passed
SAME = 0.5  # [m] greatest difference of the distances to lanes that may be the ego's
OVER = 0.5  # [m/s] least excess of speed above a limit
HELD = 0.5  # [s] least duration of the excess
MOVING = 0.5  # [m/s] speed from which on the ego does not wait
BESIDE = 1.0  # [m] from the ego's side, within which somebody is in its way
SOON = 2.0  # [s] within which somebody who walks on must be in the ego's way
WALKING = 0.3  # [m/s] least speed towards the ego of somebody who walks on
REACH = 60.0  # [m] greatest distance from a crossing's middle
SHOULDER = 0.3  # [m] beside a lane that still belong to the road
AROUND = 3.0  # [m] around the lanes inside a junction that belong to the junction
ON_FOOT = frozenset({"pedestrian"})


@dataclass(frozen=True, slots=True)
class Broken:
    """The times [s] at which rules were broken."""

    lights: int  # number of lights passed
    reds: tuple[float, ...]
    crossings: int  # number driven over while somebody on foot was there
    violated: tuple[float, ...]
    limits: tuple[float, ...]
    off_road: tuple[float, ...]  # when leaving the road


@dataclass
class _Passing:
    """The passing of a lane's end while the link taken is not known yet."""

    lane: Lane
    time: float
    red: frozenset[Signal]


@dataclass
class Rules:
    """An observer of a drive, scene by scene."""

    network: Network
    _reds: list[float] = field(default_factory=list)
    _lights: int = 0
    _crossings: int = 0
    _violated: list[float] = field(default_factory=list)
    _limits: list[float] = field(default_factory=list)
    _off: list[float] = field(default_factory=list)
    _lane: Lane | None = None  # the last lane outside of junctions
    _passing: _Passing | None = None
    _red: frozenset[Signal] = frozenset()
    _over: Crossing | None = None
    _fast: float | None = None  # [s] time since which the ego is above the limit
    _was_off: bool = False

    def __post_init__(self) -> None:
        middles = [x.line[len(x.line) // 2] for x in self.network.crossings]
        self._middles = np.array(middles).reshape(-1, 2)

    def see(self, scene: Scene) -> None:
        """Add one scene."""
        places = self._places(scene)
        self._see_light(scene, places)
        self._see_crossing(scene)
        self._see_limit(scene, places)
        off = self._is_off(scene, places)
        if off and not self._was_off:
            self._off.append(scene.time)
        self._was_off = off

    def broken(self) -> Broken:
        """Return the violations so far."""
        waiting = self._passing
        if waiting is not None and self._may_be_red(waiting):
            self._reds.append(waiting.time)
            self._passing = None
        times = (self._reds, self._violated, self._limits, self._off)
        reds, violated, limits, off = (tuple(round(t, 2) for t in found) for found in times)
        return Broken(self._lights, reds, self._crossings, violated, limits, off)

    def _places(self, scene: Scene) -> tuple[Location, ...]:
        """Return the lanes that may be the ego's."""
        found = self.network.locate(scene.ego.position, scene.ego.heading)
        least = abs(found[0].lateral) if found else 0.0
        return tuple(x for x in found if abs(x.lateral) <= least + SAME)

    def _see_light(self, scene: Scene, places: tuple[Location, ...]) -> None:
        red = frozenset(light.signal for light in scene.lights if light.state in RED)
        if self._lane is not None and self._passing is None:
            end, heading = point_at(self._lane.centreline, self._lane.length)
            if _ahead(end, heading, scene.ego.position) >= PAST:
                self._passing = _Passing(self._lane, scene.time, red & self._red)
        self._red = red
        outside = next((x for x in places if not self.network.lanes[x.lane].internal), None)
        inside = any(self.network.lanes[x.lane].internal for x in places)
        if outside is None or (inside and self._passing is not None):
            return
        lane = self.network.lanes[outside.lane]
        if self._passing is not None and lane.edge != self._passing.lane.edge:
            self._resolve(self._passing, lane)
        if self._passing is None or lane.edge != self._passing.lane.edge:
            self._lane, self._passing = lane, None

    def _resolve(self, passing: _Passing, lane: Lane) -> None:
        """Count a light that was passed, now that the lane beyond is known."""
        link = self._link(passing.lane, lane)
        if link is not None and isinstance(link.control, Signal):
            self._lights += 1
            if link.control in passing.red:
                self._reds.append(passing.time)

    def _link(self, start: Lane, end: Lane) -> Link | None:
        """Return the link from one lane to another, or else between their edges."""
        lanes = self.network.edge_lanes(start.edge)
        found = [x for lane in lanes for x in self.network.links_from(lane.id)]
        found = [x for x in found if self.network.lanes[x.to_lane].edge == end.edge]
        own = ((x.from_lane == start.id) + (x.to_lane == end.id) for x in found)
        ranked = sorted(zip(own, found, strict=True), key=lambda pair: -pair[0])
        return ranked[0][1] if ranked else None

    def _may_be_red(self, passing: _Passing) -> bool:
        """Check whether all links from the ego's lane were red, if the drive ends in a junction."""
        controls = [link.control for link in self.network.links_from(passing.lane.id)]
        return bool(controls) and all(control in passing.red for control in controls)

    def _see_crossing(self, scene: Scene) -> None:
        here = self._crossing(scene.ego.position)
        if here is not None and here != self._over and scene.ego.speed > MOVING:
            walking = [p for p in scene.people.values() if self._crossing(p.position) == here]
            self._crossings += bool(walking)
            if any(_in_the_way(here, scene, person) for person in walking):
                self._violated.append(scene.time)
        self._over = here

    def _crossing(self, position: Point) -> Crossing | None:
        near = np.flatnonzero(np.hypot(*(self._middles - np.array(position)).T) <= REACH)
        for crossing in (self.network.crossings[k] for k in near):
            offset, lateral, _ = project(crossing.line, position)
            long = cumulative(crossing.line)[-1]
            if 0.0 <= offset <= long and abs(lateral) <= crossing.width / 2.0:
                return crossing
        return None

    def _see_limit(self, scene: Scene, places: tuple[Location, ...]) -> None:
        limits = [self.network.lanes[x.lane].speed_limit for x in places]
        if not limits or scene.ego.speed <= max(limits) + OVER:
            self._fast = None
        elif self._fast is None:
            self._fast = scene.time
        elif math.isfinite(self._fast) and scene.time - self._fast >= HELD:
            self._limits.append(self._fast)
            self._fast = math.inf  # the violation is counted

    def _is_off(self, scene: Scene, places: tuple[Location, ...]) -> bool:
        if any(self.network.lanes[x.lane].internal for x in places):
            return False
        return not all(self._on_road(corner) for corner in corners(scene.ego))

    def _on_road(self, corner: Point) -> bool:
        for lane, place in self._lanes_at(corner):
            reach = AROUND if lane.internal else SHOULDER
            if abs(place.lateral) <= lane.width / 2.0 + reach:
                return True
        return False

    def _lanes_at(self, corner: Point) -> Iterator[tuple[Lane, Location]]:
        """Yield the lanes of vehicles near a place, in any direction."""
        for place in self.network.locate(corner, 0.0, 6.0, math.pi):
            yield self.network.lanes[place.lane], place
        for place in self.network.locate_aside(corner, 0.0, 6.0, math.pi):
            lane = self.network.other_lanes[place.lane]
            if lane.permits != ON_FOOT:
                yield lane, place


def _ahead(place: Point, heading: float, position: Point) -> float:
    """Return how far [m] a position is beyond a place, along a heading."""
    dx, dy = position[0] - place[0], position[1] - place[1]
    return dx * math.cos(heading) + dy * math.sin(heading)


def _in_the_way(crossing: Crossing, scene: Scene, person: PersonState) -> bool:
    """Check whether somebody on a crossing may cross, and is or will soon be before the ego."""
    shown = None if not isinstance(crossing.control, Signal) else scene.light(crossing.control)
    if shown is not None and shown.state in RED:
        return False
    _, _, along = project(crossing.line, scene.ego.position)
    apart = _ahead(scene.ego.position, along, person.position)
    free = abs(apart) - scene.ego.width / 2.0
    if free <= BESIDE:
        return True
    towards = -math.copysign(1.0, apart) * math.cos(person.heading - along) * person.speed
    return towards > WALKING and free / towards <= SOON
