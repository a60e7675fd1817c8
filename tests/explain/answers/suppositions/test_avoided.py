"""What could have been avoided: what happened, and when."""

from typing import Any

import pytest

from planner.record.events import Event as RideEvent
from tests.explain.answers.chosen import chosen
from tests.explain.answers.stated import did, driven, result
from tests.explain.answers.suppositions.test_deciding import told
from xavi_dialogue.domain.answers import (
    Avoidance,
    ChoiceReason,
    DidNotHappen,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import HowAvoid
from xavi_dialogue.domain.terms import Event, Happens
from xavi_dialogue.explain.answers.suppositions.deciding import (
    how_avoid,
)
from xavi_dialogue.explain.causes.plans import avoidance

# --- how to avoid it ----------------------------------------------------------------------------


@pytest.fixture
def avoided(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """What is to be avoided, and when it happened."""
    asked: list[Any] = []

    def avoiding(_: Any, mishap: Any, moment: float) -> Avoidance:
        asked.append((mishap, moment))
        return Avoidance(mishap, True, True, 0.5, 0.0, 1, 1)

    monkeypatch.setattr(avoidance, "avoiding", avoiding)
    return asked


def avoid(event: Event | None, **facts: Any) -> Any:
    return told(how_avoid, HowAvoid(None if event is None else Happens(event)), **facts)


CRASH = [RideEvent("collided", 15.0, vehicle=1)]
#: We brake hard from 4 s on, and once more, gently, from 10 s on.
HARD = {0: driven([0.0] * 60, step=0.2, speed=[
    *[14.0] * 20, *[14.0 - 0.8 * k for k in range(1, 11)], *[6.0] * 20,
    *[6.0 - 0.1 * k for k in range(1, 11)],
])}  # fmt: skip


def test_a_collision_is_the_worst_that_happened(avoided: list[Any]) -> None:
    for event in (None, Event("collide")):
        found = avoid(event, events=CRASH, motions=HARD)
        assert avoided[-1] == ("collide", 15.0)
        assert found.impact is not None
        assert (found.impact.action, found.impact.begin) == ("collide", 15.0)
    missing = avoid(Event("collide"), motions=HARD)
    assert missing == DidNotHappen(Event("collide"))
    stopped = (did("stop", 12.0, 14.0),)
    found = avoid(Event("stop"), events=CRASH, episodes=stopped)
    assert (avoided[-1], found.impact) == (("stop", 12.0), None)


def test_else_it_is_hard_braking_or_the_last_slowing(avoided: list[Any]) -> None:
    slowed = (did("brake", 3.0, 5.0), did("give-way", 9.0, 11.0), did("overtake", 14.0, 15.0))
    avoid(None, motions=HARD, episodes=slowed)
    assert avoided[-1] == ("brake", pytest.approx(3.8, abs=0.21))
    avoid(None, episodes=slowed)
    assert avoided[-1] == ("give-way", 9.0)
    for action in ("slow-down", "brake"):
        avoid(Event(action), motions=HARD, episodes=slowed)
        assert avoided[-1] == ("slow-down", 3.0)
    avoid(Event("give-way"), episodes=(*slowed, did("wait", 16.0, 17.0)))
    assert avoided[-1] == ("give-way", 9.0)
    avoid(Event("follow"), episodes=slowed)
    assert avoided[-1] == ("give-way", 9.0)  # anything that slowed us
    assert avoid(None) == DidNotHappen(Event("happen"))
    assert avoid(Event("stop"), episodes=slowed) == DidNotHappen(Event("stop"))
    then = chosen(Span(3.0, 4.0, said=True), episodes=slowed)
    result(how_avoid, HowAvoid(), then)
    assert avoided[-1] == ("slow-down", 3.0)


def test_a_choice_is_avoided_by_the_alternative() -> None:
    found = avoid(Event("change-left"))
    assert isinstance(found, ChoiceReason)
    assert (found.form, found.contrast.decided) == ("necessary", 6.0)
    assert isinstance(avoid(Event("avoid")), DidNotHappen)
