"""Addresses at which the dashboard listens, and the names under which it is opened."""

import ipaddress
import re
from dataclasses import dataclass, field
from typing import Self

from xavi_dialogue.process.exit_status import UsageFault
from xavi_dialogue.security.browser_token import FORM, is_token, new_token

DEFAULT_HOST = "127.0.0.1"
DEFAULT_PORT = 8480
LOCAL_NAMES = ("localhost", "127.0.0.1", "[::1]")
MEND = "write it as 127.0.0.1:8480, :8480 or [::1]:8480; port 0 is any that is free"

_NAME = re.compile(r"(?=.{1,253}$)[a-z0-9_]([a-z0-9_-]{0,62})(\.[a-z0-9_]([a-z0-9_-]{0,62}))*")


class ListenError(UsageFault):
    """The address cannot be used; the message says how to correct it."""


@dataclass(frozen=True, slots=True)
class ListenOptions:
    """The address to listen at, and the hosts that are accepted."""

    host: str = DEFAULT_HOST  # an address, that of IPv6 without brackets, or a name
    port: int = DEFAULT_PORT  # 0: any that is free
    token: str | None = field(
        default=None, repr=False
    )  # token that browsers must send; None: none is required
    names: tuple[str, ...] = ()  # other names under which the page is opened, in lower case

    @classmethod
    def read(
        cls, text: str | None = None, *, token: str | None = None, names: tuple[str, ...] = ()
    ) -> Self:
        """Parse an address.

        Args:
            text: such as 127.0.0.1:8480, :8480, [::1]:8480 or 0.0.0.0:8480; None: the default.
            token: chosen; None: none on loopback, and elsewhere a random one.
            names: host names of the page, besides the address itself.

        Raises:
            ListenError: one of them makes no sense.
        """
        host, port = _place(text or "")
        if token is not None and not is_token(token):
            raise ListenError(f"a token has {FORM}; leave it out for one")
        for name in names:
            if name_of(name) != name.lower().rstrip("."):
                raise ListenError(f"{name[:64]!r} is not a host name; write it without a port")
        if token is None and not is_loopback(host):
            token = new_token()
        return cls(host, port, token, tuple(name.lower().rstrip(".") for name in names))

    @property
    def loopback(self) -> bool:
        """Whether only this machine can reach it."""
        return is_loopback(self.host)

    @property
    def everywhere(self) -> bool:
        """Whether it stands for all addresses of the machine."""
        return self.host in {"0.0.0.0", "::"}

    @property
    def place(self) -> str:
        """The address as it is typed."""
        return f"{bracketed(self.host)}:{self.port}"

    def address(self, port: int) -> str:
        """Return the address to open in a browser, without the token.

        Args:
            port: that is listened at, once it is known.
        """
        host = {"0.0.0.0": DEFAULT_HOST, "::": "[::1]"}.get(self.host, bracketed(self.host))
        return f"http://{self.names[0] if self.names else host}:{port}/"

    def serves(self, host: str) -> bool:
        """Check whether a Host header is accepted.

        On loopback these are its usual names, with any port: ports are forwarded, by ssh for
        instance, and the names alone keep out a stranger's name that was made to lead here (DNS
        rebinding). Who listens at all addresses is served under any of them that is a number,
        since no name leads there by that; elsewhere it is the one that is listened at.
        """
        name = name_of(host, ported=True)
        if name is None:
            return False
        if name in {*self.names, bracketed(self.host).lower()}:
            return True
        if self.loopback:
            return name in LOCAL_NAMES
        return self.everywhere and (name == "localhost" or _address(name) is not None)


def is_loopback(host: str) -> bool:
    """Check whether only this machine can reach a host, an address or a name."""
    address = _address(host)
    return host.lower() == "localhost" if address is None else address.is_loopback


def bracketed(host: str) -> str:
    """Format a host as part of an address."""
    return f"[{host}]" if ":" in host else host


def name_of(host: str, *, ported: bool = False) -> str | None:
    """Return the name in a Host header in lower case; None if it is invalid.

    Args:
        host: a name, an address of IPv4, or one of IPv6 in brackets.
        ported: whether a port is allowed.
    """
    found = re.fullmatch(r"(\[[0-9a-fA-F:.]+\]|[^:\[\]]*)(:[0-9]{1,5})?", host)
    if found is None or (found[2] and not ported):
        return None
    name = found[1].lower().removesuffix(".")
    if name.startswith("["):
        return None if _address(name) is None else name
    return name if _NAME.fullmatch(name) else None


def _place(text: str) -> tuple[str, int]:
    if re.fullmatch(r"[0-9]{1,5}", text):  # a port alone
        text = f":{text}"
    found = re.fullmatch(r"(\[[^\]\[]*\]|[^:\[\]]*)(?::([0-9]{1,5}))?", text)
    if found is None:
        raise ListenError(f"{text[:64]!r} is not an address to listen at; {MEND}")
    host, port = found[1] or DEFAULT_HOST, int(found[2] or DEFAULT_PORT)
    if port > 65535:
        raise ListenError(f"{port} is not a port; give a number up to 65535")
    if name_of(host) is None:
        raise ListenError(f"{host[:64]!r} is not a host; {MEND}")
    return host.strip("[]"), port


def _address(host: str) -> ipaddress.IPv4Address | ipaddress.IPv6Address | None:
    try:
        return ipaddress.ip_address(host.strip("[]"))
    except ValueError:
        return None
