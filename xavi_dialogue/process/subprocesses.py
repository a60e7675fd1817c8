"""Child processes that end when their parent does.

Each reads its standard input, whose other end only the parent holds. It closes when the parent
ends, even if the parent is killed, and then the child ends (see child_commands.listen).
"""

import contextlib
import os
import signal
import subprocess
import sys
import threading
from collections import deque
from collections.abc import Callable, Sequence
from pathlib import Path
from types import TracebackType
from typing import Self

from xavi_dialogue.process import child_commands
from xavi_dialogue.process.exit_status import RunFault
from xavi_dialogue.process.log_setup import is_log
from xavi_dialogue.process.scratch import ScratchFolder

TOP = Path(__file__).parents[2]  # the root of the packages, in a checkout or installed
REMEMBERED = 20  # lines of a child's standard error
ORDERLY = 3.0  # [s] that a child may take to end by itself
FORCED = 1.0  # [s] that a child may take to end after SIGTERM
WARNING = "xavi: warning: "  # the prefix of lines for the passenger


class ChildFailed(RunFault):
    """A child process ended when it should not."""


class Child:
    """A child process that runs a command of `xavi`."""

    def __init__(
        self, name: str, arguments: Sequence[str], warn: Callable[[str], None] | None = None
    ) -> None:
        """Start the process.

        Args:
            name: for messages, such as "the car".
            arguments: of `xavi`; `--control` is added.
            warn: gets its warnings, on a thread.
        """
        self.name = name
        self.ordered = 0  # commands sent
        # -P keeps the working directory off the path: it may hold packages with the same names.
        command = [sys.executable, "-P", "-m", "xavi_dialogue", *arguments, "--control"]
        path = os.pathsep.join(filter(None, (str(TOP), os.environ.get("PYTHONPATH"))))
        self._scratch = ScratchFolder()
        try:
            self._process = subprocess.Popen(
                command,
                stdin=subprocess.PIPE,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                env={**_ours(), "PYTHONPATH": path, **self._scratch.environment},
                text=True,
                errors="replace",
                start_new_session=True,  # the terminal's signals are for the parent
            )
        except OSError:
            self._scratch.delete()
            raise
        self._warn = warn
        self._said: deque[str] = deque(maxlen=REMEMBERED)
        self._ear = threading.Thread(target=self._listen, daemon=True)
        self._ear.start()

    @property
    def pid(self) -> int:
        """The id of the process."""
        return self._process.pid

    def order(self, order: child_commands.Order) -> int:
        """Give an order.

        Returns:
            The number of commands sent so far.

        Raises:
            ChildFailed: the process has ended.
        """
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(child_commands.write(order) + "\n")
            self._process.stdin.flush()
        except (BrokenPipeError, ValueError):
            self.check()
            raise ChildFailed(f"{self.name} no longer takes commands") from None
        self.ordered += 1
        return self.ordered

    def check(self) -> None:
        """Check that the process runs.

        Raises:
            ChildFailed: it has ended; the message has its last lines.
        """
        code = self._process.poll()
        if code is not None:
            self._ear.join(FORCED)
            words = last_words(self._said)
            ended = f"{self.name} has ended ({_manner(code)})"
            raise ChildFailed(f"{ended}: {words.removeprefix('xavi: ')}" if words else ended)

    def stop(self) -> None:
        """End the process: by closing its input, else by SIGTERM, else by SIGKILL.

        One that was stopped by a signal goes on first, so that it ends in order.
        """
        process = self._process
        assert process.stdin is not None
        with contextlib.suppress(BrokenPipeError):
            process.stdin.close()
        process.send_signal(signal.SIGCONT)
        for patience, end in ((ORDERLY, process.terminate), (FORCED, process.kill)):
            try:
                process.wait(patience)
                break
            except subprocess.TimeoutExpired:
                end()
        process.wait()
        self._scratch.delete()
        self._ear.join(FORCED)
        assert process.stderr is not None
        process.stderr.close()

    def kill(self) -> None:
        """End the process at once."""
        self._process.kill()

    def _listen(self) -> None:
        assert self._process.stderr is not None
        with contextlib.suppress(ValueError):  # closed meanwhile
            for line in self._process.stderr:
                self._said.append(line.rstrip())
                if self._warn is not None and line.startswith(WARNING):
                    self._warn(line.removeprefix(WARNING).rstrip())

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.stop()


class RestartedChild:
    """A child that is restarted when it ends by itself."""

    def __init__(self, start: Callable[[], Child]) -> None:
        """Start it.

        Args:
            start: starts it.
        """
        self.spare = 0  # restarts left
        self._start, self._child = start, start()
        self._lock = threading.Lock()

    @property
    def pid(self) -> int:
        """The id of the present process."""
        return self._child.pid

    def check(self) -> None:
        """Check that the process runs; restart it if necessary.

        Raises:
            ChildFailed: it has ended too often.
        """
        with self._lock:
            try:
                self._child.check()
            except ChildFailed:
                if self.spare == 0:
                    raise
                self.spare -= 1
                self._child.stop()
                self._child = self._start()

    def kill(self) -> None:
        """End the present process at once, without a restart."""
        self.spare = 0
        self._child.kill()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.spare = 0
        self._child.stop()


class OptionalChild:
    """A child that is not essential: its end is reported once."""

    def __init__(self, child: Child, tell: Callable[[str], None]) -> None:
        """Watch it.

        Args:
            child: that is watched.
            tell: gets its end, with its last lines.
        """
        self.child = child
        self._tell: Callable[[str], None] | None = tell

    def check(self) -> None:
        """Report if it has ended."""
        try:
            self.child.check()
        except ChildFailed as error:
            tell, self._tell = self._tell, None
            if tell is not None:
                tell(f"{error}; the ride goes on without it")


def last_words(said: Sequence[str]) -> str:
    """Return the last line that is neither empty nor a log line; empty if there is none."""
    return next((line for line in reversed(said) if line.strip() and not is_log(line)), "")


def _ours() -> dict[str, str]:
    """Return the environment without variables that lead a child to another bus."""
    return {name: value for name, value in os.environ.items() if not name.startswith("XAVI_")}


def _manner(code: int) -> str:
    return f"signal {-code}" if code < 0 else f"exit status {code}"
