"""Who hands jobs to a pool of workers and takes the answers."""

import queue
import time
from collections.abc import Callable
from pathlib import Path

from xavi_dialogue.bus.messages import Failure
from xavi_dialogue.vehicle.worker_pool import Job, WorkerPool

PATIENCE = 30.0  # [s] before a test gives up on what never comes
LONG = 600.0  # [s] a deadline that is never met


def until(condition: Callable[[], bool]) -> bool:
    give_up = time.monotonic() + PATIENCE
    while time.monotonic() < give_up:
        if condition():
            return True
        time.sleep(0.01)
    return False


def there(pid: int) -> bool:
    """Whether there is a process; one that only its new parent has not noticed to end is not."""
    return _stat(pid)[:1] not in ([], ["Z"])


def remains(pid: int) -> bool:
    """Whether there is anything of a process, if only a zombie."""
    return bool(_stat(pid))


def children(pid: int) -> list[int]:
    """The processes that a process has started."""
    found = [int(path.name) for path in Path("/proc").glob("[0-9]*")]
    return sorted(child for child in found if _stat(child)[1:2] == [str(pid)])


def command(pid: int) -> bytes:
    """The command line of a process; each part ends with a zero."""
    return Path(f"/proc/{pid}/cmdline").read_bytes()


def _stat(pid: int) -> list[str]:
    """State, parent and so on; nothing where there is no such process."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return []


class PoolClient:
    """Hands jobs to a pool and takes the answers."""

    def __init__(self, pool: WorkerPool) -> None:
        self.pool = pool
        self.answers: dict[str, queue.SimpleQueue[bytes | Failure]] = {}

    def ask(self, order: str, within: float = LONG, name: str | None = None) -> None:
        answers = self.answers.setdefault(name or order, queue.SimpleQueue())
        self.pool.submit(Job(order.encode(), time.monotonic() + within, answers.put))

    def answer(self, name: str) -> bytes | Failure:
        return self.answers[name].get(timeout=PATIENCE)

    def reason(self, name: str) -> str:
        answer = self.answer(name)
        assert isinstance(answer, Failure)
        return answer.reason

    def pid(self) -> int:
        """The process of the one worker."""
        assert until(lambda: len(self.pool.pids) == 1)
        return self.pool.pids[0]
