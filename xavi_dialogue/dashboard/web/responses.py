"""HTTP responses: files of the page, documents as JSON, and errors as text."""

import gzip
import hashlib
import re
from dataclasses import dataclass
from html import escape
from importlib.resources import files

import msgspec

WORTH_PACKING = 1024  # bytes; compressing less saves little
LEVEL = 4  # of gzip: nearly as small as its default, in a third of the time
TYPES = {
    "css": "text/css; charset=utf-8",
    "html": "text/html; charset=utf-8",
    "js": "text/javascript; charset=utf-8",
    "png": "image/png",
    "svg": "image/svg+xml",
}
HTML, JSON = TYPES["html"], "application/json"

_PART = re.compile(r"[A-Za-z0-9_-][A-Za-z0-9._-]{0,99}")
_STATIC = files("xavi_dialogue.dashboard.web") / "static"

_PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
{head}<title>XAVI Dialogue</title>
<link rel="icon" href="/static/icon.svg">
<link rel="stylesheet" href="/static/css/tokens.css">
<link rel="stylesheet" href="/static/css/door.css">
</head>
<body><main><h1>{title}</h1><p>{text}</p></main></body>
</html>
"""


@dataclass(frozen=True, slots=True)
class Body:
    """The contents of a response."""

    data: bytes
    type: str
    etag: str
    packed: bytes | None = None  # compressed by gzip; None: not worthwhile


def body(data: bytes, kind: str) -> Body:
    """Make a response's body with a content type; packing takes some milliseconds for each MB."""
    etag = f'W/"{hashlib.sha256(data).hexdigest()[:32]}"'  # weak: the same packed or not
    packed = None
    if len(data) >= WORTH_PACKING and not kind.startswith("image/png"):
        packed = gzip.compress(data, LEVEL, mtime=0)
    return Body(data, kind, etag, packed)


def asset(path: str) -> Body | None:
    """Return one of the page's files; None: there is no such file.

    Args:
        path: within the folder `static`, its parts parted by slashes.
    """
    parts = path.split("/")
    kind = TYPES.get(path.rpartition(".")[2])
    if kind is None or not all(_PART.fullmatch(part) for part in parts):
        return None
    try:
        return body(_STATIC.joinpath(*parts).read_bytes(), kind)
    except OSError:
        return None


def said(words: str) -> bytes:
    """Return an error as JSON."""
    return msgspec.json.encode({"error": words})


def no_token_page(words: str) -> bytes:
    """Return the page for browsers without the token."""
    return _PAGE.format(head="", title="This dashboard has a key", text=escape(words)).encode()


def onward_page() -> bytes:
    """Return the page that redirects a browser to /."""
    go_on = '<meta http-equiv="refresh" content="0;url=/">\n'
    text = '<a href="/">Go on to the dashboard</a>'
    return _PAGE.format(head=go_on, title="Welcome", text=text).encode()
