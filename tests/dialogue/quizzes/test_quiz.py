"""Questions of ours: what is put, what replies come to, and how a quiz goes on."""

import pytest

from tests.dialogue.faked import Faked, Talk
from xavi_dialogue.dialogue.quizzes.quiz_replies import judged, signs
from xavi_dialogue.dialogue.state.states import Phase
from xavi_dialogue.dialogue.state.turn import Quiz
from xavi_dialogue.domain.answers import (
    Cause,
    ChoiceReason,
    Contrast,
    Effect,
    Evidence,
    Judged,
    NothingToAsk,
    OutcomeEstimate,
    Posed,
    SupposedOfUs,
    TooLittle,
)
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.meaning import Ask, Claim, Elliptic, Quizzing, Reading, WhatIf, Why
from xavi_dialogue.domain.terms import Event, Happens, Vehicle

WHO = Posed("vehicle", Why(Happens(Event("slow-down"))))
WHEN = Posed("sooner", WhatIf(Happens(Event("continue", modal="would"))))
LATER = Effect("time", "s", 4.0, 3.0, 5.0, 10, 5)


def contrast(*effects: Effect) -> Contrast:
    return Contrast(
        fact=("change-left",),
        foil=("continue",),
        outcome=OutcomeEstimate("done", 1.0),
        effects=effects,
        causes=(Cause(1, ("exit-right",), 0.9),),
        evidence=Evidence(),
        decided=4.0,
    )


class Answers(dict):  # type: ignore[type-arg]
    """What each of our questions is answered; too little is known of all others."""

    def __missing__(self, act: object) -> object:
        return TooLittle("too-little-evidence")


@pytest.fixture
def talk() -> Talk:
    answers = Answers(
        {
            Ask(WHO.about): ChoiceReason("why", None, contrast()),
            Ask(WHEN.about): SupposedOfUs(contrast(LATER)),
        }
    )
    texts = {
        "quiz me": (Quizzing(),),
        "vehicle 1": (Elliptic(thing=Vehicle(1)),),
        "vehicle 2": (Elliptic(thing=Vehicle(2)),),
    }
    return Talk(Faked(texts, answers))


def test_questions_are_put_as_long_as_the_record_answers_any(talk: Talk) -> None:
    kinds = []
    for _ in range(3):
        turn = talk.say("quiz me")
        kinds.append(None if turn.quiz is None else turn.quiz.posed.kind)
    assert sorted(map(str, kinds)) == ["None", "sooner", "vehicle"]
    assert talk.session.turns[-1].results == (NothingToAsk(asked=True),)


def posed(talk: Talk, kind: str) -> Quiz:
    quiz = None
    while quiz is None or quiz.posed.kind != kind:
        quiz = talk.say("quiz me").quiz
    assert talk.session.phase is Phase.QUIZZING
    return quiz


@pytest.mark.parametrize(
    ("kind", "text", "right"),
    [
        ("sooner", "later I think", True),
        ("sooner", "we'd have been there sooner", False),
        ("sooner", "no idea", None),
        ("vehicle", "vehicle 1", True),
        ("vehicle", "vehicle 2", False),
        ("vehicle", "nobody", False),
    ],
)
def test_a_reply_is_judged_by_the_record(
    talk: Talk, kind: str, text: str, right: bool | None
) -> None:
    posed(talk, kind)
    turn = talk.say(text)
    assert isinstance(turn.results[0], Judged)
    assert turn.right is right
    assert turn.answered is not None
    assert talk.session.phase is Phase.LISTENING


def test_what_is_no_reply_leaves_the_question_open(talk: Talk) -> None:
    posed(talk, "sooner")
    turn = talk.say("mumble")
    assert isinstance(turn.results[0], Posed)
    assert turn.results[0].again
    assert talk.session.phase is Phase.QUIZZING


def test_a_bare_name_is_no_question_of_the_passengers(talk: Talk) -> None:
    posed(talk, "sooner")
    turn = talk.say("vehicle 1")
    assert isinstance(turn.results[0], Posed)
    assert turn.results[0].again


def goes_on(talk: Talk, before: Quiz) -> None:
    """Ask for another question: what comes is not the one before, nor that one anew."""
    kinds = {posed.kind for posed in (WHO, WHEN)} - {
        turn.quiz.posed.kind for turn in talk.session.turns if turn.quiz is not None
    }
    turn = talk.say("another one please")
    if kinds:
        assert turn.quiz is not None
        assert turn.results[0] == turn.quiz.posed
        assert {turn.quiz.posed.kind} == kinds
        assert turn.quiz.posed.kind != before.posed.kind
        assert talk.session.phase is Phase.QUIZZING
    else:
        assert turn.results[0] == NothingToAsk(asked=True)
        assert talk.session.phase is Phase.LISTENING


def test_another_one_after_the_verdict_goes_on(talk: Talk) -> None:
    before = posed(talk, "sooner")
    talk.say("no idea")
    goes_on(talk, before)


def test_another_one_goes_on(talk: Talk) -> None:
    goes_on(talk, posed(talk, "sooner"))


DEED = Posed("deed", WhatIf(Happens(Event("exit-straight", Vehicle(1)))))


@pytest.mark.parametrize(
    ("text", "act", "verdict"),
    [
        ("you'd have stayed in your lane", Claim(Happens(Event("keep-lane"))), "right"),
        ("change left", Elliptic(event=Event("change-left")), "wrong"),
        ("the same", None, "wrong"),
        ("something else", None, "passed"),
        ("dunno", None, "passed"),
        ("why did you stop", Ask(WHO.about), None),
    ],
)
def test_what_we_would_have_done(text: str, act: object, verdict: str | None) -> None:
    quiz = Quiz(posed=DEED, at=5.0, actions=("continue",), same=False)
    acts = () if act is None else (act,)
    reading = Reading(acts=acts, shares=())  # type: ignore[arg-type]
    assert judged(quiz, signs(text), reading, ()) == verdict


def test_a_grounded_question_is_hashable() -> None:
    assert hash(GroundedAct(Ask(WHO.about))) is not None
