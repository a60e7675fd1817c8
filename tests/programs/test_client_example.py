"""The client in the README speaks with a car and a service that are processes of their own."""

import os
import re
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

PATIENCE = 60.0  # [s] before a test gives up on what never comes
ENDPOINT = "tcp/127.0.0.1:7447"


def client(root: Path, page: str = "README.md") -> str:
    """The program in a document."""
    text = (root / page).read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", text, flags=re.MULTILINE | re.DOTALL)
    [program] = [block for block in blocks if "import json, time, zenoh" in block]
    return program


@contextmanager
def served() -> Iterator[str]:
    """Start a service with a car, and give its endpoint."""
    with socket.socket() as trial:
        trial.bind(("127.0.0.1", 0))
        endpoint = f"tcp/127.0.0.1:{trial.getsockname()[1]}"
    with ExitStack() as stack:
        service = started(stack, "serve", "--listen", endpoint, "--keep-days", "0")
        assert service.stderr is not None
        assert f"serving at {endpoint}" in service.stderr.readline()
        started(stack, "drive", "--connect", endpoint, "--speed", "0.5")
        yield endpoint


def started(stack: ExitStack, *arguments: str) -> "subprocess.Popen[str]":
    process = subprocess.Popen(
        [sys.executable, "-m", "xavi_dialogue", *arguments], stderr=subprocess.PIPE, text=True
    )
    stack.enter_context(process)
    stack.callback(process.send_signal, signal.SIGTERM)
    return process


@pytest.fixture(scope="module")
def hub() -> Iterator[str]:
    """The endpoint of a service with a car."""
    with served() as endpoint:
        yield endpoint


def run(program: str) -> str:
    done = subprocess.run(
        [sys.executable, "-I", "-c", program],
        capture_output=True,
        text=True,
        check=False,
        timeout=PATIENCE,
        env={**os.environ, "PYTHONPATH": ""},
    )
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


def test_it_is_as_short_as_is_said(root: Path) -> None:
    program = client(root)
    assert "xavi_dialogue" not in program
    assert len([line for line in program.splitlines() if line.strip()]) == 10
    assert ENDPOINT in program


def test_it_gets_an_answer_and_the_decisions(root: Path, hub: str) -> None:
    # At half the pace there is a decision every two seconds.
    program = client(root).replace(ENDPOINT, hub)
    give_up = time.monotonic() + PATIENCE
    out = run(program)
    while '"kind":"answer"' not in out and time.monotonic() < give_up:  # the car begins
        out = run(program)
    assert '"text":"I am ' in out
    assert '{"schema":"xavi.trace/1"' in out


def test_what_is_wrong_with_a_question_is_told(root: Path, hub: str) -> None:
    program = client(root).replace(ENDPOINT, hub).replace("sleep(3.0)", "sleep(0.0)")
    assert "not-understood" in run(program.replace('"xavi.ask/1"', '"xavi.ask/9"'))
    assert "xavi.ask/1" in run(program.replace('"xavi.ask/1"', '"xavi.ask/9"'))


def test_who_comes_late_gets_what_was_before(root: Path, hub: str) -> None:
    program = client(root, "docs/bus.md").replace(ENDPOINT, hub)
    give_up = time.monotonic() + PATIENCE
    out = run(program)
    while "decision: 1" not in out and time.monotonic() < give_up:  # the car has decided twice
        out = run(program)
    assert "alive: xavi/v1/car/alive/car" in out
    assert "alive: xavi/v1/car/alive/service" in out
    decisions = [int(number) for number in re.findall(r"decision: (\d+)", out)]
    assert {0, 1} <= set(decisions)
    assert "said: " in out
