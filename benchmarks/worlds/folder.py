"""Scenario folders of worlds: plain XML, the compiled net, and the table that names them."""

import xml.etree.ElementTree as ET
from collections.abc import Collection
from dataclasses import replace
from pathlib import Path
from random import Random

from benchmarks.worlds.values import Roads, Shape, Vehicle, World
from sim.roads.netconvert import compile_plain
from sim.setup.scenario import Scenario, load

NAME = "world"
EGO = "ego"
STEP, DURATION, VIEW = 0.1, 90.0, 100.0  # [s], [s], [m]
LANE_WIDTH = 3.5  # [m]
END = 15.0  # [m] of the last road beyond the goal
COLOURS = ("white", "grey", "black", "red", "orange", "green", "blue", "purple", "brown")
RGB = {"purple": "128,0,128", "brown": "139,69,19", "green": "0,160,0"}
#: vClass, length, width, height [m], acceleration and deceleration [m/s2].
SHAPES: dict[Shape, tuple[str, float, float, float, float, float]] = {
    "car": ("passenger", 4.8, 1.8, 1.5, 2.6, 4.5),
    "van": ("delivery", 6.0, 2.0, 2.4, 2.2, 4.0),
    "truck": ("truck", 11.0, 2.5, 3.6, 1.5, 4.0),
    "bus": ("bus", 12.0, 2.5, 3.3, 1.5, 4.0),
    "motorcycle": ("motorcycle", 2.2, 0.9, 1.4, 4.0, 6.0),
}


def write(world: World, folder: Path) -> Scenario:
    """Write the scenario folder of a world, which need not exist.

    Raises:
        NetconvertError: netconvert is not installed, or cannot build the roads.
        ScenarioError: the vehicles do not fit the roads.
    """
    folder.mkdir(parents=True, exist_ok=True)
    _write_roads(world.roads, folder)
    compile_plain(folder, NAME, folder / f"{NAME}.net.xml")
    names = " and ".join(map(str, world.planted)) or "nobody"
    return write_traffic(world, folder, f"{world.kind}: what the ego does hangs on {names}.")


def write_traffic(world: World, folder: Path, story: str) -> Scenario:
    """Write the files of a world to a folder that has its compiled net already.

    Raises:
        ScenarioError: the vehicles do not fit the roads.
    """
    _save(_routes(world, ()), folder / f"{NAME}.rou.xml")
    (folder / "scenario.toml").write_text(_table(world, story), encoding="utf-8")
    return load(folder)


def without(world: World, scenario: Scenario, gone: Collection[int]) -> Scenario:
    """Return the scenario of a world without some vehicles, with a route file beside the other."""
    name = "-".join(["without", *map(str, sorted(gone))])
    target = scenario.folder / f"{name}.rou.xml"
    _save(_routes(world, gone), target)
    return replace(scenario, routes=target)


def _write_roads(roads: Roads, folder: Path) -> None:
    nodes, edges = ET.Element("nodes"), ET.Element("edges")
    for node in roads.nodes:
        kind = {"type": "dead_end"} if node.end else {"type": "priority", "radius": "6"}
        ET.SubElement(nodes, "node", {"id": node.id, "x": f"{node.x}", "y": f"{node.y}", **kind})
    for edge in roads.edges.values():
        ends = {"id": edge.id, "from": edge.start, "to": edge.end}
        rest = {"priority": f"{edge.priority}", "numLanes": f"{edge.lanes}"}
        size = {"speed": f"{edge.speed}", "width": f"{LANE_WIDTH}", "spreadType": "right"}
        line = {"shape": " ".join(f"{x:.2f},{y:.2f}" for x, y in edge.shape)} if edge.shape else {}
        ET.SubElement(edges, "edge", {**ends, **rest, **size, **line})
    for element, end in ((nodes, "nod"), (edges, "edg"), (ET.Element("connections"), "con")):
        _save(element, folder / f"{NAME}.{end}.xml")


def _routes(world: World, gone: Collection[int]) -> ET.Element:
    root = ET.Element("routes")
    paint = Random(f"paint/{world.seed}")
    _add(root, EGO, world.ego, "white")
    for name, vehicle in world.others.items():
        colour = paint.choice(COLOURS)  # drawn for all, so that the remaining ones keep theirs
        if name not in gone:
            _add(root, str(name), vehicle, colour)
    return root


def _add(root: ET.Element, name: str, vehicle: Vehicle, colour: str) -> None:
    vclass, length, width, height, accel, decel = SHAPES[vehicle.shape]
    kind = {"id": f"type-{name}", "vClass": vclass, "length": f"{length}", "width": f"{width}"}
    kind |= {"height": f"{height}", "accel": f"{accel}", "decel": f"{decel}"}
    kind |= {"sigma": "0", "speedFactor": "1", "speedDev": "0"}
    if vehicle.top is not None:
        kind["maxSpeed"] = f"{vehicle.top:.2f}"
    kind |= dict(vehicle.manners)
    # A vehicle type must come before its vehicles, since SUMO reads in order.
    root.append(ET.Element("vType", kind))
    start = {"depart": "0", "departLane": f"{vehicle.lane}", "departPos": f"{vehicle.position:.2f}"}
    top = vehicle.speed if vehicle.top is None else min(vehicle.speed, vehicle.top)
    start |= {"departSpeed": f"{max(top - 0.01, 0.0):.2f}", "color": RGB.get(colour, colour)}
    start |= {"insertionChecks": "none"}
    element = ET.SubElement(root, "vehicle", {"id": name, "type": kind["id"], **start})
    ET.SubElement(element, "route", {"edges": " ".join(vehicle.route)})
    halt = vehicle.halt
    if halt is not None:
        place = {"lane": f"{halt.edge}_{halt.lane}", "endPos": f"{halt.position + 0.5:.2f}"}
        place |= {"startPos": f"{max(halt.position - 1.0, 0.0):.2f}"}
        rest = {"duration": f"{halt.duration:.1f}", "parking": str(halt.beside).lower()}
        ET.SubElement(element, "stop", {**place, **rest})


def _table(world: World, story: str) -> str:
    last = world.roads.edges[world.ego.route[-1]]
    junction = 12.0 if len(world.ego.route) > 1 else 0.0
    place = min(last.length - junction - END, 120.0 if junction else last.length)
    return "\n".join(
        [
            f'name = "{world.kind}-{world.seed}"',
            f'description = "{story}"',
            f'network = "{NAME}.net.xml"',
            f'routes = "{NAME}.rou.xml"',
            f'ego = "{EGO}"',
            f"step = {STEP}",
            f"duration = {DURATION}",
            f"view_radius = {VIEW}",
            "",
            "[goal]",
            f'edge = "{last.id}"',
            f"position = {place:.1f}",
            "",
        ]
    )


def _save(element: ET.Element, path: Path) -> None:
    ET.indent(element)
    path.write_bytes(ET.tostring(element, encoding="utf-8") + b"\n")
