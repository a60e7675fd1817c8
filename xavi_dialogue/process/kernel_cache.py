"""The cache folder of the planner's compiled kernels.

numba caches them beside their source, else in the user's cache, and fails if neither can be
written, as in a container without a home. Then every command compiles them again.
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
COMPILED = "njit("  # text that only files with kernels contain
LENT = "xavi-kernels-"  # prefix of a temporary folder that is deleted when the process ends


def find_place() -> None:
    """Give numba a temporary cache folder if it would find none."""
    if place() is not None:
        return
    with contextlib.suppress(OSError):  # commands that need no kernels still work
        os.environ[PLACE] = tempfile.mkdtemp(prefix=LENT)
        atexit.register(shutil.rmtree, os.environ[PLACE], ignore_errors=True)


def place() -> Path | None:
    """Return the folder of compiled kernels, or its parent; None if there is none."""
    if PLACE in os.environ:
        return Path(os.environ[PLACE])
    return next((folder for folder in (BESIDE, _users_cache()) if writable(folder)), None)


def missing(folder: Path) -> tuple[str, ...]:
    """Return the source files whose kernels are not cached in a folder since their last change."""
    return tuple(
        source.name
        for source in sorted(SOURCES.glob("[a-z]*.py"))
        if COMPILED in source.read_text(encoding="utf-8")
        and not any(
            compiled.stat().st_mtime >= source.stat().st_mtime
            for compiled in folder.rglob(f"{source.stem}.*.nbi")
        )
    )


def _users_cache() -> Path:
    cache = os.environ.get("XDG_CACHE_HOME", "")
    return (Path(cache) if cache else Path.home() / ".cache") / "numba"


def writable(folder: Path) -> bool:
    """Check whether files can be written to a folder, which may not exist yet."""
    there = next(place for place in (folder, *folder.parents) if place.exists())
    return there.is_dir() and os.access(there, os.W_OK | os.X_OK)
