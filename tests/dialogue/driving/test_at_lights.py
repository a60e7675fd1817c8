"""Questions at a red light: whose turn it is, how long, and on what basis we went."""

import pytest

from tests.dialogue.talking import Talk
from xavi_dialogue.nlu.notation import acts_line
from xavi_dialogue.nlu.parse import Parser

ROLLING, RED, THROUGH = 9.0, 20.0, 34.0  # [s] in the ride `junction-0`


def read(text: str) -> str:
    return acts_line(Parser().read(text)[0].acts)


@pytest.mark.parametrize("text", ["why are we slowing, it's green!", "it is green, why brake?"])
def test_green_is_the_light_and_not_a_green_vehicle_behind_us(text: str) -> None:
    talk = Talk("junction-0", 6.0)
    assert "green bicycle" in talk.hear("how close was the bike?")
    talk.at = ROLLING
    turn = talk.say(text)
    assert "bicycle" not in turn.reply.text
    talk.hear("who has priority, them or us?")
    assert "do not cross" not in talk.hear("who has priority, them or us?")


@pytest.mark.parametrize("text", ["how long now?", "how long now", "how much longer?"])
def test_how_long_now_is_how_long_it_goes_on(text: str) -> None:
    assert read(text).startswith("Ask(HowMuch(Measured(duration, Pronoun(this), tense=future)))")


@pytest.mark.parametrize(
    "text",
    ["On what basis did you proceed?", "on what grounds did you go", "On what basis did you turn?"],
)
def test_the_basis_of_a_deed_is_its_reason(text: str) -> None:
    assert read(text).startswith("Ask(Why(Happens(")


@pytest.mark.parametrize(
    "text", ["could we squeeze through before they cross", "can we go before he comes?"]
)
def test_going_before_others_is_asked_and_not_requested(text: str) -> None:
    assert read(text).startswith("Ask(Whether(")


@pytest.mark.parametrize(
    "text", ["how hard was the last stop?", "how hard did you brake for the stop"]
)
def test_a_stop_is_as_hard_as_the_braking_before_it(text: str) -> None:
    assert "not braking" not in Talk("junction-0", RED).hear(text)


def test_oncoming_cars_after_room_beside_us_are_listed() -> None:
    reply = Talk("junction-0", RED).hear("is there room on the left?", "what about oncoming cars?")
    assert not reply.startswith(("Yes", "No,"))


@pytest.mark.parametrize("text", ["what comes next", "and what comes next?"])
def test_what_comes_next_is_what_we_do(text: str) -> None:
    assert read(text).endswith("Ask(Doing(time=Next, tense=future))")


@pytest.mark.parametrize("text", ["where did we lose time?", "where did we lose the most time"])
def test_where_time_was_lost_is_its_worst_moment(text: str) -> None:
    assert "Peak(delay" in read(text)


@pytest.mark.parametrize("text", ["what would have been quicker", "what would have been faster?"])
def test_what_would_have_been_quicker_is_of_the_options(text: str) -> None:
    assert read(text) == "Ask(Listing(options))"


@pytest.mark.parametrize("text", ["is it green", "Is it red now?", "is it green yet"])
@pytest.mark.parametrize(("name", "at"), [("s1-0", 5.0), ("motorway-0", 10.0)])
def test_where_nobody_was_spoken_of_it_is_a_light(name: str, at: float, text: str) -> None:
    assert Talk(name, at).hear(text) == "I see no traffic light on our way."


def test_a_vehicle_that_was_spoken_of_has_its_own_colour() -> None:
    assert "blue" in Talk("s1-0", 8.0).hear("who is ahead of us", "is it red")


@pytest.mark.parametrize(
    "text",
    [
        "would we be faster if it had been green",
        "Would we have been faster if the light had been green?",
        "would we have arrived earlier if the light had been green",
    ],
)
@pytest.mark.parametrize(("name", "at"), [("junction-0", 30.0), ("city-0", 45.0)])
def test_how_much_faster_a_green_light_had_made_us_is_said(name: str, at: float, text: str) -> None:
    told = Talk(name, at).hear(text)
    assert told.startswith("Yes, by about 1")
    assert "we would have passed the light" in told


@pytest.mark.parametrize(
    "text",
    [
        "When did you first see the light?",
        "when did you see the traffic light",
        "when could you see the light",
    ],
)
def test_when_we_saw_a_light_first_is_when_it_came_into_view(text: str) -> None:
    reply = Talk("junction-0", RED).hear(text)
    assert "it was red already when it came into my view" in reply


@pytest.mark.parametrize(
    "text", ["did you stop after it turned green?", "Did we stop after the light turned green?"]
)
def test_a_wait_that_ends_with_the_red_light_is_not_after_it(text: str) -> None:
    assert Talk("junction-0", 29.0).hear(text).startswith("No, I did not stop")


@pytest.mark.parametrize("text", ["can we go now", "could we just go?"])
def test_rolling_slowly_up_to_a_red_light_is_not_going(text: str) -> None:
    assert Talk("city-0", 14.0).hear(text).startswith("Not yet: the traffic light")


@pytest.mark.parametrize(
    "text",
    ["what happens if you just drive on?", "what would happen if we went now", "what if we go?"],
)
def test_what_comes_of_going_at_red_is_whom_we_would_meet(text: str) -> None:
    told = Talk("junction-0", 22.0).hear(text)
    assert told.startswith("That would be against a red light. We would be across")


def test_whoever_is_met_at_red_nothing_is_no_answer() -> None:
    told = Talk("city-0", 14.0).hear("what happens if you just drive on?")
    assert told == "That would be against a red light. As far as I know, nobody is in our way."


@pytest.mark.parametrize(
    "text", ["would you be braking if it were green now?", "would you brake if the light was green"]
)
def test_of_a_light_that_is_green_it_is_told_who_holds_us_all_the_same(text: str) -> None:
    told = Talk("city-0", 28.0).hear(text)
    assert told.startswith("Yes, the traffic light is green already, but I have to let the three")


def test_a_light_that_we_have_passed_makes_us_wait_no_more() -> None:
    told = Talk("city-0", 28.0).hear("would you brake if the light was red now")
    assert told.startswith("We passed the traffic light")


@pytest.mark.parametrize(
    "text", ["why did you slow down so early?", "why did we slow down at first"]
)
def test_slowing_so_early_is_explained_by_how_it_began(text: str) -> None:
    assert Talk("city-0", 15.0).hear(text).endswith("the bend in the road at a safe speed.")


@pytest.mark.parametrize(
    ("text", "asked"),
    [
        ("do you know when it changes?", "Ask(When(Happens(Event(turn-colour, Pronoun(it)"),
        ("do you know when we arrive", "Ask(When(Happens(Event(arrive"),
        ("what would happen if we went now", "Ask(WhatIf(Happens(Event(go, tense=present))"),
    ],
)
def test_when_is_asked_and_now_is_now(text: str, asked: str) -> None:
    assert read(text).startswith(asked)


@pytest.mark.parametrize(
    "text",
    ["do the other cars have green?", "is the other side green", "who has green now?",
     "does anybody else have green?"],
)  # fmt: skip
def test_whether_others_have_green_is_told_of_the_lights_in_view(text: str) -> None:
    told = Talk("city-0", 14.0).hear(text)
    assert told.startswith("Some of the other lights at this junction are green")
    assert told.endswith("the one on our way is red.")


def test_nobody_has_green_while_all_lights_in_view_are_red() -> None:
    told = Talk("junction-0", 25.0).hear("does anybody else have green?")
    assert told.startswith("I see no other light at this junction that is green")


@pytest.mark.parametrize("text", ["why are you stopping on green", "why brake at a green light?"])
def test_what_we_do_on_green_is_not_for_the_light(text: str) -> None:
    assert "have to let the pedestrian" in Talk("city-0", 31.0).hear(text)


def test_the_light_when_we_went_is_the_one_that_we_passed() -> None:
    told = Talk("city-0", 45.0).hear("what colour was the light when we went?")
    assert told.startswith("The traffic light was green")


def test_several_were_first_seen_when_one_of_them_was() -> None:
    told = Talk("city-0", 45.0).hear("when did you first see the people?")
    assert told.startswith("I saw the pedestrian")
    assert "at 0:01" in told


@pytest.mark.parametrize(
    "text", ["did we go over the line at red", "did we cross the line on red?"]
)
def test_a_line_crossed_at_red_is_its_light(text: str) -> None:
    told = Talk("junction-0", 31.0).hear(text)
    assert told.startswith("No, the light was green when we passed its line")


def test_being_at_red_is_waiting_there() -> None:
    told = Talk("junction-0", 22.0).hear("how long have we been at red?")
    assert told.startswith("I have been waiting for the traffic light")
