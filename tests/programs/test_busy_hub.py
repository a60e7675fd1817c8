"""A hub that reads nothing for a while, as its interpreter is held, and a car that goes on."""

import subprocess
import sys

import pytest

from tests.drills.processes import free_endpoint
from xavi_dialogue.bus.interface import Keys
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.zenoh_bus import join

pytestmark = pytest.mark.slow

REPORTS = 60
REPORT = b"x" * 250_000  # bytes; all of them are more than what the system holds on the way
KEYS = Keys("car")
#: Prints when the car comes and goes, reads nothing for three seconds, and counts the reports.
HUB = """
import ctypes, sys, threading
from xavi_dialogue.bus.interface import Keys
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.zenoh_bus import host

reports, keys, last = int(sys.argv[2]), Keys("car"), threading.Event()
heard = []

def hear(key, payload):
    heard.append(payload)
    if len(heard) == reports:
        last.set()

with host(Link.of_hub(sys.argv[1])) as bus:
    bus.watch(keys.of("alive/car"), lambda _, on: print("there" if on else "gone", flush=True))
    bus.subscribe(keys.of("trace"), hear, kept=True)
    print("up", flush=True)
    sys.stdin.readline()
    ctypes.PyDLL(None).usleep(3_000_000)
    last.wait(30.0)
    print(len(heard), flush=True)
    sys.stdin.readline()
"""


def test_a_hub_that_is_busy_keeps_its_link_to_the_car() -> None:
    endpoint = free_endpoint()
    hub = subprocess.Popen(
        [sys.executable, "-c", HUB, endpoint, str(REPORTS)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    assert hub.stdin is not None
    assert hub.stdout is not None
    with hub, hub.stdin:
        assert hub.stdout.readline() == "up\n"
        with join(Link.to_hub(endpoint)) as bus:
            reports = bus.publisher(KEYS.of("trace"), keep=REPORTS)
            bus.appear(KEYS.of("alive/car"))
            assert hub.stdout.readline() == "there\n"
            hub.stdin.write("\n")
            hub.stdin.flush()
            for _ in range(REPORTS):
                reports.put(REPORT)
            assert hub.stdout.readline() == f"{REPORTS}\n"  # and before it, the car was not gone
