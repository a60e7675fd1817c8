"""The web server, by real connections."""

import asyncio
import json
import logging
import os
import socket
import struct
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import ExitStack, closing, contextmanager, suppress
from pathlib import Path
from typing import Any

import httpx
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import ClientConnection, connect

from tests.dashboard.web.known_source import PATIENCE, STATUS, Known, Running, running, scene
from xavi_dialogue.dashboard.web import server
from xavi_dialogue.dashboard.web.auth import SECURITY
from xavi_dialogue.dashboard.web.client_session import MAX_IN_FLIGHT, MAX_WAITING
from xavi_dialogue.dashboard.web.middleware import ENDING
from xavi_dialogue.dashboard.web.server import ListenError, ListenOptions, Server
from xavi_dialogue.dashboard.web.websocket_messages import MAX_INCOMING, Trouble

KEY = "dGhlIHNhbXBsZSBub25jZQ=="


@pytest.fixture
def here() -> Iterator[Running]:
    with running() as found:
        yield found


@contextmanager
def browser(here: Running, **options: Any) -> Iterator[ClientConnection]:
    """A connection that has been greeted."""
    origin: Any = here.origin
    with connect(here.socket, origin=origin, compression=None, max_size=None, **options) as one:
        assert said(one)["type"] == "welcome"
        assert said(one)["type"] == "status"
        yield one


def said(one: ClientConnection) -> dict[str, Any]:
    return json.loads(one.recv(timeout=PATIENCE))  # type: ignore[no-any-return]


def of_kind(one: ClientConnection, kind: str) -> dict[str, Any]:
    """The next message of a kind."""
    while (message := said(one))["type"] != kind:
        pass
    return message


def closed(one: ClientConnection) -> int | None:
    """With which code a connection is closed, after whatever it says before; None: cut off."""
    try:
        while True:
            one.recv(timeout=PATIENCE)
    except ConnectionClosed as end:
        return None if end.rcvd is None else end.rcvd.code


def raw(here: Running, data: bytes) -> bytes:
    """All that a server says to some bytes until it closes the connection."""
    with closing(socket.create_connection(("127.0.0.1", here.server.port), PATIENCE)) as one:
        one.sendall(data)
        return until_closed(one)


def until_closed(one: socket.socket) -> bytes:
    """All that is said until the other end closes the connection."""
    found = b""
    with suppress(ConnectionResetError):
        while more := one.recv(65536):
            found += more
    return found


def secure(response: bytes) -> bool:
    head = response.partition(b"\r\n\r\n")[0].decode().lower()
    return all(f"{name}: {value}".lower() in head for name, value in SECURITY.items())


# --- where it listens -----------------------------------------------------------------------


def test_a_place_that_is_taken_is_said_so(here: Running) -> None:
    with pytest.raises(ListenError, match=r"is in use; choose another with --listen"):
        Server(Known(), ListenOptions.read(f"127.0.0.1:{here.server.port}"))


@pytest.mark.parametrize(
    ("place", "words"),
    [("192.0.2.1:0", "not an address of this"), ("nowhere.invalid:0", "not known")],
)
def test_a_place_that_is_not_ours_is_said_so(place: str, words: str) -> None:
    with pytest.raises(ListenError, match=words):
        Server(Known(), ListenOptions.read(place))


def test_the_address_is_known_before_anybody_is_served() -> None:
    one = Server(Known(), ListenOptions.read("0.0.0.0:0"))
    try:
        assert one.port > 0
        assert one.address == f"http://127.0.0.1:{one.port}/"
        assert one.link.startswith(f"{one.address}?token=")
        with closing(socket.create_connection(("127.0.0.1", one.port), PATIENCE)):
            pass  # it waits until it is served
    finally:
        one.close()


def test_elsewhere_the_link_alone_opens_the_page() -> None:
    with running(listen="0.0.0.0:0") as here, httpx.Client(follow_redirects=True) as web:
        assert web.get(here.server.address).status_code == 401
        page = web.get(here.server.link)
        assert (page.status_code, str(page.url)) == (200, here.server.address)
        assert web.get(here.server.address + "api/past").status_code == 200
        cookie = "; ".join(f"{name}={value}" for name, value in web.cookies.items())
        with browser(here, additional_headers={"cookie": cookie}):
            pass


def test_it_is_served_over_ipv6() -> None:
    with running(listen="[::1]:0") as here:
        assert httpx.get(here.server.address).status_code == 200
        with browser(here):
            pass


# --- what it does for a board ---------------------------------------------------------------


def test_browsers_talk_and_are_told(here: Running) -> None:
    with browser(here) as one, browser(here) as other:
        one.send('{"type":"ask","request":"r","text":"Why?"}')
        assert of_kind(one, "answered")["request"] == "r"
        here.do(here.server.tell, Trouble(request=None, text="for all"))
        here.do(here.server.tell, scene(1))
        for each in (one, other):
            assert of_kind(each, "trouble")["text"] == "for all"
            assert of_kind(each, "scene")["seq"] == 1
        assert here.do(lambda: here.server.browsers) == 2
    here.end_of_browsers()
    assert sorted(here.source.of("left")) == [0, 1]


def test_the_number_of_browsers_is_told_to_those_that_are_there(here: Running) -> None:
    with browser(here) as one:
        with browser(here):
            assert of_kind(one, "status")["browsers"] == 2
        assert of_kind(one, "status")["browsers"] == 1


def test_what_other_threads_want_is_done_in_order_and_on_the_loop(
    caplog: pytest.LogCaptureFixture,
) -> None:
    found: list[tuple[int, str]] = []

    def note(number: int) -> None:
        found.append((number, threading.current_thread().name))

    def fail() -> None:
        raise RuntimeError("secret words")

    async def main() -> None:
        one = Server(Known(), ListenOptions.read(":0"))
        stopped = asyncio.Event()
        one.soon(note, 1)
        one.soon(fail)
        thread = threading.Thread(target=lambda: [one.soon(note, 2), one.soon(stopped.set)])
        thread.start()
        await one.serve(stopped)
        thread.join()
        one.soon(note, 3)
        await asyncio.sleep(0.0)

    asyncio.run(main())
    assert found == [(1, threading.current_thread().name), (2, threading.current_thread().name)]
    assert caplog.messages == ["the dashboard failed to take something in"]


# --- its end --------------------------------------------------------------------------------


def test_browsers_are_told_of_the_end(here: Running) -> None:
    with browser(here) as one, browser(here) as other:
        here.stop()
        assert [closed(one), closed(other)] == [1001, 1001]
    here.end()
    assert sorted(here.source.of("left")) == [0, 1]
    with pytest.raises(httpx.ConnectError):
        httpx.get(here.server.address)


def test_it_ends_while_somebody_reads_nothing_or_says_nothing(here: Running) -> None:
    with silent(here), closing(socket.create_connection(("127.0.0.1", here.server.port))):
        for _ in range(60):
            here.do(here.server.tell, Trouble(request=None, text="x" * 100_000))
        here.stop()
        here.end()


def test_it_ends_when_it_is_cancelled() -> None:
    source = Known()

    async def main() -> None:
        one = Server(source, ListenOptions.read(":0"))
        serving = asyncio.create_task(one.serve(asyncio.Event()))
        async with httpx.AsyncClient() as web:
            assert (await web.get(one.address)).status_code == 200
        serving.cancel()
        with pytest.raises(asyncio.CancelledError):
            await serving
        async with httpx.AsyncClient() as web:
            with pytest.raises(httpx.ConnectError):
                await web.get(one.address)

    asyncio.run(main())


def test_evidence_that_is_still_awaited_does_not_hold_up_the_end() -> None:
    asked, answers = threading.Event(), list[httpx.Response]()

    class Slow(Known):
        async def evidence(self, number: int) -> bytes | None:
            asked.set()
            await asyncio.Event().wait()
            return None

    with running(Slow()) as here:
        address = here.server.address + "api/turns/3/evidence"

        def fetch() -> None:
            answers.append(httpx.get(address, timeout=PATIENCE))

        fetching = threading.Thread(target=fetch)
        fetching.start()
        assert asked.wait(PATIENCE)
        here.stop()
        here.end()
        fetching.join(PATIENCE)
    [answer] = answers
    assert (answer.status_code, answer.json()) == (503, {"error": ENDING})
    assert answer.headers["x-content-type-options"] == "nosniff"


# --- strangers ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("origin", "host", "status"),
    [
        (None, None, 403),
        ("http://evil.example", None, 403),
        ("null", None, 403),
        ("http://evil.example", "evil.example", 421),
    ],
)
def test_a_stranger_gets_no_connection(
    here: Running, origin: str | None, host: str | None, status: int
) -> None:
    address = here.socket if host is None else here.socket.replace("127.0.0.1", host)
    options: dict[str, Any] = {"origin": origin}
    if host is not None:  # a name that was made to lead here
        options["sock"] = socket.create_connection(("127.0.0.1", here.server.port))
    with pytest.raises(InvalidStatus) as caught, connect(address, **options):
        pass
    response = caught.value.response
    assert response.status_code == status
    assert response.headers["x-content-type-options"] == "nosniff"
    assert here.source.calls == []


REQUESTS = [
    (b"\x16\x03\x01\x00\x00", 400),
    (b"nonsense\r\n\r\n", 400),
    (b"GET / HTTP/1.1\r\n\r\n", 400),
    (b"GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n", 400),
    (b"GET / HTTP/1.0\r\n\r\n", 400),
    (b"GET / HTTP/1.1\r\nHost: localhost\r\nX: " + b"a" * 20_000, 400),
    (b"GET /" + b"a" * 20_000, 400),
    (b"GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: x\r\n\r\n", 400),
    (b"GET / HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n", 421),
    (b"GET http://localhost/ HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n", 421),
    (b"GET http://localhost/ HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n", 404),
    (b"GET /static/../server.py HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n", 404),
    (b"GET /static/%2e%2e/wire.py HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n", 404),
    (b"GET /static//etc/passwd HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n", 404),
    (b"GET /../../etc/passwd HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n", 404),
    (b"CONNECT localhost:22 HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n", 405),
    (b"TRACE / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n", 405),
    (b"POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 0\r\nConnection: close\r\n\r\n", 405),
]
UPGRADE = (
    "GET /ws HTTP/1.1\r\nHost: localhost\r\nOrigin: http://localhost\r\nUpgrade: websocket\r\n"
)
HANDSHAKES = [
    ("Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n", 400),  # no key
    (f"Connection: Upgrade\r\nSec-WebSocket-Key: {KEY}\r\nSec-WebSocket-Version: 8\r\n", 400),
    ("Connection: Upgrade\r\nSec-WebSocket-Key: x\r\nSec-WebSocket-Version: 13\r\n", 400),
]


@pytest.mark.parametrize(("request_", "status"), REQUESTS, ids=[r[0][:40] for r in REQUESTS])
def test_what_is_no_good_request_gets_words_and_headers(
    here: Running, request_: bytes, status: int
) -> None:
    found = raw(here, request_)
    assert found.startswith(f"HTTP/1.1 {status} ".encode())
    assert secure(found)
    assert list(json.loads(found.partition(b"\r\n\r\n")[2])) == ["error"]
    assert b"root:" not in found


@pytest.mark.parametrize(("headers", "status"), HANDSHAKES)
def test_a_handshake_that_is_none_gets_headers(here: Running, headers: str, status: int) -> None:
    found = raw(here, (UPGRADE + headers + "\r\n").encode())
    assert found.startswith(f"HTTP/1.1 {status} ".encode())
    assert secure(found)
    assert here.source.calls == []


def test_a_client_that_says_nothing_is_cut_off(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server, "PATIENCE", 0.1)
    head = b"GET / HTTP/1.1\r\nHost: localhost\r\n"
    with running() as here:
        assert raw(here, b"") == b""
        assert raw(here, head) == b""
        endless = head.replace(b"GET", b"POST") + b"Content-Length: 1000000\r\n\r\na"
        assert raw(here, endless).startswith(b"HTTP/1.1 405 ")
        with browser(here) as one:  # but not one that talks
            assert raw(here, b"") == b""
            here.do(here.server.tell, scene(1))
            assert of_kind(one, "scene")["seq"] == 1


def test_there_are_not_too_many_connections(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server, "MAX_CONNECTIONS", 2)
    with running() as here, browser(here), browser(here):
        refused = raw(here, b"")
        assert refused.startswith(b"HTTP/1.1 503 ")
        assert secure(refused)


def test_who_says_nothing_keeps_nobody_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server, "MAX_CONNECTIONS", 20)
    monkeypatch.setattr(server, "GRACE", 0.0)
    half = b"GET / HTTP/1.1\r\nHost: localhost\r\nX-Slow: "
    with running() as here, browser(here) as one, ExitStack() as stack:
        for number in range(60):  # half of them begin a request
            silent = socket.create_connection(("127.0.0.1", here.server.port), PATIENCE)
            stack.enter_context(closing(silent))
            silent.sendall(half if number % 2 else b"")
            if number % 10 == 0:
                assert httpx.get(f"{here.origin}/").status_code == 200
        here.do(here.server.tell, scene(1))
        assert of_kind(one, "scene")["seq"] == 1


def test_a_crowd_has_a_moment_to_speak(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server, "MAX_CONNECTIONS", 2)
    monkeypatch.setattr(server, "GRACE", server.PATIENCE)
    with running() as here, ExitStack() as stack:
        silent = [
            stack.enter_context(closing(socket.create_connection(("127.0.0.1", here.server.port))))
            for _ in range(2 * server.CROWD)
        ]
        assert raw(here, b"").startswith(b"HTTP/1.1 503 ")
        silent[0].settimeout(PATIENCE)
        silent[0].sendall(b"GET / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
        assert silent[0].recv(9) == b"HTTP/1.1 "


# --- messages -------------------------------------------------------------------------------


def frame(opcode: int, payload: bytes, *, last: bool = True) -> bytes:
    """A frame of a client, masked with zeros."""
    head = bytes([(128 if last else 0) | opcode])
    size = len(payload)
    if size < 126:
        head += bytes([128 | size])
    elif size < 65536:
        head += bytes([128 | 126]) + struct.pack(">H", size)
    else:
        head += bytes([128 | 127]) + struct.pack(">Q", size)
    return head + bytes(4) + payload


@contextmanager
def silent(here: Running) -> Iterator[socket.socket]:
    """A browser that reads nothing after the handshake, with small buffers."""
    with closing(socket.socket()) as one:
        one.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        one.settimeout(PATIENCE)
        one.connect(("127.0.0.1", here.server.port))
        head = (
            f"Connection: Upgrade\r\nSec-WebSocket-Key: {KEY}\r\nSec-WebSocket-Version: 13\r\n\r\n"
        )
        one.sendall((UPGRADE + head).encode())
        assert one.recv(12) == b"HTTP/1.1 101"
        yield one


def test_a_message_that_is_too_large_ends_the_connection(here: Running) -> None:
    with browser(here) as one:
        one.send(" " * (MAX_INCOMING + 1))
        assert closed(one) == 1009
    with browser(here) as one:
        one.send(" " * (MAX_INCOMING - 2) + "{}")
        assert of_kind(one, "trouble")["request"] is None


def test_a_message_in_parts_is_no_way_around(here: Running) -> None:
    with browser(here) as one:
        with suppress(ConnectionClosed):  # the server may close it before the last part is sent
            one.send(iter([" " * 1000] * (MAX_INCOMING // 1000 + 1)))
        assert closed(one) == 1009


@pytest.mark.parametrize("kind", [0, 9, 10])
def test_endless_parts_and_signs_of_life_end_the_connection(here: Running, kind: int) -> None:
    with silent(here) as one:
        begin = frame(1, b"", last=False) if kind == 0 else b""
        flood = begin + frame(kind, b"", last=kind != 0) * 1000
        with pytest.raises(OSError):  # reset, or a broken pipe
            one.sendall(flood * 1000)
    here.end_of_browsers()


def test_bytes_that_are_no_text_end_the_connection(here: Running) -> None:
    with browser(here) as one:
        one.send(b"\xff", text=True)
        assert closed(one) == 1007
    with browser(here) as one:
        one.send(b"{}")
        assert closed(one) == 1003


def test_a_flood_of_messages_ends_the_connection(here: Running) -> None:
    with browser(here) as one:
        try:
            for number in range(1000):
                one.send(json.dumps({"type": "ask", "request": f"r{number}", "text": "Why?"}))
        except ConnectionClosed:
            pass
        assert closed(one) == 4429
    assert len(here.source.of("ask")) < 100


def test_a_browser_that_draws_slowly_gets_fewer_scenes(here: Running) -> None:
    with browser(here) as one:
        for seq in range(50):
            here.do(here.server.tell, scene(seq))
        here.do(here.server.tell, STATUS)
        status = of_kind(one, "status")
        assert status["dropped"] == 50 - MAX_IN_FLIGHT - 1
        one.send(json.dumps({"type": "seen", "seq": MAX_IN_FLIGHT - 1}))
        assert of_kind(one, "scene")["seq"] == 49


def test_a_browser_that_reads_nothing_is_cut_off_and_holds_little(
    here: Running, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(server, "PARTING", 0.1)
    with silent(here) as one, browser(here) as other:
        large = Trouble(request=None, text="x" * 100_000)
        for _ in range(2 * MAX_WAITING // 100_000):
            here.do(here.server.tell, large)
            assert of_kind(other, "trouble")
        here.end_of_browsers(1)
        assert len(until_closed(one)) < MAX_WAITING
        here.do(here.server.tell, scene(1))
        assert of_kind(other, "scene")["seq"] == 1


# --- without the packages -------------------------------------------------------------------


@pytest.mark.parametrize("missing", ["starlette", "uvicorn", "websockets"])
def test_without_its_packages_it_says_which_extra_brings_them(missing: str, root: Path) -> None:
    code = (
        f"import sys; sys.modules[{missing!r}] = None\n"
        "import xavi_dialogue.dashboard.web.address\n"
        "try:\n    import xavi_dialogue.dashboard.web.server\n"
        "except ImportError as error:\n    print(error)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=False,
        cwd=root,
        env=os.environ | {"PYTHONPATH": str(root)},
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert "pip install starlette uvicorn websockets" in done.stdout


def test_nothing_of_strangers_is_logged(here: Running, caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.DEBUG):
        for request_, _ in REQUESTS:
            raw(here, request_)
        with browser(here) as one:
            one.send("nonsense")
            of_kind(one, "trouble")
    assert [r for r in caplog.records if r.levelno >= logging.WARNING] == []
