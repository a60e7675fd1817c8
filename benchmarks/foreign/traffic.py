"""Random traffic for a network that has none: SUMO's randomTrips, and a configuration."""

import xml.etree.ElementTree as ET
from pathlib import Path

from sim.roads.netconvert import ConversionFailed, random_trips
from sim.roads.netfile import read_network
from sim.roads.network import Network

CARS = 500.0  # cars that depart per hour and km of lanes
MOST, LEAST = 2400.0, 400.0  # bounds of the cars per hour
BICYCLES, PEOPLE = 0.1, 0.4  # number for each car
LASTS = 300.0  # [s] during which they depart
NAME = "foreign"
SHORTEST = 80.0  # [m] least length of a trip in a straight line


def made_up(net: Path, seed: int, folder: Path) -> Path:
    """Write a configuration with random traffic.

    Args:
        net: the .net.xml file.
        seed: of the traffic.
        folder: folder for the files; it need not exist.

    Returns:
        The configuration.

    Raises:
        NetconvertError: SUMO's scripts are not installed, or find no trips.
    """
    folder.mkdir(parents=True, exist_ok=True)
    network = read_network(net)
    cars = min(max(CARS * _kilometres(network), LEAST), MOST)
    routes = [_trips(net, folder, "car", cars, seed, "--vehicle-class", "passenger")]
    for name, share, kind in (("bicycle", BICYCLES, "bicycle"), ("person", PEOPLE, "pedestrian")):
        if _for(network, kind):
            more = ("--pedestrians",) if kind == "pedestrian" else ("--vehicle-class", kind)
            try:
                routes.append(_trips(net, folder, name, share * cars, seed, *more))
            except ConversionFailed:  # the network has too little room for trips of this class
                continue
    return _configuration(net, folder, routes)


def _trips(net: Path, folder: Path, name: str, rate: float, seed: int, *kind: str) -> Path:
    target = folder / f"{name}.rou.xml"
    draw = ("--seed", str(seed), "--prefix", f"{name}.", "-e", str(LASTS))
    many = ("--insertion-rate", f"{rate:.1f}", "--fringe-factor", "5", "--random-depart")
    random_trips(net, target, *draw, *many, "--min-distance", str(SHORTEST), *kind)
    return target


def _kilometres(network: Network) -> float:
    """Return the length [km] of the lanes for cars."""
    return sum(x.length for x in network.lanes.values() if not x.internal) / 1000.0


def _for(network: Network, kind: str) -> bool:
    """Check whether a network has separate lanes for a class, and crossings for people on foot."""
    if kind == "pedestrian" and not network.crossings:
        return False
    return any(kind in lane.permits for lane in network.other_lanes.values())


def _configuration(net: Path, folder: Path, routes: list[Path]) -> Path:
    root = ET.Element("configuration")
    files = ET.SubElement(root, "input")
    ET.SubElement(files, "net-file", {"value": str(net)})
    ET.SubElement(files, "route-files", {"value": ",".join(str(file) for file in routes)})
    target = folder / f"{NAME}.sumocfg"
    ET.ElementTree(root).write(target, encoding="utf-8")
    return target
