"""Several acts in one turn: whom the later ones speak of."""

from typing import Any

import pytest

from tests.nlu.grounding.fakes import Car, FakeWorld, reading
from tests.nlu.grounding.test_readings import InLine
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Doing,
    HowMuch,
    Listing,
    Question,
    Whether,
    Which,
)
from xavi_dialogue.domain.rewriting import first as named_in
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Everyone,
    Exists,
    Measured,
    Nobody,
    Pronoun,
    Related,
    Thing,
    Vehicle,
    Vehicles,
    Wanted,
)
from xavi_dialogue.nlu.grounding import ground

CARS = {
    1: Car(20.0, kind="bus", colour="yellow"),
    2: Car(-10.0, colour="blue"),
    3: Car(30.0, 3.5, kind="pedestrian", colour=None),
    4: Car(34.0, 3.5, kind="pedestrian", colour=None),
    5: Car(-30.0, colour="red"),
}
BUS = Described(kind="bus")


def then(first: Act, second: Question, world: FakeWorld | None = None) -> Any:
    """The second of two acts of one turn, after nothing else was said."""
    found = ground((reading(first, Ask(second)),), world or FakeWorld(CARS), Discourse())
    act = found.acts[-1].act
    assert isinstance(act, Ask)
    return act.question


def speed_of(thing: Thing) -> HowMuch:
    return HowMuch(Measured("speed", thing))


def test_they_are_all_those_who_were_just_asked_for() -> None:
    who = Ask(Listing("vehicles", Everyone("pedestrian")))
    assert named_in(then(who, Doing(Pronoun("they"))), Vehicles) == Vehicles((3, 4))


BEHIND_BUS = Related("behind", Described(definite=False), BUS)


@pytest.mark.parametrize("first", [
    Ask(Whether(Exists(Described(definite=False, of=BUS, bearing="behind")))),
    Ask(Whether(Exists(Nobody(Described(definite=False, of=BUS, bearing="behind"))))),
    Claim(Exists(Described(definite=False, of=BUS, bearing="behind"))),
])  # fmt: skip
def test_it_is_that_beside_which_somebody_was_asked_for(first: Act) -> None:
    assert then(first, speed_of(Pronoun("it"))).of.thing == Vehicle(1)


def placed(relation: Any, thing: Thing, to: Thing, **more: Any) -> Related:
    return Related(relation, thing, to, **more)


@pytest.mark.parametrize(
    ("first", "he"),
    [
        (Which(Wanted(), placed("behind", Wanted(), Ego())), 2),
        (Which(Wanted(), placed("ahead-of", Wanted(), Ego())), 1),
        (Whether(placed("behind", Described(definite=False), Ego())), 2),
        (Whether(placed("ahead-of", Described(definite=False), Ego())), 1),
    ],
)
def test_he_is_the_nearest_of_those_in_that_place(first: Question, he: int) -> None:
    assert then(Ask(first), speed_of(Pronoun("he")), InLine(CARS)).of.thing == Vehicle(he)


@pytest.mark.parametrize(
    "first",
    [
        Which(Wanted(), placed("behind", Wanted(), Vehicle(1))),
        Which(Wanted(), placed("beside", Wanted(), Ego())),
        Which(Wanted(), placed("behind", Wanted(), Ego(), tense="past")),
        Whether(placed("behind", Vehicle(5), Ego())),
    ],
)
def test_he_is_not_just_anybody_where_another_place_is_asked_about(first: Question) -> None:
    found = ground((reading(Ask(first), Ask(speed_of(Pronoun("he")))),), InLine(CARS), Discourse())
    named = [one.act.question for one in found.acts if isinstance(one.act, Ask)][1:]
    assert speed_of(Vehicle(2)) not in [
        HowMuch(Measured("speed", one.of.thing)) for one in named if isinstance(one, HowMuch)
    ]
