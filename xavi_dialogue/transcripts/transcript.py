"""Transcripts: golden conversations as readable text.

    scenario: s1
    seed: 0

    @ 8.0s
    > Why did you change lanes?
    I changed to the left lane to get us there sooner. ...

A header, then moments that move time, questions, and replies of one or more lines. Before the
first moment, the time is the end of the first lane change or turn. Lines with # are comments.

Incidents have lines of their own; each holds until a line says otherwise:

    ! planner fails
    > What if vehicle 1 had not been there?
    My planner could not work that out, ...

    ! planner answers

See `Befallen` for what there is. Instead of scenario and seed, `trace: FILE` names one decision, or
a recorded ride, from the folder of the transcript.
"""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Literal, TypeAlias, get_args

from xavi_dialogue.process.exit_status import UsageFault

_MOMENT = re.compile(r"@\s*(\d{1,6}(?:\.\d{1,6})?)\s*s?")
_HEADER = re.compile(r"(\w+):\s*(.*)")
KEYS = ("scenario", "seed", "style", "trace")

Befallen: TypeAlias = Literal[
    "planner answers",  # as it does from the beginning
    "planner fails",  # planning again fails
    "planner late",  # planning again takes longer than the passenger waits
    "planner gone",  # no process plans again
    "no record",  # the traces of decisions are missing
    "record",  # all traces are available, as at the beginning
    "restart",  # the program ends, and continues later with the stored turns
    "meanwhile",  # the next question is asked while the planner works on the one before
]
BEFALLEN: tuple[Befallen, ...] = get_args(Befallen)


class TranscriptError(UsageFault):
    """A transcript that cannot be read."""


@dataclass(frozen=True, slots=True)
class At:
    """A line that moves time."""

    time: float  # [s]
    text: str  # as written


@dataclass(frozen=True, slots=True)
class Exchange:
    """A question and its reply."""

    question: str
    reply: str


@dataclass(frozen=True, slots=True)
class Comment:
    """A line that is kept as it is."""

    text: str


@dataclass(frozen=True, slots=True)
class Incident:
    """An incident that concerns the car."""

    what: Befallen


Step: TypeAlias = At | Exchange | Comment | Incident


@dataclass(frozen=True, slots=True)
class Transcript:
    """One conversation."""

    header: tuple[tuple[str, str], ...]
    steps: tuple[Step, ...]

    def get(self, key: str, default: str | None = None) -> str | None:
        """Return a value of the header."""
        return dict(self.header).get(key, default)


def moment(line: str) -> float | None:
    """Parse the time [s] of a line such as "@ 8.0s"; None for any other line."""
    match = _MOMENT.fullmatch(line.strip())
    return float(match[1]) if match else None


def read(text: str) -> Transcript:
    """Read a transcript.

    Raises:
        TranscriptError: with the number of the line that is wrong.
    """
    header: list[tuple[str, str]] = []
    steps: list[Step] = []
    lines = list(enumerate(text.splitlines(), 1))
    rest = iter(lines)
    for number, line in rest:
        if not line.strip():
            if header:
                break
            continue
        if line.startswith("#"):
            steps.append(Comment(line))
            continue
        match = _HEADER.fullmatch(line)
        if match is None or match[1] not in KEYS:
            raise TranscriptError(f"line {number}: the header has {', '.join(KEYS)}, not {line!r}")
        header.append((match[1], match[2]))
    steps += _steps(rest)
    return Transcript(tuple(header), tuple(steps))


def _steps(lines: Iterable[tuple[int, str]]) -> Iterator[Step]:
    question, reply = None, list[str]()
    for number, line in lines:
        begins = line.startswith((">", "@", "#", "!"))
        if begins and question is not None:
            yield Exchange(question, "\n".join(reply).strip())
            question, reply = None, []
        if line.startswith("@"):
            time = moment(line)
            if time is None:
                raise TranscriptError(f"line {number}: a moment is written @ 8.0s, not {line!r}")
            yield At(time, line)
        elif line.startswith("#"):
            yield Comment(line)
        elif line.startswith("!"):
            yield Incident(_befallen(number, line))
        elif line.startswith(">"):
            question = line[1:].strip()
        elif question is not None:
            reply.append(line)
        elif line.strip():
            raise TranscriptError(f"line {number}: a reply without a question: {line!r}")
    if question is not None:
        yield Exchange(question, "\n".join(reply).strip())


def _befallen(number: int, line: str) -> Befallen:
    wanted = line[1:].strip()
    for known in BEFALLEN:
        if wanted == known:
            return known
    raise TranscriptError(f"line {number}: after ! comes one of {', '.join(BEFALLEN)}")


def write(transcript: Transcript) -> str:
    """Return the transcript as text; `read` gives it back."""
    blocks = ["\n".join(f"{key}: {value}" for key, value in transcript.header)]
    before: Step | None = None
    for step in transcript.steps:
        match step:
            case Comment(text) if isinstance(before, Comment):
                blocks[-1] += "\n" + text
            case At(_, text) | Comment(text):
                blocks.append(text)
            case Incident(what):
                blocks.append(f"! {what}")
            case Exchange(question, reply):
                blocks.append(f"> {question}".rstrip() + f"\n{reply}")
        before = step
    return "\n\n".join(blocks) + "\n"
