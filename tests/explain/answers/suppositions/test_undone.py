"""What we could do now but do not, and going on as going straight on."""

from types import SimpleNamespace
from typing import Any

import pytest

from planner.record.trace import Action
from xavi_dialogue.domain.terms import Ego, Event, Vehicle
from xavi_dialogue.explain.answers.suppositions import undone
from xavi_dialogue.explain.answers.suppositions.undone import is_present, stops, straight

NOW = 20.0
GO = Event("go", tense="present")


def scene(*plan: Action, past: Any = None) -> Any:
    """A setting of which only the plan in force and the time asked about are known."""
    latest = SimpleNamespace(plan=[SimpleNamespace(action=action) for action in plan])
    ride = SimpleNamespace(latest=latest, traces=(latest,) if plan else ())
    return SimpleNamespace(now=NOW, past=past, ride=ride)


@pytest.fixture(autouse=True)
def risk(monkeypatch: pytest.MonkeyPatch) -> None:
    """Going straight on has a risk here, if it is planned to turn."""
    monkeypatch.setattr(
        undone,
        "risky_onward",
        lambda ride: 0.3 if ride.latest.plan[0].action == "exit-left" else None,
    )


def straightened(event: Event) -> Event:
    return Event("exit-straight", event.actor, tense=event.tense, manner=event.manner)


@pytest.mark.parametrize("form", ["crash", "chance", "safe", "dangerous"])
def test_the_risk_of_going_on_is_that_of_going_straight_on(form: Any) -> None:
    assert straight(GO, scene("exit-left"), form) == straightened(GO)
    # Where that has none, or we stop, it is just going on.
    assert straight(GO, scene("exit-right"), form) == GO
    assert straight(GO, scene("stop"), form) == GO
    fast = Event("go", tense="present", manner=("fast",))
    assert straight(fast, scene("exit-left"), form) == fast


@pytest.mark.parametrize("form", ["better", "whether", "do"])
def test_other_questions_about_going_on_are_about_just_that(form: Any) -> None:
    assert straight(GO, scene("exit-left"), form) == GO


@pytest.mark.parametrize("form", ["safe", "better"])
def test_straight_on_is_said_so(form: Any) -> None:
    said = Event("go", side="straight", tense="present")
    assert straight(said, scene("exit-right"), form) == straightened(said)
    assert straight(said, scene("stop"), form) == straightened(said)
    assert straight(said, scene(), form) == said  # nothing was decided
    left = Event("go", side="left", tense="present")
    assert straight(left, scene("exit-left"), form) == left
    halt = Event("stop", side="straight", tense="present")
    assert straight(halt, scene("exit-left"), form) == halt


def test_we_stop_where_the_plan_begins_so() -> None:
    assert stops(scene("stop", "continue"))
    assert not stops(scene("continue", "stop"))
    assert not stops(scene())


@pytest.mark.parametrize(
    ("tense", "begin", "present"),
    [
        ("present", None, True), ("past", None, True), ("perfect", None, False),
        ("present", 20.0, True), ("present", 15.0, False),
    ],
)  # fmt: skip
def test_what_is_supposed_of_now(tense: Any, begin: float | None, present: bool) -> None:
    past = None if begin is None else SimpleNamespace(begin=begin)
    assert is_present(Event("go", tense=tense), scene("stop", past=past)) is present


def test_only_we_can_leave_something_undone_now() -> None:
    asked = scene("stop")
    assert not undone.is_undone(Event("go", Vehicle(1), tense="present"), asked)
    assert not undone.is_undone(Event("go", Ego(), tense="past"), asked)
