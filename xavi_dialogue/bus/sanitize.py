"""Cleaning of text from outside, which makes it safe to print."""

import re
import unicodedata

# Escape sequences are removed as a whole, so that their letters do not remain as words: operating
# system commands up to their end, control sequences, and other two-character escapes.
_ESCAPES = re.compile(
    r"(?:\x1b\]|\x9d)[^\x07\x1b\x9c]*(?:\x07|\x1b\\|\x9c)?"
    r"|(?:\x1b\[|\x9b)[0-?]*[ -/]*[@-~]?"
    r"|\x1b[ -/]*[0-~]?"
)


def clean(text: str) -> str:
    """Remove terminal escapes, control and invisible characters; keep line ends."""
    text = _ESCAPES.sub("", text.replace("\r\n", "\n"))
    return "".join(c for c in text if c == "\n" or not unicodedata.category(c).startswith("C"))


def one_line(text: str) -> str:
    """Return the text cleaned, on one line, with single spaces."""
    return " ".join(clean(text.replace("\t", " ")).split())
