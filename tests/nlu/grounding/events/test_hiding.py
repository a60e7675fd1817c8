"""Hiding: what "it" is behind which somebody may be, and somebody behind a vehicle."""

from typing import Any

import pytest

from tests.nlu.grounding.fakes import Car, FakeWorld, asked, question_of
from xavi_dialogue.domain.meaning import HowKnow, WhatIf, Whether
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Exists,
    Feature,
    Happens,
    Nobody,
    Pronoun,
    Related,
    Vehicle,
)

IT = Pronoun("it")
SOMEBODY = Described(definite=False)
TRUCK = Described(kind="truck")
WORLD = FakeWorld({1: Car(60.0, colour="red"), 2: Car(40.0, kind="truck", colour="blue")})
BLIND, BARN = Feature("blind"), Feature("building")


def hiders(question: Any) -> list[Any]:
    """The hiders in a grounded question."""
    found = question_of(asked(question, WORLD))
    of = getattr(found, "that", None) or getattr(found, "supposed", None) or found.of
    match of:
        case Related(to=to):
            return [to]
        case Happens(event=Event(object=to)):
            return [to]
        case Exists(Nobody(Described(bearing="behind", of=to))):
            return [to]
    return []


@pytest.mark.parametrize(
    ("question", "hider"),
    [
        (Whether(Related("behind", SOMEBODY, TRUCK)), Vehicle(2)),
        (Whether(Exists(Described(bearing="behind", of=TRUCK, definite=False))), Vehicle(2)),
        (Whether(Exists(Described(bearing="behind", of=IT, definite=False))), BLIND),
        (Whether(Exists(Described(bearing="behind", of=BARN, definite=False))), BARN),
        (Whether(Related("behind", SOMEBODY, IT)), BLIND),
        (HowKnow(Related("behind", Nobody(), IT)), BLIND),
        (WhatIf(Happens(Event("come", SOMEBODY, IT, tense="present"))), BLIND),
        (Whether(Related("sees-past", Ego(), IT)), BLIND),
    ],
)
def test_it_is_what_hides_somebody_who_is_not_known(question: Any, hider: Any) -> None:
    assert hiders(question) == [hider]
