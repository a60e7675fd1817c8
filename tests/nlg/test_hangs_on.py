"""How a deed hangs on several vehicles, or on none by itself, is told where it is asked."""

from dataclasses import replace

import pytest

from tests.nlg.causal_cases import LEADER, E
from tests.nlg.test_nlg_causes import CONTEXT
from xavi_dialogue.domain.answers import MotionCause, MotionReason
from xavi_dialogue.domain.evidence import Causation
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.nlg.say import say

SLOWED = Episode(E, "slow-down", 8.0, 14.0)
OTHER = MotionCause("no-room", 3)


def told(
    *causes: MotionCause, causation: Causation, detail: str = "usual", of_causes: bool = True
) -> str:
    reason = MotionReason(
        SLOWED, causes, causation=causation, cleared=causation.cleared, of_causes=of_causes
    )
    return say(reason, replace(CONTEXT, detail=detail)).text


def test_both_had_to_be_there() -> None:
    text = told(LEADER, OTHER, causation=Causation("both", (2, 3)))
    assert "in the way of a change of lanes" in text
    assert "had to be there: without one of them, I would have done otherwise" in text


def test_either_would_have_been_enough() -> None:
    text = told(LEADER, OTHER, causation=Causation("either", (2, 3)))
    assert "ither of them would have been enough" in text
    assert "had to be there" not in text


def test_without_the_first_the_second_would_have_been_in_our_way() -> None:
    text = told(LEADER, causation=Causation("pre-empted", (2, 3)))
    assert "would have been in our way just as well" in text


@pytest.mark.parametrize("detail", ["usual", "more"])
def test_where_no_vehicle_made_the_difference_none_is_given_as_the_reason(detail: str) -> None:
    nobody = Causation("none", (), (2,))
    text = told(causation=nobody, detail=detail)
    assert text.startswith("I slowed down")
    assert "no single vehicle made the difference to that" in text
    assert "because" not in text
    turn = told(MotionCause("turn"), causation=nobody, detail=detail)
    assert "because I had to take the turn" in turn
    assert "o single vehicle made the difference" in turn


@pytest.mark.parametrize("kind", ["both", "either", "pre-empted"])
def test_where_causes_are_not_asked_about_only_more_detail_tells_it(kind: str) -> None:
    found = Causation(kind, (2, 3))
    first = told(LEADER, causation=found, of_causes=False)
    more = told(LEADER, causation=found, detail="more", of_causes=False)
    asked = told(LEADER, causation=found)
    for words in ("had to be there", "have been enough", "just as well"):
        assert words not in first
    assert any(w in more for w in ("had to be there", "have been enough", "just as well"))
    assert len(asked) > len(first)


def test_nobody_is_spoken_of_only_where_it_is_asked_about() -> None:
    nobody = Causation("none", (), (2,))
    turn = told(MotionCause("turn"), causation=nobody, of_causes=False)
    assert "single vehicle" not in turn
    assert "because I had to take the turn" in turn


def test_one_cause_needs_no_such_sentence() -> None:
    text = told(LEADER, causation=Causation("one", (2,)))
    assert "enough" not in text
    assert "just as well" not in text
    assert "no single vehicle" not in text


def test_where_the_same_would_be_done_that_is_said() -> None:
    text = told(LEADER, OTHER, causation=Causation("both", (2, 3), decides=False))
    assert "counted" in text
    assert "I would have done the same, but for less of a reason" in text
    assert "done otherwise" not in text
