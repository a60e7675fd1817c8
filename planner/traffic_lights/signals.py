"""The meaning of traffic lights over time to vehicles at their lines, in tables for kernels."""

import itertools
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from planner.kernels.course import Codes
from planner.kernels.limits import AMBER, FIRST, HALT, OPEN, SHUT
from planner.record.light_record import LightPrediction, LightSample, Showing
from sim.scene import LightState, Signal

STEP = 0.2  # [s] of the common time base
#: The meaning of a state to a vehicle that comes to the line. In all other states, including a
#: state that is not seen, the junction's rules hold.
MEANING: dict[str, int] = {
    LightState.GREEN.value: FIRST,
    LightState.RED.value: SHUT,
    LightState.RED_AMBER.value: SHUT,
    LightState.AMBER.value: AMBER,
    LightState.STOP_FIRST.value: HALT,
}


@dataclass(frozen=True, slots=True, eq=False)
class Lights:
    """The meanings of lights in one course of events, sampled from step 0 on."""

    meaning: Mapping[Signal, Codes]  # [T] at the line; the last one stays
    _tables: dict[tuple[Signal, ...], Codes] = field(default_factory=dict)

    def shows(self, signal: Signal, steps: int) -> Codes:
        """Return the meaning of a light at each step [T >= steps]."""
        codes = self.meaning.get(signal, _DARK)
        if len(codes) >= steps:
            return codes
        return np.concatenate((codes, np.full(steps - len(codes), codes[-1])))

    def table(self, signals: tuple[Signal, ...]) -> Codes:
        """Return the meanings of some lights at each step [S, T]; results are cached."""
        if not signals or not self.meaning:
            return np.full((len(signals), 1), OPEN, np.int8)
        found = self._tables.get(signals)
        if found is None:
            steps = max((len(self.shows(signal, 1)) for signal in signals), default=1)
            rows = [self.shows(signal, steps) for signal in signals]
            found = self._tables[signals] = np.array(rows, np.int8).reshape(len(rows), steps)
        return found

    def since(self, step: int) -> "Lights":
        """Return the lights with a later step as step 0."""
        return Lights(
            {signal: codes[min(step, len(codes) - 1) :] for signal, codes in self.meaning.items()}
        )


_DARK: Codes = np.full(1, OPEN, np.int8)
NO_LIGHTS = Lights({})


@dataclass(frozen=True)
class Outlook:
    """The possible courses of all controllers in view from a moment on."""

    time: float  # [s] of step 0
    known: tuple[LightPrediction, ...] = ()

    @cached_property
    def varying(self) -> tuple[LightPrediction, ...]:
        """The controllers with several possible courses."""
        return tuple(one for one in self.known if len(one.courses) > 1)

    def courses(self, drawn: Iterable[LightSample]) -> tuple[int, ...]:
        """Return the course of every controller: the one drawn, or otherwise its only one."""
        found = {sample.controller: sample.course for sample in drawn}
        return tuple(found.get(one.controller, 0) for one in self.known)

    @cached_property
    def joint(self) -> tuple[tuple[int, ...], ...]:
        """All the courses that the controllers may take together."""
        return tuple(itertools.product(*(range(len(one.courses)) for one in self.known)))

    def with_usual(self, courses: Sequence[int], among: Collection[str]) -> tuple[int, ...]:
        """Return courses in which controllers outside a group take their likeliest ones."""
        ways = zip(self.known, courses, self.usual, strict=True)
        return tuple(k if one.controller in among else usual for one, k, usual in ways)

    @cached_property
    def usual(self) -> tuple[int, ...]:
        """The likeliest course of every controller."""
        return tuple(one.likeliest for one in self.known)

    def lights(self, courses: Sequence[int], steps: int) -> Lights:
        """Return the lights from now on if controllers take certain courses."""
        ways = zip(self.known, courses, strict=True)
        return self._sampled([one.courses[k].showings for one, k in ways], self.time, steps)

    def before(self, elapsed: int, steps: int) -> Lights:
        """Return the lights from `elapsed` steps ago on: as seen, then in likeliest courses."""
        showings = [(*one.seen, *one.courses[one.likeliest].showings) for one in self.known]
        return self._sampled(showings, self.time - elapsed * STEP, steps + elapsed)

    def _sampled(self, showings: Sequence[Sequence[Showing]], start: float, steps: int) -> Lights:
        meaning: dict[Signal, Codes] = {}
        times = start + STEP * np.arange(steps + 1) + 1e-6
        for one, changes in zip(self.known, showings, strict=True):
            at = np.searchsorted([change.time for change in changes], times, side="right") - 1
            for k, place in enumerate(one.places):
                codes = [MEANING.get(change.states[k], OPEN) for change in changes]
                shown = np.array(codes, np.int8)[np.maximum(at, 0)]
                meaning[Signal(one.controller, place)] = shown
        return Lights(meaning)


DARK = Outlook(0.0)
