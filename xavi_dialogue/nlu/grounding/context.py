"""Context: the world and the discourse that a turn is grounded in, and what grounding notes."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Final, Literal, Protocol, TypeAlias

from msgspec.structs import replace

from xavi_dialogue.domain.answers import NoSuchVehicle
from xavi_dialogue.domain.discourse import Discourse, Span
from xavi_dialogue.domain.facts import Episode, Look, Somebody
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Everyone,
    Feature,
    Proposition,
    Tense,
    Thing,
    Time,
    Unsaid,
    Vehicle,
    Vehicles,
    Wanted,
    WholeRide,
)
from xavi_dialogue.nlu.grounding.world import World

#: Tells of a vehicle the episode that fits what is said of it, if there is one.
Fits: TypeAlias = Callable[[int], Episode | None]
#: What is taken for granted of an event: that it happened ("presupposed"), that it did not
#: ("denied"), nothing, though it can be looked for ("asked"), or that it is made up ("supposed").
Mode: TypeAlias = Literal["presupposed", "denied", "asked", "supposed"]


@dataclass(frozen=True, slots=True)
class Window:
    """The part of the ride that a time names."""

    begin: float  # [s]
    end: float  # [s]
    term: Time  # grounded
    search: tuple[float, float]  # [s] where an event at that time is looked for
    said: bool = False
    ahead: bool = False
    prefer: Literal["last", "first", "nearest"] = "last"  # of the events found there
    rank: int | None = None  # of the events found there
    whole: bool = False  # all of it is meant, not just the episode found there

    @property
    def span(self) -> Span:
        """The window as the span of an act."""
        whole = isinstance(self.term, WholeRide) and not self.said
        return Span(self.begin, self.end, said=self.said, ahead=self.ahead, whole=whole)


@dataclass(frozen=True, slots=True)
class Unclear:
    """A reference that fits several vehicles, none of them more than the others."""

    thing: Thing
    options: tuple[int, ...]
    moment: float  # [s]


@dataclass(slots=True)
class Notes:
    """What is found out while one act is grounded."""

    cost: float = 0.0  # of what does not fit the world
    missing: list[NoSuchVehicle] = field(default_factory=list)
    unclear: list[Unclear] = field(default_factory=list)
    unknown: list[str] = field(default_factory=list)
    leaned: bool = False
    presupposed: bool = True
    span: Span | None = None

    def spans(self, span: Span) -> None:
        """Note what part of the ride the act is about; a time that was said counts most."""
        if self.span is None or (span.said and not self.span.said):
            self.span = span


STALE: Final = 6.0  # [s] after which an episode is no longer what "back there" means
FLEETING: Final = 2.0  # [s] the same, where the present was spoken of
NOW: Final = 0.5  # [s] before a question that still counts as its present


class Context:
    """World and discourse, with what was looked up once."""

    def __init__(self, world: World, discourse: Discourse) -> None:
        self.world = world
        self.discourse = discourse
        self.now = world.now
        self.begin = world.begin
        self._looks: dict[tuple[int, float], Look | None] = {}
        self._views: dict[float, tuple[int, ...]] = {}
        self._held: dict[tuple[Event, float, float], tuple[Episode, ...]] = {}
        self._deeds: dict[tuple[object, float, float], tuple[Episode, ...]] = {}

    def within(self, discourse: Discourse) -> "Context":
        """Give the same world with a later discourse."""
        other = Context(self.world, discourse)
        other._looks, other._views = self._looks, self._views
        other._held, other._deeds = self._held, self._deeds
        return other

    @property
    def stale(self) -> bool:
        """Whether more has happened since anything was asked than "then" or "that" reaches over."""
        asked, spoken_of = self.discourse.asked_at, self.discourse.episode
        if asked is None:
            return False
        fleeting = spoken_of is not None and spoken_of[0] >= asked - NOW
        return self.now - asked > (FLEETING if fleeting else STALE)

    def look(self, vehicle: int, time: float) -> Look | None:
        """Describe a vehicle at a time."""
        key = (vehicle, time)
        if key not in self._looks:
            self._looks[key] = self.world.look(vehicle, min(time, self.now))
        return self._looks[key]

    def in_view(self, time: float) -> tuple[int, ...]:
        """List the vehicles in view at a time."""
        if time not in self._views:
            self._views[time] = self.world.in_view(min(time, self.now))
        return self._views[time]

    def deeds(self, actor: Somebody | None, begin: float, end: float) -> tuple[Episode, ...]:
        """List what somebody did."""
        key = (actor, begin, end)
        if key not in self._deeds:
            self._deeds[key] = self.world.episodes(actor=actor, begin=begin, end=end)
        return self._deeds[key]

    def holds(self, event: Event, begin: float, end: float) -> tuple[Episode, ...]:
        """List the episodes that are such an event; of a wanted actor or object, any."""
        asked = replace(
            event, time=Unsaid(), modal=None, then=None, where=None, manner=(), tense="past"
        )
        if isinstance(asked.object, Wanted | Everyone):
            asked = replace(asked, object=None)
        key = (asked, begin, end)
        if key not in self._held:
            self._held[key] = self._search(asked, begin, end)
        return self._held[key]

    def _search(self, event: Event, begin: float, end: float) -> tuple[Episode, ...]:
        if end < self.begin or begin > self.now:
            return ()
        match event:
            case Event(actor=Vehicles(numbers=numbers)):
                each = [replace(event, actor=Vehicle(n)) for n in numbers]
            case Event(actor=Wanted() | Everyone()):
                each = [replace(event, actor=Vehicle(n)) for n in self.world.vehicles]
            case Event(object=Vehicles(numbers=numbers)):
                each = [replace(event, object=Vehicle(n)) for n in numbers]
            case Event(actor=Ego() | Vehicle() | Feature()):
                return self.world.holds(event, begin, min(end, self.now))
            case _:
                return ()
        found = [episode for one in each for episode in self.holds(one, begin, end)]
        return tuple(sorted(found, key=lambda episode: episode.begin))


class Grounder(Protocol):
    """What grounds the parts of a term; the parts of this room use one another through it."""

    context: Context
    notes: Notes

    def beside(self, discourse: Discourse) -> "Grounder":
        """Give a grounder with another discourse that notes what it finds in the same place."""

    def thing(self, thing: Thing, window: Window, fits: Fits | None = None) -> Thing:
        """Ground a thing as it was in a window of the ride."""

    def event(self, event: Event, mode: Mode, outer: Window | None = None) -> Event:
        """Ground an event; `outer` is the window of the term that it stands in."""

    def proposition(
        self, proposition: Proposition, mode: Mode, outer: Window | None = None
    ) -> Proposition:
        """Ground a proposition."""

    def window(self, time: Time, tense: Tense) -> Window:
        """Find the part of the ride that a time names."""
