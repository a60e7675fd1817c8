"""Work in a forked copy of this process, which goes on from the very same state.

A state saved by SUMO is wrong while a lane is being changed; a fork is exact. Only a process
that never opened Zenoh may be forked: its child would hang.
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
    """The work in the copy went wrong; the message is that of its error."""


class _Told(msgspec.Struct, frozen=True):
    """What a child tells its parent."""

    found: msgspec.Raw = msgspec.Raw(b"null")
    error: str | None = None


def in_fork(work: Callable[[], Found], kind: type[Found]) -> Found:
    """Return what work comes to in a copy of this process, in which it leaves no trace.

    Args:
        work: ends with a value that can be written as JSON.
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
    """Do the work, tell what it came to, and end without any of the parent's clean-up."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # ends it at once, with nothing told
    with suppress(AttributeError, OSError):  # where there is such a call, it ends with its parent
        ctypes.CDLL(None).prctl(END_WITH_PARENT, signal.SIGKILL)
    try:
        told = _Told(msgspec.Raw(msgspec.json.encode(work())))
    except BaseException as error:
        told = _Told(error=f"{type(error).__name__}: {error}")
    try:
        with os.fdopen(write, "wb") as pipe:
            pipe.write(msgspec.json.encode(told))
    finally:  # even where the parent is gone, this copy must not go on in its place
        os._exit(0)
