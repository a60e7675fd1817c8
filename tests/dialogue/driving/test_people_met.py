"""People whom we let go: how near they came, any of them, how long they still take."""

import pytest

from tests.dialogue.talking import Talk

WAITING, OVER = ("city-0", 34.0), ("city-0", 46.0)


@pytest.mark.parametrize(
    "text",
    [
        "how much longer will they take to cross?",
        "how long do these people need to get across?",
        "how long will it take them to cross?",
    ],
)
def test_how_long_people_take_is_how_long_we_still_wait(text: str) -> None:
    told = Talk(*WAITING).hear("who are we waiting for?", text)
    assert "drive on" in told


def test_any_of_them_is_one_of_those_spoken_of() -> None:
    talk = Talk(*OVER)
    told = talk.hear("which people did you give way to?", "did we come too close to any of them?")
    assert told.startswith("No: the pedestrian")


@pytest.mark.parametrize(
    "text",
    ["what was the longest time we stood still?", "how long was the longest bit we had to wait?"],
)
def test_the_longest_wait_is_told(text: str) -> None:
    assert Talk(*OVER).hear(text).startswith("The longest wait was at 0:33: I stopped")


def test_a_tag_that_affirms_what_we_know_gets_yes() -> None:
    told = Talk(*WAITING).hear("you do know those people are there, don't you?")
    assert told.startswith("Yes")


def test_braking_for_somebody_is_hard_only_where_it_was() -> None:
    talk = Talk(*OVER)
    assert talk.hear("did you brake for the people?").startswith("Yes")
    assert talk.hear("did you brake hard for the people?").startswith("No, I did not brake hard")


def test_how_long_we_stood_in_total_is_the_sum_of_our_stops() -> None:
    told = Talk(*OVER).hear("how long were we stopped in total?")
    assert told == "We stood still for 6 seconds in all."


def test_crossing_is_what_people_do_and_no_junction() -> None:
    told = Talk("junction-0", 20.0).hear("how many ppl are crossing in front of us?")
    assert told == Talk("junction-0", 20.0).hear("how many people are on the zebra crossing?")


def test_a_light_that_we_passed_is_said_to_be_passed() -> None:
    assert ", which we passed about" in Talk("city-0", 30.0).hear("what's the light doing?")


def test_the_colour_ahead_is_that_of_the_light() -> None:
    told = Talk("city-0", 16.0).hear("whats the colour up ahead")
    assert told.startswith("The traffic light is red")


@pytest.mark.parametrize("text", ["why are we stopped, is it red?", "why don't we go, is it red"])
def test_red_by_itself_is_the_light_that_holds_us(text: str) -> None:
    assert "because the traffic light is red" in Talk("city-0", 22.0).hear(text)
