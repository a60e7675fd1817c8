"""A search for networks in folders: SUMO configurations, SUMO nets, and OpenDRIVE maps."""

import hashlib
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator
from pathlib import Path

import msgspec

from sim.roads.netconvert import package_folder
from sim.setup.place_text import ENDINGS

NETS = (".net.xml", ".net.xml.gz")
MAPS = (".xodr",)
NET_OPTIONS = ("net-file", "net", "n")  # options by which a configuration may name its network
VALUES = ("value", "v")


class Site(msgspec.Struct, frozen=True):
    """A network, and the configurations with traffic on it."""

    name: str
    network: str  # file
    configurations: tuple[str, ...] = ()  # files; if none works, traffic is made up


class LeftOut(msgspec.Struct, frozen=True):
    """A site or configuration that was found and cannot be driven in."""

    name: str
    why: str


def installed() -> Path:
    """Return the folder of networks that comes with SUMO's distribution.

    Raises:
        NetconvertMissing: the distribution is not installed.
    """
    return package_folder() / "tools"


def sites(folder: Path) -> tuple[tuple[Site, ...], tuple[LeftOut, ...]]:
    """Find the networks in a folder and those below it, each once, by name.

    Returns:
        The networks, and the configurations whose network is missing.
    """
    folder = folder.resolve()
    used: dict[Path, list[Path]] = {}
    left_out: list[LeftOut] = []
    for file in _files(folder, ENDINGS):
        net = net_of(file)
        if isinstance(net, str):
            left_out.append(LeftOut(_name(file, folder), net))
        else:
            used.setdefault(net, []).append(file)
    nets = [*used, *(x for x in _files(folder, (*NETS, *MAPS)) if x not in used)]
    return tuple(_sites(folder, nets, used)), tuple(left_out)


def net_of(configuration: Path) -> Path | str:
    """Return the network that a configuration names, or the reason why there is none."""
    try:
        root = ET.parse(configuration).getroot()
    except (ET.ParseError, OSError) as error:
        return f"it cannot be read: {error}"
    for element in root.iter():
        if element.tag in NET_OPTIONS:
            value = next((element.get(key) for key in VALUES if element.get(key)), None)
            net = (configuration.parent / value).resolve() if value else None
            if net is None or not net.is_file():
                return f"its network {value!r} is not there"
            return net
    return "it names no network"


def _sites(folder: Path, nets: Iterable[Path], used: dict[Path, list[Path]]) -> Iterator[Site]:
    """Yield the networks by name; of several files with the same content, the first one counts."""
    known: dict[str, tuple[Path, list[Path]]] = {}
    for net in nets:
        content = hashlib.sha256(net.read_bytes()).hexdigest()
        known.setdefault(content, (net, []))[1].extend(used.get(net, ()))
    long = {_name((files or [net])[0], folder): (net, files) for net, files in known.values()}
    for name in sorted(long):
        net, files = long[name]
        yield Site(_short(name, long), str(net), tuple(str(file) for file in sorted(files)))


def _files(folder: Path, endings: tuple[str, ...]) -> list[Path]:
    found = (x for x in folder.rglob("*") if x.name.endswith(endings) and x.is_file())
    return sorted(found)


def _name(file: Path, folder: Path) -> str:
    """Return the path relative to the folder, without its ending."""
    name = str(file.relative_to(folder)) if file.is_relative_to(folder) else file.name
    endings = sorted((*ENDINGS, *NETS, *MAPS), key=len, reverse=True)
    return name.removesuffix(next(x for x in endings if name.endswith(x)))


def _short(name: str, names: Iterable[str]) -> str:
    """Return the shortest end of a path that no other path has."""
    parts = name.split("/")
    for count in range(1, len(parts)):
        end = "/".join(parts[-count:])
        if sum(f"/{other}".endswith(f"/{end}") for other in names) == 1:
            return end
    return name
