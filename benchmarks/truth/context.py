"""One sentence of an answer with its context, and the patterns that check such sentences."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal

from benchmarks.truth.decision import Decision
from benchmarks.truth.mentions import Mention
from benchmarks.truth.reckoning import Actions, Term
from benchmarks.truth.ridden import Ridden
from sim.scene import EGO

KMH = 3.6
CLOSE = 2.6  # [km/h] greatest error of a stated speed
NUMBERS = {
    "half a": 0.5, "one": 1, "two": 2, "three": 3, "four": 4, "five": 5, "six": 6, "seven": 7,
    "eight": 8, "nine": 9, "ten": 10, "eleven": 11, "twelve": 12,
}  # fmt: skip
CLOCK = re.compile(r"\b(\d+):(\d\d)\b")
AGO = re.compile(r"[Aa]bout (\d+(?:\.\d+)?|half a) seconds? ago")
WHO = r"(?P<who>V\d+|[Ww]e|I|[Ii]t)"


@dataclass(frozen=True)
class Said:
    """A sentence with its context: question, time, vehicles mentioned, and earlier text."""

    ride: Ridden
    now: float
    question: str
    text: str  # with V0, V1, ... for vehicles
    mentions: tuple[Mention, ...]  # of the whole answer
    before: str  # the earlier text of the answer
    decision: Decision | None = None  # the decision that the answer is about, if known

    def who(self, name: str) -> tuple[int, ...]:
        """Return the vehicles that a name may stand for."""
        if name in ("we", "We", "I", "us"):
            return (EGO,)
        if name.startswith("V"):
            return self.mentions[int(name[1:])].vehicles
        return self.last()

    def last(self) -> tuple[int, ...]:
        """Return the vehicles that "it" may stand for."""
        spoken = re.findall(r"V(\d+)", self.before + self.text)
        if spoken:
            return tuple(v for k in spoken for v in self.mentions[int(k)].vehicles)
        asked = re.search(r"vehicle (\d+)", self.question)
        return (int(asked[1]),) if asked else tuple(self.ride.known(self.now))

    def told(self, text: str | None = None) -> tuple[float, float] | None:
        """Return the interval [s] that a time phrase of the sentence names, if any does."""
        text = self.text if text is None else text
        if match := CLOCK.search(text):
            time = 60.0 * int(match[1]) + int(match[2])
            return time - 0.2, time + 1.2  # clocks show whole seconds that are over
        if match := AGO.search(text):
            ago = NUMBERS.get(match[1]) or float(match[1])
            return self.now - 1.15 * ago - 0.6, self.now - 0.85 * ago + 0.6
        if re.search(r"\bjust now\b", text):
            return self.now - 4.0, self.now
        return None

    def when(self, past: bool, text: str | None = None) -> tuple[float, float]:
        """Return the interval [s] that is meant: now, or in the past, a stated or likely one."""
        if not past:
            return self.now - 0.15, self.now
        return self.told(text) or self.episode()

    def episode(self) -> tuple[float, float]:
        """Return the interval [s] that a question about the past means.

        It is the time from shortly before the first halt, or the last braking, if the question is
        about these; else all time up to now.
        """
        if re.search(r"\b(stop|stand|wait)", self.question):
            held = [t for t in self.ride.span(0.0, self.now) if self.speeds("we", (t, t))[0] < 1.0]
            if held:
                return held[0] - 8.0, self.now
        if re.search(r"\b(brak|slow|stop|stand|that)", self.question):
            found = self.ride.brakings(self.now)
            if found:
                return found[-1][0] - 2.0, self.now
        return 0.0, self.now

    def some(
        self, who: str, span: tuple[float, float], holds: Callable[[int, float], bool]
    ) -> bool:
        """Check whether a predicate holds for a vehicle that a name may mean, in an interval."""
        times = self.ride.span(*span) or [self.ride.times[self.ride.index(span[1])]]
        return any(holds(vehicle, time) for vehicle in self.who(who) for time in times)

    def speeds(self, who: str, span: tuple[float, float]) -> list[float]:
        """Return the speeds [km/h], in an interval, of the vehicles that a name may mean."""
        times = self.ride.span(*span) or [self.ride.times[self.ride.index(span[1])]]
        states = (self.ride.state(v, time) for v in self.who(who) for time in times)
        return [KMH * state.speed for state in states if state is not None]


@dataclass(frozen=True)
class Fault:
    """A statement that is wrong by the record of the ride."""

    kind: str
    detail: str


@dataclass(frozen=True)
class Told:
    """A statement about a foil: a term of the reward, that it is close, or that it is better."""

    term: Term | Literal["close", "better"]
    foil: Actions
    implied: bool = False  # whether it is about every other road, without naming one


Check = Callable[[Said, re.Match[str]], Iterator[Fault | Told]]
RULES: list[tuple[re.Pattern[str], Check]] = []


def claim(*patterns: str) -> Callable[[Check], Check]:
    """Return a decorator that registers a check for what patterns find in a sentence."""

    def registered(check: Check) -> Check:
        RULES.extend((re.compile(pattern), check) for pattern in patterns)
        return check

    return registered


def near(told: float, found: list[float], off: float = CLOSE) -> bool:
    """Check whether a stated value lies in the range of the true ones, with a tolerance."""
    return bool(found) and min(found) - off <= told <= max(found) + off


def rounded(found: list[float]) -> str:
    """Return the range of values as text for the report."""
    return f"{min(found):.1f}..{max(found):.1f}" if found else "never"
