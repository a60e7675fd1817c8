"""Authentication and security headers. Pure: takes headers, returns a verdict."""

import hmac
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias
from urllib.parse import parse_qs

from xavi_dialogue.dashboard.web.address import ListenError, ListenOptions, name_of

__all__ = ["ListenError", "ListenOptions", "Refused", "RequestGuard", "RequestHeaders", "SetToken"]

Headers: TypeAlias = Sequence[tuple[bytes, bytes]]  # names in lower case

#: Put on every response. The page loads nothing from elsewhere, and nobody loads or frames it.
SECURITY = {
    "content-security-policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
        "img-src 'self' data:; font-src 'self'; base-uri 'none'; form-action 'none'; "
        "frame-ancestors 'none'"
    ),
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
}
#: Added to responses without a header of their own.
CACHE = ("cache-control", "no-store")

#: Served without the token: the health check, and the files of the page without it.
OPEN = frozenset({"/healthz", "/static/css/tokens.css", "/static/css/door.css", "/static/icon.svg"})
METHODS = ("GET", "HEAD")
MAX_FIELDS = 16  # greatest number of fields of a query

NO_TOKEN = "The dashboard wants its token. Open the address that it printed where it was started."
WRONG_NAME = (
    "The dashboard is not served under this name. Open the address that it printed where it was "
    "started; to open it under another name, start it with --host-name NAME."
)
STRANGER = "The dashboard talks with its own page alone."
READ_ONLY = "Here things are only looked at: GET and HEAD are understood."


@dataclass(frozen=True, slots=True)
class RequestHeaders:
    """The parts of a request that authentication needs."""

    kind: Literal["http", "websocket"]
    method: str
    path: str
    query: bytes
    headers: Headers

    def all(self, name: str) -> list[str]:
        """Return the values of a header."""
        wanted = name.encode()
        return [value.decode("latin-1") for key, value in self.headers if key == wanted]


@dataclass(frozen=True, slots=True)
class Refused:
    """The request is not served."""

    status: int  # of HTTP
    words: str


@dataclass(frozen=True, slots=True)
class SetToken:
    """The token was in the address; it is put into a cookie, and the browser redirected to /."""

    cookie: str  # Set-Cookie
    onward: Literal["redirect", "page"]


class RequestGuard:
    """A guard that accepts or refuses requests."""

    def __init__(self, listen: ListenOptions, port: int) -> None:
        """Make the guard of one address.

        Args:
            listen: the place.
            port: of the server; cookies are shared between ports, so it is part of their name.
        """
        self._listen, self._cookie = listen, f"xavi-{port}"

    def judge(self, asked: RequestHeaders) -> Refused | SetToken | None:
        """Decide whether a request is refused; None: it is served."""
        hosts, origins = asked.all("host"), asked.all("origin")
        if len(hosts) != 1:
            return Refused(400, "A request names one host.")
        if not self._listen.serves(hosts[0]):
            return Refused(421, WRONG_NAME)
        # If the page has another name, a proxy may provide TLS.
        proxied = name_of(hosts[0], ported=True) in self._listen.names
        schemes = ("http", "https") if proxied else ("http",)
        ours = {f"{scheme}://{hosts[0].lower()}" for scheme in schemes}
        if any(origin.lower() not in ours for origin in origins):
            return Refused(403, STRANGER)
        if asked.path != "/" and "cross-site" in asked.all("sec-fetch-site"):
            return Refused(403, STRANGER)  # part of another site's page
        if asked.kind == "http" and asked.method not in METHODS:
            return Refused(405, READ_ONLY)
        given = _in_query(asked.query)
        known = self._known(given) or self._known(self._elsewhere(asked))
        if asked.kind == "websocket" and not origins and not known:
            return Refused(403, STRANGER)  # browsers send an origin; other clients need a token
        if self._listen.token is None or asked.path in OPEN:
            return None
        if not known:
            return Refused(401, NO_TOKEN)
        if given and asked.kind == "http" and asked.path == "/":
            return self._enter(asked)
        return None

    def _known(self, given: Sequence[str]) -> bool:
        token = self._listen.token
        # All are compared, in constant time.
        same = [hmac.compare_digest(one.encode(), (token or "").encode()) for one in given]
        return token is not None and any(same)

    def _elsewhere(self, asked: RequestHeaders) -> list[str]:
        """Yield tokens in cookies, and in `Authorization: Bearer TOKEN`."""
        pairs = [pair.split("=", 1) for line in asked.all("cookie") for pair in line.split(";")]
        cookies = [
            pair[1].strip() for pair in pairs if pair[0].strip() == self._cookie and pair[1:]
        ]
        spoken = [value.split(" ", 1) for value in asked.all("authorization")]
        return cookies + [s[1].strip() for s in spoken if s[0].lower() == "bearer" and s[1:]]

    def _enter(self, asked: RequestHeaders) -> SetToken:
        """Let a browser in.

        One that followed a link on a stranger's page, in a mail for instance, would not show a
        cookie of this kind when it is redirected, but does when our own page sends it on. Over
        plain HTTP browsers say where they were led from to loopback alone.
        """
        cookie = f"{self._cookie}={self._listen.token}; Path=/; HttpOnly; SameSite=Strict"
        sites = asked.all("sec-fetch-site")
        led = "cross-site" in sites or (not sites and "text/html" in "".join(asked.all("accept")))
        return SetToken(cookie, "page" if led else "redirect")


def _in_query(query: bytes) -> list[str]:
    try:
        fields = parse_qs(query.decode("latin-1"), max_num_fields=MAX_FIELDS)
    except ValueError:
        return []
    return fields.get("token", [])


def secured(headers: Headers) -> list[tuple[bytes, bytes]]:
    """Return the headers of a response, with those of every response."""
    said = {name.lower() for name, _ in headers}
    ours = [(name.encode(), value.encode()) for name, value in SECURITY.items()]
    kept = [(name, value) for name, value in headers if name.lower().decode() not in SECURITY]
    cache = [] if CACHE[0].encode() in said else [(CACHE[0].encode(), CACHE[1].encode())]
    return [*kept, *ours, *cache]
