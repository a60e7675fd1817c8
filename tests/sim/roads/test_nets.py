"""The networks of SUMO's own package: whatever is in them, the lane graph holds together."""

import math
from importlib.util import find_spec
from itertools import pairwise
from pathlib import Path

import pytest

from sim.roads.netconvert import _run
from sim.roads.netfile import read_network
from sim.roads.network import UNSIGNALLED, Network
from sim.scene import Signal

LARGEST = 100_000  # bytes of a file that is read here
SPEC = find_spec("sumo")  # the package that brings netconvert
FILES = sorted(
    path
    for folder in (SPEC.submodule_search_locations or [] if SPEC else [])
    for path in Path(folder).rglob("*.net.xml*")
    if path.stat().st_size < LARGEST
)
WIDEST = 2.0  # [m] between two lanes of a way: some maps are not made to the centimetre


def test_there_are_some() -> None:
    assert len(FILES) >= 12


@pytest.mark.parametrize("file", FILES, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_the_graph_holds_together(file: Path) -> None:
    network = read_network(file)
    for lane in (*network.lanes.values(), *network.other_lanes.values()):
        assert len(lane.centreline) >= 2
        assert lane.stated_length > 0.0
        assert ("passenger" in lane.permits) or lane.id in network.other_lanes
    for lane in network.lanes.values():
        assert lane.length > 0.0
        assert "passenger" in lane.permits
        assert not lane.internal or network.link_via(lane.id) is not None
    for way in network.links:
        chain = [network.lanes[x] for x in (way.from_lane, *way.via, way.to_lane)]
        for before, after in pairwise(chain):
            assert math.dist(before.centreline[-1], after.centreline[0]) < WIDEST
        others = network.junction_links(way.junction)
        assert all(way.index in others[foe].foes for foe in way.foes)
        assert set(way.yields_to) <= set(way.foes)
        beside = network.junction_others(way.junction)
        assert set(way.other_yields_to) <= set(way.other_foes) <= set(beside)
        if isinstance(way.control, Signal):
            assert way in network.signalled(way.control)


CROSSING = {
    "nod": """<nodes>
        <node id="w" x="-100" y="0"/><node id="e" x="100" y="0"/>
        <node id="n" x="0" y="100"/><node id="s" x="0" y="-100"/>
        <node id="x" x="0" y="0" type="rail_crossing"/>
    </nodes>""",
    "edg": """<edges>
        <edge id="in" from="w" to="x" speed="13.9"/>
        <edge id="out" from="x" to="e" speed="13.9"/>
        <edge id="rail_in" from="n" to="x" allow="rail"/>
        <edge id="rail_out" from="x" to="s" allow="rail"/>
    </edges>""",
}


@pytest.fixture(scope="module")
def rails(tmp_path_factory: pytest.TempPathFactory) -> Network:
    folder = tmp_path_factory.mktemp("rails")
    for kind, text in CROSSING.items():
        (folder / f"x.{kind}.xml").write_text(text)
    net = folder / "x.net.xml"
    files = ("-n", str(folder / "x.nod.xml"), "-e", str(folder / "x.edg.xml"))
    _run(*files, "--no-turnarounds", "-o", str(net))
    return read_network(net)


def test_a_rail_crossing_has_a_light_for_the_road(rails: Network) -> None:
    assert rails.rail_crossings == {"x"}
    road = next(way for way in rails.links if way.to_lane == "out_0")
    assert road.control == Signal("x", 1)
    train = rails.junction_others("x")[0]
    assert train in rails.other_links
    assert train.control == UNSIGNALLED
    assert train.index in road.other_foes
    assert rails.other_lanes["rail_in_0"].permits == {"rail"}
