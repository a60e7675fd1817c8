"""Why we keep our speed or our lane, and what counts as refraining."""

from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.events import Event as Recorded
from tests.explain.answers.given import NOW, Given, Told, look, plan, refused, stand_in
from xavi_dialogue.domain.answers import (
    CrossingVehicle,
    GoReason,
    NeedRollout,
    NotApplicable,
    Priority,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.terms import Ego, Event, Lane, Related, Vehicle
from xavi_dialogue.explain.answers.reasons import choices, refraining
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


def kept(seen: Any = None, theirs: Any = 10.0, ours: Any = 10.0, action: Any = "brake") -> Any:
    speeds = {("speed", ONE): theirs, ("speed", Ego()): ours}
    event = Event(action, object=ONE, tense="present")
    return refrained(event, looks={1: seen or look(1)}, measures=speeds)


def test_somebody_far_ahead_who_is_no_slower_needs_no_braking() -> None:
    found = kept()
    ahead = CrossingVehicle(1, first="ahead", trend="steady", distance=15.5)
    assert found == GoReason(None, (replace(ahead, distance=look(1).distance),), past=False,
                             refrained="brake")  # fmt: skip
    assert kept(action="slow-down").refrained == "slow-down"
    assert kept(theirs=9.5).others[0].trend == "steady"
    assert kept(theirs=9.4).others[0].trend == "slowing"


@pytest.mark.parametrize(
    ("seen", "first"),
    [
        (look(1, left=4.9), "ahead"),
        (look(1, left=-5.1), "vehicle"),
        (look(1, ahead=-1.0), "vehicle"),
        (look(1, oncoming=True), "vehicle"),
    ],
)
def test_who_is_not_on_our_road_in_front_is_judged_by_the_rule(
    seen: Any, first: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert kept(seen).others[0].first == first
    rule = Priority(NOW, "priority", 1)
    monkeypatch.setattr(refraining, "priority_at", lambda scene, vehicle, about, blame: (
        rule if blame and about == Window(NOW, NOW) else None))  # fmt: skip
    assert kept(seen).others[0].first == ("ahead" if first == "ahead" else "ego")
    nobody = Priority(NOW, "none", 1)
    monkeypatch.setattr(refraining, "priority_at", lambda *args, **more: nobody)
    assert kept(seen).others[0].first == ("ahead" if first == "ahead" else "none")


def test_without_speeds_or_a_vehicle_it_is_asked_why_we_are_fast() -> None:
    assert kept(theirs=None) == ("motions.fast", ())
    assert kept(ours=None) == ("motions.fast", ())
    assert refrained(Event("brake", tense="present")) == ("motions.fast", ())
    gone = refrained(Event("brake", object=ONE, tense="present"), looks={1: None},
                     measures={("speed", ONE): 9.0, ("speed", Ego()): 9.0})  # fmt: skip
    assert gone == ("motions.fast", ())


# --- recognising --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("lane", "action"),
    [
        (Lane("right"), "change-left"),
        (Lane("rightmost"), "change-left"),
        (Lane("left"), "change-right"),
        (Lane("leftmost"), "change-right"),
        (Lane("own"), None),
        (ONE, None),
    ],
)
def test_a_lane_was_left_by_a_change_to_the_other_side(lane: Any, action: Any) -> None:
    both = scene(events=(*done("change-left", 5.0, 7.0), *done("change-right", 9.0, 11.0)))
    found = refraining.left_lane(Event("keep-lane", object=lane), both)
    assert found == (None if action is None else Event(action, tense="past"))
    assert refraining.left_lane(Event("follow", object=lane), both) is None
    assert refraining.left_lane(Event("keep-lane", object=lane), scene()) is None


def test_a_lane_that_was_left_later_was_kept_then() -> None:
    keep = Event("keep-lane", object=Lane("right"))
    late = done("change-left", 12.0, 14.0)
    for at, left in ((10.0, False), (11.0, True)):
        there = scene(Span(at, at, said=True), events=late)
        assert (refraining.left_lane(keep, there) is not None) is left


def test_refraining_is_of_waiting_slowing_and_staying() -> None:
    for action in ("stop", "wait", "give-way", "slow-down", "brake", "follow", "keep-distance"):
        assert refraining.is_refraining(Event(action))
    assert not refraining.is_refraining(Event("turn"))
    assert refraining.is_refraining(Event("keep-lane"))
    assert refraining.is_refraining(Event("keep-lane", object=Lane("own")))
    assert not refraining.is_refraining(Event("keep-lane", object=Lane("left")))


def test_staying_behind_whom_we_could_pass_is_a_choice(monkeypatch: pytest.MonkeyPatch) -> None:
    follow = Event("follow", object=ONE, tense="present")
    found: Any = refraining.not_passed(follow, scene())
    assert found.events == (Event("overtake", object=ONE, tense="present"),)
    assert refraining.not_passed(replace(follow, object=None), scene()) is None
    assert refraining.not_passed(replace(follow, tense="past"), scene()) is None
    assert refraining.not_passed(replace(follow, action="approach"), scene()) is None
    monkeypatch.setattr(choices, "why_not", raising(NotApplicable((), "no lane")))
    assert refraining.not_passed(follow, scene()) is None
    need = NeedRollout("trace")
    monkeypatch.setattr(choices, "why_not", raising(need))
    assert refused(refraining.not_passed, follow, scene()) == need
