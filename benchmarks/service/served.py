"""The dashboard as users start it, with a bus in this process."""

import os
import re
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from xavi_dialogue.bus.interface import Bus
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.zenoh_bus import host
from xavi_dialogue.process.subprocesses import ChildFailed, last_words

ADDRESS = re.compile(r"dashboard at (http://\S+)")
POLL = 0.05  # [s] between checks of its output
ENDING = 5.0  # [s] that it may take to end


@dataclass(frozen=True)
class Served:
    """A running dashboard, and the bus that it uses."""

    bus: Bus
    address: str
    pid: int

    def resident(self) -> int:
        """Return the memory of the dashboard's process that is in use [bytes]."""
        pages = int(Path(f"/proc/{self.pid}/statm").read_text(encoding="ascii").split()[1])
        return pages * os.sysconf("SC_PAGE_SIZE")


@contextmanager
def served() -> Iterator[Served]:
    """Yield a dashboard and a bus; both end with the context.

    Raises:
        ChildFailed: it does not come up.
        EndpointTaken: the port that was free for the bus is not any more.
    """
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        endpoint = f"tcp/127.0.0.1:{probe.getsockname()[1]}"
    with TemporaryDirectory() as folder, host(Link.of_hub(endpoint)) as bus:
        said = Path(folder) / "said"
        process = _started(endpoint, Path(folder), said)
        try:
            yield Served(bus, _address(process, said), process.pid)
        finally:
            process.terminate()
            try:
                process.wait(ENDING)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def _started(endpoint: str, folder: Path, said: Path) -> "subprocess.Popen[bytes]":
    arguments = ("dashboard", "--connect", endpoint, "--listen", "127.0.0.1:0", "--no-open")
    own = {name: value for name, value in os.environ.items() if not name.startswith("XAVI_")}
    homes = {f"XDG_{kind}_HOME": str(folder / kind) for kind in ("DATA", "STATE", "CONFIG")}
    with said.open("wb") as told:
        return subprocess.Popen(
            (sys.executable, "-m", "xavi_dialogue", *arguments),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=told,
            env={**own, **homes},
        )


def _address(process: "subprocess.Popen[bytes]", said: Path) -> str:
    """Return the address of the dashboard, by its output."""
    while True:
        ended = process.poll() is not None
        text = said.read_text(encoding="utf-8", errors="replace")
        found = ADDRESS.search(text)
        if found is not None:
            return found[1]
        if ended:
            last = last_words(text.splitlines()).removeprefix("xavi: ")
            raise ChildFailed(f"the dashboard has ended: {last}")
        time.sleep(POLL)
