"""`xavi drive`: the car by itself, or as a child that is told its pace."""

import queue
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

import msgspec

from planner.events import Event
from sim.scenario import Scenario
from sim.scene import EGO
from xavi_dialogue.app import control
from xavi_dialogue.app.car import Car, Pace, serve
from xavi_dialogue.app.going_on import place_of
from xavi_dialogue.app.planning import Replanner, workers
from xavi_dialogue.app.report import Reporter
from xavi_dialogue.app.ride import Ending, Moment, clock, network_of, start
from xavi_dialogue.transports.bus import DEFAULT_VEHICLE, Keys
from xavi_dialogue.transports.link import Link
from xavi_dialogue.transports.ride_file import RecordedRide, RideFileError, save
from xavi_dialogue.transports.zenoh_bus import join

Record: TypeAlias = Callable[[Moment], None]

HARD_BRAKE = -4.0  # [m/s2]
HUB_PATIENCE = 10.0  # [s] for the hub to come up


class Summary(msgspec.Struct):
    """A ride in figures: the object that `xavi drive --json` prints."""

    scenario: str
    seed: int
    ended: Ending | None = None  # null: told to quit
    goal_reached: bool = False
    arrival_time: float | None = None  # [s]
    decisions: int = 0
    collisions: int = 0  # vehicles that the ego touched
    hard_brakes: int = 0  # times that the ego began to brake harder than 4 m/s2
    events: list[Event] = []
    wall_s: float = 0.0


@dataclass
class Tally:
    """Takes a ride's moments down as figures."""

    summary: Summary
    braking: bool = False

    def record(self, moment: Moment) -> None:
        """Count one moment."""
        summary = self.summary
        summary.decisions += moment.trace is not None
        summary.events.extend(moment.events)
        braking = moment.scene.vehicles[EGO].acceleration < HARD_BRAKE
        summary.hard_brakes += braking and not self.braking
        self.braking = braking
        summary.collisions += len(moment.collisions)
        summary.ended = moment.ending
        for event in moment.events:
            if event.kind == "arrived":
                summary.goal_reached, summary.arrival_time = True, event.sim_time


@dataclass
class Log:
    """Takes a ride's decisions and events down, to be saved."""

    ride: RecordedRide

    def record(self, moment: Moment) -> None:
        """Add one moment."""
        self.ride.halt = clock(moment)
        self.ride.events.extend(moment.events)
        if moment.trace is not None:
            self.ride.traces.append(moment.trace)
        if moment.ending is not None:
            self.ride.ended = self.ride.halt


@dataclass(frozen=True)
class Manner:
    """How to drive."""

    speed: float = 0.0  # simulated seconds per second; 0 is as fast as possible
    duration: float | None = None  # [s]; None: the scenario's
    link: Link | None = None  # to a hub; None: nobody is told
    vehicle: str = DEFAULT_VEHICLE  # name of the car on the bus
    controlled: bool = False  # by orders on standard input; waits for the first one
    save: Path | None = None  # where to save the decisions


def drive(scenario: Scenario, seed: int, manner: Manner) -> Summary:
    """Drive a scenario to its end, or until told to quit.

    Raises:
        SimulationError: SUMO is not installed or fails.
        DriverError: the car cannot be driven on.
        HubUnreachable: there is no hub at the endpoint.
        RideFileError: the decisions cannot be saved.
    """
    if manner.save is not None and not manner.save.parent.is_dir():
        raise RideFileError(f"cannot write {manner.save}: there is no such folder")
    began = time.monotonic()
    orders: control.Orders = queue.SimpleQueue()
    control.quit_on_signals(orders)
    if manner.controlled:
        control.listen(sys.stdin, orders)
    network = network_of(scenario)
    tally = Tally(Summary(scenario.name, seed))
    log = Log(RecordedRide(scenario.name, seed, 0.0))
    with (
        _company(scenario, seed, manner) as (reporter, records),
        start(scenario, seed, network, duration=manner.duration) as ride,
    ):
        car = Car(
            ride=ride,
            step=scenario.step,
            records=(tally.record, *((log.record,) if manner.save else ()), *records),
            reporter=reporter,
            orders=orders,
            pace=Pace(manner.speed, running=not manner.controlled),
            stays=manner.controlled,
        )
        car.run()
    if manner.save is not None:
        save(log.ride, manner.save)
    tally.summary.wall_s = round(time.monotonic() - began, 3)
    return tally.summary


@contextmanager
def _company(
    scenario: Scenario, seed: int, manner: Manner
) -> Iterator[tuple[Reporter | None, tuple[Record, ...]]]:
    """Who is told of the ride, and who takes it down to answer about it: nobody without a hub."""
    if manner.link is None:
        yield None, ()
        return
    keys = Keys(manner.vehicle)
    with join(manner.link, HUB_PATIENCE) as bus, workers(scenario.network) as pool:
        planning = Replanner(pool)
        serve(bus, keys, planning)
        yield Reporter(bus, keys, place_of(scenario), seed), (planning.record,)
