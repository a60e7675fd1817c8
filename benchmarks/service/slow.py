"""Slow and many connections to a dashboard, and what becomes of a browser among them.

    python -m benchmarks.service.slow [--connections 500] [--seconds 30]

The dashboard runs as its users start it. A third of the connections say nothing, a third sends the
headers of a request byte by byte, and a third opens the page's WebSocket and reads nothing; whoever
is cut off comes back. Meanwhile a browser loads the page again and again.
"""

import argparse
import asyncio
import sys
import time
from collections import Counter
from contextlib import suppress
from dataclasses import dataclass, field
from urllib.parse import urlsplit

from benchmarks.figures import quantile
from benchmarks.service.served import Served, served

PAUSE = 0.2  # [s] between bytes, and before who was cut off comes back
PATIENCE = 10.0  # [s] for the browser's page
EVERY = 0.25  # [s] between loads of the page
HEAD = "GET / HTTP/1.1\r\nHost: {host}\r\nX-Slow: {filling}"
UPGRADE = (
    "GET /ws HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nUpgrade: websocket\r\n"
    "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
)
PAGE = "GET / HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n"


@dataclass
class Tally:
    """What became of the connections."""

    outcomes: Counter[str] = field(default_factory=Counter)  # of the browser, by status
    taken: list[float] = field(default_factory=list)  # [s] of each page that came
    cut: Counter[str] = field(default_factory=Counter)  # connections that were cut off


async def _attack(kind: str, host: str, port: int, tally: Tally) -> None:
    while True:
        with suppress(OSError, asyncio.IncompleteReadError):
            reader, writer = await asyncio.open_connection("127.0.0.1", port, limit=4096)
            try:
                await _dawdle(kind, host, reader, writer)
            finally:
                writer.close()
        tally.cut[kind] += 1
        await asyncio.sleep(PAUSE)


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
    kinds = ("silent", "slow", "unread")
    attackers = [
        asyncio.create_task(_attack(kinds[number % len(kinds)], host, port, tally))
        for number in range(connections)
    ]
    await _browse(host, port, seconds, tally)
    for one in attackers:
        one.cancel()


def main() -> int:
    """Run the command; 0 where the browser got each page."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.service.slow")
    parser.add_argument("--connections", type=int, default=500)
    parser.add_argument("--seconds", type=float, default=30.0)
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
            f" cut off {dict(tally.cut)}; {grown:.1f} MB more\n"
        )
        sys.stdout.flush()
    return 0 if set(tally.outcomes) == {"200"} else 1


if __name__ == "__main__":
    sys.exit(main())
