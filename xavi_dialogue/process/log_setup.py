"""Logging of processes: one line per record on standard error.

Code logs with `logging.getLogger(__name__)`, a short constant message, and values in `extra`. The
words of passengers are logged only if an option asks for that. Values with names in SPOKEN are left
out, and an exception is logged by type and place, since its text may quote what was typed.

Logging never waits for a slow reader: a thread writes the lines from a queue. Lines that do not
fit into the queue are counted, and their number is logged later.
"""

import contextlib
import json
import logging
import queue
import re
import threading
import traceback
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Literal, TextIO, TypeAlias

Form: TypeAlias = Literal["text", "json", "off"]
Level: TypeAlias = Literal["debug", "info", "warning", "error"]

OURS = ("xavi_dialogue", "planner", "sim")
SPOKEN = frozenset({"text", "question", "detail", "answer", "reply", "utterance"})
FIRST = ("vehicle", "session", "request", "trace_id")  # the order of fields
MAX_LINE = 4096  # bytes
MAX_VALUE = 256  # characters
MAX_FIELDS = 32
MAX_FRAMES = 6  # of an exception, the innermost
WAITING = 1000  # lines that wait for the reader
FLUSHED = 1.0  # [s] to write the last lines when a process ends

_PLAIN = re.compile(r"[A-Za-z0-9_.:/+@<>*-]+")
_LINE = re.compile(r"\{\"time\": |\d{4}-\d\d-\d\dT[0-9:.]+Z ")
_STANDARD = frozenset(vars(logging.makeLogRecord({}))) | {"message", "asctime", "taskName"}
_Value: TypeAlias = str | int | float | bool | None


@dataclass(frozen=True, slots=True)
class LogOptions:
    """Options of logging."""

    form: Form = "text"
    level: Level = "warning"
    component: str = "xavi"  # car, service, recorder, ...
    vehicle: str | None = None  # if the process is about one car
    dialogue: bool = False  # log what passengers say


class LineFormatter(logging.Formatter):
    """A formatter of lines with less than MAX_LINE bytes of printable ASCII; it never raises."""

    def __init__(self, telling: LogOptions) -> None:
        super().__init__()
        self._telling = telling

    def format(self, record: logging.LogRecord) -> str:
        """Return one line, without its end."""
        try:
            fields = self._fields(record)
        except Exception:  # a wrong format string must not stop the ride
            event = "unprintable log record"
            fields = {"time": _moment(record.created), "level": "error", "event": event}
        return _line(fields, self._telling.form)

    def _fields(self, record: logging.LogRecord) -> dict[str, _Value]:
        telling = self._telling
        given = {
            name: value
            for name, value in vars(record).items()
            if name not in _STANDARD and (telling.dialogue or name not in SPOKEN)
        }
        given.setdefault("vehicle", telling.vehicle)
        # Messages of other libraries may contain anything; ours are constant.
        event = record.getMessage() if telling.dialogue else str(record.msg)
        head = {
            "time": _moment(record.created),
            "level": record.levelname.lower(),
            "component": telling.component,
            "event": event,
            "logger": record.name,
        }
        found = {name: _value(value) for name, value in head.items()}
        names = [*FIRST, *sorted(name for name in given if name not in FIRST)]
        for name in names[:MAX_FIELDS]:
            if given.get(name) is not None:
                found.setdefault(str(name)[:64], _value(given[name]))
        if record.exc_info and record.exc_info[1] is not None:
            found |= _error(record.exc_info[1], told=telling.dialogue)
        return found


class ThreadedHandler(logging.Handler):
    """A handler that writes lines to a stream on a thread; logging never waits and never fails."""

    def __init__(self, stream: TextIO, telling: LogOptions) -> None:
        super().__init__()
        self.setFormatter(LineFormatter(telling))
        self._stream = stream
        self._lines: queue.Queue[str | None] = queue.Queue(WAITING)
        self._lost = 0  # lines that did not fit into the queue
        self._writer = threading.Thread(target=self._write, name="log", daemon=True)
        self._writer.start()

    def emit(self, record: logging.LogRecord) -> None:
        """Queue a record for writing, or count it as lost."""
        try:
            if self._lost:
                told = logging.LogRecord(
                    *(__name__, logging.WARNING, "", 0, "log lines lost", None, None)
                )
                told.lines = self._lost
                self._lines.put_nowait(self.format(told))
                self._lost = 0
            self._lines.put_nowait(self.format(record))
        except queue.Full:
            self._lost += 1

    def close(self) -> None:
        """Write the queued lines, as far as the reader takes them."""
        with contextlib.suppress(queue.Full):
            self._lines.put_nowait(None)
            self._writer.join(FLUSHED)
        super().close()

    def _write(self) -> None:
        while (line := self._lines.get()) is not None:
            # A closed stream must not stop the ride.
            with contextlib.suppress(OSError, ValueError):
                self._stream.write(line + "\n")
                self._stream.flush()


def begin(stream: TextIO, telling: LogOptions) -> logging.Handler:
    """Log the records of this process to a stream, in place of earlier handlers.

    Records of other libraries are logged from level warning on.
    """
    handler = logging.NullHandler() if telling.form == "off" else ThreadedHandler(stream, telling)
    root = logging.getLogger()
    for earlier in list(root.handlers):
        if isinstance(earlier, (ThreadedHandler, logging.NullHandler)):
            root.removeHandler(earlier)
            earlier.close()
    root.addHandler(handler)
    for name in OURS:
        logging.getLogger(name).setLevel(telling.level.upper())
    return handler


def is_log(line: str) -> bool:
    """Check whether a line of standard error is a log line, and not for the passenger."""
    return _LINE.match(line) is not None


def _line(fields: Mapping[str, _Value], form: Form) -> str:
    """Format fields as one line; drop the last ones if it is too long."""
    kept = dict(fields)
    while True:
        line = json.dumps(kept, allow_nan=False) if form == "json" else _text(kept)
        if len(line) < MAX_LINE or len(kept) <= 1:
            return line
        kept.popitem()


def _text(fields: Mapping[str, _Value]) -> str:
    rest = dict(fields)
    head = [str(rest.pop(name, "")) for name in ("time", "level", "component")]
    event = str(rest.pop("event", ""))
    rest.pop("logger", None)
    said = json.dumps(event)[1:-1]
    return " ".join([*filter(None, head), said, *(f"{k}={_shown(v)}" for k, v in rest.items())])


def _shown(value: _Value) -> str:
    text = value if isinstance(value, str) else json.dumps(value)
    return text if _PLAIN.fullmatch(text) else json.dumps(text)


def _value(value: Any) -> _Value:
    """Convert a value for JSON, and shorten it if it is long."""
    if value is None or isinstance(value, bool):
        return value
    if isinstance(value, int):
        return value if abs(value) < 2**53 else str(value)[:MAX_VALUE]
    if isinstance(value, float):
        return round(value, 6) if abs(value) < float("inf") else None
    try:
        many = isinstance(value, (list, tuple))
        text = ",".join(map(str, value[:MAX_FIELDS])) if many else str(value)
    except Exception as error:  # a value that cannot even be printed
        return f"unprintable: {type(error).__name__}"
    return text if len(text) <= MAX_VALUE else text[: MAX_VALUE - 1] + "…"


def _error(error: BaseException, *, told: bool) -> dict[str, _Value]:
    """Return the type of an exception and where it was raised, innermost first."""
    frames = traceback.extract_tb(error.__traceback__)[-MAX_FRAMES:]
    places = [f"{Path(one.filename).name}:{one.lineno}:{one.name}" for one in reversed(frames)]
    found: dict[str, _Value] = {"error": type(error).__name__, "where": _value(places)}
    if told:
        found["error_text"] = _value(str(error))
    return found


def _moment(created: float) -> str:
    moment = datetime.fromtimestamp(created, UTC)
    return moment.isoformat(timespec="milliseconds").replace("+00:00", "Z")
