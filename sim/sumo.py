"""SUMO as the world: the only module that knows libsumo.

SUMO moves the other vehicles; the ego is placed where it is told to be. Collisions are judged
by oriented boxes, since SUMO overlooks bodies that overlap across a lane boundary.

    SimulationError
    ├── SumoMissing          libsumo, or a system library that it needs, is not installed
    ├── SimulationRunning    a second simulation in one process
    ├── SumoFailed           SUMO refused what it was given
    └── EgoGone              the ego is not on the road
"""

import importlib
import math
import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import TracebackType
from typing import Any, Self, TypeVar

from sim import appearance, routes
from sim.boxes import overlap
from sim.names import VehicleNames
from sim.network import angle_between
from sim.options import start_arguments
from sim.quiet import errors_to, first_error
from sim.scenario import Scenario
from sim.scene import EGO, Command, Point, Scene, Signal, VehicleState
from sim.sight import Body, hidden
from sim.signals import Signals

SYSTEM_LIBRARIES = "libgl1 libx11-6 libxext6 libxrender1 libatomic1 libexpat1"
KEEP_EXACT_PLACE = 2  # keepRoute of moveToXY: no snapping to lane centres
FREE_SPEED, FREE_LANES = 0, 0  # modes in which SUMO does not touch the ego
SUMO_SPEED, SUMO_LANES = 31, 1621  # SUMO's default modes

SUMO_LIGHTS = -1  # of setSignals: as SUMO sees fit
THIN = 0.01  # [m]
BESIDE = 0.5  # [m] from the edge of its lane at which the ego may cross it in the coming step

_running = False  # libsumo is one per process: a second start would silently replace the first

Value = TypeVar("Value")


class SimulationError(Exception):
    """The simulation cannot start or go on."""


class SumoMissing(SimulationError):
    """libsumo, or a system library that it needs, is not installed."""


class SimulationRunning(SimulationError):
    """A second simulation in one process."""

    def __init__(self) -> None:
        super().__init__("a simulation runs in this process already; close it or use another one")


class SumoFailed(SimulationError):
    """SUMO refused what it was given."""


class EgoGone(SimulationError):
    """The ego is not on the road."""


class Simulation:
    """A running scenario; close it, or use it in a `with` statement.

    The first scene, at 0 s, shows the vehicles where they start. A vehicle keeps its name for
    the whole ride.
    """

    def __init__(self, scenario: Scenario, seed: int) -> None:
        """Start SUMO with the starts that the seed gives.

        Raises:
            SumoMissing: libsumo or a system library is not installed.
            SimulationRunning: this process has a simulation already.
            SumoFailed: SUMO does not accept the scenario.
            EgoGone: SUMO did not put the ego on the road.
        """
        global _running
        if _running:
            raise SimulationRunning
        self._sumo = _libsumo()
        self._scenario = scenario
        self._scratch = tempfile.TemporaryDirectory(prefix="xavi-")
        self._steps = 0
        root = routes.parse(scenario.routes)
        known = routes.departures(root)
        self._names = VehicleNames(scenario.ego, (departure.id for departure in known))
        self._coloured = frozenset(departure.id for departure in known if departure.coloured)
        self._coloured_types = routes.coloured_types(root)
        self._commanded = False
        self._announced: tuple[str, ...] = ()  # the edges that the others expect the ego on
        self._near: dict[str, VehicleState] = {}
        _running = self._open = True
        try:
            self._start(seed)
            api = self._sumo.trafficlight.getRedYellowGreenState
            self._signals = Signals(
                self._stop_lines(), lambda controller: self._call(api, controller)
            )
            self._scene = self._look(None)
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
        global _running
        if self._open:
            _running = self._open = False
            self._scratch.cleanup()
            self._sumo.close()

    @property
    def time(self) -> float:
        """Simulation time [s] since the start."""
        return round(self._steps * self._scenario.step, 9)

    def scene(self) -> Scene:
        """Every vehicle within the scenario's view radius that the ego can see, now."""
        return self._scene

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
        before = self._scene.ego
        if command is None:
            self._release()
        else:
            self._place(command)
        self._call(self._sumo.simulationStep)
        self._steps += 1
        acceleration = None
        if command is not None:
            acceleration = (command.speed - before.speed) / self._scenario.step
        self._scene = self._look(acceleration)
        return self._scene

    def collisions(self) -> tuple[int, ...]:
        """The vehicles, seen or not, whose box overlaps the ego's now, by name."""
        ego = self._scene.ego
        hit = [x for x, state in self._near.items() if overlap(ego, state)]
        names = {self._names.of(x) for x in self._names.in_order(hit)}
        return tuple(sorted(names - {EGO}))

    def sumo_collisions(self) -> tuple[int, ...]:
        """The vehicles that SUMO itself finds in collision with the ego: a cross-check."""
        pairs = [
            (hit.collider, hit.victim)
            for hit in self._call(self._sumo.simulation.getCollisions)
            if self._scenario.ego in (hit.collider, hit.victim)
        ]
        others = {b if a == self._scenario.ego else a for a, b in pairs}
        return tuple(sorted(self._names.of(other) for other in others))

    def _start(self, seed: int) -> None:
        """Start SUMO and put the first vehicles on the road."""
        log = Path(self._scratch.name) / "errors.txt"
        arguments = start_arguments(self._scenario, self._routes(seed), seed)
        try:
            with errors_to(log):
                self._call(self._sumo.start, arguments)
                self._call(self._sumo.simulationStep)
        except SumoFailed as error:
            # SUMO writes more than it raises: the vehicle and the attribute.
            reason = first_error(log) or str(error)
            raise SumoFailed(f"{self._scenario.routes}: SUMO refuses it: {reason}") from error

    def _routes(self, seed: int) -> Path:
        """The route file, with the starts of this seed."""
        if self._scenario.spawn is None:
            return self._scenario.routes
        root = routes.parse(self._scenario.routes)
        path = Path(self._scratch.name) / "spawned.rou.xml"
        path.write_bytes(routes.with_spawn(root, self._scenario.spawn, seed))
        return path

    def _place(self, command: Command) -> None:
        """Put the ego at a pose for the end of the coming step."""
        vehicle, ego = self._sumo.vehicle, self._scenario.ego
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
        """Let the others know where the ego goes: in SUMO, right of way goes by routes."""
        road: str = self._call(self._sumo.vehicle.getRoadID, self._scenario.ego)
        if edges != self._announced and road in edges:
            ahead = edges[edges.index(road) :]
            self._call(self._sumo.vehicle.setRoute, self._scenario.ego, ahead)
            self._announced = edges

    def _width_to_show(self) -> float:
        """The ego's width [m] as SUMO is to know it in the coming step.

        Where the ego crosses into a lane, SUMO would note that it overlaps the one it comes
        from, and never strike that out: whoever it passes there would brake hard.
        """
        vehicle, ego = self._sumo.vehicle, self._scenario.ego
        lane: str = self._call(vehicle.getLaneID, ego)
        aside = abs(self._call(vehicle.getLateralLanePosition, ego))
        half = self._call(self._sumo.lane.getWidth, lane) / 2.0 if lane else math.inf
        width = self._scene.ego.width
        return THIN if aside + width / 2.0 > half - BESIDE else width

    def _release(self) -> None:
        """Give the ego back to SUMO after commands."""
        if self._commanded:
            vehicle, ego = self._sumo.vehicle, self._scenario.ego
            self._call(vehicle.setSpeedMode, ego, SUMO_SPEED)
            self._call(vehicle.setLaneChangeMode, ego, SUMO_LANES)
            self._call(vehicle.setSpeed, ego, -1.0)
            self._call(vehicle.setWidth, ego, self._scene.ego.width)
            self._call(vehicle.setSignals, ego, SUMO_LIGHTS)
            self._commanded = False

    def _look(self, ego_acceleration: float | None) -> Scene:
        ids: tuple[str, ...] = self._call(self._sumo.vehicle.getIDList)
        if self._scenario.ego not in ids:
            raise EgoGone(
                f"the ego {self._scenario.ego!r} is not on the road at {self.time:g} s:"
                " its route has ended, or its start was blocked"
            )
        states = {vehicle: self._state(vehicle) for vehicle in ids}
        ego = states[self._scenario.ego]
        if ego_acceleration is not None:
            width = self._scene.ego.width
            ego = replace(ego, acceleration=ego_acceleration, width=width)
            states[self._scenario.ego] = ego
        radius = self._scenario.view_radius
        self._near = {
            x: state
            for x, state in states.items()
            if math.dist(state.position, ego.position) <= radius
        }
        seen = self._names.in_order(self._seen())
        named = {self._names.of(x): states[x] for x in seen}
        lights = self._signals.look(self.time, ego, radius)
        return Scene(self.time, dict(sorted(named.items())), lights)

    def _stop_lines(self) -> dict[Signal, tuple[Point, ...]]:
        """Where the links of each signal begin."""
        api = self._sumo.trafficlight
        found: dict[Signal, tuple[Point, ...]] = {}
        for controller in self._call(api.getIDList):
            for index, links in enumerate(self._call(api.getControlledLinks, controller)):
                lanes = dict.fromkeys(start for start, _, _ in links)
                shapes = [self._call(self._sumo.lane.getShape, lane) for lane in lanes]
                if shapes:
                    found[Signal(controller, index)] = tuple(shape[-1] for shape in shapes)
        return found

    def _seen(self) -> list[str]:
        """The vehicles near the ego that nothing hides from it, the ego among them."""
        height = self._sumo.vehicle.getHeight
        near = {x: Body(state, self._call(height, x)) for x, state in self._near.items()}
        ego = self._scenario.ego
        others = [body for x, body in near.items() if x != ego]
        view = near[ego].state
        return [x for x in near if x == ego or not hidden(view, near[x], others)]

    def _state(self, vehicle: str) -> VehicleState:
        api = self._sumo.vehicle
        heading = math.radians(90.0 - self._call(api.getAngle, vehicle))
        return VehicleState(
            position=self._call(api.getPosition, vehicle),
            heading=angle_between(heading, 0.0),
            speed=max(0.0, self._call(api.getSpeed, vehicle)),
            acceleration=self._call(api.getAcceleration, vehicle),
            length=self._call(api.getLength, vehicle),
            width=self._call(api.getWidth, vehicle),
            kind=appearance.kind_of(self._call(api.getVehicleClass, vehicle)),
            colour=self._colour(vehicle),
            signals=appearance.lights(self._call(api.getSignals, vehicle)),
        )

    def _colour(self, vehicle: str) -> str | None:
        """SUMO paints a vehicle yellow where nobody said how: then its colour is unknown."""
        # A vehicle whose width was set has a type of its own, named after both.
        kind = self._call(self._sumo.vehicle.getTypeID, vehicle).removesuffix(f"@{vehicle}")
        if vehicle in self._coloured:
            rgb = self._call(self._sumo.vehicle.getColor, vehicle)
        elif kind in self._coloured_types:
            rgb = self._call(self._sumo.vehicletype.getColor, kind)
        else:
            return None
        return appearance.colour_name(*rgb[:3])

    def _call(self, function: Callable[..., Value], *arguments: Any) -> Value:
        """Call libsumo; its errors become ours."""
        try:
            return function(*arguments)
        except (self._sumo.TraCIException, self._sumo.FatalTraCIError, RuntimeError) as error:
            reason = str(error) or type(error).__name__
            raise SumoFailed(f"SUMO at {self.time:g} s: {reason}") from error


def version() -> str:
    """Which SUMO there is.

    Raises:
        SumoMissing: none, or a system library is not installed.
    """
    return str(_libsumo().getVersion()[1])


def _libsumo() -> Any:
    """The libsumo module, untyped by its makers.

    Raises:
        SumoMissing: it, or a system library that it needs, is not installed.
    """
    try:
        return importlib.import_module("libsumo")
    except ModuleNotFoundError as error:
        raise SumoMissing("libsumo is not installed; run: pip install libsumo") from error
    except ImportError as error:
        raise SumoMissing(
            f"SUMO lacks a system library ({error}); run: apt-get install -y {SYSTEM_LIBRARIES}"
        ) from error
