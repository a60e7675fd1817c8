"""What "those", "they" and "that stretch" are behind a list or an account."""

import pytest

from tests.dialogue.following.asking import asked

REASONS = "list the reasons you slowed or stopped between 0:05 and 0:30"
SPAN = "Between(5, 30)"


@pytest.mark.parametrize(
    "text",
    [
        REASONS,
        "list the reasons you slowed between 0:05 and 0:30",
        "what were the reasons you braked between 0:05 and 0:30?",
    ],
)
def test_reasons_are_listed_of_the_deed_and_the_time_that_are_said(text: str) -> None:
    talk = asked("junction-0", 34.0, text)
    assert "Why(Happens(Event(" in talk or f"Listing(reasons, time={SPAN}, event=Event(" in talk


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("which of those cost us the most time?", f"Peak(delay, {SPAN})"),
        ("which of them was the hardest?", f"Peak(braking, {SPAN})"),
        ("which of these was the riskiest?", f"Peak(risk, {SPAN})"),
        ("what was your peak deceleration over that stretch?", f"time={SPAN}"),
        ("how fast were you in that period?", f"Measured(speed, time={SPAN}"),
    ],
)
def test_those_are_the_items_and_that_stretch_their_time(text: str, found: str) -> None:
    assert found in asked("junction-0", 34.0, REASONS, text)


@pytest.mark.parametrize(
    ("texts", "found"),
    [
        (("which of those was the longest?",), "Peak(waiting, WholeRide)"),
        (("which of them cost us the most?",), "Peak(delay, WholeRide)"),
        (("and the second?",), "When(Happens(Event(stop, time=Between("),
        (("why the first?",), "Why(Happens(Event(stop, time=Between("),
        (("and the second?", "why?"), "Why(Happens(Event(stop, time=Between("),
        (("which of those was the last?",), "When(Happens(Event(stop, time=Between("),
    ],
)
def test_one_of_several_stops(texts: tuple[str, ...], found: str) -> None:
    assert found in asked("junction-0", 34.0, "list your stops", *texts)


@pytest.mark.parametrize(
    "text",
    [
        "how did they score?",
        "what were their scores?",
        "why were they worse?",
        "which of those was the best?",
    ],
)
def test_options_score_and_no_people(text: str) -> None:
    act = asked("junction-0", 34.0, "which alternatives did you evaluate at 0:20?", text)
    assert act == "Ask(Listing(rivals, time=At(20)))"


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("how fast were we then?", "Measured(speed, time=Between(10, 20)"),
        ("what was the limit then?", "Measured(limit, time="),
        ("how fast were you over that stretch?", "Measured(speed, time=Between(10, 20)"),
        ("what was the top speed in that time?", "time=Between(10, 20), tense=past), highest"),
    ],
)
def test_then_is_the_time_that_was_named(text: str, found: str) -> None:
    assert found in asked("junction-0", 34.0, "what happened between 0:10 and 0:20?", text)
