"""Until when a red light holds us, however it is asked."""

import pytest

from tests.dialogue.talking import Talk

QUESTIONS = (
    "When do we go on?",
    "How much longer till we're moving again?",
    "How much longer do we have to wait?",
    "How long will we be standing here?",
)


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize("at", [10.0, 20.0])
def test_at_a_red_light_we_go_on_when_it_turns_green(question: str, at: float) -> None:
    told = Talk("junction-0", at).hear(question)
    assert told.startswith("I expect the traffic light to turn green in about ")


def test_at_green_no_light_is_waited_for() -> None:
    assert "light" not in Talk("junction-0", 30.0).hear("When do we go on?")
