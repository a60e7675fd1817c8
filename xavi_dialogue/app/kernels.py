"""Where the planner's compiled kernels are kept.

numba keeps them beside their source, else in the user's cache, and refuses where neither can be
written, as in a container without a home. There they are compiled anew for every command.
"""

import atexit
import contextlib
import os
import shutil
import tempfile
from pathlib import Path

PLACE = "NUMBA_CACHE_DIR"  # environment variable, inherited by the processes that we start
BESIDE = Path(__file__).parents[2] / "planner" / "kernels" / "__pycache__"


def find_place() -> None:
    """Where numba would find no place for compiled kernels, lend it one until this process ends."""
    if PLACE in os.environ or _writable(BESIDE) or _writable(_users_cache()):
        return
    with contextlib.suppress(OSError):  # without any place; commands that need none work on
        os.environ[PLACE] = tempfile.mkdtemp(prefix="xavi-kernels-")
        atexit.register(shutil.rmtree, os.environ[PLACE], ignore_errors=True)


def _users_cache() -> Path:
    cache = os.environ.get("XDG_CACHE_HOME", "")
    return Path(cache) if cache else Path.home() / ".cache"


def _writable(folder: Path) -> bool:
    """Whether files can be written into a folder, which may have to be made."""
    there = next(place for place in (folder, *folder.parents) if place.exists())
    return there.is_dir() and os.access(there, os.W_OK | os.X_OK)
