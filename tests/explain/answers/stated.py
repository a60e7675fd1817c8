"""A ride of which every fact is stated, for tests of what explainers make of facts.

Times are in seconds; a ride begins at 0 s and is asked about at 20 s, unless said otherwise.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from msgspec.structs import replace

from planner.record.events import Event as RideEvent
from planner.record.places import PriorityFact, RoadFacts, RoadPlace, RouteStep
from planner.record.trace import PlanTrace
from tests.traces import Aim, End, Way, World, trace_of
from xavi_dialogue.domain.discourse import GroundedAct, Span
from xavi_dialogue.domain.facts import Belief, Episode, Expectation, Look, Measure
from xavi_dialogue.domain.meaning import Ask, Doing
from xavi_dialogue.domain.terms import Ego, Event, Thing, Vehicle, Wanted
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.facts.actions import covered, mirrored, somebody
from xavi_dialogue.explain.facts.episodes import happening
from xavi_dialogue.explain.facts.world import World as Facts
from xavi_dialogue.explain.history.motion import Motion
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride

NOW = 20.0
US = Ego()
NOTHING = Motion((), (), (), ())


@dataclass(frozen=True)
class Said:
    """What is stated of a ride."""

    episodes: tuple[Episode, ...] = ()
    looks: Mapping[int, Any] = None  # type: ignore[assignment]  # Look, or Look by time
    values: Mapping[tuple[Any, ...], Any] = None  # type: ignore[assignment]  # see `_value`
    beliefs: tuple[Belief, ...] = ()
    road: Any = None  # RoadFacts, or RoadFacts by time
    delays: Mapping[str, float] = None  # type: ignore[assignment]  # [s] by action
    motions: Mapping[int, Motion] = None  # type: ignore[assignment]
    begin: float = 0.0


class StatedRide(Ride):
    """A ride whose motions are stated."""

    said: Said

    def motion(self, vehicle: int) -> Motion:
        return (self.said.motions or {}).get(vehicle, NOTHING)

    @property
    def vehicles(self) -> tuple[int, ...]:
        return tuple(sorted(self.said.looks or {}))


class StatedWorld(Facts):
    """Facts as they are stated; what is not stated is not recorded."""

    def __init__(self, ride: StatedRide, said: Said) -> None:
        super().__init__(ride)
        self.said = said

    @property
    def begin(self) -> float:
        return self.said.begin

    def in_view(self, t: float) -> tuple[int, ...]:
        seen = ((v, self.look(v, t)) for v in self.vehicles)
        return tuple(v for v, one in seen if one is not None and one.in_view)

    def look(self, vehicle: int, t: float) -> Look | None:
        found = (self.said.looks or {}).get(vehicle)
        return found(t) if callable(found) else found and replace(found, time=t)

    def road(self, t: float) -> RoadFacts | None:
        found: RoadFacts | None = self.said.road(t) if callable(self.said.road) else self.said.road
        return found

    def junction(self, t: float) -> RouteStep | None:
        road = self.road(t)
        return road.route[0] if road and road.route else None

    def measure(self, attribute: Any, thing: Thing, at: float, to: Thing | None = None) -> Measure:
        known = self._value(attribute, thing, at, to)
        return Measure(attribute, thing, at, to=to, **known)

    def extreme(
        self, attribute: Any, thing: Thing, which: Any, begin: float, end: float,
        to: Thing | None = None,
    ) -> Measure:  # fmt: skip
        """The extreme of the values at every half second."""
        times = [begin + 0.5 * k for k in range(int((end - begin) / 0.5 + 1e-6) + 1)]
        known = [(t, self._value(attribute, thing, t, to)) for t in times]
        told = [(one["value"], t) for t, one in known if "value" in one]
        if not told:
            return Measure(
                attribute, thing, begin, to=to, gap=known[0][1]["gap"] if known else "in-future"
            )
        value, time = min(told) if which == "lowest" else max(told, key=lambda x: (x[0], -x[1]))
        return Measure(attribute, thing, time, value=value, to=to, until=end, extreme=which)

    def _value(self, attribute: Any, thing: Thing, at: float, to: Thing | None) -> dict[str, Any]:
        """A number, the fields of a measure, or either by time; None: not recorded."""
        known = self.said.values or {}
        key = (attribute, number_of(thing))
        found = known.get((*key, number_of(to)), known.get(key))
        found = found(at) if callable(found) else found
        if found is None:
            return {"gap": "not-recorded"}
        return found if isinstance(found, dict) else {"value": found}

    def episodes(
        self, actor: Any = None, actions: Any = None, begin: float | None = None,
        end: float | None = None, object: Any = None,  # noqa: A002
    ) -> tuple[Episode, ...]:  # fmt: skip
        names: Any = (actions,) if isinstance(actions, str) else actions
        wanted = None if names is None else covered(frozenset(names))
        who = actor if actor is None or isinstance(actor, frozenset) else somebody(actor)
        whom = None if object is None else somebody(object)
        return tuple(
            e
            for e in sorted(self.said.episodes, key=lambda e: e.begin)
            if (wanted is None or e.action in wanted)
            and (who is None or bool((somebody(e.actor) or frozenset()) & who))
            and (whom is None or bool((somebody(e.object) or frozenset()) & whom))
            and (begin is None or (self.now if e.end is None else e.end) >= begin)
            and (end is None or e.begin <= end)
        )

    def holds(self, event: Event, begin: float, end: float) -> tuple[Episode, ...]:
        named = mirrored(event)
        who = somebody(named.actor)
        if who is None and not isinstance(named.actor, Wanted):
            who = frozenset(self.vehicles)
        return happening.such(self.episodes(who, (named.action,), begin, end), named, begin)

    def account(self, begin: float, end: float) -> tuple[Episode, ...]:
        return happening.account(self.episodes(begin=begin, end=end))

    def delay(self, episode: Episode) -> Measure:
        known = (self.said.delays or {}).get(episode.action)
        return Measure("delay", episode.actor, episode.begin, value=known,
                       gap=None if known is not None else "not-applicable")  # fmt: skip

    def belief(self, vehicle: int, at: float) -> Belief | None:
        found = [b for b in self.said.beliefs if b.vehicle == vehicle and b.time <= at]
        return found[-1] if found else None

    def beliefs(self, vehicle: int, begin: float, end: float) -> tuple[Belief, ...]:
        return tuple(
            b for b in self.said.beliefs if b.vehicle == vehicle and begin <= b.time <= end
        )


class Everything(tuple[Any, ...]):
    """Holds whatever is looked for in it."""

    def __contains__(self, _: object) -> bool:
        return True


def number_of(thing: Thing | None) -> int | None:
    """The number of a road user; None for all else."""
    return next(iter(somebody(thing) or ()), None)


def scene(
    span: Span | None = None, *, now: float = NOW, traces: Iterable[PlanTrace] = (),
    events: Iterable[RideEvent] = (), ended: bool = False,
    gaps: tuple[tuple[float, float], ...] = (), act: Any = None,
    extra: tuple[PlanTrace, ...] = (), again: bool = True, **said: Any,
) -> Asked:  # fmt: skip
    """The setting of a question about what is stated; `again`: plans can be asked for anew."""
    refused = () if again else Everything()
    record = Record(now, tuple(traces), tuple(events), ended, extra, refused, gaps)
    ride = StatedRide(record)
    ride.said = Said(**said)
    world = StatedWorld(ride, ride.said)
    return Asked(ride, world, span, GroundedAct(act or Ask(Doing()), span))


def result(explainer: Callable[..., Any], *args: Any) -> Any:
    """What an explainer tells or refuses with."""
    try:
        return explainer(*args)
    except Unanswered as unanswered:
        return unanswered.result


def did(action: Any, begin: float, end: float | None = None, **more: Any) -> Episode:
    """Something that we did."""
    return Episode(US, action, begin, end, **more)


def they(vehicle: int, action: Any, begin: float, end: float | None = None, **more: Any) -> Episode:
    """Something that another vehicle did."""
    return Episode(Vehicle(vehicle), action, begin, end, **more)


def look(vehicle: int, ahead: float = 20.0, left: float = 0.0, **more: Any) -> Look:
    """A vehicle as it is seen; red, and at 10 m/s unless said otherwise."""
    given: dict[str, Any] = {
        "kind": "car", "colour": "red", "length": 4.5, "distance": abs(ahead), "speed": 10.0,
        "bearing": "ahead" if ahead >= 0.0 else "behind",
    }  # fmt: skip
    return Look(vehicle=vehicle, time=0.0, ahead=ahead, left=left, **(given | more))


def belief(vehicle: int, time: float, *shares: tuple[Any, float]) -> Belief:
    """What was believed of a vehicle: (actions, probability), likeliest first."""
    each: list[tuple[Any, float]] = [((a,) if isinstance(a, str) else a, p) for a, p in shares]
    return Belief(vehicle, time, tuple(Expectation(*one) for one in each))


def driven(xs: Iterable[float], y: float = 0.0, *, speed: Any = 10.0, step: float = 1.0,
           since: float = 0.0, heading: float = 0.0, ys: Iterable[float] | None = None) -> Motion:  # fmt: skip  # noqa: E501
    """A motion with a sample each step [s]."""
    places = tuple(xs)
    across = tuple(ys) if ys is not None else (y,) * len(places)
    speeds = tuple(speed) if isinstance(speed, tuple | list) else (speed,) * len(places)
    times = tuple(since + step * k for k in range(len(places)))
    return Motion(times, tuple(zip(places, across, strict=True)), (heading,) * len(places), speeds)


def aim(kind: Any, share: float, *, ways: tuple[Way, ...] = ()) -> Aim:
    """A goal of a vehicle, reached by one way unless several are given."""
    return Aim(kind, share, ways or (Way((kind,)),))


def decision(
    time: float, plan: tuple[Any, ...] = ("continue",), *, aims: Mapping[int, Any] | None = None,
    road: RoadFacts | None = None, ends: Mapping[Any, Any] | None = None, **more: Any,
) -> PlanTrace:  # fmt: skip
    """A decision for a plan; `ends` has what comes of plans, or that by what others choose."""
    plans = (plan, *(other for other in (ends or {}) if other != plan))
    known = dict(ends or {})
    refused = more.pop("not_applicable", ())
    world = World(aims or {}, plans, lambda p, chosen: (_end(known.get(p), chosen), len(p)),
                  refused, plan)  # fmt: skip
    return replace(trace_of(world, time=time, decision=int(time), **more), road=road)


def rolled(*speeds: float, time: float = NOW, plan: Any = ("continue",), **more: Any) -> PlanTrace:
    """A decision under whose plan we drive at these speeds, five a second."""
    trace = decision(time, plan, **more)
    path = tuple((float(k), 0.0) for k in range(len(speeds)))
    rollouts = tuple(replace(r, path=path, speed=tuple(speeds)) for r in trace.rollouts)
    return replace(trace, rollouts=rollouts)


def _end(known: Any, chosen: Any) -> End:
    found = known(chosen) if callable(known) else known
    return End(time=10.0) if found is None else found


def thoughts(*shares: tuple[float, float], vehicle: int = 1) -> dict[str, Any]:
    """Decisions, and what was believed at them: (time, how surely the vehicle turns left)."""
    aims = [{vehicle: (aim("exit-left", p), aim("continue", 1.0 - p))} for _, p in shares]
    told = [(("exit-left", p), ("continue", 1.0 - p)) for _, p in shares]
    ranked = [sorted(one, key=lambda x: -x[1]) for one in told]
    return {
        "looks": {vehicle: look(vehicle)},
        "traces": [decision(t, aims=a) for (t, _), a in zip(shares, aims, strict=True)],
        "beliefs": tuple(
            belief(vehicle, t, *one) for (t, _), one in zip(shares, ranked, strict=True)
        ),
    }


def roads(
    *priority: tuple[int, Any], route: tuple[RouteStep, ...] = (), places: Any = None
) -> RoadFacts:
    """What is known of the road: who goes first, what comes, and where everybody is."""
    facts = tuple(PriorityFact(*one) for one in priority)
    return RoadFacts(places or {}, route, 200.0, 20.0, facts)


def place(edge: str = "main", lane: int | None = 0, **more: Any) -> RoadPlace:
    """A place on a road of two lanes."""
    given: dict[str, Any] = {"lanes": 2, "limit": 13.9, "in_junction": False, "roundabout": False}
    return RoadPlace(edge, lane, **(given | more))


def step(distance: float = 50.0, turn: Any = "exit-right", **more: Any) -> RouteStep:
    """A junction on our way."""
    given: dict[str, Any] = {
        "kind": "junction", "exit": None, "exits": None, "arms": 4, "rule": "priority",
    }  # fmt: skip
    return RouteStep(distance=distance, turn=turn, **(given | more))
