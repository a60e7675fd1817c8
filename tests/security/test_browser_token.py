"""The token of a dashboard's browsers, in a file."""

from pathlib import Path

import pytest

from xavi_dialogue.security.browser_token import TokenFileError, is_token, token_in

TOKEN = "correct-horse-battery-staple"


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return tmp_path / "token"


def written(file: Path, content: bytes, mode: int = 0o600) -> Path:
    file.write_bytes(content)
    file.chmod(mode)
    return file


def test_a_token_is_made_once_and_is_for_its_owner_alone(file: Path) -> None:
    notes: list[str] = []
    token = token_in(file, notes.append)
    assert is_token(token)
    assert file.stat().st_mode & 0o777 == 0o600
    [note] = notes
    assert str(file) in note
    assert token not in note
    assert token_in(file, notes.append) == token
    assert len(notes) == 1


@pytest.mark.parametrize("content", [TOKEN, f"{TOKEN}\n", f"  {TOKEN}\r\n\n"])
def test_what_is_around_a_token_does_not_count(file: Path, content: str) -> None:
    notes: list[str] = []
    assert token_in(written(file, content.encode()), notes.append) == TOKEN
    assert notes == []


@pytest.mark.parametrize("mode", [0o640, 0o604, 0o644])
def test_a_file_that_others_can_read_is_used_and_warned_of(file: Path, mode: int) -> None:
    notes: list[str] = []
    assert token_in(written(file, TOKEN.encode(), mode), notes.append) == TOKEN
    [note] = notes
    assert note.startswith("warning: ")
    assert f"chmod 600 {file}" in note


@pytest.mark.parametrize(
    "content", [b"", b"\n", b"short", b"a" * 129, b"two words of a sentence", b"\xff" * 20]
)
def test_what_is_no_token_is_refused_with_a_way_out(file: Path, content: bytes) -> None:
    with pytest.raises(TokenFileError, match="remove it to get a new one") as caught:
        token_in(written(file, content), print)
    assert str(file) in str(caught.value)
    assert file.read_bytes() == content


def test_a_file_that_cannot_be_used_is_named(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(TokenFileError, match="cannot be used"):
        token_in(tmp_path / "file" / "token", print)
    with pytest.raises(TokenFileError, match="cannot be used"):
        token_in(tmp_path, print)
