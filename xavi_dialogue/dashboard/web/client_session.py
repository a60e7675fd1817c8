"""One browser: its queue of messages and its limits. No sockets; time is an argument.

Of scenes only the newest waits, and none is sent while too many are not acknowledged: a slow
browser gets fewer of them, which are counted. All else is sent in order, and bounded in bytes.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import msgspec

from xavi_dialogue.dashboard.web.rate_limit import Bucket, Rate
from xavi_dialogue.dashboard.web.websocket_messages import (
    MAX_INCOMING,
    Ask,
    Cancel,
    Here,
    Incoming,
    Outgoing,
    Ride,
    SceneShown,
    SeenScene,
    Status,
    Suggest,
    Trouble,
)

MIB = 1 << 20
MAX_WAITING = 8 * MIB  # bytes, besides the first messages
MAX_IN_FLIGHT = 3  # scenes that may be sent without acknowledgement
STATUS_EVERY = 1.0  # [s] least time between two status messages about dropped scenes
QUESTIONS = Rate(2.0, 5)
OTHERS = Rate(50.0, 100)
MESSAGES = Rate(100.0, 200)  # of all kinds, including those that are not accepted
MAX_REASON = 123  # bytes (RFC 6455, 5.5.1)

GOING_AWAY = 1001  # the dashboard ends
UNREADABLE = 1003  # a binary message
BROKEN = 1011  # an internal error
AGAIN_LATER = 1013  # too slow a reader, or too many browsers
TOO_LARGE = 1009
NO_TOKEN = 4401
TOO_OFTEN = 4429

TOO_FAST = "You ask faster than the car can listen. Wait a second, then ask again."
NOT_READ = "The dashboard could not read that message. Reload the page, in case it is an old one."
TOO_MANY = "Too much was said at once, so that this was not heard."

Wanted: TypeAlias = Ask | Cancel | Suggest

_ENCODER = msgspec.json.Encoder()
_DECODER = msgspec.json.Decoder(Incoming)


@dataclass(frozen=True, slots=True)
class EncodedMessage:
    """A message encoded once for any number of browsers."""

    message: Outgoing
    text: str  # JSON
    size: int  # bytes


@dataclass(frozen=True, slots=True)
class Disconnect:
    """The reason for closing a connection."""

    code: int  # of the WebSocket
    reason: str  # at most MAX_REASON bytes


def pack(message: Outgoing) -> EncodedMessage:
    """Encode a message as JSON."""
    data = _ENCODER.encode(message)
    return EncodedMessage(message, data.decode(), len(data))


class ClientSession:
    """The session of one browser; its methods must be called on the event loop's thread."""

    def __init__(self, number: int, now: float, browsers: Callable[[], int] = lambda: 1) -> None:
        """Begin the session of a browser that has just connected.

        Args:
            number: of the browser in this process.
            now: [s, monotonic].
            browsers: how many there are, for its status.
        """
        self.number = number
        self.dropped = 0  # scenes for which the browser was too slow
        self.leave: Disconnect | None = None  # if set, the browser is to be disconnected
        self.changed: Callable[[], None] = lambda: None  # called when there may be more to send
        self._browsers = browsers
        self._greeted = False
        self._row: deque[EncodedMessage] = deque()
        self._waiting, self._limit = 0, MAX_WAITING  # bytes
        self._scene: EncodedMessage | None = None
        self._ride: str | None = None
        self._in_flight: deque[int] = deque()  # numbers of scenes, as sent
        self._status: Status | None = None  # as last sent
        self._told = now  # [s] when the status was sent
        self._owing: float | None = now  # [s] since when it owes a word; None: it does not
        self._questions, self._others = Bucket(QUESTIONS, now), Bucket(OTHERS, now)
        self._messages = Bucket(MESSAGES, now)

    @property
    def waiting(self) -> int:
        """Return the number of bytes that wait to be sent."""
        return self._waiting + (0 if self._scene is None else self._scene.size)

    def silent(self, now: float) -> float:
        """Return for how long [s] the browser has answered neither the welcome nor a scene."""
        return 0.0 if self._owing is None else now - self._owing

    def greet(self, messages: tuple[Outgoing, ...]) -> None:
        """Queue the first messages of a new browser, without limit."""
        packed = [pack(message) for message in messages]
        self._greeted = True
        self._limit = MAX_WAITING + sum(one.size for one in packed)
        for one in packed:
            self.put(one)

    def tell(self, message: Outgoing) -> None:
        """Queue a message for this browser only."""
        self.put(pack(message))

    def put(self, packed: EncodedMessage) -> None:
        """Queue a message; disconnect the browser if too much waits already.

        What is sent to all before the greeting is part of the greeting.
        """
        if self.leave is not None or not self._greeted:
            return
        message = packed.message
        if isinstance(message, SceneShown):
            self.dropped += self._scene is not None
            self._scene = packed
        else:
            if isinstance(message, Ride) and message.ride != self._ride:
                self._ride, self._scene = message.ride, None  # drops a scene of the previous ride
            self._row.append(packed)
            self._waiting += packed.size
            if self._waiting > self._limit:
                self.send_away(
                    AGAIN_LATER, "This connection is too slow for what there is to tell."
                )
        self.changed()

    def send_away(self, code: int, reason: str) -> None:
        """Close the connection and drop waiting messages; the first reason counts."""
        if self.leave is None:
            short = reason.encode()[:MAX_REASON].decode(errors="ignore")
            self.leave = Disconnect(code, short)
            self._row.clear()
            self._scene, self._waiting = None, 0
            self.changed()

    def take(self, now: float) -> str | None:
        """Return the next message as JSON; None if there is nothing to send now."""
        if self._row:
            packed = self._row.popleft()
            self._waiting -= packed.size
            if isinstance(packed.message, Status):
                self._status = packed.message
                return self._tell_status(now)
            return packed.text
        if self.due(now) == 0.0:
            return self._tell_status(now)
        if self._scene is not None and len(self._in_flight) < MAX_IN_FLIGHT:
            packed, self._scene = self._scene, None
            assert isinstance(packed.message, SceneShown)
            self._in_flight.append(packed.message.seq)
            self._owing = now if self._owing is None else self._owing
            return packed.text
        return None

    def due(self, now: float) -> float | None:
        """Return in how many seconds the status is due; None: it has not changed."""
        status = self._status
        if status is None or (status.dropped, status.browsers) == (self.dropped, self._browsers()):
            return None
        return max(self._told + STATUS_EVERY - now, 0.0)

    def hear(self, text: str, now: float) -> Wanted | None:
        """Handle a message from the browser.

        Returns:
            The request; None if there is nothing to do, or the browser got an error message.
        """
        if self.leave is not None:
            return None
        if len(text) > MAX_INCOMING:
            self.send_away(TOO_LARGE, "A message was too large.")
            return None
        if not self._messages.take(now):
            self.send_away(TOO_OFTEN, "Too many messages at once.")
            return None
        try:
            message: Ask | Cancel | Here | SeenScene | Suggest = _DECODER.decode(text)
        except (msgspec.MsgspecError, UnicodeError, RecursionError):
            self.tell(Trouble(request=None, text=NOT_READ))
            return None
        allowed = (self._questions if isinstance(message, Ask) else self._others).take(now)
        wanted: Wanted | None = None
        match message:
            case SeenScene(seq=seq):
                if allowed:
                    self._seen(seq)
            case Here():
                pass
            case Ask(request=request) if not allowed:
                self.tell(Trouble(request=request, text=TOO_FAST))
            case Cancel(request=request) if not allowed:
                self.tell(Trouble(request=request, text=TOO_MANY))
            case Suggest() if not allowed:
                self.tell(Trouble(request=None, text=TOO_MANY))
            case _:
                wanted = message
        self._owing = now if self._in_flight else None
        return wanted

    def _seen(self, seq: int) -> None:
        """Handle that a scene was drawn; earlier ones are drawn or dropped."""
        if seq in self._in_flight:
            while self._in_flight.popleft() != seq:
                pass
            self.changed()

    def _tell_status(self, now: float) -> str:
        assert self._status is not None
        told = {"dropped": self.dropped, "browsers": self._browsers()}
        self._status, self._told = msgspec.structs.replace(self._status, **told), now
        return pack(self._status).text
