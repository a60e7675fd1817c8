"""What replies to our questions come to."""

from typing import Any

import pytest

from planner.record.trace import Action
from tests.dialogue.quizzes.test_quiz_questions import sooner_with, who, without
from xavi_dialogue.dialogue.quizzes.quiz_replies import Sign, judged, signs
from xavi_dialogue.dialogue.state.turn import Judgement, Quiz
from xavi_dialogue.domain.meaning import Act, Ask, Claim, Elliptic, Reading, Why
from xavi_dialogue.domain.terms import Ego, Event, Happens, Vehicle


def reply(quiz: Quiz, text: str, *acts: Act, meant: tuple[Any, ...] = ()) -> Judgement | None:
    return judged(quiz, signs(text), Reading(acts=acts, shares=()), meant)


WHO = Quiz(posed=who("stop"), at=5.0, vehicle=7)


@pytest.mark.parametrize(
    ("text", "meant", "verdict"),
    [
        ("the bus", (Vehicle(7),), "right"),
        ("the car", (Vehicle(8),), "wrong"),
        ("the bus and the car", (Vehicle(7), Vehicle(8)), "wrong"),
        ("nobody", (), "wrong"),
        ("no idea", (), "passed"),
        ("hm", (), None),
        ("hm", (Ego(),), None),
    ],
)
def test_who_it_was(text: str, meant: tuple[Any, ...], verdict: Judgement | None) -> None:
    assert reply(WHO, text, meant=meant) == verdict


def test_a_question_is_no_reply_unless_it_names_somebody_or_says_more() -> None:
    assert reply(WHO, "was it the bus?", Ask(who("stop").about), meant=(Vehicle(7),)) == "right"
    assert reply(WHO, "why?", Ask(who("stop").about)) is None
    assert reply(WHO, "nobody?", Ask(who("stop").about)) == "wrong"
    assert reply(WHO, "I do not know, why?", Ask(who("stop").about)) == "passed"
    assert judged(WHO, frozenset(), None, ()) is None


def deed(*actions: Action, same: bool = False, sooner: bool | None = None) -> Quiz:
    return Quiz(posed=without(3), at=5.0, actions=actions, same=same, sooner=sooner)


@pytest.mark.parametrize(
    ("quiz", "text", "verdict"),
    [
        (deed("stop", same=True), "the same", "right"),
        (deed("stop"), "the same", "wrong"),
        (deed("stop", same=True), "something else", "wrong"),
        (deed("stop"), "something else", "passed"),
        (deed("stop", same=True, sooner=True), "sooner", "right"),
        (deed("stop", same=True, sooner=True), "later", "wrong"),
        (deed("stop", same=True, sooner=False), "later", "right"),
        (deed("stop", sooner=True), "sooner", "wrong"),  # it is something else that we would do
        (deed("stop", same=True), "sooner", "passed"),  # that is not clear
        (deed("stop"), "hm", None),
    ],
)
def test_what_we_would_have_done(quiz: Quiz, text: str, verdict: Judgement | None) -> None:
    assert reply(quiz, text) == verdict


@pytest.mark.parametrize(
    ("action", "side", "right", "wrong"),
    [
        ("continue", None, ["continue", "exit-straight"], ["stop"]),
        ("exit-straight", None, ["continue", "exit-straight"], ["stop"]),
        ("go", None, ["continue", "exit-straight"], ["change-left"]),
        ("move", None, ["continue", "exit-straight"], ["stop"]),
        ("keep-lane", None, ["continue"], ["exit-straight", "change-left"]),
        ("change-lane", None, ["change-left", "change-right"], ["continue", "exit-left"]),
        ("change-lane", "left", ["change-left"], ["change-right", "exit-left"]),
        ("change-lane", "right", ["change-right"], ["change-left"]),
        ("turn", None, ["exit-left", "exit-right"], ["change-left"]),
        ("turn", "left", ["exit-left"], ["exit-right", "change-left"]),
        ("turn", "right", ["exit-right"], ["exit-left"]),
        ("overtake", None, ["change-left", "change-right"], ["continue"]),
        ("give-way", None, ["stop"], ["continue"]),
        ("wait", None, ["stop"], ["continue"]),
        ("brake", None, ["stop"], ["continue"]),
        ("stand", None, ["stop"], ["continue"]),
        ("change-left", None, ["change-left"], ["change-right"]),
        ("see", None, [], ["continue", "stop"]),
    ],
)
def test_an_action_may_be_called_otherwise(
    action: Any, side: Any, right: list[Action], wrong: list[Action]
) -> None:
    said = Claim(Happens(Event(action, side=side)))
    for verdict, actions in (("right", right), ("wrong", wrong)):
        for one in actions:
            assert reply(deed(one), "so", said) == verdict
            assert reply(deed(one, same=True), "so", said) == verdict
    # The first of several counts; a question is none.
    both = (Elliptic(event=Event("stop")), said)
    assert reply(deed("stop"), "so", *both) == "right"
    assert reply(deed("stop"), "so", Ask(Why(Happens(Event("stop"))))) is None


@pytest.mark.parametrize("sooner", [True, False])
@pytest.mark.parametrize(
    ("said", "verdict"),
    [
        ({"sooner"}, True),
        ({"later"}, False),
        ({"sooner", "later"}, "passed"),
        ({"same"}, "wrong"),
        ({"passed"}, "passed"),
        ({"nobody"}, None),
        (set(), None),
    ],
)
def test_when_we_would_have_been_there(
    sooner: bool, said: set[Sign], verdict: bool | Judgement | None
) -> None:
    quiz = Quiz(posed=sooner_with("continue"), at=5.0, sooner=sooner)
    if isinstance(verdict, bool):
        verdict = "right" if verdict is sooner else "wrong"
    assert judged(quiz, frozenset(said), None, ()) == verdict


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("Dunno!", {"passed"}),
        ("no idea", {"passed", "no"}),
        ("The SAME thing", {"same"}),
        ("we'd have been a bit later, I think", {"later"}),
        ("another one, please", {"another"}),
        ("yes", {"yes"}),
        ("nope", {"no"}),
        ("the red car", set()),
    ],
)
def test_signs_are_read_off_the_words(text: str, found: set[str]) -> None:
    assert signs(text) == found
