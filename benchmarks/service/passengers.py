"""Many passengers at once: questions sent at given times, and their results."""

import threading
import time
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field

import msgspec

from benchmarks.figures import quantile
from xavi_dialogue.bus.errors import MessageError
from xavi_dialogue.bus.interface import Bus, Keys, NoAnswer, Outcome, Refused, TooLate
from xavi_dialogue.bus.messages import AskReply, AskRequest, Failure, pack, unpack

DEADLINE = 10.0  # [s] for an answer
GRACE = 0.5  # [s] allowed for the transport of a reply


@dataclass(frozen=True)
class Question:
    """One question of one passenger."""

    due: float  # [s] after the first question
    session: str
    text: str
    at: float  # [s] simulation time


class Load(msgspec.Struct, frozen=True):
    """The results of many questions."""

    name: str
    sessions: int
    asked: int
    answered: int  # questions with any answer, including a clear refusal
    busy: int  # questions rejected because there were too many
    timed_out: int
    lost: int  # questions without a readable reply, or whose request was rejected
    offered_per_s: float
    answered_per_s: float  # rate from the first question to the last reply
    p50_ms: float | None  # of those answered, from question to reply
    p99_ms: float | None
    late: int  # replies after their deadline


@dataclass
class _Tally:
    """The results so far; updated on threads of the bus."""

    wanted: int
    taken: list[float] = field(default_factory=list)  # [s] of those answered
    ends: Counter[str] = field(default_factory=Counter)
    last: float = 0.0  # [s] on the performance clock
    late: int = 0
    _lock: threading.Lock = field(default_factory=threading.Lock)
    done: threading.Event = field(default_factory=threading.Event)

    def take(self, began: float, outcome: Outcome) -> None:
        """Record the result of a question that was sent at a time [s]."""
        now, end = time.perf_counter(), _end(outcome)
        with self._lock:
            self.ends[end] += 1
            self.last = now
            self.late += now - began > DEADLINE and end != "timed out"
            if end == "answered":
                self.taken.append(now - began)
            if self.ends.total() == self.wanted:
                self.done.set()


def ask_all(bus: Bus, keys: Keys, name: str, questions: Iterable[Question]) -> Load:
    """Send every question when it is due, without waiting for replies, and count the results."""
    rows = sorted(questions, key=lambda one: one.due)
    tally = _Tally(len(rows))
    began = time.perf_counter()
    for number, row in enumerate(rows):
        time.sleep(max(began + row.due - time.perf_counter(), 0.0))
        asked = AskRequest(
            request=f"{name}-{number}".replace(" ", "-"),
            session=row.session,
            text=row.text,
            deadline_ms=DEADLINE * 1000.0,
            at=row.at,
        )
        sent = time.perf_counter()
        bus.request(
            keys.of("@rpc/ask"),
            pack(asked),
            DEADLINE + GRACE,
            lambda outcome, sent=sent: tally.take(sent, outcome),  # type: ignore[misc]
        )
    tally.done.wait(DEADLINE + 5.0)
    return _load(name, rows, tally, began)


def _load(name: str, rows: list[Question], tally: _Tally, began: float) -> Load:
    ends, taken = tally.ends, [1000.0 * one for one in tally.taken]
    span = max(tally.last - began, 1e-6)
    return Load(
        name=name,
        sessions=len({row.session for row in rows}),
        asked=len(rows),
        answered=ends["answered"],
        busy=ends["busy"],
        timed_out=ends["timed out"],
        lost=len(rows) - ends["answered"] - ends["busy"] - ends["timed out"],
        offered_per_s=round(len(rows) / max(rows[-1].due, 1e-6), 1) if rows[-1].due else 0.0,
        answered_per_s=round(ends["answered"] / span, 1),
        p50_ms=round(quantile(taken, 50), 1) if taken else None,
        p99_ms=round(quantile(taken, 99), 1) if taken else None,
        late=tally.late,
    )


def _end(outcome: Outcome) -> str:
    """Return the result of a question in a word or two."""
    if isinstance(outcome, TooLate):
        return "timed out"
    try:
        if isinstance(outcome, Refused):
            reason: str | None = unpack(outcome.payload, Failure).reason
            if reason == "not-understood":  # the request itself, not its text
                return "lost"
        elif isinstance(outcome, NoAnswer):
            return "lost"
        else:
            reason = unpack(outcome, AskReply).reason
    except MessageError:
        return "lost"
    return {"busy": "busy", "timed-out": "timed out"}.get(reason or "", "answered")
