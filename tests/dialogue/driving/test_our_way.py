"""Whether we are on our way: lost, off our route, past our exit or turn."""

import pytest

from tests.dialogue.talking import Talk

MOTORWAY, TOWN = ("motorway-0", 20.0), ("town-0", 30.0)
OURS = "we are on our way to our destination, about"


@pytest.mark.parametrize("where", [MOTORWAY, TOWN])
@pytest.mark.parametrize(
    ("text", "reply"),
    [
        ("are we lost?", "No"),
        ("have we missed our exit?", "No"),
        ("Did you miss the turn?", "No"),
        ("did you take a wrong turn", "No"),
        ("I think we are going the wrong way", "No"),
        ("this isn't the right road", "No"),
        ("we are off route, aren't we?", "No"),
        ("are we still on the right track?", "Yes"),
        ("are you sure this is the right way?", "Yes"),
        ("is this the right road?", "Yes"),
        ("are we still on our route?", "Yes"),
    ],
)
def test_we_say_whether_we_are_on_our_way(where: tuple[str, float], text: str, reply: str) -> None:
    assert Talk(*where).hear(text).startswith(f"{reply}, {OURS}")


@pytest.mark.parametrize("text", ["is the car behind us going the wrong way?", "is he off course?"])
def test_of_others_we_do_not_know_it(text: str) -> None:
    told = Talk(*TOWN).hear(text)
    assert told.startswith("I cannot")
    assert OURS not in told
