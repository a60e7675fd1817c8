"""Real processes for drills, and what is asked of them.

Every process carries a mark in its environment, and so do those that it starts: whoever is left
behind is found by it, whatever became of its parent.
"""

import os
import secrets
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).parents[2]
PATIENCE = 90.0  # [s] before a drill gives up on what never comes
DEADLINE = 10.0  # [s] for an answer: the product's
LATE = 3.0 * DEADLINE  # [s] for one on a machine that is busy with other things
EXIT = 3.0  # [s] for a process that is told to end: the product's
ENDED = 3.0 * EXIT
MARK = "DRILL"
SHARED_MEMORY = "/dev/shm/"


def until(condition: Callable[[], object], patience: float = PATIENCE) -> bool:
    """Whether something comes true within `patience` [s]."""
    give_up = time.monotonic() + patience
    while time.monotonic() < give_up:
        if condition():
            return True
        time.sleep(0.05)
    return bool(condition())


def free_endpoint() -> str:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return f"tcp/127.0.0.1:{probe.getsockname()[1]}"


def state_of(pid: int) -> str:
    """The letter that proc(5) has for the state of a process; empty where there is none."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return ""


def resident_bytes(pid: int) -> int:
    return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@dataclass
class Process:
    """One that a drill has started; what it writes is read from files."""

    popen: subprocess.Popen[str]
    out: Path
    err: Path

    @property
    def pid(self) -> int:
        return self.popen.pid

    @property
    def said(self) -> str:
        """What it wrote to its standard error."""
        return self.err.read_text(encoding="utf-8", errors="replace")

    @property
    def answers(self) -> list[str]:
        """Whole lines of its standard output."""
        return self.out.read_text(encoding="utf-8").split("\n")[:-1]

    def says(self, text: str) -> bool:
        """Whether a text appears on its standard error."""
        found = until(lambda: text in self.said or self.popen.poll() is not None)
        return found and text in self.said

    def order(self, *lines: str) -> None:
        """Write lines to its standard input."""
        assert self.popen.stdin is not None
        assert self.popen.poll() is None, self.said
        self.popen.stdin.write("".join(f"{line}\n" for line in lines))
        self.popen.stdin.flush()

    def hear(self, count: int, patience: float = PATIENCE) -> list[str]:
        """Its first so many lines, once they are there."""
        assert until(lambda: len(self.answers) >= count, patience), self.said
        return self.answers[:count]

    def end(self, number: int = signal.SIGTERM) -> int:
        """Its exit status after a signal."""
        self.popen.send_signal(number)
        return self.popen.wait(ENDED)

    def kill(self) -> None:
        self.popen.kill()
        self.popen.wait()


@dataclass
class Crew:
    """All processes of one drill."""

    folder: Path
    started: list[Process] = field(default_factory=list)
    mark: str = field(default_factory=lambda: secrets.token_hex(8))
    shared: set[Path] = field(default_factory=set)  # memory that was seen in use

    def xavi(self, *arguments: str, extra: Mapping[str, str] | None = None) -> Process:
        """Start a command of ours."""
        return self.python("-m", "xavi_dialogue", *arguments, extra=extra)

    def python(self, *arguments: str, extra: Mapping[str, str] | None = None) -> Process:
        """Start a program."""
        stem = self.folder / f"process-{len(self.started)}"
        out, err = stem.with_suffix(".out"), stem.with_suffix(".err")
        with out.open("w") as written, err.open("w") as told:
            popen = subprocess.Popen(
                [sys.executable, *arguments],
                stdin=subprocess.PIPE,
                stdout=written,
                stderr=told,
                text=True,
                cwd=ROOT,
                start_new_session=True,
                env={**self.environment(), **(extra or {})},
            )
        self.started.append(Process(popen, out, err))
        return self.started[-1]

    def environment(self) -> dict[str, str]:
        """Of our processes: nothing of the user's is read or written."""
        own = {k: v for k, v in os.environ.items() if not k.startswith("XAVI_")}
        homes = ("XDG_DATA_HOME", "XDG_STATE_HOME", "XDG_CONFIG_HOME")
        places = {name: str(self.folder / name.lower()) for name in homes}
        return {**own, **places, MARK: self.mark}

    def serve(
        self, endpoint: str, *arguments: str, extra: Mapping[str, str] | None = None
    ) -> Process:
        """A service that is ready."""
        process = self.xavi("serve", "--listen", endpoint, *arguments, extra=extra)
        assert process.says("serving at"), process.said
        return process

    def drive(
        self, endpoint: str, *arguments: str, extra: Mapping[str, str] | None = None
    ) -> Process:
        """A car that begins to join a bus."""
        return self.xavi("drive", "--connect", endpoint, *arguments, extra=extra)

    def there(self) -> dict[int, str]:
        """All processes with our mark, by number; zombies are none."""
        found = {}
        wanted = f"{MARK}={self.mark}".encode()
        for folder in Path("/proc").glob("[0-9]*"):
            try:
                if wanted in (folder / "environ").read_bytes().split(b"\0"):
                    command = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode()
                    found[int(folder.name)] = command
            except OSError:
                continue
        return {pid: command for pid, command in found.items() if state_of(pid) not in ("", "Z")}

    def pids(self, word: str) -> list[int]:
        """Those whose command has a word in it."""
        return [pid for pid, command in sorted(self.there().items()) if word in command]

    def dismiss(self) -> None:
        """End all, and see that each ends as it is told to and leaves nothing behind."""
        self.shared |= {path for pid in self.there() for path in _segments(pid)}
        running = [one for one in self.started if one.popen.poll() is None]
        for one in reversed(running):
            one.popen.terminate()
        for one in running:
            one.popen.wait(ENDED)

    def clear(self) -> None:
        """Kill whoever is left."""
        for pid in self.there():
            os.kill(pid, signal.SIGKILL)
        for one in self.started:
            one.popen.wait()
            if one.popen.stdin is not None:
                with suppress(BrokenPipeError):  # what was written to it came too late
                    one.popen.stdin.close()

    def leavings(self) -> list[str]:
        """What is left once all should have ended: processes, shared memory, tracebacks."""
        until(lambda: not self.there(), ENDED)
        left = [*self.there().values(), *(str(path) for path in self.shared if path.exists())]
        return left + [one.said for one in self.started if "Traceback" in one.said]


def _segments(pid: int) -> set[Path]:
    """Zenoh's files in shared memory that a process uses."""
    try:
        lines = Path(f"/proc/{pid}/maps").read_text().splitlines()
    except OSError:
        return set()
    return {Path(line.split()[-1]) for line in lines if SHARED_MEMORY in line}
