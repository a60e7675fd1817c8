"""The reader of SUMO nets, on the shipped networks and on small broken ones."""

from itertools import pairwise
from pathlib import Path

import pytest

from sim.netfile import NetworkInvalid, NetworkUnreadable, read_network
from sim.network import Link, Network
from sim.scenario import load

S1 = read_network(load("s1").network)
S2 = read_network(load("s2").network)

NET = """<net>
  <edge id="a" from="w" to="J"><lane id="a_0" index="0" speed="10" shape="0,0 10,0"/></edge>
  <edge id="b" from="J" to="e"><lane id="b_0" index="0" speed="10" shape="10,0 20,0"/></edge>
  <junction id="J" type="priority" incLanes="a_0" intLanes="">
    <request index="0" response="0" foes="0" cont="0"/>
  </junction>
  <connection from="a" to="b" fromLane="0" toLane="0" dir="s"/>
</net>"""


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
    assert read_network(plain).hash == read_network(commented).hash
    assert read_network(plain).hash != read_network(other).hash
    assert len(S1.hash) == 16


def test_lanes_that_cars_may_not_use_are_left_out(tmp_path: Path) -> None:
    path = tmp_path / "a.net.xml"
    path.write_text(
        NET.replace('id="b_0"', 'id="b_0" allow="bicycle pedestrian"').replace(
            "</net>",
            '<edge id="c" from="J" to="e"><lane id="c_0" index="0" speed="10" shape="10,0 20,5"'
            ' disallow="tram"/></edge>'
            '<connection from="a" to="c" fromLane="0" toLane="0" dir="l"/></net>',
        )
    )
    network = read_network(path)
    assert list(network.lanes) == ["a_0", "c_0"]
    assert [(way.to_lane, way.index) for way in network.links] == [("c_0", 1)]


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
        ('speed="10" shape="0,0', 'shape="0,0', "'a_0' has no attribute 'speed'"),
        ('speed="10" shape="0,0', 'speed="fast" shape="0,0', "speed='fast' is not a number"),
        ("0,0 10,0", "0,0 ten", "'ten' in its shape is no point"),
        ("0,0 10,0", "0,0", "fewer than 2 points"),
        (' dir="s"', "", "<connection> 'a' has no attribute 'dir'"),
        ('incLanes="a_0"', 'incLanes=""', "junction 'J' does not list incoming lane 'a_0'"),
        (' foes="0"', "", "<request> '0' has no attribute 'foes'"),
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
