"""Questions whose words say more than their term: lanes of others, lights, counts, paces."""

import pytest

from tests.dialogue.talking import Talk
from xavi_dialogue.nlu.notation import acts_line
from xavi_dialogue.nlu.parse import Parser


def read(text: str) -> str:
    return acts_line(Parser().read(text)[0].acts)


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("the one in the left lane", "Related(on, Wanted, Lane(left))"),
        ("how fast is the car in the middle lane", "Related(on, Wanted, Lane(other))"),
        ("the car in the left lane is fast", "Related(on, Wanted, Lane(left))"),
        ("how far is the lorry in our lane?", "Related(on, Wanted, Lane"),
    ],
)
def test_a_lane_behind_a_vehicle_tells_which_is_meant(text: str, part: str) -> None:
    assert part in read(text)


@pytest.mark.parametrize(
    ("text", "acts"),
    [
        (
            "how many are crossing?",
            "Ask(HowMany(Described(doing=Event(cross, Wanted, tense=present)",
        ),
        ("How many people are crossing?", "Ask(HowMany(Described(pedestrian"),
        ("how many crossings are there", "Ask(HowMany(Junction"),
        ("was that the only stop?", "Ask(HowMany(Event(stop, time=WholeRide)))"),
        ("what colour was your signal?", "Ask(HowMuch(Measured(colour, Feature(light)"),
        ("now is green, why not go?", "Claim(Has(colour, green, Pronoun(it))); Ask(Why(Not("),
        ("how much time do we lose because of him", "Ask(HowMuch(Measured(delay, Pronoun(he))))"),
        (
            "how you know the bus is going to stop?",
            "Ask(HowKnow(Happens(Event(stop, Described(bus)",
        ),
        ("how often did you revise the plan?", "Ask(HowMany(Event(change-plan)))"),
        ("which vehicles were relevant to that decision?", "Ask(WhatWouldChange("),
        ("who was important for that decision?", "Ask(WhatWouldChange("),
        ("Is anything coming up behind us fast?", "Ask(Whether(Happens(Event(come"),
    ],
)
def test_is_read_with_all_that_its_words_say(text: str, acts: str) -> None:
    assert read(text).startswith(acts)


@pytest.mark.parametrize(
    "text", ["why is the lorry slower than us?", "why does the lorry drive only 80?"]
)
def test_why_another_is_slower_is_of_that_one(text: str) -> None:
    assert Talk("motorway-0", 20.0).hear(text).startswith("The white lorry")


def test_people_on_foot_walk() -> None:
    reply = Talk("junction-0", 14.0).hear("why is vehicle 9 so slow?")
    assert "driving" not in reply


@pytest.mark.parametrize("text", ["I feel better.", "i feel better now"])
def test_who_feels_better_is_relieved(text: str) -> None:
    assert read(text) == "Feel(relieved)"
