"""What is said once we are there, of who has passed us, and of what was asked before."""

import pytest

from tests.dialogue.talking import Talk, ride

OVER = ride("s1-0").ended or 0.0  # [s]


@pytest.mark.parametrize(
    ("text", "reply"),
    [
        ("How fast are you going?", "We have arrived at our destination."),
        ("What are you doing?", "We have arrived at our destination."),
        ("Are you there yet?", "We arrived at our destination at "),
        ("Where were we at the start?", "At 0:00, we were on our way to our destination."),
    ],
)
def test_who_is_there_drives_no_longer(text: str, reply: str) -> None:
    assert Talk("s1-0", OVER).say(text).reply.text.startswith(reply)


@pytest.mark.parametrize("text", ["Are you there yet?", "are we there soon", "Are we there yet?"])
def test_on_the_way_it_is_told_how_long_it_takes(text: str) -> None:
    assert Talk("s1-0").say(text).reply.text.startswith("We should be there in about ")


def test_the_same_may_be_asked_twice_of_one_vehicle() -> None:
    talk = Talk("s1-0")
    first = talk.say("What is vehicle 1 doing?").reply
    again = talk.say("What is it doing?").reply
    assert first.explanation is not None
    assert again.explanation == first.explanation


@pytest.mark.parametrize(
    ("before", "about"), [("Why did you change left?", 0), ("What is vehicle 1 doing?", 1)]
)
def test_how_fast_is_no_more_of_a_why(before: str, about: int) -> None:
    talk = Talk("s1-0")
    talk.say(before)
    found = talk.say("and how fast?").reply.explanation
    assert found is not None
    assert found.sight is not None
    assert (found.sight.about, found.sight.vehicle) == ("speed", about)


def test_the_first_question_is_not_the_last() -> None:
    talk = Talk("s1-0")
    assert talk.say("What did I ask first?").reply.text.startswith("You have not asked me")
    talk.say("Where are we going?")
    talk.say("What is vehicle 1 doing?")
    assert talk.say("What did I ask first?").reply.text == "You first asked: Where are we going?"
    assert "vehicle 1" in talk.say("What was my last question?").reply.text


def test_slowing_for_a_turn_is_nobodys_doing_at_that_time() -> None:
    said = Talk("s4-0", 14.0).say("Why did you stop?").reply
    assert said.text.endswith("I slowed down for the turn: no other vehicle was in my way then.")


@pytest.mark.parametrize(
    "text", ["Why did you enter the roundabout?", "why did you join the circle"]
)
def test_to_enter_a_roundabout_is_to_go_round_it(text: str) -> None:
    said = Talk("s3-0", 7.0).say(text).reply
    assert said.explanation is not None
    assert said.explanation.factual[:1] == ("continue-next-exit",)
