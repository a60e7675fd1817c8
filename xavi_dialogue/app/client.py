"""A passenger's side of the bus: the latest scene, and questions to the service."""

import queue
import secrets
import threading
import time
from collections.abc import Callable

from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.language.context import Style
from xavi_dialogue.transports.bus import Bus, Keys, Outcome, Refused
from xavi_dialogue.transports.messages import (
    MAX_TEXT,
    AskReply,
    AskRequest,
    CancelRequest,
    EventReport,
    Failure,
    MessageError,
    SceneReport,
    pack,
    unpack,
)
from xavi_dialogue.transports.text import clean

DEADLINE = 10.0  # [s] for an answer
GRACE = 0.5  # [s] that a reply may take on its way
POLL = 0.1  # [s] between looks at whether waiting still makes sense


class ServiceLost(Exception):
    """The service does not answer."""


class Client:
    """One passenger on the bus."""

    def __init__(
        self,
        bus: Bus,
        keys: Keys,
        session: str,
        on_event: Callable[[EventReport], None] | None = None,
    ) -> None:
        self.scene: SceneReport | None = None  # the latest
        self._bus, self._keys, self._session = bus, keys, session
        self._changed = threading.Condition()
        self._on_event = on_event
        bus.subscribe(keys.of("scene"), self._on_scene)
        if on_event is not None:
            bus.subscribe(keys.of("event"), self._on_report, kept=True)

    def send(
        self,
        text: str,
        done: Callable[[Reply | ServiceLost], None],
        *,
        at: float | None = None,
        style: Style = "passenger",
        request: str | None = None,
    ) -> None:
        """Ask; `done` gets the reply, or why there is none, on a thread of the bus."""
        asked = AskRequest(
            request=request or new_request(),
            session=self._session,
            text=text[:MAX_TEXT],
            style=style,
            deadline_ms=DEADLINE * 1000.0,
            at=at,
        )
        key = self._keys.of("@rpc/ask")
        self._bus.request(key, pack(asked), DEADLINE + GRACE, lambda came: done(_reply(came)))

    def ask(self, text: str, at: float | None = None, style: Style = "passenger") -> Reply:
        """Ask and wait for the reply.

        Raises:
            ServiceLost: there is no reply.
        """
        replies: queue.SimpleQueue[Reply | ServiceLost] = queue.SimpleQueue()
        self.send(text, replies.put, at=at, style=style)
        reply = replies.get()
        if isinstance(reply, ServiceLost):
            raise reply
        return reply

    def cancel(self, request: str) -> None:
        """Tell the service that an answer is no longer wanted."""
        wanted = CancelRequest(request=request, session=self._session)
        self._bus.request(self._keys.of("@rpc/cancel"), pack(wanted), 1.0, lambda _: None)

    def wait_for(
        self, wanted: Callable[[SceneReport], bool], going_on: Callable[[], None], patience: float
    ) -> SceneReport | None:
        """Wait for a scene.

        Args:
            wanted: whether this is the one.
            going_on: called now and then; raises where waiting makes no sense any more.
            patience: [s] without any new scene after which None is returned.
        """
        give_up = time.monotonic() + patience
        latest = None
        with self._changed:
            while self.scene is None or not wanted(self.scene):
                if self.scene is not latest:
                    latest, give_up = self.scene, time.monotonic() + patience
                if time.monotonic() > give_up:
                    return None
                self._changed.wait(POLL)
                going_on()
            return self.scene

    def _on_scene(self, _: str, payload: bytes) -> None:
        try:
            report = unpack(payload, SceneReport)
        except MessageError:
            return
        with self._changed:
            self.scene = report
            self._changed.notify_all()

    def _on_report(self, _: str, payload: bytes) -> None:
        try:
            report = unpack(payload, EventReport)
        except MessageError:
            return
        if self._on_event is not None:
            self._on_event(report)


def new_request() -> str:
    """A name for a request."""
    return secrets.token_hex(8)


def _reply(came: Outcome) -> Reply | ServiceLost:
    match came:
        case bytes():
            try:
                return unpack(came, AskReply).reply()
            except MessageError as error:
                return ServiceLost(f"the dialogue service sent nonsense: {error}")
        case Refused(payload=payload):
            try:
                failure = unpack(payload, Failure)
            except MessageError:
                return ServiceLost("the dialogue service refused the question")
            reason = clean(failure.detail) or failure.reason
            return ServiceLost(f"the dialogue service refused the question: {reason}")
        case _:
            return ServiceLost("the dialogue service does not answer")
