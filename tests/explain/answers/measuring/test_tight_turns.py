"""Which of our turns was the tightest."""

import math
from dataclasses import dataclass, field
from typing import Any

import pytest

from tests.explain.answers.given import Given, deed
from xavi_dialogue.domain.answers import DidNotHappen
from xavi_dialogue.domain.meaning import Peak
from xavi_dialogue.domain.terms import Event
from xavi_dialogue.explain.answers.measuring import peak_moments, tight_turns
from xavi_dialogue.explain.answers.reference.asked import Unanswered
from xavi_dialogue.explain.history.motion import Motion

FIRST, SECOND = deed("exit-right", 2.0, 6.0), deed("exit-left", 10.0, 14.0)
TURN = Event("turn")


def test_without_a_turn_there_is_no_tightest_one() -> None:
    with pytest.raises(Unanswered) as raised:
        peak_moments.peak(Peak("tightness", deed=TURN), Given().asked())
    assert isinstance(raised.value.result, DidNotHappen)


@dataclass
class _Ride:
    path: Motion

    def motion(self, vehicle: int) -> Motion:
        del vehicle
        return self.path


@dataclass
class _Asked:
    ride: _Ride
    now: float = 20.0
    deeds: list[Any] = field(default_factory=list)


def test_the_tightest_turn_is_that_with_most_turning_for_its_length() -> None:
    times = tuple(float(t) for t in range(17))
    headings = tuple(
        math.radians(90.0 * min(max(t - 2.0, 0.0) / 4.0, 1.0) + 60.0 * min(max(t - 10.0, 0.0), 1.0))
        for t in times
    )
    path = Motion(times, tuple((6.0 * t, 0.0) for t in times), headings, (6.0,) * len(times))
    asked: Any = _Asked(_Ride(path))
    assert tight_turns._curvature(asked, SECOND) > tight_turns._curvature(asked, FIRST) > 0.0
