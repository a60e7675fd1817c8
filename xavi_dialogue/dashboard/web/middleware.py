"""Middleware (ASGI): authentication, rate limits, headers and error pages."""

import asyncio
import logging
import time
from collections.abc import Awaitable, Callable, MutableMapping
from typing import Any, TypeAlias

from xavi_dialogue.dashboard.web import responses
from xavi_dialogue.dashboard.web.auth import (
    METHODS,
    Refused,
    RequestGuard,
    RequestHeaders,
    SetToken,
    secured,
)
from xavi_dialogue.dashboard.web.client_session import NO_TOKEN, TOO_OFTEN
from xavi_dialogue.dashboard.web.rate_limit import Buckets, Rate

Scope: TypeAlias = MutableMapping[str, Any]
Message: TypeAlias = MutableMapping[str, Any]
Receive: TypeAlias = Callable[[], Awaitable[Message]]
Send: TypeAlias = Callable[[Message], Awaitable[None]]
App: TypeAlias = Callable[[Scope, Receive, Send], Awaitable[None]]

# Per address, which many browsers may share: on loopback all of them do.
VISITS = Rate(4.0, 64)  # WebSockets
FETCHES = Rate(100.0, 400)  # of documents
TRIES = Rate(1.0, 20)  # of requests without a valid token, to prevent guessing
TRIED_OFTEN = "That was tried too often. Wait a little."
FETCHED_OFTEN = "Too much is asked for at once. Wait a second, then try again."
VISITED_OFTEN = "Too many connections at once. Wait a little."
ENDING = "The dashboard is being stopped."
FAULT = "Something went wrong in the dashboard. It has been written to its log."

_LOG = logging.getLogger(__name__)


class GuardMiddleware:
    """An ASGI application in front of another one."""

    def __init__(
        self, app: App, guard: RequestGuard, clock: Callable[[], float] = time.monotonic
    ) -> None:
        """Make a gate.

        Args:
            app: the application.
            guard: authenticates requests.
            clock: [s], monotonic.
        """
        self._app, self._guard, self._clock = app, guard, clock
        self._visits, self._fetches = Buckets(VISITS), Buckets(FETCHES)
        self._tries = Buckets(TRIES)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """See ASGI."""
        if scope["type"] not in {"http", "websocket"}:  # a lifespan event, not a request
            await self._app(scope, receive, send)
            return
        started = False

        async def out(message: Message) -> None:
            nonlocal started
            if message["type"].endswith("http.response.start"):
                started = True
                message["headers"] = secured(list(message.get("headers", [])))
            await send(message)

        asked = _asked(scope)
        verdict = self._guard.judge(asked)
        if verdict is None or (isinstance(verdict, Refused) and verdict.status == 401):
            verdict = self._too_often(scope, asked, known=verdict is None) or verdict
        try:
            if isinstance(verdict, Refused):
                await _refuse(asked, verdict, receive, out)
            elif isinstance(verdict, SetToken):
                await _enter(verdict, out)
            else:
                await self._app(scope, receive, out)
        except asyncio.CancelledError:  # what it waited for does not come before the end
            if not started and asked.kind == "http":
                await _say(out, 503, ENDING)
            raise
        except Exception:
            _LOG.exception("the dashboard's server failed", extra={"path": asked.path})
            if not started and asked.kind == "http":
                await _say(out, 500, FAULT)

    def _too_often(self, scope: Scope, asked: RequestHeaders, *, known: bool) -> Refused | None:
        whose, now = (scope.get("client") or ("",))[0], self._clock()
        if not known:  # limits the guessing of tokens
            return None if self._tries.take(whose, now) else Refused(429, TRIED_OFTEN)
        if asked.kind == "websocket":
            return None if self._visits.take(whose, now) else Refused(429, VISITED_OFTEN)
        if asked.path.startswith("/api/") and not self._fetches.take(whose, now):
            return Refused(429, FETCHED_OFTEN)
        return None


def _asked(scope: Scope) -> RequestHeaders:
    kind, method = scope["type"], scope.get("method", "GET")
    return RequestHeaders(
        kind, method, scope["path"], scope.get("query_string", b""), scope["headers"]
    )


async def _refuse(asked: RequestHeaders, refused: Refused, receive: Receive, out: Send) -> None:
    codes = {401: NO_TOKEN, 429: TOO_OFTEN}
    if asked.kind == "websocket" and refused.status in codes:
        # A page learns why from the code alone, and that only of a connection that was accepted.
        await receive()
        await out({"type": "websocket.accept"})
        code = codes[refused.status]
        await out({"type": "websocket.close", "code": code, "reason": refused.words[:120]})
    elif refused.status == 401 and asked.path == "/":
        page = responses.no_token_page(refused.words)
        await _answer(out, 401, page, [(b"content-type", responses.HTML.encode())])
    else:
        await _say(out, refused.status, refused.words, websocket=asked.kind == "websocket")


async def _enter(entered: SetToken, out: Send) -> None:
    headers = [(b"set-cookie", entered.cookie.encode())]
    if entered.onward == "redirect":
        await _answer(out, 303, b"", [*headers, (b"location", b"/")])
    else:
        kind = (b"content-type", responses.HTML.encode())
        await _answer(out, 200, responses.onward_page(), [*headers, kind])


async def _say(out: Send, status: int, words: str, *, websocket: bool = False) -> None:
    headers = [(b"content-type", responses.JSON.encode())]
    if status == 405:
        headers.append((b"allow", ", ".join(METHODS).encode()))
    if status == 429:
        headers.append((b"retry-after", b"1"))
    await _answer(out, status, responses.said(words), headers, "websocket." if websocket else "")


async def _answer(
    out: Send, status: int, data: bytes, headers: list[tuple[bytes, bytes]], kind: str = ""
) -> None:
    headers = [*headers, (b"content-length", str(len(data)).encode())]
    await out({"type": f"{kind}http.response.start", "status": status, "headers": headers})
    await out({"type": f"{kind}http.response.body", "body": data})
