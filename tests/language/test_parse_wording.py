"""Wordings that are easily got wrong: who acts, what "not" belongs to, what is no question."""

import pytest

from tests.language.annotated import parse, query
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.parse import NotUnderstood

MEANT = [  # (text, what must hold of its query)
    ("Why were we overtaken by vehicle 3?", {"actor": "vehicle:3", "factual": ("overtake",)}),
    ("Why did we get overtaken by vehicle 3?", {"actor": "vehicle:3", "factual": ("overtake",)}),
    ("The truck, where is that off to?", {"actor": "vehicle:truck", "type": "where_goal"}),
    ("Vehicle 2, why did it stop?", {"actor": "vehicle:2", "factual": ("stop",)}),
    ("Why did vehicle 1 and vehicle 2 stop?", {"actor": "vehicle:both"}),
    ("Why did vehicle 007 stop?", {"actor": "vehicle:7"}),
    ("Why did vehicle ٣ stop?", {"actor": "vehicle:3"}),
    ("Why did vehicle one hundred stop?", {"actor": "vehicle:100"}),
    ("What would you have done unless vehicle 1 had stopped?", {"negated": True}),
    ("What if there was nobody else around?", {"negated": True, "actor": "vehicle:both"}),
    ("Why did you stop when vehicle 1 did not turn left?", {"type": "why", "factual": ("stop",)}),
    ("You stopped, didn't you?", {"type": "what", "factual": ("stop",)}),
    ("You are slowing down, right?", {"type": "what", "factual": ("slow-down",)}),
    ("whyis vehicle 3 turning left", {"type": "why", "actor": "vehicle:3"}),
    ("why u stopped", {"type": "why", "factual": ("stop",)}),
    ("what'd you do if vehicle 1 stopped?", {"type": "what_if", "tense": "future"}),
    ("you could of stopped", {"type": "why_not", "counterfactual": ("stop",)}),
    ("Why did you go left?", {"factual": ("exit-left",), "underspecified": "manoeuvre"}),
    ("why did we swerve", {"factual": ("change-left",), "underspecified": "direction"}),
    ("did vehicle 1 or vehicle 2 make you stop", {"actor": "ego", "factual": ("stop",)}),
    ("Why did you move from the left to the right lane?", {"factual": ("change-right",)}),
]


@pytest.mark.parametrize(("text", "holds"), MEANT)
def test_what_is_meant(text: str, holds: dict[str, object]) -> None:
    found = query(text)
    assert {name: getattr(found, name) for name in holds} == holds


@pytest.mark.parametrize(
    "text",
    [
        "Why did the pedestrian stop?",
        "Where is the cyclist going?",
        "Why did the tram slow down?",
        "Why did Germany turn right?",
        "Why is the sky blue?",
    ],
)
def test_what_others_do_is_not_laid_to_the_car(text: str) -> None:
    assert query(text).type == "out_of_scope"


BEFORE = "Why did you stop?"


@pytest.mark.parametrize(
    ("text", "holds"),
    [
        ("Was it vehicle 2?", {"actor": "ego", "hypothesised_cause": "vehicle:2"}),
        ("why?", {"type": "why", "factual": ("stop",), "detail": "more"}),
        ("and before that?", {"type": "why"}),
        ("Same for vehicle 4?", {"actor": "vehicle:4", "factual": ("stop",)}),
    ],
)
def test_follow_ups(text: str, holds: dict[str, object]) -> None:
    found = query(text, BEFORE)
    assert {name: getattr(found, name) for name in holds} == holds


def test_another_vehicle_is_another_condition() -> None:
    asked = "Would you still have stopped if vehicle 2 had not been there?"
    found = query("and without vehicle 1?", asked)
    assert isinstance(found, Query)
    assert (found.type, found.actor) == ("sensitivity", "ego")
    assert found.condition == "without vehicle 1"


@pytest.mark.parametrize("digit", ["❷", "❼", "፩", "②", "½", "٣", "００7"])
def test_digits_of_any_script_are_words_like_others(digit: str) -> None:
    asked = parse(f"Why did vehicle {digit} two stop?")
    assert isinstance(asked, Query | NotUnderstood)
    assert isinstance(parse(digit), Query | NotUnderstood)
