"""What is sent over HTTP."""

import gzip
from importlib.resources import files

import pytest

from xavi_dialogue.dashboard.web import responses


@pytest.mark.parametrize(
    ("path", "kind"),
    [
        ("index.html", "text/html; charset=utf-8"),
        ("css/door.css", "text/css; charset=utf-8"),
        ("js/store.js", "text/javascript; charset=utf-8"),
        ("icon.svg", "image/svg+xml"),
    ],
)
def test_the_pages_files_are_there(path: str, kind: str) -> None:
    found = responses.asset(path)
    assert found is not None
    assert found.type == kind
    data = (files("xavi_dialogue") / "dashboard/web/static" / path).read_bytes()
    assert found.data == data
    assert found.packed is None or gzip.decompress(found.packed) == data


@pytest.mark.parametrize(
    "path",
    [
        *("", "/", ".", "..", "js", "js/", "nothing.js", "js/nothing.js", "index.html/", ".html"),
        *("../server.py", "../server.js", "js/../js/store.js", "./index.html", "//index.html"),
        *("/index.html", "/etc/passwd", "/etc/hosts.html", "js//store.js", "js\\store.js"),
        *("%2e%2e/server.py", "index.html\x00", "index.html\x00.js", "index.html\n", "\x00.html"),
        *("store.js/../../index.html", "index.HTML", "Index.html", "é.js", "x" * 300 + ".js"),
        *("index.html/store.js", "css/door.css/door.css", "/".join(["js"] * 3000) + "/store.js"),
    ],
    ids=lambda path: repr(path[:30]),
)
def test_nothing_else_is(path: str) -> None:
    assert responses.asset(path) is None


def test_only_files_of_these_kinds_are_beside_the_page() -> None:
    folder = files("xavi_dialogue") / "dashboard/web/static"
    left, found = [folder], set()
    while left:
        for one in left.pop().iterdir():
            if one.is_dir():
                left.append(one)
            else:
                found.add(one.name.rpartition(".")[2])
    assert found <= set(responses.TYPES)


def test_what_is_large_is_packed_and_what_changes_is_told_apart() -> None:
    small, large = responses.body(b"a", responses.JSON), responses.body(b"a" * 5000, responses.JSON)
    assert small.packed is None
    assert large.packed is not None
    assert len(large.packed) < 100
    assert small.etag != large.etag
    assert responses.body(b"a", responses.JSON) == small


def test_words_are_escaped() -> None:
    assert b"<script>" not in responses.no_token_page("<script>alert(1)</script>")
    assert responses.said('"</script>\n') == b'{"error":"\\"</script>\\n"}'
