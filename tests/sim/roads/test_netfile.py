"""The reader of SUMO nets, on the shipped networks and on small broken ones."""

import gzip
import hashlib
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest

from sim.roads.netconvert import generate
from sim.roads.netfile import DrivesOnTheLeft, NetworkInvalid, NetworkUnreadable, read_network
from sim.roads.network import Link, Network
from sim.scene import Signal
from sim.setup.scenario import available, load

S1 = read_network(load("s1").network)
S2 = read_network(load("s2").network)

NET = """<net>
  <type id="road"><restriction vClass="truck" speed="5"/></type>
  <edge id="a" from="w" to="J" type="road">
    <lane id="a_0" index="0" speed="10" length="10.0" shape="0,0 10,0"/>
  </edge>
  <edge id="b" from="J" to="e">
    <lane id="b_0" index="0" speed="10" length="20.0" shape="10,0 20,0"/>
  </edge>
  <junction id="J" type="priority" x="10" y="0" incLanes="a_0" intLanes="">
    <request index="0" response="0" foes="0" cont="0"/>
  </junction>
  <connection from="a" to="b" fromLane="0" toLane="0" dir="s" state="M"/>
</net>"""

#: The lane graph of each scenario as it was when the car learnt to drive there.
GRAPHS = {
    "bend": "835fb7821227583b",
    "junction": "a64009362293addb",
    "motorway": "e186aff6153f1c31",
    "s1": "51c50e5eb8db4c74",
    "s2": "12acce4321c2844f",
    "s3": "9af05fd7b7f09a1e",
    "s4": "69447841b528d49b",
    "town": "d8def0f99f34d8bf",
}
#: Other lanes, other links and crossings of those that have any.
OTHERS = {"junction": (28, 8, 5)}


def link(network: Network, start: str, end: str) -> Link:
    found = [x for x in network.links if (x.from_lane, x.to_lane) == (start, end)]
    assert len(found) == 1
    return found[0]


def yields(network: Network, start: str, end: str) -> set[tuple[str, str]]:
    way = link(network, start, end)
    links = network.junction_links(way.junction)
    return {(links[i].from_lane, links[i].to_lane) for i in way.yields_to}


@pytest.mark.parametrize(
    ("start", "end", "direction"),
    [
        ("main_in_0", "exit_s_0", "right"),
        ("main_in_0", "main_out_0", "straight"),
        ("main_in_1", "main_out_1", "straight"),
        ("main_in_1", "exit_n_0", "left"),
        ("from_s_0", "back_out_0", "left"),
        ("from_n_0", "main_out_1", "left"),
    ],
)
def test_directions_in_s1(start: str, end: str, direction: str) -> None:
    assert link(S1, start, end).direction == direction


def test_turns_in_s1_need_their_lane() -> None:
    ways = {way.to_lane for way in S1.links_from("main_in_0")}
    assert ways == {"exit_s_0", "main_out_0"}
    assert {way.to_lane for way in S1.links_from("main_in_1")} == {"main_out_1", "exit_n_0"}


def test_main_road_has_priority_in_s1() -> None:
    for start, end in (("main_in_0", "exit_s_0"), ("main_in_0", "main_out_0")):
        assert yields(S1, start, end) == set()
    assert yields(S1, "main_in_1", "main_out_1") == set()
    assert yields(S1, "main_in_1", "exit_n_0") == {
        ("back_in_0", "back_out_0"),
        ("back_in_0", "exit_n_0"),
    }
    assert yields(S1, "from_s_0", "back_out_0") >= {
        ("main_in_0", "main_out_0"),
        ("main_in_1", "main_out_1"),
        ("back_in_0", "back_out_0"),
    }


def test_ego_of_s2_yields_to_the_west_alone() -> None:
    assert yields(S2, "south_in_0", "east_out_0") == {("west_in_0", "east_out_0")}


def test_left_turn_of_s2_waits_inside_for_oncoming_traffic() -> None:
    turn = link(S2, "west_in_0", "north_out_0")
    assert turn.waits_inside
    assert len(turn.via) == 2
    assert yields(S2, "west_in_0", "north_out_0") == {
        ("east_in_0", "west_out_0"),
        ("east_in_0", "north_out_0"),
    }
    assert not link(S2, "south_in_0", "east_out_0").waits_inside


@pytest.mark.parametrize("network", [S1, S2])
def test_ways_through_junctions_touch_from_end_to_end(network: Network) -> None:
    for way in network.links:
        chain = [network.lanes[lane] for lane in (way.from_lane, *way.via, way.to_lane)]
        for before, after in pairwise(chain):
            assert before.centreline[-1] == pytest.approx(after.centreline[0], abs=0.011)


@pytest.mark.parametrize("network", [S1, S2])
def test_right_of_way_is_consistent(network: Network) -> None:
    for way in network.links:
        others = network.junction_links(way.junction)
        assert set(way.yields_to) <= set(way.foes)
        for index in way.foes:
            assert way.index in others[index].foes
        assert [others[way.index]] == [way]


def test_hash_ignores_comments_and_nothing_else(tmp_path: Path) -> None:
    plain, commented, other = (tmp_path / name for name in ("a.xml", "b.xml", "c.xml"))
    plain.write_text(NET)
    commented.write_text(NET.replace("<junction", "<!-- made today -->\n<junction"))
    other.write_text(NET.replace('speed="10"', 'speed="11"'))
    packed = tmp_path / "a.net.xml.gz"
    packed.write_bytes(gzip.compress(NET.encode(), mtime=0))
    assert read_network(packed) == read_network(plain)
    assert read_network(plain).hash == read_network(commented).hash
    assert read_network(plain).hash != read_network(other).hash
    assert len(S1.hash) == 16


def test_the_graphs_of_all_networks_of_ours_are_known() -> None:
    assert set(GRAPHS) == set(available()) - {"city"}  # which is a network of SUMO's


@pytest.mark.parametrize("name", GRAPHS)
def test_the_graphs_of_the_scenarios_stay_what_they_were(name: str) -> None:
    network = read_network(load(name).network)
    lanes = [
        (x.id, x.edge, x.index, x.width, x.speed_limit, x.centreline, x.internal, x.length)
        for x in network.lanes.values()
    ]
    links = [
        (
            *(x.junction, x.index, x.from_lane, x.to_lane, x.via, x.direction),
            *(x.yields_to, x.foes, x.waits_inside),
        )
        for x in network.links
    ]
    rings = [sorted(ring) for ring in network.roundabouts]
    graph = repr((lanes, links, rings, sorted(network.equal), network.hash))
    assert hashlib.sha256(graph.encode()).hexdigest()[:16] == GRAPHS[name]
    others = (len(network.other_lanes), len(network.other_links), len(network.crossings))
    assert others == OTHERS.get(name, (0, 0, 0))


def test_lanes_that_cars_may_not_use_stand_aside(tmp_path: Path) -> None:
    path = tmp_path / "a.net.xml"
    path.write_text(
        NET.replace('id="b_0"', 'id="b_0" allow="bicycle pedestrian"')
        .replace(
            "  <junction",
            '<edge id="c" from="J" to="e"><lane id="c_0" index="0" speed="10" length="10"'
            ' shape="10,0 20,5" disallow="tram"/></edge><junction',
        )
        .replace(
            "</net>",
            '<connection from="a" to="c" fromLane="0" toLane="0" dir="l" state="M"/></net>',
        )
    )
    network = read_network(path)
    assert list(network.lanes) == ["a_0", "c_0"]
    assert [(way.to_lane, way.index) for way in network.links] == [("c_0", 1)]
    assert list(network.other_lanes) == ["b_0"]
    assert network.other_lanes["b_0"].permits == {"bicycle", "pedestrian"}
    assert [(way.to_lane, way.index) for way in network.other_links] == [("b_0", 0)]
    assert network.locate((15.0, 0.0), 0.0, reach=1.0) == ()
    assert [x.lane for x in network.locate_aside((15.0, 0.0), 0.0)] == ["b_0"]
    assert "tram" not in network.lanes["c_0"].permits
    assert {"passenger", "bus"} <= network.lanes["c_0"].permits


def test_a_link_that_only_bicycles_may_use_is_none_for_cars(tmp_path: Path) -> None:
    path = tmp_path / "a.net.xml"
    path.write_text(NET.replace('dir="s"', 'dir="s" allow="bicycle"'))
    network = read_network(path)
    assert network.links == ()
    assert [(way.from_lane, way.to_lane) for way in network.other_links] == [("a_0", "b_0")]


def test_a_way_without_length_is_none(tmp_path: Path) -> None:
    path = tmp_path / "a.net.xml"
    dot = (
        '<edge id=":J_0" function="internal">'
        '<lane id=":J_0_0" index="0" speed="10" length="0.1" shape="10,0 10,0"/></edge><junction'
    )
    way = '<connection from=":J_0" to="b" fromLane="0" toLane="0" dir="s" state="M"/></net>'
    text = NET.replace("<junction", dot, 1).replace('dir="s"', 'via=":J_0_0" dir="s"')
    path.write_text(text.replace("</net>", way))
    network = read_network(path)
    assert list(network.lanes) == ["a_0", "b_0"]
    assert [way.via for way in network.links] == [()]


def test_limits_are_those_of_the_class_of_vehicle(tmp_path: Path) -> None:
    path = tmp_path / "a.net.xml"
    path.write_text(NET)
    lane = read_network(path).lanes["a_0"]
    assert lane.speed_limit == lane.limit_for("passenger") == lane.limit_for("bus") == 10.0
    assert lane.limit_for("truck") == 5.0
    path.write_text(NET.replace('vClass="truck"', 'vClass="passenger"'))
    lane = read_network(path).lanes["a_0"]
    assert lane.speed_limit == lane.limit_for("passenger") == 5.0
    assert lane.limit_for("truck") == 10.0


def test_offsets_of_the_file_are_not_those_of_the_centreline(tmp_path: Path) -> None:
    path = tmp_path / "a.net.xml"
    path.write_text(NET)
    lanes = read_network(path).lanes
    assert (lanes["b_0"].length, lanes["b_0"].stated_length) == (10.0, 20.0)
    assert lanes["b_0"].offset(20.0) == 10.0
    assert lanes["b_0"].offset(5.0) == 2.5
    assert lanes["a_0"].offset(5.0) == 5.0


def test_left_hand_traffic_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.net.xml"
    path.write_text(NET.replace("<net>", '<net lefthand="true">'))
    with pytest.raises(DrivesOnTheLeft, match=r"keeps to the left .*netconvert without --lefth"):
        read_network(path)


def test_a_damaged_gzip_file(tmp_path: Path) -> None:
    path = tmp_path / "a.net.xml.gz"
    path.write_bytes(gzip.compress(NET.encode(), mtime=0)[:40])
    with pytest.raises(NetworkUnreadable, match="damaged gzip"):
        read_network(path)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<net", "not an XML file"),
        ("<routes/>", "its root is <routes>"),
    ],
)
def test_unreadable_files(tmp_path: Path, text: str, words: str) -> None:
    path = tmp_path / "a.net.xml"
    path.write_text(text)
    with pytest.raises(NetworkUnreadable, match=words) as caught:
        read_network(path)
    assert str(path) in str(caught.value)


def test_missing_file(tmp_path: Path) -> None:
    with pytest.raises(NetworkUnreadable, match="No such file"):
        read_network(tmp_path / "none.net.xml")


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('speed="10" length="10.0"', "", "<lane> 'a_0': it has no attribute 'speed'"),
        ('speed="10" length="10.0"', 'speed="fast"', "<lane> 'a_0': could not convert"),
        ("0,0 10,0", "0,0 ten", "<lane> 'a_0': could not convert string to float: 'ten'"),
        ("0,0 10,0", "0,0", "fewer than 2 points"),
        (' dir="s"', "", "<connection> 'a': it has no attribute 'dir'"),
        ('fromLane="0"', 'fromLane="1"', "<connection> 'a': it refers to what there is not"),
        ('from="a" to="b"', 'from="a" to="z"', "<connection> 'a': there is no 'z' that it"),
        ('incLanes="a_0"', 'incLanes="z_0"', "<junction> 'J': there is no 'z_0' that it"),
        ('incLanes="a_0"', 'incLanes=""', "junction 'J' does not list incoming lane 'a_0'"),
        (' foes="0"', "", "<request> '0': it has no attribute 'foes'"),
    ],
)
def test_invalid_elements(tmp_path: Path, old: str, new: str, words: str) -> None:
    assert old in NET
    path = tmp_path / "a.net.xml"
    path.write_text(NET.replace(old, new))
    with pytest.raises(NetworkInvalid) as caught:
        read_network(path)
    assert words in str(caught.value)
    assert str(path) in str(caught.value)


@pytest.fixture(scope="module")
def street(tmp_path_factory: pytest.TempPathFactory) -> Network:
    """A signalised crossroads with pavements, bicycle lanes and crossings on four arms."""
    target = tmp_path_factory.mktemp("street") / "street.net.xml"
    guessed = ("--sidewalks.guess", "--bikelanes.guess", "--crossings.guess")
    size = ("--grid.number", "1", "--grid.attach-length", "100", "-L", "2")
    generate(("-g", *size, *guessed, "-j", "traffic_light"), target)
    return read_network(target)


def test_pavements_and_bicycle_lanes_are_not_for_cars(street: Network) -> None:
    assert [lane.index for lane in street.edge_lanes("left0A0")] == [2, 3]
    pavement, cycles = street.other_lanes["left0A0_0"], street.other_lanes["left0A0_1"]
    assert (pavement.permits, cycles.permits) == ({"pedestrian"}, {"bicycle"})
    assert street.right_of("left0A0_2") is None
    for way in street.links:
        for lane in (way.from_lane, *way.via, way.to_lane):
            assert "passenger" in street.lanes[lane].permits


def test_the_indices_of_links_and_of_lights_agree_beside_pavements(street: Network) -> None:
    # netgenerate gives every link of a junction the same number in both.
    for way in (*street.links, *street.other_links, *street.crossings):
        assert way.control == Signal("A0", way.index)


def test_a_turn_gives_way_to_bicycles_and_crossings(street: Network) -> None:
    turn = link(street, "left0A0_2", "A0bottom0_2")
    beside = street.junction_others("A0")
    first = [beside[index] for index in turn.other_yields_to]
    names = {way.from_lane if isinstance(way, Link) else way.id for way in first}
    assert {"left0A0_1", ":A0_c2_0", ":A0_c3_0"} <= names
    ahead = link(street, "left0A0_2", "A0right0_2")
    assert not {"left0A0_1", ":A0_c2_0"} & {
        way.from_lane if isinstance(way, Link) else way.id
        for way in (beside[index] for index in ahead.other_yields_to)
    }
    assert set(turn.other_yields_to) <= set(turn.other_foes)


def test_crossings_lie_across_their_roads(street: Network) -> None:
    assert len(street.crossings) == 4
    south = next(x for x in street.crossings if x.id == ":A0_c2_0")
    assert set(south.edges) == {"A0bottom0", "bottom0A0"}
    assert south.line[0][1] == south.line[-1][1]  # from west to east
    assert south.width == 4.0
    assert street.junction_others("nowhere") == {}


def test_the_crossings_of_a_way_are_known(street: Network) -> None:
    turn = link(street, "left0A0_2", "A0bottom0_2")
    assert {x.id for x in street.crossings_on(turn)} == {":A0_c2_0", ":A0_c3_0"}
    assert street.crossings_on(replace(turn, other_foes=())) == ()
