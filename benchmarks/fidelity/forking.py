"""Work in a forked copy of this process, which continues from exactly the same state.

A state saved by SUMO is wrong during a lane change; a fork is exact. A process that has opened
Zenoh must not be forked: its child would hang.
"""

import ctypes
import os
import signal
from collections.abc import Callable
from contextlib import suppress
from typing import TypeVar

import msgspec

END_WITH_PARENT = 1  # PR_SET_PDEATHSIG of prctl

Found = TypeVar("Found")


class ChildFailed(Exception):
    """The work in the copy failed; the message is that of its error."""


class _Told(msgspec.Struct, frozen=True):
    """The message of a child to its parent."""

    found: msgspec.Raw = msgspec.Raw(b"null")
    error: str | None = None


def in_fork(work: Callable[[], Found], kind: type[Found]) -> Found:
    """Return the result of work in a copy of this process, which itself stays unchanged.

    Args:
        work: returns a value that can be written as JSON.
        kind: of that value.

    Raises:
        ChildFailed: it raised an error, or its process died.
    """
    read, write = os.pipe()
    child = os.fork()
    if child == 0:  # pragma: no cover - another process
        os.close(read)
        _tell(write, work)
    os.close(write)
    try:
        with os.fdopen(read, "rb") as pipe:
            data = pipe.read()
    except BaseException:
        os.kill(child, signal.SIGKILL)
        raise
    finally:
        os.waitpid(child, 0)
    if not data:
        raise ChildFailed("its process died")
    told = msgspec.json.decode(data, type=_Told)
    if told.error is not None:
        raise ChildFailed(told.error)
    return msgspec.json.decode(told.found, type=kind)


def _tell(write: int, work: Callable[[], Found]) -> None:  # pragma: no cover - another process
    """Do the work, send its result, and end without any of the parent's clean-up."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # ends it at once, without a result
    with suppress(AttributeError, OSError):  # systems may lack this call; it ends with its parent
        ctypes.CDLL(None).prctl(END_WITH_PARENT, signal.SIGKILL)
    try:
        told = _Told(msgspec.Raw(msgspec.json.encode(work())))
    except BaseException as error:
        told = _Told(error=f"{type(error).__name__}: {error}")
    try:
        with os.fdopen(write, "wb") as pipe:
            pipe.write(msgspec.json.encode(told))
    finally:  # even if the parent is gone, this copy must not continue the parent's work
        os._exit(0)
