"""Who is behind us, or ahead, and what is said of one who is not there."""

import pytest

from tests.dialogue.talking import Talk


@pytest.mark.parametrize("question", ["Is anybody behind us?", "Is somebody behind us?"])
def test_who_is_right_behind_us_is_named_first(question: str) -> None:
    told = Talk("motorway-0", 10.0).hear(question)
    assert told.startswith("Yes, there is the brown lorry behind us (vehicle 3), about 75 metres")
    assert "the black car behind us on the left (vehicle 5), about 3 metres away" in told


@pytest.mark.parametrize(
    "question",
    [
        "How far is the car behind us?",
        "How close is the car behind us?",
        "How fast is the car behind us?",
        "What is the car behind us doing?",
    ],
)
def test_a_question_about_somebody_who_is_not_there_is_one_question(question: str) -> None:
    told = Talk("s1-0", 4.0).hear(question)
    assert told.startswith("I see no car behind us. I see the blue car ahead of us on the right")
