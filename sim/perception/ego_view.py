"""The ego's view of SUMO's world: vehicles, people, traffic lights and unseen stretches."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeVar

from sim.engine import EgoGone, Engine
from sim.names import VehicleNames
from sim.perception import appearance
from sim.perception.blind import Blind
from sim.perception.buildings import Buildings
from sim.perception.sight import TALL, Anybody, Body, eye_of, hidden
from sim.perception.signals import Signals
from sim.roads.lines import angle_between
from sim.roads.network import Network
from sim.scene import PersonState, Point, Scene, Signal, VehicleState

State = TypeVar("State")
PAINT = (255, 255, 0)  # SUMO's colour of vehicles and types for which no colour is stated


@dataclass(frozen=True, slots=True)
class Painted:
    """The vehicles and types whose colours a file states."""

    vehicles: frozenset[str] = frozenset()
    types: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True)
class View:
    """The scene at one instant, and everybody near the ego."""

    scene: Scene
    near: Mapping[str, VehicleState | PersonState]  # by the key for naming; seen or not, no ego


class Perception:
    """The ego's view of a running simulation, step by step."""

    def __init__(
        self,
        engine: Engine,
        ego: str,
        radius: float,
        names: VehicleNames,
        painted: Painted,
        network: Network,
    ) -> None:
        """Read what does not change: stop lines, buildings and lanes.

        Args:
            engine: of a simulation that has started.
            ego: the ego's id.
            radius: [m] how far the ego sees.
            names: the names for road users that come into view.
            painted: those whose colours are stated, even if they equal SUMO's default.
            network: the roads.

        Raises:
            SumoFailed: SUMO cannot answer.
        """
        self._call, self._api = engine.call, engine.api
        self._ego, self._radius, self._names, self._painted = ego, radius, names, painted
        self._driving: set[str] = set(self._call(self._api.vehicle.getIDList))
        state = self._api.trafficlight.getRedYellowGreenState
        self._signals = Signals(self._stop_lines(), lambda x: self._call(state, x))
        self._buildings = Buildings(self._polygons())
        self._blind = Blind(network)

    def look(self, time: float, commanded: VehicleState | None) -> View:
        """Return the view now; must be called in every step, to know who departed and arrived.

        Args:
            time: [s] of the scene.
            commanded: the ego with its true width and the acceleration that was commanded; None
                if SUMO drives it.

        Raises:
            EgoGone: the ego is not on the road.
            SumoFailed: SUMO cannot answer.
        """
        api = self._api.vehicle
        ids = self._on_the_road()
        if self._ego not in ids:
            raise EgoGone(
                f"the ego {self._ego!r} is not on the road at {time:g} s:"
                " its route has ended, or its start was blocked"
            )
        ego = self._vehicle(self._ego)
        if commanded is not None:
            ego = replace(ego, acceleration=commanded.acceleration, width=commanded.width)
        near = {x: self._body(x) for x in ids if x != self._ego and self._reaches(api, x, ego)}
        people = {
            _key(x): self._person(x)
            for x in self._call(self._api.person.getIDList)
            if self._reaches(self._api.person, x, ego) and self._on_foot(x)
        }
        everybody: dict[str, Anybody] = {**near, **people}
        walls = self._buildings.around(ego, self._radius)
        bodies = tuple(everybody.values())
        seen = [x for x, body in everybody.items() if not hidden(ego, body, bodies, walls)]
        named = {x: self._names.of(x) for x in self._names.in_order([self._ego, *seen])}
        vehicles = {named[x]: near[x].state for x in near if x in named}
        vehicles[named[self._ego]] = ego
        on_foot = {named[x]: people[x].state for x in people if x in named}
        lights = self._signals.look(time, ego, self._radius)
        tall = (body.state for body in near.values() if body.height >= TALL)
        unseen = self._blind.stretches(eye_of(ego), self._radius, walls.beside(tall), walls)
        scene = Scene(time, _sorted(vehicles), lights, _sorted(on_foot), unseen)
        return View(scene, {x: body.state for x, body in everybody.items()})

    def _on_the_road(self) -> set[str]:
        """Return the ids of the vehicles that have departed and not arrived."""
        # SUMO's own list is slow if many vehicles have yet to depart.
        news = self._api.simulation
        self._driving.update(self._call(news.getDepartedIDList))
        self._driving.difference_update(self._call(news.getArrivedIDList))
        return self._driving

    def _reaches(self, api: Any, name: str, ego: VehicleState) -> bool:
        position: Point = self._call(api.getPosition, name)
        return math.dist(position, ego.position) <= self._radius

    def _on_foot(self, person: str) -> bool:
        """Check whether a person is outside of every vehicle."""
        return not self._call(self._api.person.getVehicle, person)

    def _body(self, vehicle: str) -> Body[VehicleState]:
        return Body(self._vehicle(vehicle), self._call(self._api.vehicle.getHeight, vehicle))

    def _vehicle(self, vehicle: str) -> VehicleState:
        api = self._api.vehicle
        return VehicleState(
            position=self._call(api.getPosition, vehicle),
            heading=self._heading(api, vehicle),
            speed=max(0.0, self._call(api.getSpeed, vehicle)),
            acceleration=self._call(api.getAcceleration, vehicle),
            length=self._call(api.getLength, vehicle),
            width=self._call(api.getWidth, vehicle),
            kind=appearance.kind_of(
                self._call(api.getVehicleClass, vehicle), self._call(api.getShapeClass, vehicle)
            ),
            colour=self._colour(vehicle),
            signals=appearance.lights(self._call(api.getSignals, vehicle)),
        )

    def _person(self, person: str) -> Body[PersonState]:
        api, kinds = self._api.person, self._api.vehicletype
        kind: str = self._call(api.getTypeID, person)
        state = PersonState(
            position=self._call(api.getPosition, person),
            heading=self._heading(api, person),
            speed=max(0.0, self._call(api.getSpeed, person)),
            length=self._call(api.getLength, person),
            width=self._call(kinds.getWidth, kind),
            kind=appearance.walker_of(self._call(kinds.getVehicleClass, kind)),
        )
        return Body(state, self._call(kinds.getHeight, kind))

    def _heading(self, api: Any, name: str) -> float:
        """Return a heading [rad]; SUMO's angles are clockwise from north, in degrees."""
        return angle_between(math.radians(90.0 - self._call(api.getAngle, name)), 0.0)

    def _colour(self, vehicle: str) -> str | None:
        """Return the word for a vehicle's colour; None if no colour is stated for it."""
        # A vehicle whose width was set has a type of its own, named after both.
        kind = self._call(self._api.vehicle.getTypeID, vehicle).removesuffix(f"@{vehicle}")
        own = self._call(self._api.vehicle.getColor, vehicle)[:3]
        if vehicle in self._painted.vehicles or own != PAINT:
            return appearance.colour_name(*own)
        common = self._call(self._api.vehicletype.getColor, kind)[:3]
        if kind in self._painted.types or common != PAINT:
            return appearance.colour_name(*common)
        return None

    def _stop_lines(self) -> dict[Signal, tuple[Point, ...]]:
        """Return the points [m] where the links of each signal begin."""
        api = self._api.trafficlight
        found: dict[Signal, tuple[Point, ...]] = {}
        for controller in self._call(api.getIDList):
            for index, links in enumerate(self._call(api.getControlledLinks, controller)):
                lanes = dict.fromkeys(start for start, _, _ in links)
                shapes = [self._call(self._api.lane.getShape, lane) for lane in lanes]
                if shapes:
                    found[Signal(controller, index)] = tuple(shape[-1] for shape in shapes)
        return found

    def _polygons(self) -> list[tuple[str, tuple[Point, ...]]]:
        """Return the type and outline [m] of every polygon."""
        api = self._api.polygon
        return [
            (self._call(api.getType, x), tuple(self._call(api.getShape, x)))
            for x in self._call(api.getIDList)
        ]


def _key(person: str) -> str:
    """Return the key by which a person is named, as a vehicle may have the same id."""
    return f"person {person}"


def _sorted(states: Mapping[int, State]) -> dict[int, State]:
    return dict(sorted(states.items()))
