"""The temporary folder of a child process: deleted with it, even if the child was killed.

A process that is killed deletes nothing, so its parent does. If the parent is killed, the child
does when it ends.
"""

import atexit
import os
import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path

PLACE = "XAVI_SCRATCH"  # environment variable of a child: its folder
PREFIX = "xavi-"


class ScratchFolder:
    """A temporary folder that a child process writes its temporary files to."""

    def __init__(self) -> None:
        """Make the folder."""
        self.path = Path(tempfile.mkdtemp(prefix=PREFIX))

    @property
    def environment(self) -> Mapping[str, str]:
        """The variables that lead the child there."""
        return {PLACE: str(self.path), "TMPDIR": str(self.path)}

    def delete(self) -> None:
        """Delete the folder, once the child has ended; deleting it twice does nothing."""
        shutil.rmtree(self.path, ignore_errors=True)


def delete_at_exit() -> None:
    """Have this process delete its folder at its end, if its parent made one for it."""
    if PLACE in os.environ:
        atexit.register(delete_own)


def delete_own() -> None:
    """Delete the folder of this process now, if its parent made one for it."""
    if PLACE in os.environ:
        shutil.rmtree(os.environ[PLACE], ignore_errors=True)
