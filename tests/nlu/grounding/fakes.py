"""A world made by hand: vehicles on straight tracks in our frame, and episodes as listed."""

from collections.abc import Collection
from dataclasses import dataclass, field

from msgspec.structs import replace

from planner.record.places import RoadFacts, RoadPlace, RouteStep
from sim.scene import EGO
from xavi_dialogue.domain.discourse import Discourse, Mention
from xavi_dialogue.domain.facts import Episode, Look
from xavi_dialogue.domain.meaning import Act, Ask, Question, Reading, TokenShare
from xavi_dialogue.domain.terms import Ego, Event, Junction, Thing, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName, Bearing, Kind, Relation, Side
from xavi_dialogue.explain.facts.actions import SIDES, covered
from xavi_dialogue.nlu.grounding import Grounding, ground

LENGTHS = {"truck": 12.0, "bus": 12.0, "van": 5.5, "motorcycle": 2.2}


@dataclass(frozen=True)
class Car:
    """A vehicle that keeps its speed in our frame; `oncoming` or `crossing` by its heading."""

    ahead: float  # [m] at `at`
    left: float = 0.0
    kind: Kind = "car"
    colour: str | None = "white"
    drift: float = 0.0  # [m/s] of `ahead`
    side: float = 0.0  # [m/s] of `left`
    at: float = 0.0
    seen: tuple[float, float] = (0.0, 1e9)
    oncoming: bool = False
    crossing: bool = False
    speed: float = 10.0

    def place(self, t: float) -> tuple[float, float]:
        return self.ahead + self.drift * (t - self.at), self.left + self.side * (t - self.at)


def bearing(car: Car, ahead: float, left: float) -> Bearing:
    if car.oncoming and ahead > 0.0:
        return "oncoming"
    if car.crossing:
        return "crossing-left" if left > 0.0 else "crossing-right"
    if abs(left) <= 2.0:
        return "ahead" if ahead > 0.0 else "behind"
    side = "left" if left > 0.0 else "right"
    along = "beside" if abs(ahead) < 5.0 else "ahead" if ahead > 0.0 else "behind"
    return f"{along}-{side}"  # type: ignore[return-value]


@dataclass
class FakeWorld:
    cars: dict[int, Car] = field(default_factory=dict)
    happened: tuple[Episode, ...] = ()
    now: float = 20.0
    begin: float = 0.0
    facts: RoadFacts | None = None
    across: tuple[int, ...] = ()  # who cross our way

    @property
    def vehicles(self) -> tuple[int, ...]:
        return tuple(n for n, car in sorted(self.cars.items()) if car.seen[0] <= self.now)

    def crossing(self, t: float) -> tuple[int, ...]:
        return tuple(n for n in self.in_view(t) if n in self.across)

    def in_view(self, t: float) -> tuple[int, ...]:
        return tuple(n for n, c in sorted(self.cars.items()) if c.seen[0] <= t <= c.seen[1])

    def look(self, vehicle: int, t: float) -> Look | None:
        car = self.cars.get(vehicle)
        if car is None or car.seen[0] > t:
            return None
        seen = min(t, car.seen[1])
        ahead, left = car.place(seen)
        here = bearing(car, ahead, left)
        return Look(
            vehicle, seen, car.kind, car.colour, LENGTHS.get(car.kind, 4.5), here,
            (ahead**2 + left**2) ** 0.5, ahead, left, car.speed, here == "oncoming",
            in_view=seen == t, seen=None if seen == t else seen,
        )  # fmt: skip

    def episodes(
        self,
        actor: Thing | None = None,
        actions: Collection[ActionName] | None = None,
        begin: float | None = None,
        end: float | None = None,
        object: Thing | None = None,  # noqa: A002
    ) -> tuple[Episode, ...]:
        names = None if actions is None else covered(frozenset(actions))
        return tuple(
            e
            for e in sorted(self.happened, key=lambda e: e.begin)
            if (actor is None or e.actor == actor)
            and (names is None or e.action in names)
            and (object is None or e.object == object)
            and (begin is None or (self.now if e.end is None else e.end) >= begin)
            and (end is None or e.begin <= end)
        )

    def relation(self, relation: Relation, thing: Thing, to: Thing, at: float) -> bool | None:
        return None

    def holds(self, event: Event, begin: float, end: float) -> tuple[Episode, ...]:
        if not isinstance(event.actor, Ego | Vehicle):
            return ()  # there is no traffic light
        wanted = event.object if isinstance(event.object, Ego | Vehicle) else None
        found = self.episodes(event.actor, (event.action,), begin, end, wanted)
        return tuple(
            e for e in found
            if event.side in (None, e.side or SIDES.get(e.action))
            and (not isinstance(event.object, Junction) or e.place is None
                 or e.place.form == event.object.form)
        )  # fmt: skip

    def decided(self, number: int) -> float | None:
        return None

    def road(self, t: float) -> RoadFacts | None:
        return self.facts


def did(
    action: ActionName,
    begin: float,
    end: float | None = None,
    who: int = 0,
    whom: int | None = None,
    side: Side | None = None,
    place: Junction | None = None,
    going_on: bool = False,
) -> Episode:
    """An episode; 0 is our own car."""
    over = None if going_on else begin + 1.0 if end is None else end
    target = None if whom is None else Ego() if whom == 0 else Vehicle(whom)
    actor = Ego() if who == 0 else Vehicle(who)
    return Episode(actor, action, begin, over, target, side, place=place)


def road(*steps: str, roundabout: bool = False) -> RoadFacts:
    """The road ahead: kinds of junctions by distance."""
    route = tuple(
        RouteStep(50.0 * (k + 1), kind, "exit-straight", None, None, 4, "priority")  # type: ignore[arg-type]
        for k, kind in enumerate(steps)
    )
    here = RoadPlace("e", 0, 1, 13.9, roundabout, roundabout)
    return RoadFacts(places={EGO: here}, route=route)


def reading(*acts: Act, cost: float = 0.0, shares: tuple[TokenShare, ...] = ()) -> Reading:
    return Reading(acts, shares, cost)


def asked(question: Question, world: FakeWorld, discourse: Discourse | None = None) -> Grounding:
    return ground((reading(Ask(question)),), world, discourse or Discourse())


def act(spoken: Act, world: FakeWorld, discourse: Discourse | None = None) -> Grounding:
    return ground((reading(spoken),), world, discourse or Discourse())


def question_of(grounding: Grounding) -> Question:
    """The question of the only act."""
    assert grounding.clarify is None, grounding.clarify
    assert grounding.refusal is None, grounding.refusal
    (only,) = grounding.acts
    assert isinstance(only.act, Ask), only.act
    return only.act.question


def talk(*things: Thing, **fields: object) -> Discourse:
    """A discourse in which things were spoken of, the first most lately."""
    mentions = tuple(
        Mention(thing, 1, False, 0.9 * 0.8**k, "subject") for k, thing in enumerate(things)
    )
    return replace(Discourse(turn=2, mentions=mentions), **fields)
