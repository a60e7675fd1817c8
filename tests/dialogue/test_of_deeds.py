"""What was believed and done at the time of a deed, when it is asked about later."""

import pytest

from tests.dialogue.talking import Talk


@pytest.mark.parametrize(
    "text",
    [
        "what did you think the blue car was going to do?",
        "what did you expect it to do?",
        "what did you reckon he'd do when you changed lanes?",
    ],
)
def test_a_past_belief_is_that_of_the_deed_spoken_of(text: str) -> None:
    """The decision for the left lane was taken at 3 s."""
    talk = Talk("s1-0", 9.0)
    talk.say("why did you change lanes?")
    reply = talk.say(text).reply.text
    assert "seconds ago" in reply
    assert "turn right" in reply


def test_what_is_believed_now_is_told_of_now() -> None:
    talk = Talk("s1-0", 9.0)
    talk.say("why did you change lanes?")
    assert "ago" not in talk.say("how sure are you that it turns?").reply.text


@pytest.mark.parametrize("text", ["why tho", "but why", "why?", "how come?"])
def test_why_before_anything_was_said_is_of_what_we_do(text: str) -> None:
    assert "because" in Talk("s1-0", 5.0).say(text).reply.text
