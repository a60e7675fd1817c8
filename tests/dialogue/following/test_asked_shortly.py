"""Short questions that ask one more thing of what was asked before."""

import pytest

from tests.dialogue.following.asking import asked, told

SAVES = "HowMuch(Measured(delay))"


@pytest.mark.parametrize("amount", ["by how much?", "and by how much?", "how much?"])
@pytest.mark.parametrize(
    ("first", "found"),
    [
        ("would changing left be quicker?", "WhatIf(Happens(Event(change-left"),
        ("what if you changed left?", "WhatIf(Happens(Event(change-left"),
        ("are we faster than the white lorry?", "HowMuch(Measured(speed, to=Vehicle(1)"),
        ("are we over the limit?", "HowMuch(Measured(excess"),
        ("did you slow down?", "Whether(Happens(Event(slow-down"),
        ("is the white lorry closer than the green car?", "Whether(Compares(Measured(distance"),
    ],
)
def test_by_how_much_is_the_difference_that_was_asked_about(
    first: str, found: str, amount: str
) -> None:
    act = asked("motorway-0", 20.0, first, amount)
    assert act.startswith(f"Ask({found}")


@pytest.mark.parametrize("text", ["by how much?", "how much?"])
def test_an_amount_of_nothing_is_not_a_count(text: str) -> None:
    assert "did not understand" in told("motorway-0", 20.0, "who is behind us?", text)


@pytest.mark.parametrize("text", ["until when?", "till when?", "and until when?"])
@pytest.mark.parametrize(
    ("first", "found"),
    [
        ("why are we standing?", "When(Happens(Event(go"),
        ("is the light red?", "When(Happens(Event(turn-colour, Feature(light)"),
        ("did you brake?", "When(Happens(Event(brake"),
    ],
)
def test_until_when_is_the_end_of_it(first: str, found: str, text: str) -> None:
    assert asked("junction-0", 22.0, first, text).startswith(f"Ask({found}")


@pytest.mark.parametrize(
    ("texts", "found"),
    [
        (("who is behind us?", "and in front of us?"), "Related(ahead-of, Wanted, time=Now)"),
        (("who is behind us?", "and behind the white lorry?"), "Related(behind, Wanted, Vehicle"),
        (("what is on our left?", "and behind us?"), "Related(behind, Wanted, time=Now)"),
        (("who is behind us?", "and on the left?", "and ahead?"), "Related(ahead-of, Wanted"),
        (("how far is the car behind us?", "and in front of us?"), "Measured(distance, Vehicle("),
    ],
)
def test_another_place_is_asked_the_same(texts: tuple[str, ...], found: str) -> None:
    assert found in asked("motorway-0", 20.0, *texts)


def test_who_then_is_who_it_was_instead() -> None:
    act = asked("junction-0", 22.0, "why did you brake?", "was it the bus?", "who then?")
    assert act.startswith("Ask(Why(Happens(Event(brake")
    assert "suspect" not in act


@pytest.mark.parametrize(
    ("first", "found"),
    [
        ("where is the black car going?", "HowKnow(Happens(Event("),
        ("how long have we been behind the white lorry?", "HowLong(Related(behind"),
    ],
)
def test_since_when_is_of_what_was_told(first: str, found: str) -> None:
    assert asked("motorway-0", 20.0, first, "since when?").startswith(f"Ask({found}")


@pytest.mark.parametrize("text", ["how did they score?", "which of them was best?"])
def test_options_are_compared_at_the_decision_that_was_told(text: str) -> None:
    act = asked("motorway-0", 40.0, "what did you consider?", text)
    assert act.startswith("Ask(Listing(rivals, time=At(39")
