"""Rows of the file of conversations, checked when read: the file may be damaged.

A row that is not as it was written raises Damaged, with the session that it belongs to and how to
forget that; forgetting needs nothing of it to be read.
"""

import re
import shlex
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Self, TypeVar

import msgspec

from xavi_dialogue.bus.messages import Count, Name, Seconds, Whole
from xavi_dialogue.storage.database import Row
from xavi_dialogue.storage.store_errors import Damaged

LATEST = 2.5e11  # [s] wall time in the year 9892: dates end soon after

WallTime = Annotated[float, msgspec.Meta(ge=0.0, le=LATEST)]
T = TypeVar("T")


class Summary(msgspec.Struct, frozen=True):
    """One session, as `xavi sessions` lists it."""

    name: Name
    turns: Count
    first: WallTime  # [s] of the first turn that is kept
    last: WallTime  # [s] of the last
    scenario: str | None  # of the last turn on a ride
    seed: Whole | None
    sim_time: Seconds | None  # [s] at which that turn's question was asked
    question: str  # of the last turn

    @classmethod
    def of(cls, path: Path, row: Row) -> Self:
        """Make a summary of a row: the fields in order, but the last turn in JSON for `question`.

        Raises:
            Damaged: it cannot be read.
        """
        name = known(path, row[0])
        question = decoded(path, name, row[-1], _Asked).text
        fields = dict(zip(cls.__struct_fields__, (*row[:-1], question), strict=True))
        return checked(path, name, fields, cls)


class Line(msgspec.Struct, omit_defaults=True):
    """One exported line: a turn, or an event."""

    schema: str
    session: str | msgspec.UnsetType = msgspec.UNSET
    number: int | msgspec.UnsetType = msgspec.UNSET
    ride: str | msgspec.UnsetType | None = msgspec.UNSET
    seq: int | msgspec.UnsetType = msgspec.UNSET
    wall_time: WallTime | msgspec.UnsetType = msgspec.UNSET
    turn: dict[str, Any] | msgspec.UnsetType = msgspec.UNSET
    event: dict[str, Any] | msgspec.UnsetType = msgspec.UNSET


class _Asked(msgspec.Struct):
    text: str


def known(path: Path, name: object) -> str:
    """Check the name of a session and return it.

    Raises:
        Damaged: it is not a valid name.
    """
    try:
        return msgspec.convert(name, Name)
    except (msgspec.MsgspecError, UnicodeError) as error:
        raise Damaged(
            f"the name of a session in {path} is damaged;"
            f" `xavi forget --all --store {shlex.quote(str(path))}` erases all of them"
        ) from error


def decoded(path: Path, session: str, text: object, kind: type[T]) -> T:
    """Decode the JSON of a session.

    Raises:
        Damaged: it cannot be read.
    """
    if not isinstance(text, str):
        raise _damaged(path, session, f"no text, but {type(text).__name__}")
    try:
        return msgspec.json.decode(text, type=kind)
    except (msgspec.MsgspecError, UnicodeError, RecursionError) as error:
        raise _damaged(path, session, str(error)) from error


def checked(path: Path, session: str, fields: Mapping[str, object], kind: type[T]) -> T:
    """Check the fields of a session, so that they are safe to write.

    Raises:
        Damaged: they are not valid.
    """
    try:
        made = msgspec.convert(fields, kind)
        msgspec.json.encode(made)
    except (msgspec.MsgspecError, UnicodeError) as error:
        raise _damaged(path, session, str(error)) from error
    return made


def decoded_owner(path: Path, session: str, text: object) -> str:
    """Check the digest of a session's owner and return it.

    Raises:
        Damaged: it is not a valid digest.
    """
    if not isinstance(text, str) or not re.fullmatch(r"[0-9a-f]{64}", text):
        raise _damaged(path, session, "no digest of an owner")
    return text


def _damaged(path: Path, session: str, problem: str) -> Damaged:
    return Damaged(
        f"what is kept of session {session} in {path} is damaged ({problem});"
        f" `xavi forget {session} --store {shlex.quote(str(path))}` erases it"
    )
