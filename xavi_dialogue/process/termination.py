"""The end of the program by SIGTERM or SIGINT, as by an exception, so that resources are released.

Python raises the exception wherever the main thread happens to be. In a finaliser or a callback of
C it only reports and drops it, and the program would go on as if nobody had told it to end. So the
signal is sent again when that happens.
"""

import signal
import sys
import threading
from types import FrameType
from typing import Any

from xavi_dialogue.process.exit_status import ExitStatus

AGAIN = 0.05  # [s] until a signal whose exception was dropped is sent again


def end_on_signals() -> None:
    """Let SIGTERM raise SystemExit and SIGINT raise KeyboardInterrupt, until one gets through."""
    signal.signal(signal.SIGTERM, _terminate)
    sys.unraisablehook = _watch


def _terminate(_number: int, _frame: FrameType | None) -> None:
    sys.exit(ExitStatus.TERMINATED)


def _watch(unraisable: Any) -> None:
    """Send a signal again if the exception that it raised was dropped."""
    number = _number_of(unraisable.exc_value)
    if number is None or threading.current_thread() is not threading.main_thread():
        sys.__unraisablehook__(unraisable)
        return
    signal.signal(signal.SIGALRM, lambda *_: signal.raise_signal(number))
    signal.setitimer(signal.ITIMER_REAL, AGAIN)


def _number_of(error: BaseException | None) -> signal.Signals | None:
    if isinstance(error, KeyboardInterrupt):
        return signal.SIGINT
    if isinstance(error, SystemExit) and error.code == ExitStatus.TERMINATED:
        return signal.SIGTERM
    return None
