"""How a process is linked to the bus: as what, and over which endpoints."""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal, Self, TypeAlias

from xavi_dialogue.bus.interface import DEFAULT_ENDPOINT

Mode: TypeAlias = Literal["peer", "router", "client"]


@dataclass(frozen=True, slots=True)
class Link:
    """What the configuration of a Zenoh session is made of.

    Without a file, what is not said here is the safe choice: loopback, no multicast, no gossip.
    A file says all by itself; of endpoints and mode, those that are given here count.
    """

    mode: Mode | None = None  # None: as the file says; without one, client
    listen: tuple[str, ...] = ()
    connect: tuple[str, ...] = ()
    config: Path | None = None  # a Zenoh configuration (JSON5), such as `xavi keys` writes

    @classmethod
    def to_hub(cls, connect: str | None = None, config: Path | None = None) -> Self:
        """A client of the hub at an endpoint; of the default one where neither is given."""
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
        """A hub that listens at an endpoint; at the default one where neither is given.

        Args:
            listen: endpoint.
            connect: endpoints of routers of a fleet.
            mode: peer or router; without a configuration, peer is taken.
            config: a Zenoh configuration.
        """
        if config is None:
            return cls(mode or "peer", (listen or DEFAULT_ENDPOINT,), connect)
        return cls(mode, () if listen is None else (listen,), connect, config)

    def at(self, endpoint: str) -> Self:
        """The same, but to another hub."""
        return replace(self, connect=(endpoint,))
