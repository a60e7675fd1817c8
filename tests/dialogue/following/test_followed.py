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


@pytest.mark.parametrize("follow_up", ["and if nobody had been there?", "and without anybody?"])
def test_the_same_is_asked_with_nobody_there(follow_up: str) -> None:
    act = asked("s3-0", 10.4, "would you have slowed down without the blue car?", follow_up)
    assert act.startswith("Ask(WhatIf(")
    assert "slow-down, modal=would" in act


@pytest.mark.parametrize("follow_up", ["and the one before that?", "and the one before?"])
@pytest.mark.parametrize(
    ("first", "found"),
    [
        ("why did you brake?", "Ask(Why(Happens(Event(brake, time=Between(0, "),
        ("what did the last stop cost us?", "Ask(HowMuch(Measured(delay, event=Event(stop, time="),
    ],
)
def test_the_one_before_is_the_same_deed_sooner(first: str, found: str, follow_up: str) -> None:
    assert asked("city-0", 40.0, first, follow_up).startswith(found)


@pytest.mark.parametrize(
    ("text", "found"),
    [("when?", "HowMuch(Measured(distance"), ("where exactly?", "HowMuch(Measured(distance"),
     ("and the lorry?", "HowMuch(Measured(distance")],
)  # fmt: skip
def test_who_leaves_the_question_before_under_discussion(text: str, found: str) -> None:
    act = asked("motorway-0", 30.0, "how close did we get to anyone?", "who?", text)
    assert act.startswith(f"Ask({found}")
