"""What passengers hear: the car says that it does not, and who is at the place that is named."""

import pytest

from tests.dialogue.talking import Talk

DEAF = "I cannot tell you anything about sounds"


@pytest.mark.parametrize(
    "text",
    [
        "somebody is honking",
        "who is honking at us?",
        "did someone just beep at us?",
        "I heard a horn, was that for us?",
        "someone's beeping their horn",
        "I heard a noise. What was that?",
        "where is that noise coming from?",
        "was there a bang just now?",
        "is there any honking?",
    ],
)
def test_the_car_hears_nothing(text: str) -> None:
    reply = Talk("junction-0", 28.0).say(text).reply.text
    assert reply.startswith(DEAF)
    assert "because" not in reply


@pytest.mark.parametrize(
    "text",
    [
        "I hear brakes squealing behind us, what is that?",
        "what's that noise behind us?",
        "that car behind us honked at us!",
        "i can hear screeching behind us whats that",
        "there is a noise to our rear",
        "somebody beeped at the back of us",
    ],
)
def test_who_is_there_is_told(text: str) -> None:
    reply = Talk("junction-0", 28.0).say(text).reply.text
    assert reply.startswith(DEAF)
    assert "behind us (vehicle 1)" in reply


@pytest.mark.parametrize(
    "text",
    [
        "I hear a siren",
        "is that a siren?",
        "there's a siren somewhere",
        "I can hear sirens",
        "was there a siren just now?",
        "do you hear the sirens?",
        "where are the sirens coming from?",
        "are there sirens behind us?",
        "I heard an ambulance",
    ],
)
def test_of_sirens_it_is_told_whether_we_see_their_vehicles(text: str) -> None:
    reply = Talk("junction-0", 28.0).say(text).reply.text
    assert reply.startswith(DEAF)
    assert "no emergency vehicle" in reply


def test_that_others_do_not_honk_is_not_stated() -> None:
    assert "not honking" not in Talk("s1-0").say("why is he honking?").reply.text
    assert "not honking" in Talk("s1-0").say("are you honking?").reply.text
