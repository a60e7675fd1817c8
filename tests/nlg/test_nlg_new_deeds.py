"""What we would newly do under a supposition is not told as what we would do even so."""

from dataclasses import replace

import pytest
from msgspec.structs import replace as replace_struct

from tests.nlg.causal_cases import LATER
from tests.nlg.scenery import CONTEXT
from xavi_dialogue.domain.answers import ChoiceReason, SupposedOfOther
from xavi_dialogue.domain.terms import Event, Vehicle
from xavi_dialogue.nlg.say import say

MOVE = Event("change-left", tense="present")
TURNS = Event("exit-right", Vehicle(2), tense="present")


def told(*, still: bool, new: bool, supposed: Event | None = TURNS) -> str:
    answer = SupposedOfOther(
        2, supposed, None, ("continue",), ("change-left",), False, None,
        past=False, asked=MOVE, still=still, undone=new,
    )  # fmt: skip
    return say(answer, CONTEXT).text


@pytest.mark.parametrize("supposed", [TURNS, None])
def test_what_is_new_is_no_more_than_that(supposed: Event | None) -> None:
    new = told(still=True, new=True, supposed=supposed)
    assert new.startswith("Yes, ")
    assert "even" not in new
    assert "still" not in new
    kept = told(still=True, new=False, supposed=supposed)
    assert "even" in kept
    assert "still" in kept
    never = told(still=False, new=True, supposed=supposed)
    assert never.startswith("No, even")


def test_a_gain_that_is_too_small_does_not_read_as_the_reason_for_it() -> None:
    """An answer says first that too little time is saved, then what it would take."""
    terms = tuple(
        replace_struct(LATER.told[0], term=term, cost=cost, chance=None, fact_chance=None)
        for term, cost in (("effort", 3.0), ("time", -2.0))
    )
    sooner = replace_struct(LATER.effects[0], delta=-2.0, low=-2.0, high=-2.0)
    contrast = replace_struct(
        LATER, fact=("continue",), foil=("change-left",), continued=(), terms=terms, told=terms,
        effects=(sooner,), causes=(), causation=None, cleared=(), likely=None,
    )  # fmt: skip
    text = say(ChoiceReason("why-not", None, contrast), replace(CONTEXT, detail="usual")).text
    assert "would only" in text
    assert "to be worth a lane change" in text
    assert "but not enough" not in text
