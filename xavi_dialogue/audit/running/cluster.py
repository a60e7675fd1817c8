"""Workers of a Dask cluster that work on rides.

The scheduler gives the ride of a worker that dies to another one. What is under way is limited, so
that neither the scheduler nor this process holds many rides.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, Final

from xavi_dialogue.audit.errors import AuditError, AuditFailed, needing
from xavi_dialogue.audit.running.local import Result
from xavi_dialogue.audit.values import Failed
from xavi_dialogue.audit.work import Task, work

if TYPE_CHECKING:
    from distributed import Client

PATIENCE: Final = 10.0  # [s] for which the scheduler and a first worker are waited for
AHEAD: Final = 2  # tasks under way for each thread of the workers
PREFIX: Final = "xavi-"  # of the names of tasks
START: Final = "start them: dask scheduler, and dask worker ADDRESS --nthreads 1"


def run(tasks: Sequence[Task], address: str, lost: Callable[[], None]) -> Iterator[Result]:
    """Yield the result of each task as it comes.

    Args:
        tasks: what is to be done.
        address: of the scheduler.
        lost: called when a worker has gone.

    Raises:
        AuditError: no cluster answers there, or it has no worker.
        AuditFailed: the cluster broke off.
    """
    with needing("cluster", "pip install distributed"):
        from distributed.comm.core import CommClosedError
    if not tasks:
        return
    client = _connect(address)
    try:
        yield from _results(client, tasks, lost)
    except (OSError, CommClosedError) as error:
        raise AuditFailed(f"the cluster at {address} broke off: {error}") from error
    finally:
        client.close()


def _connect(address: str) -> "Client":
    from distributed import Client

    try:
        client = Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError) as error:
        why = f"no Dask scheduler answers at {address!r}"
        raise AuditError(f"{why}; give an address such as tcp://127.0.0.1:8786; {START}") from error
    try:
        client.wait_for_workers(1, timeout=PATIENCE)
    except TimeoutError as error:
        client.close()
        raise AuditError(f"the Dask scheduler at {address} has no worker; {START}") from error
    return client


def _results(client: "Client", tasks: Sequence[Task], lost: Callable[[], None]) -> Iterator[Result]:
    from distributed import as_completed

    waiting, running = list(reversed(tasks)), dict[str, Task]()
    known, width = _workers(client)
    completed = as_completed([], loop=client.loop)

    def submit() -> None:
        while waiting and len(running) < width:
            task = waiting.pop()
            running[task.key] = task
            completed.add(client.submit(work, task, key=f"{PREFIX}{task.key}", pure=False))

    submit()
    for count, future in enumerate(completed, 1):
        task = running.pop(future.key.removeprefix(PREFIX))
        yield task, _result(future)
        future.release()
        if count % len(known) == 0 or not running:  # seldom, as it asks the scheduler
            before, (known, width) = known, _workers(client)
            if before - known:
                lost()
        submit()


def _result(future: Any) -> Any:
    error = future.exception()
    if error is None:
        return future.result()
    if type(error).__name__ == "KilledWorker":
        return Failed("the workers that worked on it died; have they enough memory?")
    if isinstance(error, ImportError):
        raise AuditFailed(f"a worker cannot import this program: {error}; install it there")
    raise error


def _workers(client: "Client") -> tuple[set[str], int]:
    """Return the workers, and how many tasks should be under way."""
    found = client.scheduler_info(n_workers=-1)["workers"]
    return set(found) or {""}, AHEAD * max(sum(one["nthreads"] for one in found.values()), 1)
