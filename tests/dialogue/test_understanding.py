"""What is asked in the light of what was said before, on recorded rides."""

import pytest

from tests.dialogue.talking import MIND, NAME, Talk, driven
from xavi_dialogue.dialogue.events import Answered, Asked
from xavi_dialogue.dialogue.manager import advance
from xavi_dialogue.dialogue.mind import Mind
from xavi_dialogue.dialogue.states import Phase
from xavi_dialogue.dialogue.turn import Turn
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.parse import NotUnderstood

CHANGED = "Why did you change lanes?"
TRUCK = "What is the truck doing?"


def asked(turn: Turn) -> tuple[str, str, str]:
    assert turn.query is not None
    return turn.query.type, turn.query.actor, turn.query.tense


# --- Corrections, and the other one --------------------------------------------------------------


@pytest.mark.parametrize("text", ["no, I meant vehicle 2", "no, vehicle 2", "I meant vehicle 2"])
def test_a_correction_asks_the_same_of_another(text: str) -> None:
    talk = Talk()
    talk.say("Where is vehicle 1 going?")
    turn = talk.say(text)
    assert asked(turn) == ("where_goal", "vehicle:2", "present")
    assert turn.reply.explanation == Talk().say("Where is vehicle 2 going?").reply.explanation


def test_a_correction_takes_a_question_back_that_was_declined() -> None:
    talk = Talk()
    assert talk.say("What is vehicle 9 doing?").reply.reason == "unknown-vehicle"
    assert asked(talk.say("no, I meant vehicle 2")) == ("what", "vehicle:2", "present")


def test_a_correction_of_what_was_doubted_is_of_the_question_before() -> None:
    talk = Talk()
    talk.hear("What is vehicle 9 doing?", "Are you sure?")
    assert asked(talk.say("no, I meant vehicle 2")) == ("what", "vehicle:2", "present")


def test_the_other_one_is_not_the_one_that_was_spoken_of() -> None:
    talk = Talk()
    talk.say("What is vehicle 1 doing?")
    for vehicle in (2, 1, 2):
        assert asked(talk.say("And the other one?")) == ("what", f"vehicle:{vehicle}", "present")


def test_of_several_others_it_is_asked_which() -> None:
    talk = Talk("motorway-0", at=20.0)
    talk.say("What is vehicle 1 doing?")
    turn = talk.say("And the other one?")
    assert turn.reply.reason == "ambiguous"
    assert all("vehicle 1?" not in choice for choice in turn.reply.choices)


@pytest.mark.parametrize("text", ["the other one", "no, I meant vehicle 2", "And vehicle 2?"])
def test_out_of_the_blue_nothing_is_corrected(text: str) -> None:
    assert Talk().say(text).reply.reason in ("ambiguous", "not-understood")


# --- Choices -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "vehicle"),
    [
        *(("1", 1), ("2", 3), ("2.", 3), ("the first one", 1), ("The second one, please.", 3)),
        *(("the last one", 3), ("I mean number two", 3), ("the former", 1), ("the latter", 3)),
        *(("vehicle 3", 3), ("the one behind us", 3)),
    ],
)
def test_a_choice_is_picked(text: str, vehicle: int) -> None:
    talk = Talk("motorway-0", at=20.0)
    offered = talk.say(TRUCK)
    assert [query.actor for query in offered.choices] == ["vehicle:1", "vehicle:3"]
    turn = talk.say(text)
    assert asked(turn) == ("what", f"vehicle:{vehicle}", "present")
    assert turn.reply.kind == "answer"
    assert turn.mentioned[-1] == vehicle


@pytest.mark.parametrize("text", ["neither", "none of them"])
def test_none_of_the_choices_is_answered_where_none_is_picked(text: str) -> None:
    talk = Talk("motorway-0", at=20.0)
    talk.say(TRUCK)
    turn = talk.say(text)
    assert turn.reply.kind == "refusal"
    assert turn.reply.explanation is None
    assert talk.session.phase is Phase.LISTENING
    assert talk.say("the second one").reply.kind != "answer"


@pytest.mark.parametrize("text", ["3", "0", "5!", "99"])
def test_a_number_of_none_of_the_choices_has_them_offered_again(text: str) -> None:
    talk = Talk("motorway-0", at=20.0)
    offered = talk.say(TRUCK)
    again = talk.say(text)
    assert again.reply.kind == "clarification"
    assert again.reply.choices == offered.reply.choices
    assert asked(talk.say("2"))[1] == "vehicle:3"


def test_a_number_by_itself_asks_nothing() -> None:
    talk = Talk()
    for _ in range(2):
        assert talk.say("2").reply.reason == "not-understood"
        assert talk.say(CHANGED).reply.kind == "answer"


def test_a_question_instead_of_a_choice_is_answered_and_voids_the_choices() -> None:
    talk = Talk("motorway-0", at=20.0)
    talk.say(TRUCK)
    assert asked(talk.say("What are you doing?")) == ("what", "ego", "present")
    assert talk.say("2").reply.kind == "refusal"


def ask(readings: tuple[Query, ...]) -> Turn:
    """What comes of a text that the parser gives these readings of."""

    def parse(text: str, _: frozenset[int], __: Query | None) -> Query | NotUnderstood:
        return NotUnderstood("ambiguous", readings)

    mind = Mind(parse, MIND.explain)
    _, [output] = advance(mind, driven("s1-0"), Asked("q", NAME, "so?", 6.0))
    assert isinstance(output, Answered)
    assert output.turn is not None
    return output.turn


def test_choices_that_read_alike_are_one() -> None:
    why = Query(type="why", factual=("change-left",))
    same = Query(type="why", factual=("change-left",), refers_to_previous=True)
    what = Query(type="what", actor="vehicle:1", tense="present")
    turn = ask((why, same, what))
    assert len(turn.choices) == len(turn.reply.choices) == 2
    assert turn.choices[1] == what
    assert len(set(turn.reply.choices)) == 2


def test_choices_that_all_read_alike_are_not_offered() -> None:
    why = Query(type="why", factual=("change-left",))
    turn = ask((why, Query(type="why", factual=("change-left",), refers_to_previous=True)))
    assert turn.reply.choices == ()
    assert turn.choices == ()


def test_choices_are_not_too_many() -> None:
    readings = (Query(type="what", actor=f"vehicle:{n}", tense="present") for n in range(1, 12))
    turn = ask(tuple(readings))
    assert 2 <= len(turn.choices) == len(turn.reply.choices) <= 4


# --- Times ---------------------------------------------------------------------------------------


def test_follow_ups_stay_with_the_time_that_was_spoken_of() -> None:
    talk = Talk(at=12.0)
    told = talk.say("What were you doing 5 seconds ago?")
    assert told.focus is not None
    assert told.focus.moment == pytest.approx(7.0)
    assert "0:07" in told.reply.text
    assert talk.say("Why?").focus == told.focus
    onward = talk.say("And where was vehicle 1 going?")
    assert onward.focus == told.focus
    assert "0:07" in onward.reply.text
    assert talk.say("Are you sure?").focus == told.focus


@pytest.mark.parametrize("question", ["What are you doing?", "Where is vehicle 1 going?", CHANGED])
def test_a_fresh_question_is_not_about_the_time_before(question: str) -> None:
    talk = Talk(at=12.0)
    talk.hear("What were you doing 5 seconds ago?", "Why?")
    fresh = talk.say(question)
    assert fresh.focus is None
    assert "0:07" not in fresh.reply.text


def test_another_time_takes_the_place_of_the_one_before() -> None:
    talk = Talk(at=12.0)
    talk.say("What were you doing 5 seconds ago?")
    later = talk.say("And at 0:10?")
    assert later.focus is not None
    assert later.focus.moment == pytest.approx(10.0)


def test_a_time_of_which_there_is_no_record_is_declined_and_not_kept() -> None:
    talk = Talk(at=12.0)
    declined = talk.say("What were you doing 100 seconds ago?")
    assert declined.reply.reason == "outside-record"
    assert talk.say(CHANGED).reply.explanation == Talk(at=12.0).say(CHANGED).reply.explanation


# --- What was declined ---------------------------------------------------------------------------


def test_what_was_declined_stands_when_it_is_doubted() -> None:
    talk = Talk()
    talk.say("Why did you turn left?")
    first = talk.say("Are you sure?")
    assert (first.reply.kind, first.reply.reason) == ("answer", None)
    assert first.reply.explanation is None
    assert "record" in first.reply.text
    second = talk.say("Really?")
    assert second.reply.explanation is None
    assert "record" in second.reply.text


def test_what_is_asked_after_a_doubt_of_a_refusal_is_understood_as_before_it() -> None:
    doubted, plain = Talk(), Talk()
    for talk in (doubted, plain):
        talk.say("Why did you turn left?")
    doubted.say("Are you sure?")
    assert asked(doubted.say("tell me more")) == asked(plain.say("tell me more"))


def test_a_doubt_of_something_else_is_no_doubt_of_the_refusal() -> None:
    talk = Talk()
    talk.say("Why did you turn left?")
    turn = talk.say("Are you sure that vehicle 1 will turn right?")
    assert turn.query is not None
    assert turn.query.actor == "vehicle:1"
    assert "record" not in turn.reply.text


# --- Talk about the talk -------------------------------------------------------------------------


def test_what_was_just_said_is_said_again_and_leant_on() -> None:
    talk = Talk(at=12.0)
    told = talk.say("What were you doing 5 seconds ago?")
    talk.hear("thanks")
    again = talk.say("What did you just say?", at=14.0)
    assert again.reply.text == told.reply.text
    assert again.reply.sim_time == 14.0
    assert (again.query, again.focus) == (told.query, told.focus)
    assert talk.say("Why?").focus == told.focus


def test_choices_that_are_said_again_can_be_picked() -> None:
    talk = Talk("motorway-0", at=20.0)
    talk.say(TRUCK)
    again = talk.say("What did you say?")
    assert len(again.reply.choices) == 2
    assert asked(talk.say("2"))[1] == "vehicle:3"


def test_before_anything_was_said_there_is_nothing_to_say_again() -> None:
    for text in ("What did you just say?", "What did I ask before?"):
        talk = Talk()
        turn = talk.say(text)
        assert turn.reply.explanation is None
        assert "yet" in turn.reply.text


def test_what_was_asked_before_is_known() -> None:
    talk = Talk()
    talk.hear("What is vehicle 2 doing?", "thanks")
    assert "What is vehicle 2 doing?" in talk.say("What did I ask before?").reply.text
    talk.say("Where is vehicle 1 going?")
    assert "Where is vehicle 1 going?" in talk.say("What did I ask before?").reply.text


@pytest.mark.parametrize(("text", "event"), [("Thanks!", "thanks"), ("bye", "farewell")])
def test_small_talk_is_answered_and_changes_no_subject(text: str, event: str) -> None:
    talk = Talk()
    talk.say("What is vehicle 1 doing?")
    turn = talk.say(text)
    assert turn.query is not None
    assert (turn.query.type, turn.query.event) == ("smalltalk", event)
    assert asked(talk.say("And where is it going?"))[:2] == ("where_goal", "vehicle:1")


@pytest.mark.parametrize("text", ["no", "dunno"])
def test_a_bare_no_is_all_right(text: str) -> None:
    talk = Talk()
    talk.say("What is vehicle 1 doing?")
    assert talk.say(text).reply.text.startswith("All right")
    assert asked(talk.say("And where is it going?"))[:2] == ("where_goal", "vehicle:1")


@pytest.mark.parametrize("texts", [("What happened just now?", "Why?"), ("Why did you do that?",)])
def test_a_follow_up_on_what_was_answered_without_its_name_means_that_deed(
    texts: tuple[str, ...],
) -> None:
    talk = Talk(at=6.0)
    talk.hear(*texts)
    turn = talk.say("What if you hadn't done that?")
    assert turn.query is not None
    assert turn.query.counterfactual == ("change-left",)


def test_before_that_is_before_what_was_told() -> None:
    talk = Talk(at=15.0)
    talk.say("What were you doing at 0:10?")
    first = talk.say("And before that?").reply.explanation
    second = talk.say("And before that?").reply.explanation
    assert first is not None
    assert second is not None
    assert first.then is not None
    assert second.then is not None
    assert 10.0 > first.then > second.then


@pytest.mark.parametrize("text", ["Why?", "Are you sure?"])
def test_what_asks_nothing_new_has_the_choices_offered_again(text: str) -> None:
    talk = Talk("motorway-0", at=20.0)
    offered = talk.say(TRUCK)
    assert talk.say(text).choices == offered.choices


def test_no_suggestion_is_made_twice_in_a_row() -> None:
    talk = Talk(at=15.0)
    said = [talk.say("Why did you stop?").reply for _ in range(3)]
    made = [tuple(s for s in one.suggestions if s in one.text) for one in said]
    assert made[0]
    assert len({*made}) == len(made)
