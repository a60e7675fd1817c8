"""The web application: page, documents and WebSocket. See `interfaces`."""

import asyncio
import logging
import re
import time
from collections.abc import Awaitable, Callable
from contextlib import suppress
from typing import TypeAlias

try:
    from starlette.applications import Starlette
    from starlette.exceptions import HTTPException
    from starlette.requests import Request
    from starlette.responses import Response
    from starlette.routing import Route, WebSocketRoute
    from starlette.websockets import WebSocket, WebSocketDisconnect
except ImportError as error:
    from xavi_dialogue.dashboard.web import MISSING

    raise ImportError(MISSING) from error

from xavi_dialogue.dashboard.web import responses
from xavi_dialogue.dashboard.web.auth import RequestGuard
from xavi_dialogue.dashboard.web.client_session import (
    AGAIN_LATER,
    BROKEN,
    GOING_AWAY,
    UNREADABLE,
    ClientSession,
    EncodedMessage,
    Wanted,
    pack,
)
from xavi_dialogue.dashboard.web.interfaces import DashboardSource
from xavi_dialogue.dashboard.web.middleware import ENDING, FAULT, App, GuardMiddleware
from xavi_dialogue.dashboard.web.responses import JSON, Body
from xavi_dialogue.dashboard.web.websocket_messages import Ask, Cancel, Outgoing, Suggest, Trouble

MAX_BROWSERS = 32
SILENCE = 5.0  # [s] without a word after which a browser's place is another's if all are taken
EVIDENCE_WAIT = 30.0  # [s]
CLOSING = 1.0  # [s] to tell a browser why it is disconnected
ASIDE = 64 * 1024  # bytes from which on a body is packed on another thread

FULL = "There are too many browsers already. Close one of them, then try again."
SILENT = "This page said nothing, and another one wanted its place."
TEXT_ALONE = "Only text is read here."
UNKNOWN = "There is nothing here."
NO_DECISION = "The record of this decision is not here any more."
NO_ROADS = "These roads are not known here."
NO_EVIDENCE = "There is no evidence of this answer here."
TOO_LATE = "The evidence of this answer did not come in time. Try again."

_LOG = logging.getLogger(__name__)
_NAME = re.compile(r"[A-Za-z0-9_.:-]{1,128}")
_NUMBER = re.compile(r"[0-9]{1,9}")
_Endpoint: TypeAlias = Callable[[Request], Awaitable[Response]]


class WebApplication:
    """The application, and the browsers that are connected to it."""

    app: App

    def __init__(
        self,
        source: DashboardSource,
        guard: RequestGuard,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Make an application.

        Args:
            source: the contents of the dashboard.
            guard: authenticates requests.
            clock: [s], monotonic.
        """
        self._source, self._clock = source, clock
        self._viewers: dict[int, ClientSession] = {}
        self._came = 0
        self._ending = False
        self.empty = asyncio.Event()  # no browsers are connected
        self.empty.set()
        routes = [
            Route("/", _page),
            Route("/static/{path:path}", _static),
            Route("/api/roads/{name}", self._roads),
            Route("/api/past", self._past),
            Route("/api/decisions/{name}", self._decision),
            Route("/api/turns/{number}/evidence", self._evidence),
            Route("/healthz", _health),
            WebSocketRoute("/ws", self._meet),
        ]
        inner = Starlette(
            routes=routes, exception_handlers={HTTPException: _in_words, Exception: _fault}
        )
        inner.router.redirect_slashes = False
        self.app = GuardMiddleware(inner, guard, clock)

    @property
    def browsers(self) -> int:
        """The number of connected browsers."""
        return len(self._viewers)

    def tell(self, message: Outgoing) -> None:
        """Send a message to all browsers."""
        packed: EncodedMessage | None = None
        for viewer in list(self._viewers.values()):
            packed = packed or pack(message)
            viewer.put(packed)

    def close(self) -> None:
        """Disconnect all browsers, and accept no more."""
        self._ending = True
        for viewer in list(self._viewers.values()):
            viewer.send_away(GOING_AWAY, ENDING)

    # Documents:

    async def _roads(self, request: Request) -> Response:
        name = _named(request, _NAME, NO_ROADS)
        return await _json(request, self._source.roads(name), NO_ROADS)

    async def _past(self, request: Request) -> Response:
        return await _json(request, self._source.past(), UNKNOWN)

    async def _decision(self, request: Request) -> Response:
        name = _named(request, _NAME, NO_DECISION)
        return await _json(request, self._source.decision(name), NO_DECISION)

    async def _evidence(self, request: Request) -> Response:
        number = int(_named(request, _NUMBER, NO_EVIDENCE, "number"))
        try:
            async with asyncio.timeout(EVIDENCE_WAIT):
                found = await self._source.evidence(number)
        except TimeoutError:
            raise HTTPException(504, TOO_LATE) from None
        return await _json(request, found, NO_EVIDENCE)

    # Browsers:

    async def _meet(self, socket: WebSocket) -> None:
        """Serve a browser until it disconnects or must be disconnected."""
        await socket.accept()
        if self._ending or not self._has_room():
            code, why = (GOING_AWAY, ENDING) if self._ending else (AGAIN_LATER, FULL)
            await socket.close(code, why)
            return
        viewer = ClientSession(self._came, self._clock(), lambda: self.browsers)
        self._came += 1
        self._viewers[viewer.number] = viewer
        self.empty.clear()
        try:
            self._look_up()
            viewer.greet(self._source.greet(viewer))
            await self._talk(socket, viewer)
        except Exception:
            _LOG.exception("the dashboard failed to talk with a browser")
            viewer.send_away(BROKEN, FAULT)
            await _dismiss(socket, viewer)
        finally:
            self._viewers.pop(viewer.number, None)
            self._look_up()
            if not self._viewers:
                self.empty.set()
            self._source.left(viewer)

    def _has_room(self) -> bool:
        """Check whether there is a place; take it from who has been silent for longest."""
        if self.browsers < MAX_BROWSERS:
            return True
        now = self._clock()
        silent = max(self._viewers.values(), key=lambda viewer: viewer.silent(now))
        if silent.silent(now) < SILENCE:
            return False
        del self._viewers[silent.number]
        silent.send_away(AGAIN_LATER, SILENT)
        return True

    def _look_up(self) -> None:
        """Update the number of browsers in the status of each."""
        for viewer in self._viewers.values():
            viewer.changed()

    async def _talk(self, socket: WebSocket, viewer: ClientSession) -> None:
        more, leave = asyncio.Event(), asyncio.Event()

        def changed() -> None:
            more.set()
            if viewer.leave is not None:
                leave.set()

        viewer.changed = changed
        changed()
        tasks = [
            asyncio.create_task(part)
            for part in (self._send(socket, viewer, more), self._hear(socket, viewer), leave.wait())
        ]
        try:
            await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for task in tasks:
                task.cancel()
            await asyncio.wait(tasks)
        for task in tasks:
            if not task.cancelled() and not isinstance(task.exception(), WebSocketDisconnect):
                task.result()
        await _dismiss(socket, viewer)

    async def _send(self, socket: WebSocket, viewer: ClientSession, more: asyncio.Event) -> None:
        while True:
            more.clear()
            text = viewer.take(self._clock())
            if text is not None:
                await socket.send_text(text)
                await asyncio.sleep(0)  # many messages must not block the other browsers
            else:
                with suppress(TimeoutError):
                    async with asyncio.timeout(viewer.due(self._clock())):
                        await more.wait()

    async def _hear(self, socket: WebSocket, viewer: ClientSession) -> None:
        while (event := await socket.receive())["type"] == "websocket.receive":
            text = event.get("text")
            if text is None:
                viewer.send_away(UNREADABLE, TEXT_ALONE)
                return
            wanted = viewer.hear(text, self._clock())
            if wanted is not None:
                self._pass_on(viewer, wanted)

    def _pass_on(self, viewer: ClientSession, wanted: Wanted) -> None:
        try:
            match wanted:
                case Ask():
                    self._source.ask(viewer, wanted)
                case Cancel():
                    self._source.cancel(viewer, wanted)
                case Suggest():
                    self._source.suggest(viewer, wanted)
        except Exception:
            _LOG.exception("the board failed")
            request = None if isinstance(wanted, Suggest) else wanted.request
            viewer.tell(Trouble(request=request, text=FAULT))


async def _dismiss(socket: WebSocket, viewer: ClientSession) -> None:
    """Close the connection of a browser that must leave; one that reads nothing gets no reason."""
    if viewer.leave is not None:
        with suppress(TimeoutError, RuntimeError, WebSocketDisconnect):
            async with asyncio.timeout(CLOSING):
                await socket.close(viewer.leave.code, viewer.leave.reason)


async def _page(request: Request) -> Response:
    return _response(request, await asyncio.to_thread(responses.asset, "index.html"), UNKNOWN)


async def _static(request: Request) -> Response:
    path = request.path_params["path"]
    return _response(request, await asyncio.to_thread(responses.asset, path), UNKNOWN)


async def _health(_: Request) -> Response:
    return Response(b'{"ok":true}', media_type=JSON)


def _named(request: Request, form: re.Pattern[str], words: str, part: str = "name") -> str:
    """Return a parameter of the path; raise HTTPException (404) if it is not of the form."""
    name: str = request.path_params[part]
    if not form.fullmatch(name):
        raise HTTPException(404, words)
    return name


async def _json(request: Request, data: bytes | None, words: str) -> Response:
    if data is None:
        raise HTTPException(404, words)
    if len(data) < ASIDE:
        return _response(request, responses.body(data, JSON), words)
    return _response(request, await asyncio.to_thread(responses.body, data, JSON), words)


def _response(request: Request, body: Body | None, words: str) -> Response:
    """Make a response that browsers may cache and revalidate."""
    if body is None:
        raise HTTPException(404, words)
    headers = {"etag": body.etag, "cache-control": "no-cache", "vary": "accept-encoding"}
    known = request.headers.get("if-none-match", "")
    if body.etag.removeprefix("W/") in [one.strip().removeprefix("W/") for one in known.split(",")]:
        return Response(status_code=304, headers=headers)
    headers["content-type"] = body.type
    packs = re.search(r"(^|,)\s*gzip\s*(,|$)", request.headers.get("accept-encoding", ""))
    if body.packed is not None and packs:
        return Response(body.packed, headers=headers | {"content-encoding": "gzip"})
    return Response(body.data, headers=headers)


async def _in_words(_: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)
    words = UNKNOWN if error.detail == "Not Found" else error.detail
    return Response(responses.said(words), error.status_code, media_type=JSON)


async def _fault(_: Request, __: Exception) -> Response:
    return Response(responses.said(FAULT), 500, media_type=JSON)
