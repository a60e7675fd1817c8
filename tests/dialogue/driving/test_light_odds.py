"""Chances that a light turns, or still shows what it does, at a moment that is named."""

import re

import pytest

from tests.dialogue.talking import Talk

RED = 4.0  # [s] in the ride `city-0`: red, as is all that we see of the cycle


def chance(reply: str) -> float:
    """Read the chance that a reply states, in percent; "under 1 %" counts as 0."""
    found = re.search(r"at (under |over |about )?(\d+) %", reply)
    assert found is not None, reply
    bound = {"under ": 0, "over ": 100}
    return float(bound.get(found[1] or "", int(found[2])))


@pytest.mark.parametrize(
    "asked",
    [
        "How likely is it that it turns green within {} seconds?",
        "What are the chances it goes green in the next {} seconds?",
        "will it turn green within {} seconds",
        "do you think the light changes in {} seconds?",
    ],
)
def test_the_chance_of_green_grows_with_the_time(asked: str) -> None:
    told = [Talk("city-0", RED).hear(asked.format(after)) for after in (4, 12, 25)]
    found = list(map(chance, told))
    assert found == sorted(found)
    assert found[0] < found[-1]
    assert all(
        f"within {after} seconds" in reply for after, reply in zip((4, 12, 25), told, strict=True)
    )


@pytest.mark.parametrize(
    "asked", ["Will it still be red in {} seconds?", "Is it still red in {} s?"]
)
def test_what_still_shows_is_the_rest(asked: str) -> None:
    still = chance(Talk("city-0", RED).hear(asked.format(12)))
    turned = chance(Talk("city-0", RED).hear("Will it turn green within 12 seconds?"))
    assert still + turned == pytest.approx(100.0, abs=1.0)


def test_yes_and_no_follow_the_chance() -> None:
    assert Talk("city-0", RED).hear("Will it turn green within 2 seconds?").startswith("No: ")
    assert Talk("city-0", RED).hear("Will it be red in 2 seconds?").startswith("Yes: ")


def test_beyond_what_is_foreseen_no_chance_is_stated() -> None:
    reply = Talk("city-0", RED).hear("How likely is it that it turns green within two minutes?")
    assert "within 2 minutes" not in reply


def test_within_some_metres_is_a_distance() -> None:
    assert "metres" in Talk("city-0", RED).hear("Is anyone within ten metres of us?")


@pytest.mark.parametrize(
    "asked",
    [
        "Do we have to stop for the light?",
        "must we stop at the light",
        "do you need to stop for that light",
    ],
)
def test_having_to_stop_for_a_light_ahead_is_to_come(asked: str) -> None:
    talk = Talk("city-0", RED)
    talk.hear("What colour is the light?")
    assert "we will have to stop for the traffic light" in talk.hear(asked)
