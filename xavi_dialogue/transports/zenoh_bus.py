"""The bus over Zenoh: the only module that knows zenoh.

One process hosts the hub, a session in `peer` mode that listens; all others are clients of it.
Loopback by default, no multicast, no gossip, no shared memory. Callbacks run on Zenoh's threads
(`indirect=False`: a process that ends without closing would hang with any other kind).
"""

import itertools
import json
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from types import TracebackType
from typing import Self

import zenoh
from zenoh import CongestionControl, SampleKind, ext
from zenoh.handlers import Callback

from xavi_dialogue.transports.bus import (
    BusFailed,
    CallHandler,
    EndpointTaken,
    Handler,
    HubUnreachable,
    NobodyThere,
    Outcome,
    Publisher,
    Refused,
    TooLate,
    Watcher,
)

JSON = "application/json"
RETRY = 0.05  # [s] between attempts to reach a hub that is not up yet
HEARTBEAT = 0.2  # [s] within which a lost last message is noticed
GRACE = 0.5  # [s] that Zenoh may take beyond a deadline to clean up; ours has passed by then


class ZenohBus:
    """A connection of this process; see `host` and `join`."""

    def __init__(self, session: zenoh.Session) -> None:
        self._session = session
        self._declared: list[object] = []  # kept, so that they live as long as the session

    def publisher(self, key: str, keep: int = 0) -> Publisher:
        """See Bus."""
        publisher: Publisher
        if not keep:
            publisher = self._session.declare_publisher(
                key, encoding=JSON, congestion_control=CongestionControl.DROP
            )
        else:
            publisher = ext.declare_advanced_publisher(
                self._session,
                key,
                encoding=JSON,
                congestion_control=CongestionControl.BLOCK,
                cache=ext.CacheConfig(max_samples=keep),
                sample_miss_detection=ext.MissDetectionConfig(
                    heartbeat=HEARTBEAT, sporadic_heartbeat=None
                ),
                publisher_detection=True,
            )
        self._declared.append(publisher)
        return publisher

    def subscribe(self, key: str, handler: Handler, *, kept: bool = False) -> None:
        """See Bus."""

        def on_sample(sample: zenoh.Sample) -> None:
            handler(str(sample.key_expr), sample.payload.to_bytes())

        callback = Callback(on_sample, indirect=False)
        if not kept:
            self._declared.append(self._session.declare_subscriber(key, callback))
            return
        subscriber = ext.declare_advanced_subscriber(
            self._session,
            key,
            callback,
            history=ext.HistoryConfig(detect_late_publishers=True),
            recovery=ext.RecoveryConfig(periodic_queries=None, heartbeat=True),
            subscriber_detection=True,
        )
        self._declared.append(subscriber)

    def serve(self, key: str, handler: CallHandler) -> None:
        """See Bus."""

        def on_query(query: zenoh.Query) -> None:
            handler(_ZenohCall(query))

        self._declared.append(
            self._session.declare_queryable(key, Callback(on_query, indirect=False))
        )

    def request(
        self, key: str, payload: bytes, timeout: float, done: Callable[[Outcome], None]
    ) -> None:
        """See Bus."""
        tally = itertools.count()  # its first number goes to whoever ends the request

        def end(outcome: Outcome) -> None:
            if next(tally) == 0:
                timer.cancel()
                done(outcome)

        timer = threading.Timer(timeout, end, (TooLate(f"no reply from {key} in time"),))
        timer.daemon = True
        timer.start()

        def on_reply(reply: zenoh.Reply) -> None:
            end(_outcome(reply))

        def on_end() -> None:
            end(NobodyThere(f"nobody serves {key}"))

        try:
            self._session.get(
                key,
                Callback(on_reply, on_end, indirect=False),
                payload=payload,
                encoding=JSON,
                timeout=timeout + GRACE,
            )
        except zenoh.ZError as error:
            end(NobodyThere(f"cannot reach {key}: {error}"))

    def appear(self, key: str) -> None:
        """See Bus."""
        self._declared.append(self._session.liveliness().declare_token(key))

    def watch(self, key: str, watcher: Watcher) -> None:
        """See Bus."""

        def on_change(sample: zenoh.Sample) -> None:
            watcher(str(sample.key_expr), sample.kind == SampleKind.PUT)

        self._declared.append(
            self._session.liveliness().declare_subscriber(
                key, Callback(on_change, indirect=False), history=True
            )
        )

    def close(self) -> None:
        """End the session and all that was declared on it; closing twice does nothing."""
        if not self._session.is_closed():
            with suppress(zenoh.ZError):  # the other end hangs: nothing is left to be told to it
                self._session.close()  # type: ignore[no-untyped-call]
        self._declared.clear()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()


class _ZenohCall:
    """A request that came in over Zenoh."""

    def __init__(self, query: zenoh.Query) -> None:
        self._query = query
        self.payload = b"" if query.payload is None else query.payload.to_bytes()

    def reply(self, payload: bytes) -> None:
        with _translated("reply"), self._query as query:
            query.reply(query.key_expr, payload, encoding=JSON)

    def refuse(self, payload: bytes) -> None:
        with _translated("refusal"), self._query as query:
            query.reply_err(payload, encoding=JSON)

    def drop(self) -> None:
        self._query.drop()  # type: ignore[no-untyped-call]


@contextmanager
def _translated(what: str) -> Iterator[None]:
    """Zenoh's error as ours."""
    try:
        yield
    except zenoh.ZError as error:
        raise BusFailed(f"the {what} was not sent: {error}") from error


def host(endpoint: str) -> ZenohBus:
    """Open the hub, listening at an endpoint such as `tcp/127.0.0.1:7447`.

    Raises:
        EndpointTaken: the endpoint is in use, or cannot be listened at.
    """
    try:
        return ZenohBus(zenoh.open(_config("peer", listen=[endpoint])))
    except zenoh.ZError as error:
        reason = str(error).partition(" at /")[0]  # Zenoh appends places in its own source
        raise EndpointTaken(f"cannot listen at {endpoint}: {reason}") from error


def join(endpoint: str, patience: float = 5.0) -> ZenohBus:
    """Connect to the hub at an endpoint, waiting for it to come up.

    Raises:
        HubUnreachable: there is no hub within `patience` [s].
    """
    give_up = time.monotonic() + patience
    while True:
        try:
            return ZenohBus(zenoh.open(_config("client", connect=[endpoint])))
        except zenoh.ZError as error:
            if time.monotonic() >= give_up:
                raise HubUnreachable(
                    f"there is no hub at {endpoint}; start one with: xavi serve --listen {endpoint}"
                ) from error
        time.sleep(RETRY)


def _config(mode: str, *, listen: Sequence[str] = (), connect: Sequence[str] = ()) -> zenoh.Config:
    config = zenoh.Config()
    settings: dict[str, object] = {
        "mode": mode,
        "listen/endpoints": list(listen),
        "connect/endpoints": list(connect),
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
        "transport/shared_memory/enabled": False,
        "timestamping/enabled": True,
    }
    for key, value in settings.items():
        config.insert_json5(key, json.dumps(value))
    return config


def _outcome(reply: zenoh.Reply) -> Outcome:
    if reply.ok is not None:
        return reply.ok.payload.to_bytes()
    assert reply.err is not None
    payload = reply.err.payload.to_bytes()
    return TooLate("no reply in time") if payload == b"Timeout" else Refused(payload)
