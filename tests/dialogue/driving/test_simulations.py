"""How many simulations and options a decision had, and how the simulations ended."""

import re

import pytest

from tests.dialogue.talking import Talk, ride
from xavi_dialogue.nlu.notation import acts_line
from xavi_dialogue.nlu.parse import Parser


def read(text: str) -> str:
    return acts_line(Parser().read(text)[0].acts)


@pytest.mark.parametrize(
    ("text", "acts"),
    [
        ("how many simulations did you run", "Ask(HowMuch(Measured(simulations, tense=past)))"),
        ("count the rollouts", "Ask(HowMuch(Measured(simulations, tense=past)))"),
        (
            "how many rollouts ended in a collision",
            "Ask(HowMuch(Measured(simulations, event=Event(collide), tense=past)))",
        ),
        (
            "in how many of the simulations did we crash?",
            "Ask(HowMuch(Measured(simulations, event=Event(collide), tense=past)))",
        ),
        (
            "How many of your simulations got to the destination?",
            "Ask(HowMuch(Measured(simulations, event=Event(arrive), tense=past)))",
        ),
        ("how many options did you consider", "Ask(HowMuch(Measured(options, tense=past)))"),
        ("How many alternatives were there?", "Ask(HowMuch(Measured(options, tense=past)))"),
    ],
)
def test_simulations_and_options_are_counted_as_such(text: str, acts: str) -> None:
    assert read(text) == acts


@pytest.mark.parametrize(
    "text",
    ["How many simulations did you run?", "how many rollouts were there", "count the simulations"],
)
def test_all_simulations_of_the_last_decision_count(text: str) -> None:
    trace = [t for t in ride("s1-0").traces if t.sim_time <= 3.0 and t.under_way is None][-1]
    said = Talk(at=3.0).hear(text)
    assert f"I ran {len(trace.rollouts)} simulations" in said
    ends = [r.outcome for r in trace.rollouts]
    assert f"{ends.count('done')} reached the goal" in said
    assert "none ended in a collision" in said


@pytest.mark.parametrize(
    "text",
    ["how many of them ended in a crash?", "And how many of those crashed?", "how many crashed"],
)
def test_what_is_counted_next_is_of_the_simulations(text: str) -> None:
    said = Talk(at=3.0).hear("How many simulations did you run?", text)
    assert re.search(r"none of my \d+ simulations ended in a collision", said)


def test_simulations_are_told_by_option() -> None:
    trace = [t for t in ride("s1-0").traces if t.sim_time <= 3.0 and t.under_way is None][-1]
    stops = [r for r in trace.rollouts if r.actions and r.actions[0].action == "stop"]
    said = Talk(at=3.0).hear("How many simulations of stopping did you run?")
    assert f"I ran {len(stops)} simulations of stopping" in said


@pytest.mark.parametrize(
    "text", ["How many options did you consider?", "how many choices did you have?"]
)
def test_options_are_counted_and_named(text: str) -> None:
    said = Talk(at=3.0).hear(text)
    assert re.search(r"I considered \d options: .*stopping.*I chose", said)


@pytest.mark.parametrize(
    "text",
    [
        "How many rollouts did the last decision use, and how many ended in a crash?",
        "how many simulations did you run and how many ended in a collision",
    ],
)
def test_both_counts_of_one_text_are_of_the_simulations(text: str) -> None:
    said = Talk(at=3.0).hear(text)
    assert re.search(r"I ran \d+ simulations.*none of my \d+ simulations ended in", said)


@pytest.mark.parametrize("text", ["What was your worst prediction?", "what was your worst guess"])
def test_the_worst_prediction_is_one_that_was_wrong(text: str) -> None:
    assert read(text) == "Ask(Listing(wrong-predictions))"


@pytest.mark.parametrize(
    "text",
    ["Which vehicle limits our speed right now?", "who limits us", "which one is slowing us down?"],
)
def test_who_limits_us_now_is_who_is_in_our_way(text: str) -> None:
    said = Talk("junction-0", 9.0).hear(text)
    assert "cost us" not in said
    assert "red" in said


@pytest.mark.parametrize("text", ["List every stop we made with its duration.", "list the stops"])
def test_a_stop_at_a_light_is_for_nobody_who_goes_first_at_its_end(text: str) -> None:
    assert "0:16 to 0:26 I stopped;" in Talk("junction-0", 40.0).hear(text)
