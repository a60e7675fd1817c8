"""Errors of the library; all that it raises derive from `XaviError`."""

from collections.abc import Iterator
from contextlib import contextmanager

from planner.errors import PlannerError
from sim.errors import SimError
from xavi_dialogue.errors import XaviError


class LibraryError(XaviError):
    """A ride cannot be driven, opened or asked about; the message says how to mend it."""


@contextmanager
def translated() -> Iterator[None]:
    """Raise errors of the simulation and the planner as errors of the library."""
    try:
        yield
    except (SimError, PlannerError) as error:
        raise LibraryError(str(error)) from error
