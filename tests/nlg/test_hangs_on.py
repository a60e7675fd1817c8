"""How a deed hangs on several vehicles, or on none by itself, is told where it is asked."""

from dataclasses import replace

import pytest

from tests.nlg.causal_cases import LEADER, E
from tests.nlg.test_nlg_causes import CONTEXT
from xavi_dialogue.domain.answers import ChoiceReason, Contrast, Evidence, MotionCause, MotionReason
from xavi_dialogue.domain.evidence import Causation, OutcomeEstimate, Share
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
    assert "no other vehicle made the difference to that, not even all of them together" in text
    assert "because" not in text
    turn = told(MotionCause("turn"), causation=nobody, detail=detail)
    assert "because I had to take the turn" in turn
    assert "o other vehicle made the difference" in turn


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        ("both", "The blue car "),
        ("either", "Either of them would have been enough, it or "),
    ],
)
@pytest.mark.parametrize("detail", ["less", "simpler", "usual", "more"])
def test_a_reason_with_two_causes_is_never_told_with_one(
    kind: str, words: str, detail: str
) -> None:
    found = Causation(kind, (2, 3))
    text = told(LEADER, causation=found, detail=detail, of_causes=False)
    assert text.split(". ")[1].startswith(words)
    whole = told(LEADER, causation=found, detail=detail).count("without one of them")
    assert whole == (kind == "both")  # asked about causes


@pytest.mark.parametrize("decides", [True, False])
@pytest.mark.parametrize("asked", [True, False])
def test_several_that_no_one_of_them_accounts_for_are_told_together(
    asked: bool, decides: bool
) -> None:
    found = Causation("several", (1, 2, 3), decides=decides)
    text = told(LEADER, causation=found, of_causes=asked)
    assert ("Others played a part, too: without any one of them alone" in text) is asked
    assert (" played a part, too" in text) is (asked or decides)
    assert ("I would have done otherwise" in text) is (asked and decides)
    assert ("done the same, but with less reason" in text) is (asked and not decides)
    crowd = told(LEADER, causation=Causation("several", (1, 2, 3, 4, 5)), of_causes=asked)
    whole = "would have come to the same, and without all 5 of them, I would" in crowd
    assert whole if asked else crowd.endswith("Others played a part, too.")
    more = told(LEADER, causation=Causation("several", (1, 2, 3)), of_causes=asked, detail="more")
    assert "I would have done otherwise" in more


@pytest.mark.parametrize("asked", [True, False])
def test_who_would_have_taken_the_place_of_the_cause_is_told_where_it_is_asked(asked: bool) -> None:
    found = Causation("pre-empted", (2, 3))
    for detail in ("usual", "more"):
        text = told(LEADER, causation=found, detail=detail, of_causes=asked)
        assert text.count("just as well") == (asked or detail == "more")
    assert "just as well" not in told(LEADER, causation=found, detail="less", of_causes=asked)


def only(*causes: MotionCause, causation: Causation, part: str, besides: tuple[int, ...]) -> str:
    reason = MotionReason(
        SLOWED, causes, causation=causation, of_causes=True,
        suspect=2, suspected=part, besides=besides,  # type: ignore[arg-type]
    )  # fmt: skip
    return say(reason, CONTEXT).text


def test_one_that_is_taken_for_the_only_cause_is_told_with_the_others() -> None:
    both = only(LEADER, causation=Causation("both", (2, 3)), part="beside", besides=(3,))
    assert both.startswith("No, also because of ")
    assert "had to be there" in both
    either = only(LEADER, causation=Causation("either", (2, 3)), part="beside", besides=(3,))
    assert either.startswith("No, also because of ")
    assert "would have been enough" in either
    several = only(LEADER, causation=Causation("several", (2, 3, 4)), part="beside", besides=(3, 4))
    assert several.startswith("No, also because of ")
    assert "thers played a part, too" in several
    one = only(LEADER, causation=Causation("one", (2,)), part="alone", besides=())
    assert one.startswith("Yes, only because of ")


def test_a_turn_beside_the_one_taken_for_the_only_cause_is_told() -> None:
    turn = MotionCause("turn")
    text = only(LEADER, turn, causation=Causation("one", (2,)), part="beside", besides=())
    assert text.startswith("No, not only: ")
    assert "I had to take the turn" in text


def test_nobody_is_spoken_of_only_where_it_is_asked_about() -> None:
    nobody = Causation("none", (), (2,))
    turn = told(MotionCause("turn"), causation=nobody, of_causes=False)
    assert "other vehicle made the difference" not in turn
    assert "because I had to take the turn" in turn


def test_one_cause_needs_no_such_sentence() -> None:
    text = told(LEADER, causation=Causation("one", (2,)))
    assert "enough" not in text
    assert "just as well" not in text
    assert "thers counted" not in text
    assert "other vehicle" not in text


def test_where_the_same_would_be_done_that_is_said() -> None:
    text = told(LEADER, OTHER, causation=Causation("both", (2, 3), decides=False))
    assert "counted" in text
    assert "I would have done the same, but with less reason" in text
    assert "done otherwise" not in text


def test_where_not_all_of_several_may_be_needed_nobody_is_named() -> None:
    several = Causation("several", (2, 3, 4), minimal=False)
    text = told(LEADER, causation=several)
    assert text.endswith("would have come to the same.")
    assert "4" not in text


def changing(outcome: str, later: tuple[str, ...]) -> str:
    """Say why we changed to the right, where we turn right next."""
    contrast = Contrast(
        fact=("change-right", "continue", "exit-right"), foil=("continue",),
        outcome=OutcomeEstimate(outcome, 0.97), effects=(), causes=(), evidence=Evidence(),
        decided=1.0, continued=later, verdict="better",  # type: ignore[arg-type]
        terms=(Share("late", 9.0, 0.97),), told=(Share("late", 9.0, 0.97),),
    )  # fmt: skip
    return say(ChoiceReason("why", None, contrast), CONTEXT).text


def test_a_lane_is_changed_for_the_turn_that_needs_it() -> None:
    turn = "because we had to turn right next"
    assert turn in changing("termination", ("change-right", "exit-right"))
    assert turn in changing("dead", ())
    assert turn not in changing("termination", ("exit-right",))  # we can turn without it
