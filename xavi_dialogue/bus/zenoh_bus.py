"""The bus over Zenoh: the only module that imports zenoh.

One process hosts the hub, a session in `peer` mode that listens; all others are clients of it.
Defaults are loopback, no multicast, no gossip, no shared memory. Callbacks run on Zenoh's threads
(`indirect=False`, since with other callbacks a process that ends without closing hangs).
"""

import itertools
import json
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import TracebackType
from typing import Self

import zenoh
from zenoh import CongestionControl, Priority, SampleKind, ext
from zenoh.handlers import Callback

from xavi_dialogue.bus.interface import (
    BadLink,
    BusFailed,
    CallHandler,
    EndpointTaken,
    Handler,
    HubUnreachable,
    NobodyThere,
    Outcome,
    Presence,
    Publisher,
    Refused,
    Subscription,
    TooLate,
    Watcher,
)
from xavi_dialogue.bus.link import Link, accepts, defaults
from xavi_dialogue.bus.timers import Timers

JSON = "application/json"
CERTIFICATE = "transport/link/tls/connect_certificate"
RETRY = 0.05  # [s] between attempts to reach a hub that is not up yet
HEARTBEAT = 0.2  # [s] after which readers notice at the latest that the last message was lost
GRACE = 0.5  # [s] of Zenoh's clean-up after a deadline
_TIMERS = Timers()  # of all requests of this process


class ZenohBus:
    """A connection of this process to the bus; see `host` and `join`."""

    def __init__(self, session: zenoh.Session, places: tuple[str, ...] = ()) -> None:
        self.places = places  # endpoints at which the hub listens
        self._session = session
        self._declared: set[object] = set()  # references that keep them alive for the session

    def publisher(self, key: str, keep: int = 0) -> Publisher:
        """See Bus."""
        publisher: zenoh.Publisher | ext.AdvancedPublisher
        if not keep:
            publisher = self._session.declare_publisher(
                key,
                encoding=JSON,
                congestion_control=CongestionControl.DROP,
                priority=Priority.DATA_LOW,
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
        self._declared.add(publisher)
        return _ZenohPublisher(publisher)

    def send(self, key: str, payload: bytes) -> None:
        """See Bus."""
        with _translated("message"):
            self._session.put(
                key, payload, encoding=JSON, congestion_control=CongestionControl.DROP
            )

    @property
    def linked(self) -> bool:
        """See Bus."""
        return bool(self._session.info.peers_zid() or self._session.info.routers_zid())

    def subscribe(self, key: str, handler: Handler, *, kept: bool = False) -> Subscription:
        """See Bus."""

        def on_sample(sample: zenoh.Sample) -> None:
            handler(str(sample.key_expr), sample.payload.to_bytes())

        callback = Callback(on_sample, indirect=False)
        if not kept:
            return _Declared(self._declared, self._session.declare_subscriber(key, callback))
        subscriber = ext.declare_advanced_subscriber(
            self._session,
            key,
            callback,
            history=ext.HistoryConfig(detect_late_publishers=True),
            recovery=ext.RecoveryConfig(periodic_queries=None, heartbeat=True),
            subscriber_detection=True,
        )
        return _Declared(self._declared, subscriber)

    def serve(self, key: str, handler: CallHandler) -> None:
        """See Bus."""

        def on_query(query: zenoh.Query) -> None:
            handler(_ZenohCall(query))

        callback = Callback(on_query, indirect=False)
        self._declared.add(self._session.declare_queryable(key, callback))

    def request(
        self, key: str, payload: bytes, timeout: float, done: Callable[[Outcome], None]
    ) -> None:
        """See Bus."""
        tally = itertools.count()  # only the caller that gets the first number ends the request

        def end(outcome: Outcome) -> None:
            if next(tally) == 0:
                cancel()
                done(outcome)

        cancel = _TIMERS.after(timeout, lambda: end(TooLate(f"no reply from {key} in time")))

        def on_reply(reply: zenoh.Reply) -> None:
            end(_outcome(reply))

        def on_end() -> None:
            end(NobodyThere(f"nobody serves {key}, or this role may not ask it"))

        try:
            self._session.get(
                key,
                Callback(on_reply, on_end, indirect=False),
                payload=payload,
                encoding=JSON,
                timeout=timeout + GRACE,
                priority=Priority.INTERACTIVE_HIGH,  # also of the reply: it overtakes large records
            )
        except zenoh.ZError as error:
            end(NobodyThere(f"cannot reach {key}: {error}"))

    def appear(self, key: str) -> Presence:
        """See Bus."""
        return _Declared(self._declared, self._session.liveliness().declare_token(key))

    def watch(self, key: str, watcher: Watcher) -> None:
        """See Bus."""

        def on_change(sample: zenoh.Sample) -> None:
            watcher(str(sample.key_expr), sample.kind == SampleKind.PUT)

        self._declared.add(
            self._session.liveliness().declare_subscriber(
                key, Callback(on_change, indirect=False), history=True
            )
        )

    def close(self) -> None:
        """End the session and all that was declared on it; closing twice does nothing."""
        if not self._session.is_closed():
            with suppress(zenoh.ZError):  # the other end hangs
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


class _ZenohPublisher:
    """Sends under one key."""

    def __init__(self, publisher: zenoh.Publisher | ext.AdvancedPublisher) -> None:
        self._publisher = publisher

    def put(self, payload: bytes) -> None:
        with _translated("message"):
            self._publisher.put(payload)


class _Declared:
    """A sign of life or a subscription, until it is withdrawn."""

    def __init__(self, among: set[object], thing: object) -> None:
        self._among, self._thing = among, thing
        among.add(thing)

    def withdraw(self) -> None:
        self._among.discard(self._thing)
        with suppress(zenoh.ZError):  # a closed session has withdrawn it already
            self._thing.undeclare()  # type: ignore[attr-defined]


class _ZenohCall:
    """A request that came in over Zenoh."""

    def __init__(self, query: zenoh.Query) -> None:
        self._query = query
        self.key = str(query.key_expr)
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
    """Turn errors of Zenoh into BusFailed."""
    try:
        yield
    except zenoh.ZError as error:
        raise BusFailed(f"the {what} was not sent: {error}") from error


def host(link: Link) -> ZenohBus:
    """Open the hub, which listens at the endpoints of a link, such as `tcp/127.0.0.1:7447`.

    Raises:
        EndpointTaken: an endpoint is in use, or the hub cannot listen there.
        BadLink: the link's configuration cannot be used.
    """
    config = _config(link)
    try:
        return ZenohBus(zenoh.open(config), tuple(_endpoints(config, "listen")))
    except zenoh.ZError as error:
        places = " and ".join(_endpoints(config, "listen")) or "no endpoint at all"
        remedy = "name another with --listen; if it is in use, xavi doctor tells by whom"
        raise EndpointTaken(f"cannot listen at {places}: {_reason(error)}; {remedy}") from error


def join(link: Link, patience: float = 5.0) -> ZenohBus:
    """Connect to the hub of a link; wait for it to start.

    Raises:
        HubUnreachable: there is no hub within `patience` [s].
        BadLink: the link's configuration cannot be used.
    """
    give_up = time.monotonic() + patience
    config = _config(link)
    while True:
        try:
            return ZenohBus(zenoh.open(config))
        except zenoh.ZError as error:
            if time.monotonic() >= give_up:
                raise HubUnreachable(_unreachable(config)) from error
        time.sleep(RETRY)


def _unreachable(config: zenoh.Config) -> str:
    places = _endpoints(config, "connect")
    if not places:
        return "there is no endpoint to connect to; name one with --connect"
    start = f"start one with: xavi serve --listen {places[0]}"
    if any(map(accepts, places)):
        start = "another program listens there; end it, or name the endpoint of a hub"
    if places[0].startswith(("tls/", "quic/")):
        given = json.loads(config.get_json(CERTIFICATE))
        start = "or it does not accept the certificate that it was shown"
        start = start if given else "or it asks for a certificate; name one with --zenoh FILE"
    return f"there is no hub at {' or '.join(places)}; {start}"


def certificate_of(link: Link) -> Path | None:
    """Return the file of the certificate that a link shows; raise BadLink as `join` does."""
    named = json.loads(_config(link).get_json(CERTIFICATE))
    return None if named is None else Path(named)


def _config(link: Link) -> zenoh.Config:
    """Return the configuration of a session.

    Raises:
        BadLink: the file, an endpoint or the mode cannot be used.
    """
    config, settings = zenoh.Config(), defaults(link.mode or "client")
    if link.config is not None:
        try:
            config, settings = zenoh.Config.from_file(str(link.config)), {}
        except zenoh.ZError as error:
            raise BadLink(
                f"{link.config} is not a Zenoh configuration: {_reason(error)};"
                " `xavi keys` writes such files"
            ) from error
    said = {"mode": link.mode, "listen/endpoints": link.listen, "connect/endpoints": link.connect}
    if link.config is None:
        said["mode"] = link.mode or "client"
    else:
        said = {key: value for key, value in said.items() if value}
    try:
        for key, value in {**settings, **said}.items():
            config.insert_json5(key, json.dumps(value))
    except zenoh.ZError as error:
        raise BadLink(f"the bus cannot be configured so: {_reason(error)}") from error
    return config


def _endpoints(config: zenoh.Config, direction: str) -> list[str]:
    """Return the endpoints at which a session listens, or to which it connects."""
    found = json.loads(config.get_json(f"{direction}/endpoints"))
    if isinstance(found, dict):  # by mode
        found = found.get(json.loads(config.get_json("mode")), [])
    return [str(one) for one in found]


def _reason(error: zenoh.ZError) -> str:
    text = str(error).partition(" at /")[0]  # Zenoh appends places in its own source
    _, quoted, inner = text.partition('msg: "')
    return inner.partition('"')[0] if quoted else text


def _outcome(reply: zenoh.Reply) -> Outcome:
    if reply.ok is not None:
        return reply.ok.payload.to_bytes()
    assert reply.err is not None
    payload = reply.err.payload.to_bytes()
    return TooLate("no reply in time") if payload == b"Timeout" else Refused(payload)
