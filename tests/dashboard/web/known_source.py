"""A board whose words are known, and a real server around it."""

import asyncio
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from xavi_dialogue.dashboard.web.client_session import ClientSession
from xavi_dialogue.dashboard.web.server import ListenOptions, Server
from xavi_dialogue.dashboard.web.websocket_messages import (
    AnsweredHere,
    Ask,
    Cancel,
    Outgoing,
    SceneShown,
    Status,
    Suggest,
    Suggestions,
    Welcome,
)

WELCOME = Welcome(version="1", vehicle="car", session="talk")
STATUS = Status(hub="there", car="awaited", service="gone", dropped=0, browsers=0)
PATIENCE = 10.0  # [s]


def scene(seq: int, vehicles: int = 1) -> SceneShown:
    seen = (0, 1.0, 2.0, 0.5, 10.0, 4.5, 1.8, "car", None, ())
    return SceneShown(
        seq=seq,
        t=float(seq),
        wall=0.0,
        state="driving",
        speed=1.0,
        plan=("continue",),
        vehicles=(seen,) * vehicles,
    )


@dataclass
class Known:
    """Answers everything, and remembers what it was called for."""

    calls: list[tuple[str, Any]] = field(default_factory=list)
    past_said: bytes = b'{"ride":"r","scenes":[]}'
    fails: str = ""  # the method that fails

    def greet(self, viewer: ClientSession) -> tuple[Outgoing, ...]:
        self._call("greet", viewer.number)
        return (WELCOME, STATUS)

    def ask(self, viewer: ClientSession, message: Ask) -> None:
        self._call("ask", message)
        viewer.tell(AnsweredHere(request=message.request, n=0, reply=None))

    def cancel(self, viewer: ClientSession, message: Cancel) -> None:
        self._call("cancel", message)

    def suggest(self, viewer: ClientSession, message: Suggest) -> None:
        self._call("suggest", message)
        viewer.tell(Suggestions(t=message.at, questions=("Why?",)))

    def left(self, viewer: ClientSession) -> None:
        self._call("left", viewer.number)

    def roads(self, name: str) -> bytes | None:
        self._call("roads", name)
        return b'{"hash":"abc"}' if name == "abc" else None

    def past(self) -> bytes:
        self._call("past", None)
        return self.past_said

    def decision(self, name: str) -> bytes | None:
        self._call("decision", name)
        return b'{"id":"d1"}' if name == "d1" else None

    async def evidence(self, number: int) -> bytes | None:
        self._call("evidence", number)
        await asyncio.sleep(0.0)
        return b'{"n":3}' if number == 3 else None

    def of(self, kind: str) -> list[Any]:
        return [given for name, given in self.calls if name == kind]

    def _call(self, kind: str, given: Any) -> None:
        self.calls.append((kind, given))
        if kind == self.fails:
            raise RuntimeError("secret words")


class Running:
    """A server that serves on a thread."""

    def __init__(self, source: Known, listen: ListenOptions) -> None:
        self.source, self.server = source, Server(source, listen)
        self._stopped = asyncio.Event()
        self._thread = threading.Thread(target=lambda: asyncio.run(self._serve()))
        self._thread.start()

    @property
    def origin(self) -> str:
        return self.server.address.rstrip("/")

    @property
    def socket(self) -> str:
        return self.origin.replace("http", "ws") + "/ws"

    def do(self, function: Any, *arguments: Any) -> Any:
        """Call something on the event loop, and wait for what it returns."""
        done, found = threading.Event(), []

        def call() -> None:
            found.append(function(*arguments))
            done.set()

        self.server.soon(call)
        assert done.wait(PATIENCE)
        return found[0]

    def stop(self) -> None:
        self.server.soon(self._stopped.set)

    def end(self) -> None:
        self._thread.join(PATIENCE)
        assert not self._thread.is_alive()

    def end_of_browsers(self, left: int = 0) -> None:
        """Wait until no more than so many browsers are there."""
        end = time.monotonic() + PATIENCE
        while self.do(lambda: self.server.browsers) > left:
            assert time.monotonic() < end, "browsers that should be gone are there"

    async def _serve(self) -> None:
        await self.server.serve(self._stopped)


@contextmanager
def running(
    source: Known | None = None, listen: str = "127.0.0.1:0", **said: Any
) -> Iterator[Running]:
    server = Running(source or Known(), ListenOptions.read(listen, **said))
    try:
        yield server
    finally:
        server.stop()
        server.end()
