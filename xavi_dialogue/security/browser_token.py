"""The token that a dashboard's browsers must bring, in a file: no list of processes shows it."""

import re
import secrets
import stat
from collections.abc import Callable
from pathlib import Path

from xavi_dialogue.process.exit_status import UsageFault
from xavi_dialogue.security.client_token import write_secret

FORM = "16 to 128 letters, digits, _ or -"
RANDOM_BYTES = 24  # of a token that is made up
MAX_BYTES = 1024  # that are read of a file

_TOKEN = re.compile(r"[A-Za-z0-9_-]{16,128}")


class TokenFileError(UsageFault):
    """A file with a token cannot be used; the message says how to correct it."""


def is_token(text: str) -> bool:
    """Check whether a text has the form of a token."""
    return _TOKEN.fullmatch(text) is not None


def new_token() -> str:
    """Return a random token."""
    return secrets.token_urlsafe(RANDOM_BYTES)


def token_in(file: Path, note: Callable[[str], None]) -> str:
    """Read the token in a file; write a random one where the file is missing.

    So a dashboard that is started again has the same token, and browsers stay signed in.

    Args:
        file: of the token alone; spaces and line ends around it do not count.
        note: takes notes: that a token was written, and that others can read the file.

    Raises:
        TokenFileError: it cannot be read or written, or holds something else.
    """
    try:
        if not file.exists():
            write_secret(file, f"{new_token()}\n".encode())
            note(f"{file} has a new token, which this dashboard has when it is started again")
        mode = file.stat().st_mode
        with file.open("rb") as held:
            text = held.read(MAX_BYTES).decode(errors="replace").strip()
    except OSError as error:
        raise TokenFileError(f"the token in {file} cannot be used: {error.strerror}") from error
    if not is_token(text):
        raise TokenFileError(f"{file} holds no token of {FORM}; remove it to get a new one")
    if stat.S_ISREG(mode) and mode & 0o077:
        note(f"warning: others on this machine can read the token; run: chmod 600 {file}")
    return text
