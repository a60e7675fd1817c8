"""The questions of an audit, and the moments at which they are asked.

A line is a question, which may end in `@ MOMENT`: a time [s], or a word of MOMENTS. A line that
begins with # is a comment.
"""

import math
import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Final, Literal, TypeAlias, get_args

import msgspec

from xavi_dialogue.audit.errors import AuditError
from xavi_dialogue.bus.messages import MAX_TEXT

#: After the hardest braking, after the closest call, or at the end of the ride.
Word: TypeAlias = Literal["braking", "closest", "end"]

MOMENTS: Final = get_args(Word)
_AT: Final = re.compile(r"\s*@\s*(?P<moment>[^@?]*)$")
_SECONDS: Final = re.compile(r"(\d+(?:\.\d+)?)\s*s?")


class Question(msgspec.Struct, frozen=True, order=True):
    """A question and when it is asked."""

    text: str
    moment: float | Word | None = None  # [s] or by word; None: when `Ride.ask` asks

    @property
    def when(self) -> str:
        """The moment as it is written."""
        if isinstance(self.moment, float):
            return f"{self.moment:g} s"
        return self.moment or ""

    def __str__(self) -> str:
        return f"{self.text} @ {self.when}" if self.when else self.text


DEFAULT: Final = (
    Question("Why did you do that?"),
    Question("Why did you brake?", "braking"),
    Question("Was that dangerous?", "closest"),
    Question("What did you get wrong?", "end"),
)


def read(line: str) -> Question:
    """Read a question.

    Raises:
        AuditError: it is empty, too long, or its moment is none.
    """
    found = _AT.search(line)
    text = (line[: found.start()] if found else line).strip()
    if not text:
        raise AuditError(f"{line!r} has no question before the moment; write: Why? @ 8")
    if len(text) > MAX_TEXT:
        raise AuditError(f"a question has at most {MAX_TEXT} characters; {text[:40]!r}... has more")
    return Question(text, _moment(found["moment"].strip(), line) if found else None)


def read_file(path: Path) -> tuple[Question, ...]:
    """Read the questions in a file, one in a line.

    Raises:
        AuditError: the file cannot be read, has no question, or one of them is wrong.
    """
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        why = error.strerror if isinstance(error, OSError) else "it is not UTF-8"
        raise AuditError(f"cannot read the questions of {path}: {why}") from error
    found = []
    for number, line in enumerate(lines, 1):
        if line.strip() and not line.lstrip().startswith("#"):
            try:
                found.append(read(line))
            except AuditError as error:
                raise AuditError(f"{path}, line {number}: {error}") from error
    if not found:
        raise AuditError(f"{path} has no question; write one in a line")
    return tuple(found)


def distinct(questions: Iterable[Question]) -> tuple[Question, ...]:
    """Return questions without those that come twice, in order."""
    return tuple(dict.fromkeys(questions))


def _moment(text: str, line: str) -> float | Word:
    word = _word(text, MOMENTS)
    if word is not None:
        return word
    seconds = _SECONDS.fullmatch(text)
    if seconds is not None and math.isfinite(float(seconds[1])):
        return float(seconds[1])
    known = ", ".join(MOMENTS)
    raise AuditError(f"{line!r}: {text!r} is no moment; give a time [s] such as 8, or {known}")


def _word(text: str, words: Sequence[Word]) -> Word | None:
    return next((word for word in words if word == text), None)
