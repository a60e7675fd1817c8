"""Car and service for one chat: started in order, stopped in order, none left behind."""

import socket
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, field
from functools import partial

from xavi_dialogue.app import control
from xavi_dialogue.app.children import Child, ChildFailed, Steady
from xavi_dialogue.app.client import Client, ServiceLost
from xavi_dialogue.app.memory import Keeping
from xavi_dialogue.transports.bus import HubUnreachable
from xavi_dialogue.transports.link import Link
from xavi_dialogue.transports.messages import SceneReport
from xavi_dialogue.transports.zenoh_bus import ZenohBus, join

ATTEMPTS = 3  # to find a port that stays free until the service listens at it
RETRY = 0.2  # [s] between looks at whether the service is still coming up
START_PATIENCE = 90.0  # [s] for the service, and for the first scene: kernels may be compiled
SPARE = 5  # times that a service which has died is started anew
BACK = 15.0  # [s] until it must answer then
CLOSING = 1.5  # [s] that it may take to leave the bus
SILENCE = 20.0  # [s] without a scene after which the car counts as lost


@dataclass(frozen=True)
class Convoy:
    """The processes behind a chat, and its own connection to them."""

    car: Child
    service: Steady
    bus: ZenohBus
    over: threading.Event = field(default_factory=threading.Event)  # nobody waits any more

    def check(self) -> None:
        """Make sure that both are there; start the service anew if it is not.

        Raises:
            ChildFailed: the car has ended, or the service once too often.
        """
        self.service.check()
        self.car.check()

    def recover(self, client: Client) -> bool:
        """See to it that there is a service that answers; whether there is.

        Raises:
            ChildFailed: see `check`.
        """
        give_up = time.monotonic() + BACK
        while time.monotonic() < give_up and not self.over.wait(RETRY):
            self.service.check()
            with suppress(ServiceLost):
                client.probe()
                return True
        return False

    def drive(self, client: Client, order: control.Order, *, halt: bool = False) -> SceneReport:
        """Give the car an order, and wait until it has obeyed it.

        Args:
            client: sees the car's scenes.
            order: to give.
            halt: wait until the car has halted or the ride is over, too.

        Raises:
            ChildFailed: a process has ended, or the car is not heard of any more.
        """
        number = self.car.order(order)

        def done(scene: SceneReport) -> bool:
            return scene.orders >= number and not (halt and scene.state == "driving")

        scene = client.wait_for(done, self.check, SILENCE)
        if scene is None:
            raise ChildFailed("the car is not heard of any more")
        return scene


@contextmanager
def convoy(
    scenario: str,
    seed: int,
    speed: float,
    keeping: Keeping | None = None,
    warn: Callable[[str], None] | None = None,
) -> Iterator[Convoy]:
    """Start service and car, the car waiting for the service; stop them in reverse.

    Args:
        scenario: name or folder.
        seed: of the ride.
        speed: simulated seconds per second; 0 is as fast as possible.
        keeping: where and how long the service keeps what is said; None: not at all.
        warn: gets the service's warnings, on a thread.

    Raises:
        ChildFailed: one does not come up.
    """
    ride = ["--scenario", scenario, "--seed", str(seed), "--speed", repr(speed)]
    with ExitStack() as stack:
        yield _start(stack, ride, _kept(keeping), warn)


def first_scene(behind: Convoy, client: Client) -> SceneReport:
    """Wait for the car to be on the road.

    Raises:
        ChildFailed: it does not come up.
    """
    scene = client.wait_for(lambda _: True, behind.check, START_PATIENCE)
    if scene is None:
        raise ChildFailed("the car does not start")
    return scene


def _kept(keeping: Keeping | None) -> list[str]:
    if keeping is None:
        return ["--keep-days", "0"]
    return ["--keep-days", str(keeping.days), "--store", str(keeping.path.absolute())]


def _start(
    stack: ExitStack, ride: list[str], kept: list[str], warn: Callable[[str], None] | None
) -> Convoy:
    """Both processes and a connection to them, on a port that another process may snatch."""
    for attempt in range(1, ATTEMPTS + 1):
        endpoint = f"tcp/127.0.0.1:{_free_port()}"
        serve = ["serve", "--listen", endpoint, *kept]
        service = stack.enter_context(Steady(partial(Child, "the dialogue service", serve, warn)))
        car = stack.enter_context(Child("the car", ["drive", *ride, "--connect", endpoint]))
        try:
            bus = stack.enter_context(_join(service, endpoint))
        except ChildFailed:
            if attempt == ATTEMPTS:
                raise
            stack.close()
        else:
            service.spare = SPARE
            stack.callback(_let_go, bus, service)
            return Convoy(car, service, bus)
    raise AssertionError("the last attempt returns or raises")


def _let_go(bus: ZenohBus, service: Steady) -> None:
    """Close the connection; to a service that hangs that would take long, so it is killed."""
    closing = threading.Thread(target=bus.close, daemon=True)
    closing.start()
    closing.join(CLOSING)
    if closing.is_alive():
        service.kill()
        closing.join(BACK)


def _join(service: Steady, endpoint: str) -> ZenohBus:
    give_up = time.monotonic() + START_PATIENCE
    while True:
        try:
            return join(Link.to_hub(endpoint), patience=RETRY)
        except HubUnreachable:
            service.check()
            if time.monotonic() > give_up:
                raise ChildFailed("the dialogue service does not come up") from None


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])
