"""Why we did not wait, stop, slow down or stay behind somebody: whom that is asked of, and what."""

from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.events import Event as Recorded
from tests.explain.answers.given import NOW, Given, Told, deed, look, plan, refused, stand_in
from xavi_dialogue.domain.answers import (
    CrossingVehicle,
    DidNotHappen,
    GoReason,
    MotionReason,
    NeedRollout,
    Priority,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.terms import Ego, Event, Related, Vehicle
from xavi_dialogue.explain.answers.reasons import going, motions, refraining
from xavi_dialogue.explain.answers.reference.asked import Unanswered
from xavi_dialogue.explain.answers.reference.moments import Window

ONE = Vehicle(1)
BEHIND = Related("behind", Ego(), ONE)


def raising(result: Any) -> Any:
    def explain(*args: Any, **more: Any) -> Any:
        raise Unanswered(result)

    return explain


@pytest.fixture(autouse=True)
def explainers(monkeypatch: pytest.MonkeyPatch) -> None:
    stand_in(monkeypatch, "choices.why_not", "motions.motion", "motions.fast", "going.went")
    monkeypatch.setattr(refraining, "leads", lambda world, vehicle, time: vehicle == 1)
    rule = Priority(NOW, "give-way", 1)
    monkeypatch.setattr(refraining, "priority_at", lambda *args, **more: rule)


def done(action: Any, begin: float, end: float | None = None) -> tuple[Any, ...]:
    """The events of something that we did."""
    started = (
        Recorded("action-started", begin, action, 1),
        Recorded("action-committed", begin, action),
    )
    return started if end is None else (*started, Recorded("action-ended", end, action))


def scene(span: Span | None = None, **more: Any) -> Any:
    given = {"looks": {1: look(1)}, "traces": (plan(NOW),)} | more
    return Given(**given).asked(span)


def refrained(event: Event, span: Span | None = None, **more: Any) -> Any:
    found = refraining.refrained(event, scene(span, **more))
    if isinstance(found, Told):
        return found.by, tuple(one for one in found.args if not hasattr(one, "world"))
    return found


CHANGED = done("change-left", 15.0, 17.0)
KEEP, CHANGE = Event("keep-lane"), Event("change-left", tense="past")
INSTEAD = ("choices.why_not", (KEEP, CHANGE))


# --- after a change of lanes --------------------------------------------------------------------


@pytest.mark.parametrize(
    "event",
    [
        Event("follow", object=ONE),
        Event("keep-distance"),
        Event("keep-lane"),
        Event("wait", where=BEHIND),
        Event("slow-down", object=ONE),  # who was ahead of us as we changed
        Event("brake", object=ONE),
        Event("wait"),
        Event("let-go"),
    ],
)
def test_not_staying_behind_is_asked_of_the_change_of_lanes(event: Event) -> None:
    assert refrained(event, events=CHANGED) == INSTEAD


def test_what_is_compared_by_itself_is_not_asked_of_the_change() -> None:
    for event in (Event("stop"), Event("slow-down", object=Vehicle(2)), Event("brake")):
        assert refrained(event, events=CHANGED) != INSTEAD


def test_a_change_is_told_as_of_its_time() -> None:
    going = done("change-right", 18.0)
    event = Event("keep-lane", tense="present")
    found = refrained(event, events=going)
    assert found == ("choices.why_not", (event, Event("change-right", tense="past")))
    over = refrained(event, events=CHANGED)
    assert over == INSTEAD


@pytest.mark.parametrize(
    ("begin", "end", "meant"),
    [(15.0, 17.0, True), (14.9, 17.0, False), (15.0, None, True)],
)
def test_what_nothing_says_is_meant_for_five_seconds(begin: float, end: Any, meant: bool) -> None:
    found = refrained(Event("let-go"), events=done("change-left", begin, end))
    assert (found[1][0].action == "keep-lane") is meant
    assert refrained(Event("wait"), events=done("change-left", 14.0, 17.0)) == INSTEAD


@pytest.mark.parametrize(
    ("begin", "end", "found"),
    [(1.0, 8.0, True), (1.0, 7.9, False), (1.0, None, True), (21.0, None, False)],
)
def test_a_change_counts_that_was_over_no_longer_ago(begin: float, end: Any, found: bool) -> None:
    made = refraining._change(scene(events=done("change-left", begin, end)))
    assert (made is not None) is found


def test_the_last_change_up_to_the_moment_counts() -> None:
    two = (*done("change-left", 5.0, 7.0), *done("change-right", 12.0, 14.0))
    assert refraining._change(scene(events=two)).action == "change-right"  # type: ignore[union-attr]
    early = Span(10.0, 10.0, said=True)
    assert refraining._change(scene(early, events=two)).action == "change-left"  # type: ignore[union-attr]
    soon = Span(11.0, 11.0, said=True)
    assert refraining._change(scene(soon, events=two)).action == "change-right"  # type: ignore[union-attr]
    other = done("exit-left", 12.0, 14.0)
    assert refraining._change(scene(events=other)) is None


# --- without one --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("seen", "action"),
    [
        (look(1, left=3.5), "change-left"),
        (look(1, left=-3.5), "change-right"),
        (look(1, left=2.0), "change-left"),
        (look(1, left=1.9), None),
        (look(1, left=3.5, oncoming=True), None),
        (None, None),
    ],
)
def test_who_drives_aside_is_followed_by_a_change_of_lanes(seen: Any, action: Any) -> None:
    follow = Event("follow", object=ONE, tense="present")
    found = refrained(follow, looks={1: seen})
    if action is None:
        assert found == ("choices.why_not", (Event("keep-lane", tense="present"),))
    else:
        assert found == ("choices.why_not", (Event(action, tense="present"),))
    keep = refrained(Event("keep-distance", object=ONE), looks={1: look(1, left=3.5)})
    assert keep == ("choices.why_not", (KEEP,))


CROSSED = done("exit-left", 16.0, 18.0)


def went(event: Event, *others: CrossingVehicle, **more: Any) -> Any:
    """What is told of not waiting at a junction where these others were."""
    with pytest.MonkeyPatch.context() as patch:
        reason = GoReason(None, others, past=False)
        patch.setattr(going, "went", lambda event, scene: (
            reason if event == Event("go", tense="past") else None))  # fmt: skip
        return refrained(event, events=CROSSED, **more)


def test_not_waiting_at_a_junction_is_told_by_who_was_there() -> None:
    one, two = CrossingVehicle(1, "ego"), CrossingVehicle(2, "vehicle")
    found = went(Event("give-way"), one, two)
    assert found == GoReason(None, (one, two), refrained="give-way", past=True)
    assert went(Event("wait", object=ONE), one, two).others == (one,)
    assert went(Event("wait", object=ONE), two).others == (CrossingVehicle(1, first="none"),)
    assert went(Event("slow-down"), one).refrained == "wait"
    assert went(Event("stop"), one).refrained == "stop"


def test_whom_we_had_let_go_is_told_as_done(monkeypatch: pytest.MonkeyPatch) -> None:
    gone = CrossingVehicle(1, "vehicle", gone=True)
    event = Event("wait", object=ONE)
    yielded = Event("give-way", object=ONE, tense="past")
    assert went(event, gone) == ("motions.motion", (yielded,))
    assert isinstance(went(Event("wait"), gone), GoReason)
    assert isinstance(went(event, CrossingVehicle(2, "vehicle", gone=True)), GoReason)
    reason = MotionReason(deed("give-way", 10.0), ())
    monkeypatch.setattr(motions, "motion", lambda *args, **more: reason)
    assert went(event, gone) == replace(reason, form="did")


def test_where_nobody_was_in_question_it_is_told_as_elsewhere() -> None:
    found = refrained(Event("stop", tense="present"), events=CROSSED)  # going tells something else
    assert found == ("choices.why_not", (Event("stop", tense="present"),))


# --- where no junction and no lane is in question -----------------------------------------------


@pytest.mark.parametrize(
    ("action", "rule", "told"),
    [
        ("let-go", "priority", True),
        ("give-way", "priority", True),
        ("wait", "priority", True),
        ("let-go", "give-way", False),
        ("stop", "priority", False),
    ],
)
def test_who_has_right_of_way_need_not_wait(
    action: Any, rule: Any, told: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    windows: list[Any] = []

    def read(scene: Any, vehicle: int, about: Window) -> Priority:
        windows.append(about)
        return Priority(NOW, rule, vehicle)

    monkeypatch.setattr(refraining, "priority_at", read)
    event = Event(action, object=ONE, tense="present")
    assert (refrained(event) == Priority(NOW, rule, 1)) is told
    if action != "stop":
        refrained(event, Span(4.0, 6.0, said=True))
        assert windows == [Window(NOW, NOW), Window(4.0, 6.0)]
    assert refrained(replace(event, object=None))[0] == "choices.why_not"


def test_what_we_did_after_all_is_told_so() -> None:
    assert refrained(Event("slow-down")) == (
        "motions.motion", (Event("give-way", tense="past"),),
    )  # fmt: skip
    assert refrained(Event("stop")) == ("choices.why_not", (Event("stop"),))
    held = refrained(Event("wait", object=ONE))
    assert held == ("motions.motion", (Event("give-way", tense="past"),))


def test_what_we_did_not_do_is_compared_with_a_stop(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(motions, "motion", raising(DidNotHappen(Event("wait"))))
    assert refrained(Event("wait")) == ("choices.why_not", (Event("stop"),))
    need = NeedRollout("trace")
    monkeypatch.setattr(motions, "motion", raising(need))
    assert refused(refrained, Event("wait")) == need


def test_who_goes_first_and_was_in_no_way_imagined_is_no_reason(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    name = "xavi_dialogue.explain.answers.reasons.refraining.reckoned_with"
    monkeypatch.setattr(name, lambda *_: False)
    one, two = CrossingVehicle(1, "ego"), CrossingVehicle(2, "vehicle")
    assert went(Event("give-way"), one, two).others == (one,)
