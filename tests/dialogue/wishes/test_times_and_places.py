"""Times and places that hang on what was said before, or on which of several is meant."""

import pytest

from tests.dialogue.talking import Talk


@pytest.mark.parametrize(
    ("at", "texts", "told"),
    [
        (36.0, ("how long did we wait at the light?", "during that stop, who was next to us?"),
         "green bicycle"),
        (36.0, ("how fast are we going?", "what was it at 0:20?"), "At 0:20"),
        (36.0, ("How fast is the bicycle going?", "and what was it at 0:25?"), "At 0:25"),
        (36.0, ("When did the light turn green?", "When did you start to turn?",
                "Between those two moments, to whom did you yield?"), "green bicycle"),
        (50.0, ("At the second crossing, who walked in front of us?",), "vehicle 13"),
        (50.0, ("At the second crossing, who walked in front of us?", "and at the first one?"),
         "vehicle 10"),
        (50.0, ("How close did the pedestrian at the second crossing come to us?",),
         "vehicle 13"),
    ],
)  # fmt: skip
def test_a_time_is_that_of_what_was_spoken_of(at: float, texts: tuple[str, ...], told: str) -> None:
    assert told in Talk("junction-0", at).hear(*texts)


@pytest.mark.parametrize(
    ("texts", "when"),
    [
        (("How fast were you in the second turn?",), "At 0:44"),
        (("How fast were you in the second turn?", "and in the first?"), "At 0:26"),
        (("how fast did you take the first bend?",), "At 0:26"),
        (("How fast did we go through the second bend?",), "At 0:44"),
        (("how fast did you take the first bend?", "and the second one?"), "At 0:44"),
        (("how long did the first turn take?", "and the second?"), "I turned left for"),
        (("where were we slowest, and how fast was that?",), "when I turned right"),
        (("What was the slowest we went since we left, and where?",), "in the junction"),
    ],
)
def test_one_of_several_turns_is_asked_about(texts: tuple[str, ...], when: str) -> None:
    assert when in Talk("town-0", 47.0).hear(*texts)


@pytest.mark.parametrize(
    "text", ["is the worst over now?", "is the danger over?", "are we out of the woods now?"]
)
def test_whether_the_worst_is_over_is_whether_it_is_safe(text: str) -> None:
    assert Talk("s1-0", 14.0).hear(text).startswith("Yes, it is safe")


@pytest.mark.parametrize("text", ["Is there nobody in front of us?", "nobody is before us"])
def test_nobody_in_front_of_us_is_of_our_lane(text: str) -> None:
    assert "nobody is ahead of us" in Talk("city-0", 15.0).hear(text)
    assert "the white lorry" in Talk("motorway-0", 10.0).hear(text)


def test_that_time_is_when_the_last_question_was_asked() -> None:
    talk = Talk("s1-0", 4.0)
    talk.hear("Why are you moving left?")
    assert talk.say("How fast were we at that time?", 8.0).reply.text.startswith("At 0:04")


def test_who_was_beside_us_while_we_stood_is_who_was_there_at_any_time_of_it() -> None:
    told = Talk("junction-0", 36.0).hear("While we were stopped at the lights, who was beside us?")
    assert "green bicycle" in told


def test_a_second_later_is_counted_from_the_moment_that_was_told() -> None:
    talk = Talk("junction-0", 44.0)
    talk.hear("what speed were we doing at 38 seconds?")
    assert talk.hear("and what was it three seconds later?").startswith("At 0:41")
