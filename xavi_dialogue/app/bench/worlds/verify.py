"""Whether a planted cause is one: SUMO drives the ego itself, with and without each vehicle.

Two drives are compared by when the ego passes each place of its way, and by the lanes it takes.
No prediction of ours has a part in it.
"""

import math
from bisect import bisect_left
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass

from sim.netfile import read_network
from sim.network import Network
from sim.scenario import Scenario
from sim.scene import Scene
from sim.sumo import EgoGone, Simulation
from xavi_dialogue.app.bench.watch import reached
from xavi_dialogue.app.bench.worlds.folder import without
from xavi_dialogue.app.bench.worlds.values import World

CHANGED = 1.5  # [s] by which a vehicle that matters changes when the ego is where
SAME = 0.3  # [s] below which a vehicle does not matter
HIDDEN = 1.0  # [s] for which an occluder must hide the planted vehicle
GRID = 2.0  # [m] between the places at which drives are compared


@dataclass(frozen=True, slots=True)
class Way:
    """A drive of the ego from its start to its goal."""

    arrived: bool
    time: tuple[float, ...]  # [s] [N]
    gone: tuple[float, ...]  # [m] driven since the start [N]
    lanes: tuple[int, ...]  # indices of the lanes taken, one after the other
    seen: tuple[frozenset[int], ...]  # the others in view [N]


@dataclass(frozen=True, slots=True)
class Check:
    """What removing vehicles does to SUMO's ego."""

    planted: float  # [s] by which it is elsewhere without the planted vehicle
    swerves: bool  # it takes other lanes without it
    others: float  # [s] the most that one of the others makes of a difference
    hidden: float  # [s] for which the occluder hides the planted vehicle

    @property
    def matters(self) -> bool:
        """Whether the planted vehicle does."""
        return self.planted > CHANGED or self.swerves


def verify(world: World, scenario: Scenario) -> Check | None:
    """Drive with everybody, without the planted one, and without each of the others.

    Returns:
        What came of it; None where the planted vehicle alone does not matter.

    Raises:
        SimulationError: SUMO is not installed or fails.
    """
    network = read_network(scenario.network)
    whole = drive(scenario, network)
    free = drive(without(world, scenario, {world.planted}), network)
    if not (whole.arrived and free.arrived):
        return None
    check = Check(apart(whole, free), whole.lanes != free.lanes, 0.0, 0.0)
    empty = drive(without(world, scenario, world.others), network)
    if not check.matters or not _same(free, empty):
        return None
    hidden, most = 0.0, apart(free, empty)
    for name in world.others:
        if name == world.planted:
            continue
        less = drive(without(world, scenario, {name}), network)
        if not _same(whole, less):
            return None
        most = max(most, apart(whole, less))
        if name == world.occluder:
            hidden = _hidden(whole, less, world.planted, scenario.step)
    if world.occluder is not None and hidden < HIDDEN:
        return None
    return Check(check.planted, check.swerves, most, hidden)


def drive(scenario: Scenario, network: Network) -> Way:
    """The ego driven by SUMO's own driver to its goal, or to the end of the time."""
    time: list[float] = []
    gone: list[float] = []
    lanes: list[int] = []
    seen: list[frozenset[int]] = []
    with Simulation(scenario, scenario.seed) as world, suppress(EgoGone):
        scene, last = world.scene(), world.scene().ego.position
        while scene.time < scenario.duration:
            step = math.dist(last, scene.ego.position)
            last = scene.ego.position
            time.append(scene.time)
            gone.append((gone[-1] if gone else 0.0) + step)
            seen.append(frozenset(scene.vehicles))
            lane = _lane(network, scene)
            if lane is not None and lanes[-1:] != [lane]:
                lanes.append(lane)
            if world.collisions():
                break
            if reached(network, scenario.goal, scene):
                return Way(True, tuple(time), tuple(gone), tuple(lanes), tuple(seen))
            scene = world.step(None)
    return Way(False, tuple(time), tuple(gone), tuple(lanes), tuple(seen))


def apart(one: Way, other: Way) -> float:
    """The most [s] by which two drives differ in when they pass a place."""
    end = min(one.gone[-1], other.gone[-1])
    places = [k * GRID for k in range(int(end / GRID) + 1)] + [end]
    return max(abs(_passes(one, place) - _passes(other, place)) for place in places)


def _passes(way: Way, place: float) -> float:
    """When [s] a drive has come so far [m]; between two samples it is interpolated."""
    k = bisect_left(way.gone, place)
    if k == 0:
        return way.time[0]
    if k == len(way.gone):
        return way.time[-1]
    before, after = way.gone[k - 1], way.gone[k]
    return way.time[k - 1] + (way.time[k] - way.time[k - 1]) * (place - before) / (after - before)


def _same(one: Way, other: Way) -> bool:
    return other.arrived and one.lanes == other.lanes and apart(one, other) < SAME


def _lane(network: Network, scene: Scene) -> int | None:
    places = network.locate(scene.ego.position, scene.ego.heading)
    lane = network.lanes[places[0].lane] if places else None
    return None if lane is None or lane.internal else lane.index


def _hidden(whole: Way, less: Way, planted: int, step: float) -> float:
    """For how long [s] a vehicle is seen only where the occluder is away."""
    pairs: Sequence[tuple[frozenset[int], frozenset[int]]] = list(
        zip(whole.seen, less.seen, strict=False)
    )
    return step * sum(planted in b and planted not in a for a, b in pairs)
