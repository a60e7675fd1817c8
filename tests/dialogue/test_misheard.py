"""Answers to questions that were taken for others, or that answers to others contradicted."""

import pytest

from tests.dialogue.talking import Talk

SLOWED = "I did not stop. I slowed down at 0:28."


@pytest.mark.parametrize(
    "text", ["Did you stop?", "When did you stop?", "What if you hadn't stopped?"]
)
def test_whether_we_stopped_has_one_answer(text: str) -> None:
    talk = Talk("town-0", at=35.0)
    assert talk.say("Why did you stop?").reply.text.startswith("I did not stop, but I slowed down")
    assert talk.say(text).reply.text.startswith(SLOWED)


@pytest.mark.parametrize(
    ("text", "answer"),
    [
        ("Did we crash?", "We have not collided with anybody."),
        ("Was it close?", "We have not collided with anybody."),
        ("How likely is a collision?", "I do not expect that: in my simulations, the chance of a"),
        ("Will we crash?", "I do not expect that: in my simulations, the chance of a collision"),
    ],
)
@pytest.mark.parametrize("before", ["Why did you change lanes?", "Where is vehicle 1 going?"])
def test_collisions_are_told_of(before: str, text: str, answer: str) -> None:
    talk = Talk()
    talk.say(before)
    assert talk.say(text).reply.text.startswith(answer)


def test_how_we_decide_is_no_question_of_what_we_knew() -> None:
    talk = Talk()
    talk.say("Why did you change lanes?")
    decided = talk.say("How did you decide?")
    assert decided.query is not None
    assert (decided.query.type, decided.query.actor) == ("how", "ego")
    assert decided.reply.text.startswith("I simulated")
    known = Talk()
    known.say("Why did you change lanes?")
    asked = known.say("How did you know?").query
    assert asked is not None
    assert (asked.type, asked.actor) == ("how", "vehicle:1")


def test_our_mind_is_ours_whoever_was_spoken_of() -> None:
    talk = Talk()
    talk.say("Where is vehicle 1 going?")
    assert talk.say("What changed your mind?").reply.text.startswith("What mattered most is")


def test_what_else_if_we_had_decided_otherwise() -> None:
    talk = Talk()
    talk.say("Why did you change lanes?")
    assert talk.say("What if you had decided otherwise?").reply.text.startswith("Had I stayed in")
