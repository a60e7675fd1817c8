"""The web application, without a network."""

from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager

import pytest

from tests.dashboard.web.browsing import TestClient, WebSocketDenialResponse, WebSocketTestSession
from tests.dashboard.web.known_source import Known
from xavi_dialogue.dashboard.web import routes
from xavi_dialogue.dashboard.web.auth import NO_TOKEN, SECURITY, ListenOptions, RequestGuard
from xavi_dialogue.dashboard.web.middleware import FAULT, FETCHES, TRIES, VISITS
from xavi_dialogue.dashboard.web.routes import MAX_BROWSERS, SILENCE, WebApplication

HERE = "http://127.0.0.1:8480"
TOKEN = "0123456789abcdefghij"
ORIGIN = {"origin": HERE}
WS = "ws://127.0.0.1:8480/ws"


def client(
    source: Known | None = None,
    token: str | None = None,
    clock: Callable[[], float] = lambda: 0.0,
) -> TestClient:
    listen = ListenOptions.read(":8480", token=token)
    still = WebApplication(source or Known(), RequestGuard(listen, 8480), clock=clock)
    return TestClient(still.app, base_url=HERE, follow_redirects=False)


@contextmanager
def talking(browser: TestClient, **headers: str) -> Iterator[WebSocketTestSession]:
    """A connection that has been greeted."""
    with browser.websocket_connect(WS, headers=ORIGIN | headers) as socket:
        assert socket.receive_json()["type"] == "welcome"
        assert socket.receive_json()["type"] == "status"
        yield socket


def closed(socket: WebSocketTestSession) -> tuple[int, str]:
    """With which code and words a connection is closed, after whatever it says before."""
    while (message := socket.receive())["type"] != "websocket.close":
        assert message["type"] == "websocket.send"
    return message["code"], message["reason"]


@pytest.mark.parametrize(
    ("path", "status", "text"),
    [
        ("/api/roads/abc", 200, '{"hash":"abc"}'),
        ("/api/roads/other", 404, "not known"),
        ("/api/past", 200, '{"ride":"r","scenes":[]}'),
        ("/api/decisions/d1", 200, '{"id":"d1"}'),
        ("/api/decisions/d2", 404, "not here any more"),
        ("/api/turns/3/evidence", 200, '{"n":3}'),
        ("/api/turns/4/evidence", 404, "no evidence"),
        ("/healthz", 200, '{"ok":true}'),
        ("/api", 404, "nothing here"),
        ("/api/past/", 404, "nothing here"),
        ("/ws", 404, "nothing here"),
        ("/openapi.json", 404, "nothing here"),
        ("/static", 404, "nothing here"),
        ("/static/", 404, "nothing here"),
        ("/%2fevil.example/", 404, "nothing here"),
        ("/%0d%0aSet-Cookie:a=b", 404, "nothing here"),
    ],
)
def test_what_is_there(path: str, status: int, text: str) -> None:
    found = client().get(path)
    assert found.status_code == status
    assert found.headers["content-type"] == "application/json"
    assert text in found.text
    assert status == 200 or list(found.json()) == ["error"]


@pytest.mark.parametrize(
    "path",
    [
        *("/api/roads/a%2Fb", "/api/roads/..", "/api/roads/%00", "/api/roads/a%0A"),
        *("/api/decisions/%3Cscript%3E", "/api/decisions/" + "a" * 200),
        *("/api/decisions/%F0%9F%9A%97", "/api/turns/-1/evidence", "/api/turns/1e3/evidence"),
        *("/api/turns/%D9%A3/evidence", "/api/turns/" + "9" * 5000 + "/evidence"),
        *("/api/turns//evidence", "/api/turns/3%0A/evidence"),
    ],
    ids=lambda path: path[:30],
)
def test_what_is_no_name_is_not_asked_for(path: str) -> None:
    source = Known()
    found = client(source).get(path)
    assert found.status_code == 404
    assert "script" not in found.text
    assert source.calls == []


def test_the_page_is_there_and_is_kept_until_it_changes() -> None:
    browser = client()
    page = browser.get("/")
    assert page.headers["content-type"] == "text/html; charset=utf-8"
    assert page.headers["cache-control"] == "no-cache"
    assert page.text.startswith("<!doctype html>")
    etag = page.headers["etag"]
    same = browser.get("/", headers={"if-none-match": f'"other", {etag}'})
    assert (same.status_code, same.content, same.headers["etag"]) == (304, b"", etag)
    assert browser.get("/", headers={"if-none-match": '"other"'}).status_code == 200
    assert browser.get("/static/js/store.js").headers["content-type"].startswith("text/javascript")


def test_what_is_large_is_packed_for_who_can_read_that() -> None:
    source = Known(past_said=b'{"ride":"' + b"a" * 300_000 + b'"}')
    browser = client(source)
    packed = browser.get("/api/past", headers={"accept-encoding": "br, gzip;q=1.0, gzip"})
    assert packed.headers["content-encoding"] == "gzip"
    assert int(packed.headers["content-length"]) < 1000
    assert packed.content == source.past_said
    plain = browser.get("/api/past", headers={"accept-encoding": "identity"})
    assert "content-encoding" not in plain.headers
    assert plain.content == source.past_said
    assert packed.headers["vary"] == plain.headers["vary"] == "accept-encoding"


def test_head_tells_the_same_without_a_body() -> None:
    browser = client()
    got, told = browser.get("/api/past"), browser.head("/api/past")
    assert (told.status_code, told.content) == (200, b"")
    assert told.headers["content-length"] == got.headers["content-length"]


RESPONSES = [
    *(("GET", path, {}) for path in ("/", "/static/js/store.js", "/api/past", "/healthz")),
    *(("GET", path, {}) for path in ("/nothing", "/static/nothing.js", "/api/decisions/x")),
    *((method, "/", {}) for method in ("HEAD", "POST", "PUT", "DELETE", "OPTIONS", "PATCH")),
    ("GET", "/", {"host": "evil.example"}),
    ("GET", "/", {"origin": "http://evil.example"}),
    ("GET", "/ws", {}),
]


@pytest.mark.parametrize(("method", "path", "headers"), RESPONSES)
@pytest.mark.parametrize("token", [None, TOKEN])
def test_every_response_has_its_headers(
    method: str, path: str, headers: dict[str, str], token: str | None
) -> None:
    found = client(token=token).request(method, path, headers=headers)
    for name, value in SECURITY.items():
        assert found.headers.get_list(name) == [value]
    assert len(found.headers.get_list("cache-control")) == 1
    assert not {"server", "x-powered-by", "access-control-allow-origin"} & set(found.headers)
    if found.status_code == 405:
        assert found.headers["allow"] == "GET, HEAD"


@pytest.mark.parametrize("fails", ["roads", "past", "decision", "evidence"])
def test_a_fault_of_ours_is_logged_and_not_shown(
    fails: str, caplog: pytest.LogCaptureFixture
) -> None:
    paths = {
        "roads": "/api/roads/abc",
        "past": "/api/past",
        "decision": "/api/decisions/d1",
        "evidence": "/api/turns/3/evidence",
    }
    found = client(Known(fails=fails)).get(paths[fails])
    assert (found.status_code, found.json()) == (500, {"error": FAULT})
    assert found.headers["content-security-policy"] == SECURITY["content-security-policy"]
    assert "the dashboard's server failed" in caplog.messages


def test_evidence_that_does_not_come_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    class Slow(Known):
        async def evidence(self, number: int) -> bytes | None:
            await routes.asyncio.Event().wait()
            return None

    monkeypatch.setattr(routes, "EVIDENCE_WAIT", 0.01)
    found = client(Slow()).get("/api/turns/3/evidence")
    assert (found.status_code, list(found.json())) == (504, ["error"])


def test_documents_are_not_fetched_without_end() -> None:
    browser = client()
    statuses = [browser.get("/api/past").status_code for _ in range(FETCHES.burst + 1)]
    assert statuses == [200] * FETCHES.burst + [429]
    assert browser.get("/api/past").headers["retry-after"] == "1"
    assert browser.get("/").status_code == 200


def test_a_browser_talks() -> None:
    source = Known()
    with talking(client(source)) as socket:
        socket.send_json({"type": "ask", "request": "r1", "text": "Why?"})
        assert socket.receive_json() == {"type": "answered", "request": "r1", "n": 0, "reply": None}
        socket.send_json({"type": "cancel", "request": "r1"})
        socket.send_json({"type": "suggest", "at": 1.0})
        assert socket.receive_json() == {"type": "suggestions", "t": 1.0, "questions": ["Why?"]}
    assert [name for name, _ in source.calls] == ["greet", "ask", "cancel", "suggest", "left"]


def test_a_board_that_fails_ends_neither_the_talk_nor_tells_why(
    caplog: pytest.LogCaptureFixture,
) -> None:
    with talking(client(Known(fails="ask"))) as socket:
        socket.send_json({"type": "ask", "request": "r1", "text": "Why?"})
        assert socket.receive_json() == {"type": "trouble", "request": "r1", "text": FAULT}
        socket.send_json({"type": "suggest", "at": 1.0})
        assert socket.receive_json()["type"] == "suggestions"
    assert caplog.messages == ["the board failed"]


def test_a_greeting_that_fails_closes_the_connection(caplog: pytest.LogCaptureFixture) -> None:
    with client(Known(fails="greet")).websocket_connect(WS, headers=ORIGIN) as socket:
        assert closed(socket) == (1011, FAULT)
    assert "the dashboard failed to talk with a browser" in caplog.messages


def test_what_is_no_text_ends_the_connection() -> None:
    with talking(client()) as socket:
        socket.send_bytes(b'{"type":"seen","seq":1}')
        assert closed(socket)[0] == 1003


@pytest.mark.parametrize(
    ("headers", "status"),
    [
        ({}, 403),
        ({"origin": "http://evil.example"}, 403),
        ({"origin": "null"}, 403),
        ({"origin": "http://localhost:8480"}, 403),
        ({"origin": "http://evil.example", "host": "evil.example"}, 421),
    ],
)
def test_a_stranger_gets_no_connection(headers: dict[str, str], status: int) -> None:
    source = Known()
    with (
        pytest.raises(WebSocketDenialResponse) as caught,
        client(source).websocket_connect(WS, headers=headers),
    ):
        pass
    assert caught.value.status_code == status
    assert list(caught.value.json()) == ["error"]
    assert caught.value.headers["x-content-type-options"] == "nosniff"
    assert source.calls == []


def test_there_are_not_too_many_browsers() -> None:
    source, sockets = Known(), []
    browser = client(source)
    with browser:
        for _ in range(MAX_BROWSERS):
            socket = talking(browser)
            socket.__enter__()
            sockets.append(socket)
        with browser.websocket_connect(WS, headers=ORIGIN) as socket:
            code, words = closed(socket)
        assert code == 1013
        assert words == routes.FULL
        sockets.pop().__exit__(None, None, None)
        with talking(browser):
            pass
        for one in sockets:
            one.__exit__(None, None, None)
    assert len(source.of("greet")) == len(source.of("left")) == MAX_BROWSERS + 1


def test_who_says_nothing_loses_its_place_to_another() -> None:
    source, now = Known(), [0.0]
    browser = client(source, clock=lambda: now[0])
    with browser, ExitStack() as places:
        speaking = places.enter_context(talking(browser))
        speaking.send_json({"type": "here"})
        silent = [places.enter_context(talking(browser)) for _ in range(MAX_BROWSERS - 1)]
        with browser.websocket_connect(WS, headers=ORIGIN) as early:
            assert closed(early) == (1013, routes.FULL)
        now[0] = SILENCE
        for one in silent:
            places.enter_context(talking(browser))
            assert closed(one) == (1013, routes.SILENT)
        with browser.websocket_connect(WS, headers=ORIGIN) as late:
            assert closed(late) == (1013, routes.FULL)
        speaking.send_json({"type": "ask", "request": "r1", "text": "Why?"})
        while speaking.receive_json()["type"] != "answered":
            pass
    assert len(source.of("greet")) == len(source.of("left")) == 2 * MAX_BROWSERS - 1


def test_connections_are_not_made_without_end() -> None:
    browser = client()
    for _ in range(VISITS.burst):
        with talking(browser):
            pass
    with browser.websocket_connect(WS, headers=ORIGIN) as socket:
        assert closed(socket)[0] == 4429


def test_tokens_are_not_guessed_without_end() -> None:
    browser = client(token=TOKEN)
    statuses = [browser.get(f"/?token={'x' * 19}{k}").status_code for k in range(10)]
    statuses += [browser.get(f"/?token={'y' * 18}{k}").status_code for k in range(20)]
    assert statuses[: TRIES.burst] == [401] * TRIES.burst
    assert 429 in statuses[TRIES.burst :]
    assert browser.get(f"/?token={TOKEN}").status_code == 303


def test_the_way_in_with_a_token() -> None:
    browser = client(token=TOKEN)
    page = browser.get("/")
    assert page.status_code == 401
    assert page.headers["content-type"] == "text/html; charset=utf-8"
    assert "where it was started" in page.text
    assert browser.get("/api/past").json() == {"error": NO_TOKEN}
    assert browser.get("/static/css/door.css").status_code == 200
    with browser.websocket_connect(WS, headers=ORIGIN) as socket:
        assert closed(socket)[0] == 4401
    assert browser.get("/?token=" + TOKEN[:-1] + "x").status_code == 401

    entered = browser.get(f"/?token={TOKEN}")
    assert (entered.status_code, entered.headers["location"]) == (303, "/")
    cookie = entered.headers["set-cookie"]
    assert "HttpOnly" in cookie
    assert "SameSite=Strict" in cookie
    assert browser.get("/").status_code == 200
    assert browser.get("/api/past").status_code == 200
    with talking(browser):
        pass


def test_the_way_in_from_a_link_elsewhere() -> None:
    browser = client(token=TOKEN)
    page = browser.get(f"/?token={TOKEN}", headers={"sec-fetch-site": "cross-site"})
    assert page.status_code == 200
    assert 'http-equiv="refresh" content="0;url=/"' in page.text
    assert TOKEN not in page.text
    assert browser.get("/").status_code == 200


def test_programs_that_are_no_browsers_say_the_token() -> None:
    browser = client(token=TOKEN)
    bearer = {"authorization": f"Bearer {TOKEN}"}
    assert browser.get("/api/past", headers=bearer).status_code == 200
    with browser.websocket_connect(WS, headers=bearer) as socket:
        assert socket.receive_json()["type"] == "welcome"
