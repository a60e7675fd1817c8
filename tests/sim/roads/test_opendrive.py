"""What is said about maps in OpenDRIVE whose conversion lost something."""

import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from sim.roads.netconvert import convert_opendrive
from sim.roads.netfile import read_network
from sim.roads.network import Network
from sim.roads.opendrive import conversion_warnings
from sim.setup.scenario import ScenarioInvalid, load
from tests.sim.folders import copy_of, edit

PRIORITY = '[priority]\n"-1" = 10\n"-3" = 10\n'


@pytest.fixture
def bend(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the shipped map's folder, and a cache of its own."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return copy_of("bend", tmp_path)


def yields(network: Network, start: str, end: str) -> set[tuple[str, str]]:
    way = next(x for x in network.links if (x.from_lane, x.to_lane) == (start, end))
    links = network.junction_links(way.junction)
    return {(links[i].from_lane, links[i].to_lane) for i in way.yields_to}


def test_the_shipped_map_has_the_right_of_way_that_it_states(bend: Path) -> None:
    scenario = load(bend)
    assert scenario.warnings == ()
    network = read_network(scenario.network)
    assert yields(network, "2_0", "1_0") == {("-3_0", "1_0")}
    assert yields(network, "-3_0", "1_0") == set()


def test_a_right_of_way_that_the_conversion_lost(bend: Path) -> None:
    edit(bend / "scenario.toml", PRIORITY, "")
    (warning,) = load(bend).warnings
    assert warning.startswith("junction '10': ")
    assert "by the map '-3' to '1' goes before '2' to '1', here it does not" in warning
    assert '[priority]: "-1" = 10, "-3" = 10, "2" = 1' in warning


def test_what_the_warning_says_to_write_mends_it(bend: Path) -> None:
    edit(bend / "scenario.toml", PRIORITY, "")
    advice = load(bend).warnings[0].split("[priority]: ")[1].replace(", ", "\n")
    file = bend / "scenario.toml"
    file.write_text(f"{file.read_text()}\n[priority]\n{advice}\n")
    assert load(bend).warnings == ()


def test_a_right_of_way_by_the_roads_that_come_in(bend: Path) -> None:
    edit(bend / "scenario.toml", PRIORITY, "")
    text = (bend / "bend.xodr").read_text()
    kept = [line for line in text.splitlines() if "<priority" not in line]
    rule = '<priority high="3" low="2"/></junction>'
    (bend / "bend.xodr").write_text("\n".join(kept).replace("</junction>", rule))
    (warning,) = load(bend).warnings
    assert '[priority]: "-3" = 10, "2" = 1' in warning


def test_a_right_of_way_that_cannot_be_had(bend: Path) -> None:
    rule = '<priority high="23" low="31"/>\n    </junction>'
    edit(bend / "bend.xodr", "</junction>", rule)
    edit(bend / "scenario.toml", '"-3" = 10', '"-3" = 5\n"2" = 5')
    (warning,) = load(bend).warnings
    assert "[priority] does not solve it; correct the junction in the map" in warning


@pytest.mark.parametrize(("kind", "found"), [("driving", 1), ("sidewalk", 0)])
def test_a_lost_way(bend: Path, kind: str, found: int) -> None:
    whole = read_network(load(bend).network)
    kept = [x for x in whole.links if (x.from_lane, x.to_lane) != ("-1_0", "-2_0")]
    network = Network(whole.lanes, tuple(kept), "less")
    root = ET.parse(bend / "bend.xodr").getroot()
    for lane in root.iterfind("road[@id='12']//lane[@id='-1']"):
        lane.set("type", kind)
    warnings = conversion_warnings(root, network, "2", {})
    lost = [x for x in warnings if "was lost" in x]
    assert len(lost) == found
    for warning in lost:
        assert "junction '10': the way from road '1' to road '2' was lost" in warning
        assert "connecting road '12'" in warning


ROAD = """<road name="" length="60" id="{id}" junction="-1"><link/>
  <planView><geometry s="0" x="{x}" y="{y}" hdg="0" length="60"><line/></geometry></planView>
  <lanes><laneSection s="0"><center><lane id="0" type="none"/></center><right>
    <lane id="-1" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane>
  </right></laneSection></lanes></road>
"""


@pytest.mark.parametrize(
    ("x", "y", "words"),
    [
        (165.0, 0.0, ["edge '-2' ends 3.0 m from where '-7' begins", "roads '2' and '7'"]),
        (400.0, 90.0, []),
    ],
)
def test_roads_that_hang_together_with_nothing(
    bend: Path, x: float, y: float, words: list[str]
) -> None:
    road = ROAD.format(id=7, x=x, y=y)
    edit(bend / "bend.xodr", '<junction name="bend"', f'{road}<junction name="bend"')
    warnings = load(bend).warnings
    assert warnings[-1].startswith("no way leads between the ego's roads and '-7';")
    assert len(warnings) == (2 if words else 1)
    assert all(word in warnings[0] for word in words)


NET = """<net>
  <edge id="-1" from="w" to="J"><lane id="-1_0" index="0" speed="10" length="10" shape="0,0 10,0"/>
    <lane id="-1_1" index="1" speed="10" length="10" shape="0,3 10,3"/></edge>
  <edge id="-2" from="J" to="e">
    <lane id="-2_0" index="0" speed="10" length="10" shape="10,0 20,0"/></edge>
  <junction id="J" type="priority" x="0" y="0" incLanes="-1_0 -1_1" intLanes="">
    <request index="0" response="0" foes="0" cont="0"/>
  </junction>
  <connection from="-1" to="-2" fromLane="0" toLane="0" dir="s" state="M"/>
</net>"""


def test_a_lane_that_ends(tmp_path: Path) -> None:
    path = tmp_path / "a.net.xml"
    path.write_text(NET)
    found = conversion_warnings(ET.fromstring("<OpenDRIVE/>"), read_network(path), "-1", {})
    assert len(found) == 1
    assert found[0].startswith("lane '-1_1' is a dead end: vehicles must leave it")


def test_a_sound_map_with_a_roundabout_is_not_warned_of(tmp_path: Path) -> None:
    source, net = tmp_path / "s3.xodr", tmp_path / "s3.net.xml"
    source.write_text(exported("s3", tmp_path))
    convert_opendrive(source, net, {})
    network = read_network(net)
    start = max(network.lanes.values(), key=lambda lane: lane.length).edge
    assert conversion_warnings(ET.parse(source).getroot(), network, start, {}) == ()
    assert [len(ring) for ring in network.roundabouts] == [8]


def exported(name: str, folder: Path) -> str:
    """A shipped network as a map in OpenDRIVE."""
    target = folder / "exported.xodr"
    program = Path(sys.executable).parent / "netconvert"
    command = [program, "-s", load(name).network, "--opendrive-output", target]
    subprocess.run(command, check=True, capture_output=True)
    return target.read_text()


@pytest.mark.parametrize(
    ("edge", "choice"),
    [("-11", "choose one of -1, "), ("main", "choose one of -1, -2, -3, 1, 2, 3")],
)
def test_a_priority_for_no_edge_tells_of_those_that_are_near(
    bend: Path, edge: str, choice: str
) -> None:
    edit(bend / "scenario.toml", '"-1" = 10', f'"{edge}" = 10')
    with pytest.raises(ScenarioInvalid) as caught:
        load(bend)
    assert f"toml: priority.{edge}: there is no such edge; {choice}" in str(caught.value)


def test_nets_of_sumo_are_not_warned_of() -> None:
    assert load("s1").warnings == ()
