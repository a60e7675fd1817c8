"""Follow-ups on what a light shows, time lost at it, and what those who went first cost us."""

import pytest

from tests.dialogue.talking import Talk


@pytest.mark.parametrize(
    "before", ["what does the light show?", "is the light green?", "what colour is the light?"]
)
@pytest.mark.parametrize(
    ("follow", "told"),
    [
        ("since when?", "it was red already when it came into my view"),
        ("are you sure?", "Yes, the traffic light is red"),
        ("when will that change?", "I expect it to turn green in about"),
    ],
)
def test_follow_ups_on_a_light_are_of_what_it_shows(before: str, follow: str, told: str) -> None:
    talk = Talk("junction-0", 9.0)
    assert "red" in talk.hear(before)
    assert told in talk.hear(follow)


@pytest.mark.parametrize(
    "text",
    [
        "how long did we lose at that light?",
        "how much time did we lose at the light?",
        "how much time did we waste at that light?",
        "did we lose time at the light?",
    ],
)
def test_time_lost_at_a_light_is_the_wait_there(text: str) -> None:
    assert "waited for the traffic light for 10 seconds" in Talk("junction-0", 40.0).hear(text)


@pytest.mark.parametrize(
    "text",
    [
        "would we have been faster without the people?",
        "how much time did the people cost us?",
        "did the people cost us time?",
    ],
)
def test_without_those_who_held_us_up_we_gain_what_they_cost(text: str) -> None:
    told = Talk("city-0", 42.0).hear(text)
    assert told.startswith("The six pedestrians cost us about ")
    assert "no time" not in told


def test_a_colour_alone_is_of_the_light_after_its_forecast() -> None:
    talk = Talk("junction-0", 20.0)
    assert "turn green" in talk.hear("when will the light turn green?")
    talk.hear("how do you know that?")
    assert talk.hear("still red?").startswith("Yes, the traffic light is red")


def test_the_colour_of_lights_that_were_counted_is_told() -> None:
    talk = Talk("city-0", 50.0)
    assert "one traffic light" in talk.hear("how many lights did we pass?")
    assert "green" in talk.hear("what colour were they?")


@pytest.mark.parametrize("text", ["tell me about the light", "where is the traffic light?"])
def test_a_light_that_we_passed_is_not_denied(text: str) -> None:
    told = Talk("junction-0", 60.0).hear(text)
    assert "none" not in told
    assert "0:2" in told


@pytest.mark.parametrize(
    ("text", "begins"),
    [
        ("The car entered the junction.", "Yes, that is right"),
        ("You entered the junction, didn't you?", "Yes"),
        ("You did not enter the junction.", "Actually, I am turning right"),
    ],
)
def test_who_turns_in_a_junction_has_entered_it(text: str, begins: str) -> None:
    assert Talk("city-0", 31.0).hear(text).startswith(begins)


@pytest.mark.parametrize("text", ["Are we allowed to go?", "May we go?"])
def test_once_it_is_green_we_may_go_though_we_still_stand(text: str) -> None:
    talk = Talk("city-0", 24.1)
    assert talk.hear("Is the light green?").startswith("Yes")
    assert talk.hear(text).startswith("Yes, we have right of way")


@pytest.mark.parametrize("text", ["Are we allowed to go?", "May we go?"])
def test_while_it_is_red_we_may_not_go(text: str) -> None:
    told = Talk("city-0", 22.5).hear(text)
    assert told.startswith("No, ")
    assert "red" in told
