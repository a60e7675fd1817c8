"""A SUMO configuration (.sumocfg) as a scenario: SUMO loads it, and is queried for its content."""

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from pathlib import Path

from sim.engine import Engine, SumoFailed
from sim.perception import appearance
from sim.quiet import errors_to, warnings_in
from sim.roads.netfile import NetworkError, read_network
from sim.roads.network import Network
from sim.setup.checks import edges_of, near
from sim.setup.departing import LONGEST, LOOKED, NeverDeparts, clock, depart, first_departures
from sim.setup.mentioned import mentioned
from sim.setup.options import ALWAYS, Stated, listed, of_ride, stated
from sim.setup.place_text import KEYS, begin_of, place_of, split_place
from sim.setup.source import Added, Departing, Rider
from sim.setup.tables import TableError

STEP = 0.1  # [s] the longest simulation step in which the ego is driven
LOOKING = 1.0  # [s] the simulation step in which departures are looked for, to propose an ego
SHORTEST = 5.0  # [s] between the departure and the end, below which the ride goes on beyond it
SHOWN = 3  # greatest number of SUMO's warnings that are quoted
CAR = "passenger"
BEFORE_END = 5.0  # [m] from the goal to the end of the last edge
OPTIONS = {"ego": "ego", "from": "ego-from", "to": "ego-to", "begin": "begin"}  # by key
NOBODY = f"no car departs within {LOOKED:g} s"
OTHERS = {"net": "roads", "routes": "routes", "additional": "additional elements"}  # by root
UNFORESEEN = {"rail": "trains", "ship": "ships"}


@dataclass(frozen=True, slots=True)
class Inspected:
    """The content of a configuration at the moment when its ego departs."""

    network: Path
    ego: str
    goal: str  # the last edge of its route
    goal_position: float  # [m] along the goal's centreline
    step: float  # [s]
    duration: float  # [s]
    seed: int
    sublane: bool
    warnings: tuple[str, ...]


def with_rider(place: str) -> str:
    """Return a place with the first car that departs as the ego, unless the place has wishes.

    Raises:
        TableError: SUMO refuses the configuration, or no car departs.
    """
    file, wishes = split_place(place)
    if wishes:
        return place
    departing = _who_departs(file)
    if not departing:
        raise TableError(file, None, NOBODY, "give --ego-from EDGE and --ego-to EDGE")
    return place_of(file, Departing(departing[0]))


def rider_of(file: Path, wishes: dict[str, str]) -> Rider:
    """Return the ego that the wishes of a place state.

    Raises:
        TableError: they state no ego, or contradict each other; without wishes, the message
            lists the first cars that depart.
    """
    names = {"ego", "from", "to", "begin"} & set(wishes)
    if names == {"ego"}:
        return Departing(wishes["ego"])
    if {"from", "to"} <= names <= {"from", "to", "begin"}:
        return Added(wishes["from"], wishes["to"], begin_of(file, wishes.get("begin")))
    how = "give --ego ID, or --ego-from EDGE and --ego-to EDGE with or without --begin SECONDS"
    if "ego" in names:
        given = " and ".join(f"--{OPTIONS[key]}" for key in KEYS if key in names - {"ego"})
        raise TableError(file, None, f"{given} cannot be given together with --ego", how)
    if names:
        given = " and ".join(f"--{OPTIONS[key]}" for key in KEYS if key in names)
        raise TableError(file, None, f"{given} alone does not say who the ego is", how)
    known = ", ".join(_who_departs(file))
    first = f"the first cars that depart: {known}" if known else NOBODY
    raise TableError(file, None, "it does not say who the ego is", f"{how}; {first}")


def _who_departs(file: Path) -> list[str]:
    with _refused(file), Engine() as engine:
        _start(engine, file, None, LOOKING)
        with _hushed(engine):
            return first_departures(engine)


def inspect(file: Path, rider: Rider, seed: int | None, step: float | None) -> Inspected:
    """Let SUMO load a configuration and run up to the ego's departure, as in the ride.

    Args:
        file: the configuration.
        rider: its ego.
        seed: of the ride; None: as the configuration states.
        step: [s] of the ride; None: as the configuration states, at most STEP.

    Raises:
        TableError: SUMO refuses the configuration, or the car cannot be driven in it.
        SimulationError: SUMO is not installed, or runs in this process already.
    """
    with _refused(file), Engine() as engine:
        found = _start(engine, file, seed, step)
        with _hushed(engine):
            return _Inspection(engine, file, rider, found).result()


@contextmanager
def _refused(file: Path) -> Iterator[None]:
    """Turn SUMO's errors about a configuration into errors of its file.

    Raises:
        TableError: SUMO refuses the configuration.
    """
    try:
        yield
    except NeverDeparts as error:
        raise TableError(file, None, error.problem, error.remedy) from error
    except SumoFailed as error:
        kind = _other_kind(file)
        if kind is not None:
            problem = f"it is a file of {kind}, and no SUMO configuration"
            raise TableError(file, None, problem, "give a .sumocfg that names it") from error
        problem = str(error).removeprefix(f"{file}: ")
        option = "No option with the name" in problem
        remedy = (
            "take it out: it is one of sumo-gui"
            if option
            else "correct it so that sumo accepts it, too"
        )
        raise TableError(file, None, problem, remedy) from error


def _other_kind(file: Path) -> str | None:
    """Return what a file of SUMO's holds that is no configuration; None: it may be one."""
    try:
        _, root = next(ET.iterparse(file, events=["start"]))
    except (OSError, ET.ParseError, StopIteration):
        return None
    return OTHERS.get(root.tag)


@dataclass(frozen=True, slots=True)
class _Started:
    """What a simulation was started with."""

    stated: Stated  # by the configuration
    seed: int
    step: float  # [s]


def _start(engine: Engine, file: Path, seed: int | None, step: float | None) -> _Started:
    """Start SUMO with the options of the ride: its random numbers depend on all of them."""
    configuration = {"--configuration-file": str(file)}
    saved = engine.scratch / "options.xml"
    engine.start(listed({**configuration, **ALWAYS, "--save-configuration": str(saved)}), file)
    found = stated(saved)
    if found.mesoscopic:
        problem = "its vehicles have no places in SUMO's mesoscopic model"
        raise TableError(file, "mesosim", problem, "remove the option")
    seed = found.seed if seed is None else seed
    step = min(STEP, found.step) if step is None else step
    # SUMO's warnings stay on: they state what SUMO leaves out.
    options = of_ride(step, seed, sublane=found.sublane)
    engine.start(listed({**configuration, **options}), file)
    return _Started(found, seed, step)


def _hushed(engine: Engine) -> AbstractContextManager[None]:
    """Keep SUMO's messages about the driving before the ego's departure off the terminal."""
    return errors_to(engine.scratch / "driving.txt")


class _Inspection:
    """Queries to SUMO about the content of a configuration."""

    def __init__(self, engine: Engine, file: Path, rider: Rider, started: _Started) -> None:
        self.engine, self.file, self.rider, self.started = engine, file, rider, started

    def result(self) -> Inspected:
        """Run the simulation up to the ego's departure, check it, and return its content."""
        path = Path(self._option("net-file"))
        network = self._network(path)
        if isinstance(self.rider, Added):
            for edge in (self.rider.origin, self.rider.destination):
                self._check_edge(edge, network)
        else:
            self._check_mentioned(self.rider.id)
        ego = depart(self.engine, self.file, self.rider)
        self._check_ego(ego, network)
        goal = self.engine.call(self.engine.api.vehicle.getRoute, ego)[-1]
        self._check_edge(goal, network, f", where {ego!r} drives to")
        self._check_way(ego, goal, network)
        length = min(lane.length for lane in network.edge_lanes(goal))
        end = float(self.engine.call(self.engine.api.simulation.getEndTime))
        left = (end if end >= 0.0 else LONGEST) - clock(self.engine)
        over = left < SHORTEST
        return Inspected(
            network=path,
            ego=ego,
            goal=goal,
            goal_position=round(max(0.5 * length, length - BEFORE_END), 2),
            step=self.started.step,
            duration=LONGEST if over else left,
            seed=self.started.seed,
            sublane=self.started.stated.sublane,
            warnings=tuple(
                f"{self.file.name}: {warning}"
                for warning in (*self._of_sumo(), *self._unmodelled(ego, network, end, over=over))
            ),
        )

    def _option(self, name: str) -> str:
        return str(self.engine.call(self.engine.api.simulation.getOption, name))

    def _network(self, path: Path) -> Network:
        try:
            return read_network(path)
        except NetworkError as error:
            remedy = "build the net again with netconvert"
            raise TableError(self.file, "net-file", str(error), remedy) from error

    def _check_edge(self, edge: str, network: Network, whose: str = "") -> None:
        edges = edges_of(network)
        if edge not in edges:
            problem = f"there is no edge {edge!r} for cars{whose}"
            raise TableError(self.file, None, problem, near(edge, edges))

    def _check_mentioned(self, name: str) -> None:
        """Raise an error for a vehicle that no file names, rather than wait for it to the end."""
        options = ("route-files", "additional-files")
        values = [self._option(option).split(",") for option in options]
        files = [Path(text.strip()) for value in values for text in value if text.strip()]
        if not mentioned(name, files):
            known = ", ".join(first_departures(self.engine))
            remedy = f"choose one of those that depart, such as {known}" if known else "nobody does"
            raise NeverDeparts(self.file, f"no vehicle, trip or flow has the id {name!r}", remedy)

    def _check_ego(self, ego: str, network: Network) -> None:
        """Check that the ego is a car on a lane for cars."""
        api = self.engine.api.vehicle
        kind = self.engine.call(api.getVehicleClass, ego)
        lane = self.engine.call(api.getLaneID, ego)
        remedy = "choose a car, or give --ego-from EDGE and --ego-to EDGE"
        if appearance.kind_of(kind) != "car":
            problem = f"{ego!r} is of class {kind!r}, and the planner drives a car"
            raise TableError(self.file, f"vehicle {ego!r}", problem, remedy)
        if lane not in network.lanes:
            problem = f"it departs on lane {lane!r}, which is not for cars"
            raise TableError(self.file, f"vehicle {ego!r}", problem, remedy)

    def _check_way(self, ego: str, goal: str, network: Network) -> None:
        start = self.engine.call(self.engine.api.vehicle.getRoadID, ego)
        if start not in network.distance_to(goal):
            problem = f"no way for cars leads from {start!r}, where it departs, to {goal!r}"
            remedy = "choose another vehicle, or other edges"
            raise TableError(self.file, f"vehicle {ego!r}", problem, remedy)

    def _of_sumo(self) -> Iterator[str]:
        """Yield SUMO's own warnings."""
        found = warnings_in(self.engine.log)
        yield from (f"SUMO warns: {warning}" for warning in found[:SHOWN])
        if len(found) > SHOWN:
            yield f"SUMO warns of {len(found) - SHOWN} things more"

    def _unmodelled(self, ego: str, network: Network, end: float, *, over: bool) -> Iterator[str]:
        """Yield sentences on what in the configuration the planner does not take into account."""
        if over:
            yield f"it ends at {end:g} s, but the ride goes on to its destination"
        stated, step = self.started.stated.step, self.started.step
        if stated > step:
            yield f"steps of {stated:g} s are shortened to {step:g} s"
        if self.engine.call(self.engine.api.vehicle.getStops, ego):
            yield f"the stops of {ego!r} are not made: the car drives to the end of its route"
        for what in sorted({UNFORESEEN[x] for x in UNFORESEEN.keys() & self._classes()}):
            yield f"{what} are seen, and where they go is not foreseen"
        limits, closed = self._changed(network)
        if limits:
            yield f"{_many(limits)} have another limit now; the car keeps to that of the net"
        if closed:
            yield f"{_many(closed)} are closed now, which the planner does not know"

    def _classes(self) -> set[str]:
        """Return the classes of the vehicle types that the configuration brings."""
        api = self.engine.api.vehicletype
        types = self.engine.call(api.getIDList)
        return {
            self.engine.call(api.getVehicleClass, x) for x in types if not x.startswith("DEFAULT_")
        }

    def _changed(self, network: Network) -> tuple[list[str], list[str]]:
        """Return the lanes with another speed limit than in the net, and those closed to cars."""
        api, call = self.engine.api.lane, self.engine.call
        plain = [lane for lane in network.lanes.values() if not lane.limits]
        limits = [x.id for x in plain if abs(call(api.getMaxSpeed, x.id) - x.speed_limit) > 0.01]
        closed = [lane for lane in network.lanes if CAR in call(api.getDisallowed, lane)]
        return limits, closed


def _many(lanes: list[str]) -> str:
    named = ", ".join(map(repr, lanes[:3])) + (", ..." if len(lanes) > 3 else "")
    return f"{len(lanes)} lanes ({named})"
