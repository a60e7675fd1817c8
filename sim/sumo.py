"""The simulated world, run by SUMO.

SUMO moves the other vehicles; commands place the ego. Collisions are judged by oriented boxes,
since SUMO overlooks bodies that overlap across a lane boundary. Errors are those of
`sim.engine`.
"""

import math
from dataclasses import replace
from pathlib import Path
from types import TracebackType
from typing import Self

from sim.boxes import overlap
from sim.engine import EgoGone, Engine, SimulationError, SimulationRunning, SumoFailed, SumoMissing
from sim.names import VehicleNames
from sim.perception import appearance
from sim.perception.ego_view import Painted, Perception, View
from sim.roads.bridges import apart
from sim.roads.netfile import read_network
from sim.scene import Command, Scene, VehicleState
from sim.setup import routes
from sim.setup.departing import depart, forget_stops, step
from sim.setup.options import listed, of_ride
from sim.setup.scenario import Scenario
from sim.setup.source import FromConfiguration, FromRoutes
from sim.setup.spawning import with_spawn

__all__ = [
    "EgoGone",
    "Simulation",
    "SimulationError",
    "SimulationRunning",
    "SumoFailed",
    "SumoMissing",
]

KEEP_EXACT_PLACE = 2  # keepRoute of moveToXY: no snapping to lane centres
FREE_SPEED, FREE_LANES = 0, 0  # modes in which SUMO does not touch the ego
SUMO_SPEED, SUMO_LANES = 31, 1621  # SUMO's default modes

SUMO_LIGHTS = -1  # value of setSignals that leaves the lights to SUMO
THIN = 0.01  # [m] width of the ego for SUMO while it may overlap two lanes
BESIDE = 0.5  # [m] from the edge of its lane, within which the ego may cross it in one step


class Simulation:
    """A running scenario; close it, or use it in a `with` statement.

    The first scene, at 0 s, shows the vehicles where they start. A vehicle keeps its name for
    the whole ride.
    """

    def __init__(self, scenario: Scenario) -> None:
        """Start SUMO, with vehicles where the scenario's seed puts them.

        Raises:
            SumoMissing: libsumo or a system library is not installed.
            SimulationRunning: this process has a simulation already.
            SumoFailed: SUMO does not accept the scenario.
            EgoGone: SUMO did not put the ego on the road.
        """
        self._engine = Engine()
        self._api, self._call = self._engine.api, self._engine.call
        self._scenario, self._ego = scenario, scenario.ego
        self._steps = 0
        self._commanded = False
        self._announced: tuple[str, ...] = ()  # the edges that the others expect the ego on
        try:
            names, painted = self._start()
            self._names = names
            self._roads, radius = read_network(scenario.network), scenario.view_radius
            self._eyes = Perception(self._engine, self._ego, radius, names, painted, self._roads)
            self._view = self._look(None)
        except BaseException:
            self.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()

    def close(self) -> None:
        """End the simulation; closing twice does nothing."""
        self._engine.close()

    @property
    def time(self) -> float:
        """Simulation time [s] since the start."""
        return round(self._steps * self._scenario.step, 9)

    def scene(self) -> Scene:
        """Return every vehicle within the scenario's view radius that the ego can see, now."""
        return self._view.scene

    def step(self, command: Command | None) -> Scene:
        """Advance by one step of the scenario.

        Args:
            command: the ego's pose at the end of the step; None leaves it to SUMO.

        Returns:
            The scene after the step.

        Raises:
            SumoFailed: SUMO cannot go on.
            EgoGone: the ego has left the road network.
        """
        before = self._view.scene.ego
        if command is None:
            self._release()
        else:
            self._place(command)
        step(self._engine)
        self._steps += 1
        self._engine.now = self.time
        driven = None
        if command is not None:
            acceleration = (command.speed - before.speed) / self._scenario.step
            driven = replace(before, acceleration=acceleration)
        self._view = self._look(driven)
        return self._view.scene

    def collisions(self) -> tuple[int, ...]:
        """Return the names of vehicles and people, seen or not, whose box overlaps the ego's now.

        Those on a bridge over the ego's road, or on a road below it, do not count.
        """
        ego = self._view.scene.ego
        near = (x for x, state in self._view.near.items() if overlap(ego, state))
        hit = [x for x in near if not apart(self._roads, ego, self._view.near[x])]
        return tuple(sorted(self._names.of(x) for x in self._names.in_order(hit)))

    def sumo_collisions(self) -> tuple[int, ...]:
        """Return the vehicles that collide with the ego according to SUMO, as a cross-check."""
        pairs = [
            (hit.collider, hit.victim)
            for hit in self._call(self._api.simulation.getCollisions)
            if self._ego in (hit.collider, hit.victim)
        ]
        others = {b if a == self._ego else a for a, b in pairs}
        return tuple(sorted(self._names.of(other) for other in others))

    def _start(self) -> tuple[VehicleNames, Painted]:
        """Start SUMO and put the ego on the road.

        Returns:
            The names to give, and the vehicles and types whose colours are stated.
        """
        scenario, source = self._scenario, self._scenario.source
        sublane = isinstance(source, FromConfiguration) and source.sublane
        options = {
            **of_ride(scenario.step, scenario.seed, sublane=sublane),
            "--no-warnings": "true",
        }
        match source:
            case FromRoutes():
                root = routes.parse(scenario.routes)
                known = routes.departures(root)
                coloured = frozenset(departure.id for departure in known if departure.coloured)
                painted = Painted(coloured, routes.coloured_types(root))
                net, file = str(scenario.network), str(self._routes())
                options |= {"--net-file": net, "--route-files": file}
                self._engine.start(listed(options), scenario.routes)
                self._engine.guarded(scenario.routes, lambda: step(self._engine))
                return VehicleNames(self._ego, (departure.id for departure in known)), painted
            case FromConfiguration(rider):
                options["--configuration-file"] = str(scenario.routes)
                self._engine.start(listed(options), scenario.routes)
                self._ego = depart(self._engine, scenario.routes, rider)
                forget_stops(self._engine, self._ego)
                return VehicleNames(self._ego, ()), Painted()

    def _routes(self) -> Path:
        """Return the route file, with the starts that the seed draws."""
        scenario = self._scenario
        if scenario.spawn is None:
            return scenario.routes
        root = routes.parse(scenario.routes)
        path = self._engine.scratch / "spawned.rou.xml"
        network = read_network(scenario.network)
        path.write_bytes(with_spawn(root, scenario.spawn, scenario.seed, network))
        return path

    def _look(self, driven: VehicleState | None) -> View:
        return self._eyes.look(self.time, driven)

    def _place(self, command: Command) -> None:
        """Put the ego at a pose for the end of the coming step."""
        vehicle, ego = self._api.vehicle, self._ego
        if not self._commanded:
            self._call(vehicle.setSpeedMode, ego, FREE_SPEED)
            self._call(vehicle.setLaneChangeMode, ego, FREE_LANES)
            self._commanded = True
        (x, y), angle = command.position, 90.0 - math.degrees(command.heading)
        self._announce(command.edges)
        self._call(vehicle.setWidth, ego, self._width_to_show())
        self._call(vehicle.setPreviousSpeed, ego, command.speed)
        self._call(vehicle.moveToXY, ego, "", -1, x, y, angle, KEEP_EXACT_PLACE)
        self._call(vehicle.setSpeed, ego, command.speed)
        shown = SUMO_LIGHTS if command.lights is None else appearance.bits(command.lights)
        self._call(vehicle.setSignals, ego, shown)

    def _announce(self, edges: tuple[str, ...]) -> None:
        """Set the ego's route in SUMO: the others grant right of way by it.

        If SUMO finds no lane for the ego, such as in the gap at a corner, it assumes the ego to be
        at the beginning of its route, and accepts no route that begins elsewhere. Then the new
        route is set in a later step.
        """
        vehicle, ego = self._api.vehicle, self._ego
        road: str = self._call(vehicle.getRoadID, ego)
        if edges != self._announced and road in edges:
            ahead = edges[edges.index(road) :]
            if self._call(vehicle.getRoute, ego)[self._call(vehicle.getRouteIndex, ego)] in ahead:
                self._call(vehicle.setRoute, ego, ahead)
                self._announced = edges

    def _width_to_show(self) -> float:
        """Return the width [m] that SUMO is given for the ego in the coming step.

        When the ego crosses into another lane, SUMO notes that it overlaps the lane it comes
        from, and never removes that note. Vehicles that it passes there would brake hard.
        """
        vehicle, ego = self._api.vehicle, self._ego
        lane: str = self._call(vehicle.getLaneID, ego)
        aside = abs(self._call(vehicle.getLateralLanePosition, ego))
        half = self._call(self._api.lane.getWidth, lane) / 2.0 if lane else math.inf
        width = self._view.scene.ego.width
        return THIN if aside + width / 2.0 > half - BESIDE else width

    def _release(self) -> None:
        """Return the control of the ego to SUMO after commands."""
        if self._commanded:
            vehicle, ego = self._api.vehicle, self._ego
            self._call(vehicle.setSpeedMode, ego, SUMO_SPEED)
            self._call(vehicle.setLaneChangeMode, ego, SUMO_LANES)
            self._call(vehicle.setSpeed, ego, -1.0)
            self._call(vehicle.setWidth, ego, self._view.scene.ego.width)
            self._call(vehicle.setSignals, ego, SUMO_LIGHTS)
            self._commanded = False
