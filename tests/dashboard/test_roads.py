"""Roads and scenes as browsers get them, also from a car that nobody knows."""

import gzip
import math
from pathlib import Path

import msgspec
import pytest

from sim.roads.netfile import NetworkError, parse_outlines, read_network
from sim.scene import Light, LightState, PersonState, Signal, Unseen, VehicleState
from xavi_dialogue.bus.messages import SceneReport
from xavi_dialogue.dashboard.views import map as roads
from xavi_dialogue.dashboard.web.http_documents import Roads

SCENARIOS = Path(__file__).parents[2] / "sim" / "scenarios"
PLACE = 'type="priority" x="0" y="0" incLanes="" intLanes=""'
LANE = '<lane id="{0}_0" index="0" speed="10" length="9" shape="{1}"/>'


def packed(name: str) -> bytes:
    return gzip.compress((SCENARIOS / name / f"{name}.net.xml").read_bytes(), mtime=0)


def net(shape: str, more: str = "") -> bytes:
    lane = LANE.format("a", shape)
    return gzip.compress(f'<net><edge id="a">{lane}</edge>{more}</net>'.encode(), mtime=0)


@pytest.mark.parametrize("name", ["s1", "s2", "s3", "s4", "motorway", "town"])
def test_the_roads_of_every_scenario(name: str) -> None:
    network, outlines = roads.read(packed(name))
    assert network.hash == read_network(SCENARIOS / name / f"{name}.net.xml").hash
    shown = roads.shown(network, outlines)
    assert msgspec.json.decode(msgspec.json.encode(shown), type=Roads) == shown
    assert [lane.id for lane in shown.lanes] == list(network.lanes)
    assert len(shown.junctions) >= len({link.junction for link in network.links}) > 0
    left, bottom, right, top = shown.bounds
    for line in (*(lane.line for lane in shown.lanes), *shown.junctions):
        assert len(line) % 2 == 0
        assert all(left <= x <= right for x in line[0::2])
        assert all(bottom <= y <= top for y in line[1::2])


def test_links_are_named_by_their_place_and_yield_to_those_of_their_junction() -> None:
    network, outlines = roads.read(packed("town"))
    shown = roads.shown(network, outlines)
    yielding = 0
    for k, link in enumerate(shown.links):
        assert link.id == k
        assert (link.from_lane, link.to_lane) == (
            network.links[k].from_lane,
            network.links[k].to_lane,
        )
        first = [network.links[other] for other in link.yields_to]
        assert {one.junction for one in first} <= {link.junction}
        assert tuple(one.index for one in first) == network.links[k].yields_to
        yielding += bool(first)
    assert yielding > 0


@pytest.mark.parametrize(
    ("data", "complaint"),
    [
        (b"no gzip", "damaged"),
        (gzip.compress(b"x" * 100, mtime=0)[:-9], "damaged"),
        (gzip.compress(b"<osm/>", mtime=0), "not a SUMO net"),
        (gzip.compress(b"<net", mtime=0), "not an XML file"),
        (gzip.compress(b"\xff\xfe\x00", mtime=0), "not an XML file"),
        (net("0,0 nan,1"), "farther"),
        (net("0,0 1e300,1"), "farther"),
        (net("0,0 inf,1"), "farther"),
        (net(" ".join("0,0 1000000,0" for _ in range(9))), "longer"),
        (
            net("0,0 9,0", f'<junction id="j" {PLACE} shape="0,0 1,b 3,3"/>'),
            "to float: 'b'",
        ),
        (net("0,0 9,0", f'<junction id="j" {PLACE} shape="0,0 1,1e9 3,3"/>'), "farther"),
    ],
)
def test_roads_that_are_none_are_refused(data: bytes, complaint: str) -> None:
    with pytest.raises(NetworkError, match=complaint):
        roads.read(data)


def test_a_bomb_does_not_go_off() -> None:
    """A few hundred bytes that would be gigabytes (billion laughs) are no XML that is read."""
    entities = "".join(
        f'<!ENTITY e{k + 1} "{"".join(f"&e{k};" for _ in range(10))}">' for k in range(11)
    )
    text = f'<!DOCTYPE net [<!ENTITY e0 "laugh">{entities}]><net>&e11;</net>'
    with pytest.raises(NetworkError, match="not an XML file"):
        roads.read(gzip.compress(text.encode(), mtime=0))


def test_outlines_are_of_junctions_that_have_an_area() -> None:
    text = f"""<net>
        <junction id="a" {PLACE} shape="0,0 4,0 4,4"/>
        <junction id=":b" {PLACE.replace("priority", "internal")} shape="0,0 4,0 4,4"/>
        <junction id="c" {PLACE} shape="0,0 4,0"/>
        <junction id="d" {PLACE} shape=""/>
        <junction id="e" {PLACE}/>
    </net>"""
    assert parse_outlines(text.encode(), "it") == (((0.0, 0.0), (4.0, 0.0), (4.0, 4.0)),)


def test_a_net_without_roads_has_bounds() -> None:
    network, outlines = roads.read(gzip.compress(b"<net></net>", mtime=0))
    assert roads.shown(network, outlines).bounds == (0.0, 0.0, 0.0, 0.0)


def test_a_scene_as_it_was_seen() -> None:
    other = VehicleState(
        (1.23456, -2.0), math.pi / 3, 9.87654, 0.5, 4.567, 1.8, "bus", "red", ("left",)
    )
    ego = VehicleState((0.0, 0.0), 0.0, 10.0, 0.0, 4.5, 1.8)
    report = SceneReport(
        ride="r",
        seq=7,
        sim_time=3.2,
        wall_time=99.5,
        vehicles={2: other, 0: ego},
        state="driving",
        speed_factor=1.0,
        plan=("continue",),
        traces=1,
        events=0,
    )
    shown = roads.scene(report)
    assert (shown.seq, shown.t, shown.wall, shown.state) == (7, 3.2, 99.5, "driving")
    assert (shown.speed, shown.plan) == (1.0, ("continue",))
    assert shown.vehicles == (
        (0, 0.0, 0.0, 0.0, 10.0, 4.5, 1.8, "car", None, ()),
        (2, 1.23, -2.0, 1.047, 9.88, 4.57, 1.8, "bus", "red", ("left",)),
    )


def test_what_is_for_others_and_what_lights_control_is_shown() -> None:
    network, outlines = roads.read(packed("junction"))
    shown = roads.shown(network, outlines)
    assert [lane.id for lane in shown.others] == list(network.other_lanes)
    assert {lane.use for lane in shown.others} == {"bicycles", "people"}
    assert {lane.use for lane in shown.lanes} == {"cars"}
    assert [one.signal for one in shown.crossings].count(None) == 1  # the zebra crossing
    assert {one.width for one in shown.crossings} == {4.0}
    controlled = {link.signal for link in shown.links if link.signal is not None}
    assert controlled
    assert controlled.isdisjoint(one.signal for one in shown.crossings)


def test_people_lights_and_hidden_stretches_of_a_scene_are_shown() -> None:
    report = SceneReport(
        ride="r",
        seq=7,
        sim_time=3.2,
        wall_time=99.5,
        vehicles={0: VehicleState((0.0, 0.0), 0.0, 10.0, 0.0, 4.5, 1.8)},
        people={9: PersonState((5.0, 1.0), 0.5, 1.4, 0.2, 0.5)},
        lights=(Light(Signal("J", 3), LightState.RED_AMBER, 1.0, change_seen=True),),
        unseen=(Unseen("a_0", 10.0, 22.345), Unseen("b_0", math.nan, 3.0)),
        state="driving",
        speed_factor=1.0,
        plan=(),
        traces=0,
        events=0,
    )
    shown = roads.scene(report)
    assert shown.vehicles[1] == (9, 5.0, 1.0, 0.5, 1.4, 0.2, 0.5, "pedestrian", None, ())
    assert shown.lights == (("J 3", "red_amber"),)
    assert shown.hidden == (("a_0", 10.0, 22.3),)
