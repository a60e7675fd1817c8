"""What says nothing is not answered: a thing that meets itself, or nobody that meets nobody."""

import pytest

from xavi_dialogue.domain.meaning import Ask, Request, Whether
from xavi_dialogue.domain.terms import Ego, Event, Everyone, Happens, Nobody, Related, Vehicle
from xavi_dialogue.nlu.grounding.soundness import is_sound


@pytest.mark.parametrize(
    "of",
    [
        Happens(Event("wait", Vehicle(1), Vehicle(1))),
        Happens(Event("wait", Everyone(), Nobody())),
        Happens(Event("let-go", Ego(), Ego())),
        Related("in-the-way-of", Ego(), Ego()),
    ],
)
def test_what_meets_itself_is_not_sound(of: Happens | Related) -> None:
    assert not is_sound(Ask(Whether(of)))


@pytest.mark.parametrize(
    "of",
    [
        Happens(Event("wait", Vehicle(1), Vehicle(2))),
        Happens(Event("wait", Everyone(), Ego())),
        Related("behind", Vehicle(1), Ego()),
    ],
)
def test_what_is_between_two_is_sound(of: Happens | Related) -> None:
    assert is_sound(Ask(Whether(of)))


def test_passengers_may_be_let_out() -> None:
    assert is_sound(Request(Event("drop-off", Ego(), Ego())))
