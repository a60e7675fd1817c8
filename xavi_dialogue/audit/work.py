"""The work on one ride, in whatever process: drive or open it, look through it, and ask.

Questions are asked of the stored ride, so that whoever opens its file gets the same answers.
"""

import hashlib
import os
import resource
import socket
import tempfile
import threading
import time
import traceback
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Final

import msgspec

from xavi_dialogue.audit.program import program
from xavi_dialogue.audit.questions import Question
from xavi_dialogue.audit.rides.facts import look_through
from xavi_dialogue.audit.sources import Source, check_content
from xavi_dialogue.audit.values import Answered, Cost, Done, Facts, Failed, Peak
from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.errors import XaviError
from xavi_dialogue.library import sources as rides
from xavi_dialogue.library.ride import Ride
from xavi_dialogue.storage import ride_file

AFTERWARDS: Final = 1.0  # [s] after a moment at which it is asked about
MAX_WHY: Final = 300  # letters of a fault
_ONE_AT_A_TIME: Final = threading.Lock()  # SUMO has one simulation in a process


class Task(msgspec.Struct, frozen=True):
    """What is to be done about one ride."""

    key: str  # of its result
    program: str
    source: Source
    questions: tuple[Question, ...]
    ride: bytes | None = None  # it was driven already
    facts: Facts | None = None


def work(task: Task) -> Done | Failed:
    """Do a task; what goes wrong with the ride is a value."""
    with _ONE_AT_A_TIME:
        if task.program != program():
            here = f"{socket.gethostname()}, process {os.getpid()}"
            return Failed(f"{here} runs another version of this program; install the same on all")
        try:
            return _done(task)
        except XaviError as error:
            return Failed(one_line(str(error)))
        except Exception as error:  # a fault of this program costs one ride and not the audit
            return Failed(fault_of(error))


def fault_of(error: Exception) -> str:
    """Return a fault of this program in words, with the line that it comes from."""
    last = traceback.extract_tb(error.__traceback__)[-1]
    what = one_line(f"{type(error).__name__}: {error}")[:MAX_WHY]
    return f"a fault of this program at {Path(last.filename).name}, line {last.lineno}: {what}"


def _done(task: Task) -> Done:
    begin = time.process_time()
    check_content(task.source)
    with tempfile.TemporaryDirectory(prefix="xavi-") as folder, _quietly():
        ride, data = _ride(task, Path(folder))
        driven = time.process_time()
        facts = task.facts or look_through(ride, hashlib.sha256(data).hexdigest(), len(data))
        looked = time.process_time()
        if task.source.seed is not None:
            ride = _stored(data, Path(folder))
        answers = tuple(_answered(ride, facts, one) for one in task.questions)
        answered = time.process_time()
    cost = Cost(
        drive=round(driven - begin, 3),
        look=round(looked - driven, 3),
        answer=round(answered - looked, 3),
        memory=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024,
        worker=f"{socket.gethostname()} {os.getpid()}",
    )
    stored = data if task.source.seed is not None and task.ride is None else None
    return Done(stored, None if task.facts else facts, answers, cost)


def _ride(task: Task, folder: Path) -> tuple[Ride, bytes]:
    """Return the ride of a task, and its file."""
    source = task.source
    if source.seed is None:
        path = Path(source.place)
        return rides.open_ride(path), path.read_bytes()
    if task.ride is not None and task.facts is not None:
        return _stored(task.ride, folder), task.ride
    ride = rides.drive(source.place, source.seed, source.duration)
    return ride, ride_file.dump(ride.record)


def _stored(data: bytes, folder: Path) -> Ride:
    path = folder / f"ride{ride_file.ENDING}"
    path.write_bytes(data)
    return rides.open_ride(path)


def _answered(ride: Ride, facts: Facts, question: Question) -> Answered:
    known, at = _moment(facts, question)
    if not known:
        return Answered(question.text, question.when, None)
    answer = ride.ask(question.text, at)
    return Answered(
        question=question.text,
        when=question.when,
        at=round(answer.at, 3),
        kind=answer.kind,
        reason=answer.reason,
        text=answer.text,
        content=msgspec.json.encode(answer.content, order="sorted").decode(),
        traces=answer.evidence.traces,
    )


def _moment(facts: Facts, question: Question) -> tuple[bool, float | None]:
    """Return whether there is such a moment, and when [s]; None: as `Ride.ask` chooses."""
    match question.moment:
        case None:
            return True, None
        case "end":
            return True, facts.end
        case "braking":
            return _after(facts, (facts.braking,))
        case "closest":
            return _after(facts, (facts.collision, facts.time_to_collision, facts.distance))
    return True, question.moment


def _after(facts: Facts, peaks: Sequence[Peak | None]) -> tuple[bool, float | None]:
    peak = next((one for one in peaks if one is not None), None)
    return peak is not None, None if peak is None else min(peak.at + AFTERWARDS, facts.end)


@contextmanager
def _quietly() -> Iterator[None]:
    """Leave out warnings of scenarios, which were told when the audit was planned."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield
