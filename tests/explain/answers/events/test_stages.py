"""Whether somebody stands or moves, is stuck or late, and whether something is over."""

from typing import Any

import pytest

from planner.record.events import Event as Recorded
from tests.explain.answers.given import NOW, Given, deed, look, plan, their
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import At, Between, Ego, Event, Happens, Is, Vehicle
from xavi_dialogue.explain.answers.events import stages
from xavi_dialogue.explain.answers.reference.findings import Finding

WAIT = Measure("waiting-time", Ego(), NOW, value=3.0)


def test_a_state_is_ours_where_nobody_is_named() -> None:
    assert stages.actor(Is("stuck")) == Ego()
    assert stages.actor(Is("stuck", Vehicle(1))) == Vehicle(1)
    assert stages.actor(Is("over", event=Event("brake", Vehicle(2)))) == Vehicle(2)


@pytest.mark.parametrize(
    ("speed", "stands"), [(0.0, True), (0.13, True), (0.15, False), (8.0, False)]
)
def test_who_is_slower_than_a_crawl_stands(speed: float, stands: bool) -> None:
    asked = Given(looks={1: look(1)}, measures={("speed", Vehicle(1)): speed}).asked()
    assert stages.still(Is("stationary", Vehicle(1)), asked).holds is stands
    found = stages.still(Is("moving", Vehicle(1)), asked)
    assert found.holds is not stands
    assert [fact.value for fact in found.facts] == [speed]  # type: ignore[union-attr]


def test_standing_is_told_of_us_and_of_the_time_asked_about() -> None:
    asked = Given(measures={("speed", Ego()): lambda t: 0.0 if t < 10.0 else 5.0}).asked()
    assert stages.still(Is("stationary"), asked).holds is False
    assert stages.still(Is("stationary", time=At(5.0), tense="past"), asked).holds is True


def test_who_is_not_seen_is_not_told_to_stand() -> None:
    gone = Measure("speed", Vehicle(1), NOW, gap="out-of-view")
    lost = look(1, in_view=False, seen=3.0)
    asked = Given(looks={1: lost}, measures={("speed", Vehicle(1)): gone}).asked()
    found = stages.still(Is("moving", Vehicle(1)), asked)
    assert (found.holds, found.gap, found.facts) == (None, "out-of-view", (lost,))
    nothing = stages.still(Is("moving"), Given().asked())
    assert (nothing.gap, nothing.facts) == ("not-recorded", ())


@pytest.mark.parametrize(("state", "action"), [("stationary", "stand"), ("moving", "move")])
def test_standing_over_a_stretch_is_an_event(
    state: Any, action: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(stages, "happens", lambda of, asked: of)
    time = Between(3.0, 8.0)
    found: Any = stages.still(Is(state, Vehicle(1), time=time, tense="past"), Given().asked())
    assert found == Happens(Event(action, Vehicle(1), time=time))


@pytest.mark.parametrize(("end", "over"), [(15.0, True), (None, False), (NOW, False), (19.9, True)])
def test_what_has_ended_is_over(end: float | None, over: bool) -> None:
    braking = deed("brake", 14.0, end)
    found = stages.over(Is("over", event=Event("brake")), Given(deeds=(braking,)).asked())
    assert (found.holds, found.facts) == (over, (braking,))


@pytest.mark.parametrize(
    ("seen", "over"),
    [
        (look(1), False),
        (look(1, ahead=-1.0), True),
        (look(1, ahead=0.0), False),
        (look(1, in_view=False), True),
        (None, False),
    ],
)
def test_it_is_over_with_a_vehicle_that_is_behind_us_or_gone(seen: Any, over: bool) -> None:
    found = stages.over(Is("over", Vehicle(1)), Given(looks={1: seen}).asked())
    assert found.holds is over
    assert found.facts == (() if seen is None else (seen,))


def over(*deeds: Any, span: Span | None = None, **more: Any) -> Finding:
    return stages.over(Is("over"), Given(deeds=deeds, **more).asked(span))


def test_all_of_it_is_over_where_nothing_worth_telling_goes_on() -> None:
    braked, change = deed("brake", 3.0, 5.0), deed("change-left", 8.0, 11.0)
    assert (over(braked, change).holds, over(braked, change).facts) == (True, (change,))
    waits = deed("wait", 18.0)
    assert (over(braked, waits).holds, over(braked, waits).facts) == (False, (waits,))
    for going in (deed("follow", 15.0), deed("speed-up", 15.0), their(1, "brake", 15.0)):
        assert (over(braked, going).holds, over(braked, going).facts) == (True, (braked,))
    assert over().holds is True
    assert over().facts == ()


def test_what_others_do_to_us_is_told_where_we_do_nothing() -> None:
    cut = their(1, "cut-in", 9.0, 12.0, to=Ego())
    braked = deed("brake", 3.0, 5.0)
    assert over(cut).facts == (cut,)
    assert over(braked, cut).facts == (braked,)
    on = their(1, "cut-in", 19.0, to=Ego())
    assert (over(braked, on).holds, over(braked, on).facts) == (False, (on,))
    ours = deed("brake", 19.5)
    assert over(ours, on).facts == (ours,)


def test_only_what_lies_in_the_time_asked_about_counts() -> None:
    braked, waits = deed("brake", 3.0, 5.0), deed("wait", 18.0)
    found = over(braked, waits, span=Span(2.0, 6.0, said=True))
    assert (found.holds, found.facts) == (True, (braked,))


def test_it_is_over_when_we_are_there() -> None:
    waits = deed("wait", 18.0)
    there = over(waits, events=(Recorded("arrived", 19.0),))
    assert (there.holds, there.facts) == (True, ())
    assert over(waits, ended=True).holds is True


def test_nobody_can_tell_whether_we_are_late_but_when_we_are_there() -> None:
    known = Measure("time-to-go", Ego(), NOW, value=12.0)
    found = stages.late(Is("late"), Given(measures={("time-to-go", Ego()): known}).asked())
    assert (found.holds, found.gap, found.facts) == (None, "unknown-plans", (known,))


def stuck(who: Any, *deeds: Any, speed: float = 0.0, own: float = 0.0, tense: Any = "present"):  # type: ignore[no-untyped-def]
    given = Given(
        deeds=deeds,
        looks={1: look(1)},
        measures={("speed", who): speed},
        traces=(plan(NOW, speed=own),),
    )
    return stages.stuck(Is("stuck", who, tense=tense), given.asked())


@pytest.fixture
def a_wait(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stages, "remaining_wait", lambda asked: WAIT)


@pytest.mark.usefixtures("a_wait")
def test_who_has_stood_for_five_seconds_is_stuck() -> None:
    for begin, holds in ((14.0, True), (15.0, True), (15.1, False)):
        stands = their(1, "stand", begin)
        found = stuck(Vehicle(1), stands)
        assert (found.holds, found.facts) == (holds, (stands,))
    ours, waits = deed("stand", 10.0), deed("wait", 10.0, to=1)
    assert stuck(Ego(), ours).facts == (ours, WAIT)
    assert stuck(Ego(), ours, waits).facts == (waits, WAIT)
    assert stuck(Ego(), ours, own=5.0).facts == (ours,)  # we are rolling


@pytest.mark.usefixtures("a_wait")
def test_who_drives_on_is_not_stuck() -> None:
    stands = their(1, "stand", 10.0)
    for speed, holds in ((0.9, True), (1.0, False), (4.0, False)):
        found = stuck(Vehicle(1), stands, speed=speed)
        assert found.holds is holds
    assert [fact.value for fact in stuck(Vehicle(1), stands, speed=4.0).facts] == [4.0]
    assert stuck(Vehicle(1), speed=0.0).holds is False
    past = stuck(Vehicle(1), their(1, "stand", 10.0, 18.0), speed=4.0, tense="past")
    assert past.holds is False
