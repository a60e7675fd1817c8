"""A ride: the simulated world and the driver, step by step.

The caller takes one moment after the other, and thereby sets the speed of the ride and the time
of a halt. The record is complete up to the time of the latest moment.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Literal, Protocol, TypeAlias

import msgspec

from planner.driving.driver import Driver, DriveStep
from planner.record.events import Event
from planner.record.trace import Action, EgoGoal, PlanTrace, Settings
from sim.roads.netfile import read_network
from sim.roads.network import Network
from sim.scene import Command, Scene
from sim.setup.scenario import Scenario
from sim.sumo import Simulation
from xavi_dialogue.bus.interface import DEFAULT_VEHICLE
from xavi_dialogue.dialogue.manoeuvres import carried_out
from xavi_dialogue.dialogue.state.state import EPSILON
from xavi_dialogue.process.garbage import settled
from xavi_dialogue.vehicle.search_worker import TreeOfRide
from xavi_dialogue.vehicle.search_workers import search_workers

Ending: TypeAlias = Literal["arrived", "collided", "duration"]


@dataclass(frozen=True, slots=True)
class Moment:
    """One step of a ride: the scene, the decision and the events."""

    scene: Scene
    plan: tuple[Action, ...]  # of the latest decision
    trace: PlanTrace | None = None  # of a decision taken now
    events: tuple[Event, ...] = ()  # up to the end of the step that begins now
    ending: Ending | None = None  # in the last moment, the reason why the ride is over
    collisions: tuple[int, ...] = ()  # vehicles that the ego touches now


class World(Protocol):
    """A simulated world, which moves the other road users, and the ego as commanded."""

    def scene(self) -> Scene: ...

    def step(self, command: Command | None) -> Scene: ...

    def collisions(self) -> tuple[int, ...]: ...


class Drives(Protocol):
    """A driver; see planner.driving.driver.Driver."""

    @property
    def finished(self) -> bool: ...

    def step(self, scene: Scene, dt: float) -> DriveStep: ...


def moments(world: World, driver: Drives, step: float, duration: float) -> Iterator[Moment]:
    """Drive until arrival, collision or time-out; the last moment states which.

    Args:
        world: a world at its first scene.
        driver: of the ego.
        step: [s] of the simulation.
        duration: [s] after which the ride ends.
    """
    scene = world.scene()
    plan: tuple[Action, ...] = ()
    while True:
        driven = driver.step(scene, step)
        if driven.trace is not None:
            plan = tuple(planned.action for planned in driven.trace.plan)
        yield Moment(scene, plan, driven.trace, driven.events)
        scene = world.step(driven.command)
        touched = world.collisions()
        if touched:
            event = Event("collided", round(scene.time, 3), vehicle=touched[0])
            yield Moment(scene, plan, None, (event,), "collided", touched)
            return
        if driver.finished:
            yield Moment(scene, plan, ending="arrived")
            return
        if scene.time >= duration - EPSILON:
            event = Event("ended", round(scene.time, 3))
            yield Moment(scene, plan, None, (event,), "duration")
            return


def clock(moment: Moment) -> float:
    """Return the time [s] of a moment, as it is reported and asked about."""
    return round(moment.scene.time, 6)


def halts(until: float | None, time: float, events: Sequence[Event]) -> bool:
    """Check whether a ride that may run up to `until` [s] halts now.

    Args:
        until: [s]; None stands for the end of the first lane change or turn.
        time: [s] of the latest moment.
        events: of the ride so far.
    """
    if until is None:
        ends = carried_out(events)
        return bool(ends) and time >= ends[0].sim_time - EPSILON
    return time >= until - EPSILON


def network_of(scenario: Scenario) -> Network:
    """Return the road network of a scenario."""
    return read_network(scenario.network)


def settings_of(scenario: Scenario, trees: int = 1) -> Settings:
    """Return the planner's settings in a scenario."""
    several = trees if trees > 1 else msgspec.UNSET
    return Settings(view_radius=scenario.view_radius, reacting=True, trees=several)


@contextmanager
def start(
    scenario: Scenario,
    network: Network,
    *,
    duration: float | None = None,
    vehicle: str = DEFAULT_VEHICLE,
    trees: int = 1,
) -> Iterator[Iterator[Moment]]:
    """Start SUMO and the driver; the ride advances as its moments are taken.

    Args:
        scenario: to drive, with the seed of the ride.
        network: of the scenario.
        duration: [s] after which the ride ends; None: the scenario's.
        vehicle: name of the car on the bus.
        trees: of each search; all but the first grow in processes of their own.

    Raises:
        SimulationError: SUMO is not installed or does not start.
    """
    goal = EgoGoal(scenario.goal.edge, scenario.goal.position, scenario.goal.lane)
    settings = settings_of(scenario, trees)
    searched = TreeOfRide(goal, settings, scenario.seed, vehicle)
    with (
        Simulation(scenario) as world,
        search_workers(scenario.network, searched) as elsewhere,
        settled(),
    ):
        driver = Driver(network, goal, settings, scenario.seed, vehicle, elsewhere)
        limit = scenario.duration if duration is None else min(duration, scenario.duration)
        yield moments(world, driver, scenario.step, limit)
