"""`xavi dashboard`: a car and its conversation in a web page, as a client of the bus.

The page is available at once. A thread behind it joins the bus of others, or starts a car and a
service, which begin when the first browser connects.
"""

import asyncio
import os
import signal
import sys
import threading
import webbrowser
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import TypeAlias

from xavi_dialogue.bus.interface import Bus, HubUnreachable, Keys, TransportError
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.zenoh_bus import join
from xavi_dialogue.chat.client import Client
from xavi_dialogue.chat.interactive import warner
from xavi_dialogue.chat.local_backend import LocalBackend, LocalOptions, first_scene
from xavi_dialogue.chat.main import ChatOptions, start_backend
from xavi_dialogue.dashboard.controller import Controller
from xavi_dialogue.dashboard.web.address import ListenOptions
from xavi_dialogue.dashboard.web.server import Server
from xavi_dialogue.process import child_commands
from xavi_dialogue.process.subprocesses import ChildFailed
from xavi_dialogue.security.client_token import Passenger
from xavi_dialogue.terminal.slash_commands import CommandError

GLANCE = 0.5  # [s] between checks for a hub, and for the end
CLOSING = 15.0  # [s] for car and service to end, after which they are killed

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
SCREENS = ("DISPLAY", "WAYLAND_DISPLAY")  # environment variables that are set if there is a display

Note: TypeAlias = Callable[[str], None]


@dataclass(frozen=True)
class DashboardOptions:
    """Options of the dashboard."""

    listen: ListenOptions
    vehicle: str
    passenger: Passenger
    source: Link | ChatOptions  # the bus of others; or a ride to drive or play
    speed: float = 1.0  # of a ride that the dashboard starts
    opens: bool = True  # whether to open a browser, if there is one

    @property
    def opens_browser(self) -> bool:
        """Whether to open one: its command line, which all can see, would show a token."""
        return self.opens and self.listen.token is None


class BusThread:
    """A thread behind the page, which joins the bus and checks the connection until the end."""

    def __init__(
        self,
        task: DashboardOptions,
        note: Note,
        joined: Callable[[Bus], None],
        failed: Callable[[], None],
    ) -> None:
        """Begin.

        Args:
            task: what to join.
            note: is called with notes.
            joined: gets the bus, on this thread.
            failed: called on this thread when it cannot go on, for `failure`.
        """
        self._task, self._note, self._joined, self._failed = task, note, joined, failed
        self.over = threading.Event()
        self.seen = threading.Event()  # a browser has connected
        self._backend: LocalBackend | None = (
            None  # of an own ride, once it has reached its starting time
        )
        self.failure: Exception | None = None
        self._thread = threading.Thread(target=self._run, name="background", daemon=True)
        self._thread.start()

    def end(self) -> None:
        """Stop the thread and the processes."""
        self.over.set()
        self._thread.join(CLOSING)

    def _run(self) -> None:
        try:
            source = self._task.source
            if isinstance(source, Link):
                self._be_with_others(source)
            else:
                self._be_alone(source)
        except (TransportError, ChildFailed) as error:
            if not self.over.is_set():  # else nothing more is waited for
                self.failure = error
                self._failed()

    def _be_with_others(self, link: Link) -> None:
        waiting = False
        while not self.over.is_set():
            try:
                with join(link, GLANCE) as bus:
                    if waiting:
                        self._note("the hub is there")
                    self._joined(bus)
                    self.over.wait()
            except HubUnreachable as error:
                if not waiting:
                    self._note(f"{error}; waiting for it")
                waiting = True

    def coming(self) -> bool:
        """Check whether the car is starting or driving to its starting time; thread-safe."""
        if isinstance(self._task.source, Link):
            return False
        return self._backend is None or self._backend.car.catching_up

    def now(self, client: Client) -> float | None:
        """Return the default time [s] of a question, by the scenes of this client."""
        return client.now() if self._backend is None else self._backend.now(client)

    def _be_alone(self, ride: ChatOptions) -> None:
        options = LocalOptions(
            ride.record, ride.overwrite, warner(self._note), self._note, self.over
        )
        first = self._task.speed if ride.resume is None else 0.0
        with start_backend(ride, first, options) as backend:
            session = ride.passenger.session
            talk = f"xavi chat --connect {backend.endpoint} --session {session}"
            self._note(f"to talk at a terminal as well: {talk}")
            client = Client(backend.bus, Keys(), session)
            self._joined(backend.bus)
            first_scene(backend, client)
            if ride.resume is not None:
                with suppress(CommandError):  # the car has ended, which was reported
                    backend.drive(client, child_commands.Until(ride.resume), halt=True)
                    backend.order(child_commands.Speed(self._task.speed))
            self._backend = backend
            self._set_off(backend)
            while not self.over.wait(GLANCE):
                backend.check()

    def _set_off(self, backend: LocalBackend) -> None:
        """Let the ride begin once a browser has connected."""
        while not self.over.is_set():
            if self.seen.wait(GLANCE):
                backend.set_off()
                return
            backend.check()


def run(task: DashboardOptions, note: Note) -> None:
    """Show a car until asked to stop.

    Args:
        task: what to show, and where.
        note: is called with notes.

    Raises:
        ListenError: the address cannot be used.
        BadLink: the link's configuration cannot be used.
        ChildFailed: the car or the service did not start, or ended too often.
    """
    recording = isinstance(task.source, ChatOptions) and bool(task.source.played)
    controller = Controller(Keys(task.vehicle), task.passenger, recording=recording)
    server = Server(controller, task.listen)
    try:
        controller.attach(server)
        asyncio.run(_run(task, note, controller, server))
    finally:
        server.close()


async def _run(task: DashboardOptions, note: Note, controller: Controller, server: Server) -> None:
    loop, stopped = asyncio.get_running_loop(), asyncio.Event()
    joined, failed = partial(server.soon, controller.join), partial(server.soon, stopped.set)
    background = BusThread(task, note, joined, failed)

    def stop() -> None:
        background.over.set()  # so that everything ends at the same time
        stopped.set()

    for number in SIGNALS:
        loop.add_signal_handler(number, stop)
    controller.first_seen = background.seen.set
    controller.coming, controller.moment = background.coming, background.now
    note(f"dashboard at {server.link}")
    if task.opens_browser:
        _open(server.link)
    watching = loop.create_task(controller.watch())
    try:
        await server.serve(stopped)
    finally:
        watching.cancel()
        background.end()
    if background.failure is not None:
        raise background.failure


def _open(link: str) -> None:
    """Open the page if there is a display and a user."""
    if sys.stderr.isatty() and any(os.environ.get(name) for name in SCREENS):
        threading.Thread(target=webbrowser.open, args=(link,), daemon=True).start()
