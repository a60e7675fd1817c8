"""Worker processes that grow search trees, while the car grows the first one.

A worker gets the moment and recognises the goals of others itself, as beliefs are larger than what
they come from. What it does not deliver in time, the car grows, too: the decision is the same.
"""

import contextlib
import logging
import pickle
import queue
import subprocess
import sys
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from planner.search.decide import Elsewhere, Pending
from planner.search.inputs import Moment
from planner.search.trees import GrownTree, trees_of
from xavi_dialogue.vehicle.search_worker import TreeOfRide, read_frame, write_frame

PATIENCE = 0.5  # [s] after the car's own tree, up to which a worker may be late

_LOG = logging.getLogger(__name__)


@contextmanager
def search_workers(network: Path, ride: TreeOfRide) -> Iterator[Elsewhere | None]:
    """Start a worker for each search tree after the first; None: there is only one tree.

    Args:
        network: file of the road network.
        ride: what the workers need to know, with any number of a tree.
    """
    trees = range(1, trees_of(ride.settings))
    if not trees:
        yield None
        return
    workers = [_Worker(network, replace(ride, tree=tree)) for tree in trees]

    def begin(moment: Moment) -> Sequence[Pending]:
        data = pickle.dumps(moment)
        return [worker.begin(data) for worker in workers]

    try:
        yield begin
    finally:
        for worker in workers:
            worker.end()


class _Worker:
    """One worker process; it is asked for a tree only if it has answered all before."""

    def __init__(self, network: Path, ride: TreeOfRide) -> None:
        self._process = subprocess.Popen(
            (sys.executable, "-m", "xavi_dialogue.vehicle.search_worker", str(network)),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            start_new_session=True,  # the terminal's signals are for the car
        )
        self._frames: queue.SimpleQueue[bytes | None] = queue.SimpleQueue()
        self._owed = 0  # frames that it has still to write
        self._gone = False
        threading.Thread(target=self._listen, name="search-trees", daemon=True).start()
        self._send(pickle.dumps(ride))

    def begin(self, moment: bytes) -> Pending:
        """Have a tree grown, and return a function that waits for it."""
        while self._owed and self._take(0.0):
            pass
        if self._owed or self._gone:
            return _nothing
        self._send(moment)
        return self._wait

    def end(self) -> None:
        """End the process at once, whatever it is doing."""
        self._gone = True
        self._process.kill()
        self._process.wait()
        assert self._process.stdin is not None
        with contextlib.suppress(OSError):
            self._process.stdin.close()

    def _send(self, data: bytes) -> None:
        """Send a frame on a separate thread, because the worker may not be reading."""
        self._owed += 1
        threading.Thread(target=self._write, args=(data,), daemon=True).start()

    def _write(self, data: bytes) -> None:
        assert self._process.stdin is not None
        with contextlib.suppress(OSError, ValueError):  # it has ended
            write_frame(self._process.stdin, data)

    def _listen(self) -> None:
        assert self._process.stdout is not None
        with self._process.stdout as stream:
            while (data := read_frame(stream)) is not None:
                self._frames.put(data)
        self._frames.put(None)

    def _wait(self) -> GrownTree | None:
        """Wait for the tree; None: it comes too late, or the worker has died."""
        data = self._take(PATIENCE)
        if not data:
            return None
        found: GrownTree = pickle.loads(data)
        return found

    def _take(self, patience: float) -> bytes | None:
        """Take a frame that the worker owes; None: it has not come within some time [s]."""
        try:
            data = self._frames.get(timeout=patience) if patience else self._frames.get_nowait()
        except queue.Empty:
            return None
        self._owed -= 1
        if data is None and not self._gone:
            _LOG.warning("a search worker has died: the car grows its search trees from now on")
            self._gone = True
        return data


def _nothing() -> GrownTree | None:
    """Deliver no tree: the worker is not ready."""
    return None
