"""The roads as others than cars may use them."""

from planner.roads.classes import roads_of
from planner.roads.trajectory import Roads
from sim.roads.lanes import Lane, Link
from sim.roads.network import Network

CAR, BOTH, BICYCLE = frozenset({"passenger"}), frozenset({"passenger", "bicycle"}), {"bicycle"}


def lane(name: str, start: float, permits: frozenset[str]) -> Lane:
    line = ((start, 0.0), (start + 10.0, 0.0))
    edge = name.rpartition("_")[0]
    return Lane(name, edge, 0, 3.5, 14.0, line, name.startswith(":"), 10.0, 10.0, permits)


def test_a_lane_that_no_link_of_theirs_leads_along_stays_aside() -> None:
    lanes = (lane("a_0", 0.0, BOTH), lane(":j_0_0", 10.0, BOTH), lane("b_0", 20.0, CAR))
    aside = lane("c_0", 40.0, frozenset(BICYCLE))
    link = Link("j", 0, "a_0", "b_0", (":j_0_0",), "straight", (), (), False)
    network = Network({x.id: x for x in lanes}, (link,), "x", other_lanes={aside.id: aside})
    theirs = roads_of(Roads(network), "bicycle").network
    assert set(theirs.lanes) == {"a_0", "c_0"}
    assert set(theirs.other_lanes) == {":j_0_0", "b_0"}
    assert [x.via for x in theirs.other_links] == [(":j_0_0",)]


def test_lanes_inside_junctions_alone_make_no_roads_of_their_own() -> None:
    street, stray = lane("a_0", 0.0, BOTH), lane(":j_0_0", 10.0, frozenset({"tram"}))
    network = Network({street.id: street}, (), "x", other_lanes={stray.id: stray})
    roads = Roads(network)
    assert roads_of(roads, "tram") is roads
