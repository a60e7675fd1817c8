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
SOURCES = Path(__file__).parents[2] / "planner" / "kernels"
BESIDE = SOURCES / "__pycache__"
LENT = "xavi-kernels-"  # how the name of a place begins that goes with the process


def find_place() -> None:
    """Where numba would find no place for compiled kernels, lend it one until this process ends."""
    if place() is not None:
        return
    with contextlib.suppress(OSError):  # without any place; commands that need none work on
        os.environ[PLACE] = tempfile.mkdtemp(prefix=LENT)
        atexit.register(shutil.rmtree, os.environ[PLACE], ignore_errors=True)


def place() -> Path | None:
    """The folder in which compiled kernels are kept, or below which; None: there is none."""
    if PLACE in os.environ:
        return Path(os.environ[PLACE])
    return next((folder for folder in (BESIDE, _users_cache()) if writable(folder)), None)


def missing(folder: Path) -> tuple[str, ...]:
    """The files with kernels of which none is compiled below a folder since they were changed."""
    return tuple(
        source.name
        for source in sorted(SOURCES.glob("[a-z]*.py"))
        if not any(
            compiled.stat().st_mtime >= source.stat().st_mtime
            for compiled in folder.rglob(f"{source.stem}.*.nbi")
        )
    )


def _users_cache() -> Path:
    cache = os.environ.get("XDG_CACHE_HOME", "")
    return (Path(cache) if cache else Path.home() / ".cache") / "numba"


def writable(folder: Path) -> bool:
    """Whether files can be written into a folder, which may have to be made."""
    there = next(place for place in (folder, *folder.parents) if place.exists())
    return there.is_dir() and os.access(there, os.W_OK | os.X_OK)
