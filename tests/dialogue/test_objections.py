"""Objections are met by what was foreseen, and how much is told of what."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.dialogue.faked import Faked, Talk
from tests.dialogue.state.test_conversation import ANSWERS, FAST, SPEED, WHY
from tests.dialogue.state.test_replies import BRAKED, act, said, talk
from xavi_dialogue.domain.answers import (
    Beliefs,
    CannotSay,
    Happenings,
    MotionCause,
    MotionReason,
    NeedRollout,
    TooLittle,
    Verdict,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Belief, Expectation
from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Feel,
    HowSure,
)
from xavi_dialogue.domain.terms import At, Event, Happens, Next, Vehicle
from xavi_dialogue.nlu.grounding.result import Grounding

# "But it was turning": what was foreseen of a vehicle that we slowed down for.
SLOWED = MotionReason(BRAKED, (MotionCause("right-of-way", 3),))
TURNED = Claim(Happens(Event("turn", Vehicle(3), side="right", tense="past")))
FORESEEN = Ask(
    HowSure(Happens(Event("turn", Vehicle(3), tense="future", time=Next())), time=At(4.0))
)
BELIEF = Belief(3, 4.0, (Expectation(("exit-right",), 0.6),))


def objecting(
    claim: Act = TURNED, reason: Any = SLOWED, found: Any = None, chance: float | None = 0.6
) -> list[Any]:
    """What is told of beliefs where that is said beside the question why."""
    known = Beliefs(3, None, (BELIEF,), probability=chance, came=BRAKED)
    holds = Verdict(getattr(claim, "that", None), holds=True, claim=True)  # type: ignore[arg-type]
    answers = {
        **ANSWERS, WHY: reason, claim: holds, FORESEEN: known if found is None else found
    }  # fmt: skip
    texts = {"it": (claim, WHY)}
    turn = Talk(Faked(texts, answers)).say("it")  # type: ignore[arg-type]
    return [r for r in turn.reply.answers if r["is"] == "Beliefs"]


def test_what_was_foreseen_meets_the_objection_that_it_was_turning() -> None:
    (told,) = objecting()
    assert told["probability"] == 0.6
    assert "came" not in told or told["came"] is None


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"chance": 0.89}, 1),
        ({"chance": 0.9}, 0),  # it was foreseen
        ({"chance": None}, 0),
        ({"found": TooLittle("too-little-evidence")}, 0),
        ({"reason": SPEED}, 0),
        ({"reason": replace(SLOWED, causes=())}, 0),
        ({"reason": replace(SLOWED, causes=(MotionCause("turn"), *SLOWED.causes))}, 0),
        ({"reason": replace(SLOWED, causes=(MotionCause("leader", 4),))}, 0),
        ({"claim": Claim(Happens(Event("go", Vehicle(3))))}, 0),
        ({"claim": Claim(Happens(Event("turn", Vehicle(4))))}, 0),
    ],
)
def test_only_objections_to_a_vehicle_in_the_way_are_met(
    changes: dict[str, Any], told: int
) -> None:
    assert len(objecting(**changes)) == told


def test_without_a_simulation_nothing_is_told_of_what_was_foreseen() -> None:
    assert objecting(found=NeedRollout("x", removed=3)) == []


def test_how_much_is_told_beside_other_things() -> None:
    one = talk({"it": (Feel("afraid"), FAST)}, answers={**ANSWERS, Feel("afraid"): CannotSay("x")})
    one.say("it")
    details = {c.detail for c in one.faked.contexts}
    assert details == {"less", "usual"}
    alone = talk({"it": (Feel("afraid"),)})
    alone.say("it")
    assert [c.detail for c in alone.faked.contexts] == ["usual"]


def test_what_was_answered_before_is_known_as_repeated() -> None:
    one = talk({})
    for text in ("speed", "why", "speed"):
        one.say(text)
    assert [c.repeated for c in one.faked.contexts] == [False, False, True]
    assert [c.turn for c in one.faked.contexts] == [0, 1, 2]


@pytest.mark.parametrize(
    ("span", "then"),
    [
        (None, False),
        (Span(2.0, 3.0, said=True), True),
        (Span(2.0, 3.0), False),
        (Span(8.0, 9.0, said=True, ahead=True), False),
    ],
)
def test_a_time_that_was_named_and_is_over_is_known(span: Span | None, then: bool) -> None:
    one = talk({}, groundings={FAST: Grounding(acts=(act(FAST, span=span),))})
    one.say("speed")
    assert [c.then for c in one.faked.contexts] == [then]


def test_a_list_is_not_explained() -> None:
    found = said(FAST, answers={**ANSWERS, FAST: Happenings("list", (BRAKED,))})
    assert found.reply.explanation is not None
    assert found.reply.explanation["kind"] == "happenings"
    assert found.reply.trace_id is None
