"""The course of a quiz on recorded rides: posed, replied to, interrupted, resumed, at its end."""

from collections.abc import Callable

import msgspec
import pytest

from tests.dialogue.talking import MIND, Talk
from xavi_dialogue.dialogue.events import EventRecorded, TraceRecorded
from xavi_dialogue.dialogue.manager import fold
from xavi_dialogue.dialogue.memory import remember
from xavi_dialogue.dialogue.state import up_to
from xavi_dialogue.dialogue.states import Phase
from xavi_dialogue.dialogue.turn import Quiz, Turn
from xavi_dialogue.explain.query import Query


def posed(talk: Talk, kind: str, text: str = "Quiz me") -> Quiz:
    """Ask to be quizzed until a question of this kind is put."""
    for _ in range(12):
        turn = talk.say(text)
        assert turn.quiz is not None, f"no question of kind {kind}"
        if turn.quiz.kind == kind:
            return turn.quiz
    raise AssertionError("no end of questions")


def true_reply(quiz: Quiz) -> str:
    if quiz.kind == "vehicle":
        return f"vehicle {quiz.vehicle}"
    if quiz.kind == "sooner":
        return "sooner" if quiz.sooner else "later"
    return {"continue": "you would have stayed in your lane", "change-left": "change left"}[
        quiz.actions[0]
    ]


def false_reply(quiz: Quiz) -> str:
    if quiz.kind == "vehicle":
        return "vehicle 9"
    if quiz.kind == "sooner":
        return "later" if quiz.sooner else "sooner"
    return "you would have turned right"


@pytest.mark.parametrize("kind", ["vehicle", "deed", "sooner"])
def test_a_question_is_put_that_has_an_answer_and_does_not_give_it_away(kind: str) -> None:
    talk = Talk()
    quiz = posed(talk, kind)
    turn = talk.session.turns[-1]
    assert talk.session.phase is Phase.QUIZZING
    assert turn.reply.text.endswith("?")
    assert turn.reply.explanation is None
    assert quiz.vehicle not in turn.mentioned
    assert (quiz.vehicle is not None, bool(quiz.actions), quiz.same is not None) == {
        "vehicle": (True, False, False),
        "deed": (False, True, True),
        "sooner": (False, False, False),
    }[kind]
    assert kind != "sooner" or quiz.sooner is not None


@pytest.mark.parametrize("kind", ["vehicle", "deed", "sooner"])
@pytest.mark.parametrize("right", [True, False, None])
def test_a_reply_is_judged_and_explained(kind: str, right: bool | None) -> None:
    talk = Talk()
    quiz = posed(talk, kind)
    reply = {True: true_reply(quiz), False: false_reply(quiz), None: "I don't know"}[right]
    verdict = talk.say(reply)
    assert verdict.answered == quiz
    assert verdict.right is right
    assert verdict.query == quiz.about
    assert verdict.reply.kind == "answer"
    assert verdict.reply.explanation is not None
    assert verdict.reply.trace_id in {trace.trace_id for trace in talk.ride.traces}
    assert talk.session.phase is Phase.LISTENING


def test_what_is_said_of_right_and_wrong_differs() -> None:
    openings = set()
    for reply in (true_reply, false_reply, lambda _: "no idea"):
        talk = Talk()
        openings.add(talk.say(reply(posed(talk, "vehicle"))).reply.text.split(":")[0])
    assert len(openings) == 3


def test_another_one_is_put_after_a_verdict_and_after_a_question() -> None:
    talk = Talk()
    first = posed(talk, "sooner")
    second = talk.say("another one").quiz
    assert second is not None
    assert second != first
    talk.say("I don't know")
    third = talk.say("another one").quiz
    assert third is not None
    assert third not in (first, second)


@pytest.mark.parametrize("text", ["another one", "next", "more"])
def test_another_one_means_nothing_of_the_kind_where_there_is_no_quiz(text: str) -> None:
    talk = Talk()
    assert talk.say(text).quiz is None
    talk.hear("Quiz me", "What is vehicle 2 doing?")
    assert talk.say(text).quiz is None


@pytest.mark.parametrize("reply", ["banana", "77", "what?"])
def test_a_reply_that_makes_no_sense_leaves_the_question_open(reply: str) -> None:
    talk = Talk()
    quiz = posed(talk, "sooner")
    for _ in range(2):
        turn = talk.say(reply, at=8.0)
        assert turn.reply.kind != "answer"
        assert talk.session.phase is Phase.QUIZZING
    verdict = talk.say(true_reply(quiz), at=12.0)
    assert (verdict.answered, verdict.right) == (quiz, True)
    plain = Talk()
    posed(plain, "sooner")
    assert verdict.reply.explanation == plain.say(true_reply(quiz)).reply.explanation


def test_a_question_that_was_left_open_is_still_about_the_moment_it_was_put_at() -> None:
    at_once, later = Talk(at=2.0), Talk(at=2.0)
    quiz = posed(at_once, "deed")
    assert posed(later, "deed") == quiz
    later.say("banana", at=12.0)
    assert later.say(true_reply(quiz)).reply.explanation == (
        at_once.say(true_reply(quiz)).reply.explanation
    )


def test_a_question_in_between_is_answered_and_ends_the_quiz() -> None:
    talk = Talk()
    quiz = posed(talk, "vehicle")
    between = talk.say("Where is vehicle 2 going?")
    assert between.query == Query(type="where_goal", actor="vehicle:2", tense="present")
    assert between.answered is None
    late = talk.say(true_reply(quiz))
    assert late.answered is None
    assert late.query is not None
    assert late.query.actor == "vehicle:1"  # "and vehicle 1?"


def test_a_quiz_may_be_taken_up_again_with_other_questions() -> None:
    talk = Talk()
    quiz = posed(talk, "vehicle")
    talk.say("Where is vehicle 2 going?")
    again = talk.say("Quiz me").quiz
    assert again is not None
    assert again != quiz


def test_no_question_is_put_twice_and_at_last_there_is_none_left() -> None:
    talk = Talk()
    found: list[Quiz] = []
    while (quiz := talk.say("Quiz me").quiz) is not None:
        found.append(quiz)
        assert len(found) < 20
    assert len({(quiz.kind, quiz.about) for quiz in found}) == len(found) >= 3
    spent = talk.session.turns[-1]
    assert talk.session.phase is Phase.LISTENING
    assert spent.reply.kind == "answer"
    assert not spent.reply.text.endswith("?")
    assert talk.say(true_reply(found[-1])).answered is None


def test_where_nothing_can_be_asked_that_is_said_otherwise_than_at_the_end() -> None:
    never, done = Talk("bend-0", at=5.0), Talk()
    first = never.say("Quiz me")
    assert first.quiz is None
    while (last := done.say("Quiz me")).quiz is not None:
        pass
    assert first.reply.text.split(".")[0] != last.reply.text.split(".")[0]


def test_a_manoeuvre_between_question_and_reply_changes_nothing() -> None:
    """Asked at 2 s, before the lane change, of what was planned then."""
    at_once, later = Talk(at=2.0), Talk(at=2.0)
    quiz = posed(at_once, "deed")
    assert posed(later, "deed") == quiz
    first = at_once.say(true_reply(quiz))
    second = later.say(true_reply(quiz), at=12.0)
    assert (second.right, second.reply.text) == (first.right, first.reply.text)
    assert second.reply.explanation == first.reply.explanation
    assert later.say("What are you doing?").reply.sim_time == 12.0


@pytest.mark.parametrize("at", [2.0, 4.0, 6.0, 12.0])
def test_what_is_asked_follows_from_what_was_known_when_it_was_asked(at: float) -> None:
    whole, part = Talk(at=at), Talk(at=at)
    known = up_to(part.dialogue.record(at), at)
    inputs = (*map(TraceRecorded, known.traces), *map(EventRecorded, known.events))
    part.dialogue = fold(MIND, inputs)
    for _ in range(2):
        assert whole.say("Quiz me") == part.say("Quiz me")


def test_without_a_planner_only_what_needs_none_is_asked() -> None:
    with_planner, without = Talk(), Talk(planner=False)
    found: list[list[Quiz]] = [[], []]
    for talk, quizzes in zip((with_planner, without), found, strict=True):
        while (quiz := talk.say("Quiz me").quiz) is not None:
            quizzes.append(quiz)
            verdict = talk.say(true_reply(quiz))
            assert (verdict.right, verdict.reply.kind) == (True, "answer")
    assert found[1]
    assert len(found[1]) < len(found[0])


def test_what_was_planned_for_a_question_serves_for_its_verdict() -> None:
    talk = Talk()
    quiz = posed(talk, "deed")
    talk.planner = False
    verdict = talk.say(true_reply(quiz))
    assert verdict.right is True
    assert verdict.reply.explanation is not None


def test_where_there_is_no_planner_any_more_there_is_no_verdict_but_the_reason() -> None:
    """A conversation is resumed, and what was planned for the question is gone."""
    before = Talk()
    quiz = posed(before, "deed")
    resumed = Talk(planner=False)
    resumed.resume(before.session.turns)
    declined = resumed.say(true_reply(quiz))
    assert (declined.reply.kind, declined.reply.reason) == ("refusal", "planner-unavailable")
    assert declined.right is None
    assert declined.answered is None


def test_after_a_wrong_reply_the_vehicle_is_missed_until_it_is_named_rightly() -> None:
    talk = Talk()

    def missed() -> frozenset[int]:
        return remember(talk.session.turns, talk.dialogue.ride_id).missed

    quiz = posed(talk, "vehicle")
    talk.say("vehicle 9")
    assert missed() == {quiz.vehicle}
    talk.say("Why did you change lanes?")
    assert missed() == {quiz.vehicle}


def test_a_verdict_can_be_asked_into() -> None:
    talk = Talk()
    talk.say(true_reply(posed(talk, "vehicle")))
    motive = talk.say("Why?")
    assert motive.query is not None
    assert (motive.query.type, motive.query.actor) == ("why", "vehicle:1")


@pytest.mark.parametrize("reply", [true_reply, false_reply])
def test_a_quiz_that_was_broken_off_goes_on_where_it_was(reply: Callable[[Quiz], str]) -> None:
    before = Talk()
    quiz = posed(before, "vehicle")
    stored = [msgspec.json.encode(turn) for turn in before.session.turns]
    resumed = Talk()
    resumed.resume(tuple(msgspec.json.decode(line, type=Turn) for line in stored))
    assert resumed.session.phase is Phase.QUIZZING
    later = [talk.say(reply(quiz)) for talk in (before, resumed)]
    assert later[0] == later[1]
    assert later[1].answered == quiz
    assert before.say("another one").quiz == resumed.say("another one").quiz


def test_a_quiz_about_another_ride_is_not_gone_on_with() -> None:
    before = Talk("s2-0")
    quiz = posed(before, "vehicle")
    resumed = Talk("s1-0")
    resumed.resume(before.session.turns)
    assert resumed.session.phase is Phase.LISTENING
    assert resumed.say(true_reply(quiz)).answered is None


def test_that_it_would_be_sooner_is_not_wrong_where_that_is_not_clear() -> None:
    talk = Talk(at=2.0)
    quiz = posed(talk, "deed")
    assert (quiz.same, quiz.sooner) == (True, None)
    for reply in ("sooner", "you would drive faster"):
        held = Talk(at=2.0)
        assert posed(held, "deed") == quiz
        assert held.say(reply).right is None
