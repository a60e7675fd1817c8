"""Identity of a passenger: a secret of the user, and a token per conversation made from it.

A conversation belongs to the client that begins it: later requests must carry the token of its
first question. The secret never leaves the machine, and a token reveals no other.

    IdentityError   the secret cannot be read or created
"""

import base64
import hashlib
import hmac
import os
import secrets
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from xavi_dialogue.process.exit_status import RunFault

SECRET_BYTES = 32


class IdentityError(RunFault):
    """The user's secret cannot be read or created."""


@dataclass(frozen=True)
class Passenger:
    """The identity of a passenger: session and token."""

    session: str
    token: str | None = None  # None: the conversation is open to all
    share: bool = False  # others may read it on the bus


def default_path() -> Path:
    """Return the file of this user's secret."""
    # Imported late, since few commands need it.
    from platformdirs import user_state_path

    return user_state_path("xavi-dialogue") / "secret"


def token_of(secret: bytes, session: str) -> str:
    """Return the token of a conversation: HMAC-SHA256 (RFC 2104) of its name in URL-safe base64."""
    digest = hmac.new(secret, session.encode(), hashlib.sha256).digest()
    return base64.urlsafe_b64encode(digest).decode().rstrip("=")


def own_secret(file: Path, *, make: bool = True) -> bytes:
    """Read the secret from a file that only its owner can read; create it if missing.

    Args:
        file: of the secret.
        make: write the file if it is missing; else a new secret lasts as long as this process.

    Raises:
        IdentityError: the file cannot be read or written, or holds something else.
    """
    try:
        if make and not file.exists():
            write_secret(file, secrets.token_bytes(SECRET_BYTES))
        elif not file.exists():
            return secrets.token_bytes(SECRET_BYTES)
        secret = file.read_bytes()
    except OSError as error:
        raise IdentityError(f"your secret in {file} cannot be used: {error.strerror}") from error
    if len(secret) != SECRET_BYTES:
        raise IdentityError(
            f"{file} does not hold a secret of {SECRET_BYTES} bytes; remove it to get a new one,"
            " which opens no conversation of before"
        )
    return secret


def write_secret(file: Path, content: bytes) -> None:
    """Write a file that only its owner can read, whole or not at all.

    Of several that do so at once, one wins; a file that is there already stays.
    """
    file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    draft = file.with_name(f"{file.name}.{os.getpid()}.{secrets.token_hex(4)}")
    try:
        with os.fdopen(os.open(draft, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "wb") as new:
            new.write(content)
        with suppress(FileExistsError):
            os.link(draft, file)
    finally:
        draft.unlink(missing_ok=True)
