"""A crossroads with a house at the corner, behind which somebody may come or not.

The ego comes from the south and must give way. The house stands south-west of the junction: it
hides the road from the west, until the ego is near.
"""

from pathlib import Path

from sim.roads.netconvert import compile_plain
from sim.setup.scenario import Scenario, load

ARMS = {"west": (-200, 0), "east": (200, 0), "south": (0, -160), "north": (0, 180)}
HOUSE = (-60.0, -60.0, -7.0, -6.0)  # [m] west, south, east and north
OTHER = """
    <vehicle id="1" depart="{depart}" departPos="{place}" departSpeed="13.8">
        <route edges="west_in east_out"/>
    </vehicle>
"""


def arm(name: str, priority: int) -> str:
    rest = f'priority="{priority}" numLanes="1" speed="13.89" width="3.5" spreadType="right"'
    return f"""
    <edge id="{name}_in" from="{name}" to="J" {rest}/>
    <edge id="{name}_out" from="J" to="{name}" {rest}/>"""


def at_the_corner(folder: Path, *, house: bool, others: str = "", routes: str = "") -> Scenario:
    """A ride from the south straight on over the junction.

    Args:
        folder: to write it to; it must exist.
        house: whether there is one.
        others: vehicles of the route file beside the ego, in the order of their departures.
        routes: all of them, in place of the ego's straight on.
    """
    nodes = "".join(
        f'<node id="{name}" x="{x}" y="{y}" type="dead_end"/>' for name, (x, y) in ARMS.items()
    )
    edges = "".join(arm(name, 10 if name in ("west", "east") else 3) for name in ARMS)
    (folder / "c.nod.xml").write_text(
        f'<nodes>{nodes}<node id="J" x="0" y="0" type="priority" radius="6"/></nodes>'
    )
    (folder / "c.edg.xml").write_text(f"<edges>{edges}</edges>")
    (folder / "c.con.xml").write_text("<connections/>")
    compile_plain(folder, "c", folder / "c.net.xml")
    ego = """<vehicle id="ego" depart="0" departPos="40" departSpeed="12">
        <route edges="south_in north_out"/></vehicle>"""
    (folder / "c.rou.xml").write_text(f"<routes>{routes or ego + others}</routes>")
    west, south, east, north = HOUSE
    outline = f"{west},{south} {east},{south} {east},{north} {west},{north}"
    polygon = f'<poly id="house" type="building" color="1,0,0" layer="0" shape="{outline}"/>'
    (folder / "c.poly.xml").write_text(f"<additional>{polygon if house else ''}</additional>")
    file = folder / "c.sumocfg"
    file.write_text("""<configuration>
        <input>
            <net-file value="c.net.xml"/>
            <route-files value="c.rou.xml"/>
            <additional-files value="c.poly.xml"/>
        </input>
        <time><begin value="0"/><end value="60"/></time>
    </configuration>""")
    return load(f"{file}?ego=ego")
