"""Who may come in."""

import pytest

from xavi_dialogue.dashboard.web.auth import (
    SECURITY,
    ListenOptions,
    Refused,
    RequestGuard,
    RequestHeaders,
    SetToken,
    secured,
)

TOKEN = "0123456789abcdefghij"
HERE = "127.0.0.1:8480"


def asked(
    path: str = "/", kind: str = "http", method: str = "GET", **headers: str
) -> RequestHeaders:
    """A request; of a header's name underscores are dashes, and an empty one is left out."""
    path, _, query = path.partition("?")
    said = {"host": HERE} | headers
    pairs = [(k.replace("_", "-").encode(), v.encode()) for k, v in said.items() if v != "-"]
    return RequestHeaders(kind, method, path, query.encode(), pairs)  # type: ignore[arg-type]


def guard(token: str | None = None) -> RequestGuard:
    return RequestGuard(ListenOptions.read(":8480", token=token), 8480)


def status(verdict: object) -> int | None:
    assert verdict is None or isinstance(verdict, Refused)
    return None if verdict is None else verdict.status


@pytest.mark.parametrize(
    ("request_", "expected"),
    [
        (asked(), None),
        (asked(method="HEAD"), None),
        (asked(origin="http://127.0.0.1:8480"), None),
        (asked(host="localhost:8480", origin="http://LOCALHOST:8480"), None),
        (asked(host="-"), 400),
        (asked(host="evil.example"), 421),
        (asked(host="evil.example", origin="http://evil.example"), 421),
        (asked(origin="http://evil.example"), 403),
        (asked(origin="null"), 403),
        (asked(origin=""), 403),
        (asked(origin="http://127.0.0.1:9999"), 403),
        (asked(origin="https://127.0.0.1:8480"), 403),
        (asked(origin="http://localhost:8480"), 403),  # another one than the host
        (asked(method="POST"), 405),
        (asked(method="OPTIONS"), 405),
        (asked(method="TRACE"), 405),
        (asked("/ws", "websocket", origin="http://127.0.0.1:8480"), None),
        (asked("/ws", "websocket", origin="http://evil.example"), 403),
        (asked("/ws", "websocket", origin="null"), 403),
        (asked("/ws", "websocket"), 403),
        (asked("/ws?token=", "websocket"), 403),
        (asked(f"/ws?token={TOKEN}", "websocket"), 403),  # nobody gave one out
    ],
)
def test_without_a_token(request_: RequestHeaders, expected: int | None) -> None:
    assert status(guard().judge(request_)) == expected


@pytest.mark.parametrize(
    ("request_", "expected"),
    [
        (asked(), 401),
        (asked("/api/past"), 401),
        (asked("/static/js/main.js"), 401),
        (asked("/static/css/door.css"), None),
        (asked("/static/css/../js/main.js"), 401),
        (asked("/healthz"), None),
        (asked("/healthz", host="evil.example"), 421),
        (asked(f"/api/past?token={TOKEN}"), None),
        (asked("/api/past?token=wrong"), 401),
        (asked("/api/past?token="), 401),
        (asked("/api/past?token=%ff"), 401),
        (asked("/api/past?" + "&".join(["a=1"] * 100) + f"&token={TOKEN}"), 401),
        (asked("/api/past", cookie=f"xavi-8480={TOKEN}"), None),
        (asked("/api/past", cookie=f"a=b; xavi-8480=wrong; xavi-8480={TOKEN}; c"), None),
        (asked("/api/past", cookie=f"xavi-8481={TOKEN}"), 401),
        (asked("/api/past", cookie="xavi-8480="), 401),
        (asked("/api/past", cookie="xavi-8480"), 401),
        (asked("/api/past", authorization=f"Bearer {TOKEN}"), None),
        (asked("/api/past", authorization=f"Basic {TOKEN}"), 401),
        (asked("/api/past", authorization="Bearer"), 401),
        (asked("/api/past", authorization=f"Bearer {TOKEN}é"), 401),
        (asked("/ws", "websocket", origin="http://127.0.0.1:8480"), 401),
        (asked("/ws", "websocket"), 403),
        (asked(f"/ws?token={TOKEN}", "websocket"), None),
        (asked("/ws", "websocket", authorization=f"Bearer {TOKEN}"), None),
        (asked("/ws", "websocket", cookie=f"xavi-8480={TOKEN}", origin="http://evil.example"), 403),
        (asked("/", cookie=f"xavi-8480={TOKEN}"), None),
    ],
)
def test_with_a_token(request_: RequestHeaders, expected: int | None) -> None:
    assert status(guard(TOKEN).judge(request_)) == expected


def test_behind_a_proxy_with_tls_the_page_has_a_name() -> None:
    named = RequestGuard(ListenOptions.read(":8480", names=("dash.example.org",)), 8480)
    for origin, expected in (
        ("https://dash.example.org", None),
        ("http://dash.example.org", None),
        ("https://evil.example", 403),
        ("https://dash.example.org.evil.example", 403),
    ):
        request = asked("/ws", "websocket", host="dash.example.org", origin=origin)
        assert status(named.judge(request)) == expected


@pytest.mark.parametrize("path", ["/api/past", "/api/roads/x", "/static/js/main.js"])
def test_what_is_part_of_a_strangers_page_is_refused(path: str) -> None:
    for site, expected in (("cross-site", 403), ("same-origin", None), ("none", None)):
        assert status(guard().judge(asked(path, sec_fetch_site=site))) == expected
    assert (
        status(guard().judge(asked(sec_fetch_site="cross-site"))) is None
    )  # a link that leads here


def test_the_token_goes_from_the_address_into_a_cookie() -> None:
    cookie = f"xavi-8480={TOKEN}; Path=/; HttpOnly; SameSite=Strict"
    entered = guard(TOKEN).judge(asked(f"/?token={TOKEN}"))
    assert entered == SetToken(cookie, "redirect")
    led = guard(TOKEN).judge(asked(f"/?token={TOKEN}", sec_fetch_site="cross-site"))
    assert led == SetToken(cookie, "page")
    unsaid = guard(TOKEN).judge(asked(f"/?token={TOKEN}", accept="text/html,*/*;q=0.8"))
    assert unsaid == SetToken(cookie, "page")
    typed = asked(f"/?token={TOKEN}", sec_fetch_site="none", accept="text/html")
    assert guard(TOKEN).judge(typed) == SetToken(cookie, "redirect")


def test_every_response_has_the_headers_once() -> None:
    found = secured(
        [(b"X-Frame", b"a"), (b"Referrer-Policy", b"unsafe-url"), (b"cache-control", b"b")]
    )
    names = [name.lower().decode() for name, _ in found]
    assert len(names) == len(set(names)) == len(SECURITY) + 2
    assert dict(found)[b"referrer-policy"] == b"no-referrer"
    assert dict(found)[b"cache-control"] == b"b"
    assert dict(secured([]))[b"cache-control"] == b"no-store"
