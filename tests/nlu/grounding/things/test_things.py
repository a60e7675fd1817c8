"""Things grounded one by one: who is meant, what it costs, and what is noted."""

from typing import Any

import pytest

from planner.record.places import RoadFacts, RoadPlace, RouteStep
from tests.nlu.grounding.fakes import Car, FakeWorld, did, talk
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Everyone,
    Junction,
    Lane,
    Nobody,
    Now,
    Passenger,
    Pronoun,
    Thing,
    Unknown,
    Unsaid,
    Vehicle,
    Vehicles,
    Wanted,
)
from xavi_dialogue.nlu.grounding.context import Context, Window
from xavi_dialogue.nlu.grounding.grounder import TermGrounder

NOW = 40.0
PRESENT = Window(NOW, NOW, Now(), (37.0, NOW))


class Knowing(FakeWorld):
    """A world that knows of some relations."""

    related: frozenset[tuple[Any, Thing, Thing]] = frozenset()
    known: bool = True

    def relation(self, relation: Any, thing: Thing, to: Thing, at: float) -> bool | None:
        return (relation, thing, to) in self.related if self.known else None


class Meant:
    """A thing grounded at 40 s."""

    def __init__(
        self,
        thing: Thing,
        cars: dict[int, Car],
        *happened: Any,
        discourse: Discourse | None = None,
        window: Window = PRESENT,
        facts: RoadFacts | None = None,
        related: tuple[tuple[Any, Thing, Thing], ...] | None = (),
    ) -> None:
        world = Knowing(cars, happened, now=NOW, facts=facts)
        world.related, world.known = frozenset(related or ()), related is not None
        g = TermGrounder(Context(world, discourse or Discourse()))
        self.thing: Any = g.thing(thing, window)
        self.notes = g.notes

    @property
    def cost(self) -> Any:
        return pytest.approx(self.notes.cost)


def at(begin: float, end: float | None = None) -> Window:
    last = begin if end is None else end
    return Window(begin, last, Unsaid(), (begin, last), said=True)


RED, BLUE, BUS = (
    Car(20.0, colour="red"),
    Car(-15.0, colour="blue"),
    Car(40.0, 3.5, kind="bus", colour="yellow"),
)
THREE = {1: RED, 2: BLUE, 3: BUS}


@pytest.mark.parametrize(
    ("thing", "found"),
    [
        (Passenger(), Ego()),
        (Vehicle(0), Ego()),
        (Ego(), Ego()),
        (Vehicle(2), Vehicle(2)),
        (Vehicles((1, 3)), Vehicles((1, 3))),
        (Pronoun("who"), Wanted()),
        (Lane("left"), Lane("left")),
        (Lane("own", of=Described("bus")), Lane("own", of=Vehicle(3))),
        (Lane("own", of=Passenger()), Lane("own")),
        (Everyone(), Everyone()),
    ],
)
def test_things_that_are_clear(thing: Thing, found: Thing) -> None:
    one = Meant(thing, THREE)
    assert (one.thing, one.cost) == (found, 0.0)


def test_numbers_of_nobody_are_noted_with_who_is_near() -> None:
    for thing in (Vehicle(9), Vehicles((1, 9))):
        one = Meant(thing, {**THREE, 4: Car(90.0)})
        assert (one.thing, one.cost) == (thing, 0.8)
        (missing,) = one.notes.missing
        assert (missing.thing, missing.time) == (Vehicle(9), 40.0)
        assert [look.vehicle for look in missing.known] == [2, 1, 3]


def test_words_without_a_sense_cost_most() -> None:
    one = Meant(Unknown("flurb"), THREE)
    assert (one.thing, one.cost, one.notes.unknown) == (Unknown("flurb"), 1.5, ["flurb"])


def test_a_description_that_says_nothing_costs() -> None:
    assert Meant(Described(), {1: RED}).cost == 0.4
    assert Meant(Described("car"), {1: RED}).cost == 0.0


@pytest.mark.parametrize(
    ("described", "vehicle", "cost"),
    [
        (Described("car", colour="red"), 1, 0.0),
        (Described("van", colour="yellow"), 3, 1.0 - 0.4),
        (Described("car", colour="orange"), 1, 0.4),
        (Described("bus", colour="gold"), 3, 0.4),
        (Described("car", colour="green"), None, 0.8),
        (Described("bus", colour="green"), 3, 0.4),
        (Described("truck", colour="yellow"), 3, 0.5),
        (Described("motorcycle", colour="green"), None, 0.8),
    ],
)
def test_how_well_somebody_fits(described: Described, vehicle: int | None, cost: float) -> None:
    one = Meant(described, THREE)
    if vehicle is None:
        assert (one.thing, one.cost) == (described, cost)
        assert one.notes.missing[0].misdescribed is None
    elif described.kind != "van":
        assert (one.thing, one.cost) == (Vehicle(vehicle), cost)


def test_who_is_described_wrongly_is_taken_with_the_look_that_he_has() -> None:
    one = Meant(Described("bus", colour="green"), THREE)
    (missing,) = one.notes.missing
    assert missing.misdescribed is not None
    assert missing.misdescribed.vehicle == 3
    two = {**THREE, 4: Car(30.0, 3.5, kind="bus", colour="white")}
    assert Meant(Described("bus", colour="green"), two).notes.missing[0].misdescribed is None


def test_somebody_indefinite_who_fits_nobody_is_nobody() -> None:
    some = Described("motorcycle", definite=False)
    one = Meant(some, THREE)
    assert (one.thing, one.cost) == (Nobody(described=some), 0.0)


@pytest.mark.parametrize(
    ("seen", "time", "found"),
    [
        ((0.0, 99.0), 10.0, True),
        ((20.0, 99.0), 10.0, True),  # it is there now
        ((0.0, 5.0), 10.0, True),  # it was there lately
        ((0.0, 3.0), 30.0, True),  # ... or ever
    ],
)
def test_whoever_was_seen_may_be_meant(seen: tuple[float, float], time: float, found: bool) -> None:
    cars = {1: Car(20.0, colour="red", seen=seen), 2: BLUE}
    one = Meant(Described(colour="red"), cars, window=at(time))
    assert (one.thing == Vehicle(1)) is found


def test_who_is_in_view_is_meant_rather_than_who_was() -> None:
    cars = {1: Car(20.0, colour="red", seen=(0.0, 20.0)), 2: Car(60.0, colour="red")}
    assert Meant(Described(colour="red"), cars).thing == Vehicle(2)
    assert Meant(Described(colour="red"), cars, window=at(10.0)).notes.unclear == []
    gone = {1: cars[1], 2: BLUE}
    assert isinstance(Meant(Described(colour="red", definite=False), gone).thing, Nobody)


def test_with_several_that_fit_it_is_noted_as_unclear() -> None:
    two = {1: Car(30.0, 3.5), 2: Car(30.0, -3.5), 3: Car(90.0, kind="bus")}
    one = Meant(Described("car", colour="white"), two)
    (unclear,) = one.notes.unclear
    assert (unclear.options, unclear.moment) == ((1, 2), 40.0)
    assert Meant(Described("car", colour="white", definite=False), two).notes.unclear == []
    assert Meant(Described("car", plural=True), two).thing == Vehicles((1, 2))
    assert Meant(Described("bus", plural=True), two).thing == Vehicle(3)


def test_another_one_is_not_who_was_spoken_of() -> None:
    two = {1: Car(30.0, colour="red"), 2: Car(60.0, colour="red")}
    other = Described(colour="red", other=True)
    assert Meant(other, two, discourse=talk(Vehicle(1))).thing == Vehicle(2)
    alone = {1: two[1]}
    assert Meant(other, alone, discourse=talk(Vehicle(1))).cost == 0.8
    some = Described(colour="red", other=True, definite=False)
    assert Meant(some, alone, discourse=talk(Vehicle(1))).thing == Nobody(described=some)


@pytest.mark.parametrize(
    ("discourse", "found", "cost"),
    [
        (talk(Vehicle(2)), Vehicle(2), 0.0),
        (talk(Vehicle(2), Vehicle(1)), Vehicle(2), 0.0),
        (talk(Vehicle(9)), Vehicle(1), 0.1),  # nobody knows it: the scene tells
        (Discourse(), Vehicle(1), 0.1),
    ],
)
def test_it_is_who_was_spoken_of_or_our_leader(
    discourse: Discourse, found: Thing, cost: float
) -> None:
    one = Meant(Pronoun("it"), THREE, discourse=discourse)
    assert (one.thing, one.cost) == (found, cost)


def test_it_is_nobody_where_nobody_is() -> None:
    one = Meant(Pronoun("it"), {})
    assert (one.thing, one.cost) == (Pronoun("it"), 0.8)
    assert one.notes.missing[0].thing == Pronoun("it")


def test_all_of_them() -> None:
    both = Pronoun("them-all")
    assert Meant(both, THREE).thing == Everyone()
    assert Meant(both, THREE, discourse=talk(Vehicles((1, 3)))).thing == Vehicles((1, 3))
    spoken = talk(Vehicle(3), Vehicle(1), Vehicle(2))
    assert Meant(both, THREE, discourse=spoken).thing == Vehicles((1, 3))
    assert Meant(both, {1: RED, 2: BLUE}).thing == Vehicles((1, 2))
    assert Meant(both, {1: RED}).thing == Everyone()
    they = Pronoun("they")
    assert Meant(they, THREE, discourse=talk(Vehicles((1, 3)))).thing == Vehicles((1, 3))
    assert Meant(they, THREE, discourse=talk(Vehicle(2), Vehicles((1, 3)))).thing == Vehicles(
        (1, 3)
    )


RING = Junction("roundabout", time=20.0)


def step(kind: Any, distance: float) -> RouteStep:
    return RouteStep(distance, kind, "exit-straight", None, None, 4, "priority")


def ahead(*kinds: str, ring: bool = False) -> RoadFacts:
    route = tuple(step(kind, 50.0 * k) for k, kind in enumerate(kinds, 1))
    return RoadFacts({0: RoadPlace("e", 0, 1, 13.9, ring, ring)}, route)


PASSED = (did("enter", 20.0, place=RING), did("leave", 25.0, place=RING))


@pytest.mark.parametrize(
    ("place", "facts", "window", "found", "cost"),
    [
        (Junction("roundabout"), ahead(), PRESENT, Junction("roundabout", time=20.0), 0.0),
        (Junction("roundabout", -1), ahead(), PRESENT, Junction("roundabout", -1, 20.0), 0.0),
        (Junction("roundabout", -2), ahead(), PRESENT, Junction("roundabout", -2), 0.8),
        (Junction("roundabout", 1), ahead("roundabout"), PRESENT, Junction("roundabout", 1), 0.0),
        (Junction("roundabout", 2), ahead("roundabout"), PRESENT, Junction("roundabout", 2), 0.8),
        (Junction("roundabout"), ahead("roundabout"), PRESENT, Junction("roundabout", 1), 0.0),
        (Junction("roundabout"), ahead("roundabout"), at(22.0), Junction("roundabout", time=20.0),
         0.0),
        (Junction("junction"), ahead(), PRESENT, Junction("roundabout", time=20.0), 0.2),
        (Junction("junction"), ahead("junction"), PRESENT, Junction("junction", 1), 0.0),
        (RING, ahead(), PRESENT, RING, 0.0),
    ],
)  # fmt: skip
def test_junctions(
    place: Junction, facts: Any, window: Window, found: Junction, cost: float
) -> None:
    one = Meant(place, THREE, *PASSED, facts=facts, window=window)
    assert (one.thing, one.cost) == (found, cost)


def test_a_roundabout_that_we_are_on_is_this_one() -> None:
    one = Meant(Junction("roundabout"), THREE, PASSED[0], facts=ahead("roundabout", ring=True))
    assert one.thing == RING
