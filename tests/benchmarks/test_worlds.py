"""Worlds with planted causes: how they are drawn and written."""

import math
from collections.abc import Iterator
from pathlib import Path
from random import Random

import pytest

from benchmarks.worlds.bystanders import APART, MOST
from benchmarks.worlds.folder import without, write
from benchmarks.worlds.generate import STORIES, draw, kind_of
from benchmarks.worlds.nets import write_net
from benchmarks.worlds.values import KINDS, Roads, World
from sim.roads.netfile import read_network
from sim.sumo import Simulation
from tests.sources import imports, modules

WORLDS = "benchmarks.worlds"
FORBIDDEN = ("planner", "xavi_dialogue.causal", "xavi_dialogue.explain")


def known_by(name: str) -> Iterator[str]:
    """The modules of ours that a module imports, and those that these do."""
    waiting, seen = [name], set()
    while waiting:
        module = waiting.pop()
        if module in seen or module not in modules():
            continue
        seen.add(module)
        waiting += [found.target for found in imports(modules()[module])]
    yield from sorted(seen)


@pytest.mark.parametrize("name", [name for name in modules() if name.startswith(WORLDS)])
def test_worlds_know_neither_the_planner_nor_its_explanations(name: str) -> None:
    for target in known_by(name):
        assert not target.startswith(FORBIDDEN), f"{name} comes to know {target}"


def test_a_seed_gives_one_world_and_another_seed_another() -> None:
    assert draw(8, 0) == draw(8, 0)
    assert draw(8, 0) != draw(8, 1)
    assert draw(8, 0) != draw(14, 0)


def test_the_kinds_take_turns() -> None:
    assert [kind_of(seed) for seed in range(len(KINDS))] == list(KINDS)
    assert set(STORIES) == set(KINDS)


@pytest.mark.parametrize("seed", range(60))
def test_vehicles_stand_apart_on_their_roads(seed: int) -> None:
    world = draw(seed, 0)
    assert len(world.others) <= MOST + 1
    assert all(name > 0 for name in world.others)
    everybody = [world.ego, *world.others.values()]
    for k, one in enumerate(everybody):
        edge = world.roads.edges[one.route[0]]
        assert 0.0 < one.position < edge.length
        assert 0 <= one.lane < edge.lanes
        for other in everybody[:k]:
            if (one.route[0], one.lane) == (other.route[0], other.lane):
                near = {one.role, other.role} & {"hiding", "ego", "held-up"}
                assert abs(one.position - other.position) >= (0.0 if near else min(APART, 14.0))


def test_the_worlds_differ_in_roads_vehicles_and_numbers() -> None:
    drawn = [draw(seed, 0) for seed in range(120)]
    shapes = {v.shape for world in drawn for v in world.others.values()}
    roles = {v.role for world in drawn for v in world.others.values()}
    assert shapes == {"car", "van", "truck", "bus", "motorcycle"}
    assert roles >= {"parked", "other-road", "behind", "leaving", "oncoming", "other-lane"}
    assert {len(world.others) for world in drawn} >= set(range(1, MOST))
    assert len({edge.speed for world in drawn for edge in world.roads.edges.values()}) >= 4
    assert {edge.lanes for world in drawn for edge in world.roads.edges.values()} == {1, 2}
    assert {name for world in drawn for name in world.planted} == set(range(1, MOST + 4))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("worlds")


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(len(KINDS)))
def test_bent_roads_lead_where_straight_ones_do(seed: int, folder: Path) -> None:
    straight, bent = (draw(seed, 0, family) for family in ("straight", "bent"))
    assert bent.others == straight.others
    lanes = [
        read_network(write(world, folder / f"{seed}-{k}").network).lanes
        for k, world in enumerate((straight, bent))
    ]
    assert {lane.id for lane in lanes[1].values() if not lane.internal} == {
        lane.id for lane in lanes[0].values() if not lane.internal
    }
    for name in bent.roads.edges:
        if not name.startswith("aside"):
            known = lanes[1][f"{name}_0"].length
            assert known == pytest.approx(straight.roads.edges[name].length, rel=0.25)


@pytest.mark.slow
def test_the_others_stay_what_they_are_when_one_is_taken_away(folder: Path) -> None:
    drawn = (draw(seed, 0) for seed in range(60))
    world = next(w for w in drawn if w.planted and len(w.others) > 8)
    scenario = write(world, folder / "less")
    looks = []
    for gone in ((), world.planted):
        with Simulation(without(world, scenario, gone)) as run:
            looks.append(
                {n: (v.colour, v.length, v.position) for n, v in run.scene().vehicles.items()}
            )
    shared = set(looks[1])
    assert len(shared) > 1
    assert not set(world.planted) & set(looks[1])
    assert all(looks[0][name] == looks[1][name] for name in shared if name in looks[0])


@pytest.mark.slow
def test_the_compass_is_turned_and_distances_stay(folder: Path) -> None:
    drawn = (draw(seed, 0) for seed in range(5, 40))
    worlds = [world for world in drawn if "west_in" in world.roads.edges][:2]
    bearings = [_bearing(world.roads) for world in worlds]
    assert abs(bearings[0] - bearings[1]) > 0.01
    for world in worlds:
        lanes = read_network(write(world, folder / f"turned-{world.seed}").network).lanes
        road = world.roads.edges["west_in"]
        [lane] = [lane for lane in lanes.values() if lane.id == "west_in_0"]
        assert 0.0 < road.length - lane.length < 20.0


def _bearing(roads: Roads) -> float:
    places = {node.id: (node.x, node.y) for node in roads.nodes}
    return math.atan2(*places["west"])


def test_stories_draw_from_what_they_are_given_alone() -> None:
    for kind, story in STORIES.items():
        assert story(Random(7)) == story(Random(7)), kind


def test_a_world_says_who_is_planted_and_who_is_idle() -> None:
    counts = {"one": 1, "both": 2, "either": 2, "pre-empted": 2, "distractor": 1, "none": 0}
    for seed in range(24):
        world: World = draw(seed, 0)
        usual = 2 - len(world.idle)  # one that reacts to the ego is idle; of a chain none is
        assert len(world.planted) == counts.get(world.kind, usual)
        assert set(world.planted) | set(world.idle) <= set(world.others)
        assert not set(world.planted) & set(world.idle)
        if world.kind in ("distractor", "none"):
            assert len(world.idle) == 1


def test_random_networks_follow_from_family_and_number(tmp_path: Path) -> None:
    def files(family: str, number: int, name: str) -> tuple[str, str]:
        scenario = write_net(family, number, tmp_path / name)
        route = scenario.routes.read_text(encoding="utf-8")
        return read_network(scenario.network).hash, route

    first = files("random", 3, "one")
    assert files("random", 3, "two") == first
    others = [files("learning", 3, "three"), files("random", 4, "four")]
    assert first[0] not in {net for net, _ in others}
    assert others[0] != others[1]
