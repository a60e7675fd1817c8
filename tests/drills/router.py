"""A router of a fleet, which forwards and does nothing else.

    python -m tests.drills.router LISTEN [CONNECT ...]
    python -m tests.drills.router CONFIGURATION [CONNECT ...]

It runs until the end of its input.
"""

import sys
from pathlib import Path

from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.zenoh_bus import host

READY = "ready"


def main() -> None:
    place, connect = sys.argv[1], tuple(sys.argv[2:])
    if "/" in place and Path(place).is_file():
        link = Link.of_hub(None, connect, "router", Path(place))
    else:
        link = Link.of_hub(place, connect, "router")
    with host(link):
        sys.stdout.write(f"{READY}\n")
        sys.stdout.flush()
        sys.stdin.read()


if __name__ == "__main__":
    main()
