"""What "why's that?" and "are you sure?" ask after denials and forecasts."""

import pytest

from tests.dialogue.following.asking import asked

WHYS = ("why's that?", "how come?", "what for?")


@pytest.mark.parametrize("why", WHYS)
@pytest.mark.parametrize("denied", ["are we going straight on?", "will you turn left?"])
def test_after_a_denied_way_the_reason_of_the_way_is_asked(denied: str, why: str) -> None:
    act = asked("junction-0", 20.0, denied, why)
    assert act.startswith("Ask(Why(Happens(Event(exit-right")


@pytest.mark.parametrize("why", WHYS)
def test_after_a_risk_the_grounds_are_asked(why: str) -> None:
    act = asked("junction-0", 20.0, "are we going to hit someone?", why)
    assert act.startswith("Ask(HowKnow(Happens(Event(collide")


@pytest.mark.parametrize("first", ["when do we go on?", "when does the light turn green?"])
@pytest.mark.parametrize(
    ("text", "form"),
    [("are you sure about that?", "HowSure"), ("are you sure?", "HowSure"),
     ("how do you know?", "HowKnow"), ("how likely is that?", "HowSure")],
)  # fmt: skip
def test_after_a_forecast_of_the_light_it_is_that_which_is_doubted(
    first: str, text: str, form: str
) -> None:
    act = asked("junction-0", 20.0, first, text)
    assert act.startswith(f"Ask({form}(Happens(Event(turn-colour")


def test_how_likely_it_is_to_hit_anybody() -> None:
    act = asked("junction-0", 20.0, "are we going to hit someone?", "how likely?")
    assert act.startswith("Ask(HowSure(Happens(Event(collide")
    assert "Nobody" not in act


@pytest.mark.parametrize("text", ["was that risky?", "was that dangerous?", "was it risky?"])
def test_a_risk_is_of_the_deed_of_another_that_was_asked_about(text: str) -> None:
    act = asked("motorway-0", 20.0, "did the black car overtake us?", text)
    assert "event=Event(overtake, Vehicle(" in act


@pytest.mark.parametrize(
    "text",
    [
        "when did you become certain?",
        "since when were you sure about that?",
        "and when did you become sure of it?",
        "how long have you been certain?",
    ],
)
def test_since_when_it_was_sure_is_told_by_the_evidence(text: str) -> None:
    act = asked("s1-0", 6.0, "why did you change lanes?", text)
    assert act.startswith("Ask(HowKnow(")
