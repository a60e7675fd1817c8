"""Vehicles told by what holds of them, what they do, and where they are beside others."""

from typing import Any

import pytest

from planner.record.places import RoadFacts, RoadPlace
from sim.scene import EGO
from tests.nlu.grounding.fakes import Car, did, road
from tests.nlu.grounding.things.test_things import BLUE, BUS, RED, Meant
from xavi_dialogue.domain.terms import (
    At,
    Both,
    Compares,
    Described,
    Ego,
    Event,
    Exists,
    Happens,
    Has,
    Is,
    Junction,
    Measured,
    Nobody,
    Not,
    Pronoun,
    Related,
    Unsaid,
    Vehicle,
    Vehicles,
    Wanted,
)

GAP = Wanted()
PAIR = {1: Car(20.0, speed=0.4), 2: Car(50.0, kind="bus", colour="yellow", speed=9.0)}


def such(that: Any, *happened: Any, **more: Any) -> list[int]:
    """The vehicles in view of which something holds."""
    some = Described(definite=False, plural=True, such=that)
    found = Meant(some, more.pop("cars", PAIR), *happened, **more).thing
    if isinstance(found, Nobody):
        return []
    return [found.number] if isinstance(found, Vehicle) else sorted(found.numbers)


@pytest.mark.parametrize(
    ("that", "found"),
    [
        (Is("stationary", GAP), [1]),
        (Is("moving", GAP), [2]),
        (Not(Is("moving", GAP)), [1]),
        (Is("visible", GAP), [1, 2]),
        (Is("hidden", GAP), []),
        (Is("big", GAP), [2]),
        (Is("close", GAP), [1]),
        (Is("far", GAP), [2]),
        (Has("colour", "yellow", GAP), [2]),
        (Has("kind", "car", GAP), [1]),
        (Exists(GAP), [1, 2]),
        (Both((Is("moving", GAP), Is("big", GAP)), "and"), [2]),
        (Both((Is("moving", GAP), Is("close", GAP)), "and"), []),
        (Both((Is("moving", GAP), Is("close", GAP)), "or"), [1, 2]),
        (Both((Is("stationary", GAP), Is("hidden", GAP)), "or"), [1]),
        (Is("moving", Pronoun("who")), [2]),
    ],
)
def test_a_condition_tells_who_is_meant(that: Any, found: list[int]) -> None:
    assert such(that) == found


def test_relations_and_comparisons_tell_who_is_meant() -> None:
    behind = Related("behind", GAP, Described("bus"))
    assert such(behind, related=(("behind", Vehicle(1), Vehicle(2)),)) == [1]
    faster = Compares(Measured("speed", GAP), "more", Measured("speed", Ego()))
    slower = Compares(Measured("speed", GAP), "less", Measured("speed", Ego()))
    related = (("faster-than", Vehicle(2), Ego()), ("slower-than", Vehicle(1), Ego()))
    assert such(faster, related=related) == [2]
    assert such(slower, related=related) == [1]
    longer = Compares(Measured("distance", GAP), "more", Measured("distance", Ego()))
    assert such(longer, related=related) == [1, 2]  # it cannot be told of anybody


def test_what_was_done_tells_who_is_meant() -> None:
    braked = Happens(Event("brake", GAP, tense="past"))
    now = Happens(Event("brake", GAP, tense="present"))
    early, late = did("brake", 5.0, 7.0, who=1), did("brake", 36.5, 37.5, who=2)
    assert such(braked, early, late) == [1, 2]
    assert such(now, early, late) == [2]
    assert such(now, early, did("brake", 35.0, 36.9, who=2)) == []


PASSING = Event("pass", GAP, Ego(), tense="present")
FAST = (("faster-than", Vehicle(1), Ego()), ("faster-than", Vehicle(2), Ego()))


def passing(car: Car, related: Any = FAST, **more: Any) -> bool:
    cars = {1: car, 3: Car(25.0, kind="bus")}
    found = Meant(Described("car", doing=PASSING, **more), cars, related=related)
    return bool(found.thing == Vehicle(1) and found.notes.cost < 0.15)


@pytest.mark.parametrize(
    ("car", "goes"),
    [
        (Car(5.0, 3.5), True),
        (Car(-35.0, 3.5), True),
        (Car(36.0, 3.5), False),
        (Car(5.0, 1.8), True),
        (Car(5.0, 1.7), False),
        (Car(5.0, -3.5), True),
        (Car(5.0, 3.5, crossing=True), False),
        (Car(5.0, 3.5, seen=(0.0, 39.0)), False),
    ],
)
def test_who_goes_past_us_is_beside_us_and_faster(car: Car, goes: bool) -> None:
    assert passing(car) is goes


def test_who_comes_towards_us_goes_past_us_however_fast() -> None:
    assert passing(Car(20.0, 3.5, oncoming=True), related=())
    assert not passing(Car(20.0, 3.5), related=())
    assert not passing(Car(20.0, 3.5), related=None)


def test_who_passes_on_the_left_is_on_our_left() -> None:
    left = Event("pass", GAP, Ego(), tense="present", where=Related("left-of", GAP, Ego()))
    cars = {1: Car(5.0, 3.5), 2: Car(5.0, -3.5)}
    assert Meant(Described("car", doing=left), cars, related=FAST).thing == Vehicle(1)
    right = Event("overtake", GAP, Ego(), tense="present", where=Related("right-of", GAP, Ego()))
    assert Meant(Described("car", doing=right), cars, related=FAST).thing == Vehicle(2)


def coming(car: Car, facts: RoadFacts | None = None, related: Any = (), **more: Any) -> bool:
    some = Described("car", doing=Event("come", GAP, tense="present"), definite=False, **more)
    found = Meant(some, {1: car}, facts=facts, related=related).thing
    return bool(found == Vehicle(1))


def lanes(count: int) -> RoadFacts:
    return RoadFacts({0: RoadPlace("e", 0, count, 13.9, False, False)}, ())


@pytest.mark.parametrize(
    ("car", "comes"),
    [
        (Car(50.0, 3.5, oncoming=True, drift=-9.0, at=40.0), True),
        (Car(50.0, 3.5, oncoming=True, drift=9.0, at=40.0), False),
        (Car(20.0, -30.0, crossing=True, side=5.0, at=40.0), True),
        (Car(20.0, -30.0, crossing=True, side=-5.0, at=40.0), False),
        (Car(50.0, drift=-9.0, at=40.0), False),  # our leader: we come up to it
        (Car(-50.0, drift=9.0, at=40.0), False),
        (Car(50.0, 3.5, oncoming=True, seen=(39.5, 99.0)), True),  # seen only now
    ],
)
def test_who_comes_comes_nearer(car: Car, comes: bool) -> None:
    assert coming(car) is comes


def test_who_is_behind_us_comes_where_he_can_go_past_or_is_looked_for_there() -> None:
    behind = Car(-50.0, drift=9.0, at=40.0)
    assert coming(behind, lanes(2))
    assert not coming(behind, lanes(1))
    assert coming(behind, bearing="behind")
    assert not coming(Car(-50.0, drift=-9.0, at=40.0), lanes(2))


def test_who_has_right_of_way_from_the_left_comes() -> None:
    from_left = Car(30.0, 20.0, drift=1.0, at=40.0)
    first = (("has-priority-over", Vehicle(1), Ego()),)
    assert coming(from_left, related=first)
    assert not coming(from_left)
    assert not coming(Car(30.0, -20.0, drift=1.0, at=40.0), related=first)


def test_who_did_something_is_told_by_it_and_else_by_his_noun() -> None:
    cut = Event("cut-in", GAP, Ego(), tense="past")
    cars = {1: RED, 2: Car(30.0, colour="red")}
    one = Meant(Described(colour="red", doing=cut), cars, did("cut-in", 5.0, who=2, whom=0))
    assert (one.thing, one.cost) == (Vehicle(2), 0.0)
    like = Meant(Described(colour="red", doing=cut), cars, did("pull-out", 5.0, who=2, whom=0))
    assert (like.thing, like.cost) == (Vehicle(2), 0.3)
    alone = Meant(Described(colour="red", doing=cut), {1: RED, 2: BLUE})
    assert (alone.thing, alone.cost) == (Vehicle(1), 0.2)
    both = Meant(Described(colour="red", doing=cut), cars)
    assert both.notes.missing != []


def test_all_are_meant_who_ever_did_it() -> None:
    passed = Described("car", plural=True, doing=Event("overtake", Ego(), GAP, tense="past"))
    cars = {1: RED, 2: Car(-90.0, colour="blue", seen=(0.0, 9.0)), 3: BUS}
    done = (did("overtake", 5.0, whom=2), did("overtake", 35.0, whom=1))
    assert Meant(passed, cars, *done).thing == Vehicles((1, 2))


def test_somebody_beside_another() -> None:
    cars = {1: RED, 2: Car(25.0, 3.5, colour="blue"), 3: Car(60.0, kind="bus")}
    left = Described("car", bearing="left", of=Vehicle(1))
    assert Meant(left, cars, related=(("left-of", Vehicle(2), Vehicle(1)),)).thing == Vehicle(2)
    # Where it cannot be told, by where they are: 3.5 m to the left of it.
    assert Meant(left, cars, related=None).thing == Vehicle(2)
    behind = Described("vehicle", bearing="behind", of=Described("bus"))
    related = (("behind", Vehicle(1), Vehicle(3)),)
    assert Meant(behind, cars, related=related).thing == Vehicle(1)


def test_who_did_it_at_a_time_is_who_did_it_then() -> None:
    cars = {1: RED, 2: Car(30.0, colour="red")}
    cuts = (did("cut-in", 5.0, who=1, whom=0), did("cut-in", 20.0, who=2, whom=0))
    for time, vehicle in ((At(5.0), 1), (At(20.0), 2), (Unsaid(), 2)):
        cut = Event("cut-in", GAP, Ego(), time=time, tense="past")
        found = Meant(Described(colour="red", doing=cut), cars, *cuts)
        assert found.thing == Vehicle(vehicle)


def test_people_at_the_corner_are_near_the_junction_and_not_on_it() -> None:
    there = Related("on", GAP, Junction())
    cars = {
        1: Car(60.0, -8.0, kind="pedestrian"), 2: Car(20.0, 4.0, kind="pedestrian"),
        3: Car(50.0), 4: Car(12.0, kind="pedestrian", seen=(0.0, 5.0)),
    }  # fmt: skip
    inside = RoadFacts(places={EGO: RoadPlace("e", None, 1, 13.9, True, False)}, route=())
    assert such(there, cars=cars, facts=road("junction")) == [1]  # its entry is 50 m ahead
    assert such(there, cars=cars, facts=inside) == [2]
    assert such(there, cars=cars, facts=road()) == []
