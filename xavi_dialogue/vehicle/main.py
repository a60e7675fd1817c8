"""`xavi drive`: the car by itself, or as a child that is told its pace."""

import logging
import queue
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeAlias

import msgspec

from planner.record.events import Event
from sim.scene import EGO
from sim.setup.scenario import Scenario
from sim.sumo import EgoGone, SumoFailed
from xavi_dialogue.bus.interface import DEFAULT_VEHICLE, Keys
from xavi_dialogue.bus.link import Link
from xavi_dialogue.process import child_commands
from xavi_dialogue.storage.resume import place_of
from xavi_dialogue.storage.ride_file import RecordedRide, RideFileError, save
from xavi_dialogue.vehicle.bus_session import (
    CHILD_PATIENCE,
    HUB_PATIENCE,
    Company,
    Dismissed,
    Staff,
    company,
)
from xavi_dialogue.vehicle.episode import Ending, Moment, clock, network_of, start
from xavi_dialogue.vehicle.node import Car, Pace
from xavi_dialogue.vehicle.telemetry import Reporter

Record: TypeAlias = Callable[[Moment], None]

_LOG = logging.getLogger(__name__)
HARD_BRAKE = -4.0  # [m/s2]
UNHURRIED = 5.0  # [s] for the last reports to go out after the ride,
HURRIED = 1.0  # and when told to quit
FORCED = 2.8  # [s] after a signal, at which the process ends whatever it is doing


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
    staff: Staff = field(default_factory=Staff)  # who plans again for others


def drive(
    scenario: Scenario, seed: int, manner: Manner, signals: child_commands.Signals | None = None
) -> Summary:
    """Drive a scenario to its end, or until told to quit.

    Args:
        scenario: to drive.
        seed: of the ride.
        manner: how.
        signals: are listened to; they know afterwards what came.

    Raises:
        SimulationError: SUMO is not installed or fails.
        DriverError: the car cannot be driven on.
        HubUnreachable: there is no hub at the endpoint.
        BadLink: the configuration of the link cannot be used.
        NameTaken: another car of this name is on the bus.
        RideFileError: the decisions cannot be saved.
    """
    if manner.save is not None and not manner.save.parent.is_dir():
        raise RideFileError(f"cannot write {manner.save}: there is no such folder")
    began = time.monotonic()
    orders: child_commands.Orders = queue.SimpleQueue()
    signals = child_commands.Signals() if signals is None else signals
    signals.listen(orders, FORCED)
    if manner.controlled:
        child_commands.listen(sys.stdin, orders)
    tally = Tally(Summary(scenario.name, seed))
    log = Log(RecordedRide(scenario.name, seed, 0.0))
    records = (tally.record, *((log.record,) if manner.save else ()))
    with suppress(Dismissed), _remedied(scenario), _in_company(scenario, manner, signals) as others:
        _drive(scenario, seed, manner, _Told(orders, records, others))
    if manner.save is not None:
        save(log.ride, manner.save)
    tally.summary.wall_s = round(time.monotonic() - began, 3)
    _LOG.info("the ride is over", extra={"ended": tally.summary.ended or "told to quit"})
    return tally.summary


@dataclass(frozen=True)
class _Told:
    """Who tells the car, and who is told."""

    orders: child_commands.Orders
    records: tuple[Record, ...]
    others: Company | None


def _drive(scenario: Scenario, seed: int, manner: Manner, told: _Told) -> None:
    reporter, records, others = None, told.records, told.others
    if others is not None:
        keys = Keys(manner.vehicle)
        reporter = Reporter(others.outbox, keys, place_of(scenario), seed, others.alive)
        records = (*records, others.planning.record)
    network = network_of(scenario)
    _LOG.info("the ride begins", extra={"scenario": scenario.name, "seed": seed})
    with start(scenario, seed, network, duration=manner.duration) as ride:
        pace = Pace(manner.speed, running=not manner.controlled)
        Car(ride, scenario.step, records, reporter, told.orders, pace, manner.controlled).run()
    if others is not None:
        others.outbox.close(HURRIED if pace.quit else UNHURRIED)


def _in_company(
    scenario: Scenario, manner: Manner, signals: child_commands.Signals
) -> AbstractContextManager[Company | None]:
    """Who is told of the ride and may ask about it: nobody without a hub."""
    if manner.link is None:
        return nullcontext()
    patience = CHILD_PATIENCE if manner.controlled else HUB_PATIENCE
    keys = Keys(manner.vehicle)
    return company(manner.link, keys, scenario.network, manner.staff, signals, patience)


@contextmanager
def _remedied(scenario: Scenario) -> Iterator[None]:
    """Faults of SUMO with a word on where to look."""
    try:
        yield
    except (SumoFailed, EgoGone) as error:
        if str(scenario.routes) in str(error):
            raise
        look = f"look at the vehicles in {scenario.routes} and at the roads in {scenario.network}"
        raise type(error)(f"{error}; {look}") from error
