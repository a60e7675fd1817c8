"""Options of a manoeuvre that is named, time lost in queues, and what stands for a cause."""

import pytest

from xavi_dialogue.nlu.notation import acts_line
from xavi_dialogue.nlu.parse import Parser


def read(text: str) -> str:
    return acts_line(Parser().read(text)[0].acts)


@pytest.mark.parametrize(
    ("text", "acts"),
    [
        (
            "What was the alternative to turning left?",
            "Ask(Listing(options, event=Event(exit-left)))",
        ),
        ("were there alternatives to braking?", "Ask(Listing(options))"),
    ],
)
def test_alternatives_to_a_deed_are_of_that_deed(text: str, acts: str) -> None:
    assert read(text) == acts


@pytest.mark.parametrize(
    "text",
    [
        "how long did we lose in that queue",
        "how much time did we lose in the queue",
        "how many seconds did we lose in the traffic jam?",
    ],
)
def test_time_lost_in_a_queue_is_lost_by_waiting(text: str) -> None:
    assert read(text).startswith("Ask(HowMuch(Measured(delay, event=Event(wait)")


@pytest.mark.parametrize(
    "text",
    [
        "did we brake for the corner or was there something?",
        "did we just brake for the corner or was their something",
        "Did you brake for the bend, or was there somebody?",
    ],
)
def test_for_what_or_was_there_somebody_is_why(text: str) -> None:
    assert read(text).startswith("Ask(Why(Happens(Event(brake)), suspect=")


@pytest.mark.parametrize(
    "text",
    ["Which part of the road can't you see?", "which bits of the road can you not see"],
)
def test_what_part_of_the_road_is_not_seen_is_hidden(text: str) -> None:
    assert read(text) == "Ask(Listing(hidden))"


@pytest.mark.parametrize("text", ["after this, which direction?", "which direction after that"])
def test_which_way_after_this_is_what_comes_next(text: str) -> None:
    assert read(text) == "Ask(Doing(time=Next, tense=future))"
