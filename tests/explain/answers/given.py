"""A ride of which the facts are written down by hand, for explainers that read facts alone.

What is not written down is not recorded: a measure has no value, a relation does not hold, nobody
is seen. Each fact may be a value, or a function of the time [s] that it is asked for.
"""

import pkgutil
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.events import Event as Recorded
from planner.record.places import RoadFacts, RoadPlace, RouteStep
from planner.record.trace import Action, EgoGoal, PlannedAction, PlanTrace, Settings, TimedAction
from sim.scene import VehicleState
from tests.traces import straight_track
from xavi_dialogue.domain.discourse import GroundedAct, Span
from xavi_dialogue.domain.facts import (
    Belief,
    Episode,
    Expectation,
    Gap,
    Look,
    Measure,
    OptionValue,
)
from xavi_dialogue.domain.meaning import Ask, Doing
from xavi_dialogue.domain.terms import Ego, Event, Thing, Vehicle, Wanted
from xavi_dialogue.explain import answers
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.facts.actions import covered, mirrored, somebody
from xavi_dialogue.explain.facts.episodes import happening
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride

NOW = 20.0  # [s] at which all of it is asked about


@dataclass
class Given:
    """The facts of a ride."""

    now: float = NOW
    begin: float = 0.0
    deeds: Sequence[Episode] = ()
    looks: Mapping[int, Any] = field(default_factory=dict)  # of other vehicles
    measures: Mapping[tuple[Any, ...], Any] = field(default_factory=dict)  # name, thing, maybe to
    extremes: Mapping[tuple[Any, ...], Any] = field(default_factory=dict)  # name, thing, which
    relations: Mapping[tuple[Any, ...], Any] = field(default_factory=dict)  # name, thing, to
    beliefs: Mapping[int, Any] = field(default_factory=dict)
    road: Any = None
    traces: tuple[PlanTrace, ...] = ()
    events: tuple[Recorded, ...] = ()
    ended: bool = False
    gaps: tuple[tuple[float, float], ...] = ()

    def asked(self, span: Span | None = None) -> Asked:
        """A question about these facts, or about a part of the ride."""
        record = Record(self.now, self.traces, self.events, self.ended, gaps=self.gaps)
        ride = Ride(record)
        return Asked(ride, Facts(self, ride), span, GroundedAct(Ask(Doing()), span))


class Facts(World):
    """The world of facts that were given."""

    def __init__(self, given: Given, ride: Ride) -> None:
        super().__init__(ride)
        self.given = given

    @property
    def begin(self) -> float:
        return self.given.begin

    @property
    def vehicles(self) -> tuple[int, ...]:
        return tuple(sorted(self.given.looks))

    def in_view(self, t: float) -> tuple[int, ...]:
        seen = ((v, self.look(v, t)) for v in self.vehicles)
        return tuple(v for v, look in seen if look is not None and look.in_view)

    def look(self, vehicle: int, t: float) -> Look | None:
        found: Look | None = _at(self.given.looks.get(vehicle), t)
        return found

    def road(self, t: float) -> RoadFacts | None:
        found: RoadFacts | None = _at(self.given.road, t)
        return found

    def junction(self, t: float) -> RouteStep | None:
        road = self.road(t)
        return road.route[0] if road and road.route else None

    def measure(self, attribute: Any, thing: Thing, at: float, to: Thing | None = None) -> Measure:
        known = self.given.measures
        found = _at(known.get((attribute, thing, to), known.get((attribute, thing))), at)
        if isinstance(found, Measure):
            return found
        gap: Gap | None = None if found is not None else "not-recorded"
        return Measure(attribute, thing, at, value=found, to=to, gap=gap)

    def extreme(
        self, attribute: Any, thing: Thing, which: Any, begin: float, end: float, to: Any = None
    ) -> Measure:
        known = self.given.extremes
        found = known.get((attribute, thing, which, to), known.get((attribute, thing, which)))
        found = found(begin, end) if callable(found) else found
        if isinstance(found, Measure):
            return found
        gap: Gap | None = None if found is not None else "not-recorded"
        return Measure(attribute, thing, end, value=found, to=to, extreme=which, gap=gap)

    def episodes(
        self, actor: Any = None, actions: Any = None, begin: Any = None, end: Any = None,
        object: Any = None,  # noqa: A002
    ) -> tuple[Episode, ...]:  # fmt: skip
        names = frozenset((actions,) if isinstance(actions, str) else actions or ())
        found = sorted(self.given.deeds, key=lambda e: (e.begin, e.action))
        if actions is None:
            found = [e for e in found if e.action not in happening.ON_REQUEST]
        return tuple(
            e
            for e in found
            if (actor is None or bool(_numbers(actor) & (somebody(e.actor) or frozenset())))
            and (actions is None or e.action in covered(names))
            and (begin is None or (self.now if e.end is None else e.end) >= begin - 1e-6)
            and (end is None or e.begin <= end + 1e-6)
            and (object is None or bool(_numbers(object) & (somebody(e.object) or frozenset())))
        )

    def holds(self, event: Event, begin: float, end: float) -> tuple[Episode, ...]:
        named = mirrored(event)
        actors = somebody(named.actor)
        if actors is None and not isinstance(named.actor, Wanted):
            actors = frozenset(self.vehicles)
        found = self.episodes(actors, (named.action,), begin, end)
        return happening.such(found, named, begin)

    def relation(self, relation: Any, thing: Thing, to: Thing, at: float) -> bool | None:
        found: bool | None = _at(self.given.relations.get((relation, thing, to), False), at)
        return found

    def belief(self, vehicle: int, at: float) -> Belief | None:
        found: Belief | None = _at(self.given.beliefs.get(vehicle), at)
        return found


def _at(found: Any, time: float) -> Any:
    return found(time) if callable(found) else found


def _numbers(thing: Any) -> frozenset[int]:
    if isinstance(thing, int):
        return frozenset((thing,))
    found = somebody(thing) if not isinstance(thing, Iterable) else frozenset(thing)
    return found or frozenset()


def look(vehicle: int = 1, **more: Any) -> Look:
    """A blue car 20 m ahead of us at our own 10 m/s, unless something else is said."""
    plain = Look(vehicle, NOW, "car", "blue", 4.5, "ahead", 15.5, 20.0, 0.0, 10.0)
    return replace(plain, **more)


def deed(action: Any, begin: float, end: float | None = None, to: Any = None, **more: Any) -> Any:
    """Something that we did, to another vehicle where a number is given."""
    whom = Vehicle(to) if isinstance(to, int) else to
    return Episode(more.pop("actor", Ego()), action, begin, end, whom, **more)


def their(vehicle: int, action: Any, begin: float, end: float | None = None, **more: Any) -> Any:
    """Something that another vehicle did."""
    return deed(action, begin, end, actor=Vehicle(vehicle), **more)


def expects(vehicle: int, *chances: tuple[tuple[Any, ...], float]) -> Belief:
    """What is believed of a vehicle: its actions, each with a probability."""
    return Belief(vehicle, NOW, tuple(Expectation(a, p) for a, p in chances))


def place(edge: str = "main", lane: int | None = 0, lanes: int = 2, **more: Any) -> RoadPlace:
    """A place on a road; ours, the right one of two lanes, unless something else is said."""
    return RoadPlace(
        edge, lane, lanes, 13.89, more.get("in_junction", False), more.get("roundabout", False)
    )


def step(distance: float = 60.0, **more: Any) -> RouteStep:
    """A junction ahead, at which we turn right and give way, unless something else is said."""
    plain = RouteStep(distance, "junction", "exit-right", None, None, 4, "give-way")
    return replace(plain, **more)


def option(action: Any, *, chosen: bool = False, **more: Any) -> OptionValue:
    """What a decision could choose, and does where it says so."""
    plain = OptionValue(action, chosen, "done", 1.0, 10.0, 0.0, -10.0)
    return replace(plain, **more)


def plan(
    time: float,
    *actions: Action,
    under_way: Action | None = None,
    speed: float = 10.0,  # [m/s] ours so far
    **more: Any,
) -> PlanTrace:
    """A decision for some actions, of which nothing was simulated."""
    plain = PlanTrace(
        schema="xavi.plan_trace/2",
        vehicle="car",
        sim_time=time,
        decision=round(time),
        seed=0,
        settings=Settings(),
        network="0",
        goal=EgoGoal("out", 80.0, None),
        under_way=None if under_way is None else TimedAction(under_way, time),
        history={0: straight_track(time, 0, speed)},
        scene={0: VehicleState((10.0 * time, 0.0), 0.0, speed, 0.0, 4.5, 1.8)},
        predictions=(),
        rollouts=(),
        not_applicable=(),
        plan=tuple(PlannedAction(action, -10.0, 50) for action in actions),
    )
    return replace(plain, **more)


#: Where the modules of explainers are, by their last names.
MODULES = {
    found.name.rpartition(".")[2]: found.name
    for found in pkgutil.walk_packages(answers.__path__, f"{answers.__name__}.")
    if not found.ispkg
}


@dataclass(frozen=True)
class Told:
    """What an explainer was asked to tell, in a test of who is asked."""

    by: str
    args: tuple[Any, ...] = ()
    more: Mapping[str, Any] = field(default_factory=dict)

    @property
    def events(self) -> tuple[Event, ...]:
        """The events that it was asked about."""
        return tuple(one for one in self.args if isinstance(one, Event))


def stand_in(patch: pytest.MonkeyPatch, *names: str) -> None:
    """Have explainers tell only that they were asked: by module and name."""
    for name in names:
        module, explainer = name.split(".")
        patch.setattr(f"{MODULES[module]}.{explainer}", _teller(name))


def _teller(name: str) -> Any:
    return lambda *args, **more: Told(name, args, more)


def refused(call: Any, *args: Any, **more: Any) -> Any:
    """The refusal, or the request for rollouts, that a call ends in."""
    with pytest.raises(Unanswered) as found:
        call(*args, **more)
    return found.value.result
