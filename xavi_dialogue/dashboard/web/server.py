"""The dashboard's web server: uvicorn with the web application of `routes`. HTTP/1.1, no TLS.

A client that says nothing, reads nothing or does not end its request is cut off in time, so that
it takes up a connection for a while and no more.
"""

import asyncio
import errno
import logging
import socket
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any

try:
    import uvicorn
    from uvicorn.protocols.http.h11_impl import H11Protocol, RequestResponseCycle
    from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
    from websockets.frames import Frame
    from websockets.http11 import Request, Response
    from websockets.server import ServerProtocol
except ImportError as error:
    from xavi_dialogue.dashboard.web import MISSING

    raise ImportError(MISSING) from error

from xavi_dialogue.dashboard.web import responses
from xavi_dialogue.dashboard.web.auth import (
    CACHE,
    SECURITY,
    ListenError,
    ListenOptions,
    RequestGuard,
)
from xavi_dialogue.dashboard.web.interfaces import DashboardSource
from xavi_dialogue.dashboard.web.rate_limit import Bucket, Rate
from xavi_dialogue.dashboard.web.routes import WebApplication
from xavi_dialogue.dashboard.web.websocket_messages import MAX_INCOMING, Outgoing

__all__ = ["ListenError", "ListenOptions", "Server"]

MAX_CONNECTIONS = 256  # a browser has up to seven
CROWD = 4  # times as many, that there may be for a moment
GRACE = 1.0  # [s] that each client has for its request, however many there are
MAX_HEAD = 16 * 1024  # bytes of a request's first line and headers
PATIENCE = 15.0  # [s] to receive a whole request
LAST = 60.0  # [s] to send a response after everything else was sent
PARTING = 5.0  # [s] for a browser to confirm the closing of a WebSocket
PING = 15.0  # [s] between pings, and for a reply to one
FRAMES = Rate(100.0, 400)  # of fragments of messages, and pings
ENDING = 1.0  # [s] for browsers to leave, and then for requests to end
STATUS = {400: "Bad Request", 503: "Service Unavailable"}

_LOG = logging.getLogger(__name__)


class Server:
    """A server of a dashboard for browsers."""

    def __init__(self, source: DashboardSource, listen: ListenOptions) -> None:
        """Bind the address; browsers that connect wait until `serve`.

        Args:
            source: the contents of the dashboard.
            listen: the address.

        Raises:
            ListenError: the address cannot be used.
        """
        self._socket = bind(listen)
        self.port: int = self._socket.getsockname()[1]
        self.address = listen.address(self.port)  # the address to open in a browser
        #: The same with the token, if there is one: it permits access.
        self.link = self.address + (f"?token={listen.token}" if listen.token else "")
        self._application = WebApplication(source, RequestGuard(listen, self.port))
        self._lock = threading.Lock()
        self._loop: asyncio.AbstractEventLoop | None = None
        self._early: deque[tuple[Callable[..., None], tuple[Any, ...]]] = deque()
        self._over = False

    @property
    def browsers(self) -> int:
        """The number of connected browsers."""
        return self._application.browsers

    def tell(self, message: Outgoing) -> None:
        """Send a message to all browsers; on the event loop only."""
        self._application.tell(message)

    def soon(self, function: Callable[..., None], *arguments: Any) -> None:
        """Schedule a call on the event loop; see `interfaces.Browsers`. Thread-safe."""
        with self._lock:
            if self._loop is not None:
                self._loop.call_soon_threadsafe(_call, function, arguments)
            elif not self._over:
                self._early.append((function, arguments))

    async def serve(self, stopped: asyncio.Event) -> None:
        """Serve until asked to stop, or cancelled; then end within 3 s. Call it once only."""
        server = _Uvicorn(self._config())
        with self._lock:
            self._loop = asyncio.get_running_loop()
            while self._early:
                self._loop.call_soon(_call, *self._early.popleft())
        serving = asyncio.create_task(server.serve(sockets=[self._socket]))
        stopping = asyncio.create_task(stopped.wait())
        try:
            await asyncio.wait({serving, stopping}, return_when=asyncio.FIRST_COMPLETED)
        finally:
            stopping.cancel()
            self._application.close()
            with suppress(TimeoutError):
                async with asyncio.timeout(ENDING):
                    await self._application.empty.wait()
            with self._lock:
                self._loop, self._over = None, True
            server.should_exit = True
            await serving
            for connection in list(server.server_state.connections):
                connection.transport.abort()  # of clients that read nothing
            await asyncio.sleep(0)  # the loop closes them in its next round

    def close(self) -> None:
        """Release the address; has no effect after `serve`."""
        self._socket.close()

    def _config(self) -> uvicorn.Config:
        return uvicorn.Config(
            self._application.app,
            http=_Http,
            ws=_WebSocket,
            loop="asyncio",
            lifespan="off",
            log_config=None,
            log_level="critical",  # other levels would log the errors of strangers
            access_log=False,
            server_header=False,
            proxy_headers=False,  # forwarded addresses cannot be trusted
            ws_max_size=MAX_INCOMING,
            ws_ping_interval=PING,
            ws_ping_timeout=PING,
            ws_per_message_deflate=False,  # would be repeated for each browser
            h11_max_incomplete_event_size=MAX_HEAD,
            timeout_graceful_shutdown=1,
        )


def bind(listen: ListenOptions) -> socket.socket:
    """Return a socket that listens.

    Raises:
        ListenError: the address cannot be used.
    """
    place = listen.place
    try:
        found = socket.getaddrinfo(listen.host, listen.port, type=socket.SOCK_STREAM)
    except OSError:
        raise ListenError(f"{listen.host} is not known; choose another with --listen") from None
    family, *_, address = min(found, key=lambda one: one[0] != socket.AF_INET)
    ours = socket.socket(family, socket.SOCK_STREAM)
    try:
        ours.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        ours.bind(address)
        ours.listen(128)
    except OSError as error:
        ours.close()
        reasons = {
            errno.EADDRINUSE: "is in use",
            errno.EACCES: "is not for everybody (ports from 1024 on are)",
            errno.EADDRNOTAVAIL: "is not an address of this machine",
        }
        reason = reasons.get(error.errno or 0, "cannot be listened at")
        other = "port 0 is any that is free"
        raise ListenError(f"{place} {reason}; choose another with --listen: {other}") from error
    ours.setblocking(False)
    return ours


def _call(function: Callable[..., None], arguments: tuple[Any, ...]) -> None:
    try:
        function(*arguments)
    except Exception:
        _LOG.exception("the dashboard failed to take something in")


class _Uvicorn(uvicorn.Server):
    @contextmanager
    def capture_signals(self) -> Iterator[None]:
        """Leave signals to the process, which has more to stop than this server."""
        yield


class _Http(H11Protocol):
    """A protocol that disconnects slow clients, and adds headers to all responses."""

    _late: asyncio.TimerHandle | None = None
    _cut: asyncio.TimerHandle | None = None
    _last: RequestResponseCycle | None = None  # request that was answered

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        super().connection_made(transport)
        if len(self.connections) > MAX_CONNECTIONS and not self._make_room():
            self._send_off(503, "There are too many connections already. Try again later.")
        else:
            self._wait()

    def on_response_complete(self) -> None:
        super().on_response_complete()
        self._wait()

    def handle_websocket_upgrade(self, event: Any) -> None:
        self._wait_no_longer()
        super().handle_websocket_upgrade(event)

    def connection_lost(self, exc: Exception | None) -> None:
        self._wait_no_longer()
        if self._cut is not None:
            self._cut.cancel()
        super().connection_lost(exc)

    def send_400_response(self, msg: str) -> None:
        del msg
        self._send_off(400, "This request cannot be understood.")

    def _wait(self) -> None:
        """Wait for the next request for a limited time."""
        self._wait_no_longer()
        self._last = self.cycle
        self._late = self.loop.call_later(PATIENCE, self._give_up)

    def _wait_no_longer(self) -> None:
        if self._late is not None:
            self._late.cancel()
            self._late = None

    def _waits(self) -> bool:
        """Check whether the client has not ended its next request."""
        return self._late is not None and self.cycle is self._last

    def _make_room(self) -> bool:
        """Cut off who has been waited for longest; return whether there is room.

        So those who say nothing cannot keep out those who do.
        """
        fits = len(self.connections) <= CROWD * MAX_CONNECTIONS
        others = (one for one in self.connections if isinstance(one, _Http) and one is not self)
        waiting = [(one._late.when(), one) for one in others if one._late and one._waits()]
        if not waiting:
            return False
        due, slowest = min(waiting, key=lambda pair: pair[0])
        if due > self.loop.time() + PATIENCE - GRACE:
            return fits
        slowest._wait_no_longer()
        slowest.transport.abort()
        return True

    def _give_up(self) -> None:
        if self._waits():
            self._part()

    def _part(self) -> None:
        self.transport.close()
        if self._cut is None:
            self._cut = self.loop.call_later(LAST, self.transport.abort)

    def _send_off(self, status: int, words: str) -> None:
        data = responses.said(words)
        headers = {"content-type": responses.JSON, CACHE[0]: CACHE[1], "connection": "close"}
        headers |= {"content-length": str(len(data))} | SECURITY
        lines = [f"HTTP/1.1 {status} {STATUS[status]}", *(f"{k}: {v}" for k, v in headers.items())]
        self.transport.write("\r\n".join([*lines, "", ""]).encode() + data)
        self._part()


class _Handshake(ServerProtocol):
    def accept(self, request: Request) -> Response:
        """Add the headers to the response of a refused handshake."""
        response = super().accept(request)
        if response.status_code != 101:
            response.headers.update({**SECURITY, CACHE[0]: CACHE[1]})
        return response


class _WebSocket(WebSocketsSansIOProtocol):
    """A protocol that disconnects clients that do not read, or send too many fragments or pings."""

    _cut: asyncio.TimerHandle | None = None

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__(*arguments, **named)
        self.close_timeout = PARTING
        self.conn = _Handshake(max_size=self.config.ws_max_size, logger=self.logger)
        self._frames = Bucket(FRAMES, time.monotonic())

    async def run_asgi(self) -> None:
        await super().run_asgi()
        # Unread input would keep an otherwise closed connection open.
        if self in self.connections:
            self._cut = self.loop.call_later(PARTING, self.transport.abort)

    def connection_lost(self, exc: Exception | None) -> None:
        if self._cut is not None:
            self._cut.cancel()
        super().connection_lost(exc)

    def keepalive_timeout(self) -> None:
        super().keepalive_timeout()
        self.transport.abort()

    def handle_ping(self) -> None:
        if self._bears() and self.writable.is_set():
            super().handle_ping()
        else:
            self.conn.data_to_send()  # drops the answers, which would accumulate unread

    def handle_pong(self, event: Frame) -> None:
        if self._bears():
            super().handle_pong(event)

    def handle_cont(self, event: Frame) -> None:
        if self._bears():
            super().handle_cont(event)

    def _bears(self) -> bool:
        """Count a fragment or ping; return whether it is within the limit."""
        if self._frames.take(time.monotonic()):
            return True
        self.transport.abort()
        return False
