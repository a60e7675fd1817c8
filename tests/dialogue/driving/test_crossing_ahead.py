"""People crossing, who is behind us, and going once the light is green."""

import pytest

from tests.dialogue.talking import Talk
from xavi_dialogue.nlu.notation import acts_line
from xavi_dialogue.nlu.parse import Parser


def read(text: str) -> str:
    return acts_line(Parser().read(text)[0].acts)


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("are there people crossing?", "pedestrian"),
        ("are there any people crossing in front of us?", "pedestrian"),
        ("are there cars crossing?", "car"),
        ("are there people crossing ahead?", "pedestrian"),
    ],
)
def test_people_crossing_are_people(text: str, kind: str) -> None:
    assert f"Exists(Described({kind}" in read(text)
    assert "cross" in read(text)


@pytest.mark.parametrize(
    "text",
    [
        "is the car behind us close?",
        "was the car behind us close?",
        "is the car behind us too close?",
        "was the car behind us close when you braked?",
    ],
)
def test_a_place_before_what_is_said_is_part_of_the_description(text: str) -> None:
    assert "Described(car, bearing=behind)" in read(text)


@pytest.mark.parametrize(
    "text",
    [
        "can we go when it turns green?",
        "will we be able to go when it goes green?",
        "what has to happen before we can go?",
    ],
)
def test_going_once_it_is_green_asks_when_we_can_go(text: str) -> None:
    assert read(text) == "Ask(When(Happens(Event(go, tense=future, modal=can))))"
    assert "turn green in about" in Talk("junction-0", 18.0).hear(text)


@pytest.mark.parametrize(
    "text", ["what deceleration did you use?", "what braking force did you use?"]
)
def test_what_we_used_is_how_hard_we_braked(text: str) -> None:
    assert "Measured(deceleration, event=Event(brake" in read(text)


@pytest.mark.parametrize("text", ["are we turning left?", "are we turning left here?"])
def test_a_turn_under_way_is_told_rather_than_the_way_ahead(text: str) -> None:
    reply = Talk("s2-2", 7.0, planner=False).hear(text)
    assert "turning right" in reply


@pytest.mark.parametrize(
    ("text", "seen"),
    [
        ("is he aware of us?", "can-see, Pronoun(he))"),
        ("is the pedestrian aware of us?", "can-see, Described(pedestrian))"),
        ("is vehicle 3 aware of us?", "can-see, Vehicle(3))"),
        ("are you aware of the bike?", "can-see, Ego, Described(bike)"),
    ],
)
def test_who_is_aware_of_somebody_sees_them(text: str, seen: str) -> None:
    assert f"Related({seen}" in read(text)


@pytest.mark.parametrize(
    "text", ["how long before we're standing?", "how long until we stop?", "when will we stop?"]
)
def test_when_we_stop_is_not_when_the_light_turns_green(text: str) -> None:
    """We roll up to a red light at 14 s, and stand at it from 16.9 s on."""
    reply = Talk("junction-0", 12.0).hear(text)
    assert "in about" in reply
    assert "green" not in reply


@pytest.mark.parametrize(
    "text",
    [
        "which road user is limiting our speed?",
        "which vehicle limits our speed?",
        "who is slowing us down?",
    ],
)
def test_who_limits_our_speed_is_who_holds_us_up_now(text: str) -> None:
    reply = Talk("junction-0", 12.0).hear(text)
    assert reply.startswith("I am braking, because")
    assert "no time to speak of" not in reply


@pytest.mark.parametrize("at", [28.5, 29.0])
@pytest.mark.parametrize(
    "text",
    [
        "are there people on the crossing",
        "is anyone crossing",
        "Is somebody on the crosswalk?",
        "is anyone on the zebra crossing",
    ],
)
def test_people_on_the_crossing_of_our_exit_cross_our_way(text: str, at: float) -> None:
    told = Talk("city-0", at).hear(text)
    assert told.startswith("Yes")
    assert "(vehicle 7)" in told or "(vehicle 33)" in told


def test_people_beside_the_crossing_of_our_exit_do_not() -> None:
    told = Talk("junction-0", 28.0).hear("are there people on the crossing")
    assert told.startswith("No")


@pytest.mark.parametrize(
    "text",
    [
        "would you have stopped if nobody was crossing",
        "Would you have stopped if the pedestrian wasn't there?",
        "would we have stopped without that pedestrian",
    ],
)
def test_it_is_not_asked_of_a_halt_before_somebody_was_seen(text: str) -> None:
    told = Talk("junction-0", 42.5).hear(text)
    assert "in view" not in told
    assert "(vehicle 13)" in told
    assert "slowed down" in told


@pytest.mark.parametrize(
    "text",
    ["is there a cyclist behind us?", "are there bicycles next to us", "any bike beside us?"],
)
def test_whether_somebody_is_at_a_place_is_strict(text: str) -> None:
    assert Talk("city-0", 15.0).hear(text).startswith("No, there is no bi")


@pytest.mark.parametrize(
    "text", ["is somebody on the crossing in front of us?", "is anyone on the crossing ahead"]
)
def test_the_crossing_ahead_is_where_people_cross(text: str) -> None:
    assert "junction" not in Talk("junction-0", 22.0).hear(text)
