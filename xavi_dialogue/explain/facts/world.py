"""World: the facts of a ride, asked by thing, attribute, action and time."""

from collections.abc import Iterable, Mapping

from planner.record.places import RoadFacts, RouteStep
from planner.record.trace import Action as MacroAction
from xavi_dialogue.domain.facts import Belief, Episode, Look, Measure
from xavi_dialogue.domain.terms import Event, Feature, Thing
from xavi_dialogue.domain.vocabulary import ActionName, Attribute, Extreme, Relation
from xavi_dialogue.explain.facts import beliefs, looks, plans, relations
from xavi_dialogue.explain.facts.actions import covered, mirrored, somebody
from xavi_dialogue.explain.facts.episodes import happening
from xavi_dialogue.explain.facts.episodes.crossing import crossing
from xavi_dialogue.explain.facts.episodes.light_events import light_episodes
from xavi_dialogue.explain.facts.measures import extremes, measuring
from xavi_dialogue.explain.facts.states import states_of
from xavi_dialogue.explain.history.motion import EPSILON
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride, planned

LETTING_GO = frozenset[ActionName](("give-way", "let-go"))


class World:
    """What the record of a ride shows; all times are simulation seconds.

    Nothing is computed before it is asked for.
    """

    def __init__(self, ride: Ride) -> None:
        self.ride = ride
        self.states = states_of(ride)

    @property
    def now(self) -> float:
        """The moment [s] of the question."""
        return self.ride.now

    @property
    def begin(self) -> float:
        """The first moment [s] of the record."""
        return self.states.begin

    @property
    def vehicles(self) -> tuple[int, ...]:
        """All other vehicles seen so far."""
        return self.ride.vehicles

    def in_view(self, t: float) -> tuple[int, ...]:
        """Return the vehicles in view at a time, in order of their numbers."""
        return self.states.memo(("view", t), lambda: self.states.in_view(t))

    def crossing(self, t: float) -> tuple[int, ...]:
        """Return who crosses our way at a time, crossed it lately or is about to."""
        return self.states.memo(("crossing", t), lambda: crossing(self.states, t))

    def look(self, vehicle: int, t: float) -> Look | None:
        """Return a vehicle as it is seen at a time, or was seen last; None if it never was."""
        return looks.look(self.states, vehicle, t)

    def road(self, t: float) -> RoadFacts | None:
        """Return the road as it was known at a time; None if no record keeps it."""
        return self.states.road(t)

    def junction(self, t: float) -> RouteStep | None:
        """Return the junction that we are in at a time, or come to next; None if unknown."""
        return self.states.junction(t)

    def measure(
        self, attribute: Attribute, thing: Thing, at: float, to: Thing | None = None
    ) -> Measure:
        """Return the value of an attribute at a time, or why it has none."""
        return measuring.measure(self.states, attribute, thing, at, to)

    def extreme(
        self,
        attribute: Attribute,
        thing: Thing,
        which: Extreme,
        begin: float,
        end: float,
        to: Thing | None = None,
    ) -> Measure:
        """Return the highest, lowest, first, last, mean or total value over an interval."""
        return extremes.extreme(self.states, attribute, thing, which, (begin, end), to)

    def episodes(
        self,
        actor: Thing | int | Iterable[int] | None = None,
        actions: Iterable[ActionName] | ActionName | None = None,
        begin: float | None = None,
        end: float | None = None,
        object: Thing | int | None = None,  # noqa: A002
    ) -> tuple[Episode, ...]:
        """Return the episodes that overlap an interval, in order of their beginnings.

        Args:
            actor: the actor; None: anybody.
            actions: the actions, each with all that count as it; None: any.
            begin: the begin of the interval; None: that of the ride.
            end: the end of the interval; None: now.
            object: the road user that it concerns; None: anybody or nobody.
        """
        wanted = None if actions is None else covered(_names(actions))
        actors, objects = _numbers(actor), _numbers(object)
        found = []
        for episode in happening.happening(self.states, actors, wanted):
            until = self.now if episode.end is None else episode.end
            if begin is not None and until < begin - EPSILON:
                continue
            if end is not None and episode.begin > end + EPSILON:
                continue
            whom = somebody(episode.object)
            if objects is not None and (whom is None or not whom & objects):
                continue
            found.append(episode)
        return tuple(found)

    def holds(self, event: Event, begin: float, end: float) -> tuple[Episode, ...]:
        """Return the episodes in an interval that a grounded event describes."""
        lit = light_episodes(self.states, event, begin, end)
        if lit is not None:
            return lit
        named = mirrored(event)
        actors = happening.actors_of(self.states, named)
        found = self.episodes(actors, (named.action,), begin, end)
        if named.action in LETTING_GO:  # whom we stand behind we do not let go first, nor a light
            found = tuple(e for e in found if e.how in (None, "right-of-way"))
            by_light = isinstance(named.object, Feature)
            found = tuple(e for e in found if by_light or not isinstance(e.object, Feature))
        return happening.such(found, named, begin)

    def account(self, begin: float, end: float) -> tuple[Episode, ...]:
        """Return the episodes of an interval that are worth mentioning, without repetitions."""
        return happening.account(self.episodes(begin=begin, end=end))

    def duration(self, episode: Episode) -> float:
        """Return how long [s] an episode lasted, or has lasted."""
        return max((self.now if episode.end is None else episode.end) - episode.begin, 0.0)

    def delay(self, episode: Episode) -> Measure:
        """Return the time that an episode cost compared with driving on as before."""
        return measuring.delay(self.states, episode)

    def relation(self, relation: Relation, thing: Thing, to: Thing, at: float) -> bool | None:
        """Check whether a relation holds at a time; None if that cannot be known."""
        return relations.holds(self.states, relation, thing, to, at)

    def belief(self, vehicle: int, at: float) -> Belief | None:
        """Return what was believed of a vehicle at the last decision up to a time."""
        return beliefs.belief(self.states, vehicle, at)

    def beliefs(self, vehicle: int, begin: float, end: float) -> tuple[Belief, ...]:
        """Return what was believed of a vehicle at each decision of an interval."""
        return beliefs.over(self.states, vehicle, begin, end)

    def probability(self, event: Event, at: float) -> float | None:
        """Return the believed probability of another vehicle's event; None: not known."""
        return beliefs.probability(self.states, event, at)

    def plan(self, at: float) -> tuple[MacroAction, ...]:
        """Return what the last decision up to a time meant to do, in order."""
        trace = self.states.trace(at)
        return () if trace is None else planned(trace)

    def decided(self, number: int) -> float | None:
        """Return when [s] the decision with a number was taken; None if it is not recorded."""
        found = (t.sim_time for t in self.ride.traces if t.decision == number)
        return next(found, None)

    def beginnings(self) -> Mapping[ActionName, float]:
        """Return when each action of the ego's plan is expected to begin [s]."""
        return plans.beginnings(self.ride)


_kept: list[World] = []  # latest first
KEPT = 2  # worlds that are kept for the questions that follow


def world_of(record: Record) -> World:
    """Return the world of a record; the parts of one question get the same object."""
    for known in _kept:
        if known.ride.record is record:
            return known
    found = World(Ride(record))
    _kept[:] = [found, *_kept][:KEPT]
    return found


def _names(actions: Iterable[ActionName] | ActionName) -> frozenset[ActionName]:
    return frozenset((actions,)) if isinstance(actions, str) else frozenset(actions)


def _numbers(thing: Thing | int | Iterable[int] | None) -> frozenset[int] | None:
    if thing is None:
        return None
    if isinstance(thing, int):
        return frozenset((thing,))
    if isinstance(thing, Iterable):
        return frozenset(thing)
    return somebody(thing)
