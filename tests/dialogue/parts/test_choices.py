"""Choices: which of several causes, road users, colours or courses it is."""

import pytest

from tests.dialogue.following.asking import asked, told

OF_CAUSES = (
    "is it those people you are waiting for or the red light?",
    "is it the light that you are waiting for or the people?",
    "is it those people you are waiting for or is it the red light?",
    "what are you waiting for, the light or the pedestrians?",
    "what holds us up, the people, the light or another car?",
    "which constraint is limiting our speed, the curve, the light or a road user?",
    "is it because of the light or because of the people that we stand?",
    "why are we standing, for the light or for the people?",
    "are you waiting for the people or the light?",
    "what made you stop, the light or the people?",
    "why are we waiting, is it the people or the light?",
)


@pytest.mark.parametrize("text", OF_CAUSES)
def test_the_light_is_told_as_what_we_wait_for(text: str) -> None:
    reply = told("junction-0", 20.0, text)
    assert "because the traffic light" in reply
    assert not reply.startswith(("Yes", "No"))
    assert "pedestrian" not in reply


OF_A_TURN = (
    "why slow down, for the bus or for the turn?",
    "are you slowing for the turn or for the bus?",
    "is it the corner or that car that slows us, or what?",
    "what holds us back, the bend, a light or a vehicle?",
    "what slows us down, the corner or a car?",
    "which factor limits our speed, the bend or a car?",
)


@pytest.mark.parametrize("text", OF_A_TURN[2:])
def test_the_turn_is_told_as_what_slows_us(text: str) -> None:
    reply = told("town-0", 22.5, text)
    assert "because I have to take the turn" in reply
    assert not reply.startswith(("Yes", "No"))


@pytest.mark.parametrize("text", OF_A_TURN[:2])
def test_two_causes_are_the_suspects_of_one_question(text: str) -> None:
    act = asked("junction-0", 28.0, text)
    assert act.startswith("Ask(Why(Happens(Event(slow-down")
    assert "suspect=" in act
    assert "rival=" in act


@pytest.mark.parametrize(
    "text",
    [
        "what keeps you from changing lanes, the blue car or the black one?",
        "who is stopping you from moving left, the blue car or the black one?",
    ],
)
def test_who_is_in_the_way_of_a_change_is_told_without_yes_or_no(text: str) -> None:
    act = asked("motorway-0", 12.0, text)
    assert act.startswith("Ask(Why(Not(Happens(Event(change-l")
    assert "suspect=" in act
    assert "rival=" in act
    assert not told("motorway-0", 12.0, text).startswith(("Yes", "No"))


@pytest.mark.parametrize(
    ("ride", "at", "text", "answer"),
    [
        ("junction-0", 20.0, "is the light red or green?", "The traffic light is red"),
        ("junction-0", 32.0, "was it red or green when we crossed?", "The traffic light was green"),
        ("motorway-0", 12.0, "is the lorry white or grey?", "The lorry"),
        ("motorway-0", 12.0, "are we speeding up or slowing down?", "I am following"),
        ("motorway-0", 12.0, "are we going to stop or drive on?", "I will not stop"),
        ("junction-0", 20.0, "will we go now or later?", "I expect the traffic light"),
        ("junction-0", 32.0, "are you turning left or right?", "I am turning right"),
    ],
)
def test_what_holds_is_told(ride: str, at: float, text: str, answer: str) -> None:
    assert told(ride, at, text).startswith(answer)


@pytest.mark.parametrize(
    "text",
    [
        "who is faster, the lorry, the red car or the black car?",
        "is the lorry, the red car or the black car faster?",
    ],
)
def test_three_are_compared(text: str) -> None:
    act = asked("motorway-0", 12.0, text)
    assert act.startswith("Ask(Compare([Vehicle(")
    assert act.count("Vehicle(") == 3


@pytest.mark.parametrize(
    "text", ["what limits our speed?", "what slows us?", "what holds us back?"]
)
def test_a_turn_limits_our_speed_though_we_wait_for_nobody(text: str) -> None:
    assert "the turn" in told("town-0", 22.5, text)
    assert "not waiting for anybody" in told("town-0", 22.5, "what are we waiting for?")
