"""Claims beside questions: the question comes first, and one reply reads as one."""

import pytest

from tests.dialogue.faked import Faked, Talk
from tests.dialogue.state.test_conversation import FAST, SPEED, WHY
from xavi_dialogue.dialogue.joining import AT_MOST, joined
from xavi_dialogue.dialogue.state.turn import Turn
from xavi_dialogue.domain.answers import (
    Comforting,
    Measures,
    MotionCause,
    MotionReason,
    Verdict,
)
from xavi_dialogue.domain.facts import Episode, Look, Measure
from xavi_dialogue.domain.meaning import Act, Ask, Claim, Feel, Why
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Exists,
    Happens,
    Is,
    Lane,
    Not,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.nlg.context import Utterance

SLOWED = Ask(Why(Happens(Event("slow-down"))))
CAUSE = MotionCause("right-of-way", 1)
REASON = MotionReason(Episode(Ego(), "slow-down", 4.0, 7.0), (CAUSE,))
UNCAUSED = MotionReason(Episode(Ego(), "slow-down", 4.0, 7.0), ())
NOBODY = Claim(Not(Exists(Vehicles((1, 2)))))
FREE = Claim(Is("free", Lane("left")))
SLOW = Claim(Is("slow", Ego()))
DISPUTE = Claim(Not(Happens(Event("brake"))), True)
RIGHT = Claim(Not(Is("right")))
LEFT = Claim(Happens(Event("leave", Vehicle(1))))


def look(vehicle: int, bearing: str, in_view: bool = True) -> Look:
    return Look(vehicle, 7.0, "car", "blue", 4.5, bearing, 20.0, 20.0, 0.0, 5.0, in_view=in_view)  # type: ignore[arg-type]


def verdict(claim: Claim, holds: bool, *facts: Look) -> Verdict:
    return Verdict(claim.that, holds, facts, claim=True)


AHEAD = verdict(NOBODY, False, look(1, "ahead"))
BEHIND = verdict(NOBODY, False, look(1, "behind"))


def said(answers: dict[Act, object], *acts: Act) -> Turn:
    return Talk(Faked({"it": acts}, answers)).say("it")  # type: ignore[arg-type]


def told(turn: Turn) -> list[str]:
    return [str(answer["is"]) for answer in turn.reply.answers]


@pytest.mark.parametrize("order", [(FREE, FAST), (FAST, FREE)])
def test_the_question_comes_first_and_a_claim_beside_it_is_context(
    order: tuple[Act, ...],
) -> None:
    assert told(said({FREE: verdict(FREE, True), FAST: SPEED}, *order)) == ["Measures"]
    assert told(said({FREE: verdict(FREE, False), FAST: SPEED}, *order)) == ["Measures"]


@pytest.mark.parametrize("order", [(DISPUTE, FAST), (FAST, DISPUTE)])
def test_a_false_challenge_beside_a_question_is_put_right(order: tuple[Act, ...]) -> None:
    false = said({DISPUTE: verdict(DISPUTE, False), FAST: SPEED}, *order)
    assert told(false) == ["Measures", "Verdict"]
    assert false.reply.text == "Measures. Verdict."


@pytest.mark.parametrize("order", [(FREE, SLOWED), (SLOWED, FREE)])
def test_a_claim_beside_the_question_why_is_only_the_setting(order: tuple[Act, ...]) -> None:
    assert told(said({FREE: verdict(FREE, False), SLOWED: UNCAUSED}, *order)) == ["MotionReason"]


def test_what_the_answer_puts_right_is_not_put_right_again() -> None:
    assert told(said({NOBODY: AHEAD, SLOWED: REASON}, SLOWED, NOBODY)) == ["MotionReason"]


def test_who_is_there_is_seen_by_everybody_and_not_put_right_beside_an_answer() -> None:
    assert told(said({NOBODY: AHEAD, FAST: SPEED}, FAST, NOBODY)) == ["Measures"]


def test_who_is_behind_us_does_not_matter() -> None:
    assert told(said({NOBODY: BEHIND, FAST: SPEED}, NOBODY, FAST)) == ["Measures"]


def test_opinions_are_not_disputed_nor_even_looked_at() -> None:
    turn = said({FAST: SPEED}, SLOW, FAST)
    assert told(turn) == ["Measures"]
    hurried = Claim(Happens(Event("go", manner=("fast",))))
    assert told(said({FAST: SPEED}, hurried, FAST)) == ["Measures"]


def test_a_claim_that_is_passed_over_is_remembered() -> None:
    turn = said({FREE: verdict(FREE, True), SLOWED: REASON}, FREE, SLOWED)
    assert {act.act for act in turn.acts} == {FREE, SLOWED}
    assert turn.results[-1] == REASON


def test_a_claim_alone_is_answered() -> None:
    assert told(said({FREE: verdict(FREE, True)}, FREE)) == ["Verdict"]
    assert told(said({SLOW: verdict(SLOW, False)}, SLOW)) == ["Verdict"]


def test_that_is_not_right_beside_what_is_says_nothing_more() -> None:
    assert told(said({LEFT: verdict(LEFT, True)}, RIGHT, LEFT)) == ["Verdict"]
    assert told(said({RIGHT: verdict(RIGHT, False)}, RIGHT)) == ["Verdict"]


def test_a_feeling_a_claim_and_a_question_get_sympathy_and_the_answer() -> None:
    turn = said({SLOW: verdict(SLOW, False), FAST: SPEED}, Feel("afraid"), SLOW, FAST)
    assert told(turn) == ["Comforting", "Measures"]
    assert isinstance(turn.results[-1], Measures)
    assert any(isinstance(result, Comforting) for result in turn.results)


def test_a_reply_to_several_acts_is_short() -> None:
    long = Utterance("One. Two. Three. Four.")
    other = Utterance("Five. Six. Seven.")
    assert joined((long,)).text == long.text
    both = joined((long, other)).text
    assert both == "One. Two. Five."
    assert both.count(".") == AT_MOST


def test_choices_are_never_cut() -> None:
    which = Utterance("A. B. C.", choices=("this", "that"))
    assert joined((Utterance("One. Two. Three. Four."), which)).text.endswith("A. B. C.")


def test_two_questions_are_both_answered() -> None:
    moved = Measures((Measure("speed", Ego(), 7.0, 12.0),))
    assert told(said({WHY: REASON, FAST: moved}, WHY, FAST)) == ["MotionReason", "Measures"]
