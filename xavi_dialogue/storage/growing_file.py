"""Files that one process writes and others may read meanwhile."""

import errno
import os
import stat
from pathlib import Path


def create(path: Path, overwrite: bool) -> int:
    """Create an empty file, readable by its owner alone, and return its descriptor.

    Raises:
        OSError: there is one already, or it cannot be created.
    """
    # O_NONBLOCK, because opening a pipe would wait for a reader.
    flags = os.O_CREAT | os.O_WRONLY | os.O_NONBLOCK | (0 if overwrite else os.O_EXCL)
    file = os.open(path, flags, 0o600)
    try:
        if not stat.S_ISREG(os.fstat(file).st_mode):
            raise OSError(errno.EINVAL, "it is not a file")
        os.fchmod(file, 0o600)
        os.ftruncate(file, 0)
    except OSError:
        os.close(file)
        raise
    return file


def write_at(file: int, place: int, data: bytes) -> None:
    """Write all of the data at a place, given in bytes from the start.

    Raises:
        OSError: the disk is full, or fails.
    """
    view = memoryview(data)
    while view:
        written = os.pwrite(file, view, place)
        place, view = place + written, view[written:]
