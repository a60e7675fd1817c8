"""Behind a question for a reason, "was it that blue one?" asks whether that was it."""

import pytest

from tests.dialogue.following.asking import asked

BRAKED = "Why(Happens(Event(brake, time=Between("


@pytest.mark.parametrize(
    ("follow_up", "suspect"),
    [
        ("was it that blue one?", "Vehicle(4)"),
        ("was it the blue one?", "Vehicle(4)"),
        ("so it was the blue one?", "Vehicle(4)"),
        ("it was the blue one, wasn't it?", "Vehicle(4)"),
        ("was it the bus?", "Vehicle(2)"),
        ("was it the light?", "Feature(light)"),
        ("so it was the light?", "Feature(light)"),
        ("was it the turn?", "Junction("),
        ("because of the light?", "Feature(light)"),
    ],
)
def test_what_it_is_said_to_be_is_the_suspected_cause(follow_up: str, suspect: str) -> None:
    act = asked("junction-0", 22.0, "why did you brake?", follow_up)
    assert act.startswith(f"Ask({BRAKED}")
    assert f"suspect={suspect}" in act


def test_a_second_suspect_is_asked_of_the_same_deed() -> None:
    act = asked("junction-0", 22.0, "why did you brake?", "was it the bus?", "was it the blue one?")
    assert act.startswith(f"Ask({BRAKED}")
    assert "suspect=Vehicle(4)" in act


def test_a_kind_is_suspected_as_somebody_who_had_to_do_with_it() -> None:
    act = asked("junction-0", 22.0, "why did you brake?", "was it a pedestrian?")
    assert act.startswith(f"Ask({BRAKED}")


@pytest.mark.parametrize("text", ["is it red?", "was it red?", "is that a traffic light?"])
def test_a_colour_or_a_sort_by_itself_is_no_cause(text: str) -> None:
    assert "suspect" not in asked("junction-0", 22.0, "what do you see?", text)
