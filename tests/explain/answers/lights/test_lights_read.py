"""What is said about a light: that it shows something, is there, or was passed."""

from typing import Any

import pytest

from tests.explain.lit import PASSED, answer
from xavi_dialogue.domain.meaning import Ask, Whether
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Exists,
    Feature,
    Happens,
    Has,
    Is,
    Not,
    Related,
    Vehicle,
)
from xavi_dialogue.explain.answers.lights import lights_seen
from xavi_dialogue.explain.answers.lights.lights_read import (
    may_pass,
    of_another,
    of_showing,
    passing,
    stated,
)

LIGHT, RED, BEND = Feature("light"), Feature("light", colour="red"), Feature("blind")
TURNS = Event("turn-colour", LIGHT, RED)
PASS = Event("pass", Ego(), RED)


@pytest.mark.parametrize(
    ("of", "found"),
    [
        (Has("colour", "red", LIGHT), (LIGHT, "red")),
        (Has("colour", "what", LIGHT), (LIGHT, None)),
        (Has("colour", "red", Vehicle(1)), None),
        (Has("size", "red", LIGHT), None),
        (Happens(TURNS), (LIGHT, "red")),
        (TURNS, (LIGHT, "red")),
        (Event("turn-colour", LIGHT), (LIGHT, None)),
        (Event("show", LIGHT, RED), (LIGHT, "red")),
        (Event("turn-colour", Vehicle(1), Vehicle(2)), None),
        (Event("brake", LIGHT), None),
        (Exists(LIGHT), None),
        (None, None),
    ],
)
def test_what_a_light_is_said_to_show(of: Any, found: Any) -> None:
    assert of_showing(of) == found


@pytest.mark.parametrize(
    ("event", "passes", "may", "another"),
    [
        (PASS, True, False, False),
        (Event("pass", Ego(), Vehicle(1)), False, False, False),
        (Event("brake", Ego(), RED), False, False, False),
        (Event("go", Ego(), where=Related("beside", Ego(), RED)), True, False, False),
        (Event("pass", Vehicle(1), RED), False, False, True),
        (Event("pass", Vehicle(1), Vehicle(2)), False, False, False),
        (Event("brake", Vehicle(1), RED), False, False, False),
        (Event("pass", Ego(), RED, modal="could"), False, True, False),
        (Event("pass", Ego(), RED, modal="should"), False, True, False),
        (Event("pass", Ego(), Vehicle(1), modal="could"), False, False, False),
        (Event("pass", Vehicle(1), RED, modal="could"), False, False, True),
    ],
)
def test_who_is_said_to_pass_a_light(event: Event, passes: bool, may: bool, another: bool) -> None:
    of = Happens(event)
    assert passing(of) == (event if passes else None)
    assert (may_pass(of), of_another(of)) == (may, another)
    assert passing(Not(of)) is None
    assert of_another(Not(of)) is another
    assert stated(of) == (of if passes else None)


@pytest.mark.parametrize("of", [
    Has("colour", "red", LIGHT), Happens(TURNS), Exists(LIGHT), Is("present", LIGHT),
    Related("can-see", Ego(), LIGHT), Not(Exists(LIGHT)),
])  # fmt: skip
def test_what_facts_show_of_a_light(of: Any) -> None:
    assert stated(of) == (of.content if isinstance(of, Not) else of)


@pytest.mark.parametrize("of", [
    Has("size", "big", LIGHT), Exists(Vehicle(1)), Is("far", LIGHT), Is("present", BEND),
    Related("can-see", Ego(), Vehicle(1)), Related("can-see", Vehicle(1), LIGHT),
    Related("behind", Ego(), LIGHT), None,
])  # fmt: skip
def test_what_is_not_about_a_light_is_not_told_of_one(of: Any) -> None:
    assert stated(of) is None


def test_a_light_that_we_passed_was_there_though_it_is_out_of_sight_at_that_moment(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    there = Exists(LIGHT, tense="past")
    seen = answer(Ask(Whether(there)), 45.0)
    monkeypatch.setattr(lights_seen, "shown_at", lambda ride, light, time: None)
    for of, holds in ((there, True), (Not(there), False)):
        found = answer(Ask(Whether(of)), 45.0)
        assert found.holds is holds  # type: ignore[union-attr]
        assert found.passed == pytest.approx(PASSED, abs=0.15)  # type: ignore[union-attr]
        assert found.shown == seen.shown  # type: ignore[union-attr]
    before = answer(Ask(Whether(there)), 20.0)
    assert before.holds is False  # type: ignore[union-attr]
    assert before.shown is None  # type: ignore[union-attr]
