"""Slow and many connections to a dashboard, and what becomes of a browser among them.

    python -m benchmarks.service.slow [--connections 500] [--seconds 60]

The dashboard runs as its users start it. A quarter of the connections says nothing, a quarter sends
the headers of a request byte by byte, a quarter opens the page's WebSocket and reads nothing, and a
quarter opens it, reads, answers pings, and says nothing. Each that is cut off comes back. Meanwhile
a browser loads the page again and again, and opens its WebSocket.
"""

import argparse
import asyncio
import sys
import time
from collections import Counter
from collections.abc import AsyncGenerator
from contextlib import aclosing, suppress
from dataclasses import dataclass, field
from urllib.parse import urlsplit

from benchmarks.figures import quantile
from benchmarks.service.served import Served, served

PAUSE = 0.2  # [s] between bytes, and before a connection that was cut off is opened again
PATIENCE = 10.0  # [s] for the browser's page, and for its welcome
EVERY = 0.25  # [s] between loads of the page
AGAIN = 4.0  # [s] until a page that was refused tries its WebSocket again, as the page does
HEAD = "GET / HTTP/1.1\r\nHost: {host}\r\nX-Slow: {filling}"
UPGRADE = (
    "GET /ws HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nUpgrade: websocket\r\n"
    "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
)
TEXT, CLOSE, PING, PONG = 1, 8, 9, 10  # kinds of frames (RFC 6455)
ANSWERED = {CLOSE: CLOSE, PING: PONG}
LENGTHS = {126: 2, 127: 8}  # bytes of a long frame's length
HERE = b'{"type": "here"}'
PAGE = "GET / HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n"


@dataclass
class Tally:
    """What became of the connections."""

    outcomes: Counter[str] = field(default_factory=Counter)  # of the browser, by status
    welcomes: Counter[str] = field(default_factory=Counter)  # of its WebSockets
    waited: list[float] = field(default_factory=list)  # [s] from its first try to each welcome
    taken: list[float] = field(default_factory=list)  # [s] of each page that came
    cut: Counter[str] = field(default_factory=Counter)  # connections that were cut off


async def _attack(kind: str, host: str, port: int, tally: Tally) -> None:
    while True:
        with suppress(OSError, asyncio.IncompleteReadError):
            await (_be_mute(host, port) if kind == "mute" else _linger(kind, host, port))
        tally.cut[kind] += 1
        await asyncio.sleep(PAUSE)


async def _be_mute(host: str, port: int) -> None:
    async for _ in _read(host, port):  # which answers pings
        pass


async def _linger(kind: str, host: str, port: int) -> None:
    reader, writer = await asyncio.open_connection("127.0.0.1", port, limit=4096)
    try:
        await _dawdle(kind, host, reader, writer)
    finally:
        writer.close()


async def _dawdle(
    kind: str, host: str, reader: asyncio.StreamReader, writer: asyncio.StreamWriter
) -> None:
    if kind == "slow":
        for sign in HEAD.format(host=host, filling="a" * 10_000):
            if reader.at_eof():
                return
            writer.write(sign.encode())
            await writer.drain()
            await asyncio.sleep(PAUSE)
    elif kind == "unread":
        writer.write(UPGRADE.format(host=host).encode())
        await reader.readline()
        while not reader.at_eof():
            await asyncio.sleep(PAUSE)
    else:
        await reader.read()


async def _browse(host: str, port: int, seconds: float, tally: Tally) -> None:
    until = time.monotonic() + seconds
    while (began := time.monotonic()) < until:
        status = "late"
        with suppress(TimeoutError):
            async with asyncio.timeout(PATIENCE):
                status = await _page(host, port)
        tally.outcomes[status] += 1
        if status == "200":
            tally.taken.append(time.monotonic() - began)
        await asyncio.sleep(EVERY)


async def _read(host: str, port: int, first: bytes = b"") -> AsyncGenerator[tuple[int, bytes]]:
    """Open the page's WebSocket, say something, and yield the frames that come."""
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    try:
        writer.write(UPGRADE.format(host=host).encode())
        await reader.readuntil(b"\r\n\r\n")
        if first:
            writer.write(_frame(TEXT, first))
        while True:
            kind, size = await reader.readexactly(2)
            if size in LENGTHS:
                size = int.from_bytes(await reader.readexactly(LENGTHS[size]))
            data = await reader.readexactly(size)
            if kind & 15 in ANSWERED:
                writer.write(_frame(ANSWERED[kind & 15], data))
            yield kind & 15, data
    finally:
        writer.close()


def _frame(kind: int, data: bytes) -> bytes:
    """Return a short frame of a client, masked with zeros."""
    return bytes((128 | kind, 128 | len(data), 0, 0, 0, 0)) + data


async def _look_on(host: str, port: int, seconds: float, tally: Tally) -> None:
    until = time.monotonic() + seconds
    while (began := time.monotonic()) < until:
        while (how := await _welcomed(host, port)) != "welcome" and time.monotonic() < until:
            tally.welcomes[how] += 1
            await asyncio.sleep(AGAIN)
        tally.welcomes[how] += 1
        tally.waited.append(time.monotonic() - began)
        await asyncio.sleep(AGAIN)


async def _welcomed(host: str, port: int) -> str:
    try:
        async with asyncio.timeout(PATIENCE), aclosing(_read(host, port, HERE)) as frames:
            kind, data = await anext(frames)
            return "welcome" if kind == TEXT else str(int.from_bytes(data[:2]))
    except (OSError, TimeoutError, asyncio.IncompleteReadError) as error:
        return type(error).__name__


async def _page(host: str, port: int) -> str:
    try:
        reader, writer = await asyncio.open_connection("127.0.0.1", port)
        writer.write(PAGE.format(host=host).encode())
        got = await reader.read()
        writer.close()
    except OSError as error:
        return type(error).__name__
    return got[9:12].decode() if got else "cut off"


async def _measure(server: Served, connections: int, seconds: float, tally: Tally) -> None:
    address = urlsplit(server.address)
    host, port = address.netloc, address.port or 80
    kinds = ("silent", "slow", "unread", "mute")
    attackers = [
        asyncio.create_task(_attack(kinds[number % len(kinds)], host, port, tally))
        for number in range(connections)
    ]
    await asyncio.gather(_browse(host, port, seconds, tally), _look_on(host, port, seconds, tally))
    for one in attackers:
        one.cancel()


def main() -> int:
    """Run the command; 0 where the browser got each page, and a welcome in the end."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.service.slow")
    parser.add_argument("--connections", type=int, default=500)
    parser.add_argument("--seconds", type=float, default=60.0)
    asked = parser.parse_args()
    for connections in (0, asked.connections):
        tally = Tally()
        with served() as server:
            before = server.resident()
            asyncio.run(_measure(server, connections, asked.seconds, tally))
            grown = (server.resident() - before) / 1e6
        times = [1000.0 * one for one in tally.taken] or [0.0]
        sys.stdout.write(
            f"{connections} others: pages {dict(tally.outcomes)},"
            f" p50 {quantile(times, 50):.0f} ms, p99 {quantile(times, 99):.0f} ms;"
            f" WebSockets {dict(tally.welcomes)}, {max(tally.waited, default=0.0):.1f} s at most;"
            f" cut off {dict(tally.cut)}; {grown:.1f} MB more\n"
        )
        sys.stdout.flush()
    return 0 if set(tally.outcomes) == {"200"} and tally.welcomes["welcome"] else 1


if __name__ == "__main__":
    sys.exit(main())
