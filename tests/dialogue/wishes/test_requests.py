"""What passengers want us to do: declined, with what we do anyway or what stands against it."""

import pytest

from tests.dialogue.talking import Talk

#: A ride and a moment [s] of it.
LATE, CROWDED = ("s1-0", 7.0), ("motorway-0", 10.0)
STANDING, BOUND = ("junction-0", 20.0), ("town-0", 30.0)


@pytest.mark.parametrize(
    ("where", "text", "reply"),
    [
        (LATE, "you should brake a little, just in case!", "cannot brake on request. I am not"),
        (LATE, "You'd better slow down, just to be safe!", "cannot slow down on request"),
        (LATE, "you ought to drive slower", "cannot slow down on request"),
        (LATE, "let me get out here", "cannot let you out"),
        (LATE, "can I get out here?", "cannot let you out"),
        (LATE, "I'd like to get off now", "cannot let you out"),
        (BOUND, "could you take the next one slower?", "I am going to slow down to about"),
        (BOUND, "please take the next bend more slowly", "I am going to slow down to about"),
        (BOUND, "could you take the corner more gently?", "I am going to slow down to about"),
        (BOUND, "slow down please", "I am going to slow down to about"),
        (CROWDED, "change lanes please", "end in a collision with the black car"),
        (CROWDED, "move over to the left lane", "end in a collision with the black car"),
        (STANDING, "beep and drive on", "cannot honk. Not yet: the traffic light"),
        (STANDING, "honk and go!", "cannot honk. Not yet: the traffic light"),
        (LATE, "you might want to keep more distance", "cannot keep more distance on request"),
        (LATE, "You could brake just to be careful.", "cannot brake on request"),
        (CROWDED, "you should be in the left lane", "end in a collision with the black car"),
        (LATE, "I would feel better if you slowed down a little. Could you?", "cannot slow down"),
        (STANDING, "don't go yet!", "cannot wait on request. The traffic light"),
        (STANDING, "you should wait for those people", "cannot wait for"),
    ],
)
def test_a_request_is_declined_with_what_bears_on_it(
    where: tuple[str, float], text: str, reply: str
) -> None:
    assert reply in Talk(*where).hear(text)


@pytest.mark.parametrize(
    "texts",
    [
        ("so change lane then, what's stopping you",),
        ("switch lanes already, what are you waiting for?",),
        ("change lanes!", "why not?"),
        ("change lanes!", "what's keeping you from doing it?"),
        ("you should overtake that lorry", "what is the problem?"),
        ("overtake that lorry", "what's holding you back?"),
    ],
)
def test_what_stops_us_is_what_speaks_against_the_wish(texts: tuple[str, ...]) -> None:
    told = Talk(*CROWDED).hear(*texts)
    assert "the black car" in told
    assert "the blue car" not in told


def test_we_are_about_to_go_once_the_light_has_turned_green() -> None:
    assert Talk("city-0", 24.1).hear("ok it's green. can we go now?").startswith("I am just about")
    assert Talk("city-0", 22.0).hear("can we go now?").startswith("Not yet")


@pytest.mark.parametrize("text", ["wait!", "hold on!"])
def test_wait_by_itself_is_a_request(text: str) -> None:
    assert "cannot wait on request" in Talk(*STANDING).hear(text)
