"""Compiled road networks: SUMO's netconvert, from the extra `maps`.

The networks of the package are written as plain XML (nodes, edges, connections, programmes of
traffic lights) and shipped compiled. `compile_plain` compiles them, as does
`python -m sim.roads.netconvert FOLDER...`. `convert_opendrive` converts a map in OpenDRIVE.
`generate` makes up a network with netgenerate, which is part of the same extra.

    NetconvertError
    ├── NetconvertMissing    netconvert is not installed
    └── ConversionFailed     netconvert did not accept its input
"""

import hashlib
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from xml.sax.saxutils import quoteattr

from platformdirs import user_cache_path

from sim.errors import SimError

PATIENCE = 60.0  # [s] greatest duration of one run of a program
GEOMETRY = (
    "--no-turnarounds",
    "--offset.disable-normalization",
    "--junctions.internal-link-detail",
    "20",
)


class NetconvertError(SimError):
    """A network could not be compiled, converted or made up."""


class NetconvertMissing(NetconvertError):
    """netconvert is not installed."""

    def __init__(self) -> None:
        super().__init__(
            "netconvert is not installed (the extra `maps`): pip install -U eclipse-sumo"
        )


class ConversionFailed(NetconvertError):
    """netconvert did not accept its input."""


def compile_plain(folder: Path, name: str, target: Path) -> None:
    """Compile `<name>.nod.xml`, `.edg.xml` and `.con.xml` of a folder into a SUMO net.

    Traffic lights follow the programmes in `<name>.tll.xml` if that file exists.

    Raises:
        NetconvertMissing: netconvert is not installed.
        ConversionFailed: netconvert did not accept the sources.
    """
    sources = {"-n": ".nod.xml", "-e": ".edg.xml", "-x": ".con.xml"}
    if (folder / f"{name}.tll.xml").is_file():
        sources["-i"] = ".tll.xml"
    arguments = [part for key, end in sources.items() for part in (key, str(folder / (name + end)))]
    _run(*arguments, *GEOMETRY, "--junctions.corner-detail", "10", "-o", str(target))
    # netconvert writes the time and its own paths in a comment at the top of the file.
    net = re.sub(r"<!--.*?-->\n*", "", target.read_text(encoding="utf-8"), flags=re.DOTALL)
    target.write_text(net, encoding="utf-8")


def opendrive_net(source: Path, priority: Mapping[str, int]) -> Path:
    """Return the SUMO net of an OpenDRIVE map, converted once and kept in the user's cache.

    Raises:
        NetconvertMissing: netconvert is not installed.
        ConversionFailed: netconvert did not accept the map or the priorities.
    """
    content = source.read_bytes() + _priorities(priority).encode()
    name = hashlib.sha256(content).hexdigest()[:16] + ".net.xml"
    target = user_cache_path("xavi-dialogue", ensure_exists=True) / name
    if not target.exists():
        # Renamed into place, so that no process reads an incomplete net.
        part = target.with_name(f"{os.getpid()}.{name}")
        convert_opendrive(source, part, priority)
        part.replace(target)
    return target


def convert_opendrive(source: Path, target: Path, priority: Mapping[str, int]) -> None:
    """Convert an OpenDRIVE map into a SUMO net that keeps the map's coordinates.

    Args:
        source: the .xodr file.
        target: the .net.xml file to write.
        priority: edge priorities by the edge's id in the converted net; they replace the right of
            way of the map's junctions, which netconvert ignores.

    Raises:
        NetconvertMissing: netconvert is not installed.
        ConversionFailed: netconvert did not accept the map or the priorities.
    """
    options = ("--junctions.corner-detail", "20", "--geometry.min-dist", "0.1")
    resolution = ("--opendrive.curve-resolution", "0.5")
    with tempfile.TemporaryDirectory() as scratch:
        raw = Path(scratch) / "raw.net.xml"
        made = raw if priority else target
        _run("--opendrive-files", str(source), *GEOMETRY, *options, *resolution, "-o", str(made))
        if priority:
            edges = Path(scratch) / "priority.edg.xml"
            edges.write_text(_priorities(priority), encoding="utf-8")
            patch = ("-s", str(raw), "-e", str(edges), *GEOMETRY, *options)
            _run(*patch, "-o", str(target))


def _priorities(priority: Mapping[str, int]) -> str:
    lines = [f"<edge id={quoteattr(edge)} priority='{value}'/>" for edge, value in priority.items()]
    return "<edges>" + "".join(lines) + "</edges>"


def generate(arguments: Sequence[str], target: Path) -> None:
    """Make up a network without turnarounds.

    Args:
        arguments: of netgenerate, such as the kind of network, its sizes, its seed.
        target: the .net.xml file to write.

    Raises:
        NetconvertMissing: netgenerate is not installed.
        ConversionFailed: netgenerate did not accept the arguments.
    """
    _run(*arguments, "--no-turnarounds", "-o", str(target), tool="netgenerate")


def program(tool: str = "netconvert") -> str:
    """Return the path of a program of the extra.

    Raises:
        NetconvertMissing: it is not installed.
    """
    beside = Path(sys.executable).parent / tool
    found = str(beside) if beside.exists() else shutil.which(tool)
    if found is None:
        raise NetconvertMissing
    return found


def package_folder() -> Path:
    """Return the folder of the extra's package, with SUMO's scripts and networks.

    Raises:
        NetconvertMissing: it is not installed.
    """
    found = importlib.util.find_spec("sumo")
    if found is None or not found.submodule_search_locations:
        raise NetconvertMissing
    return Path(found.submodule_search_locations[0])


def random_trips(net: Path, target: Path, *arguments: str) -> None:
    """Make up trips on a network with SUMO's script randomTrips.py.

    Args:
        net: the .net.xml file.
        target: the route file to write.
        arguments: further ones of the script.

    Raises:
        NetconvertMissing: the extra is not installed.
        ConversionFailed: the script did not accept the arguments.
    """
    script = package_folder() / "tools" / "randomTrips.py"
    files = ("-n", str(net), "-r", str(target), "-o", str(target.with_suffix(".trips.xml")))
    _done("randomTrips.py", [sys.executable, str(script), *files, "--validate", *arguments])


def _run(*arguments: str, tool: str = "netconvert") -> None:
    _done(tool, [program(tool), *arguments, "--xml-validation", "never"])


def _done(tool: str, command: list[str]) -> None:
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, check=False, timeout=PATIENCE
        )
    except subprocess.TimeoutExpired as error:
        raise ConversionFailed(f"{tool} did not finish within {PATIENCE:g} s") from error
    if done.returncode != 0:
        told = done.stderr.strip().splitlines() or [f"exit status {done.returncode}"]
        reason = next((x for x in told if x.startswith("Error")), told[-1])
        raise ConversionFailed(f"{tool} failed: {reason.strip()}")


def main(folders: list[str]) -> None:
    """Compile the plain-XML files of folders; the files have the names of their folders."""
    for folder in (Path(name).resolve() for name in folders):
        try:
            compile_plain(folder, folder.name, folder / f"{folder.name}.net.xml")
        except NetconvertError as error:
            sys.exit(f"{folder}: {error}")


if __name__ == "__main__":
    main(sys.argv[1:] or sys.exit("usage: python -m sim.roads.netconvert FOLDER..."))
