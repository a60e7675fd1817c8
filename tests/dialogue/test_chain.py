"""Rows of whys, "how do you know?" and "which car?", on recorded rides."""

import pytest

from tests.dialogue.talking import Talk
from xavi_dialogue.dialogue.chain import meant_vehicle
from xavi_dialogue.dialogue.memory import remember
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.turn import Turn
from xavi_dialogue.explain.query import Query

CHANGED = "Why did you change lanes?"
DECIDED = 3.0  # [s] when s1's lane change was decided


def down(talk: Talk, *, steps: int = 3) -> list[Turn]:
    return [talk.say("Why?") for _ in range(steps)]


def assert_is_motive(turn: Turn, vehicle: int) -> None:
    assert turn.query is not None
    assert (turn.query.type, turn.query.actor) == ("why", f"vehicle:{vehicle}")
    assert turn.reply.kind == "answer"


def assert_is_evidence(turn: Turn, vehicle: int) -> None:
    assert turn.query is not None
    assert (turn.query.type, turn.query.actor) == ("how", f"vehicle:{vehicle}")
    assert turn.reply.explanation is not None
    assert turn.reply.explanation.grounds is not None


def assert_is_end(turn: Turn) -> None:
    assert (turn.reply.kind, turn.reply.reason) == ("refusal", "out-of-scope")
    wordings = ("as far down", "Beneath that", "nothing beneath")
    assert any(words in turn.reply.text for words in wordings)


@pytest.mark.parametrize(
    "question",
    [
        CHANGED,
        "Why didn't you stay in your lane?",
        "Why did you change left instead of going straight?",
        "What if you had stayed in your lane?",
    ],
)
def test_a_row_of_whys_goes_down_a_level_each(question: str) -> None:
    talk = Talk()
    first = talk.say(question)
    assert first.reply.explanation is not None
    assert first.reply.explanation.causes[0].vehicle == 1
    motive, evidence, end = down(talk)
    assert_is_motive(motive, 1)
    assert_is_evidence(evidence, 1)
    assert_is_end(end)
    assert len({turn.reply.text for turn in (first, motive, evidence, end)}) == 4


def test_what_lies_beneath_is_told_as_it_was_when_it_was_decided() -> None:
    """The car is past vehicle 1 by 0:12, and sure by then of where it goes."""
    talk = Talk(at=12.0)
    talk.say(CHANGED)
    motive, evidence, _ = down(talk)
    for turn in (motive, evidence):
        assert turn.focus is not None
        assert turn.focus.moment == pytest.approx(DECIDED, abs=0.6)
        assert "90 %" in turn.reply.text
    now = talk.say("How sure are you that vehicle 1 will turn right?")
    assert "90 %" not in now.reply.text


def test_at_the_bottom_it_is_still_the_same_moment_that_is_spoken_of() -> None:
    talk = Talk(at=12.0)
    talk.say(CHANGED)
    _, evidence, end = down(talk)
    assert end.focus == evidence.focus
    known = talk.say("How do you know?")
    assert known.focus == evidence.focus
    assert known.reply.explanation == evidence.reply.explanation


def test_the_bottom_is_the_bottom() -> None:
    talk = Talk()
    talk.say(CHANGED)
    for turn in down(talk, steps=5)[2:]:
        assert_is_end(turn)


def test_who_doubts_and_then_asks_why_is_told_the_reasons_of_what_was_doubted() -> None:
    talk = Talk()
    talk.say(CHANGED)
    doubted = talk.say("Are you sure?")
    assert doubted.query is not None
    assert (doubted.query.type, doubted.query.actor) == ("confidence", "ego")
    motive, evidence, end = down(talk)
    assert_is_motive(motive, 1)
    assert_is_evidence(evidence, 1)
    assert_is_end(end)


def test_who_doubts_twice_is_told_the_same_reasons() -> None:
    talk = Talk()
    talk.hear(CHANGED, "Are you sure?", "Really?")
    assert_is_motive(talk.say("Why?"), 1)


def test_why_after_a_doubt_of_a_prediction_asks_for_its_evidence() -> None:
    talk = Talk()
    talk.hear("Where is vehicle 1 going?", "Are you sure?")
    assert_is_evidence(talk.say("Why?"), 1)
    assert_is_end(talk.say("Why?"))


def test_why_after_a_supposed_absence_asks_for_the_decision_first() -> None:
    talk = Talk()
    talk.say("What would you have done without vehicle 1?")
    decision = talk.say("Why?")
    assert decision.query is not None
    assert (decision.query.actor, decision.query.factual) == ("ego", ("change-left",))
    assert decision.reply.explanation is not None
    assert decision.reply.explanation.causes[0].vehicle == 1
    motive, evidence, end = down(talk)
    assert_is_motive(motive, 1)
    assert_is_evidence(evidence, 1)
    assert_is_end(end)


def test_where_no_vehicle_is_behind_it_all_is_told_once_and_then_it_ends() -> None:
    talk = Talk("s3-0")
    first = talk.say("Why did you turn right?")
    assert first.reply.explanation is not None
    assert all(cause.vehicle == 0 for cause in first.reply.explanation.causes)
    fuller, end = down(talk, steps=2)
    assert fuller.reply.explanation == first.reply.explanation
    assert len(fuller.reply.text) > len(first.reply.text)
    assert_is_end(end)


def test_what_was_told_in_full_is_not_told_again() -> None:
    talk = Talk("s3-0")
    talk.hear("Why did you turn right?", "Tell me more.")
    assert_is_end(talk.say("Why?"))


def test_why_after_a_wrong_premise_asks_for_what_was_done_instead() -> None:
    talk = Talk()
    refused = talk.say("Why did you turn left?")
    assert refused.reply.reason == "did-not-happen"
    instead, motive = down(talk, steps=2)
    assert instead.query is not None
    assert instead.query.factual == ("change-left",)
    told = Talk().say("Why did you move to the left lane?")
    assert instead.reply.explanation == told.reply.explanation
    assert_is_motive(motive, 1)


def test_why_after_a_wrong_premise_about_now_asks_for_what_is_done_now() -> None:
    talk = Talk()
    assert talk.say("Why are you slowing down?").reply.reason == "did-not-happen"
    instead = talk.say("Why?")
    assert instead.query is not None
    assert (instead.query.actor, instead.query.tense) == ("ego", "present")
    assert instead.reply.explanation is not None
    assert "slow-down" not in instead.reply.explanation.factual


@pytest.mark.parametrize("why", ["Why?", "Why not?"])
def test_there_is_no_reason_beneath_what_cannot_be_done(why: str) -> None:
    talk = Talk()
    talk.say(CHANGED)
    assert talk.say("Could you have gone faster?").reply.reason == "not-applicable"
    assert_is_end(talk.say(why))


def test_why_after_what_is_beyond_us_is_not_about_what_was_said_before() -> None:
    talk = Talk()
    talk.say(CHANGED)
    assert talk.say("What is the weather like?").reply.reason == "out-of-scope"
    assert_is_end(talk.say("Why?"))
    again = talk.say(CHANGED)
    assert again.reply.kind == "answer"


def test_why_after_what_was_done_asks_why_that_was_done() -> None:
    talk = Talk(at=12.0)
    told = talk.say("What were you doing 5 seconds ago?")
    assert told.reply.explanation is not None
    assert told.reply.explanation.activity is not None
    assert told.reply.explanation.activity.actions == ("continue",)
    why = talk.say("Why?")
    assert why.query is not None
    assert why.query.factual == ("continue",)
    assert why.focus == told.focus
    assert why.reply.explanation is not None
    assert why.reply.explanation.factual == ("continue",)


def test_why_after_what_another_does_goes_down_a_level_each() -> None:
    talk = Talk()
    told = talk.say("What is vehicle 1 doing?")
    motive, evidence, end = down(talk)
    assert_is_motive(motive, 1)
    assert motive.reply.text != told.reply.text
    assert_is_evidence(evidence, 1)
    assert_is_end(end)


def test_why_after_what_another_is_going_to_do_asks_for_the_evidence() -> None:
    talk = Talk()
    told = talk.say("Where is vehicle 1 going?")
    assert told.reply.explanation is not None
    assert told.reply.explanation.destination is not None
    evidence, end = down(talk, steps=2)
    assert_is_evidence(evidence, 1)
    assert evidence.query is not None
    assert evidence.query.factual == (told.reply.explanation.destination.kind,)
    assert_is_end(end)


def test_why_after_what_another_does_that_we_cannot_tell_is_no_end_yet() -> None:
    talk = Talk("bend-0", at=8.0)
    talk.say("What is vehicle 2 doing?")
    assert talk.say("Why?").reply.kind == "answer"


def test_why_is_no_wish_to_hear_more_from_now_on() -> None:
    talk = Talk()
    talk.say(CHANGED)
    down(talk)
    talk.say("Why?")
    assert remember(talk.session.turns, talk.dialogue.ride_id).detail is None


@pytest.mark.parametrize("question", [CHANGED, "Why didn't you stay in your lane?"])
def test_how_do_you_know_asks_how_the_vehicle_that_is_blamed_was_seen_through(
    question: str,
) -> None:
    talk = Talk()
    talk.say(question)
    known = talk.say("How do you know?")
    assert_is_evidence(known, 1)
    assert known.focus is not None
    assert known.focus.moment == pytest.approx(DECIDED, abs=0.6)
    assert known.query is not None
    assert known.query.factual == ("exit-right",)


def test_how_do_you_know_after_what_blames_nobody_asks_how_we_decided() -> None:
    talk = Talk("s3-0")
    talk.say("Why did you turn right?")
    known = talk.say("How do you know?")
    assert known.query is not None
    assert (known.query.type, known.query.actor) == ("how", "ego")


def test_which_car_is_the_one_that_was_named_first_and_where_it_is() -> None:
    talk = Talk()
    assert "(vehicle 1)" in talk.hear(CHANGED)
    assert "vehicle 1" in talk.hear("Why?")
    which = talk.say("Which car?")
    assert which.query is not None
    assert (which.query.actor, which.query.tense) == ("vehicle:1", "present")
    assert "the car ahead on the right (vehicle 1)" in which.reply.text.lower()


def test_which_car_looks_further_back_where_the_last_answer_named_none() -> None:
    talk = Talk()
    talk.hear("What is vehicle 2 doing?", "What are you doing?")
    which = talk.say("Which car?")
    assert which.query is not None
    assert which.query.actor == "vehicle:2"
    assert "(vehicle 2)" in which.reply.text


def test_of_several_that_were_named_the_first_is_meant() -> None:
    talk = Talk("s2-0")
    told = talk.say("Why did vehicle 1 stop?")
    assert set(told.mentioned) == {1, 2}
    which = talk.say("Which car?")
    assert which.query is not None
    assert which.query.actor == f"vehicle:{told.mentioned[0]}"


def test_what_was_named_last_is_not_what_was_named_first() -> None:
    reply = Reply(text="so", kind="answer", sim_time=6.0)
    named = Turn(text="so?", query=Query(type="why"), reply=reply, mentioned=(4, 7))
    later = Turn(text="so?", query=Query(type="why"), reply=reply)
    meant = meant_vehicle(
        Query(type="what", actor="vehicle:unknown"), remember([named, later], None)
    )
    assert meant is not None
    assert meant.actor == "vehicle:4"


@pytest.mark.parametrize("text", ["Why?", "Why not?", "Which car?"])
def test_out_of_the_blue_it_is_asked_what_is_meant(text: str) -> None:
    turn = Talk().say(text)
    assert (turn.reply.kind, turn.reply.reason) == ("clarification", "ambiguous")
    assert turn.mentioned == ()


def test_how_do_you_know_out_of_the_blue_lays_it_to_nobody() -> None:
    turn = Talk().say("How do you know?")
    assert turn.mentioned == ()
    assert turn.query is None or turn.query.actor == "ego"


def test_after_small_talk_alone_there_is_nothing_to_go_deeper_into() -> None:
    talk = Talk()
    talk.say("Hello!")
    assert talk.say("Why?").reply.reason == "ambiguous"


def test_small_talk_in_between_does_not_end_the_row() -> None:
    talk = Talk()
    talk.hear(CHANGED, "Thanks.")
    assert_is_motive(talk.say("Why?"), 1)
