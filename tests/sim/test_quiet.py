"""What libraries write to standard error goes to a file and not to the terminal."""

import os
from pathlib import Path

import pytest

from sim.quiet import errors_to, first_error


def test_the_terminal_is_spared_and_given_back(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    log = tmp_path / "log.txt"
    for word in (b"one\n", b"two\n"):
        with errors_to(log):
            os.write(2, word)
    os.write(2, b"three\n")
    assert log.read_text() == "one\ntwo\n"
    assert capfd.readouterr().err == "three\n"


def test_the_terminal_is_given_back_after_an_error(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(ValueError, match="broken"), errors_to(tmp_path / "log.txt"):
        raise ValueError("broken")
    os.write(2, b"heard\n")
    assert capfd.readouterr().err == "heard\n"


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("Warning: a\nError: b is c.\nError: d\n", "b is c."),
        ("Warning: a\n", None),
        ("", None),
    ],
)
def test_the_first_error_is_found(tmp_path: Path, text: str, error: str | None) -> None:
    log = tmp_path / "log.txt"
    log.write_text(text)
    assert first_error(log) == error
