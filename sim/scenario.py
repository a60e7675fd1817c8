"""Scenario folders: ours and a user's alike, read and checked.

Errors:
    ScenarioError
    ├── ScenarioNotFound    no scenario has this name, and no folder is there
    └── ScenarioInvalid     a file of the folder is wrong: file, key, problem, remedy
        └── NeedsMaps       its network is OpenDRIVE, and netconvert is not installed
"""

import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass, replace
from importlib.resources import files
from pathlib import Path

from sim import routes
from sim.checks import check_routes, check_starts, edges_of, near, one_of
from sim.netconvert import NetconvertError, NetconvertMissing, opendrive_net
from sim.netfile import NetworkError, read_network
from sim.network import Network
from sim.opendrive import conversion_warnings
from sim.routes import Departure, RoutesError, Spawn
from sim.tables import Table, TableError, read_toml

CONFIG = "scenario.toml"
OPENDRIVE = ".xodr"
VIEW_RADIUS = 100.0  # [m]

_KEYS = ("name", "description", "network", "routes", "ego", "step", "duration")
_OPTIONAL = ("view_radius", "seed", "goal", "spawn", "priority")


class ScenarioError(Exception):
    """A scenario cannot be used."""


class ScenarioNotFound(ScenarioError):
    """No scenario has this name, and no folder is there."""

    def __init__(self, asked: str) -> None:
        known = ", ".join(available()) or "none"
        super().__init__(
            f"there is no scenario {asked!r}; those that exist: {known};"
            f" or give the path of a folder that holds a {CONFIG}"
        )


class ScenarioInvalid(ScenarioError):
    """A file of a scenario folder is wrong.

    The message names file, key, problem and remedy.
    """


class NeedsMaps(ScenarioInvalid):
    """A scenario's network is OpenDRIVE, and netconvert is not installed."""


@dataclass(frozen=True, slots=True)
class Goal:
    """Where the ego wants to go."""

    edge: str
    position: float  # [m] along the edge
    lane: int | None  # None: any lane counts


@dataclass(frozen=True, slots=True)
class Scenario:
    """A world to drive in, checked: its files exist and agree with one another."""

    name: str
    description: str
    folder: Path
    network: Path  # SUMO net; converted where the folder holds OpenDRIVE
    routes: Path
    ego: str  # id in the route file
    step: float  # [s]
    duration: float  # [s]
    view_radius: float  # [m]
    seed: int
    goal: Goal
    spawn: Spawn | None
    priority: Mapping[str, int]  # by edge
    warnings: tuple[str, ...] = ()  # what looks wrong in it, in sentences


def available() -> tuple[str, ...]:
    """The names of the scenarios that come with the package, sorted."""
    root = files("sim").joinpath("scenarios")
    return tuple(sorted(x.name for x in root.iterdir() if x.joinpath(CONFIG).is_file()))


def descriptions() -> dict[str, str]:
    """What the scenarios that come with the package show, by name.

    Unlike `load` it needs no netconvert, as it leaves their networks alone.

    Raises:
        ScenarioInvalid: a scenario.toml lacks its description.
    """
    try:
        found = {name: read_toml(_folder(name) / CONFIG) for name in available()}
        return {name: table.text("description") for name, table in found.items()}
    except TableError as error:
        raise ScenarioInvalid(str(error)) from error


def load(name_or_path: str | Path) -> Scenario:
    """Read and check a scenario by its name or its folder.

    Raises:
        ScenarioNotFound: neither a name that exists nor a folder with a scenario.toml.
        ScenarioInvalid: the folder is wrong.
        NeedsMaps: its network is OpenDRIVE, and netconvert is not installed.
    """
    folder = _folder(name_or_path)
    try:
        return _read(folder)
    except TableError as error:
        missing = isinstance(error.__cause__, NetconvertMissing)
        raise (NeedsMaps if missing else ScenarioInvalid)(str(error)) from error


def _read(folder: Path) -> Scenario:
    top = read_toml(folder / CONFIG)
    top.only((*_KEYS, *_OPTIONAL))
    priority = top.table("priority")
    priorities = {edge: priority.integer(edge) for edge in priority.values}
    scenario = Scenario(
        name=top.text("name"),
        description=top.text("description"),
        folder=folder,
        network=_network_file(top, folder, priorities),
        routes=top.path("routes", folder),
        ego=top.text("ego"),
        step=top.number("step", least=0.001, most=1.0),
        duration=top.number("duration", least=0.001),
        view_radius=top.number("view_radius", default=VIEW_RADIUS, least=20.0),
        seed=top.integer("seed", default=0, most=2**31 - 1),
        goal=_goal(top.table("goal", required=True)),
        spawn=_spawn(top.table("spawn")) if "spawn" in top.values else None,
        priority=priorities,
    )
    return replace(scenario, warnings=_check(scenario, top))


def _folder(name_or_path: str | Path) -> Path:
    if isinstance(name_or_path, str) and name_or_path in available():
        return Path(str(files("sim").joinpath("scenarios", name_or_path)))
    folder = Path(name_or_path).expanduser()
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
        raise table.wrong("speed", f"{speeds!r} is no range", "write it as [least, greatest]")
    low, high = (table.check("speed", speed) for speed in speeds)
    if not 0.0 <= low <= high:
        raise table.wrong("speed", f"[{low:g}, {high:g}] is no range", "put the lower one first")
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
    """Whether the files agree with one another; returns what may be wrong."""
    try:
        network = read_network(scenario.network)
    except NetworkError as error:
        raise top.wrong("network", str(error), "compile it again with netconvert") from error
    try:
        root = routes.parse(scenario.routes)
        departures = routes.departures(root)
    except RoutesError as error:
        raise TableError(scenario.routes, None, str(error), "mend the route file") from error
    edges = edges_of(network)
    check_routes(scenario.routes, root, network)
    ids = [departure.id for departure in departures]
    if scenario.ego not in ids:
        problem = f"{scenario.routes.name} has no vehicle {scenario.ego!r}"
        raise top.wrong("ego", problem, one_of(ids))
    check_starts(scenario.routes, departures, network, scenario.ego, scenario.spawn)
    ego = next(x for x in departures if x.id == scenario.ego)
    start = ego.edges[0]
    _check_goal(scenario.goal, top, network, edges, ego)
    source = scenario.folder / top.text("network")
    if source.suffix != OPENDRIVE:
        return ()
    return conversion_warnings(ET.parse(source).getroot(), network, start, scenario.priority)


def _check_goal(goal: Goal, top: Table, network: Network, edges: set[str], ego: Departure) -> None:
    start = ego.edges[0]
    if goal.edge not in edges:
        raise top.wrong("goal.edge", f"there is no edge {goal.edge!r}", one_of(edges))
    if goal.edge != start and start not in network.distance_to(goal.edge):
        problem = f"{goal.edge!r} cannot be reached from {start!r}, where the ego starts"
        raise top.wrong("goal.edge", problem, one_of(_reachable(network, edges, start)))
    behind = goal.edge == start and ego.position is not None and ego.position > goal.position
    if behind and not _leads_back(network, start):
        problem = f"{goal.position:g} m lies behind the ego, which starts at {ego.position:g} m"
        raise top.wrong("goal.position", problem, "set it ahead of the start, or another edge")
    lanes = network.edge_lanes(goal.edge)
    numbers = [str(lane.index) for lane in lanes]
    if goal.lane is not None and str(goal.lane) not in numbers:
        raise top.wrong("goal.lane", f"{goal.edge!r} has no lane {goal.lane}", one_of(numbers))
    length = min(lane.length for lane in lanes)
    if goal.position > length:
        problem = f"{goal.position:g} m is beyond the end of {goal.edge!r}"
        raise top.wrong("goal.position", problem, f"it must be at most {length:g}")


def _leads_back(network: Network, edge: str) -> bool:
    """Whether one can come to an edge again after leaving it."""
    links = [link for lane in network.edge_lanes(edge) for link in network.links_from(lane.id)]
    return any(network.lanes[x.to_lane].edge in network.distance_to(edge) for x in links)


def _reachable(network: Network, edges: set[str], start: str) -> list[str]:
    return [edge for edge in sorted(edges) if start in network.distance_to(edge)]
