"""The folder of an audit: each result under the hash of all that decides it.

A result is written beside its place and then moved there, so that it is whole or not there at all.
One that cannot be read counts as not there.
"""

import gzip
import hashlib
import zlib
from pathlib import Path
from typing import Final, TypeVar

import msgspec

from xavi_dialogue.audit.errors import AuditError, AuditFailed
from xavi_dialogue.audit.program import digest
from xavi_dialogue.audit.questions import Question
from xavi_dialogue.audit.sources import Source
from xavi_dialogue.audit.values import Answered, Cost, Done, Facts
from xavi_dialogue.audit.work import Task
from xavi_dialogue.storage.ride_file import ENDING

RIDES: Final = "rides"
FACTS: Final = "facts"
ANSWERS: Final = "answers"
COSTS: Final = "costs.jsonl"  # what was measured; no part of the results
DIGITS: Final = 32  # of a key

Kept = TypeVar("Kept")


class _CostLine(msgspec.Struct):
    ride: str
    cost: Cost


class Store:
    """The results in a folder."""

    def __init__(self, folder: Path) -> None:
        """Open or make the folder.

        Raises:
            AuditError: it cannot be made.
        """
        self.folder = folder
        try:
            for name in (RIDES, FACTS, ANSWERS):
                (folder / name).mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise AuditError(f"cannot make the folder {folder}: {error.strerror}") from error

    def ride(self, key: str) -> Path:
        """Return the place of a ride."""
        return self.folder / RIDES / f"{key}{ENDING}"

    def task(self, program: str, source: Source, questions: tuple[Question, ...]) -> Task:
        """Return what is to be done about a ride, with what is known of it."""
        ride, answers = keys(program, source, questions)
        facts = self.facts(ride)
        data = self._ride_of(ride, facts) if source.seed is not None else None
        if source.seed is not None and data is None:
            facts = None
        return Task(answers, program, source, questions, data, facts)

    def facts(self, key: str) -> Facts | None:
        """Return the facts of a ride, if they are known."""
        return self._read(FACTS, key, Facts)

    def answers(self, key: str) -> tuple[Answered, ...] | None:
        """Return the answers of a ride, if they are known."""
        return self._read(ANSWERS, key, tuple[Answered, ...])

    def keep(self, task: Task, done: Done) -> None:
        """Write what a worker found.

        Raises:
            AuditFailed: it cannot be written.
        """
        key, _ = keys(task.program, task.source, task.questions)
        try:
            if done.ride is not None:
                _write(self.ride(key), done.ride)
            if done.facts is not None:
                _write(self._place(FACTS, key), _packed(done.facts))
            _write(self._place(ANSWERS, task.key), _packed(done.answers))
            with (self.folder / COSTS).open("ab") as file:
                file.write(msgspec.json.encode(_CostLine(task.source.ride, done.cost)) + b"\n")
        except OSError as error:
            raise AuditFailed(f"cannot write to {self.folder}: {error.strerror}") from error

    def write(self, name: str, data: bytes) -> None:
        """Write a file of the folder.

        Raises:
            AuditFailed: it cannot be written.
        """
        try:
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            _write(self.folder / name, data)
        except OSError as error:
            raise AuditFailed(f"cannot write {self.folder / name}: {error.strerror}") from error

    def read(self, name: str) -> bytes:
        """Return a file of the folder; nothing if it cannot be read."""
        try:
            return (self.folder / name).read_bytes()
        except OSError:
            return b""

    def whole(self, key: str, facts: Facts) -> bool:
        """Check whether a ride is stored as it was."""
        return self._ride_of(key, facts) is not None

    def _ride_of(self, key: str, facts: Facts | None) -> bytes | None:
        """Return a ride that is stored whole."""
        try:
            data = self.ride(key).read_bytes()
        except OSError:
            return None
        whole = facts is not None and hashlib.sha256(data).hexdigest() == facts.ride_hash
        return data if whole else None

    def _place(self, kind: str, key: str) -> Path:
        return self.folder / kind / f"{key}.json.gz"

    def _read(self, kind: str, key: str, shape: type[Kept]) -> Kept | None:
        try:
            data = gzip.decompress(self._place(kind, key).read_bytes())
            return msgspec.json.decode(data, type=shape)
        except (OSError, EOFError, RecursionError, ValueError, zlib.error):
            return None


def keys(program: str, source: Source, questions: tuple[Question, ...]) -> tuple[str, str]:
    """Return the keys of a ride and of its answers."""
    ride = digest(program.encode(), source.key)[:DIGITS]
    asked = msgspec.json.encode(questions)
    return ride, digest(ride.encode(), asked)[:DIGITS]


def _packed(value: object) -> bytes:
    return gzip.compress(msgspec.json.encode(value), mtime=0)


def _write(path: Path, data: bytes) -> None:
    part = path.with_name(f"{path.name}.part")
    part.write_bytes(data)
    part.replace(path)
