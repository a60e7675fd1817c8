"""Remarks beside a question are context: nothing is asked back about them."""

from tests.dialogue.talking import Talk


def test_which_vehicle_a_remark_is_about_is_not_asked_beside_a_question() -> None:
    told = Talk("town-0", 25.0).hear("Why are you not turning left? The car is slow.")
    assert told == "I cannot turn left: our lane does not lead to the left."


def test_a_number_in_a_remark_picks_nobody() -> None:
    told = Talk("town-0", 25.0).hear("Why are we so slow? In my country is allowed fifty.")
    assert "vehicle 50" not in told


def test_how_a_rule_is_known_is_told_by_the_map() -> None:
    told = Talk("town-0", 6.0).hear("How do you know that the yellow car gives way?")
    assert told.startswith("We have right of way, and the yellow car")


def test_how_something_is_done_is_no_question_of_other_rides() -> None:
    told = Talk("town-0", 15.0).hear("Is the white bus driving normally?")
    assert "only know about this ride" not in told
    assert "only know about this ride" in Talk("town-0", 15.0).hear("Is it always this busy here?")
