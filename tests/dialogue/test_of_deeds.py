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


@pytest.mark.parametrize(
    "text",
    [
        "was that legal?",
        "You turned right in front of the blue lorry.",
        "you pulled out in front of the lorry!",
        "the lorry had priority and you just went",
        "you went before the lorry",
        "were you allowed to turn before the lorry?",
    ],
)
@pytest.mark.parametrize("at", [17.0, 24.0])
def test_going_before_one_that_stood_is_owned_up_to_with_the_rule(text: str, at: float) -> None:
    """The lorry has right of way and stands; we come into the junction at 15 s."""
    talk = Talk("s4-0", at)
    talk.say("why did you turn in front of the lorry?")
    reply = talk.say(text).reply.text
    assert "had right of way" in reply
    assert "standing" in reply
    assert not reply.startswith(("No", "Actually"))


def test_whether_a_deed_was_lawful_is_answered_without_a_verdict() -> None:
    reply = Talk("bend-0", 12.0).say("was it legal to turn there?").reply.text
    assert "had right of way" in reply
    assert not reply.startswith("No")


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("You slowed from 27 to 10 before the junction, why so much?", "the blue lorry"),
        ("You slowed from 27 to 10. Was all of that needed?", "the blue lorry"),
        ("when did we go from 40 down to 23?", "0:10"),
        ("why did you slow from 20 to 0?", "the black car"),
    ],
)
def test_speeds_that_are_said_tell_which_braking_is_meant(text: str, told: str) -> None:
    """We braked for the junction at 10 s and at 14 s, and behind the queue at 19 s."""
    assert told in Talk("s4-0", 30.0).say(text).reply.text


def test_from_which_speed_is_asked_of_the_braking_just_told() -> None:
    talk = Talk("s4-0", 24.0)
    talk.say("why did you brake?")
    assert "20 km/h" in talk.say("from what speed?").reply.text


@pytest.mark.parametrize(
    "between", ["how much time did we win by that?", "was it worth it?", "when was that?"]
)
def test_without_somebody_is_asked_of_the_deed_spoken_of(between: str) -> None:
    talk = Talk("s1-0", 12.0)
    talk.say("why did you change lanes?")
    talk.say(between)
    reply = talk.say("what if he hadn't been there?").reply.text
    assert "would have stayed in my lane" in reply


@pytest.mark.parametrize("text", ["what if you'd gone ahead of the black car?",
                                  "what if we had gone in front of the black car?"])  # fmt: skip
def test_going_ahead_of_one_in_another_lane_is_changing_to_it(text: str) -> None:
    reply = Talk("motorway-0", 20.0).say(text).reply.text
    assert "moved to the left lane" in reply


@pytest.mark.parametrize("text", ["I'd have gone past it ages ago", "why didn't you go past it?"])
def test_going_past_one_ahead_in_our_lane_is_overtaking(text: str) -> None:
    talk = Talk("motorway-0", 14.0)
    talk.say("what is the lorry ahead doing?")
    assert "left lane" in talk.say(text).reply.text


def test_the_evidence_that_somebody_turns_is_of_the_way_that_is_expected() -> None:
    reply = Talk("s1-0", 5.0).say("what makes you think the blue car will turn?").reply.text
    assert "turn right" in reply


def test_a_past_belief_out_of_the_blue_is_that_of_what_we_last_set_about() -> None:
    """We began to change lanes at 3 s; the blue car came over to our lane before."""
    reply = Talk("s1-0", 9.0).say("what did you think the blue car would do?").reply.text
    assert "6 seconds ago" in reply


@pytest.mark.parametrize("question", ["What if you hadn't stopped?", "What if we hadn't stopped?"])
@pytest.mark.parametrize(
    ("name", "at", "whom"), [("junction-0", 28.0, "bicycle"), ("city-0", 32.0, "pedestrian")]
)
def test_a_stop_is_the_slowing_to_walking_pace_that_goes_on(
    name: str, at: float, whom: str, question: str
) -> None:
    told = Talk(name, at).hear(question)
    assert whom in told, told
    assert "light" not in told
    assert "red light" in Talk(name, at - 4.0).hear(question)  # we had stood at it before
