"""Options of a manoeuvre that is named, time lost in queues, and what stands for a cause."""

import pytest

from tests.dialogue.talking import Talk
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


@pytest.mark.parametrize(
    ("text", "acts"),
    [
        ("are we in a traffic jam?", "Ask(Whether(Exists(Feature(queue))))"),
        ("who's first in the jam", "Ask(Which(Wanted, Related(on, Wanted, Feature(queue))))"),
        ("who is first in the queue?", "Ask(Which(Wanted, Related(on, Wanted, Feature(queue))))"),
        ("what signal is it giving?", "Ask(HowMuch(Measured(indicator, Pronoun(it))))"),
        ("y r we breaking its a straight rode", "Ask(Why(Happens(Event(brake, tense=present))))"),
    ],
)
def test_queues_signals_and_brakes_are_what_they_are(text: str, acts: str) -> None:
    assert read(text).startswith(acts)


@pytest.mark.parametrize("text", ["are we in a traffic jam?", "is there a queue ahead of us?"])
def test_who_stands_ahead_in_a_row_is_a_queue(text: str) -> None:
    assert Talk("s4-0", 22.0).hear(text).startswith("Yes")
