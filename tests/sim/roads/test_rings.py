"""Roundabouts: named in the file, or found by their shape and right of way."""

from dataclasses import replace
from pathlib import Path

import pytest

from sim.roads.netfile import read_network
from sim.roads.network import Lane, Link, Network
from sim.roads.rings import find_rings
from sim.setup.scenario import load
from tests.sim.folders import edit

S3 = read_network(load("s3").network)
RING = {edge for edge in {lane.edge for lane in S3.lanes.values()} if edge.startswith("ring_")}


def found(network: Network) -> tuple[frozenset[str], ...]:
    return find_rings(network.lanes, network.links)


def mirrored(network: Network) -> Network:
    """The same roads where traffic keeps to the left."""
    lanes = {
        name: replace(lane, centreline=tuple((x, -y) for x, y in lane.centreline))
        for name, lane in network.lanes.items()
    }
    return Network(lanes, network.links, "mirrored")


def test_the_file_names_its_rings(tmp_path: Path) -> None:
    assert len(RING) == 8
    assert S3.roundabouts == (frozenset(RING),)
    assert S3.roundabout("ring_east") == RING
    assert S3.roundabout("south_in") is None
    net = tmp_path / "named.net.xml"
    net.write_bytes(load("s3").network.read_bytes())
    edit(net, 'edges="ring_east ', 'edges="nowhere ')
    assert read_network(net).roundabouts == (frozenset(RING - {"ring_east"}),)


@pytest.mark.parametrize("name", ["s3", "town"])
def test_a_ring_is_found_where_the_file_names_none(name: str, tmp_path: Path) -> None:
    named = load(name).network.read_text()
    net = tmp_path / "plain.net.xml"
    net.write_text("\n".join(x for x in named.splitlines() if "<roundabout" not in x))
    rings = read_network(load(name).network).roundabouts
    assert len(rings) == 1
    assert read_network(net).roundabouts == rings


def test_a_ring_is_found_where_traffic_keeps_left() -> None:
    assert found(mirrored(S3)) == (frozenset(RING),)


@pytest.mark.parametrize("name", ["s1", "s2", "s4", "motorway"])
def test_other_roads_have_no_ring(name: str) -> None:
    assert read_network(load(name).network).roundabouts == ()


def test_a_loop_to_which_nobody_gives_way_is_no_roundabout() -> None:
    equal = [replace(link, yields_to=()) for link in S3.links]
    assert find_rings(S3.lanes, equal) == ()
    alone = [x for x in S3.links if S3.lanes[x.from_lane].edge in RING]
    assert find_rings(S3.lanes, alone) == ()


def test_a_loop_with_two_directions_is_no_roundabout() -> None:
    line = ((0.0, 0.0), (9.0, 0.0))
    back = Lane("back_0", "back", 0, 3.5, 10.0, line, False, 9.0, 9.0, frozenset())
    link = next(x for x in S3.links if S3.lanes[x.from_lane].edge == "ring_east")
    after = next(x for x in S3.links if S3.lanes[x.from_lane].edge == "ring_east_north")
    ways = [
        Link(after.junction, 8, after.from_lane, "back_0", (), "turnaround", (), (), False),
        Link(link.junction, 9, "back_0", link.to_lane, (), "turnaround", (), (), False),
    ]
    assert find_rings({**S3.lanes, "back_0": back}, [*S3.links, *ways]) == ()


def test_a_loop_may_be_too_long_or_too_thin() -> None:
    for wide, high in ((10.0, 10.0), (1.0, 0.2)):
        lanes = {
            name: replace(
                lane,
                centreline=tuple((x * wide, y * high) for x, y in lane.centreline),
                length=lane.length * wide,
            )
            for name, lane in S3.lanes.items()
        }
        assert find_rings(lanes, S3.links) == ()
