"""Places of SUMO configurations: a text that names the file and the ego.

Examples are `town.sumocfg?ego=car.3` and `town.sumocfg?from=north&to=east&begin=60`.
"""

from pathlib import Path
from urllib.parse import parse_qsl, urlencode

from sim.roads.netconvert import NetconvertMissing, package_folder
from sim.setup.packaged import INSTALL, PACKAGED
from sim.setup.source import Added, Departing, Rider
from sim.setup.tables import TableError

ENDINGS = (".sumocfg", ".sumocfg.xml", ".sumo.cfg")
KEYS = ("ego", "from", "to", "begin")
LATEST = 604_800.0  # [s] a week: SUMO takes every step up to where the ride begins


def is_place(text: str) -> bool:
    """Check whether a text is the place of a configuration."""
    file = expanded(Path(text.partition("?")[0]))
    return file.name.endswith(ENDINGS) or (file.suffix in (".xml", ".cfg") and file.is_file())


def expanded(path: Path) -> Path:
    """Return a path with the home folder for `~`; that of an unknown user stays as it is."""
    try:
        return path.expanduser()
    except RuntimeError:
        return path


def split_place(place: str) -> tuple[Path, dict[str, str]]:
    """Return the file and the wishes (ego, from, to, begin) of a place.

    Raises:
        TableError: there is no such file, or a wish is unknown or not written as key=value.
    """
    name, _, query = place.partition("?")
    file = _file(name)
    try:
        wishes = dict(parse_qsl(query, strict_parsing=True)) if query else {}
    except ValueError as error:
        raise TableError(file, None, f"{query!r}: {error}", "write ?ego=ID") from error
    if file.is_dir():
        raise TableError(
            file, None, "it is a folder", "name a file, or a folder with scenario.toml"
        )
    if not file.is_file():
        raise TableError(file, None, "there is no such file", "correct the path")
    for key in wishes:
        if key not in KEYS:
            raise TableError(file, key, "unknown", f"known are {', '.join(KEYS)}")
    return file, wishes


def _file(name: str) -> Path:
    if not name.startswith(PACKAGED):
        return expanded(Path(name)).resolve()
    try:
        return package_folder() / name.removeprefix(PACKAGED)
    except NetconvertMissing as error:
        problem = "it is part of eclipse-sumo, which is not installed"
        raise TableError(Path(name), None, problem, f"run: {INSTALL}") from error


def place_of(file: Path, rider: Rider) -> str:
    """Return the place from which `split_place` and `rider_of` read this file and rider."""
    match rider:
        case Departing(name):
            wishes = {"ego": name}
        case Added(origin, destination, None):
            wishes = {"from": origin, "to": destination}
        case Added(origin, destination, begin):
            wishes = {"from": origin, "to": destination, "begin": f"{begin:g}"}
    return f"{file}?{urlencode(wishes)}"


def with_wishes(place: str, wishes: dict[str, str]) -> str:
    """Return a place with more wishes, which replace those with the same key."""
    file, _, query = place.partition("?")
    return f"{file}?{urlencode({**dict(parse_qsl(query)), **wishes})}"


def begin_of(file: Path, text: str | None) -> float | None:
    """Return the time [s] at which the ego is to depart; None: when the configuration begins.

    Raises:
        TableError: it is no such time.
    """
    if text is None:
        return None
    try:
        begin = float(text)
    except ValueError as error:
        raise TableError(file, "begin", f"{text!r} is not a number", "write seconds") from error
    if not begin <= LATEST:
        problem = f"{text} s is later than {LATEST:g} s"
        raise TableError(file, "begin", problem, "choose a time when there is traffic")
    return begin
