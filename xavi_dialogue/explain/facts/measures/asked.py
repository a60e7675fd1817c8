"""The request for a measure: the attribute, the things and the time."""

from dataclasses import dataclass

from sim.scene import EGO
from xavi_dialogue.domain.facts import Gap, Measure
from xavi_dialogue.domain.terms import Ego, Thing, Vehicle, Vehicles
from xavi_dialogue.domain.vocabulary import Attribute
from xavi_dialogue.explain.facts.states import States


@dataclass(frozen=True, slots=True)
class Asked:
    """A measure that is asked for."""

    states: States
    attribute: Attribute
    thing: Thing
    at: float  # [s]
    to: Thing | None = None

    @property
    def vehicle(self) -> int:
        """The vehicle that is measured; ours if the thing is not a vehicle."""
        match self.thing:
            case Vehicle(number):
                return number
            case Vehicles(numbers) if numbers:
                return numbers[0]
        return EGO

    @property
    def other(self) -> int | None:
        """The other vehicle, if there is one; for another vehicle, ours by default."""
        match self.to:
            case Ego():
                return EGO
            case Vehicle(number):
                return number
            case Vehicles(numbers) if numbers:
                return numbers[0]
        return EGO if self.to is None and self.vehicle != EGO else None

    @property
    def time(self) -> float:
        """The time [s] of the value: the time asked about, or the last sample before it."""
        motion = self.states.motion(self.vehicle)
        if motion.time and self.at > motion.time[-1]:
            return motion.time[-1]
        return self.at

    def found(
        self, value: float | None, word: str | None = None, time: float | None = None
    ) -> Measure:
        """Return the measure with a value or word."""
        at = self.time if time is None else time
        return Measure(self.attribute, self.thing, at, value, word, self.to)

    def none(self, gap: Gap) -> Measure:
        """Return the measure without a value, and why."""
        return Measure(self.attribute, self.thing, self.at, to=self.to, gap=gap)

    def gap(self) -> Gap | None:
        """Return why the things are not known at that time; None if they are."""
        first = self.states.gap(self.vehicle, self.at)
        if first is not None or self.other is None:
            return first
        return self.states.gap(self.other, self.at)
