"""Scenario folders with people on foot: a crossing on a straight road, made by netconvert."""

from pathlib import Path

from sim.roads.netconvert import _run

NODES = """<nodes><node id="a" x="0" y="0"/><node id="m" x="120" y="0" type="priority"/>
<node id="b" x="240" y="0"/></nodes>"""
EDGE = '<edge id="{}" from="{}" to="{}" numLanes="{}" speed="13.89" sidewalkWidth="2"/>'
TOML = """
name = "zebra"
description = "A crossing for people."
network = "zebra.net.xml"
routes = "zebra.rou.xml"
ego = "ego"
step = 0.1
duration = 60.0
[goal]
edge = "mb"
position = 80.0
"""
EGO = (
    '<vehicle id="ego" depart="0" departPos="10" departSpeed="10"><route edges="am mb"/></vehicle>'
)


def zebra_folder(folder: Path, traffic: str, *, priority: bool = True, lanes: int = 1) -> Path:
    """A scenario folder: a road east of 240 m with a crossing in its middle.

    Args:
        folder: to write; it must exist.
        traffic: persons and vehicles beside the ego, as in a route file, by depart.
        priority: whether people go first.
        lanes: in each direction.
    """
    ways = (("am", "a", "m"), ("mb", "m", "b"), ("bm", "b", "m"), ("ma", "m", "a"))
    first = "true" if priority else "false"
    sources = {
        "nod": NODES,
        "edg": f"<edges>{''.join(EDGE.format(*way, lanes) for way in ways)}</edges>",
        "con": f'<connections><crossing node="m" edges="am ma" priority="{first}"/></connections>',
    }
    for name, text in sources.items():
        (folder / f"zebra.{name}.xml").write_text(text, encoding="utf-8")
    named = (("-n", "nod"), ("-e", "edg"), ("-x", "con"))
    files = [part for key, name in named for part in (key, str(folder / f"zebra.{name}.xml"))]
    _run(*files, "--no-turnarounds", "--walkingareas", "-o", str(folder / "zebra.net.xml"))
    (folder / "scenario.toml").write_text(TOML, encoding="utf-8")
    routes = f"<routes>{EGO}{traffic}</routes>"
    (folder / "zebra.rou.xml").write_text(routes, encoding="utf-8")
    return folder


def person(name: str, start: str, place: float, end: str, depart: float = 0.0) -> str:
    """Somebody who walks from a place [m] on an edge to another edge."""
    return (
        f'<person id="{name}" depart="{depart}" departPos="{place}">'
        f'<walk from="{start}" to="{end}" arrivalPos="60"/></person>'
    )
