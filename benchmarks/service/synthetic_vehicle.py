"""A synthetic car: invented traffic and reports on a bus, like those of a real car."""

import random
import secrets
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from planner.record.events import Event
from planner.record.trace import PlanTrace
from sim.roads.network import Lane, Network, point_at
from sim.scene import Scene, VehicleState
from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import Bus, Keys, Presence
from xavi_dialogue.bus.messages import CarState, EventReport, SceneReport, TraceReport, pack
from xavi_dialogue.vehicle.map_server import serve_roads
from xavi_dialogue.vehicle.telemetry import KEPT_EVENTS, KEPT_TRACES

ROOM = 12.0  # [m] of a lane for each vehicle that begins on it
PACES = (6.0, 14.0)  # [m/s] least and greatest speed
#: kind, length and width [m]; most are cars.
MAKES = (
    *(("car", 4.5, 1.8),) * 7,
    *(("truck", 10.0, 2.5), ("bus", 12.0, 2.5), ("motorcycle", 2.2, 0.8)),
)
COLOURS = ("red", "white", "blue", None, "yellow", "black", "green")


@dataclass
class _Mover:
    """One vehicle on its way from lane to lane."""

    lane: Lane
    offset: float  # [m] along the lane
    speed: float  # [m/s]
    make: tuple[str, float, float]
    colour: str | None
    ahead: list[Lane] = field(default_factory=list)  # lanes that follow on its way


class Traffic:
    """Vehicles that drive on a network at steady speeds and ignore one another."""

    def __init__(self, network: Network, count: int, seed: int) -> None:
        """Put vehicles on the roads.

        Args:
            network: the roads.
            count: of vehicles, the ego among them.
            seed: of where they begin and which way they take.

        Raises:
            ValueError: there is not so much room.
        """
        self._network, self._dice = network, random.Random(seed)
        roads = [lane for lane in network.lanes.values() if not lane.internal]
        spots = [(lane, k * ROOM) for lane in roads for k in range(1, int(lane.length / ROOM))]
        if len(spots) < count:
            raise ValueError(f"{count} vehicles; these roads have room for {len(spots)}")
        self._movers = [
            _Mover(
                *spot,
                self._dice.uniform(*PACES),
                self._dice.choice(MAKES) if k else MAKES[0],
                self._dice.choice(COLOURS),
            )
            for k, spot in enumerate(self._dice.sample(spots, count))
        ]

    def go_on(self, seconds: float) -> None:
        """Advance by a time [s]."""
        for mover in self._movers:
            mover.offset += mover.speed * seconds
            while mover.offset > mover.lane.length:
                mover.offset -= mover.lane.length
                mover.lane = self._next(mover)

    @property
    def vehicles(self) -> dict[int, VehicleState]:
        """Return all vehicles by name; the ego is 0."""
        return {name: _state(mover) for name, mover in enumerate(self._movers)}

    def _next(self, mover: _Mover) -> Lane:
        """Return the lane after a vehicle's, or some other one at the end of the map."""
        lanes = self._network.lanes
        if not mover.ahead:
            links = self._network.links_from(mover.lane.id)
            if not links:
                roads = [lane for lane in lanes.values() if not lane.internal]
                return self._dice.choice(roads)
            link = self._dice.choice(links)
            mover.ahead = [lanes[lane] for lane in (*link.via, link.to_lane)]
        return mover.ahead.pop(0)


def _state(mover: _Mover) -> VehicleState:
    (x, y), heading = point_at(mover.lane.centreline, mover.offset)
    kind, length, width = mover.make
    place = (round(x, 3), round(y, 3))
    speed = round(mover.speed, 3)
    return VehicleState(place, round(heading, 4), speed, 0.0, length, width, kind, mover.colour)


class SyntheticVehicle:
    """A car that reports scenes, traces and events as requested."""

    def __init__(self, bus: Bus, keys: Keys, roads: Path | None = None) -> None:
        """Begin a ride.

        Args:
            bus: to report on.
            keys: of the car.
            roads: the network file to serve; None: none is served.
        """
        self._bus, self._keys = bus, keys
        self._alive: Presence | None = None
        if roads is not None:
            serve_roads(bus, keys, roads)
        self._scene = bus.publisher(keys.of("scene"))
        self._trace = bus.publisher(keys.of("trace"), keep=KEPT_TRACES)
        self._event = bus.publisher(keys.of("event"), keep=KEPT_EVENTS)
        self.ride = secrets.token_hex(4)
        self.scenario: str | None = None  # name of the ride's scenario
        self.scenes = self.traces = self.events = 0
        self._first: str | None = None

    def appear(self) -> None:
        """Appear on the bus."""
        self._alive = HealthReporter("car").serve(self._bus, self._keys)

    def vanish(self) -> None:
        """Disappear from the bus."""
        if self._alive is not None:
            self._alive.withdraw()

    def see(
        self, now: float, vehicles: Mapping[int, VehicleState], state: CarState = "driving"
    ) -> None:
        """Report vehicles at a simulation time [s]."""
        self.see_all(Scene(now, vehicles), state)

    def see_all(self, scene: Scene, state: CarState = "driving") -> None:
        """Report a scene."""
        report = SceneReport(
            ride=self.ride,
            seq=self.scenes,
            sim_time=scene.time,
            wall_time=time.time(),
            vehicles=dict(scene.vehicles),
            lights=scene.lights,
            people=dict(scene.people),
            unseen=scene.unseen,
            state=state,
            speed_factor=1.0,
            plan=("continue",),
            traces=self.traces,
            events=self.events,
            scenario=self.scenario,
        )
        self._scene.put(pack(report))
        self.scenes += 1

    def decide(self, trace: PlanTrace) -> None:
        """Report a decision."""
        self._first = self._first or trace.trace_id
        report = TraceReport(
            ride=self.ride,
            seq=self.traces,
            sim_time=trace.sim_time,
            wall_time=time.time(),
            trace=trace,
            first=self._first,
        )
        self._trace.put(pack(report))
        self.traces += 1

    def experience(self, event: Event) -> None:
        """Report an event."""
        report = EventReport(
            ride=self.ride,
            seq=self.events,
            sim_time=event.sim_time,
            wall_time=time.time(),
            event=event,
        )
        self._event.put(pack(report))
        self.events += 1
