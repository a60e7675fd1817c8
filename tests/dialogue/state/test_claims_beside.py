"""What is told of claims and requests beside questions and reasons."""

from typing import Any

import pytest

from tests.dialogue.state.test_claims_told import (
    BRAKED,
    FAST,
    HURRY,
    SPEED,
    THREE_GOES,
    THREE_TURNS,
    WE_BRAKED,
    beside,
    claim,
    look,
    part,
)
from xavi_dialogue.dialogue.claims import kept, told
from xavi_dialogue.dialogue.state.turn import Part
from xavi_dialogue.domain.answers import (
    Comforting,
    Declined,
    DidNotHappen,
    MotionCause,
    MotionReason,
    Priority,
    Verdict,
)
from xavi_dialogue.domain.facts import Look
from xavi_dialogue.domain.meaning import Ask, Feel, Request, Whether
from xavi_dialogue.domain.terms import (
    Believed,
    Ego,
    Event,
    Happens,
    Has,
    Is,
    Not,
    Related,
    Vehicle,
    Vehicles,
)

# Claims beside a question: only a false challenge that matters is put right.
CHALLENGE = claim(WE_BRAKED, False, challenge=True)


@pytest.mark.parametrize(
    ("one", "put_right"),
    [
        (CHALLENGE, True),
        (claim(WE_BRAKED, False), False),
        (claim(WE_BRAKED, True, challenge=True), False),
        (claim(WE_BRAKED, None, challenge=True), False),
        (claim(WE_BRAKED, False, challenge=True, mistaken=True), False),
        (claim(THREE_TURNS, False, challenge=True), False),  # it is not about us
        (claim(Believed(THREE_TURNS), False, challenge=True), True),
        (claim(Not(WE_BRAKED), False, challenge=True), True),
        (claim(Happens(Event("go")), False, challenge=True), False),  # so anybody may put it
        (claim(Not(Happens(Event("wait"))), False, challenge=True), False),
        (claim(Related("has-priority-over", Ego(), Vehicle(3)), False, challenge=True), True),
        (claim(Related("must-yield-to", Ego(), Vehicle(3)), False, challenge=True), True),
        (claim(Related("behind", Ego(), Vehicle(3)), False, challenge=True), False),
        (claim(Has("colour", "red", Ego()), False, challenge=True), False),
        (claim(Is("free", Ego()), False, challenge=True), True),
        (claim(WE_BRAKED, False, look(3), challenge=True), True),
        (claim(WE_BRAKED, False, look(3, "behind"), challenge=True), False),
        (claim(WE_BRAKED, False, look(3, "behind-left"), challenge=True), False),
        (claim(WE_BRAKED, False, look(3, in_view=False), challenge=True), False),
        (claim(WE_BRAKED, False, look(3, "behind"), look(4), challenge=True), True),
    ],
)  # fmt: skip
def test_beside_a_question_a_false_challenge_is_put_right_where_it_matters(
    one: Part, put_right: bool
) -> None:
    assert beside(one) == ([one] if put_right else [])


@pytest.mark.parametrize(
    "answer", [DidNotHappen(Event("stop")), Verdict(THREE_TURNS, True), MotionReason(BRAKED, ())]
)
def test_nothing_is_put_right_where_the_answer_tells_what_was_so(answer: Any) -> None:
    assert beside(CHALLENGE, result=answer) == []
    # Another claim is no answer.
    assert beside(CHALLENGE, claim(THREE_TURNS)) == [CHALLENGE]


def blaming(vehicle: int) -> Declined:
    return Declined(HURRY, cause=MotionCause("leader", vehicle))


@pytest.mark.parametrize(
    ("that", "facts", "put_right"),
    [
        (Not(Happens(Event("overtake", object=Vehicle(3)))), (), False),
        (Not(Happens(Event("overtake", object=Vehicle(4)))), (), True),
        (Not(Happens(Event("overtake", object=Vehicles((3, 5))))), (), False),
        (WE_BRAKED, (look(3),), False),
        (WE_BRAKED, (look(4),), True),
    ],
)
def test_who_is_blamed_in_the_answer_is_not_put_right_beside_it(
    that: Any, facts: tuple[Look, ...], put_right: bool
) -> None:
    one = claim(that, False, *facts, challenge=True)
    found = beside(one, result=blaming(3), act=HURRY)
    assert found == ([one] if put_right else [])


@pytest.mark.parametrize(
    ("feeling", "worded"), [("afraid", True), ("sick", True), ("bored", False), ("happy", False)]
)
def test_only_grave_feelings_get_a_word_beside_a_question(feeling: Any, worded: bool) -> None:
    felt = part(Feel(feeling), Comforting(Feel(feeling)))
    assert beside(felt) == ([felt] if worded else [])
    assert told((felt,)) == (felt,)


def rule(vehicle: int, holds: bool | None = None) -> Part:
    return part(FAST, Priority(7.0, "give-way", vehicle, holds=holds))


def test_who_has_right_of_way_is_told_once_of_each() -> None:
    first, again = rule(3), part(HURRY, Priority(7.0, "give-way", 3, legal=True))
    other = rule(4)
    assert told((first, again, other)) == (first, other)
    yes = rule(3, holds=True)
    assert told((first, yes)) == (yes,)
    assert told((first, other, yes)) == (yes,)


REASON = part(FAST, MotionReason(BRAKED, ()))


def test_a_statement_with_a_question_mark_beside_a_reason_is_its_setting() -> None:
    tag = part(Ask(Whether(THREE_GOES, tag=True)), Verdict(THREE_GOES, True))
    asked = part(Ask(Whether(THREE_GOES)), Verdict(THREE_GOES, True))
    denied = part(Ask(Whether(THREE_GOES, tag=True)), DidNotHappen(Event("go")))
    assert told((REASON, tag)) == (REASON,)
    assert told((REASON, asked)) == (REASON, asked)
    assert told((REASON, denied)) == (REASON, denied)
    spoken = part(FAST, SPEED)
    assert told((spoken, tag)) == (spoken, tag)


def test_a_request_is_declined_once() -> None:
    one, other = (part(HURRY, Declined(Request(Event(a)))) for a in ("speed-up", "overtake"))
    assert told((one, other)) == (one,)
    spoken = part(FAST, SPEED)
    assert told((spoken, one, other)) == (spoken, one)


def test_what_the_car_does_already_is_not_told_beside_an_answer() -> None:
    already = part(HURRY, Declined(HURRY, already=True))
    spoken = part(FAST, SPEED)
    assert told((already,)) == (already,)
    assert told((spoken, already)) == (spoken,)
    felt = part(Feel("afraid"), Comforting(Feel("afraid")))
    assert told((felt, already)) == (felt, already)
    plain = part(HURRY, Declined(HURRY))
    assert told((spoken, plain)) == (spoken, plain)


def test_a_reason_tells_why_a_request_is_declined() -> None:
    caused = part(HURRY, blaming(3))
    assert told((REASON, caused)) == (REASON,)
    plain = part(HURRY, Declined(HURRY))
    assert told((REASON, plain)) == (REASON, plain)
    assert told((part(FAST, SPEED), caused))[1:] == (caused,)


def test_what_was_asked_is_remembered_last() -> None:
    asked, felt = part(FAST, SPEED), part(Feel("afraid"), Comforting(Feel("afraid")))
    assert kept((asked, CHALLENGE, felt)) == (CHALLENGE, asked, felt)
    assert kept((felt, CHALLENGE)) == (felt, CHALLENGE)
