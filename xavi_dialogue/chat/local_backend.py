"""The processes of car and service for one chat, which are started and stopped in order."""

import socket
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import TypeAlias

from xavi_dialogue.bus.interface import HubUnreachable, Keys
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.messages import SceneReport
from xavi_dialogue.bus.zenoh_bus import ZenohBus, join
from xavi_dialogue.chat.client import Client, ServiceLost
from xavi_dialogue.chat.vehicle_supervisor import VehicleSupervisor
from xavi_dialogue.process import child_commands
from xavi_dialogue.process.subprocesses import Child, ChildFailed, OptionalChild, RestartedChild
from xavi_dialogue.runtime import system
from xavi_dialogue.storage.turn_log import Retention
from xavi_dialogue.terminal.slash_commands import CommandError

ATTEMPTS = 3  # to find a port that stays free until the service listens on it
RETRY = 0.2  # [s] between checks whether the service is ready
START_PATIENCE = 90.0  # [s] for the service, and for the first scene: kernels may be compiled
SPARE = 5  # times that a failed service is restarted
BACK = 60.0  # [s] until it must answer then; on a busy machine it takes long to start
CLOSING = 1.5  # [s] to leave the bus
KILLED = 15.0  # [s] to leave the bus of a service that was killed
OVER = "the chat is over"
LIVE = "Only a recorded ride can be taken to any moment: xavi replay FILE."
SILENCE = 20.0  # [s] without a scene after which the car counts as lost

Tell: TypeAlias = Callable[[str], None]


@dataclass(frozen=True)
class LocalBackend:
    """The processes behind a chat, with a connection to them; see Backend."""

    car: VehicleSupervisor
    service: RestartedChild
    bus: ZenohBus
    recorder: OptionalChild | None = None
    over: system.Event = field(default_factory=system.event)
    seeks: bool = False  # the car is a recording, which can go to any moment
    endpoint: str = ""  # of the hub: others may join
    paced: bool = True  # see Backend

    def check(self) -> None:
        """Check the processes; restart the service if it has ended.

        Raises:
            ChildFailed: the car did not start, or the service ended too often.
        """
        self.service.check()
        self.car.check()
        if self.recorder is not None:
            self.recorder.check()

    def recover(self, client: Client) -> bool:
        """See Backend."""
        give_up = system.monotonic() + BACK
        while system.monotonic() < give_up and not self.over.wait(RETRY):
            self.service.check()
            with suppress(ServiceLost):
                client.probe()
                return True
        return False

    def order(self, order: child_commands.Order) -> None:
        """See Backend."""
        if isinstance(order, child_commands.Seek) and not self.seeks:
            raise CommandError(LIVE)
        self.car.order(order)

    def set_off(self) -> None:
        """See Backend."""
        with suppress(CommandError):  # the car has ended, which was reported
            self.car.order(child_commands.Resume())

    def drive(
        self, client: Client, order: child_commands.Order, *, halt: bool = False
    ) -> SceneReport:
        """See Backend."""
        self.car.order(order)

        def done(scene: SceneReport) -> bool:
            return self.car.obeyed(scene) and not (halt and scene.state == "driving")

        while True:
            scene = client.wait_for(done, self.wait, SILENCE)
            if scene is not None:
                return scene
            if not self.car.catching_up:
                raise ChildFailed("the car no longer sends anything")

    def wait(self) -> None:
        """Check the processes; to be called repeatedly while waiting for the car.

        Raises:
            ChildFailed: see `check`; or the chat is over.
            CommandError: the car has ended.
        """
        if self.over.is_set():
            raise ChildFailed(OVER)
        self.check()
        self.car.hope()

    def now(self, client: Client) -> float | None:
        """See Backend."""
        return self.car.now(client.now())

    def trouble(self) -> str:
        """See Backend."""
        return self.car.trouble()


@dataclass(frozen=True)
class LocalOptions:
    """Options of a local backend: recording and where notes go."""

    record: Path | None = None  # file that the ride is recorded in
    overwrite: bool = False  # replace an existing file
    warn: Tell = lambda _: None  # gets the service's warnings, on a thread
    tell: Tell = lambda _: None  # gets notes for the passenger, on a thread
    over: system.Event = field(default_factory=system.event)  # set: nothing is waited for


@contextmanager
def start_local(
    scenario: str,
    seed: int,
    speed: float,
    keeping: Retention | None = None,
    options: LocalOptions | None = None,
    duration: float | None = None,
) -> Iterator[LocalBackend]:
    """Start the service, then the car; stop them in reverse order.

    Args:
        scenario: name or folder.
        seed: of the ride.
        speed: simulated seconds per second; 0 is as fast as possible.
        keeping: file in which the service stores turns, and for how long; None: not at all.
        options: recording and notes.
        duration: [s] of the ride at the longest; None: the scenario's.

    Raises:
        ChildFailed: a process did not start.
    """
    ride = ["drive", "--scenario", scenario, "--seed", str(seed), "--speed", repr(speed)]
    ride += [] if duration is None else ["--duration", repr(duration)]
    with start_processes(ride, speed, keeping, options) as backend:
        yield backend


@contextmanager
def start_processes(
    car: Sequence[str],
    speed: float,
    keeping: Retention | None,
    options: LocalOptions | None = None,
    *,
    seeks: bool = False,
) -> Iterator[LocalBackend]:
    """Do the same as `start_local` with any command that acts like a car.

    Args:
        car: arguments of `xavi`; the endpoint to connect to is added.
        speed: the initial pace.
        keeping: see `start_local`.
        options: see `start_local`.
        seeks: it is a recording, which can go to any moment.

    Raises:
        ChildFailed: a process did not start.
    """
    with ExitStack() as stack:
        backend = _start(stack, car, speed, _kept(keeping), options or LocalOptions())
        yield replace(backend, seeks=seeks)


def first_scene(backend: LocalBackend, client: Client) -> SceneReport:
    """Wait for the first scene of the car; from then on the car is restarted if it ends.

    Raises:
        ChildFailed: it did not start.
    """
    scene = client.wait_for(lambda _: True, backend.wait, START_PATIENCE)
    if scene is None:
        raise ChildFailed("the car does not start")
    backend.car.follow(client)
    return scene


def _kept(keeping: Retention | None) -> list[str]:
    if keeping is None:
        return ["--keep-days", "0"]
    return ["--keep-days", str(keeping.days), "--store", str(keeping.path.absolute())]


def _start(
    stack: ExitStack, car: Sequence[str], speed: float, kept: list[str], options: LocalOptions
) -> LocalBackend:
    """Start the processes and connect; try another port if some process takes the first."""
    for attempt in range(1, ATTEMPTS + 1):
        endpoint = f"tcp/127.0.0.1:{_free_port()}"
        serve = ["serve", "--listen", endpoint, *kept]
        begin = partial(Child, "the dialogue service", serve, options.warn)
        service = stack.enter_context(RestartedChild(begin))
        recorder = _recorder(stack, options, endpoint)
        drive = partial(Child, "the car", [*car, "--connect", endpoint], options.warn)
        driven = stack.enter_context(VehicleSupervisor(drive, speed, options.tell))
        try:
            bus = stack.enter_context(_join(service, endpoint, options.over))
        except ChildFailed:
            if attempt == ATTEMPTS or options.over.is_set():
                raise
            stack.close()
        else:
            service.spare = SPARE
            stack.callback(_let_go, bus, service)
            if recorder is not None:
                _await(recorder.child, bus, options.over)
            return LocalBackend(driven, service, bus, recorder, options.over, endpoint=endpoint)
    raise AssertionError("the last attempt returns or raises")


def _recorder(stack: ExitStack, options: LocalOptions, endpoint: str) -> OptionalChild | None:
    if options.record is None:
        return None
    record = ["record", str(options.record.absolute()), "--connect", endpoint]
    record += ["--force"] if options.overwrite else []
    child = stack.enter_context(Child("the recorder", record, options.warn))
    return OptionalChild(child, options.tell)


def _await(recorder: Child, bus: ZenohBus, over: system.Event) -> None:
    """Wait until the recorder is ready, so that it misses nothing of the ride.

    Raises:
        ChildFailed: it did not start; or the chat is over.
    """
    there = threading.Event()
    bus.watch(Keys().of("alive/recorder"), lambda _, alive: there.set() if alive else None)
    give_up = system.monotonic() + START_PATIENCE
    while not there.wait(RETRY):
        recorder.check()
        if over.is_set():
            raise ChildFailed(OVER)
        if system.monotonic() > give_up:
            raise ChildFailed("the recorder does not start")


def _let_go(bus: ZenohBus, service: RestartedChild) -> None:
    """Close the connection; if that takes too long because the service hangs, kill the service."""
    closing = threading.Thread(target=bus.close, daemon=True)
    closing.start()
    closing.join(CLOSING)
    if closing.is_alive():
        service.kill()
        closing.join(KILLED)


def _join(service: RestartedChild, endpoint: str, over: system.Event) -> ZenohBus:
    """Connect to the service as soon as it is ready.

    Raises:
        ChildFailed: it did not start; or the chat is over.
    """
    give_up = system.monotonic() + START_PATIENCE
    while True:
        try:
            return join(Link.to_hub(endpoint), patience=RETRY)
        except HubUnreachable:
            service.check()
            if over.is_set():
                raise ChildFailed(OVER) from None
            if system.monotonic() > give_up:
                raise ChildFailed("the dialogue service does not start") from None


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])
