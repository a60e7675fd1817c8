"""What a follow-up takes over from the question before: all that it does not replace."""

import pytest

from tests.dialogue.following.asking import asked

SLOWED = "Whether(Happens(Event(slow-down, modal=would)))"
RED = "Not(Exists(Vehicle(2)"


@pytest.mark.parametrize(
    "follow_up",
    [
        "and without the red one?",
        "what about the red car?",
        "and the red one?",
        "and if the red one hadn't been there?",
    ],
)
@pytest.mark.parametrize(
    "first",
    [
        "would you have slowed down without the blue car?",
        "without the blue car, would you have slowed?",
        "had the blue car not been there, would you have slowed down?",
    ],
)
def test_another_supposition_is_asked_the_same(first: str, follow_up: str) -> None:
    act = asked("s3-0", 10.4, first, follow_up)
    assert act.startswith(f"Ask(WhatIf({RED}")
    assert "slow-down, modal=would" in act


@pytest.mark.parametrize(
    ("texts", "then"),
    [
        (("why did you slow down?", "and without the red one?"), SLOWED),
        (("did you slow down?", "without the red car?"), SLOWED),
        (("when do we get there?", "and without the red car?"), "When(Happens(Event(arrive"),
        (("what did that cost us?", "and without the red car?"), "HowMuch(Measured(delay))"),
        (("would you have slowed without it?", "and without both?", "and without the red one?"),
         SLOWED),
    ],
)  # fmt: skip
def test_a_bare_supposition_is_asked_what_was_asked_before(
    texts: tuple[str, ...], then: str
) -> None:
    act = asked("s3-0", 10.4, *texts)
    assert act.startswith(f"Ask(WhatIf({RED}")
    assert then in act


def test_what_else_we_would_have_chosen_stays_open() -> None:
    act = asked("s1-0", 6.0, "why did you change lanes?", "and without the blue car?")
    assert act == "Ask(WhatIf(Not(Exists(Vehicle(1), Between(3.1, 6)))))"
