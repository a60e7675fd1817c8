"""The end of the program by SIGTERM or SIGINT, as by an exception, so that resources are released.

Python raises the exception wherever the main thread happens to be. In a finaliser or a callback of
C it only reports and drops it, and the program would go on as if nobody had told it to end. In an
import, others may catch it or turn it into an error of their own. So the signal is sent again when
the exception was dropped, and until the import is over.
"""

import signal
import sys
import threading
from types import FrameType
from typing import Any

from xavi_dialogue.process.exit_status import ExitStatus

AGAIN = 0.05  # [s] until a signal is sent again
IMPORT = "importlib._bootstrap"


def end_on_signals() -> None:
    """Let SIGTERM raise SystemExit and SIGINT raise KeyboardInterrupt, until one gets through."""
    signal.signal(signal.SIGTERM, _end)
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:  # else it is ignored
        signal.signal(signal.SIGINT, _end)
    sys.unraisablehook = _watch


def let_asyncio_interrupt() -> None:
    """Give SIGINT back to Python: asyncio cancels its task only if nobody else handles it."""
    if signal.getsignal(signal.SIGINT) is _end:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _end(number: int, frame: FrameType | None) -> None:
    if _imports(frame):
        _send_again(number)
    elif number == signal.SIGINT:
        raise KeyboardInterrupt
    else:
        sys.exit(ExitStatus.TERMINATED)


def _imports(frame: FrameType | None) -> bool:
    """Tell whether a module is being imported in this frame or in one that called it."""
    while frame is not None and frame.f_globals.get("__name__") != IMPORT:
        frame = frame.f_back
    return frame is not None


def _watch(unraisable: Any) -> None:
    """Send a signal again if the exception that it raised was dropped."""
    number = _number_of(unraisable.exc_value)
    if number is None or threading.current_thread() is not threading.main_thread():
        sys.__unraisablehook__(unraisable)
    else:
        _send_again(number)


def _send_again(number: int) -> None:
    signal.signal(signal.SIGALRM, lambda *_: signal.raise_signal(number))
    signal.setitimer(signal.ITIMER_REAL, AGAIN)


def _number_of(error: BaseException | None) -> signal.Signals | None:
    if isinstance(error, KeyboardInterrupt):
        return signal.SIGINT
    if isinstance(error, SystemExit) and error.code == ExitStatus.TERMINATED:
        return signal.SIGTERM
    return None
