"""Exit statuses of commands, and the errors that commands report."""

from enum import IntEnum
from typing import Protocol

from xavi_dialogue.errors import XaviError


class Told(Protocol):
    """A reply to a question, or an answer of the library."""

    @property
    def kind(self) -> str:
        """Answer, refusal or clarification."""

    @property
    def reason(self) -> str | None:
        """Why it was not answered."""


class UsageFault(XaviError, ValueError):
    """Invalid input of the user; the message says how to correct it."""


class RunFault(XaviError, RuntimeError):
    """A command failed; the message says why."""


class ExitStatus(IntEnum):
    """Exit statuses of `xavi`."""

    ANSWERED = 0  # also small talk and help
    FAILED = 1  # an internal error, or a broken installation
    USAGE = 2
    DECLINED = 3  # also if the car asked back
    NOT_UNDERSTOOD = 4
    PLANNER_UNAVAILABLE = 5
    TIMED_OUT = 6
    INTERRUPTED = 130
    TERMINATED = 143


def status_of(reply: Told) -> ExitStatus:
    """Return the exit status for a reply."""
    if reply.kind == "answer":
        return ExitStatus.ANSWERED
    match reply.reason:
        case "not-understood":
            return ExitStatus.NOT_UNDERSTOOD
        case "planner-unavailable":
            return ExitStatus.PLANNER_UNAVAILABLE
        case "timed-out":
            return ExitStatus.TIMED_OUT
    return ExitStatus.DECLINED
