"""`xavi drive`: the car, alone or as a child process that takes commands."""

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
from xavi_dialogue.storage.resume import known_as
from xavi_dialogue.storage.ride_file import RecordedRide, RideFileError, save
from xavi_dialogue.vehicle.bus_session import (
    CHILD_PATIENCE,
    HUB_PATIENCE,
    BusSession,
    QuitBeforeRide,
    ReplanningOptions,
    join_bus,
)
from xavi_dialogue.vehicle.episode import Ending, Moment, clock, network_of, start
from xavi_dialogue.vehicle.node import Pace, VehicleNode
from xavi_dialogue.vehicle.telemetry import Reporter

Record: TypeAlias = Callable[[Moment], None]

_LOG = logging.getLogger(__name__)
HARD_BRAKE = -4.0  # [m/s2]
UNHURRIED = 5.0  # [s] allowed for sending the last reports after the ride,
HURRIED = 1.0  # [s] and when asked to quit
FORCED = 2.8  # [s] after a signal, when the process ends in any case


class Summary(msgspec.Struct):
    """A ride in figures: the object that `xavi drive --json` prints."""

    scenario: str
    seed: int
    ended: Ending | None = None  # null: asked to quit
    goal_reached: bool = False
    arrival_time: float | None = None  # [s]
    decisions: int = 0
    collisions: int = 0  # vehicles that the ego touched
    hard_brakes: int = 0  # times that the ego began to brake by more than 4 m/s2
    events: list[Event] = []
    wall_s: float = 0.0


@dataclass
class SummaryRecorder:
    """A recorder of figures from the moments of a ride."""

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
class RideLog:
    """A log of the decisions and events of a ride, for saving."""

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
class DriveOptions:
    """Options of a ride."""

    speed: float = 0.0  # simulated seconds per second; 0 is as fast as possible
    duration: float | None = None  # [s]; None: the scenario's
    link: Link | None = None  # to a hub; None: nothing is published
    vehicle: str = DEFAULT_VEHICLE  # name of the car on the bus
    controlled: bool = False  # by orders on standard input; waits for the first one
    save: Path | None = None  # where to save the decisions
    replanning: ReplanningOptions = field(
        default_factory=ReplanningOptions
    )  # options of planning again
    trees: int = 1  # of each search


def drive(
    scenario: Scenario,
    options: DriveOptions,
    signals: child_commands.Signals | None = None,
) -> Summary:
    """Drive a scenario to its end, or until asked to quit.

    Args:
        scenario: to drive, with the seed of the ride.
        options: of the ride.
        signals: record the signals that arrive; None: new ones.

    Raises:
        SimulationError: SUMO is not installed or fails.
        DriverError: the car cannot go on.
        HubUnreachable: there is no hub at the endpoint.
        BadLink: the configuration of the link cannot be used.
        NameTaken: another car of this name is on the bus.
        RideFileError: the decisions cannot be saved.
    """
    if options.save is not None and not options.save.parent.is_dir():
        raise RideFileError(f"cannot write {options.save}: there is no such folder")
    began = time.monotonic()
    orders: child_commands.Orders = queue.SimpleQueue()
    signals = child_commands.Signals() if signals is None else signals
    signals.listen(orders, FORCED)
    if options.controlled:
        child_commands.listen(sys.stdin, orders)
    tally = SummaryRecorder(Summary(scenario.name, scenario.seed))
    known = known_as(scenario.place) or scenario.name
    log = RideLog(RecordedRide(known, scenario.seed, 0.0))
    records = (tally.record, *((log.record,) if options.save else ()))
    with (
        suppress(QuitBeforeRide),
        _remedied(scenario),
        _joined_to_bus(scenario, options, signals) as bus_session,
    ):
        _drive(scenario, options, _Connections(orders, records, bus_session))
    if options.save is not None:
        save(log.ride, options.save)
    tally.summary.wall_s = round(time.monotonic() - began, 3)
    _LOG.info("the ride is over", extra={"ended": tally.summary.ended or "told to quit"})
    return tally.summary


@dataclass(frozen=True)
class _Connections:
    """The source of commands, and the receivers of moments."""

    orders: child_commands.Orders
    records: tuple[Record, ...]
    bus_session: BusSession | None


def _drive(scenario: Scenario, options: DriveOptions, connections: _Connections) -> None:
    reporter, records, bus_session = None, connections.records, connections.bus_session
    if bus_session is not None:
        keys = Keys(options.vehicle)
        reporter = Reporter(
            bus_session.outbox, keys, known_as(scenario.place), scenario.seed, bus_session.alive
        )
        records = (*records, bus_session.planning.record)
    network = network_of(scenario)
    _LOG.info("the ride begins", extra={"scenario": scenario.name, "seed": scenario.seed})
    with start(scenario, network, duration=options.duration, trees=options.trees) as ride:
        pace = Pace(options.speed, running=not options.controlled)
        VehicleNode(
            ride, scenario.step, records, reporter, connections.orders, pace, options.controlled
        ).run()
    if bus_session is not None:
        bus_session.outbox.close(HURRIED if pace.quit else UNHURRIED)


def _joined_to_bus(
    scenario: Scenario, options: DriveOptions, signals: child_commands.Signals
) -> AbstractContextManager[BusSession | None]:
    """Join the bus if there is a link; without one, publish nothing."""
    if options.link is None:
        return nullcontext()
    patience = CHILD_PATIENCE if options.controlled else HUB_PATIENCE
    keys = Keys(options.vehicle)
    return join_bus(options.link, keys, scenario.network, options.replanning, signals, patience)


@contextmanager
def _remedied(scenario: Scenario) -> Iterator[None]:
    """Add a hint on where to look to errors of SUMO."""
    try:
        yield
    except (SumoFailed, EgoGone) as error:
        if str(scenario.routes) in str(error):
            raise
        look = f"look at the vehicles in {scenario.routes} and at the roads in {scenario.network}"
        raise type(error)(f"{error}; {look}") from error
