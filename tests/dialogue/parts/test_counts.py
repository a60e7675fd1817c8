"""Counts over what is in view: of several kinds, and of those of whom something holds."""

import pytest

from tests.dialogue.following.asking import asked, told


@pytest.mark.parametrize(
    "text",
    [
        "how many cars and bicycles do you see?",
        "How many car and bicycle you see around us?",
        "how many bicycle and car you can see",
        "how many cars and how many bicycles are around us?",
        "how many cars and bicycles are there?",
    ],
)
def test_each_kind_is_counted(text: str) -> None:
    acts = asked("city-0", 20.0, text)
    assert acts.count("Ask(HowMany(") == 2
    reply = told("city-0", 20.0, text)
    assert "cars now" in reply
    assert "bicycles now" in reply
    assert "Yes" not in reply
    assert "Do you mean" not in reply


def test_what_each_kind_does_is_counted() -> None:
    reply = told("city-0", 20.0, "how many cars and bicycles are standing still?")
    assert "Yes" not in reply
    assert reply.count(".") == 2


@pytest.mark.parametrize(
    ("text", "count"),
    [
        ("how many are faster than us?", "Seven vehicles"),
        ("how many vehicles are closer than 30 metres?", "Three vehicles"),
        ("how many are going faster than 100 km/h?", "Two cars"),
        ("how many cars are further away than 100 metres?", "One car"),
    ],
)
def test_those_of_whom_a_comparison_holds_are_counted(text: str, count: str) -> None:
    assert told("motorway-0", 12.0, text).startswith(count)


def test_of_them_only_those_are_counted() -> None:
    reply = told("motorway-0", 12.0, "how many cars can you see?", "how many are within 30 m?")
    assert "cars, as far" not in reply


@pytest.mark.parametrize("text", ["who is closer than 30 metres?", "who is within 30 metres?"])
def test_a_distance_to_us_is_told_as_being_close(text: str) -> None:
    reply = told("motorway-0", 12.0, text)
    assert reply.endswith("are closer than 30 metres.")
    assert "distance of" not in reply


def test_nobody_is_told_without_a_second_denial() -> None:
    reply = told("motorway-0", 12.0, "which lorries are closer than 3 metres?")
    assert reply == "Nobody is closer than 3 metres."


@pytest.mark.parametrize(
    "text",
    [
        "how far away is the lorry in metres and in seconds?",
        "what distance did you keep to the lorry, in metres and in seconds?",
        "how far ahead is the lorry in secs",
        "what is our gap to the lorry in seconds and metres?",
    ],
)
def test_a_distance_in_seconds_is_the_gap_in_both(text: str) -> None:
    reply = told("motorway-0", 12.0, text)
    assert "metres, or about" in reply
    assert "of driving" in reply
    assert "0:00" not in reply
