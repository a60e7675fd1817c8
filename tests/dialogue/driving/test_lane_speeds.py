"""The speed of another lane is that of the vehicles in it; who waits beside us is beside us."""

import re

import pytest

from tests.dialogue.talking import Talk


@pytest.mark.parametrize(
    "text",
    [
        "How much faster is the left lane?",
        "how much faster are the cars in the left lane",
        "Is the left lane faster?",
        "how much faster is the left lane than us?",
    ],
)
def test_a_lane_is_compared_with_us(text: str) -> None:
    said = Talk("motorway-0", 6.0).hear(text)
    assert re.search(r"(faster|slower|fast).* us|we are .* (faster|slower)", said, re.I), said


@pytest.mark.parametrize(
    "text", ["How fast is the left lane?", "what speed is the left lane doing"]
)
def test_the_speed_of_a_lane_is_that_of_its_vehicles(text: str) -> None:
    said = Talk("motorway-0", 6.0).hear(text)
    assert "vehicle" in said
    assert "km/h" in said
    assert "the left lane is" not in said


@pytest.mark.parametrize(
    "text", ["What is waiting beside us?", "who is waiting next to us", "who's standing beside us?"]
)
def test_who_waits_beside_us_is_beside_us(text: str) -> None:
    assert "Nobody" in Talk("city-0", 12.0).hear(text)
