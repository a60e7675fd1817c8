"""Scenario folders: ours and a user's alike, read and checked.

    ScenarioError
    ├── ScenarioNotFound    no scenario has this name, and no folder is there
    └── ScenarioInvalid     a file of the folder is wrong: file, key, problem, remedy
"""

import math
import tomllib
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from pathlib import Path

from sim import routes
from sim.netconvert import NetconvertError, opendrive_net
from sim.netfile import NetworkError, read_network
from sim.network import Network
from sim.routes import RoutesError, Spawn

CONFIG = "scenario.toml"
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
    """A file of a scenario folder is wrong."""

    def __init__(self, file: Path, key: str | None, problem: str, remedy: str) -> None:
        self.file, self.key, self.problem, self.remedy = file, key, problem, remedy
        where = f"{file}: {key}" if key else str(file)
        super().__init__(f"{where}: {problem}; {remedy}")


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


def available() -> tuple[str, ...]:
    """The names of the scenarios that come with the package, sorted."""
    root = files("sim").joinpath("scenarios")
    return tuple(sorted(x.name for x in root.iterdir() if x.joinpath(CONFIG).is_file()))


def load(name_or_path: str | Path) -> Scenario:
    """Read and check a scenario by its name or its folder.

    Raises:
        ScenarioNotFound: neither a name that exists nor a folder with a scenario.toml.
        ScenarioInvalid: the folder is wrong.
    """
    folder = _folder(name_or_path)
    file = folder / CONFIG
    try:
        with file.open("rb") as stream:
            top = _Table(file, "", tomllib.load(stream))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ScenarioInvalid(file, None, f"not TOML: {error}", "mend the syntax there") from error
    except OSError as error:
        raise ScenarioInvalid(file, None, str(error.strerror), "make it readable") from error
    top.only((*_KEYS, *_OPTIONAL))
    priority = top.table("priority")
    priorities = {edge: priority.integer(edge) for edge in priority.values}
    network_file = _network_file(top, folder, priorities)
    scenario = Scenario(
        name=top.text("name"),
        description=top.text("description"),
        folder=folder,
        network=network_file,
        routes=top.path("routes", folder),
        ego=top.text("ego"),
        step=top.number("step", least=0.001, most=1.0),
        duration=top.number("duration", least=0.001),
        view_radius=top.number("view_radius", default=VIEW_RADIUS, least=1.0),
        seed=top.integer("seed", default=0, most=2**31 - 1),
        goal=_goal(top.table("goal", required=True)),
        spawn=_spawn(top.table("spawn")) if "spawn" in top.values else None,
        priority=priorities,
    )
    _check(scenario, top)
    return scenario


def _folder(name_or_path: str | Path) -> Path:
    if isinstance(name_or_path, str) and name_or_path in available():
        return Path(str(files("sim").joinpath("scenarios", name_or_path)))
    folder = Path(name_or_path).expanduser()
    if not (folder / CONFIG).is_file():
        raise ScenarioNotFound(str(name_or_path))
    return folder.resolve()


@dataclass(frozen=True, slots=True)
class _Table:
    """A table of the TOML file, read key by key with strict types."""

    file: Path
    prefix: str  # of its keys in messages
    values: Mapping[str, object]

    def wrong(self, key: str, problem: str, remedy: str) -> ScenarioInvalid:
        return ScenarioInvalid(self.file, self.prefix + key, problem, remedy)

    def only(self, known: tuple[str, ...]) -> None:
        for key in self.values:
            if key not in known:
                raise self.wrong(key, "unknown key", f"remove it; known are {', '.join(known)}")

    def _get(self, key: str, what: str) -> object:
        if key not in self.values:
            raise self.wrong(key, "missing", f"add it: {what}")
        return self.values[key]

    def text(self, key: str) -> str:
        value = self._get(key, "a text")
        if not isinstance(value, str) or not value.strip():
            raise self.wrong(key, f"{value!r} is no text", "write it in quotes")
        return value

    def number(
        self,
        key: str,
        *,
        default: float | None = None,
        least: float = 0.0,
        most: float = math.inf,
    ) -> float:
        value = default if default is not None and key not in self.values else None
        if value is None:
            value = self.check(key, self._get(key, "a number"))
        if not least <= value <= most:
            limits = f"at least {least:g}" + ("" if math.isinf(most) else f", at most {most:g}")
            raise self.wrong(key, f"{value:g} is out of range", f"it must be {limits}")
        return value

    def check(self, key: str, value: object) -> float:
        """A finite number, or an error."""
        real = isinstance(value, int | float) and not isinstance(value, bool)
        if not (real and math.isfinite(float(value))):  # type: ignore[arg-type]
            raise self.wrong(key, f"{value!r} is no number", "write a finite number, unquoted")
        return float(value)  # type: ignore[arg-type]

    def integer(self, key: str, *, default: int | None = None, most: int = 2**31 - 1) -> int:
        value = self.values.get(key, default)
        if value is None:
            value = self._get(key, "a whole number")
        if not isinstance(value, int) or isinstance(value, bool) or not 0 <= value <= most:
            remedy = f"write a whole number from 0 to {most}"
            raise self.wrong(key, f"{value!r} is no whole number in range", remedy)
        return value

    def path(self, key: str, folder: Path) -> Path:
        path = folder / self.text(key)
        if not path.is_file():
            raise self.wrong(key, f"there is no file {path}", "put it there or mend the name")
        return path

    def table(self, key: str, *, required: bool = False) -> "_Table":
        value = self._get(key, f"a table [{key}]") if required else self.values.get(key, {})
        if not isinstance(value, dict):
            raise self.wrong(key, f"{value!r} is no table", f"write it as [{key}]")
        return _Table(self.file, f"{self.prefix}{key}.", value)


def _goal(table: _Table) -> Goal:
    table.only(("edge", "position", "lane"))
    lane = table.integer("lane") if "lane" in table.values else None
    return Goal(table.text("edge"), table.number("position"), lane)


def _spawn(table: _Table) -> Spawn:
    table.only(("longitudinal", "speed"))
    longitudinal = table.number("longitudinal")
    speeds = table._get("speed", "the least and the greatest speed [m/s]")
    if not isinstance(speeds, list) or len(speeds) != 2:
        raise table.wrong("speed", f"{speeds!r} is no range", "write it as [least, greatest]")
    low, high = (table.check("speed", speed) for speed in speeds)
    if not 0.0 <= low <= high:
        raise table.wrong("speed", f"[{low:g}, {high:g}] is no range", "put the lower one first")
    return Spawn(longitudinal, (low, high))


def _network_file(top: _Table, folder: Path, priority: Mapping[str, int]) -> Path:
    path = top.path("network", folder)
    if path.suffix != ".xodr":
        return path
    try:
        return opendrive_net(path, priority)
    except NetconvertError as error:
        raise top.wrong("network", f"cannot convert {path}", str(error)) from error


def _check(scenario: Scenario, top: _Table) -> None:
    """Whether the files agree with one another."""
    try:
        network = read_network(scenario.network)
    except NetworkError as error:
        raise top.wrong("network", str(error), "compile it again with netconvert") from error
    try:
        root = routes.parse(scenario.routes)
        departures = routes.departures(root)
    except RoutesError as error:
        raise ScenarioInvalid(scenario.routes, None, str(error), "mend the route file") from error
    edges = {lane.edge for lane in network.lanes.values() if not lane.internal}
    for edge in scenario.priority:
        if edge not in edges:
            raise top.wrong(f"priority.{edge}", "there is no such edge", _one_of(edges))
    _check_routes(scenario, root, edges)
    ids = [departure.id for departure in departures]
    if scenario.ego not in ids:
        problem = f"{scenario.routes.name} has no vehicle {scenario.ego!r}"
        raise top.wrong("ego", problem, _one_of(ids))
    _check_starts(scenario, network, departures)
    start = next(x.edges[0] for x in departures if x.id == scenario.ego)
    _check_goal(scenario.goal, top, network, edges, start)


def _check_routes(scenario: Scenario, root: ET.Element, edges: set[str]) -> None:
    for edge, owner in routes.mentioned_edges(root).items():
        if edge not in edges:
            key = f"route of {owner!r}"
            raise ScenarioInvalid(scenario.routes, key, f"there is no edge {edge!r}", _one_of(edges))


def _check_starts(
    scenario: Scenario, network: Network, departures: tuple[routes.Departure, ...]
) -> None:
    """The ego starts at 0 s, and every start that varies stays on its first edge."""
    for vehicle in departures:
        key = f"vehicle {vehicle.id!r}"
        if not vehicle.edges:
            remedy = 'give it <route edges="..."/>'
            raise ScenarioInvalid(scenario.routes, key, "it has no route", remedy)
        if not vehicle.at_start:
            if vehicle.id == scenario.ego:
                raise ScenarioInvalid(scenario.routes, key, "the ego departs late", 'write depart="0"')
            continue
        if scenario.spawn is None:
            continue
        half = scenario.spawn.longitudinal / 2.0
        length = min(lane.length for lane in network.edge_lanes(vehicle.edges[0]))
        if vehicle.position is None or not half <= vehicle.position <= length - half:
            problem = "departPos leaves no room for [spawn]"
            remedy = f"write departPos as a number from {half:g} to {length - half:g} m"
            raise ScenarioInvalid(scenario.routes, key, problem, remedy)


def _check_goal(
    goal: Goal, top: _Table, network: Network, edges: set[str], start: str
) -> None:
    if goal.edge not in edges:
        raise top.wrong("goal.edge", f"there is no edge {goal.edge!r}", _one_of(edges))
    if goal.edge != start and start not in network.distance_to(goal.edge):
        problem = f"{goal.edge!r} cannot be reached from {start!r}, where the ego starts"
        raise top.wrong("goal.edge", problem, _one_of(_reachable(network, edges, start)))
    lanes = network.edge_lanes(goal.edge)
    if goal.lane is not None and goal.lane >= len(lanes):
        remedy = f"{goal.edge!r} has lanes 0 to {len(lanes) - 1}, counted from the right"
        raise top.wrong("goal.lane", f"there is no lane {goal.lane}", remedy)
    length = min(lane.length for lane in lanes)
    if goal.position > length:
        problem = f"{goal.position:g} m is beyond the end of {goal.edge!r}"
        raise top.wrong("goal.position", problem, f"it must be at most {length:g}")


def _reachable(network: Network, edges: set[str], start: str) -> list[str]:
    return [edge for edge in sorted(edges) if start in network.distance_to(edge)]


def _one_of(names: set[str] | list[str]) -> str:
    return "choose one of " + ", ".join(sorted(names)) if names else "there is none to choose"
