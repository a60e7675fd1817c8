"""Scenarios, which are read from folders or SUMO configurations and checked.

Errors:
    ScenarioError
    ├── ScenarioNotFound    no scenario has this name, and no such folder or configuration exists
    └── ScenarioInvalid     a file of the folder is wrong: file, key, problem, remedy
        └── NeedsMaps       it needs the extra `maps`: netconvert, or SUMO's networks
"""

import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from importlib.resources import files
from pathlib import Path

from sim.errors import SimError
from sim.roads.netconvert import NetconvertError, NetconvertMissing, opendrive_net
from sim.roads.netfile import NetworkError, read_network
from sim.roads.opendrive import conversion_warnings
from sim.setup import configuration, place_text, routes
from sim.setup.checks import check_routes, check_starts, edges_of, near, one_of
from sim.setup.goal import Goal, check_goal, check_place
from sim.setup.packaged import packaged_file
from sim.setup.routes import RoutesError
from sim.setup.source import FROM_ROUTES, Added, Departing, FromConfiguration, Rider, Source, told
from sim.setup.spawning import Spawn
from sim.setup.tables import Table, TableError, read_toml

CONFIG = "scenario.toml"
OPENDRIVE = ".xodr"
VIEW_RADIUS = 100.0  # [m]

_KEYS = ("name", "description", "network", "routes", "ego", "step", "duration")
_OPTIONAL = ("view_radius", "seed", "goal", "spawn", "priority")
_CONFIGURED = ("name", "description", "configuration", "ego")
_CHANGES = ("step", "duration", "view_radius", "seed", "goal")


class ScenarioError(SimError):
    """A scenario cannot be used."""


class ScenarioNotFound(ScenarioError):
    """No scenario has this name, and no such folder exists."""

    def __init__(self, asked: str) -> None:
        known = ", ".join(available()) or "none"
        super().__init__(
            f"there is no scenario {asked!r}; those that exist: {known};"
            f" or give the path of a folder that holds a {CONFIG}, or of a .sumocfg"
        )


class ScenarioInvalid(ScenarioError):
    """A file of a scenario folder is wrong.

    The message names file, key, problem and remedy.
    """


class NeedsMaps(ScenarioInvalid):
    """A scenario needs netconvert or a network of SUMO's, and eclipse-sumo is not installed."""


@dataclass(frozen=True, slots=True)
class Scenario:
    """A world to drive in, whose files exist and agree with one another."""

    name: str
    description: str
    folder: Path
    place: str  # argument of `load` that loads it again
    network: Path  # SUMO net; a converted one if the folder has OpenDRIVE
    routes: Path  # a route file, or a SUMO configuration
    ego: str  # the ego's id there
    step: float  # [s]
    duration: float  # [s]
    view_radius: float  # [m]
    seed: int
    goal: Goal
    spawn: Spawn | None
    priority: Mapping[str, int]  # by edge
    source: Source = FROM_ROUTES
    warnings: tuple[str, ...] = ()  # sentences on what looks wrong in it or is not modelled


def available() -> tuple[str, ...]:
    """Return the names of the scenarios that come with the package, sorted."""
    root = files("sim").joinpath("scenarios")
    return tuple(sorted(x.name for x in root.iterdir() if x.joinpath(CONFIG).is_file()))


def descriptions() -> dict[str, str]:
    """Return the descriptions of the scenarios that come with the package, by name.

    Unlike `load`, this needs no netconvert, as it does not read their networks.

    Raises:
        ScenarioInvalid: a scenario.toml lacks its description.
    """
    try:
        found = {name: read_toml(_folder(name) / CONFIG) for name in available()}
        return {name: table.text("description") for name, table in found.items()}
    except TableError as error:
        raise ScenarioInvalid(str(error)) from error


def load(name_or_path: str | Path, seed: int | None = None) -> Scenario:
    """Read and check a scenario by its name, its folder, or a SUMO configuration.

    Args:
        name_or_path: for a configuration, a place as described in `sim.setup.place_text`.
        seed: of the ride: where routes are drawn, it decides where the ego drives to. None: the
            scenario's own.

    Raises:
        ScenarioNotFound: this is neither a known name, nor a folder with a scenario.toml, nor a
            configuration.
        ScenarioInvalid: the folder or the configuration is wrong.
        NeedsMaps: it needs netconvert or a network of SUMO's, and eclipse-sumo is not installed.
        SimulationError: SUMO, which reads configurations, is not installed or runs already.
    """
    with _invalid():
        if _is_configuration(name_or_path):
            return _configured(str(name_or_path), seed)
        return _read(_folder(name_or_path), seed)


def place_of(name_or_path: str | Path) -> str:
    """Return the place of a scenario, as `load` states it, without reading its content.

    Raises:
        ScenarioNotFound, ScenarioInvalid, SimulationError: as of `load`.
    """
    with _invalid():
        if _is_configuration(name_or_path):
            file, wishes = place_text.split_place(str(name_or_path))
            return place_text.place_of(file, configuration.rider_of(file, wishes))
        return str(_folder(name_or_path))


def with_rider(place: str) -> str:
    """Return the place of a configuration with an ego: the first car that departs, if none is set.

    Raises:
        ScenarioInvalid: the configuration is wrong, or no car departs.
        SimulationError: SUMO is not installed or runs already.
    """
    with _invalid():
        return configuration.with_rider(place)


@contextmanager
def _invalid() -> Iterator[None]:
    """Turn errors in a file, or in reaching it, into errors of the scenario."""
    try:
        yield
    except TableError as error:
        missing = isinstance(error.__cause__, NetconvertMissing)
        raise (NeedsMaps if missing else ScenarioInvalid)(str(error)) from error
    except OSError as error:
        problem = f"cannot read {error.filename}: {error.strerror}"
        raise ScenarioInvalid(f"{problem}; give another folder or file") from error


def _is_configuration(name_or_path: str | Path) -> bool:
    return name_or_path not in available() and place_text.is_place(str(name_or_path))


def _read(folder: Path, seed: int | None) -> Scenario:
    top = read_toml(folder / CONFIG)
    if "configuration" in top.values:
        return _configured_folder(folder, top, seed)
    top.only((*_KEYS, *_OPTIONAL))
    priority = top.table("priority")
    priorities = {edge: priority.integer(edge) for edge in priority.values}
    own = top.integer("seed", default=0)
    scenario = Scenario(
        name=top.text("name"),
        description=top.text("description"),
        folder=folder,
        place=str(folder),
        network=_network_file(top, folder, priorities),
        routes=top.path("routes", folder),
        ego=top.text("ego"),
        step=_step(top),
        duration=top.number("duration", least=0.001),
        view_radius=_radius(top),
        seed=own if seed is None else seed,
        goal=_goal(top.table("goal", required=True)),
        spawn=_spawn(top.table("spawn")) if "spawn" in top.values else None,
        priority=priorities,
    )
    return replace(scenario, warnings=_check(scenario, top))


def _configured(place: str, seed: int | None, step: float | None = None) -> Scenario:
    """Return the scenario in a SUMO configuration."""
    file, wishes = place_text.split_place(place)
    rider = configuration.rider_of(file, wishes)
    found = configuration.inspect(file, rider, seed, step)
    return Scenario(
        name=file.name.partition(".")[0],
        description=f"{told(rider)} in {file.name}",
        folder=file.parent,
        place=place_text.place_of(file, rider),
        network=found.network,
        routes=file,
        ego=found.ego,
        step=found.step,
        duration=found.duration,
        view_radius=VIEW_RADIUS,
        seed=found.seed,
        goal=Goal(found.goal, found.goal_position, None),
        spawn=None,
        priority={},
        source=FromConfiguration(rider, found.sublane),
        warnings=found.warnings,
    )


def _configured_folder(folder: Path, top: Table, seed: int | None) -> Scenario:
    """Return a scenario whose folder names a SUMO configuration and may override parts of it."""
    top.only((*_CONFIGURED, *_CHANGES))
    file = packaged_file(top, "configuration", folder).resolve()
    own = top.integer("seed") if "seed" in top.values else None
    step = _step(top) if "step" in top.values else None
    place = place_text.place_of(file, _rider(top))
    found = _configured(place, own if seed is None else seed, step)
    return replace(
        found,
        name=top.text("name"),
        description=top.text("description"),
        folder=folder,
        place=str(folder),
        duration=top.number("duration", default=found.duration, least=0.001),
        view_radius=_radius(top),
        goal=_goal_there(top, found),
    )


def _rider(top: Table) -> Rider:
    if not isinstance(top.values.get("ego"), dict):
        return Departing(top.text("ego"))
    table = top.table("ego")
    table.only(("from", "to", "begin"))
    begin = table.number("begin") if "begin" in table.values else None
    return Added(table.text("from"), table.text("to"), begin)


def _goal_there(top: Table, found: Scenario) -> Goal:
    if "goal" not in top.values:
        return found.goal
    goal = _goal(top.table("goal"))
    check_place(goal, top, read_network(found.network))
    return goal


def _step(top: Table) -> float:
    return top.number("step", least=0.001, most=1.0)


def _radius(top: Table) -> float:
    return top.number("view_radius", default=VIEW_RADIUS, least=20.0)


def _folder(name_or_path: str | Path) -> Path:
    if isinstance(name_or_path, str) and name_or_path in available():
        return Path(str(files("sim").joinpath("scenarios", name_or_path)))
    folder = place_text.expanded(Path(name_or_path))
    if not (folder / CONFIG).is_file():
        raise ScenarioNotFound(str(name_or_path))
    return folder.resolve()


def _goal(table: Table) -> Goal:
    table.only(("edge", "position", "lane"))
    lane = table.integer("lane") if "lane" in table.values else None
    return Goal(table.text("edge"), table.number("position"), lane)


def _spawn(table: Table) -> Spawn:
    table.only(("longitudinal", "speed"))
    longitudinal = table.number("longitudinal")
    speeds = table.value("speed", "the least and the greatest speed [m/s]")
    if not isinstance(speeds, list) or len(speeds) != 2:
        raise table.wrong("speed", f"{speeds!r} is not a range", "write it as [least, greatest]")
    low, high = (table.check("speed", speed) for speed in speeds)
    if not 0.0 <= low <= high:
        raise table.wrong("speed", f"[{low:g}, {high:g}] is not a range", "put the lower one first")
    return Spawn(longitudinal, (low, high))


def _network_file(top: Table, folder: Path, priority: Mapping[str, int]) -> Path:
    path = top.path("network", folder)
    if path.suffix != OPENDRIVE:
        if priority:
            remedy = "remove it: the right of way of a SUMO net is part of the net"
            raise top.wrong("priority", "only for OpenDRIVE networks", remedy)
        return path
    try:
        net = opendrive_net(path, {})
        edges = edges_of(read_network(net))
        for edge in priority:
            if edge not in edges:
                raise top.wrong(f"priority.{edge}", "there is no such edge", near(edge, edges))
        return opendrive_net(path, priority) if priority else net
    except (NetconvertError, NetworkError) as error:
        raise top.wrong("network", f"cannot convert {path}", str(error)) from error


def _check(scenario: Scenario, top: Table) -> tuple[str, ...]:
    """Check that the files agree with one another, and return warnings.

    Raises:
        TableError: they do not agree.
    """
    try:
        network = read_network(scenario.network)
    except NetworkError as error:
        raise top.wrong("network", str(error), "compile it again with netconvert") from error
    try:
        root = routes.parse(scenario.routes)
        departures = routes.departures(root)
    except RoutesError as error:
        raise TableError(scenario.routes, None, str(error), "correct the route file") from error
    check_routes(scenario.routes, root, network, scenario.ego)
    ids = [departure.id for departure in departures]
    if scenario.ego not in ids:
        problem = f"{scenario.routes.name} has no vehicle {scenario.ego!r}"
        raise top.wrong("ego", problem, one_of(ids))
    spawn = scenario.spawn is not None
    check_starts(scenario.routes, departures, network, scenario.ego, spawn)
    ego = next(x for x in departures if x.id == scenario.ego)
    check_goal(scenario.goal, top, network, ego)
    source = scenario.folder / top.text("network")
    if source.suffix != OPENDRIVE:
        return ()
    return conversion_warnings(ET.parse(source).getroot(), network, ego.edges[0], scenario.priority)
