"""Descriptions of vehicles, resolved against who was there."""

import pytest

from tests.nlu.grounding.fakes import Car, FakeWorld, act, asked, did, question_of, talk
from xavi_dialogue.domain.answers import NoSuchVehicle
from xavi_dialogue.domain.meaning import (
    Ask,
    HowMany,
    HowMuch,
    Identify,
    Request,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    At,
    Described,
    Ego,
    Event,
    Exists,
    Happens,
    Is,
    Measured,
    Nobody,
    Not,
    Passenger,
    Pronoun,
    Related,
    Thing,
    Vehicle,
    Vehicles,
    Wanted,
)

STREET = FakeWorld(
    {
        1: Car(20.0, 0.0, "truck", "brown"),  # our leader
        2: Car(-15.0, 0.0, "car", "red"),
        3: Car(2.0, 3.5, "car", "blue"),
        4: Car(60.0, 3.5, "car", "blue"),
        5: Car(40.0, -20.0, "bus", "yellow", crossing=True),
        6: Car(80.0, 3.5, "car", "black", oncoming=True),
        7: Car(90.0, 0.0, "van", "white"),
    },
    (
        did("cut-in", 4.0, 6.0, who=7, whom=0),
        did("give-way", 10.0, 12.0, whom=5),
        did("brake", 9.0, 11.0, who=1),
        did("signal", 18.5, None, who=4, side="left", going_on=True),
    ),
)


def meant(thing: Thing, world: FakeWorld = STREET, **fields: object) -> Thing:
    found = question_of(asked(Identify(thing), world, talk(**fields)))
    assert isinstance(found, Identify)
    return found.thing


@pytest.mark.parametrize(
    ("described", "vehicle"),
    [
        (Described(kind="truck"), 1),
        (Described(kind="truck", size="big"), 1),
        (Described(kind="bus"), 5),
        (Described(colour="red"), 2),
        (Described(kind="car", colour="yellow"), 5),  # a lay person's "car"
        (Described(kind="truck", colour="white"), 7),  # a van may pass for a lorry
        (Described(kind="car", colour="orange"), 2),  # red may pass for orange
        (Described(bearing="ahead"), 1),
        (Described(bearing="behind"), 2),
        (Described(kind="car", bearing="left"), 3),
        (Described(bearing="beside-left"), 3),
        (Described(bearing="oncoming"), 6),
        (Described(bearing="crossing-right"), 5),
        (Described(origin="right"), 5),
        (Described(size="big", bearing="ahead"), 1),
        (Described(extreme="nearest"), 3),
        (Described(extreme="farthest"), 7),
        (Described(kind="car", colour="blue", bearing="ahead-left"), 4),
        (Described(kind="car", colour="blue"), 3),  # the other one is far
        (Described(bearing="ahead", of=Described(kind="truck")), 7),
        (Described(doing=Event("cut-in", actor=Wanted())), 7),
        (Described(doing=Event("give-way", object=Wanted())), 5),
        (Described(doing=Event("wait", object=Wanted())), 5),  # waiting is much like giving way
        (Described(kind="car", doing=Event("brake", actor=Wanted())), 1),
        (Described(doing=Event("signal", actor=Wanted(), tense="present")), 4),
        (Described(colour="blue", rank=1), 3),
        (Described(colour="blue", rank=2), 4),
        (Described(colour="blue", rank=-1), 4),
        (Vehicle(6), 6),
    ],
)
def test_a_description_finds_its_vehicle(described: Thing, vehicle: int) -> None:
    assert meant(described) == Vehicle(vehicle)


def test_a_plural_names_all_that_fit() -> None:
    assert meant(Described(colour="blue", plural=True)) == Vehicles((3, 4))
    assert meant(Described(kind="car", plural=True, number=2, bearing="left")) == Vehicles((3, 4))


def test_some_of_several_are_some_of_those_spoken_of() -> None:
    spoken = talk(Vehicles((1, 3, 4, 5))).mentions
    blue = Described(colour="blue", among=Pronoun("them-all"), plural=True, definite=False)
    assert meant(blue, mentions=spoken) == Vehicles((3, 4))
    red = Described(colour="red", among=Pronoun("them-all"), plural=True, definite=False)
    assert isinstance(meant(red, mentions=spoken), Nobody)


def test_the_other_one_is_not_the_one_spoken_of() -> None:
    blue = talk(Vehicle(3)).mentions
    assert meant(Described(colour="blue", other=True), mentions=blue) == Vehicle(4)


def test_of_a_group_the_second_counts() -> None:
    group = talk(Vehicles((6, 2, 1))).mentions
    assert meant(Described(rank=2), mentions=group) == Vehicle(2)


def test_two_that_fit_as_well_are_asked_about() -> None:
    world = FakeWorld({1: Car(30.0, 3.5, colour="blue"), 2: Car(32.0, -3.5, colour="blue")})
    found = asked(HowMuch(Measured("speed", Described(kind="car", colour="blue"))), world)
    assert found.clarify is not None
    assert found.clarify.readings == (Vehicle(1), Vehicle(2))
    assert [look.vehicle for look in found.clarify.looks] == [1, 2]
    assert found.acts == ()
    assert found.offered_things == (Vehicle(1), Vehicle(2))
    assert [o.question.of.thing for o in found.offers] == [Vehicle(1), Vehicle(2)]  # type: ignore[union-attr]
    assert found.pending is not None


def test_what_was_done_tells_them_apart() -> None:
    world = FakeWorld(
        {1: Car(30.0, 3.5, colour="blue"), 2: Car(32.0, -3.5, colour="blue")},
        (did("brake", 15.0, who=2),),
    )
    why = Why(Happens(Event("brake", Described(colour="blue"))))
    found = question_of(asked(why, world))
    assert found.of.event.actor == Vehicle(2)  # type: ignore[union-attr]


def test_only_the_one_that_comes_nearer_stands_out() -> None:
    world = FakeWorld(
        {
            1: Car(40.0, 3.5, colour="blue", drift=-5.0, at=20.0),
            2: Car(-42.0, 3.5, colour="blue", drift=-5.0, at=20.0),
        }
    )
    assert meant(Described(colour="blue"), world) == Vehicle(1)


def test_the_time_spoken_of_counts() -> None:
    world = FakeWorld(
        {
            1: Car(10.0, 0.0, seen=(0.0, 8.0), colour="red"),
            2: Car(10.0, 0.0, seen=(10.0, 30.0), colour="red"),
        }
    )
    then = HowMuch(Measured("speed", Described(colour="red"), time=At(5.0), tense="past"))
    found = question_of(asked(then, world))
    assert found.of.thing == Vehicle(1)  # type: ignore[union-attr]
    assert meant(Described(colour="red"), world) == Vehicle(2)


def test_one_that_is_gone_is_found_by_what_it_did() -> None:
    world = FakeWorld(
        {1: Car(10.0, 3.0, seen=(0.0, 8.0), colour="green"), 2: Car(10.0)},
        (did("pass", 6.0, who=1, whom=0),),
    )
    went_past = Described(kind="car", doing=Event("pass", actor=Wanted(), object=Ego()))
    assert meant(went_past, world) == Vehicle(1)
    assert meant(Described(colour="green"), world) == Vehicle(1)


@pytest.mark.parametrize(("begin", "meant_is"), [(6.0, 2), (15.0, 1)])
def test_whether_it_was_done_is_asked_of_who_is_there_unless_it_was_just_done(
    begin: float, meant_is: int
) -> None:
    world = FakeWorld(
        {
            1: Car(10.0, 3.0, "motorcycle", seen=(0.0, begin + 2.0)),
            2: Car(12.0, kind="bicycle"),
        },
        (did("brake", begin, begin + 1.0, who=1),),
        now=20.0,
    )
    braked = Happens(Event("brake", Described(kind="bike"), tense="past"))
    found = question_of(asked(Whether(braked), world))
    assert found.that.event.actor == Vehicle(meant_is)  # type: ignore[union-attr]


def test_a_side_that_was_true_of_the_deed_counts() -> None:
    world = FakeWorld(
        {1: Car(-60.0, -3.5, drift=-5.0, at=20.0, colour="blue"), 2: Car(30.0, 3.5, colour="red")},
        (did("brake", 3.0, who=1),),
    )  # vehicle 1 was ahead on the right when it braked
    why = Why(Happens(Event("brake", Described(kind="car", bearing="ahead-right"))))
    found = question_of(asked(why, world))
    assert found.of.event.actor == Vehicle(1)  # type: ignore[union-attr]


def test_a_wrong_colour_is_reported_and_the_question_kept() -> None:
    found = asked(HowMuch(Measured("speed", Described(kind="truck", colour="red"))), STREET)
    assert isinstance(found.refusal, NoSuchVehicle)
    assert found.refusal.misdescribed is not None
    assert found.refusal.misdescribed.vehicle == 1
    assert found.acts[0].act.question.of.thing == Vehicle(1)  # type: ignore[union-attr]


def test_a_wrong_kind_is_reported_and_the_question_kept() -> None:
    found = asked(Identify(Described(kind="motorcycle", colour="red", bearing="behind")), STREET)
    assert isinstance(found.refusal, NoSuchVehicle)
    assert found.refusal.misdescribed is not None
    assert found.refusal.misdescribed.vehicle == 2


@pytest.mark.parametrize(
    "nobody",
    [
        Described(kind="car", colour="green"),
        Described(kind="pedestrian"),
        Described(kind="vehicle", bearing="beside-right"),
        Described(doing=Event("collide", actor=Wanted(), object=Ego())),
        Vehicle(99),
        Vehicles((1, 99)),
    ],
)
def test_what_is_not_there_is_said_to_be_missing(nobody: Thing) -> None:
    found = asked(Identify(nobody), STREET)
    assert found.acts == ()
    assert isinstance(found.refusal, NoSuchVehicle)
    assert found.refusal.misdescribed is None
    assert len(found.refusal.known) == 3


def test_whether_there_is_somebody_may_be_denied() -> None:
    there = question_of(asked(Whether(Exists(Described(colour="green", definite=False))), STREET))
    assert isinstance(there.that.thing, Nobody)  # type: ignore[union-attr]
    here = question_of(asked(Whether(Exists(Described(bearing="behind", definite=False))), STREET))
    assert here.that.thing == Vehicle(2)  # type: ignore[union-attr]


def test_all_of_a_sort_are_counted() -> None:
    found = question_of(asked(HowMany(Described(kind="car", colour="blue", plural=True)), STREET))
    assert found.of == Vehicles((3, 4))  # type: ignore[union-attr]


def test_which_of_some_names_them() -> None:
    of_blue = Which(Described(colour="blue", plural=True), Happens(Event("brake", Wanted())))
    assert question_of(asked(of_blue, STREET)).thing == Vehicles((3, 4))  # type: ignore[union-attr]


def test_somebody_is_whoever_did_it() -> None:
    did_any = Whether(Happens(Event("cut-in", Described(definite=False))))
    found = question_of(asked(did_any, STREET))
    assert found.that.event.actor == Vehicle(7)  # type: ignore[union-attr]
    none = Whether(Happens(Event("collide", Described(definite=False))))
    assert isinstance(question_of(asked(none, STREET)).that.event.actor, Nobody)  # type: ignore[union-attr]


def test_the_passenger_is_where_the_car_is() -> None:
    near = Whether(Related("behind", Described(colour="red"), to=Passenger()))
    found = question_of(asked(near, STREET))
    assert (found.that.thing, found.that.to) == (Vehicle(2), Ego())  # type: ignore[union-attr]


def test_a_request_is_about_somebody_there() -> None:
    found = act(Request(Event("overtake", object=Described(kind="truck"))), STREET)
    assert found.acts[0].act == Request(Event("overtake", object=Vehicle(1)))
    assert not isinstance(found.acts[0].act, Ask)


def test_somebody_definite_who_is_not_there_is_missing() -> None:
    gone = asked(Whether(Exists(Described(kind="bicycle"))), STREET)
    assert isinstance(gone.refusal, NoSuchVehicle)
    truck = question_of(asked(Whether(Exists(Described(kind="truck"))), STREET))
    assert truck.that.thing == Vehicle(1)  # type: ignore[union-attr]


def test_any_other_clause_may_tell_a_vehicle() -> None:
    world = FakeWorld({1: Car(10.0, speed=0.0), 2: Car(20.0, 3.5), 3: Car(9.0, seen=(0.0, 15.0))})
    standing = Described(such=Is("stationary", Wanted()))
    assert meant(standing, world) == Vehicle(1)
    hidden = Described(such=Not(Is("visible", Wanted())), plural=True, definite=False)
    found = question_of(asked(HowMany(hidden), world))
    assert found.of == Vehicle(3)  # type: ignore[union-attr]


def test_people_who_cross_are_meant_rather_than_the_nearest() -> None:
    walkers = {
        1: Car(3.0, -3.0, "pedestrian", None),
        2: Car(15.0, 1.0, "pedestrian", None),
        3: Car(16.0, -1.0, "pedestrian", None),
        4: Car(10.0, 0.0, "truck", "brown"),
    }
    several = Described("pedestrian", plural=True)
    assert meant(several, FakeWorld(walkers, across=(2, 3, 4))) == Vehicles((2, 3))
    assert meant(Described("pedestrian"), FakeWorld(walkers, across=(2,))) == Vehicle(2)
    assert meant(Described("pedestrian", bearing="right"), FakeWorld(walkers)) == Vehicle(1)
