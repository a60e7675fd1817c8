"""Arguments of the library: checks of their kinds; an error names the argument."""

import math
import os
from numbers import Integral, Real
from pathlib import Path
from typing import get_args

from xavi_dialogue.bus.messages import MAX_TEXT
from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.library.errors import LibraryError
from xavi_dialogue.nlg.context import Style


def path_of(given: object, name: str = "path", wanted: str = "the path of a file") -> Path:
    """Return the path of a file.

    Raises:
        LibraryError: it is no path, or no file can have it.
    """
    try:
        written = os.fspath(given)  # type: ignore[call-overload]
        written = os.fsdecode(written)
        os.fsencode(written)
    except (TypeError, UnicodeError):
        raise LibraryError(f"{name} is {given!r}; give {wanted}") from None
    if not written or "\0" in written:
        raise LibraryError(f"{name} is {given!r}; give {wanted}")
    return Path(written)


def whole(given: object, name: str, wanted: str) -> int:
    """Return a whole number.

    Raises:
        LibraryError: it is none; the message says what is wanted.
    """
    if isinstance(given, bool) or not isinstance(given, Integral):
        raise LibraryError(f"{name} is {given!r}; give {wanted}")
    return int(given)


def real(given: object, name: str, wanted: str) -> float:
    """Return a number; infinity is one.

    Raises:
        LibraryError: it is none; the message says what is wanted.
    """
    value = math.nan if isinstance(given, bool) or not isinstance(given, Real) else float(given)
    if math.isnan(value):
        raise LibraryError(f"{name} is {given!r}; give {wanted}")
    return value


def question_of(given: object) -> str:
    """Return a question on one line, cut where it is too long.

    Raises:
        LibraryError: it is no text.
    """
    if not isinstance(given, str):
        raise LibraryError(f"the question is {given!r}; give a text")
    return one_line(given)[:MAX_TEXT]


def check_style(given: object) -> None:
    """Check the style of answers.

    Raises:
        LibraryError: there is no such style.
    """
    if given not in get_args(Style):
        raise LibraryError(f"there is no style {given!r}; use one of {get_args(Style)}")
