"""Whether another vehicle braked because of us."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.explain.answers.given import NOW, Given, deed, look, their
from xavi_dialogue.domain.answers import (
    MotionCause,
    NoSuchVehicle,
    OtherReason,
)
from xavi_dialogue.domain.facts import Belief
from xavi_dialogue.domain.meaning import Whether, Why
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Happens,
    Vehicle,
)
from xavi_dialogue.explain.answers.reasons import others, provoked

ONE = Vehicle(1)


BRAKED = their(1, "brake", 10.0, 13.0)
BELIEF = Belief(1, NOW, ())


def because(found: Any, patch: pytest.MonkeyPatch, tense: Any = "past", **more: Any) -> Any:
    def why(event: Event, scene: Any, negated: bool) -> Any:
        assert (event, negated) == (Event("brake", ONE, tense=tense), False)
        return found

    patch.setattr(others, "why", why)
    given = {"looks": {1: look(1, ahead=-15.0)}} | more
    asked = Given(**given).asked()
    event = Event("brake", ONE, tense=tense, modal="would")
    return provoked.because_of_us(Why(Happens(event)), asked)


LEADER, US = MotionCause("leader", 2), MotionCause("leader", 0)


def test_who_braked_for_us_has_us_as_its_first_cause(monkeypatch: pytest.MonkeyPatch) -> None:
    both = OtherReason(1, BRAKED, causes=(LEADER, US))
    told = because(both, monkeypatch)
    assert (told.causes, told.ours) == ((US, LEADER), True)
    other = because(OtherReason(1, BRAKED, causes=(LEADER,)), monkeypatch)
    assert (other.causes, other.ours) == ((LEADER,), False)
    nothing = OtherReason(1, None)
    assert because(nothing, monkeypatch) == nothing
    refusal = NoSuchVehicle(ONE, NOW)
    assert because(refusal, monkeypatch) == refusal


def test_what_was_done_instead_is_left_as_it_is_unless_it_was_for_us(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked = Event("stop", ONE)
    other = OtherReason(1, BRAKED, asked=asked, causes=(LEADER,))
    assert because(other, monkeypatch) == other
    ours = because(replace(other, causes=(US,)), monkeypatch)
    assert (ours.asked, ours.ours) == (None, True)


def test_a_braking_that_goes_on_is_told_up_to_now_where_it_is_past(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    going = OtherReason(1, their(1, "brake", 18.0), causes=(US,))
    assert because(going, monkeypatch).deed.end == NOW
    assert because(going, monkeypatch, "perfect").deed.end == NOW
    assert because(going, monkeypatch, "present").deed.end is None
    over = OtherReason(1, BRAKED, causes=(US,))
    assert because(over, monkeypatch).deed == BRAKED


def came_in(begin: float, end: float, seen: Any = None, at: Any = None, action: Any = "merge"):  # type: ignore[no-untyped-def]
    """Whether it is told to brake at 10 s for our coming in ahead of it."""
    with pytest.MonkeyPatch.context() as patch:
        behind = look(1, ahead=-15.0, distance=10.0) if seen is None else seen
        ahead = {("ahead-of", Ego(), ONE): True if at is None else lambda t: t == at}
        return because(
            OtherReason(1, BRAKED, causes=(LEADER,), goal=BELIEF),
            patch,
            looks={1: behind},
            deeds=(deed(action, begin, end),),
            relations=ahead,
        )


@pytest.mark.parametrize(
    ("begin", "end", "ours"),
    [(8.0, 11.0, True), (3.0, 6.0, True), (3.0, 5.9, False), (10.0, 12.0, True),
     (10.1, 12.0, False)],
)  # fmt: skip
def test_who_brakes_just_after_we_came_in_brakes_for_us(
    begin: float, end: float, ours: bool
) -> None:
    found = came_in(begin, end)
    assert found.ours is ours
    assert found.causes == ((MotionCause("cut-in", 0),) if ours else (LEADER,))
    assert found.goal == (None if ours else BELIEF)


@pytest.mark.parametrize(
    ("seen", "ours"),
    [
        (look(1, ahead=-15.0, distance=60.0), True),
        (look(1, ahead=-15.0, distance=60.1), False),
        (look(1, ahead=1.0, distance=10.0), False),
        (look(1, ahead=-15.0, distance=10.0, in_view=False), False),
    ],
)
def test_only_who_is_close_behind_brakes_for_us(seen: Any, ours: bool) -> None:
    assert came_in(8.0, 11.0, seen).ours is ours


def test_we_may_come_in_ahead_of_it_two_seconds_later() -> None:
    assert came_in(8.0, 13.0, at=12.0).ours is True
    assert came_in(8.0, 13.0, at=10.0).ours is True
    assert came_in(8.0, 13.0, at=11.0).ours is False
    assert came_in(8.0, 11.0, action="overtake").ours is False


@pytest.mark.parametrize("modal", [None, "must"])
def test_whether_somebody_braked_for_us_is_told_with_the_reason(
    monkeypatch: pytest.MonkeyPatch, modal: Any
) -> None:
    both = OtherReason(1, BRAKED, causes=(LEADER, US))
    monkeypatch.setattr(others, "why", lambda event, scene, negated: both)
    question = Whether(Happens(Event("brake", ONE, Ego(), tense="past", modal=modal)))
    explain = provoked.explainer(question)
    assert explain is not None
    assert explain(question, Given(looks={1: look(1)}).asked()).ours is True
    for other in (Event("brake", ONE, tense="past"), Event("brake", Ego(), ONE, tense="past")):
        assert provoked.explainer(Whether(Happens(other))) is None
    assert provoked.explainer(Whether(Happens(Event("brake", ONE, Ego(), tense="future")))) is None
