"""What "that" is in "what would that have saved?": the option that was asked about."""

import pytest

from tests.dialogue.following.asking import asked

SAVED = (
    "what would that have saved me",
    "how much would that have saved?",
    "how much time would it have saved us?",
)


@pytest.mark.parametrize("saved", SAVED)
@pytest.mark.parametrize(
    "first", ["can't you just turn right on red", "could you turn right on red?"]
)
def test_a_turn_on_red_would_have_saved_the_wait(first: str, saved: str) -> None:
    act = asked("junction-0", 20.0, first, saved)
    assert act.startswith("Ask(WhatIf(Has(colour, green, Feature(light), tense=past), HowMuch")


@pytest.mark.parametrize("judged", ["is that worth it", "would that be dangerous?"])
def test_whether_a_turn_on_red_is_worth_it_is_whether_we_may(judged: str) -> None:
    act = asked("junction-0", 20.0, "can't you just turn right on red", judged)
    assert act.startswith("Ask(Whether(Happens(Event(exit-right, object=Feature(light, red)")


@pytest.mark.parametrize("saved", SAVED)
@pytest.mark.parametrize(
    ("first", "option"),
    [
        ("can you overtake?", "change-left"),
        ("could you have overtaken?", "overtake"),
        ("should you have changed lanes?", "change-lane"),
        ("why didn't you change lanes?", "change-l"),
        ("couldn't you have moved to the left lane?", "change-left"),
    ],
)
def test_what_an_option_would_save_is_asked_of_that_option(
    first: str, option: str, saved: str
) -> None:
    act = asked("motorway-0", 20.0, first, saved)
    assert act.startswith(f"Ask(WhatIf(Happens(Event({option}")
    assert act.endswith("HowMuch(Measured(delay))))")


def test_what_we_could_see_is_no_option() -> None:
    act = asked("motorway-0", 20.0, "could you see the lorry?", "what would that have saved?")
    assert "see" not in act
