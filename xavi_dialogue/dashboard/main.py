"""`xavi dashboard`: a car and its conversation in a web page; a client of the bus like any other.

The page is there at once. What it shows is joined behind it: a bus of others, or a car and a
service of one's own, which set off when somebody looks.
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

from xavi_dialogue.bus.interface import Bus, BusError, HubUnreachable, Keys
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.zenoh_bus import join
from xavi_dialogue.chat.client import Client
from xavi_dialogue.chat.interactive import warner
from xavi_dialogue.chat.local_backend import Company, Convoy, first_scene
from xavi_dialogue.chat.main import Ride, behind_of
from xavi_dialogue.dashboard.controller import Board
from xavi_dialogue.dashboard.web.address import Listen
from xavi_dialogue.dashboard.web.server import Server
from xavi_dialogue.process import child_commands
from xavi_dialogue.process.subprocesses import ChildFailed
from xavi_dialogue.security.client_token import Passenger
from xavi_dialogue.terminal.slash_commands import CommandError

GLANCE = 0.5  # [s] between looks at whether there is a hub, or all is over
CLOSING = 15.0  # [s] that ending car and service may take, which are killed where they do not end

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
SCREENS = ("DISPLAY", "WAYLAND_DISPLAY")  # variables that tell of one

Note: TypeAlias = Callable[[str], None]


@dataclass(frozen=True)
class Task:
    """What to show, and where."""

    listen: Listen
    vehicle: str
    passenger: Passenger
    source: Link | Ride  # the bus of others; or what to drive, or to play, oneself
    speed: float = 1.0  # of a ride of one's own
    opens: bool = True  # a browser, where there is one


class Background:
    """What runs behind the page, on a thread: joins the bus, and sees to it until all is over."""

    def __init__(
        self, task: Task, note: Note, joined: Callable[[Bus], None], failed: Callable[[], None]
    ) -> None:
        """Begin.

        Args:
            task: what to join.
            note: takes notes on what goes on.
            joined: gets the bus, on this thread.
            failed: called on this thread when it cannot go on, for `failure`.
        """
        self._task, self._note, self._joined, self._failed = task, note, joined, failed
        self.over = threading.Event()
        self.seen = threading.Event()  # somebody has looked
        self._behind: Convoy | None = None  # of a ride of one's own, once it is where it is to be
        self.failure: Exception | None = None
        self._thread = threading.Thread(target=self._run, name="background", daemon=True)
        self._thread.start()

    def end(self) -> None:
        """End what was begun."""
        self.over.set()
        self._thread.join(CLOSING)

    def _run(self) -> None:
        try:
            source = self._task.source
            if isinstance(source, Link):
                self._be_with_others(source)
            else:
                self._be_alone(source)
        except (BusError, ChildFailed) as error:
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
        """Whether the car is being started, or driven to where it is to be; any thread may ask."""
        if isinstance(self._task.source, Link):
            return False
        return self._behind is None or self._behind.car.catching_up

    def now(self, client: Client) -> float | None:
        """The moment [s] that a passenger has in mind who is told what `client` is."""
        return client.now() if self._behind is None else self._behind.now(client)

    def _be_alone(self, ride: Ride) -> None:
        company = Company(ride.record, ride.overwrite, warner(self._note), self._note)
        first = self._task.speed if ride.resume is None else 0.0
        with behind_of(ride, first, company) as behind:
            session = ride.passenger.session
            talk = f"xavi chat --connect {behind.endpoint} --session {session}"
            self._note(f"to talk at a terminal as well: {talk}")
            client = Client(behind.bus, Keys(), session)
            self._joined(behind.bus)
            first_scene(behind, client)
            if ride.resume is not None:
                with suppress(CommandError):  # there is no car any more, which has been told
                    behind.drive(client, child_commands.Until(ride.resume), halt=True)
                    behind.order(child_commands.Speed(self._task.speed))
            self._behind = behind
            self._set_off(behind)
            while not self.over.wait(GLANCE):
                behind.check()
            behind.over.set()

    def _set_off(self, behind: Convoy) -> None:
        """Let the ride begin, once there is somebody to see it."""
        while not self.over.is_set():
            if self.seen.wait(GLANCE):
                behind.set_off()
                return
            behind.check()


def run(task: Task, note: Note) -> None:
    """Show a car until told to stop.

    Args:
        task: what to show, and where.
        note: takes notes on what goes on.

    Raises:
        ListenError: it cannot be listened there.
        BadLink: the link's configuration cannot be used.
        ChildFailed: the car or the service does not come up, or ended too often.
    """
    recording = isinstance(task.source, Ride) and bool(task.source.played)
    board = Board(Keys(task.vehicle), task.passenger, recording=recording)
    server = Server(board, task.listen)
    try:
        board.attach(server)
        asyncio.run(_run(task, note, board, server))
    finally:
        server.close()


async def _run(task: Task, note: Note, board: Board, server: Server) -> None:
    loop, stopped = asyncio.get_running_loop(), asyncio.Event()
    joined, failed = partial(server.soon, board.join), partial(server.soon, stopped.set)
    background = Background(task, note, joined, failed)

    def stop() -> None:
        background.over.set()  # all ends at the same time
        stopped.set()

    for number in SIGNALS:
        loop.add_signal_handler(number, stop)
    board.first_seen = background.seen.set
    board.coming, board.moment = background.coming, background.now
    note(f"dashboard at {server.link}")
    if task.opens:
        _open(server.link)
    watching = loop.create_task(board.watch())
    try:
        await server.serve(stopped)
    finally:
        watching.cancel()
        background.end()
    if background.failure is not None:
        raise background.failure


def _open(link: str) -> None:
    """Open the page, where there is a screen to show it on and somebody before it."""
    if sys.stderr.isatty() and any(os.environ.get(name) for name in SCREENS):
        threading.Thread(target=webbrowser.open, args=(link,), daemon=True).start()
