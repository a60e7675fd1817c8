"""Questions for an opinion of our own driving, and for what our screen shows."""

import pytest

from tests.dialogue.talking import Talk

TURNED = 35.0  # [s] in the ride `junction-0`, when we have turned


@pytest.mark.parametrize(
    "text",
    [
        "How would you rate your braking there?",
        "rate your braking",
        "How would you mark your own braking?",
        "how was that braking",
        "Did you brake well?",
        "was that good braking?",
        "How did you feel about that braking?",
    ],
)
def test_tells_how_hard_the_braking_was(text: str) -> None:
    reply = Talk("junction-0", TURNED).hear(text)
    assert reply.startswith("That was comfortable: the hardest braking in it was 1.9 m/s²")


@pytest.mark.parametrize(
    "text",
    ["Was that a good turn?", "How would you grade that turn?", "how was the turn for you"],
)
def test_tells_how_comfortable_the_turn_was(text: str) -> None:
    assert Talk("junction-0", TURNED).hear(text).startswith("That was comfortable")


@pytest.mark.parametrize(
    "text", ["did you drive well?", "How do you rate your own driving?", "rate your driving"]
)
def test_tells_how_comfortable_the_ride_was(text: str) -> None:
    assert Talk("junction-0", TURNED).hear(text).startswith("The ride was comfortable")


@pytest.mark.parametrize(
    "text", ["How would you rate your braking there?", "was that good braking?"]
)
def test_says_that_what_is_to_be_rated_did_not_happen(text: str) -> None:
    assert Talk("s1-0", 7.0).hear(text).startswith("I did not brake")


@pytest.mark.parametrize(
    "text",
    [
        "What is your screen showing?",
        "what do your sensors show",
        "What's on your display?",
        "what is the radar showing",
    ],
)
def test_tells_what_the_screen_shows(text: str) -> None:
    assert Talk("s1-0", 7.0).hear(text).startswith("I can see two vehicles")


@pytest.mark.parametrize(
    "text", ["how did you frobnicate the lane?", "How did you manage the grumbling?"]
)
def test_tells_the_decision_only_if_it_is_asked_for(text: str) -> None:
    assert Talk("s1-0", 7.0).say(text).reply.kind == "refusal"
