"""Questions that name a time are answered for that time; what held us is named the same way."""

import pytest

from tests.dialogue.talking import Talk


@pytest.mark.parametrize(
    ("name", "text", "reply"),
    [
        (
            "junction-0",
            "Who were you waiting for at 20 s?",
            "I waited at 0:16, because the",
        ),
        ("junction-0", "Who held you up at 20 s?", "I stopped at 0:16, because the traffic light"),
        ("s1-0", "How likely was a collision at 3 s?", "At 0:03, I put the chance that we would"),
        ("bend-0", "Did you give way to vehicle 1?", "No, the blue car"),  # it let us go first
        ("bend-0", "How hard did you brake for vehicle 1?", "We braked with up to 3.0 m/s"),
        ("junction-0", "Which light did you stop at?", "I stopped for the traffic light at 0:16"),
        ("junction-0", "When did the light turn amber?", "I have not seen it turn amber"),
        ("junction-0", "How long was the light green?", "The traffic light has been green for"),
        (
            "junction-0",
            "Did the light turn red before 20 s?",
            "I did not see the traffic light",
        ),
        ("junction-0", "How often did you give way?", "I have given way once so far, at 0:29"),
        ("s3-0", "Which predictions were wrong?", "Yes: I expected the blue car"),
        ("s1-0", "When did you last see vehicle 1?", "Yes, I can see the blue car"),
    ],
)
def test_is_answered_of_the_ride_as_it_was(name: str, text: str, reply: str) -> None:
    assert Talk(name).hear(text).startswith(reply)


def test_the_decision_of_a_time_is_another_one_than_the_last() -> None:
    asked = [f"How sure were you about the decision at {at} s?" for at in (3, 15)]
    first, later = (Talk("s1-0", 19.0).hear(text) for text in asked)
    assert first.startswith("Moving to the left lane")
    assert not later.startswith("Moving to the left lane")


def test_an_option_is_of_the_time_that_is_named() -> None:
    at, late = (
        Talk("s1-0", 15.0).hear(f"What was the risk of the option you rejected at {t} s?")
        for t in (3, 8)
    )
    assert at != late


def test_a_belief_is_asked_of_a_time_counted_from_the_one_before() -> None:
    talk = Talk("s1-0", 8.0)
    talk.hear("How likely is it that the blue car turns right?")
    three = talk.hear("How likely was that at 3 seconds?")
    assert three.startswith("About 5 seconds ago, I put the chance that the blue car would turn")
    earlier = talk.hear("What probability did you give that two seconds earlier?")
    assert earlier.startswith("About 7 seconds ago, I put the chance")


def test_what_was_asked_of_the_whole_ride_names_no_time_for_the_next_question() -> None:
    alone = Talk("s1-0", 8.0).hear("What if the blue car braked?")
    talk = Talk("s1-0", 4.0)
    talk.hear("What was the runner-up?")
    talk.at = 8.0
    assert talk.hear("What if the blue car braked?") == alone


@pytest.mark.parametrize(
    "text", ["Was the blue car close?", "was that blue car close?", "Has the blue car been close?"]
)
def test_how_close_somebody_was_is_of_the_whole_ride(text: str) -> None:
    talk = Talk("s1-0", 15.0)
    talk.hear("Why did you move over?")
    assert talk.hear(text).endswith("came no closer than 1.7 metres to us, at 0:10.")


@pytest.mark.parametrize(
    "text",
    [
        "Did we overtake the green bicycle earlier?",
        "did we pass that bicycle earlier",
        "Had you overtaken the green bicycle earlier on?",
    ],
)
def test_earlier_is_a_time_before_now_and_no_manner(text: str) -> None:
    talk = Talk("junction-0", 29.0)
    talk.hear("Why did you stop?")
    reply = talk.hear(text)
    assert reply.startswith("Yes, I overtook the green bicycle")
    assert reply.endswith("at 0:03.")
