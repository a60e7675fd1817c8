"""Halves: each of two questions in one gets its own answer."""

import pytest

from tests.dialogue.following.asking import asked, told


@pytest.mark.parametrize(
    "text",
    [
        "State the time at which the light changed to green and the time at which you set off.",
        "give me the moment the light went green and the moment we set off",
        "tell me when the light turned green and when we set off",
    ],
)
def test_both_moments_are_told(text: str) -> None:
    acts = asked("junction-0", 36.0, text)
    assert acts.count("Ask(When(") == 2
    reply = told("junction-0", 36.0, text)
    assert "turned green" in reply
    assert "I moved on" in reply


@pytest.mark.parametrize(
    "text",
    [
        "How sure are you that the blue car turns off and what do you make of it for your plan?",
        "how likely is it that the blue car turns and what follows from that for your plan?",
        "how sure are you that the blue one turns, and what does that mean for us?",
    ],
)
def test_what_follows_for_the_plan_is_what_we_are_going_to_do(text: str) -> None:
    acts = asked("s1-0", 4.0, text)
    assert acts.startswith("Ask(HowSure(")
    assert acts.endswith("Ask(Doing(time=Next, tense=future))") or "Ask(Doing(" in acts
    reply = told("s1-0", 4.0, text)
    assert "I put the chance" in reply
    assert "straight on" in reply


@pytest.mark.parametrize(
    "text",
    [
        "What made the left lane better, and by how much?",
        "What made the left lane the better option, and by how much?",
    ],
)
def test_reason_and_amount_are_told(text: str) -> None:
    reply = told("s1-0", 4.0, text)
    assert "because I expect" in reply
    assert "seconds" in reply
    assert "did not get" not in reply


@pytest.mark.parametrize(
    "text", ["by how much is the left lane better than ours?", "how much better is the left lane?"]
)
def test_by_how_much_a_lane_is_better_is_why_it_is(text: str) -> None:
    assert asked("s1-0", 4.0, text).startswith("Ask(Why(Compares(Measured(value, Lane(left")


@pytest.mark.parametrize(
    "text",
    [
        "summarise in one sentence why that right turn took so long",
        "sum up why that turn took us so long",
        "why did that right turn take so long?",
    ],
)
def test_why_a_turn_took_long_is_told_over_the_episode(text: str) -> None:
    reply = told("junction-0", 50.0, text)
    assert reply.startswith("Most time was lost between")
    assert "because of the traffic light" in reply
