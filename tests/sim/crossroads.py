"""Scenario folders on a crossroads with traffic lights, made by netgenerate."""

from pathlib import Path

from sim.roads.netconvert import generate

SIGNALLED = (
    *("-g", "--grid.number", "1", "--grid.attach-length", "150", "-L", "1"),
    *("--default-junction-type", "traffic_light"),
)
TOML = """
name = "cross"
description = "A crossroads."
network = "cross.net.xml"
routes = "cross.rou.xml"
ego = "ego"
step = 0.1
duration = 60.0
[goal]
edge = "A0right0"
position = 100.0
"""
ROUTES = """
<routes>
    <vehicle id="ego" depart="0" departPos="20" departSpeed="10">
        <route edges="left0A0 A0right0"/>
    </vehicle>
</routes>
"""


def signalled(folder: Path, routes: str = ROUTES, *more: str) -> Path:
    """A scenario folder: four arms of 150 m from the junction A0, one lane each way.

    Args:
        folder: to write; it must exist.
        routes: the route file.
        more: arguments for netgenerate.
    """
    generate((*SIGNALLED, *more), folder / "cross.net.xml")
    (folder / "scenario.toml").write_text(TOML, encoding="utf-8")
    (folder / "cross.rou.xml").write_text(routes, encoding="utf-8")
    return folder
