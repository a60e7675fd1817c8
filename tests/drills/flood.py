"""Somebody who means no good, and has the run of the bus.

    python -m tests.drills.flood HUB SEED

Sends nonsense to every key that others hear or serve, until its input ends; tells how much.
"""

import itertools
import random
import sys
import threading
import time
from collections.abc import Iterator

import msgspec

from xavi_dialogue.bus.interface import Bus, Keys, TransportError
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.messages import (
    AskRequest,
    EvidenceRequest,
    ForgetRequest,
    HistoryRequest,
    pack,
)
from xavi_dialogue.bus.zenoh_bus import join

READY = "ready"
PERIOD = 0.004  # [s] between messages
VICTIM = "ada"
HEARD = ("trace", "event", "scene", "dialogue/ada/turn")
SERVED = ("ask", "history", "cancel", "forget", "evidence", "whatif")
ESCAPES = "\x1b[2J\x1b]0;owned\x07\r\n\x9b31m\u202e"
DEEP = b"[" * 10_000 + b"]" * 10_000
LARGE = b'{"schema":"xavi.trace/1","ride":"' + b"a" * 5_000_000 + b'"}'


def payloads(dice: random.Random) -> Iterator[bytes]:
    """Nonsense of all kinds, over and over."""
    kinds = ("trace", "event_report", "scene", *SERVED)
    while True:
        kind = dice.choice(kinds)
        yield from (
            b"",
            dice.randbytes(200),
            b"\xff\xfe{}",
            b"null",
            DEEP,
            b'{"schema":"xavi.%s/1","sim_time":NaN}' % kind.encode(),
            b'{"schema":"xavi.%s/1","sim_time":1e999,"seq":-1}' % kind.encode(),
            b'{"schema":"xavi.%s/99"}' % kind.encode(),
            msgspec.json.encode({"schema": f"xavi.{kind}/1", "ride": ESCAPES, "session": ESCAPES}),
            msgspec.json.encode({"schema": ESCAPES * 20}),
        )


def forged(number: int) -> bytes:
    """An event that is well formed, of a ride that there never was."""
    event = {"kind": "arrived", "sim_time": 1.0}
    report = {"ride": f"r{number}", "seq": 10**9, "sim_time": 1e6, "wall_time": -1e300}
    return msgspec.json.encode({"schema": "xavi.event_report/1", "event": event, **report})


def requests(number: int) -> Iterator[tuple[str, bytes]]:
    """Well formed, of many sessions, and of one that belongs to somebody else."""
    text = f"{ESCAPES} Where are you going?"
    for other in range(3):
        asked, name = f"q{number}-{other}", f"s{(number + 333 * other) % 1000}"
        yield "ask", pack(AskRequest(request=asked, session=name, text=text, deadline_ms=50.0))
    yield "ask", pack(AskRequest(request=f"q{number}", session=VICTIM, text=text, token="x" * 32))
    yield "forget", pack(ForgetRequest(request=f"f{number}", session=VICTIM))
    yield "evidence", pack(EvidenceRequest(request=f"e{number}", trace_id=f"{number:016x}"))
    yield "history", pack(HistoryRequest(session=VICTIM, token="y" * 32))


def work(bus: Bus, dice: random.Random, over: threading.Event) -> int:
    """Send until it is over; how much was sent."""
    nonsense = payloads(dice)
    for number in itertools.count():
        ghost = Keys(f"ghost-{number % 1000}")
        keys = dice.choice((Keys("car"), Keys("car"), ghost, Keys("g" * 200)))
        try:
            if number % 3 == 0:
                bus.send(keys.of(dice.choice(HEARD)), next(nonsense))
            elif number % 3 == 1:
                ask(bus, keys.of(f"@rpc/{dice.choice(SERVED)}"), next(nonsense))
            else:
                for tail, payload in requests(number):
                    ask(bus, keys.of(f"@rpc/{tail}"), payload)
            bus.send(ghost.of("event"), forged(number))  # who may write a car's keys is the car
            if number % 100 == 0:
                bus.send(keys.of("trace"), LARGE)
                bus.send(Keys("car").of("scene/" + "k" * 4000), b"{}")
                ask(bus, Keys("*").of("@rpc/ask"), b"{}")
                ask(bus, "xavi/v1/**", b"{}")
                bus.appear(ghost.of("alive/car"))
        except TransportError:
            continue
        if over.wait(PERIOD):
            return number
    raise AssertionError


def ask(bus: Bus, key: str, payload: bytes) -> None:
    bus.request(key, payload, 1.0, lambda _: None)


def main() -> None:
    over = threading.Event()
    began = time.monotonic()
    with join(Link.to_hub(sys.argv[1])) as bus:
        sys.stdout.write(f"{READY}\n")
        sys.stdout.flush()
        threading.Thread(target=lambda: (sys.stdin.read(), over.set()), daemon=True).start()
        sent = work(bus, random.Random(sys.argv[2]), over)
    sys.stdout.write(f"{sent} in {time.monotonic() - began:.1f} s\n")


if __name__ == "__main__":
    main()
