"""Of which decision it is asked what was not done: the one in force, unless another is named."""

import dataclasses
from typing import Any

import pytest
from msgspec import structs

from tests.explain.answers.chosen import EVENTS, STAY, STOP, TRACES, TURN, chosen, deeds
from tests.explain.answers.given import stand_in
from tests.explain.answers.stated import decision
from tests.traces import End
from xavi_dialogue.domain.answers import ChoiceReason, GoReason, SupposedOfUs
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.terms import Event
from xavi_dialogue.explain.answers.reasons import going, refraining
from xavi_dialogue.explain.answers.reasons.against import against
from xavi_dialogue.explain.answers.reasons.choices import why_not
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.suppositions.own_suppositions import of_us

STOPPED = Event("stop")
LATE = {STOP: End(time=20.0)}
#: What the last decision cannot do was last open at the one before.
BARRED = [*TRACES, decision(14.0, STAY, ends=LATE)]
#: The turn is yet to come: what a decision chose need not have been carried out.
COMING = [decision(2.0, STAY, ends=LATE), decision(6.0, TURN, ends=LATE)]


def compared(event: Event, scene: Asked) -> tuple[float, float | None]:
    """When the decision was taken, and when it is told that it could last be done."""
    found = against(event, scene)
    return found.contrast.decided, found.open_at


def inferred(*, leaned: bool) -> Asked:
    """What was spoken of before was at 2 s."""
    scene = chosen(Span(2.0, 2.0))
    return dataclasses.replace(scene, act=structs.replace(scene.act, leaned=leaned))


def test_the_decision_in_force_is_taken_where_nothing_is_named() -> None:
    assert compared(STOPPED, chosen()) == (12.0, None)
    started = deeds(("continue", 0.0, 0.0, 6.0))
    assert compared(STOPPED, chosen(traces=COMING, events=started, now=8.0)) == (6.0, None)
    assert compared(STOPPED, chosen(Span(2.0, 3.0, said=True))) == (2.0, None)


def test_an_older_decision_is_told_with_its_time() -> None:
    right = Event("change-right")
    scene = chosen(traces=BARRED, events=EVENTS)
    assert compared(right, scene) == (12.0, 12.0)
    assert compared(STOPPED, scene) == (14.0, None)
    reason, supposed = why_not(right, scene), of_us(right, scene)
    assert isinstance(reason, ChoiceReason)
    assert isinstance(supposed, SupposedOfUs)
    assert (reason.open_at, supposed.open_at) == (12.0, 12.0)
    assert compared(right, chosen(Span(11.0, 13.0, said=True), traces=BARRED)) == (12.0, None)


def test_what_was_asked_before_counts_only_where_it_is_referred_to() -> None:
    assert compared(STOPPED, inferred(leaned=False)) == (12.0, None)
    assert compared(STOPPED, inferred(leaned=True))[0] == 2.0


@pytest.mark.parametrize("tense", ["past", "perfect"])
def test_keeping_the_lane_is_asked_of_the_change_that_was_made(tense: Any) -> None:
    for span in (None, Span(12.0, 12.0)):
        scene = chosen(span)
        assert compared(Event("keep-lane", tense=tense), scene) == (6.0, None)


def test_a_junction_that_lies_behind_is_not_meant_by_stopping(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    stand_in(monkeypatch, "choices.why_not", "motions.motion")
    monkeypatch.setattr(going, "went", lambda event, scene: GoReason(None, ()))
    left = deeds(("exit-right", 3.0, 4.0, 8.0), ("continue", 8.0, 8.0, None))
    inside = deeds(("exit-right", 3.0, 4.0, None))
    later = [decision(9.0, STAY, ends=LATE)]

    def of_junction(event: Event, span: Span | None = None, events: Any = left) -> bool:
        scene = chosen(span, traces=later, events=events, now=10.0)
        return isinstance(refraining.refrained(event, scene), GoReason)

    assert not of_junction(STOPPED)
    assert of_junction(STOPPED, events=inside)
    assert of_junction(STOPPED, Span(4.0, 8.0, said=True))
    assert of_junction(Event("wait"))
