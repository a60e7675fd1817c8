"""Passengers and listeners of drills, on the bus like anybody else."""

import queue
import threading
import time
from collections import defaultdict
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from typing import TypeVar

from tests.drills.processes import DEADLINE, LATE, PATIENCE, until
from xavi_dialogue.bus.errors import MessageError
from xavi_dialogue.bus.interface import Bus, Keys, NoAnswer, Outcome, Refused, call
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.messages import (
    AliveReport,
    AskReply,
    AskRequest,
    EventReport,
    Failure,
    HistoryReply,
    HistoryRequest,
    Message,
    SceneReport,
    TraceReport,
    pack,
    unpack,
)
from xavi_dialogue.bus.zenoh_bus import join
from xavi_dialogue.chat.client import new_request

M = TypeVar("M", bound=Message)
RECENT = 50  # scenes among which the latest is


@contextmanager
def on_bus(endpoint: str, patience: float = PATIENCE) -> Iterator[Bus]:
    """A client of the hub at an endpoint."""
    with join(Link.to_hub(endpoint), patience) as bus:
        yield bus


@dataclass(frozen=True)
class Answer:
    """What came of a question."""

    reply: AskReply | None  # None: it was refused, or nothing came
    reason: str | None  # of a reply or refusal; the name of an error where nothing came
    came: float  # [s] on the monotonic clock
    taken: float  # [s]

    @property
    def text(self) -> str:
        return "" if self.reply is None else self.reply.text

    @property
    def kind(self) -> str:
        return "nothing" if self.reply is None else self.reply.kind

    @property
    def told(self) -> tuple[str, str | None, str | None]:
        """What the passenger learns, and what it rests on."""
        return self.text, self.reason, None if self.reply is None else self.reply.trace_id


@dataclass(frozen=True)
class Passenger:
    """Somebody who asks."""

    bus: Bus
    session: str
    vehicle: str = "car"
    token: str | None = None

    def begin(
        self, text: str, at: float | None = None, deadline: float = DEADLINE
    ) -> "queue.SimpleQueue[Answer]":
        """Ask; all that comes of it goes into the queue."""
        came: queue.SimpleQueue[Answer] = queue.SimpleQueue()
        asked = AskRequest(
            request=new_request(),
            session=self.session,
            text=text,
            at=at,
            deadline_ms=deadline * 1000.0,
            token=self.token,
        )
        began = time.monotonic()

        def settle(outcome: Outcome) -> None:
            now = time.monotonic()
            came.put(Answer(*_read(outcome), now, now - began))

        self.bus.request(Keys(self.vehicle).of("@rpc/ask"), pack(asked), LATE, settle)
        return came

    def ask(self, text: str, at: float | None = None, deadline: float = DEADLINE) -> Answer:
        """Ask and wait."""
        return self.begin(text, at, deadline).get(timeout=PATIENCE)

    def insist(self, text: str, at: float | None = None) -> Answer:
        """Ask, and ask again for as long as the service says that it is busy."""
        give_up = time.monotonic() + PATIENCE
        while (answer := self.ask(text, at)).reason == "busy" and time.monotonic() < give_up:
            time.sleep(1.0)
        return answer

    def history(self) -> tuple[str, ...]:
        """The questions of the session."""
        wanted = pack(HistoryRequest(session=self.session, token=self.token))
        said = call(self.bus, Keys(self.vehicle).of("@rpc/history"), wanted, LATE)
        return tuple(turn.text for turn in unpack(said, HistoryReply).turns)


def _read(outcome: Outcome) -> tuple[AskReply | None, str | None]:
    if isinstance(outcome, Refused):
        return None, unpack(outcome.payload, Failure).reason
    if isinstance(outcome, NoAnswer):
        return None, type(outcome).__name__
    reply = unpack(outcome, AskReply)
    return reply, reply.reason


class Listener:
    """Hears a car, and who comes and goes."""

    def __init__(self, bus: Bus, vehicle: str = "car") -> None:
        self._bus, self._keys = bus, Keys(vehicle)
        self.scenes: list[SceneReport] = []
        self.traces: list[TraceReport] = []
        self.events: list[EventReport] = []
        self.alive: set[str] = set()
        self._lock = threading.Lock()
        bus.watch("xavi/v1/*/alive/*", self._see)
        bus.subscribe(self._keys.of("scene"), self._into(SceneReport, self.scenes))
        bus.subscribe(self._keys.of("trace"), self._into(TraceReport, self.traces), kept=True)
        bus.subscribe(self._keys.of("event"), self._into(EventReport, self.events), kept=True)

    @property
    def latest(self) -> SceneReport | None:
        """The latest scene of the latest ride, whatever overtook it."""
        heard = self.scenes[-RECENT:]
        same = [scene for scene in heard if scene.ride == heard[-1].ride]
        return max(same, key=lambda scene: scene.seq, default=None)

    @property
    def now(self) -> float:
        """The moment [s] of the latest scene."""
        return -1.0 if self.latest is None else self.latest.sim_time

    @property
    def state(self) -> str:
        return "" if self.latest is None else self.latest.state

    def halted(self, at: float) -> bool:
        """Whether the ride halts at a moment [s], or ends before, and all of it has been heard."""
        return until(lambda: self._halted(at) and self.whole())

    def whole(self) -> bool:
        """Whether all that was reported of the ride has been heard, in order, each once."""
        scene = self.latest
        return scene is not None and all(
            numbers(heard, scene.ride) == list(range(count))
            for heard, count in ((self.traces, scene.traces), (self.events, scene.events))
        )

    def fares(self, component: str = "car") -> dict[str, float]:
        """The counters of a component."""
        told = call(self._bus, self._keys.of(f"alive/{component}"), b"", LATE)
        return defaultdict(float, unpack(told, AliveReport).counters)

    def _halted(self, at: float) -> bool:
        return self.state == "ended" or (self.state == "paused" and self.now >= at)

    def _see(self, key: str, alive: bool) -> None:
        (self.alive.add if alive else self.alive.discard)(key)

    def _into(self, kind: type[M], heard: list[M]) -> Callable[[str, bytes], None]:
        def hear(_: str, payload: bytes) -> None:
            with suppress(MessageError), self._lock:  # there are those who send nonsense
                heard.append(unpack(payload, kind))

        return hear


def numbers(heard: list[TraceReport] | list[EventReport], ride: str) -> list[int]:
    return [report.seq for report in heard if report.ride == ride]
