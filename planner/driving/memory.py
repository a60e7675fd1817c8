"""The memory of the car: what it has seen, and vehicles that are hidden for a while.

A vehicle that is lost from sight behind a tall one is assumed to go on as before. It is forgotten
when it should be seen and is not, or after HIDDEN seconds.
"""

import math
from collections import deque
from dataclasses import dataclass, replace

import msgspec
import numpy as np

from planner.hidden_areas.phantoms import Counts
from planner.motion.forward import DT
from planner.motion.obstacles import Obstacle
from planner.motion.road_users import going_on, road_users_in
from planner.motion.tracks import Observed
from planner.record.places import LightChange
from planner.record.trace import ON_FOOT, Track
from planner.roads.sightlines import between, middle
from planner.roads.trajectory import Roads
from planner.traffic_lights.observations import Watched, watch
from sim.scene import EGO, Scene, VehicleState

HISTORY = 10.0  # [s]
HIDDEN = 5.0  # [s] for which a hidden vehicle is remembered
CHANGES = 40  # maximum number of changes of a controller that are remembered
TALL = ("truck", "bus", "trailer")  # kinds that hide what is behind them


@dataclass(frozen=True, slots=True)
class Lost:
    """A vehicle that was lost from sight."""

    since: float  # [s] when it was seen last
    last: VehicleState
    going_on: Obstacle  # from then on

    def at(self, time: float) -> VehicleState | None:
        """Return its assumed state; None if it would have left the network."""
        step = (time - self.since) / DT
        k = min(int(step), len(self.going_on.speed) - 2)
        share = min(step - k, 1.0)
        here, there = self.going_on.position[k], self.going_on.position[k + 1]
        x, y = (1.0 - share) * here + share * there
        if not math.isfinite(x):
            return None
        heading, speed = float(self.going_on.heading[k]), float(self.going_on.speed[k])
        return replace(
            self.last, position=(float(x), float(y)), heading=heading, speed=speed, acceleration=0.0
        )


class Memory:
    """The states of all vehicles over the last HISTORY seconds, and the changes of lights."""

    def __init__(self, roads: Roads) -> None:
        self._roads = roads
        self._seen: dict[int, deque[tuple[float, VehicleState]]] = {}
        self._lost: dict[int, Lost] = {}
        self._assumed: dict[int, deque[tuple[float, float]]] = {}  # [s] spans out of sight
        self._watched: dict[str, Watched] = {}
        self._controllers: frozenset[str] = frozenset()  # in view
        self.counts = Counts()  # of vehicles on roads that lead out of hidden areas

    def observe(self, scene: Scene) -> None:
        """Store what is seen now."""
        everybody = road_users_in(scene)
        for vehicle in [x for x in self._seen if x not in everybody]:
            self._recall(vehicle, scene)
        for vehicle, state in everybody.items():
            lost = self._lost.pop(vehicle, None)
            if lost is not None:
                self._assumed.setdefault(vehicle, deque()).append((lost.since, scene.time))
            self._note(vehicle, scene.time, state)
        self._watch(scene)

    @property
    def watched(self) -> tuple[Watched, ...]:
        """The observations of the traffic lights in view."""
        return tuple(self._watched[name] for name in sorted(self._controllers))

    @property
    def now(self) -> dict[int, VehicleState]:
        """The states of all, hidden ones included, by number, as the trace records them."""
        return {vehicle: self._seen[vehicle][-1][1] for vehicle in sorted(self._seen)}

    @property
    def unseen(self) -> dict[int, float]:
        """The times [s] when hidden road users were last seen, by number."""
        return {vehicle: self._lost[vehicle].since for vehicle in sorted(self._lost)}

    def track(self, vehicle: int, time: float) -> Track:
        """Return the history of a vehicle at 5 Hz, the last sample now; without its lights."""
        return _resampled(self._seen[vehicle], time)

    def recorded(self, vehicle: int, time: float) -> Track:
        """Return the history with what the vehicle showed and when it was hidden."""
        track = self.track(vehicle, time)
        lights: tuple[LightChange, ...] = ()
        if self._seen[vehicle][-1][1].kind not in ON_FOOT:
            lights = _lights(self._seen[vehicle], track.start)
        spans = [*self._assumed.get(vehicle, ())]
        if vehicle in self._lost:
            spans.append((self._lost[vehicle].since, time))
        assumed = tuple((round(a, 3), round(b, 3)) for a, b in spans if b > track.start)
        return msgspec.structs.replace(track, lights=lights, assumed=assumed)

    def _note(self, vehicle: int, time: float, state: VehicleState) -> None:
        seen = self._seen.setdefault(vehicle, deque())
        seen.append((time, _rounded(state)))
        while seen[0][0] < time - HISTORY - 1e-6:
            seen.popleft()
        spans = self._assumed.get(vehicle)
        while spans and spans[0][1] < time - HISTORY:
            spans.popleft()

    def _watch(self, scene: Scene) -> None:
        """Store what traffic lights show."""
        shown: dict[str, dict[int, str]] = {}
        for light in scene.lights:
            shown.setdefault(light.signal.controller, {})[light.signal.index] = light.state.value
        for name in sorted({*shown, *self._controllers}):
            before = self._watched.get(name)
            now = shown.get(name, {})
            self._watched[name] = watch(before, name, now, scene.time, CHANGES)
        self._controllers = frozenset(shown)

    def _recall(self, vehicle: int, scene: Scene) -> None:
        """Keep a vehicle that is not seen at its assumed place, or forget it."""
        lost = self._lost.get(vehicle) or self._lose(vehicle)
        state = lost.at(scene.time) if scene.time - lost.since <= HIDDEN else None
        if state is None or not hidden(state, scene):
            del self._seen[vehicle]
            self._lost.pop(vehicle, None)
            self._assumed.pop(vehicle, None)
            return
        self._lost[vehicle] = lost
        self._note(vehicle, scene.time, state)

    def _lose(self, vehicle: int) -> Lost:
        since, last = self._seen[vehicle][-1]
        track = _resampled(self._seen[vehicle], since)
        watched = Observed(
            vehicle,
            last.length,
            last.width,
            np.array(track.position),
            np.array(track.heading),
            np.array(track.speed),
            kind=last.kind,
        )
        steps = math.ceil(HIDDEN / DT) + 1
        return Lost(since, last, going_on(self._roads, watched, steps))


def hidden(state: VehicleState, scene: Scene) -> bool:
    """Check whether a tall vehicle stands between the middles of the ego and of another vehicle."""
    here, there = middle(scene.ego), middle(state)
    tall = (other for name, other in scene.vehicles.items() if name != EGO and other.kind in TALL)
    return any(between(here, there, other) for other in tall)


def _rounded(state: VehicleState) -> VehicleState:
    """Return the state as traces record it, so that a trace holds all that a decision used."""
    return replace(
        state,
        position=(round(state.position[0], 2), round(state.position[1], 2)),
        heading=round(state.heading, 4),
        speed=round(state.speed, 2),
        acceleration=round(state.acceleration, 2),
    )


def _resampled(seen: deque[tuple[float, VehicleState]], time: float) -> Track:
    """Return a history at 5 Hz, counted back from now."""
    states: list[VehicleState] = []
    start, wanted = time, time
    for moment, state in reversed(seen):
        if moment <= wanted + 1e-6:
            states.append(state)
            start, wanted = moment, wanted - DT
    states.reverse()
    return Track(
        round(start, 3),
        tuple(state.position for state in states),
        tuple(state.heading for state in states),
        tuple(state.speed for state in states),
    )


def _lights(seen: deque[tuple[float, VehicleState]], start: float) -> tuple[LightChange, ...]:
    """Return the lights shown at a moment [s], and every change since."""
    found: list[LightChange] = []
    for time, state in seen:
        if time <= start + 1e-3:
            found = [LightChange(start, state.signals)]
        elif not found or found[-1].shown != state.signals:
            found.append(LightChange(round(time, 3), state.signals))
    return tuple(found)
