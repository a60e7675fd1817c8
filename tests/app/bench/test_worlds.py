"""Worlds with one planted cause: how they are drawn, and how SUMO confirms them."""

import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from random import Random

import pytest

from sim.netfile import read_network
from sim.sumo import Simulation
from tests.sources import imports, modules
from xavi_dialogue.app.bench.worlds.bystanders import APART, MOST
from xavi_dialogue.app.bench.worlds.folder import without, write
from xavi_dialogue.app.bench.worlds.generate import NoWorld, draw, generate, kind_of
from xavi_dialogue.app.bench.worlds.stories import STORIES
from xavi_dialogue.app.bench.worlds.values import KINDS, Roads, Vehicle, World
from xavi_dialogue.app.bench.worlds.verify import CHANGED, SAME, Way, apart, drive, verify

WORLDS = "xavi_dialogue.app.bench.worlds"
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
    assert len(world.others) - 1 <= MOST
    assert all(name > 0 for name in world.others)
    everybody = [world.ego, *world.others.values()]
    for k, one in enumerate(everybody):
        edge = world.roads.edges[one.route[0]]
        assert 0.0 < one.position < edge.length
        assert 0 <= one.lane < edge.lanes
        for other in everybody[:k]:
            if (one.route[0], one.lane) == (other.route[0], other.lane):
                near = {one.role, other.role} & {"hiding", "ego"}
                assert abs(one.position - other.position) >= (0.0 if near else min(APART, 14.0))


def test_the_worlds_differ_in_roads_vehicles_and_numbers() -> None:
    drawn = [draw(seed, 0) for seed in range(120)]
    shapes = {v.shape for world in drawn for v in world.others.values()}
    roles = {v.role for world in drawn for v in world.others.values()}
    assert shapes == {"car", "van", "truck", "bus", "motorcycle"}
    assert roles >= {"parked", "other-road", "behind", "leaving", "oncoming", "other-lane"}
    assert {len(world.others) for world in drawn} >= set(range(1, MOST + 2))
    assert len({edge.speed for world in drawn for edge in world.roads.edges.values()}) >= 4
    assert {edge.lanes for world in drawn for edge in world.roads.edges.values()} == {1, 2}
    assert {world.planted for world in drawn} == set(range(1, MOST + 2))


def test_drives_are_compared_by_when_they_pass_each_place() -> None:
    steady = Way(True, (0.0, 1.0, 2.0, 3.0), (0.0, 10.0, 20.0, 30.0), (0,), ())
    waits = Way(True, (0.0, 1.0, 2.0, 4.0), (0.0, 10.0, 10.0, 30.0), (0,), ())
    assert apart(steady, steady) == 0.0
    assert apart(steady, waits) == pytest.approx(1.0, abs=0.11)
    assert apart(waits, steady) == apart(steady, waits)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("worlds")


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(len(KINDS)))
def test_sumo_confirms_a_world_of_every_kind(seed: int, folder: Path) -> None:
    found = generate(seed, folder / str(seed))
    world, check = found.world, found.check
    assert check.swerves or check.planted > CHANGED
    assert check.others < SAME
    network = read_network(found.scenario.network)
    whole = drive(found.scenario, network)
    less = drive(without(world, found.scenario, {world.planted}), network)
    assert whole.arrived
    assert less.arrived
    assert all(world.planted not in seen for seen in less.seen)
    assert any(world.planted in seen for seen in whole.seen)
    assert apart(whole, less) == check.planted
    if world.occluder is not None:
        assert check.hidden >= 1.0


@pytest.mark.slow
def test_the_others_stay_what_they_are_when_one_is_taken_away(folder: Path) -> None:
    world = next(w for w in (draw(seed, 0) for seed in range(0, 60, 6)) if len(w.others) >= 5)
    scenario = write(world, folder / "less")
    looks = []
    for gone in ((), (world.planted,)):
        with Simulation(without(world, scenario, gone), 0) as run:
            looks.append(
                {n: (v.colour, v.length, v.position) for n, v in run.scene().vehicles.items()}
            )
    shared = set(looks[1]) - {world.planted}
    assert len(shared) > 1
    assert world.planted not in looks[1]
    assert all(looks[0][name] == looks[1][name] for name in shared if name in looks[0])


@pytest.mark.slow
def test_a_world_in_which_two_vehicles_matter_is_not_confirmed(folder: Path) -> None:
    """A second slow vehicle ahead of the first: without the first, the second is met."""
    world = draw(12, 0)
    slow = world.others[world.planted]
    assert slow.role == "slow"
    assert slow.top is not None
    ahead = replace(slow, position=slow.position + 60.0, top=0.7 * slow.top)
    both = replace(world, others={1: slow, 2: ahead}, planted=1)
    assert verify(both, write(both, folder / "two")) is None
    one = replace(world, others={1: slow}, planted=1)
    assert verify(one, write(one, folder / "one")) is not None


@pytest.mark.slow
def test_a_world_in_which_the_planted_vehicle_does_nothing_is_not_confirmed(folder: Path) -> None:
    world = draw(0, 0)
    far = Vehicle("away", "car", ("aside_there",), 0, 20.0, 5.0)
    idle = replace(world, others={1: far}, planted=1)
    assert verify(idle, write(idle, folder / "idle")) is None


@pytest.mark.slow
def test_giving_up_is_told(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from xavi_dialogue.app.bench.worlds import generate as module

    monkeypatch.setattr(module, "verify", lambda world, scenario: None)
    monkeypatch.setattr(module, "TRIES", 2)
    with pytest.raises(NoWorld, match="none of 2 worlds drawn for seed 1"):
        generate(1, folder / "never")


@pytest.mark.slow
def test_the_compass_is_turned_and_distances_stay(folder: Path) -> None:
    worlds = [draw(seed, 0) for seed in (2, 8)]
    bearings = [_bearing(world.roads) for world in worlds]
    assert abs(bearings[0] - bearings[1]) > 0.01
    for world in worlds:
        lanes = read_network(write(world, folder / f"turned-{world.seed}").network).lanes
        drawn = world.roads.edges["west_in"]
        [lane] = [lane for lane in lanes.values() if lane.id == "west_in_0"]
        assert 0.0 < drawn.length - lane.length < 20.0


def _bearing(roads: Roads) -> float:
    places = {node.id: (node.x, node.y) for node in roads.nodes}
    return math.atan2(*places["west"])


def test_stories_draw_from_what_they_are_given_alone() -> None:
    for kind, story in STORIES.items():
        assert story(Random(7)) == story(Random(7)), kind


def test_a_world_says_who_is_planted_and_who_hides_it() -> None:
    for seed in range(12):
        world: World = draw(seed, 0)
        assert world.planted in world.others
        assert (world.occluder is not None) == (world.kind == "occluder")
        if world.occluder is not None:
            assert world.others[world.occluder].shape in ("truck", "bus")
