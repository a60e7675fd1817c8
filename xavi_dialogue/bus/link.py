"""The connection of a process to the bus: role and endpoints."""

import socket
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal, Self, TypeAlias

from xavi_dialogue.bus.interface import DEFAULT_ENDPOINT

Mode: TypeAlias = Literal["peer", "router", "client"]

LISTENING = 0.5  # [s] to find out whether any program listens at an endpoint
_MAX_MESSAGE = 4 * 1024 * 1024  # bytes; all messages are smaller
_SAFE: dict[str, object] = {
    "scouting/multicast/enabled": False,
    "scouting/gossip/enabled": False,
    "transport/shared_memory/enabled": False,
    "transport/link/rx/max_message_size": _MAX_MESSAGE,
    "timestamping/enabled": True,
    "transport/unicast/open_timeout": 3000,  # [ms] to detect a listener that is no hub
}
# [us] until the link to a reader that has stopped reading is closed. At a hub, it blocks all other
# readers meanwhile; a client has one reader, the hub, and loses what was under way to it.
_BLOCKED = "transport/link/tx/queue/congestion_control/block/wait_before_close"
_PATIENCE: dict[Mode, int] = {"client": 10_000_000, "peer": 1_000_000, "router": 1_000_000}


def defaults(mode: Mode) -> dict[str, object]:
    """Return the settings of a Zenoh session without a configuration file."""
    return {**_SAFE, "mode": mode, _BLOCKED: _PATIENCE[mode]}


@dataclass(frozen=True, slots=True)
class Link:
    """The parameters of a Zenoh session.

    Without a file the defaults are safe: loopback, no multicast, no gossip.
    A file overrides all of this, except for the endpoints and the mode given here.
    """

    mode: Mode | None = None  # None: from the file; without one, client
    listen: tuple[str, ...] = ()
    connect: tuple[str, ...] = ()
    config: Path | None = None  # a Zenoh configuration (JSON5), such as those of `xavi keys`

    @classmethod
    def to_hub(cls, connect: str | None = None, config: Path | None = None) -> Self:
        """Make the link of a client to the hub at an endpoint, by default the local one."""
        if connect is None and config is None:
            connect = DEFAULT_ENDPOINT
        return cls("client", connect=() if connect is None else (connect,), config=config)

    @classmethod
    def of_hub(
        cls,
        listen: str | None = None,
        connect: tuple[str, ...] = (),
        mode: Mode | None = None,
        config: Path | None = None,
    ) -> Self:
        """Make the link of a hub that listens on an endpoint, by default the local one.

        Args:
            listen: endpoint.
            connect: endpoints of routers of a fleet.
            mode: peer or router; without a configuration, peer is taken. A client joins a router,
                and hosts no hub.
            config: a Zenoh configuration.
        """
        if mode == "client":
            return cls(mode, (), connect, config)
        if config is None:
            return cls(mode or "peer", (listen or DEFAULT_ENDPOINT,), connect)
        return cls(mode, () if listen is None else (listen,), connect, config)

    def at(self, endpoint: str) -> Self:
        """Return the same link, but to another hub."""
        return replace(self, connect=(endpoint,))


def accepts(place: str) -> bool:
    """Check whether any program accepts connections at an endpoint such as tcp/127.0.0.1:7447."""
    address, _, _ = place.partition("/")[2].partition("?")
    host, _, port = address.partition("#")[0].rpartition(":")
    try:
        socket.create_connection((host.strip("[]"), int(port)), LISTENING).close()
    except (OSError, ValueError):
        return False
    return True
