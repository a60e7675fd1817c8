"""Which parts of a reply are told where several things were said at once."""

from collections.abc import Sequence
from typing import Any

import pytest
from msgspec.structs import replace

from xavi_dialogue.dialogue.claims import NOTED, asks, in_order, is_ground, told
from xavi_dialogue.dialogue.state.turn import Part
from xavi_dialogue.domain.answers import (
    Acknowledged,
    Helpful,
    Measures,
    Sociable,
    Verdict,
)
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.facts import Episode, Look, Measure
from xavi_dialogue.domain.meaning import Act, Ask, Claim, Feel, HowMuch, Request, Social
from xavi_dialogue.domain.terms import (
    Believed,
    Compares,
    Ego,
    Event,
    Exists,
    Happens,
    Is,
    Lane,
    Measured,
    Not,
    Proposition,
    Vehicle,
)

FAST = Ask(HowMuch(Measured("speed")))
SPEED = Measures((Measure("speed", Ego(), 7.0, 12.0),))
BRAKED = Episode(Ego(), "slow-down", 4.0, 7.0)
HURRY = Request(Event("speed-up"))
WE_BRAKED = Happens(Event("brake"))
THREE_TURNS = Happens(Event("turn", Vehicle(3)))
THREE_GOES = Happens(Event("go", Vehicle(3)))


def grounded(act: Act, *, leaned: bool = False) -> GroundedAct:
    return GroundedAct(act, leaned=leaned)


def part(act: Act | None, result: Any) -> Part:
    return Part(None if act is None else grounded(act), result)


def claim(that: Proposition, holds: bool | None = False, *facts: Look, **more: Any) -> Part:
    """A claim, and what it came to."""
    challenge = more.pop("challenge", False)
    return part(Claim(that, challenge), Verdict(that, holds, facts, claim=True, **more))


def look(vehicle: int, bearing: Any = "ahead", in_view: bool = True) -> Look:
    return Look(vehicle, 7.0, "car", "blue", 4.5, bearing, 20.0, 20.0, 0.0, 5.0, in_view=in_view)


def beside(*parts: Part, result: Any = SPEED, act: Act = FAST) -> list[Part]:
    """Which of these are told beside a question that has an answer."""
    asked = part(act, result)
    found = told((asked, *parts))
    assert asked in found
    return [one for one in found if one is not asked]


@pytest.mark.parametrize(
    ("act", "asking"),
    [
        (FAST, True),
        (HURRY, True),
        (Social("who-are-you"), True),
        (Social("how-are-you"), True),
        (Social("thanks"), False),
        (Claim(WE_BRAKED), False),
        (Feel("afraid"), False),
    ],
)
def test_questions_requests_and_personal_questions_ask(act: Act, asking: bool) -> None:
    assert asks([grounded(Claim(THREE_GOES)), grounded(act)]) is asking


def test_claims_are_replied_to_after_questions() -> None:
    one, other = grounded(Claim(WE_BRAKED)), grounded(Feel("afraid"))
    asked = grounded(FAST)
    assert in_order([one, asked, other]) == (asked, other, one)
    assert in_order([one, other]) == (one, other)


@pytest.mark.parametrize(
    ("that", "vague"),
    [
        (Is("fast", Ego()), True),
        (Not(Is("fast", Ego())), True),
        (Is("free", Lane("left")), False),
        (Is("free", Lane("left"), too=True), True),
        (Compares(Measured("speed"), "more", None), True),
        (Compares(Measured("speed"), "more", Measured("limit")), False),
        (Happens(Event("stop")), False),
        (Happens(Event("stop", modal="should")), True),
        (Happens(Event("do")), True),
        (Happens(Event("stop", manner=("suddenly",))), True),
        (Happens(Event("stop", manner=("again",))), False),
        (Exists(Vehicle(1)), False),
    ],
)
def test_opinions_beside_a_question_are_not_looked_into(that: Any, vague: bool) -> None:
    act = grounded(Claim(that))
    assert is_ground(act, [act, grounded(FAST)]) is vague
    assert not is_ground(act, [act])
    assert not is_ground(act, [act, grounded(Claim(THREE_GOES))])


def test_only_claims_are_grounds() -> None:
    feel = grounded(Feel("afraid"))
    assert not is_ground(feel, [feel, grounded(FAST)])


def test_that_it_is_not_right_says_nothing_beside_more() -> None:
    bare = grounded(Claim(Not(Is("right"))))
    wrong = grounded(Claim(Is("wrong")))
    full = grounded(Claim(THREE_TURNS))
    assert is_ground(bare, [bare, full])
    assert is_ground(wrong, [full, wrong])
    assert not is_ground(full, [bare, full])
    assert not is_ground(bare, [bare, wrong])
    assert is_ground(bare, [bare, grounded(FAST)])


def test_what_was_known_before_is_a_ground_unless_it_is_disputed() -> None:
    known = Claim(Believed(THREE_TURNS))
    for leaned, act, ground in (
        (True, known, True),
        (False, known, False),
        (True, replace(known, challenge=True), False),
    ):
        one = grounded(act, leaned=leaned)
        assert is_ground(one, [one, grounded(FAST)]) is ground


# Claims alone: one of them is replied to.
FALSE, TRUE = claim(THREE_TURNS), claim(Happens(Event("overtake", Vehicle(4))), True)
OPEN = claim(Happens(Event("overtake", Vehicle(5))), None)
DISPUTED = claim(WE_BRAKED, True, challenge=True)


@pytest.mark.parametrize(
    ("parts", "found"),
    [
        ((TRUE, FALSE, OPEN), [FALSE]),
        ((TRUE, OPEN), [OPEN]),
        ((OPEN, TRUE), [TRUE]),
        ((DISPUTED, OPEN), [DISPUTED]),
        ((DISPUTED, FALSE), [FALSE]),
        ((FALSE, claim(Happens(Event("overtake", Vehicle(6))))), [FALSE]),
    ],
)
def test_of_several_claims_the_false_the_disputed_or_the_last_is_replied_to(
    parts: Sequence[Part], found: list[Part]
) -> None:
    assert list(told(parts)) == found


def test_what_everybody_sees_is_not_agreed_to_beside_something_weightier() -> None:
    goes = claim(THREE_GOES, True)
    assert told((goes, TRUE)) == (TRUE,)
    assert told((TRUE, goes)) == (TRUE,)
    assert told((goes,)) == (goes,)
    wrong = claim(THREE_GOES, False)
    assert told((TRUE, wrong)) == (wrong,)
    noted = part(Claim(Is("fast", Ego())), NOTED)
    assert told((noted, TRUE)) == (TRUE,)
    hello = part(Social("greeting"), Sociable("greeting"))
    assert told((hello, goes)) == (hello,)
    frame = part(None, Helpful())
    assert told((frame, goes)) == (frame, goes)
    assert told((hello, part(Claim(Is("fast", Ego())), Acknowledged("yes")))) == (
        hello, part(Claim(Is("fast", Ego())), Acknowledged("yes"))
    )  # fmt: skip
