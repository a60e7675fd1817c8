"""What is asked of a supposed world: time, delay, place, and manners that no plan has."""

import pytest

from tests.dialogue.following.asking import told

FASTER = (
    "would we be earlier if you had taken the turn faster?",
    "what if you had taken the turn faster?",
    "would it have been quicker to take the turn faster?",
    "what if you had driven more gently into that corner, how much time would that have cost?",
    "how much time would we have saved if you had taken that corner faster?",
)


@pytest.mark.parametrize("text", FASTER)
def test_another_speed_in_a_turn_was_not_simulated(text: str) -> None:
    reply = told("town-0", 30.0, text)
    assert reply.startswith("I did not simulate another speed there: I had to take the turn")
    assert "left" not in reply


@pytest.mark.parametrize(
    "text", ["what if you had braked later?", "what if you had kept a bit more to the left?"]
)
def test_what_cannot_be_simulated_is_not_taken_for_another_deed(text: str) -> None:
    assert "no way to simulate that" in told("town-0", 30.0, text)


def test_a_faster_turn_could_hardly_be() -> None:
    assert told("town-0", 30.0, "could you have taken the turn faster?").startswith("Hardly: I had")


def test_how_much_sooner_is_told_by_how_long_it_held_us() -> None:
    reply = told("junction-0", 34.0, "if the bike had waited for us, where would we be now?")
    assert "The green bicycle" in reply
    assert "cost us about" in reply


@pytest.mark.parametrize("text", ["how much time did the bike cost us?"])
def test_nobody_costs_more_time_than_they_held_us(text: str) -> None:
    reply = told("junction-0", 34.0, text)
    assert int(reply.split(" about ")[1].split()[0]) < 10


@pytest.mark.parametrize(
    "text",
    [
        "would staying in the right lane have led to a collision with the blue car?",
        "would staying in our lane have caused a crash with the blue car?",
    ],
)
def test_what_a_deed_would_have_led_to_is_supposed(text: str) -> None:
    assert told("s1-0", 12.0, text).startswith("I do not expect that: I put the risk of")


def test_if_he_stays_ahead_we_arrive_as_planned() -> None:
    text = "when do we get there if the bicycle stays in front of us the whole way?"
    assert told("junction-0", 60.0, text).startswith("We should be there in about")
