"""Remarks beside a question are context: nothing is asked back about them."""

from tests.dialogue.talking import Talk


def test_which_vehicle_a_remark_is_about_is_not_asked_beside_a_question() -> None:
    told = Talk("town-0", 25.0).hear("Why are you not turning left? The car is slow.")
    assert told == "I cannot turn left: our lane does not lead to the left."
