"""Several people on foot together, those around us, and who or what holds us up."""

import pytest

from tests.dialogue.talking import Talk


@pytest.mark.parametrize(
    ("texts", "told"),
    [
        (["Who are those people right in front of the car?"], "pedestrians"),
        (["What is around us?"], "The nearest are"),
        (["I can't see. Describe what is around us."], "metres away"),
        (["Who are these people?", "Are they all going to cross?"], "crossing our way"),
        (["Why are we braking?", "Are they all crossing?"], "9) is crossing our way"),
        (["Why are we braking?", "You nearly ran them over!"], "No: the pedestrian"),
    ],
)
def test_people_are_told_of_together(texts: list[str], told: str) -> None:
    assert told in Talk("junction-0", 14.0).hear(*texts)


def test_the_nearest_of_them_is_as_far_from_us() -> None:
    told = Talk("junction-0", 14.0).hear("Who are these people?", "How far is the nearest of them?")
    assert "We are about" in told
    assert "away from the pedestrian" in told


def test_those_who_are_behind_us_are_passed() -> None:
    talk = Talk("junction-0", 14.0)
    talk.hear("Who are these people?")
    assert talk.say("Have they all crossed?", 14.5).reply.text.startswith("No, ")
    assert talk.say("Are we past them?", 33.0).reply.text.startswith("Yes, ")


@pytest.mark.parametrize(
    ("at", "text", "told"),
    [
        (20.0, "Is something holding us up, and how far off is it?", "the traffic light is red"),
        (20.0, "Is anything slowing us down?", "the traffic light is red"),
        (54.0, "Is something holding us up, and how far off is it?", "away from the blue bicycle"),
        (54.0, "What holds us up and how fast is it?", "The blue bicycle"),
    ],
)
def test_what_holds_us_up_is_it(at: float, text: str, told: str) -> None:
    assert told in Talk("junction-0", at).hear(text)


@pytest.mark.parametrize("text", ["What does it show?", "Can you see what colour it shows now?"])
def test_a_light_that_was_told_is_it(text: str) -> None:
    told = Talk("junction-0", 20.0).hear("Why are we standing?", text)
    assert "traffic light is red" in told


def test_the_light_up_there_is_no_vehicle() -> None:
    told = Talk("junction-0", 12.0).hear("Is it red up there?")
    assert told.startswith("Yes, the traffic light is red")


def test_what_is_counted_behind_people_are_they() -> None:
    talk = Talk("junction-0", 14.0)
    assert "two pedestrians" in talk.hear("Why are we braking?", "How many are there?")
    assert "pedestrian" in talk.hear("How far is the nearest one?")
    assert talk.hear("Is the last one across yet?").startswith("No, the pedestrian")
    assert "crossing our way" in talk.hear("Is everybody across?")


def test_one_of_several_people_is_the_nearest() -> None:
    told = Talk("junction-0", 12.0).hear("You didn't see the pedestrian, did you?")
    assert told.startswith("Actually, I could see the pedestrian")


def test_whom_we_spoke_of_long_ago_is_not_meant_where_others_cross() -> None:
    talk = Talk("junction-0", 12.0)
    talk.hear("You didn't see the pedestrian, did you?")
    assert "(vehicle 13)" in talk.say("Will you let him cross?", 40.0).reply.text
    assert "bicycle" in talk.say("Overtake him.", 58.0).reply.text


def test_we_stop_in_time_before_those_whom_we_let_go_first() -> None:
    told = Talk("junction-0", 12.0).hear("Are you going to stop in time?")
    assert told.startswith("Yes: ")
    assert "pedestrian" in told


@pytest.mark.parametrize(
    ("at", "text", "told"),
    [
        (19.0, "red?", "Yes, the traffic light is red"),
        (27.0, "green?", "Yes, the traffic light is green"),
        (19.0, "the light?", "The traffic light is red"),
    ],
)
def test_a_colour_alone_is_of_the_light(at: float, text: str, told: str) -> None:
    assert Talk("junction-0", at).hear("How fast are we?", text).startswith(told)


@pytest.mark.parametrize(
    "text",
    [
        "How fast will we take the turn?",
        "How slow do we get in the turn?",
        "What is our target speed for the turn?",
    ],
)
def test_our_speed_in_a_turn_to_come_is_the_planned_one(text: str) -> None:
    assert "slow down to about 15 km/h" in Talk("town-0", 20.0).hear(text)


def test_who_crossed_with_others_was_let_go_as_well() -> None:
    told = Talk("city-0", 55.0).hear("How many people did you let go first?")
    assert "six pedestrians" in told


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("Is it far to the light?", "The traffic light is about"),
        ("How far is the stop line?", "The traffic light is about"),
        ("Which light applies to us?", "The traffic light is about"),
        ("Rate of deceleration?", "We are braking with"),
        ("people?", "Yes, there is the pedestrian"),
        ("How many people are in our way?", "pedestrian"),
    ],
)
def test_what_is_before_us_is_told(text: str, told: str) -> None:
    assert told in Talk("junction-0", 10.0).hear(text)


def test_a_request_to_stop_is_told_for_whom_we_brake() -> None:
    told = Talk("junction-0", 40.0).hear("There's somebody stepping out, please stop!")
    assert "let the pedestrian" in told


def test_how_long_until_green_is_of_the_light() -> None:
    assert "turn green" in Talk("junction-0", 20.0).hear("How long until green?")
    assert "traffic light is red" in Talk("junction-0", 20.0).hear("State of the signal?")


def test_what_began_since_the_last_question_is_what_it_is_now() -> None:
    talk = Talk("junction-0", 20.0)
    talk.hear("How long will the red last?")
    assert "pedestrian" in talk.say("Oh come on, what is it now?", 41.0).reply.text


def test_nobody_in_a_colour_is_green_but_the_light() -> None:
    talk = Talk("junction-0", 27.0)
    talk.hear("What is that red car behind us doing?")
    assert "the traffic light is green" in talk.say("It's green!", 27.5).reply.text


def test_we_are_still_here_where_we_stand() -> None:
    assert "traffic light is red" in Talk("junction-0", 20.0).hear("Why are we still here?")


def test_it_is_the_one_on_foot_whom_the_answer_named() -> None:
    talk = Talk("junction-0", 12.0)
    talk.hear("What is around us?")
    told = talk.say("What made you brake just now?", 43.0).reply.text
    assert "pedestrian" in told
    assert "pedestrian" in talk.say("How close was it?", 43.0).reply.text


@pytest.mark.parametrize(
    "text",
    [
        "Had every single one of them cleared the road?",
        "Have they all left the road?",
        "Did each of them get across?",
        "Are the pedestrians off the road?",
        "Is everyone off the crossing?",
    ],
)
def test_who_has_crossed_is_told_together(text: str) -> None:
    """Those who were not in our way at all do not count."""
    talk = Talk("junction-0", 14.5)
    assert talk.say(text).reply.text.startswith("No, ")
    reply = Talk("junction-0", 23.0).say(text).reply.text
    assert reply.startswith("Yes, ")
    assert "not" not in reply


@pytest.mark.parametrize(
    "text", ["how many people are on the crossing?", "how many people are crossing?"]
)
def test_who_crossed_before_is_not_on_the_crossing(text: str) -> None:
    assert "Nobody" in Talk("junction-0", 25.0).say(text).reply.text


@pytest.mark.parametrize(
    "text",
    [
        "State whether those pedestrians have priority over us, and by what rule.",
        "do they have right of way over us and by which rule?",
        "do they owe us or we them?",
    ],
)
def test_right_of_way_is_told_of_all_who_cross_with_its_basis(text: str) -> None:
    reply = Talk("junction-0", 13.0).say(text).reply.text
    assert "people on foot who cross our way go first" in reply
    assert reply.count("(vehicle") == 2


@pytest.mark.parametrize(
    "text", ["who are you waiting for?", "what are we waiting for?", "who are we waiting on?"]
)
def test_while_we_drive_freely_we_wait_for_nobody(text: str) -> None:
    assert "not waiting for anybody" in Talk("junction-0", 3.0).say(text).reply.text
    assert "light is red" in Talk("junction-0", 20.0).say(text).reply.text


@pytest.mark.parametrize("text", ["which of them crossed last?", "who among them crossed last?"])
def test_the_last_of_them_is_one(text: str) -> None:
    talk = Talk("junction-0", 13.0)
    talk.say("who are those people?")
    assert talk.say(text, 25.0).reply.text.count("(vehicle") == 1
