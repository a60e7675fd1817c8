"""Road networks by SUMO's netgenerate, with random traffic: scenario folders by number.

Kinds alternate. The ways of others are drawn link by link, evenly among the roads that leave a
junction, so that the frequency of turns depends on the roads alone.
"""

import xml.etree.ElementTree as ET
from pathlib import Path
from random import Random
from typing import Literal, TypeAlias

from sim.roads.netconvert import generate
from sim.roads.netfile import read_network
from sim.roads.network import Network
from sim.setup.scenario import Scenario, load

Generated: TypeAlias = Literal["grid", "blocks", "spider", "random"]

FAMILIES: tuple[Generated, ...] = ("grid", "blocks", "spider", "random")
NAME, EGO = "generated", "ego"
STEP, DURATION, VIEW = 0.1, 60.0, 100.0  # [s], [s], [m]
OTHERS = (18, 30)  # least and greatest number of vehicles besides the ego
SPACING = 18.0  # [m] between those that start on the same edge
ROOM = 30.0  # [m] before the end of an edge where no vehicle starts
LONGEST, MOST = 900.0, 12  # greatest length [m] of a route, and greatest number of its edges
LIMITS = (8.33, 11.11, 13.89)  # [m/s]
#: vClass, length and width [m]; three of five vehicles are cars.
TYPES = {"car": ("passenger", 4.6, 1.8), "van": ("delivery", 6.5, 2.1), "bus": ("bus", 12.0, 2.5)}
KINDS = ("car", "car", "car", "van", "bus")


def family_of(number: int) -> Generated:
    """Return the kind of a network; kinds alternate with the number."""
    return FAMILIES[number % len(FAMILIES)]


def write(number: int, folder: Path) -> Scenario:
    """Write the scenario folder of a number, which need not exist; it depends on the number alone.

    Raises:
        NetconvertError: netgenerate is not installed, or it fails.
        ScenarioError: the vehicles do not fit the roads.
    """
    folder.mkdir(parents=True, exist_ok=True)
    draw = Random(f"generated/{number}")
    net = folder / f"{NAME}.net.xml"
    generate(options(number, draw), net)
    network = read_network(net)
    ways = routes(network, draw)
    _save(ways, draw, folder / f"{NAME}.rou.xml")
    (folder / "scenario.toml").write_text(_table(number, ways[0][0], network), encoding="utf-8")
    return load(folder, number)


def options(number: int, draw: Random) -> tuple[str, ...]:
    """Return the arguments for netgenerate."""
    lanes, long = str(draw.choice((1, 2))), draw.uniform(75.0, 150.0)
    blur = f"norm(0,{0.06 * long:.2f})"
    bent = ("--perturb-x", blur, "--perturb-y", blur)
    shared = ("-L", lanes, "-S", str(draw.choice(LIMITS)), "--seed")
    common = (*shared, str(number), "--default.junctions.radius", "6")
    size = (f"{long:.1f}", "--grid.attach-length", f"{long:.1f}")
    grid = ("-g", "--grid.number", "4", "--grid.length", *size, *bent)
    family = family_of(number)
    if family == "grid":
        return (*grid, "--random-priority", *common)
    if family == "blocks":
        return (*grid, "--default-junction-type", "right_before_left", *common)
    if family == "spider":
        arms = ("--spider.arm-number", str(draw.choice((4, 5, 6))), "--spider.circle-number", "2")
        return ("-s", *arms, "--spider.space-radius", f"{long:.1f}", *common)
    space = ("--rand.min-distance", "70", "--rand.max-distance", "160", "--rand.min-angle", "40")
    return ("-r", "--rand.iterations", "30", *space, "--random-priority", *common)


def routes(network: Network, draw: Random) -> list[tuple[tuple[str, ...], float]]:
    """Draw the edges that each vehicle drives along, and the place [m] where it starts.

    The ego is the first.
    """
    follow = followers(network)
    edges = [edge for edge in sorted(follow) if _length(network, edge) > ROOM + SPACING]
    places = [
        (edge, 5.0 + SPACING * k)
        for edge in edges
        for k in range(int((_length(network, edge) - ROOM - 5.0) / SPACING) + 1)
    ]
    draw.shuffle(places)
    count = min(draw.randint(*OTHERS) + 1, len(places))
    return [(walk(network, follow, edge, draw), place) for edge, place in places[:count]]


def walk(
    network: Network, follow: dict[str, tuple[str, ...]], start: str, draw: Random
) -> tuple[str, ...]:
    """Draw a way from an edge on that takes no edge twice."""
    way, total = [start], _length(network, start)
    while len(way) < MOST and total < LONGEST:
        rest = [edge for edge in follow.get(way[-1], ()) if edge not in way]
        if not rest:
            break
        way.append(draw.choice(rest))
        total += _length(network, way[-1])
    return tuple(way)


def followers(network: Network) -> dict[str, tuple[str, ...]]:
    """Return the edges that follow each edge, except by turning around."""
    found: dict[str, set[str]] = {}
    for link in network.links:
        start, end = network.lanes[link.from_lane].edge, network.lanes[link.to_lane].edge
        inside = network.lanes[link.from_lane].internal or network.lanes[link.to_lane].internal
        if not inside and link.direction != "turnaround":
            found.setdefault(start, set()).add(end)
    return {start: tuple(sorted(ends)) for start, ends in found.items()}


def _length(network: Network, edge: str) -> float:
    return min(lane.length for lane in network.edge_lanes(edge))


def _save(ways: list[tuple[tuple[str, ...], float]], draw: Random, path: Path) -> None:
    root = ET.Element("routes")
    for name, (vclass, length, width) in TYPES.items():
        size = {"length": f"{length}", "width": f"{width}", "sigma": "0.5"}
        ET.SubElement(root, "vType", {"id": name, "vClass": vclass, **size})
    for number, (way, place) in enumerate(ways):
        kind = KINDS[0] if number == 0 else draw.choice(KINDS)
        start = {"depart": "0", "departLane": "best", "departPos": f"{place:.1f}"}
        start |= {"departSpeed": f"{draw.uniform(4.0, 8.0):.2f}", "insertionChecks": "none"}
        names = {"id": EGO if number == 0 else str(number), "type": kind}
        element = ET.SubElement(root, "vehicle", {**names, **start})
        ET.SubElement(element, "route", {"edges": " ".join(way)})
    ET.indent(root)
    path.write_bytes(ET.tostring(root, encoding="utf-8") + b"\n")


def _table(number: int, way: tuple[str, ...], network: Network) -> str:
    return "\n".join(
        [
            f'name = "{family_of(number)}-{number}"',
            'description = "Roads and traffic at random."',
            f'network = "{NAME}.net.xml"',
            f'routes = "{NAME}.rou.xml"',
            f'ego = "{EGO}"',
            f"step = {STEP}",
            f"duration = {DURATION}",
            f"view_radius = {VIEW}",
            "",
            "[goal]",
            f'edge = "{way[-1]}"',
            f"position = {max(_length(network, way[-1]) - 5.0, 1.0):.1f}",
            "",
        ]
    )
