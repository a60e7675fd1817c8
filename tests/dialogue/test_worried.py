"""Questions of worried and impatient passengers at a red light and at a crossing."""

import pytest

from tests.dialogue.talking import Talk

RED, ROLLING, ROUND = 20.0, 14.0, 34.5  # [s] in the ride `junction-0`


@pytest.mark.parametrize(
    ("at", "text", "reply"),
    [
        (
            ROLLING,
            "are you waiting for those people?",
            "Partly: I am braking, because the traffic light is red. Besides, I have to let the",
        ),
        (ROLLING, "can we go now?", "Not yet: the traffic light"),
        (ROLLING, "you're braking", "I am braking, because the traffic light is red. Besides, I"),
        (ROLLING, "why are we not going?", "We are driving at 8 km/h, because the traffic light"),
        (ROLLING, "does vehicle 8 go first?", "Yes, the pedestrian coming from the right (vehicle"),
        (RED, "you've stopped again", "We are standing still, because the traffic light is red."),
        (RED, "will you stop for those people?", "We are standing still, because"),
        (RED, "are we going to be here forever?", "I expect the traffic light to turn green in"),
        (ROUND, "could you go a little more gently?", "I am sorry, but I cannot slow down"),
        (ROUND, "were you scared you'd bump into the people?", "No, I have no feelings"),
    ],
)
def test_is_answered_by_what_holds_us_up(at: float, text: str, reply: str) -> None:
    assert Talk("junction-0", at).hear(text).startswith(reply)


def test_takes_people_about_to_cross_for_people_and_not_for_a_request() -> None:
    told = Talk("junction-0", 9.0).hear(
        "There are people about to step off the pavement. You have seen them, haven't you?"
    )
    assert told.startswith("Yes, there is the pedestrian")
    assert "request" not in told


def test_names_the_people_in_front_of_us_where_it_is_asked_whether_it_is_safe() -> None:
    told = Talk("junction-0", 32.5).hear("is it really safe to go?")
    assert "the pedestrian ahead of us" in told


@pytest.mark.parametrize(
    ("ride", "at", "before", "reply"),
    [
        ("town-0", 21.5, "Who could hit us?", "Moving to the left lane carries a risk of 4 % of"),
        ("junction-0", 9.0, "Where are we?", "The pedestrian (vehicle 8) will be in our way"),
        (
            "junction-0",
            24.0,
            "Who could hit us?",
            "The green bicycle (vehicle 3) will be in our way",
        ),
    ],
)
def test_who_worries_us_is_who_was_a_risk_else_who_will_be_in_our_way(
    ride: str, at: float, before: str, reply: str
) -> None:
    talk = Talk(ride, at)
    talk.hear(before)
    assert talk.hear("Who worries you most?").startswith(reply)
