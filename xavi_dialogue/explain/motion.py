"""Motion: what a vehicle has been seen to do, read off its recorded positions and speeds.

Lane changes and turns are told by the shape of the path alone: a vehicle that moves over by a
lane's width and heads the same way again has changed lanes; one that heads elsewhere has turned.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from planner.trace import SAMPLE_PERIOD, Track, TrajectoryPrediction
from sim.network import angle_between
from sim.scene import Point
from xavi_dialogue.explain.query import QueryAction

Trend: TypeAlias = Literal["slowing", "steady", "speeding-up", "standing"]

STANDING = 0.3  # [m/s] below which a vehicle stands
CHANGED = 1.5  # [m/s] by which a speed has changed
TREND_TIME = 1.0  # [s] over which a trend is judged
TREND = 0.4  # [m/s2] from which it is one
TURNED = math.radians(50.0)
ALONG = math.radians(10.0)  # difference of heading that still counts as the same way
SLANT = math.radians(30.0)  # difference of heading within a lane change at most
LANE_SHIFT = (2.2, 5.5)  # [m] sideways in one lane change
LANE_TIME = 6.0  # [s] that a lane change takes at most
TURN_TIME = 8.0  # [s]
WAVER = 0.15  # [m/s] of speed that do not end a stretch of slowing down


@dataclass(frozen=True, slots=True)
class Sighting:
    """Something that a vehicle was seen to do."""

    action: QueryAction
    start: float  # [s]
    end: float  # [s]

    @property
    def span(self) -> tuple[float, float]:
        """From when to when [s]."""
        return self.start, self.end


@dataclass(frozen=True, slots=True)
class Motion:
    """The recorded motion of one vehicle, oldest first; all lists have the same length N."""

    time: tuple[float, ...]  # [s] [N]
    position: tuple[Point, ...]  # [m] [N]
    heading: tuple[float, ...]  # [rad] [N]
    speed: tuple[float, ...]  # [m/s] [N]

    def until(self, time: float) -> "Motion":
        """The part up to a time [s]."""
        n = sum(moment <= time + 1e-6 for moment in self.time)
        return Motion(self.time[:n], self.position[:n], self.heading[:n], self.speed[:n])

    @property
    def trend(self) -> Trend | None:
        """What the speed is doing at the end; None without a record."""
        if not self.time:
            return None
        if self.speed[-1] < STANDING:
            return "standing"
        back = next(
            k for k, moment in enumerate(self.time) if moment >= self.time[-1] - TREND_TIME - 1e-6
        )
        span = self.time[-1] - self.time[back]
        rate = (self.speed[-1] - self.speed[back]) / span if span > 0.0 else 0.0
        if abs(rate) < TREND:
            return "steady"
        return "slowing" if rate < 0.0 else "speeding-up"

    @property
    def since_standing(self) -> float | None:
        """Since when [s] it stands, as far as is known; None where it drives."""
        still = None
        for moment, speed in zip(reversed(self.time), reversed(self.speed), strict=True):
            if speed >= STANDING:
                break
            still = moment
        return still

    def sightings(self) -> tuple[Sighting, ...]:
        """What was done, in order of its start."""
        found = [*self._speeds(), *self._stops(), *self._turns(), *self._changes()]
        return tuple(sorted(found, key=lambda s: (s.start, s.end, s.action)))

    def times(self, action: QueryAction) -> tuple[Sighting, ...]:
        """All times that something was done, oldest first."""
        return tuple(s for s in self.sightings() if s.action in _means(action))

    def last(self, action: QueryAction) -> Sighting | None:
        """The last time that something was done."""
        return next(reversed(self.times(action)), None)

    def _speeds(self) -> list[Sighting]:
        return [
            *self._changes_of_speed("slow-down", -1.0),
            *self._changes_of_speed("speed-up", 1.0),
        ]

    def _changes_of_speed(self, action: QueryAction, sign: float) -> Iterator[Sighting]:
        """The stretches over which the speed grows, or falls where the sign is -1."""
        foot = start = best = 0  # where it is measured from; where it leaves that; its end so far
        for k in range(1, len(self.speed) + 1):
            if k == len(self.speed) or sign * (self.speed[k] - self.speed[best]) < -WAVER:
                if sign * (self.speed[best] - self.speed[foot]) >= CHANGED:
                    yield Sighting(action, self.time[start], self.time[best])
                foot = start = best = min(k, len(self.speed) - 1)
                continue
            change = sign * (self.speed[k] - self.speed[foot])
            if change <= 0.0:
                foot = k
            if change <= WAVER:  # a flat beginning is no part of it
                start = best = k
            elif sign * (self.speed[k] - self.speed[best]) > 0.0:
                best = k

    def _stops(self) -> list[Sighting]:
        """Standstills; one that was there when the vehicle came into view is not its coming to."""
        found: list[Sighting] = []
        for k in range(1, len(self.speed)):
            if self.speed[k] < STANDING <= self.speed[k - 1]:
                still = [j for j in range(k, len(self.speed)) if self.speed[j] >= STANDING]
                end = still[0] if still else len(self.speed) - 1
                found.append(Sighting("stop", self.time[k], self.time[end]))
        return found

    def _turns(self) -> list[Sighting]:
        found: list[Sighting] = []
        start = 0
        for k in range(len(self.time)):
            while self.time[k] - self.time[start] > TURN_TIME:
                start += 1
            turned = angle_between(self.heading[k], self.heading[start])
            if abs(turned) >= TURNED:
                action: QueryAction = "exit-left" if turned > 0.0 else "exit-right"
                found.append(Sighting(action, self.time[start], self.time[k]))
                start = k
        return found

    def _changes(self) -> list[Sighting]:
        found: list[Sighting] = []
        start = 0
        for k in range(len(self.time)):
            while self.time[k] - self.time[start] > LANE_TIME:
                start += 1
            for back in range(start, k):
                shift = self._sideways(back, k)
                if LANE_SHIFT[0] <= abs(shift) <= LANE_SHIFT[1]:
                    action: QueryAction = "change-left" if shift > 0.0 else "change-right"
                    found.append(Sighting(action, self.time[back], self.time[k]))
                    start = k
                    break
        return found

    def _sideways(self, a: int, b: int) -> float:
        """By how much [m] to its left a vehicle moved between two samples; 0 if it turned.

        Judged along both headings, so that neither a bend nor a slanted start counts.
        """
        if abs(angle_between(self.heading[b], self.heading[a])) > ALONG:
            return 0.0
        if any(abs(angle_between(h, self.heading[a])) > SLANT for h in self.heading[a:b]):
            return 0.0  # a bend and its counterpart, round a corner or a roundabout
        dx = self.position[b][0] - self.position[a][0]
        dy = self.position[b][1] - self.position[a][1]
        first, last = (
            dy * math.cos(heading) - dx * math.sin(heading)
            for heading in (self.heading[a], self.heading[b])
        )
        return min(first, last, key=abs) if first * last > 0.0 else 0.0


def join(tracks: Sequence[Track]) -> Motion:
    """Join overlapping tracks of one vehicle, in order of time."""
    times: list[float] = []
    positions: list[Point] = []
    headings: list[float] = []
    speeds: list[float] = []
    for track in tracks:
        for k in range(len(track.speed)):
            moment = track.start + k * SAMPLE_PERIOD
            if not times or moment > times[-1] + SAMPLE_PERIOD / 2.0:
                times.append(round(moment, 3))
                positions.append(track.position[k])
                headings.append(track.heading[k])
                speeds.append(track.speed[k])
    return Motion(tuple(times), tuple(positions), tuple(headings), tuple(speeds))


def foresees(way: TrajectoryPrediction, action: QueryAction) -> bool:
    """Whether a predicted trajectory contains an action, or a change of speed it describes.

    Who stands already stops if it stays, or stops again. Of a trajectory whose line the trace has
    no room for, the actions alone are known.
    """
    if not way.speed:
        return any(step in _means(action) for step in way.actions)
    if action == "slow-down":
        return min(way.speed) <= way.speed[0] - CHANGED
    if action == "speed-up":
        return max(way.speed) >= min(way.speed) + CHANGED
    if action in ("stop", "give-way"):
        return "stop" in way.actions or _halts(way.speed)
    return any(step in _means(action) for step in way.actions)


def _halts(speed: Sequence[float]) -> bool:
    off = next((k for k, value in enumerate(speed) if value >= STANDING), None)
    return off is None or min(speed[off:]) < STANDING


def _means(action: QueryAction) -> tuple[QueryAction, ...]:
    """The things seen or predicted that an action of a question may stand for."""
    meanings: dict[QueryAction, tuple[QueryAction, ...]] = {
        "continue": ("continue", "exit-straight"),
        "exit-straight": ("continue", "exit-straight"),
        "overtake": ("change-left", "change-right"),
        "give-way": ("stop",),
    }
    return meanings.get(action, (action,))
