"""An answer that does not tell what was asked gives way to a more general one."""

from typing import Any, Final

import pytest

from tests.dialogue.faked import Faked, Talk
from tests.dialogue.state.test_conversation import ANSWERS
from tests.dialogue.state.test_replies import BRAKED
from xavi_dialogue.dialogue.fitting import fits, instead, untried
from xavi_dialogue.domain.answers import (
    Activity,
    CannotSay,
    Closeness,
    MotionCause,
    MotionReason,
    OtherReason,
    Priority,
    Reaction,
    TooLittle,
    Verdict,
)
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.meaning import Ask, Doing, Question, WhatIf, Whether, Why
from xavi_dialogue.domain.terms import Ego, Event, Happens, Is, Not, Related, Vehicle, Vehicles

HIM: Final = Vehicle(3)
SLOW: Final = Why(Is("slow", HIM), suspect=Vehicles((4, 5)))
OURS: Final = Why(Is("slow", Ego()), suspect=Vehicles((4, 5)))
CRASH: Final = WhatIf(Happens(Event("collide", HIM)))
TURNED: Final = WhatIf(Happens(Event("turn", Ego(), tense="past")))
LEAVING: Final = Whether(Happens(Event("leave", HIM)))
BLIND: Final = OtherReason(3, None)
HELD: Final = OtherReason(3, None, causes=(MotionCause("leader", 4),))
BLAMED: Final = MotionReason(BRAKED, (), suspect=4, suspected="main")
NEAR: Final = Closeness(3, None)
DRIVES: Final = Activity(HIM, 4.0, (), 5.0, "steady")


def act(question: Question) -> GroundedAct:
    return GroundedAct(Ask(question))


@pytest.mark.parametrize(
    ("question", "result", "told"),
    [
        (SLOW, BLIND, False),
        (SLOW, HELD, True),
        (OURS, MotionReason(BRAKED, ()), False),
        (OURS, BLAMED, True),
        (CRASH, NEAR, False),
        (CRASH, Reaction(3, "apart", None, 4.0, 5.0), False),
        (CRASH, Reaction(3, "room", None, 4.0, 5.0), True),
        (LEAVING, Priority(4.0, "priority"), False),
        (LEAVING, Priority(4.0, "priority", vehicle=3), True),
        (LEAVING, CannotSay("imagined"), True),
        (LEAVING, Verdict(LEAVING.that, holds=None), True),
        (Whether(Happens(Event("leave"))), CannotSay("imagined"), True),
    ],
)
def test_an_answer_tells_what_was_asked_or_not(question: Question, result: Any, told: bool) -> None:
    assert fits(act(question), (result,)) is told


@pytest.mark.parametrize(
    ("question", "general"),
    [
        (SLOW, [OURS]),
        (Why(Is("slow", HIM)), []),
        (Why(Not(Happens(Event("move", Ego())))), [Why(Happens(Event("do")))]),
        (CRASH, [WhatIf(Happens(Event("stop", HIM)))]),
        (WhatIf(Happens(Event("collide", HIM, Ego()))), []),
        (TURNED, []),
        (LEAVING, [Doing(HIM)]),
        (Whether(Related("ahead-of", HIM, Vehicle(4))), []),
    ],
)
def test_what_is_asked_instead_is_of_the_same_kind(question: Question, general: list[Any]) -> None:
    assert [one.act for one in instead(act(question))] == [Ask(one) for one in general]


def test_of_a_past_deed_that_was_not_tried_nothing_is_made_up() -> None:
    assert untried(act(TURNED)) == TooLittle("too-little-evidence")
    assert untried(act(CRASH)) is None


def test_the_general_answer_is_told() -> None:
    answers = {**ANSWERS, Ask(LEAVING): Priority(4.0, "priority"), Ask(Doing(HIM)): DRIVES}
    turn = Talk(Faked({"it": (Ask(LEAVING),)}, answers)).say("it")  # type: ignore[arg-type]
    assert [one["is"] for one in turn.reply.answers] == ["Activity"]
