"""Pronouns: by what was spoken of, else by the scene."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.nlu.grounding.fakes import Car, FakeWorld, asked, did, question_of, talk
from xavi_dialogue.domain.answers import NoSuchVehicle
from xavi_dialogue.domain.discourse import Discourse, Mention
from xavi_dialogue.domain.meaning import HowMuch, Identify, Whether, Why
from xavi_dialogue.domain.terms import (
    Between,
    Ego,
    Event,
    Everyone,
    Happens,
    Is,
    Measured,
    Now,
    Pronoun,
    Related,
    Thing,
    Vehicle,
    Vehicles,
)

SCENE = FakeWorld(
    {1: Car(20.0), 2: Car(-10.0, colour="red"), 3: Car(4.0, 3.5, "truck", "blue")},
    (did("brake", 15.0, who=2), did("slow-down", 5.0, 8.0)),
)


def meant(form: str, world: FakeWorld = SCENE, discourse: Discourse | None = None) -> Thing:
    found = question_of(asked(HowMuch(Measured("speed", Pronoun(form))), world, discourse))  # type: ignore[arg-type]
    assert isinstance(found, HowMuch)
    return found.of.thing


def test_the_most_salient_is_meant() -> None:
    assert meant("it", discourse=talk(Vehicle(2), Vehicle(1))) == Vehicle(2)
    assert meant("he", discourse=talk(Ego(), Vehicle(1))) == Vehicle(1)
    assert meant("that", discourse=talk(Vehicle(3))) == Vehicle(3)


def test_they_may_be_several_or_one() -> None:
    assert meant("they", discourse=talk(Vehicles((1, 3)))) == Vehicles((1, 3))
    assert meant("they", discourse=talk(Vehicle(3))) == Vehicle(3)
    assert meant("them-all", discourse=talk(Vehicles((1, 2)))) == Vehicles((1, 2))
    assert meant("them-all") == Everyone()


def test_they_are_people_on_foot_rather_than_a_vehicle_of_the_same_breath() -> None:
    spoken = talk(Vehicle(3), Vehicles((1, 2)))
    fresh = tuple(replace(m, salience=m.salience + 2.0) for m in spoken.mentions)
    for kind, whom in (("pedestrian", Vehicles((1, 2))), ("car", Vehicle(3))):
        world = FakeWorld({3: Car(8.0), **{n: Car(10.0 + n, 0.0, kind) for n in (1, 2)}})
        assert meant("they", world, replace(spoken, mentions=fresh)) == whom


def test_without_mentions_they_are_the_people_who_cross() -> None:
    walkers = {n: Car(10.0 + n, 0.0, "pedestrian", None) for n in (1, 2)}
    crossing = FakeWorld({3: Car(8.0), **walkers}, across=(1, 2))
    found = question_of(asked(Identify(Pronoun("they")), crossing))
    assert found == Identify(Vehicles((1, 2)))


def test_what_goes_on_is_meant_rather_than_what_is_over() -> None:
    told = (did("stop", 10.0, 15.0), did("brake", 18.0, None, going_on=True))
    world = FakeWorld({1: Car(20.0)}, told)
    found = question_of(asked(Why(Happens(Event("stop", Ego(), tense="present"))), world))
    assert found.of.event.time == Now()  # type: ignore[union-attr]


def test_who_did_what_is_said_is_meant() -> None:
    why = Why(Happens(Event("brake", Pronoun("it"))))
    found = question_of(asked(why, SCENE, talk(Vehicle(1), Vehicle(2))))
    assert found.of.event.actor == Vehicle(2)  # type: ignore[union-attr]


def test_without_mentions_our_leader_is_meant() -> None:
    assert meant("it") == Vehicle(1)


def test_without_mentions_the_one_we_give_way_to_is_meant() -> None:
    world = FakeWorld(SCENE.cars, (did("give-way", 17.0, whom=2, going_on=True),))
    assert meant("he", world) == Vehicle(2)


def test_without_a_leader_the_nearest_is_meant() -> None:
    world = FakeWorld({5: Car(30.0, 10.0, crossing=True), 6: Car(10.0, -6.0, crossing=True)})
    found = question_of(asked(Identify(Pronoun("that")), world))
    assert found.thing == Vehicle(6)  # type: ignore[union-attr]


def test_nobody_there_is_nobody_meant() -> None:
    found = asked(HowMuch(Measured("speed", Pronoun("he"))), FakeWorld())
    assert isinstance(found.refusal, NoSuchVehicle)
    assert found.acts == ()


def test_somebody_gone_is_not_meant_any_more() -> None:
    assert meant("it", discourse=talk(Vehicle(77), Vehicle(2))) == Vehicle(2)


def test_it_is_an_event_where_the_state_is_one_of_events() -> None:
    braking = Why(Happens(Event("slow-down", time=Between(5.0, 8.0))))
    found = asked(
        Whether(Is("necessary", Pronoun("it"), tense="past")),
        SCENE,
        talk(Vehicle(1), question=braking),
    )
    said = question_of(found).that  # type: ignore[union-attr]
    assert (said.thing, said.event.action) == (None, "slow-down")
    assert found.acts[0].leaned


def test_it_is_a_vehicle_where_the_relation_is_one_of_vehicles() -> None:
    found = question_of(
        asked(Whether(Related("waiting-for", Pronoun("he"))), SCENE, talk(Vehicle(3)))
    )
    assert found.that.thing == Vehicle(3)  # type: ignore[union-attr]


def test_of_a_group_of_two_one_is_asked_for() -> None:
    world = FakeWorld({1: Car(20.0, 3.5), 2: Car(20.0, -3.5, colour="red")})
    found = asked(HowMuch(Measured("speed", Pronoun("it"))), world, talk(Vehicles((1, 2))))
    assert found.clarify is not None
    assert found.clarify.between == "vehicles"
    assert [o.question.of.thing for o in found.offers] == [Vehicle(1), Vehicle(2)]  # type: ignore[union-attr]


def said(*spoken: tuple[Thing, float]) -> Discourse:
    """A discourse in which things were spoken of, as clearly as is said."""
    mentions = tuple(Mention(thing, 1, False, salience) for thing, salience in spoken)
    return replace(Discourse(turn=2), mentions=mentions)


@pytest.mark.parametrize(
    ("spoken", "whom"),
    [
        (((Vehicle(1), 0.8), (Vehicle(2), 0.3)), Vehicles((2, 1))),
        (((Vehicle(1), 0.8), (Vehicle(2), 0.29)), Everyone()),
        (((Vehicle(1), 0.8), (Vehicle(2), 0.6), (Vehicle(3), 0.5)), Vehicles((2, 1))),
        (((Vehicle(1), 0.8), (Vehicle(77), 0.6), (Vehicle(3), 0.5)), Vehicles((3, 1))),
        (((Vehicle(1), 0.8), (Vehicles((2, 3)), 0.4)), Vehicles((2, 3))),
    ],
)
def test_all_of_them_are_a_group_or_those_spoken_of_one_by_one(spoken: Any, whom: Thing) -> None:
    assert meant("them-all", discourse=said(*spoken)) == whom


def test_both_are_the_only_two_in_view() -> None:
    two = FakeWorld({1: Car(20.0), 2: Car(-10.0)})
    assert meant("them-all", two) == Vehicles((1, 2))
    assert meant("them-all", FakeWorld({1: Car(20.0)})) == Everyone()
    assert meant("them-all", two, said((Vehicle(1), 0.9))) == Vehicles((1, 2))


@pytest.mark.parametrize(
    ("spoken", "whom"),
    [
        (((Vehicle(3), 0.91), (Vehicles((1, 2)), 0.9)), Vehicle(3)),
        (((Vehicle(3), 0.9), (Vehicles((1, 2)), 0.8)), Vehicles((1, 2))),
        (((Vehicles((1, 2)), 0.8), (Vehicle(3), 0.7)), Vehicles((1, 2))),
        (((Vehicle(3), 0.8),), Vehicle(3)),
    ],
)
def test_they_are_a_group_unless_one_was_clearly_named(spoken: Any, whom: Thing) -> None:
    assert meant("they", discourse=said(*spoken)) == whom


def test_it_reaches_back_less_to_who_is_gone() -> None:
    gone = FakeWorld({1: Car(20.0), 2: Car(-10.0, seen=(0.0, 9.0))})
    for salience, whom in ((0.5, 2), (0.49, 1)):
        assert meant("it", gone, said((Vehicle(2), salience), (Vehicle(1), 0.2))) == Vehicle(whom)
    for salience, whom in ((0.1, 2), (0.09, 1)):  # else our leader
        assert meant("it", discourse=said((Vehicle(2), salience))) == Vehicle(whom)


def test_it_is_no_pedestrian_beside_a_vehicle() -> None:
    world = FakeWorld({1: Car(20.0), 2: Car(9.0, 4.0, "pedestrian", None)})
    spoken = said((Vehicle(2), 0.9), (Vehicle(1), 0.6))
    assert meant("it", world, spoken) == Vehicle(1)
    assert meant("he", world, spoken) == Vehicle(2)
    assert meant("it", world, said((Vehicle(2), 0.9))) == Vehicle(2)
    alone = FakeWorld({2: Car(9.0, 0.0, "pedestrian", None)}, across=(2,))
    assert meant("it", alone) == Ego()
    assert meant("he", alone) == Vehicle(2)


def test_who_did_what_is_said_outdoes_who_was_named_a_little_more_clearly() -> None:
    why = Why(Happens(Event("brake", Pronoun("it"))))
    for salience, whom in ((0.6, 2), (0.5, 1)):  # 62 % are left to the one that did not
        spoken = said((Vehicle(1), 0.9), (Vehicle(2), salience))
        found = question_of(asked(why, SCENE, spoken))
        assert found.of.event.actor == Vehicle(whom)  # type: ignore[union-attr]


def test_two_that_do_not_differ_are_asked_about() -> None:
    world = FakeWorld({1: Car(20.0, 3.5), 2: Car(20.0, -3.5, colour="red")})
    speed = HowMuch(Measured("speed", Pronoun("it")))
    level = asked(speed, world, said((Vehicle(1), 0.9), (Vehicle(2), 0.883)))
    assert level.clarify is not None
    clear = question_of(asked(speed, world, said((Vehicle(1), 0.9), (Vehicle(2), 0.88))))
    assert clear == HowMuch(Measured("speed", Vehicle(1), time=Now()))


def test_beside_one_that_is_named_the_pronoun_is_another() -> None:
    behind = Related("behind", Vehicle(2), Pronoun("it"))
    found = question_of(asked(Whether(behind), SCENE, said((Vehicle(2), 0.9), (Vehicle(3), 0.5))))
    assert found.that.to == Vehicle(3)  # type: ignore[union-attr]
    group = said((Vehicles((2, 1)), 0.9), (Vehicle(3), 0.5))
    found = question_of(asked(Whether(behind), SCENE, group))
    assert found.that.to == Vehicle(3)  # type: ignore[union-attr]
