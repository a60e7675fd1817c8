"""XAVI Dialogue: a car that answers its passengers from its own planner's record.

    import xavi_dialogue as xavi

    ride = xavi.drive("s1", seed=3)
    print(ride.ask("Why did you change left?"))

docs/library.md describes the names of `__all__`, which are loaded when they are first used.
"""

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from xavi_dialogue.library.names import (
        Answer,
        Belief,
        Car,
        Conversation,
        Curves,
        Decision,
        Event,
        Evidence,
        Option,
        Picture,
        Report,
        Ride,
        Scene,
        Trajectory,
        XaviError,
        connect,
        connect_async,
        drive,
        open,  # noqa: A004 - as in PIL.Image
    )

__all__ = [
    "Answer",
    "Belief",
    "Car",
    "Conversation",
    "Curves",
    "Decision",
    "Event",
    "Evidence",
    "Option",
    "Picture",
    "Report",
    "Ride",
    "Scene",
    "Trajectory",
    "XaviError",
    "__version__",
    "connect",
    "connect_async",
    "drive",
    "open",
]

__version__ = "0.1.0"

# Matrices here are small: threads of the linear algebra would only slow each other down.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

if not TYPE_CHECKING:  # type checkers know the names, and find misspelt ones

    def __getattr__(name: str) -> object:
        if name not in __all__:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        from xavi_dialogue.library import names

        return getattr(names, name)

    def __dir__() -> list[str]:
        return sorted({*globals(), *__all__})
