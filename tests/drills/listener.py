"""Somebody who listens to a car, and may be too slow for it.

    python -m tests.drills.listener HUB

The room for what it has not read yet is as small as the system allows. At the end of its input
it tells how much it heard.
"""

import sys
from collections import Counter

from xavi_dialogue.bus.interface import Keys
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.zenoh_bus import join

READY = "ready"


def main() -> None:
    heard: Counter[str] = Counter()
    keys = Keys()
    with join(Link.to_hub(f"{sys.argv[1]}#so_rcvbuf=4096")) as bus:
        for tail in ("scene", "trace", "event"):
            bus.subscribe(keys.of(tail), lambda key, _: heard.update([key]), kept=tail != "scene")
        sys.stdout.write(f"{READY}\n")
        sys.stdout.flush()
        sys.stdin.read()
    sys.stdout.write(f"{heard.total()}\n")


if __name__ == "__main__":
    main()
