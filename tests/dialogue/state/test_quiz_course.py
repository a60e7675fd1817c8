"""How a quiz goes on: what is planned again for it, and which replies answer it."""

from typing import Any

import pytest

from tests.dialogue.faked import NAME, Faked, Talk
from tests.dialogue.quizzes.test_quiz import LATER, WHEN, WHO, Answers, contrast
from tests.traces import s1_ride
from xavi_dialogue.dialogue.state.events import Answered, RolloutsFailed, RolloutsWanted
from xavi_dialogue.dialogue.state.states import Phase
from xavi_dialogue.domain.answers import (
    ChoiceReason,
    Judged,
    NeedRollout,
    NothingToAsk,
    Posed,
    SupposedOfUs,
    TooLittle,
)
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.meaning import (
    Ask,
    Elliptic,
    HowMuch,
    Identify,
    Quizzing,
    Repair,
    WhatIf,
)
from xavi_dialogue.domain.terms import (
    At,
    Described,
    Exists,
    Measured,
    Not,
    Vehicle,
)
from xavi_dialogue.nlu.grounding.result import Grounding

TRACE = s1_ride().traces[1].trace_id
NEED = NeedRollout(TRACE, removed=1)
FAST = Ask(HowMuch(Measured("speed")))
TEXTS: dict[str, Any] = {
    "quiz me": (Quizzing(),),
    "stop quizzing": (Quizzing(stop=True),),
    "two": (Repair("pick", pick=2),),
    "one": (Repair("pick", pick=1),),
    "the bus": (Elliptic(thing=Described("bus")),),
    "how fast": (FAST,),
    "pardon": (Repair("repeat"),),
    "car": (Elliptic(thing=Described("car")),),
}
WHO_IT_WAS = ChoiceReason("why", None, contrast())


def talk(answers: dict[Any, Any], **changes: Any) -> Talk:
    return Talk(Faked(TEXTS, Answers(answers), **changes))


def test_a_question_that_needs_a_plan_waits_for_it_or_gives_way_to_another() -> None:
    one = talk({Ask(WHO.about): NEED, Ask(WHEN.about): SupposedOfUs(contrast(LATER))})
    output = one.begin("quiz me")
    asked = []
    while isinstance(output, RolloutsWanted):  # nothing can be planned
        assert output.need == NEED
        asked.append(output)
        output = one.put(RolloutsFailed(output.request, NAME, "timed-out"))
    assert isinstance(output, Answered)
    assert output.turn is not None
    assert output.turn.quiz is not None
    assert output.turn.quiz.posed == WHEN
    assert len(asked) <= 1


def test_without_any_question_it_says_so() -> None:
    one = talk({})
    assert one.say("quiz me").results == (NothingToAsk(asked=False),)
    assert one.session.phase is Phase.LISTENING


@pytest.mark.parametrize(("text", "right"), [("one", True), ("two", False)])
def test_a_number_is_a_vehicle(text: str, right: bool) -> None:
    one = talk({Ask(WHO.about): WHO_IT_WAS})
    assert one.say("quiz me").quiz is not None
    turn = one.say(text)
    assert isinstance(turn.results[0], Judged)
    assert turn.results[0].judgement == ("right" if right else "wrong")
    assert turn.right is right


def test_a_description_is_grounded_as_of_the_question() -> None:
    named = Ask(Identify(Described("bus")))
    found = Grounding(acts=(GroundedAct(Ask(Identify(Vehicle(1)))),))
    one = talk({Ask(WHO.about): WHO_IT_WAS}, groundings={named: found})
    one.say("quiz me")
    assert one.say("the bus").right is True
    other = talk({Ask(WHO.about): WHO_IT_WAS})  # nobody is found
    other.say("quiz me")
    assert other.say("the bus").results == (Posed("vehicle", WHO.about, again=True),)


def test_the_verdict_is_reached_by_the_question_asked_at_its_time() -> None:
    without = Ask(WhatIf(Not(Exists(Vehicle(1), time=At(4.0), tense="past"))))
    one = talk({Ask(WHO.about): WHO_IT_WAS})
    one.say("quiz me")
    turn = one.say("one")
    (part,) = turn.parts
    assert part.act == GroundedAct(Ask(WHO.about))
    assert without not in one.faked.answers


def test_a_solution_that_cannot_be_told_after_all_is_declined() -> None:
    answers: dict[Any, Any] = {Ask(WHO.about): WHO_IT_WAS}
    one = talk(answers)
    one.say("quiz me")
    one.faked.answers[Ask(WHO.about)] = TooLittle("too-little-evidence")  # type: ignore[index]
    turn = one.say("one")
    assert turn.results == (TooLittle("too-little-evidence"),)
    assert turn.answered is None


def test_something_else_may_be_asked_meanwhile() -> None:
    one = talk({Ask(WHO.about): WHO_IT_WAS})
    one.say("quiz me")
    turn = one.say("how fast")
    assert turn.acts == (GroundedAct(FAST),)
    assert turn.quiz is None
    assert one.session.phase is Phase.LISTENING


def test_the_question_is_said_again() -> None:
    one = talk({Ask(WHO.about): WHO_IT_WAS})
    first = one.say("quiz me")
    again = one.say("pardon")
    assert again.quiz == first.quiz
    assert again.reply.text == first.reply.text
    assert one.session.phase is Phase.QUIZZING
    assert one.say("stop quizzing").quiz is None


def test_another_one_is_only_asked_for_in_a_quiz() -> None:
    one = talk({Ask(WHO.about): WHO_IT_WAS})
    assert one.say("another one").quiz is None
    one.say("quiz me")
    one.say("one")
    assert one.say("another one").results == (NothingToAsk(asked=True),)
    fresh = talk({Ask(WHO.about): WHO_IT_WAS})
    fresh.say("quiz me")
    fresh.say("how fast")
    assert fresh.say("another one").results != (NothingToAsk(asked=True),)
