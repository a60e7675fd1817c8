"""The record of traffic lights: states seen, expected, supposed and drawn.

A controller operates the lights of a junction. Its states are written as one letter for
each of its places (see `sim.scene.LightState`), UNSEEN where that is out of view.
"""

import msgspec

from sim.scene import LightState

UNSEEN = "?"
GREENS = (LightState.GREEN.value, LightState.GREEN_YIELD.value)


class Showing(msgspec.Struct, frozen=True):
    """The state of a controller from a moment on."""

    time: float  # [s] simulation time
    states: str  # a letter for each of the controller's `places`


class LightCourse(msgspec.Struct, frozen=True):
    """One possible course of a controller."""

    probability: float
    showings: tuple[Showing, ...]  # from now on, in order; the last one stays


class LightPrediction(msgspec.Struct, frozen=True):
    """The observations of a controller, and its possible courses; probabilities sum to 1."""

    controller: str
    places: tuple[int, ...]  # those in view now or before, by index
    seen: tuple[Showing, ...]  # every change so far, the last one being its present state
    courses: tuple[LightCourse, ...]

    @property
    def now(self) -> str:
        """Its present state, a letter for each place."""
        return self.seen[-1].states

    @property
    def likeliest(self) -> int:
        """The index of the likeliest course."""
        return max(range(len(self.courses)), key=lambda k: self.courses[k].probability)

    @property
    def fault(self) -> str | None:
        """The inconsistency in it, if any."""
        if not self.courses or not self.seen:
            return f"the light {self.controller!r} has no course, or was never seen"
        ways = (self.seen, *(course.showings for course in self.courses))
        if not all(way and all(len(x.states) == len(self.places) for x in way) for way in ways):
            return f"a state of the light {self.controller!r} is not a letter for each place"
        return None

    def state(self, place: int) -> str:
        """Return the letter that a place shows now; UNSEEN where it is out of view."""
        return self.now[self.places.index(place)] if place in self.places else UNSEEN

    def since(self, place: int) -> tuple[float, bool]:
        """Return since when [s] a place shows its state, and whether the change was seen."""
        at = self.places.index(place)
        k = len(self.seen) - 1
        while k > 0 and self.seen[k - 1].states[at] == self.seen[-1].states[at]:
            k -= 1
        return self.seen[k].time, k > 0 and self.seen[k - 1].states[at] != UNSEEN


class LightSupposed(msgspec.Struct, frozen=True):
    """A state that a traffic light is supposed to show permanently."""

    controller: str
    place: int
    state: str  # a letter, as in LightPrediction


class LightSample(msgspec.Struct, frozen=True):
    """The course drawn for one controller, as an index into its prediction."""

    controller: str
    course: int


class HeldByLight(msgspec.Struct, frozen=True):
    """A stretch of a drive in which a light held the driver up, at its line or in a queue."""

    controller: str
    place: int
    since: float = msgspec.field(name="from")  # [s] simulation time
    until: float = msgspec.field(name="to")  # [s]
