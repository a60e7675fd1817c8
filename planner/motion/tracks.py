"""Observed tracks, and motions that continue them: coasting and driving on."""

import itertools
import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

import numpy as np

from planner.kernels.limits import FOLLOWING, OPEN
from planner.kernels.projection import SIDE_MARGIN
from planner.manoeuvres.actions import ActionPlan, LaneFollow, Situation
from planner.manoeuvres.layout import waits_along
from planner.manoeuvres.plans import Manoeuvre, ObeyLight
from planner.motion.forward import DT, Motion, drive
from planner.motion.obstacles import Obstacle, Traffic
from planner.roads.routes import onward
from planner.roads.trajectory import KEPT, Array, Path, Roads
from planner.traffic_lights.signals import NO_LIGHTS, Lights
from sim.roads.network import Location, angle_between, project
from sim.scene import Point, Signal, VehicleState

Side: TypeAlias = Literal["left", "right"]

TREND = 5  # steps of a track from which a change of speed is taken
STEADY = 15  # steps after which an unchanged speed counts as the wanted one
RIPPLE = 0.5  # [m/s] greatest variation of a steady speed
INDICATORS: tuple[Side, ...] = ("left", "right")
#: [m/s] faster than which few ride a bicycle; the mean of those without a motor is 4.3 (Schleinitz
#: et al. 2017, The German Naturalistic Cycling Study, Safety Science 92).
CYCLING = 6.0
#: [m] that a vehicle keeps free beside a bicycle that it passes, its own side margin included
#: (German road traffic regulations, StVO, section 5 (4)).
PASSING = 1.5
LEAST_PACE = 3.0  # [m/s] minimum speed at which anybody wants to drive for long
CRAWLING = 2.0  # [m/s] below which a vehicle waits for something
QUEUE = 60.0  # [m] maximum distance between vehicles of one queue
FAR_ASIDE = (5.0, 1.4)  # [m], [rad] greatest offset of a turning vehicle from its lane
AT_LINE = 0.3  # [m] farther away that the lane before a junction may lie than those inside
ON_CENTRELINE = 1.0  # [m] by which rival lanes inside a junction may lie farther away


@dataclass(frozen=True, slots=True, eq=False)
class Observed:
    """One vehicle as seen so far, at 5 Hz, the last sample now."""

    vehicle: int
    length: float  # [m]
    width: float  # [m]
    position: Array  # [m] [N, 2]
    heading: Array  # [rad] [N]
    speed: Array  # [m/s] [N]
    indicating: frozenset[Side] = frozenset()  # the sides that it indicates now
    paced: bool = True  # False: its speed so far does not show how fast it wants to drive
    kind: str = "car"  # what it looks like, as in a scene

    @property
    def elapsed(self) -> int:
        """Steps from the first sample to now."""
        return len(self.speed) - 1

    @property
    def standing(self) -> bool:
        """Whether it stands or crawls, so that it probably waits for something."""
        return float(self.speed[-1]) < CRAWLING

    @property
    def pace(self) -> float:
        """The highest speed [m/s] at which it seems to want to drive; often infinite.

        A vehicle that has driven steadily for a while, and never faster, drives as it wants to.
        """
        lately, fastest = self.speed[-STEADY:], float(np.max(self.speed)) + RIPPLE
        most = max(CYCLING, fastest) if self.kind == "bicycle" else math.inf
        if not self.paced or self.elapsed < STEADY or float(np.ptp(lately)) > RIPPLE:
            return most
        return fastest if lately[-1] >= LEAST_PACE else most

    def situation(self, roads: Roads, sample: int, time: float) -> tuple[Situation, ...]:
        """Return where it may have been at a sample: one entry for each lane that fits."""
        x, y = float(self.position[sample, 0]), float(self.position[sample, 1])
        heading, speed = float(self.heading[sample]), float(self.speed[sample])
        return tuple(
            Situation(time, (x, y), heading, speed, 0.0, location)
            for location in lanes_at(roads, (x, y), heading)
        )


def indicating(state: VehicleState) -> frozenset[Side]:
    """Return the sides that a vehicle indicates."""
    return frozenset(side for side in INDICATORS if side in state.signals)


def berth_of(roads: Roads, observed: Observed) -> float:
    """Return the margin [m] that others keep when they pass a vehicle: more for a bicycle.

    For a bicycle on a lane of its own, the margin is the usual one.
    """
    if observed.kind != "bicycle":
        return SIDE_MARGIN
    lanes = roads.network.lanes
    here = observed.situation(roads, -1, 0.0)[:1]
    own = any("passenger" not in lanes[at.location.lane].permits for at in here)
    return SIDE_MARGIN if own else PASSING


def queued(
    tracks: Sequence[Observed], held: Collection[int] = (), early: int | None = None
) -> list[Observed]:
    """Return vehicles that stand or are held, from the head of a queue on; then the others.

    The vehicle `early` comes first, except for those in front of it.
    """
    waiting = [track for track in tracks if track.standing or track.vehicle in held]
    queue = sorted(waiting, key=lambda track: sum(leads(track, other) for other in waiting))
    queue += [track for track in tracks if track not in waiting]
    for one in [track for track in tracks if track.vehicle == early]:
        queue.sort(key=lambda track: track is not one and not leads(one, track))
    return queue


def leads(track: Observed, other: Observed) -> bool:
    """Check whether another vehicle is in front of one in its track."""
    dx, dy = other.position[-1] - track.position[-1]
    cos, sin = math.cos(track.heading[-1]), math.sin(track.heading[-1])
    along, aside = dx * cos + dy * sin, dy * cos - dx * sin
    return bool(0.0 < along <= QUEUE and abs(aside) <= 0.5 * (track.width + other.width))


def lanes_at(roads: Roads, position: Point, heading: float) -> tuple[Location, ...]:
    """Return the lanes that a pose may belong to: the nearest and, in a junction, its rivals."""
    key = (position, heading)
    found: tuple[Location, ...] | None = roads.located.get(key)
    if found is None:
        if len(roads.located) >= KEPT:
            roads.located.clear()
        found = roads.located[key] = _lanes_at(roads, position, heading)
    return found


def _lanes_at(roads: Roads, position: Point, heading: float) -> tuple[Location, ...]:
    found = roads.network.locate(position, heading)
    if not found:  # a vehicle that turns sharply cuts the corner
        found = roads.network.locate(position, heading, *FAR_ASIDE)
    if not found:
        return ()
    found = _on_one_level(roads, found, position, heading)
    nearest = found[0]
    for location in found:  # a vehicle at a waiting line is still before the junction
        outside = not roads.network.lanes[location.lane].internal
        if outside and abs(location.lateral) <= abs(nearest.lateral) + AT_LINE:
            return (location,)
    return tuple(
        location
        for location in found
        if roads.network.lanes[location.lane].internal
        and abs(location.lateral) <= abs(nearest.lateral) + ON_CENTRELINE
    )


def _on_one_level(
    roads: Roads, found: tuple[Location, ...], position: Point, heading: float
) -> tuple[Location, ...]:
    """Return the lanes that do not pass above or below the one in the direction of the pose."""
    crossing = [x for x in found[1:] if roads.levels.cross(found[0].lane, x.lane)]
    if not crossing:
        return found

    def turned(here: Location) -> float:
        _, _, along = project(roads.network.lanes[here.lane].centreline, position)
        return abs(angle_between(heading, along))

    own = min((found[0], *crossing), key=turned)
    rest = (x for x in found if x != own and not roads.levels.cross(own.lane, x.lane))
    return (own, *rest)


def links_of(roads: Roads, lanes: Sequence[str]) -> frozenset[tuple[str, int]]:
    """Return the links, as (junction, index), that a row of lanes drives along."""
    network = roads.network
    links = [network.link_via(lane) for lane in lanes]
    for lane, after in itertools.pairwise(lanes):  # links without a lane of their own
        links += [x for x in network.links_from(lane) if not x.via and x.to_lane == after]
    return frozenset((link.junction, link.index) for link in links if link is not None)


def coast(
    roads: Roads, observed: Observed, steps: int, *, past: bool, lights: Lights = NO_LIGHTS
) -> Obstacle:
    """Return the vehicle as an obstacle that goes on along its lane as it does now.

    At a line where it must give way, or at a red light, it is assumed to wait, so that vehicles
    with priority do not expect it in their way.

    Args:
        roads: the road network.
        observed: its track.
        steps: how many steps from now on.
        past: whether step 0 is the first sample of the track (else it is now).
        lights: from now on.
    """
    now = observed.situation(roads, -1, 0.0)
    speed = _speeds(roads, observed, now, steps)
    arcs: Array = np.cumsum(speed) * DT
    if now:
        here = now[0]
        row = onward(roads, (here.location.lane,), here.location.offset + arcs[-1] + 5.0)
        path = roads.path(row, here.position, here.heading, 12.0, float(arcs[-1]) + 5.0)
        line = _line_ahead(roads, row, here.location, arcs, lights)
        if line >= speed[0] ** 2 / (2.0 * FOLLOWING):
            arcs, speed = np.minimum(arcs, line), np.where(arcs < line, speed, 0.0)
        position, heading = sample_path(path, arcs, observed.length)
        links = links_of(roads, row)
    else:
        angle = float(observed.heading[-1])
        position = observed.position[-1] + arcs[:, None] * np.array([np.cos(angle), np.sin(angle)])
        heading, links = np.full(steps, angle), frozenset()
    first = 0 if past else observed.elapsed
    if past:
        links |= _links_seen(roads, observed)
    return Obstacle(
        observed.vehicle,
        observed.length,
        observed.width,
        np.vstack((observed.position[first:], position)),
        np.concatenate((observed.heading[first:], heading)),
        np.concatenate((observed.speed[first:], speed)),
        links,
        berth_of(roads, observed),
    )


def aligned(obstacle: Obstacle, shift: int, steps: int) -> Obstacle:
    """Return the obstacle later by `shift` steps: absent before, and cut to 0 ... steps."""
    moved = obstacle.shifted(shift, steps)
    return replace(obstacle, position=moved[:, :2], heading=moved[:, 2], speed=moved[:, 3])


def drive_on(
    roads: Roads,
    here: Situation,
    first: int,
    traffic: Traffic,
    size: tuple[float, float],
    horizon: int,
    pace: float = math.inf,
) -> tuple[Array, Array, Array, tuple[str, ...]]:
    """Return the motion along the road until the horizon, or out of the network.

    Returns:
        Positions [m] [N, 2], headings [rad] [N] and speeds [m/s] [N] after step `first`,
        NaN where the vehicle has left the network, and the lanes driven.
    """
    reach = (horizon - first) * DT * 20.0 + 20.0
    row = onward(roads, (here.location.lane,), here.location.offset + reach)
    path = roads.path(row, here.position, here.heading, 12.0, reach)
    ahead = waits_along(roads, path, row) if traffic.lights is not NO_LIGHTS else ()
    waits = (m for m in ahead if isinstance(m, ObeyLight))
    follow: tuple[Manoeuvre, ...] = (LaneFollow(0.0, path.length), *waits)
    plan = ActionPlan("continue", path, follow, path.length, np.inf, None)
    start = Motion(0.0, here.speed, here.acceleration)
    driven = drive(plan, start, first, traffic, size, horizon, pace)
    arcs, speed = driven.motion[1:, 0], driven.motion[1:, 1]
    position, heading = sample_path(path, arcs, size[0])
    missing = horizon - first - len(arcs)
    position = np.vstack((position, np.full((missing, 2), np.nan)))
    heading = np.concatenate((heading, np.zeros(missing)))
    return position, heading, np.concatenate((speed, np.zeros(missing))), row


def sample_path(path: Path, arcs: Array, length: float) -> tuple[Array, Array]:
    """Return positions [m] [N, 2] and headings [rad] [N] for a vehicle's front at arcs [m]."""
    x = np.interp(arcs, path.arc, path.points[:, 0])
    y = np.interp(arcs, path.arc, path.points[:, 1])
    return np.column_stack((x, y)), path.headings(arcs, length)


def _speeds(roads: Roads, observed: Observed, now: tuple[Situation, ...], steps: int) -> Array:
    """Return speeds [m/s] of a coasting vehicle; it goes on speeding up, to the speed limit."""
    speed = float(observed.speed[-1])
    back = min(TREND, observed.elapsed)
    gained = (speed - float(observed.speed[-1 - back])) / (back * DT) if back else 0.0
    limit = roads.network.lanes[now[0].location.lane].speed_limit if now else speed
    if gained < 0.3 or speed >= limit:
        return np.full(steps, speed)
    growing: Array = speed + gained * DT * np.arange(1, steps + 1, dtype=np.float64)
    return np.minimum(growing, limit)


def _line_ahead(
    roads: Roads, row: Sequence[str], here: Location, arcs: Array, lights: Lights
) -> float:
    """Return the distance [m] to the first line on a row of lanes at which a vehicle must wait.

    Args:
        roads: the road network.
        row: the lanes.
        here: the place on the first of them.
        arcs: [m] arcs that the vehicle would reach by each step.
        lights: from now on.
    """
    ahead = -here.offset
    for lane, after in itertools.pairwise(row):
        ahead += roads.network.lanes[lane].length
        link = roads.network.link_via(after)
        if link is None or link.via[0] != after:
            continue
        shown, line = OPEN, max(ahead - 0.5, 0.0)
        if isinstance(link.control, Signal):
            arrival = int(np.searchsorted(arcs, line))
            shown = int(lights.shows(link.control, arrival + 1)[arrival])
        if shown > OPEN or (shown == OPEN and link.yields_to):
            return line
    return math.inf


def _links_seen(roads: Roads, observed: Observed) -> frozenset[tuple[str, int]]:
    lanes = [
        location.lane
        for sample in range(0, len(observed.speed), 5)
        for location in lanes_at(
            roads,
            (float(observed.position[sample, 0]), float(observed.position[sample, 1])),
            float(observed.heading[sample]),
        )[:1]
    ]
    return links_of(roads, lanes)
