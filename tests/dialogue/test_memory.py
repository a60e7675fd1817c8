"""What a conversation comes to: read off turns that are made up, held or stored."""

from dataclasses import replace
from functools import cache

import msgspec
from hypothesis import given
from hypothesis import strategies as st

from tests.dialogue.talking import Talk
from tests.language.realise_cases import cause as because
from xavi_dialogue.dialogue.memory import Memory, remember
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.turn import Quiz, Turn
from xavi_dialogue.explain.explanation import Cause, Evidence, Explanation
from xavi_dialogue.explain.query import Detail, Query

HERE, THERE = "this ride", "another ride"
WHY = Query(type="why", factual=("change-left",))
WHAT = Query(type="what", actor="vehicle:2", tense="present")
QUIZ = Quiz(kind="vehicle", about=WHY, vehicle=1)
FOUND = Explanation(
    factual=("change-left",),
    counterfactual=(),
    outcome=None,
    effects=(),
    causes=(),
    evidence=Evidence("tree", 4, 2, ("t",)),
)


def cause(vehicle: int) -> Cause:
    return because(vehicle, ("stop",), 0.8)


def said(found: Explanation | None = None) -> Reply:
    return Reply(text="So it is.", kind="answer", explanation=found, sim_time=6.0)


def turn(query: Query | None = WHY, ride: str = HERE, **more: object) -> Turn:
    told = Turn(text="so?", query=query, reply=said(), ride=ride)
    return msgspec.structs.replace(told, **more)


def detailed(*wanted: Detail | None) -> Detail | None:
    asked = (msgspec.structs.replace(WHY, detail=detail) for detail in wanted)
    return remember([turn(query) for query in asked], HERE).detail


def judged(vehicle: int, right: bool | None) -> Turn:
    found = msgspec.structs.replace(FOUND, causes=(cause(vehicle),))
    return turn(reply=said(found), answered=QUIZ, right=right)


def test_at_first_there_is_nothing() -> None:
    nothing = remember((), HERE)
    empty = frozenset[int]()
    assert nothing == Memory((), 0, empty, None, None, None, empty, (), frozenset())
    assert nothing.previous is None
    assert not nothing.is_quizzing


def test_vehicles_and_turns_of_other_rides_do_not_count() -> None:
    before = [turn(WHAT, THERE, mentioned=(2, 3), quiz=QUIZ), turn(WHY, THERE, answered=QUIZ)]
    memory = remember(before, HERE)
    assert memory == replace(remember((), HERE), before=2)
    mixed = remember([*before, turn(mentioned=(1,))], HERE)
    assert (mixed.before, len(mixed.turns), mixed.named, mixed.topic) == (2, 1, {1}, 1)
    assert mixed.last is not None
    assert mixed.quizzed == ()


def test_how_much_to_tell_outlasts_a_ride() -> None:
    short = msgspec.structs.replace(WHY, detail="less")
    assert remember([turn(short, THERE), turn(short, THERE)], HERE).detail == "less"


def test_what_is_asked_for_once_is_for_once() -> None:
    assert detailed("less") is None
    assert detailed("more") is None
    assert detailed("less", None, None) is None


def test_what_is_asked_for_twice_in_a_row_stands_until_the_opposite_is() -> None:
    assert detailed("less", "less") == "less"
    assert detailed("less", "less", None, None) == "less"
    assert detailed("less", None, "less") == "less"
    assert detailed("less", "less", "more") is None
    assert detailed("less", "less", "more", "more") == "more"
    assert detailed("less", "less", "more", "less") is None
    assert detailed("less", "more", "less", "more") is None


def test_what_was_spoken_of_last_is_the_topic() -> None:
    memory = remember([turn(mentioned=(1, 2)), turn(mentioned=(3, 1)), turn()], HERE)
    assert memory.named == {1, 2, 3}
    assert memory.topic == 1


def test_a_follow_up_leans_on_the_last_question_about_the_drive() -> None:
    hello, lost = Query(type="smalltalk", event="thanks"), Query(type="out_of_scope")
    memory = remember([turn(WHY), turn(WHAT), turn(hello), turn(lost), turn(None)], HERE)
    assert memory.previous == WHAT
    assert memory.asked == (WHY, WHAT, hello, lost)


def test_a_follow_up_leans_on_what_the_turn_says_where_that_is_not_the_question() -> None:
    assert remember([turn(WHY), turn(WHAT, leans=WHY)], HERE).previous == WHY


def test_a_follow_up_is_not_as_detailed_as_what_it_leans_on() -> None:
    short = msgspec.structs.replace(WHY, detail="less")
    assert remember([turn(short)], HERE).previous == WHY


def test_what_the_passenger_got_wrong_is_missed_until_it_is_right() -> None:
    def missed(*turns: Turn) -> frozenset[int]:
        return remember(turns, HERE).missed

    assert missed(judged(1, True), judged(2, None)) == frozenset()
    assert missed(judged(1, False), judged(2, False)) == {1, 2}
    assert missed(judged(1, False), judged(1, None)) == {1}
    assert missed(judged(1, False), judged(2, True)) == {1}
    assert missed(judged(1, False), judged(1, True)) == frozenset()
    assert missed(judged(1, True), judged(1, False)) == {1}


def test_what_was_told_is_known_unless_it_was_missed() -> None:
    found = msgspec.structs.replace(FOUND, causes=(cause(1), cause(2)))
    known = turn(reply=said(found))
    assert {vehicle for vehicle, _ in remember([known], HERE).told} == {1, 2}
    assert {vehicle for vehicle, _ in remember([known, judged(2, False)], HERE).told} == {1}


def test_what_was_answered_is_known_by_question_and_answer() -> None:
    memory = remember([turn(WHY, reply=said(FOUND))], HERE)
    again = msgspec.structs.replace(WHY, refers_to_previous=True)
    assert memory.answered(again, FOUND)
    assert not memory.answered(msgspec.structs.replace(WHY, detail="more"), FOUND)
    assert not memory.answered(WHAT, FOUND)
    assert not memory.answered(WHY, msgspec.structs.replace(FOUND, causes=(cause(7),)))


def test_a_quiz_goes_on_while_it_is_put_or_judged() -> None:
    asked, answered = turn(quiz=QUIZ), turn(answered=QUIZ, right=True)
    assert remember([asked], HERE).is_quizzing
    assert remember([asked, answered], HERE).is_quizzing
    assert not remember([asked, answered, turn()], HERE).is_quizzing
    assert remember([asked, turn(), asked], HERE).quizzed == (QUIZ, QUIZ)


# --- Conversations that were held ----------------------------------------------------------------

SAYINGS = (
    *("Why did you change lanes?", "Why?", "Which car?", "How do you know?", "Are you sure?"),
    *("What is vehicle 2 doing?", "And the other one?", "Where is it going?", "2", "no, vehicle 1"),
    *("Why did you turn left?", "shorter", "more", "What were you doing 2 seconds ago?"),
    *("quiz me", "vehicle 2", "I don't know", "another one", "thanks", "xyzzy"),
    *("What if vehicle 1 had not been there?", "What did you just say?", "Could you fly?"),
)


@cache
def held(texts: tuple[str, ...]) -> tuple[Turn, ...]:
    talk = Talk(planner=False)
    for text in texts:
        talk.say(text)
    return talk.session.turns


rows = st.lists(st.sampled_from(SAYINGS), max_size=6).map(tuple)


@given(rows, rows)
def test_a_conversation_that_was_stored_comes_to_the_same(
    before: tuple[str, ...], later: tuple[str, ...]
) -> None:
    turns = held(before)
    stored = [msgspec.json.encode(one) for one in turns]
    read = tuple(msgspec.json.decode(line, type=Turn) for line in stored)
    ride = Talk().dialogue.ride_id
    assert remember(read, ride) == remember(turns, ride)
    resumed, lived = Talk(planner=False), Talk(planner=False)
    resumed.resume(read)
    for text in before:
        lived.say(text)
    assert [resumed.say(text) for text in later] == [lived.say(text) for text in later]


@given(rows)
def test_what_is_remembered_is_what_the_turns_say(texts: tuple[str, ...]) -> None:
    turns = held(texts)
    ride = Talk().dialogue.ride_id
    memory = remember(turns, ride)
    assert memory.turns == turns
    assert memory.before == 0
    assert remember(turns, "another").turns == ()
    assert memory.named == {name for one in turns for name in one.mentioned}
    assert (memory.topic is None) == (not memory.named)
    assert len(memory.quizzed) == sum(one.quiz is not None for one in turns)
