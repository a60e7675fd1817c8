"""What held us up until shortly before we drove on, and no longer does."""

from types import SimpleNamespace
from typing import Any

import pytest

from tests.explain.answers.given import NOW, Given, deed, look, plan
from xavi_dialogue.domain.answers import MotionCause
from xavi_dialogue.domain.evidence import Evidence
from xavi_dialogue.explain.causes.driving import freed as freeing
from xavi_dialogue.explain.causes.driving.freed import driven_for, freed
from xavi_dialogue.explain.causes.driving.stated_reasons import Reasons

STOOD, SLOWED = deed("stand", 12.0, 18.0), deed("slow-down", 8.0, 17.0)


@pytest.fixture(autouse=True)
def reasons(monkeypatch: pytest.MonkeyPatch) -> dict[Any, Any]:
    """Reasons for each way of driving, by its name; no light held us."""
    known: dict[Any, Any] = {}

    def told(ride: Any, world: Any, done: Any, at: float | None) -> Any:
        causes = (known[done.action],) if done.action in known else ()
        known["at", done.action] = at
        return Reasons(causes, None, Evidence(), plan(NOW))

    monkeypatch.setattr(freeing, "reasons_for", told)
    monkeypatch.setattr(freeing, "holds", lambda ride, vehicle: ())
    return known


def rising(vehicle: int, before: float, after: float, at: float = 18.0) -> Any:
    """Somebody whose speed [m/s] changes after a moment [s]."""
    return lambda time: look(vehicle, speed=before if time <= at else after)


def free(*deeds: Any, time: float = NOW, **looks: Any) -> MotionCause | None:
    seen = {int(name[1:]): known for name, known in looks.items()}
    asked = Given(deeds=deeds, looks=seen).asked()
    return freed(asked.ride, asked.world, time)


def test_who_went_first_has_let_us_go(reasons: dict[Any, Any]) -> None:
    reasons["stand"] = MotionCause("right-of-way", 1)
    assert free(STOOD) == MotionCause("let-go", 1)
    assert reasons["at", "stand"] == 18.0  # as it ended


@pytest.mark.parametrize(("after", "moved"), [(1.1, True), (1.0, False), (0.0, False)])
def test_who_stood_ahead_has_moved_on(after: float, moved: bool, reasons: dict[Any, Any]) -> None:
    reasons["stand"] = MotionCause("leader", 1)
    found = free(STOOD, v1=rising(1, 0.0, after))
    assert found == (MotionCause("moved-on", 1) if moved else None)
    assert free(STOOD) is None  # it was not seen


def test_the_last_that_held_us_up_counts(reasons: dict[Any, Any]) -> None:
    reasons["stand"] = MotionCause("right-of-way", 1)
    reasons["slow-down"] = MotionCause("right-of-way", 2)
    assert free(SLOWED, STOOD) == MotionCause("let-go", 1)
    assert free(SLOWED) == MotionCause("let-go", 2)
    assert free(deed("slow-down", 13.0, 17.0), STOOD) == MotionCause("let-go", 2)


@pytest.mark.parametrize(("end", "lately"), [(16.0, True), (15.9, False)])
def test_what_ended_long_ago_does_not_explain_it(
    end: float, lately: bool, reasons: dict[Any, Any]
) -> None:
    reasons["stand"] = MotionCause("right-of-way", 1)
    found = free(deed("stand", 12.0, end))
    assert found == (MotionCause("let-go", 1) if lately else None)
    assert free(deed("stand", NOW + 1.0)) is None
    assert free(deed("follow", 12.0, 18.0)) is None


def test_what_still_goes_on_is_looked_at_now(reasons: dict[Any, Any]) -> None:
    reasons["stand"] = MotionCause("right-of-way", 1)
    assert free(deed("stand", 12.0)) == MotionCause("let-go", 1)
    assert reasons["at", "stand"] == NOW
    free(deed("stand", 12.0, NOW + 5.0))
    assert reasons["at", "stand"] == NOW


def test_what_is_nobody_does_not_let_us_go(reasons: dict[Any, Any]) -> None:
    assert free(STOOD) is None
    reasons["stand"] = MotionCause("turn")
    assert free(STOOD) is None
    assert free() is None


@pytest.mark.parametrize(
    ("begin", "end", "colour", "begun", "lit"),
    [
        (5.0, 19.0, "green", True, True),
        (5.0, 12.0, "green", True, True),
        (5.0, 11.9, "green", True, False),  # long ago
        (5.0, 24.0, "green", True, True),
        (5.0, 24.1, "green", True, False),
        (20.0, 21.0, "green", True, False),  # it held us only later
        (5.0, 19.0, "red", True, False),
        (5.0, 19.0, "green", False, False),  # nobody saw it turn
    ],
)
def test_the_light_that_turned_green_freed_us(
    begin: float, end: float, colour: str, begun: bool, lit: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown = SimpleNamespace(colour=colour, begun=begun)
    hold = SimpleNamespace(begin=begin, end=end, signal="J")
    monkeypatch.setattr(freeing, "holds", lambda ride, vehicle: (hold,))
    monkeypatch.setattr(freeing, "shown", lambda ride, signal, time: signal)
    monkeypatch.setattr(freeing, "told", lambda ride, signal, now, light: shown)
    found = free()
    assert found == (MotionCause("light", shown=shown) if lit else None)  # type: ignore[arg-type]


def test_speeding_up_is_told_with_what_held_us_up_first(reasons: dict[Any, Any]) -> None:
    reasons["stand"] = MotionCause("right-of-way", 1)
    reasons["speed-up"] = MotionCause("starting")
    asked = Given(deeds=(STOOD,)).asked()
    found = driven_for(asked.ride, asked.world, deed("speed-up", 19.0))
    assert found.causes == (MotionCause("let-go", 1),)
    reasons["speed-up"] = MotionCause("limit")
    found = driven_for(asked.ride, asked.world, deed("speed-up", 19.0))
    assert found.causes == (MotionCause("let-go", 1), MotionCause("limit"))
    reasons["move"] = MotionCause("limit")
    assert driven_for(asked.ride, asked.world, deed("move", 19.0)).causes == (MotionCause("limit"),)
