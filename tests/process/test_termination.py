"""A signal ends the program even when the exception that it raises would be dropped."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

DROPPED = """
import os, signal, time
from xavi_dialogue.process.termination import end_on_signals

class Finalised:
    def __del__(self):
        os.kill(os.getpid(), signal.{name})
        time.sleep(0.01)

signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored in background jobs
end_on_signals()
try:
    Finalised()
    print("went on", flush=True)
    time.sleep(20.0)
finally:
    print("released")
"""


@pytest.mark.parametrize(("name", "status"), [("SIGTERM", 143), ("SIGINT", -signal.SIGINT)])
def test_a_signal_in_a_finaliser_ends_the_program(name: str, status: int) -> None:
    program = DROPPED.format(name=name)
    ended = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=False
    )
    assert ended.returncode == status
    assert ended.stdout == "went on\nreleased\n"
    assert "ignored" not in ended.stderr


@pytest.mark.parametrize(("name", "status"), [("SIGTERM", 143), ("SIGINT", -signal.SIGINT)])
def test_a_signal_in_an_import_ends_the_program_after_it(
    tmp_path: Path, name: str, status: int
) -> None:
    (tmp_path / "greedy.py").write_text(f"""
import os, signal, time
try:
    os.kill(os.getpid(), signal.{name})
    time.sleep(0.2)
except BaseException:
    print("caught")
""")
    program = """
import os, signal, time
from xavi_dialogue.process.termination import end_on_signals

signal.signal(signal.SIGINT, signal.default_int_handler)  # ignored in background jobs
end_on_signals()
try:
    import greedy
    os.write(1, b"imported\\n")  # at once: the signal may come between a text and its end
    time.sleep(20.0)
finally:
    print("released")
"""
    ended = subprocess.run(
        [sys.executable, "-c", program],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
    )
    assert ended.returncode == status, ended.stderr
    assert ended.stdout == "imported\nreleased\n"


def test_other_errors_of_finalisers_are_reported_as_ever() -> None:
    program = """
from xavi_dialogue.process.termination import end_on_signals
class Finalised:
    def __del__(self):
        raise ValueError("in the finaliser")
end_on_signals()
Finalised()
"""
    ended = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=False
    )
    assert ended.returncode == 0
    assert "in the finaliser" in ended.stderr
