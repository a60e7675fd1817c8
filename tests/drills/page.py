"""The page of a dashboard as a drill sees it: what its browser is told, and what it asks."""

import json
import threading
from contextlib import ExitStack, suppress
from typing import Any
from urllib.request import urlopen

from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect
from websockets.typing import Origin

from tests.drills.processes import Crew, Process, until
from xavi_dialogue.chat.client import new_request

SAYS = "xavi: dashboard at "
NOTE = "xavi: "  # how every line on standard error begins
HERE = {"hub": "there", "car": "there", "service": "there"}


def show(crew: Crew, *arguments: str) -> Process:
    """A dashboard that is ready for browsers."""
    process = crew.xavi("dashboard", "--listen", "127.0.0.1:0", "--no-open", *arguments)
    assert process.says(SAYS), process.said
    return process


def address_of(dashboard: Process) -> str:
    [line] = [line for line in dashboard.said.splitlines() if line.startswith(SAYS)]
    return line.removeprefix(SAYS)


def healthy(dashboard: Process) -> bool:
    with urlopen(f"{address_of(dashboard)}healthz") as response:
        return bool(json.load(response)["ok"])


class Page:
    """One browser that looks on, and never connects anew."""

    def __init__(self, dashboard: Process) -> None:
        origin = address_of(dashboard).rstrip("/")
        place = origin.replace("http:", "ws:")
        self._left = ExitStack()
        self._socket = self._left.enter_context(
            connect(f"{place}/ws", origin=Origin(origin), max_size=None, proxy=None)
        )
        self.closed: int | None = None  # the code with which it was
        self.status: dict[str, str] = {}
        self.lost: set[str] = set()  # what it was told to be gone at any time
        self.rides: list[str] = []
        self.now = -1.0  # [s]
        self.decisions: set[str] = set()
        self.turns: dict[int, dict[str, Any]] = {}
        self.resets = 0
        self.answers: dict[str, dict[str, Any]] = {}
        threading.Thread(target=self._listen, daemon=True).start()

    def sees(self, **presence: str) -> bool:
        """Whether it is told in time who is there."""
        wanted = {**HERE, **presence}
        return until(lambda: {name: self.status.get(name) for name in wanted} == wanted)

    def ask(self, text: str) -> dict[str, Any]:
        """The reply to a question, and as `n` the number of its turn."""
        request = new_request()
        self._say({"type": "ask", "request": request, "text": text})
        assert until(lambda: request in self.answers), self.status
        answer = self.answers[request]
        if answer["n"] is None:
            return {**answer["reply"], "n": None}
        turn = self.turns[answer["n"]]
        assert turn["text"] == text
        return {**turn["reply"], "n": turn["n"]}

    def _say(self, message: dict[str, Any]) -> None:
        self._socket.send(json.dumps(message))

    def _listen(self) -> None:
        with self._left, suppress(ConnectionClosed):
            for text in self._socket:
                self._hear(json.loads(text))
        self.closed = self._socket.protocol.close_code

    def _hear(self, message: dict[str, Any]) -> None:
        match message["type"]:
            case "status":
                self.status = message
                self.lost |= {name for name in HERE if message[name] == "gone"}
            case "ride":
                self.rides += [message["ride"]] if message["ride"] not in self.rides else []
            case "scene":
                self.now = message["t"]
                with suppress(ConnectionClosed):
                    self._say({"type": "seen", "seq": message["seq"]})
            case "decisions":
                self.decisions |= {one["id"] for one in message["decisions"]}
            case "turns":
                self.resets += message["reset"]
                if message["reset"]:
                    self.turns.clear()
                self.turns.update({turn["n"]: turn for turn in message["turns"]})
            case "answered":
                self.answers[message["request"]] = message
