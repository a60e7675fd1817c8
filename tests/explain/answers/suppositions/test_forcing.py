"""Whether another vehicle would have had to brake if we had gone first; at 20 s."""

from typing import Any

import pytest

from tests.explain.answers.stated import did, scene
from xavi_dialogue.domain.answers import MotionReason, Unslowed
from xavi_dialogue.domain.meaning import Doing, Whether
from xavi_dialogue.domain.terms import Event, Happens, Vehicle
from xavi_dialogue.explain.answers.suppositions import forcing

IT = Vehicle(1)
MET = Unslowed(did("brake", 5.0, 8.0), None, ours=10.0, theirs=12.0, vehicle=1, form="forces")
FIRST = Event("go", manner=("first",), tense="perfect")


class Tried:
    """Stand in for what would follow if we went first; keep who was asked about."""

    def __init__(self, patch: pytest.MonkeyPatch, found: Any = MET) -> None:
        self.asked: list[Any] = []
        self.found = found
        patch.setattr(forcing, "hastened", self._hastened)

    def _hastened(self, *args: Any) -> Any:
        self.asked.append(args[2:])
        return self.found

    def forced(self, event: Event | None, then: Any, *, negated: bool = False) -> Any:
        return forcing.forced(event, then, scene(), negated=negated)


def brakes(action: Any = "brake", actor: Any = IT) -> Whether:
    return Whether(Happens(Event(action, actor, modal="would")))


def test_who_is_first_shows_whether_it_would_have_braked(monkeypatch: pytest.MonkeyPatch) -> None:
    tried = Tried(monkeypatch)
    assert tried.forced(FIRST, brakes()) == MET
    assert tried.asked == [("forces", 1)]
    for action in ("slow-down", "stop", "wait", "give-way", "swerve"):
        assert tried.forced(FIRST, brakes(action)) == MET
    assert tried.forced(Event("brake"), brakes(), negated=True) == MET


def test_all_else_is_not_shown_by_it(monkeypatch: pytest.MonkeyPatch) -> None:
    tried = Tried(monkeypatch)
    for then in (None, Doing(), brakes("turn"), brakes(actor=Event("go").actor)):
        assert tried.forced(FIRST, then) is None
    for event in (None, Event("go", IT), Event("change-left"), Event("brake")):
        assert tried.forced(event, brakes()) is None
    assert tried.forced(FIRST, brakes(), negated=True) is None
    assert tried.asked == []
    other = Tried(monkeypatch, MotionReason(did("brake", 5.0), ()))
    assert other.forced(FIRST, brakes()) is None
