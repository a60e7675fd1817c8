"""The history of a session, which can be listed, saved to a file, and erased."""

import os
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import TypeAlias

import msgspec

from xavi_dialogue.bus.messages import PastTurn
from xavi_dialogue.bus.sanitize import clean, one_line
from xavi_dialogue.chat.client import Client, ServiceLost
from xavi_dialogue.terminal import slash_commands
from xavi_dialogue.terminal.slash_commands import CommandError
from xavi_dialogue.transcripts import transcript
from xavi_dialogue.transcripts.transcript import At, Exchange, Transcript

NOTHING = "Nothing has been said in this session yet."
JSON_LINES = ".jsonl"

Forget: TypeAlias = Callable[[], None]  # raises OSError


@dataclass(frozen=True)
class SessionHistory:
    """The conversation of one session; its methods wait for the service.

    All methods raise CommandError if the history is not available.
    """

    client: Client
    session: str
    header: tuple[tuple[str, str], ...]  # of transcripts
    forget_typed: Forget | None = None  # erases the input history on this machine

    def why(self) -> str:
        """Return the question "why?" about the latest answer, or else about the latest action."""
        return slash_commands.WHY if self._turns() else slash_commands.WHY_DONE

    def told(self) -> str:
        """Format the turns for a passenger."""
        return "\n\n".join(map(_written, _steps(self._turns()))) or NOTHING

    def save(self, name: str, now: datetime) -> str:
        """Write the turns to a new file.

        Args:
            name: of the file: JSON lines if it ends in .jsonl, else a transcript. If empty, a name
                is made from the session's name and the time.
            now: the time.

        Returns:
            A note about what was done.

        Raises:
            CommandError: the session is empty, or the file exists or cannot be written.
        """
        turns = self._turns()
        if not turns:
            raise CommandError(f"{NOTHING} There is nothing to save.")
        file = _file(name or f"{self.session}-{now:%Y%m%d-%H%M%S}.txt")
        if file.suffix == JSON_LINES:
            text = "".join(f"{msgspec.json.encode(turn).decode()}\n" for turn in turns)
        else:
            text = transcript.write(Transcript(self.header, tuple(_steps(turns))))
        _create(file, text)
        return f"Saved {_counted(len(turns))} to {clean(str(file))}."

    def forget(self) -> str:
        """Erase the session; return a note with the number of turns."""
        try:
            erased = self.client.forget()
            if self.forget_typed is not None:
                self.forget_typed()
        except ServiceLost as error:
            raise CommandError(f"Nothing is erased: {error}.") from error
        except OSError as error:
            raise CommandError(f"What you typed is not erased: {error.strerror}.") from error
        if not erased.forgotten:
            raise CommandError("Not all of it could be erased from the disk. Please try again.")
        return (
            f"Erased {_counted(erased.turns)}." if erased.turns else "There was nothing to erase."
        )

    def _turns(self) -> tuple[PastTurn, ...]:
        try:
            return self.client.history()
        except ServiceLost as error:
            raise CommandError(f"The conversation is not available: {error}.") from error


def _steps(turns: Iterable[PastTurn]) -> Iterator[At | Exchange]:
    at = None
    for turn in turns:
        time = round(turn.reply.sim_time, 3)
        if time != at:
            at = time
            yield At(time, f"@ {time}s")
        yield Exchange(one_line(turn.text), clean(turn.reply.text))


def _written(step: At | Exchange) -> str:
    match step:
        case At(_, text):
            return text
        case Exchange(question, reply):
            return f"> {question}\n{reply}"


def _counted(turns: int) -> str:
    return "one question and its answer" if turns == 1 else f"{turns} questions and their answers"


def _file(name: str) -> Path:
    try:
        return Path(name).expanduser()
    except RuntimeError as error:
        raise CommandError(f"There is no place {clean(name)}: {error}") from error


def _create(file: Path, text: str) -> None:
    """Write a new file that only its owner can read, completely or not at all."""
    try:
        made = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
        try:
            with os.fdopen(made, "wb") as new:
                new.write(text.encode())
        except OSError:
            file.unlink()
            raise
    except FileExistsError:
        raise CommandError(
            f"There is a file {clean(str(file))} already; it stays as it is. Name another."
        ) from None
    except OSError as error:
        raise CommandError(f"{clean(str(file))} cannot be written: {error.strerror}.") from error
