"""Who is meant where it is supposed that somebody stops or brakes."""

import pytest

from tests.nlu.grounding.fakes import Car, FakeWorld, asked, question_of, talk
from xavi_dialogue.domain.discourse import Discourse, Mention
from xavi_dialogue.domain.meaning import WhatIf
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import Described, Event, Happens, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName

CARS = {
    1: Car(35.0, kind="truck"), 2: Car(60.0, kind="truck"), 3: Car(-20.0, kind="truck"),
    4: Car(-10.0, kind="bus"),
}  # fmt: skip
LORRY = Described("truck")
BY_US = Discourse(turn=2, mentions=(Mention(Vehicle(3), 1, True, 0.9),))


def whom(actor: Described, said: Discourse | None = None, action: ActionName = "brake") -> object:
    spoken = WhatIf(Happens(Event(action, actor, tense="present")))
    event = first(question_of(asked(spoken, FakeWorld(CARS), said)), Event)
    assert event is not None
    return event.actor


@pytest.mark.parametrize("action", ["brake", "stop", "slow-down"])
def test_who_brakes_in_a_supposition_is_ahead_of_us(action: ActionName) -> None:
    assert whom(LORRY, BY_US, action) == Vehicle(1)


def test_the_one_that_the_passenger_spoke_of_is_meant_wherever_it_is() -> None:
    assert whom(LORRY, talk(Vehicle(3))) == Vehicle(3)
    assert whom(Described("truck", bearing="behind"), BY_US) == Vehicle(3)


def test_where_none_is_ahead_another_is_meant() -> None:
    assert whom(Described("bus")) == Vehicle(4)
    assert whom(LORRY, BY_US, "turn") == Vehicle(3)
