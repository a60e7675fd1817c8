"""Which explainer is asked, and for what, where it is asked why we did not do something."""

from typing import Any

import pytest

from planner.record.events import Event as Recorded
from tests.explain.answers.given import NOW, Given, Told, deed, look, plan, refused, stand_in
from xavi_dialogue.domain.answers import CannotSay, DidNotHappen, NotApplicable, NotRecorded
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import Why
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Exit,
    Happens,
    Junction,
    Not,
    Related,
    Vehicle,
)
from xavi_dialogue.explain.answers.propositions import reasons
from xavi_dialogue.explain.answers.reasons import choices, motions, not_going, refraining
from xavi_dialogue.explain.answers.reference.asked import Unanswered
from xavi_dialogue.explain.answers.ride import onward

ONE = Vehicle(1)
THEN = Span(8.0, 9.0, said=True)
STANDS = (plan(NOW, speed=0.0),)
CROSSED = (
    Recorded("action-started", 6.0, "exit-left", 6),
    Recorded("action-committed", 8.0, "exit-left"),
    Recorded("action-ended", 11.0, "exit-left"),
)


@pytest.fixture(autouse=True)
def explainers(monkeypatch: pytest.MonkeyPatch) -> None:
    stand_in(
        monkeypatch,
        *(f"choices.{name}" for name in ("why", "why_not", "in_lane", "straight", "needed")),
        *(f"motions.{name}" for name in ("slow", "fast", "motion", "standing_or_slow")),
        *("going.went", "deciding.how_avoid", "signalling.why_signal", "refraining.refrained"),
    )
    monkeypatch.setattr(refraining, "not_passed", lambda event, scene: None)
    monkeypatch.setattr(refraining, "left_lane", lambda event, scene: None)
    monkeypatch.setattr(onward, "stays_on", lambda scene, event: None)


def scene(span: Span | None = None, **more: Any) -> Any:
    return Given(**({"looks": {1: look(1)}, "traces": (plan(NOW),)} | more)).asked(span)


def own_not(event: Event, span: Span | None = None, question: Any = None, **more: Any) -> Any:
    return reasons.own_not(event, scene(span, **more), question)


def rest(found: Told) -> tuple[Any, ...]:
    """What was asked, without the scene."""
    return tuple(one for one in found.args if not hasattr(one, "world"))


def raising(result: Any) -> Any:
    def explain(*args: Any, **more: Any) -> Any:
        raise Unanswered(result)

    return explain


BEFORE = Related("ahead-of", Ego(), ONE)


@pytest.mark.parametrize(
    ("event", "by", "args"),
    [
        (Event("speed-up"), "motions.standing_or_slow", ()),
        (Event("go", manner=("fast",)), "motions.standing_or_slow", ()),
        (Event("wait", then=Event("merge")), "choices.why_not", (Event("merge"), None)),
        (Event("wait", tense="present", then=Event("change-left")), "choices.why_not",
         (Event("change-left", tense="present"), None)),
        (Event("wait", then=Event("turn")), "refraining.refrained", None),
        (Event("slow-down"), "refraining.refrained", (Event("slow-down"),)),
        (Event("cut-in", object=ONE), "choices.why_not", (Event("cut-in", object=ONE), None)),
        (Event("turn"), "choices.why_not", (Event("turn"), None)),
    ],
)  # fmt: skip
def test_what_we_did_not_do_is_asked_of_whom_it_concerns(event: Event, by: str, args: Any) -> None:
    found = own_not(event)
    assert found.by == by
    if args is not None:
        assert rest(found) == args


def test_what_no_car_can_do_is_declined() -> None:
    assert refused(own_not, Event("fly")) == CannotSay("capability", "fly", "not-an-action")


def test_what_was_done_instead_is_handed_on() -> None:
    why = Why(Not(Happens(Event("turn"))), instead=Happens(Event("stop")))
    assert rest(own_not(Event("turn"), question=why)) == (Event("turn"), Event("stop"))
    joins = own_not(Event("merge"), question=why)
    assert rest(joins) == (Event("merge"), Event("stop"))


def test_staying_on_the_road_and_leaving_a_lane_are_told_first(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    change = Event("change-left")
    monkeypatch.setattr(refraining, "left_lane", lambda event, scene: change)
    found = own_not(Event("turn"))
    assert (found.by, rest(found)) == ("choices.why_not", (Event("keep-lane"), change))
    monkeypatch.setattr(onward, "stays_on", lambda scene, event: "on")
    assert own_not(Event("turn")) == "on"


def test_not_coming_in_is_tried_as_a_change_of_lanes_at_any_time(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    tried: list[tuple[Event, Any]] = []

    def refuses(event: Event, setting: Any, other: Any) -> None:
        tried.append((event, setting.span))
        raise Unanswered(NotApplicable(("change-left",), "no lane"))

    monkeypatch.setattr(choices, "why_not", refuses)
    inferred = Span(8.0, 9.0)
    found = own_not(Event("cut-in", object=ONE, where=BEFORE), inferred, traces=STANDS)
    cut = Event("cut-in", object=ONE, where=BEFORE)
    assert tried == [(cut, inferred), (cut, None)]
    assert (found.by, rest(found)) == ("motions.motion", (Event("give-way"),))
    tried.clear()
    own_not(Event("wait", then=Event("enter", object=ONE)), THEN)
    assert tried == [(Event("merge"), THEN)]
    tried.clear()
    own_not(Event("merge", tense="present"), traces=STANDS)
    assert tried == [(Event("merge", tense="present"), None)] * 2
    monkeypatch.setattr(choices, "why_not", raising(NotRecorded("gap-in-record")))
    assert refused(own_not, Event("merge")) == NotRecorded("gap-in-record")


def test_entering_a_junction_is_no_change_of_lanes() -> None:
    found = not_going.not_joining(Event("enter", object=Junction()), scene(), None)
    assert rest(found) == (Event("enter", object=Junction()), None)  # type: ignore[arg-type]
    out = not_going.not_joining(Event("enter", object=Exit(1)), scene(), None)
    assert rest(out) == (Event("enter", object=Exit(1)), None)  # type: ignore[arg-type]


# --- not going ----------------------------------------------------------------------------------


@pytest.mark.parametrize(("speed", "stands"), [(0.0, True), (0.29, True), (0.3, False)])
def test_who_stands_is_told_why_it_stands(speed: float, stands: bool) -> None:
    found = own_not(Event("go", tense="present"), traces=(plan(NOW, speed=speed),))
    assert (rest(found) == (Event("stand", tense="present"),)) is stands
    past = own_not(Event("go"), traces=(plan(NOW, speed=speed),))
    assert (past.by, rest(past)) == ("motions.motion", (Event("give-way"),))
    assert past.more == {"asked": "wait"}


def test_not_going_is_giving_way_while_that_is_recent() -> None:
    event = Event("go", tense="present", object=ONE)
    for end, by in ((18.0, "motions.motion"), (17.9, "motions.slow")):
        yields = (deed("give-way", 15.0, end, to=1),)
        assert own_not(event, deeds=yields).by == by
    waits = own_not(event, deeds=(deed("give-way", 15.0, to=1),))
    assert rest(waits) == (Event("give-way", tense="present", object=ONE),)
    other = own_not(event, deeds=(deed("give-way", 15.0, to=2),))
    assert other.by == "motions.slow"


@pytest.mark.parametrize(
    ("event", "by"),
    [
        (Event("go"), "motions.slow"),
        (Event("move"), "motions.slow"),
        (Event("cross"), "choices.why_not"),
        (Event("enter"), "choices.why_not"),
    ],
)
def test_not_going_without_giving_way_is_slowness_or_a_choice(
    event: Event, by: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(motions, "motion", raising(DidNotHappen(Event("give-way"))))
    assert not_going.not_going(event, scene()).by == by  # type: ignore[union-attr]
    monkeypatch.setattr(motions, "motion", raising(NotRecorded("gap-in-record")))
    assert refused(not_going.not_going, event, scene()) == NotRecorded("gap-in-record")


def test_not_going_somewhere_is_a_choice_of_the_way() -> None:
    found = own_not(Event("go", side="left"))
    assert (found.by, rest(found)) == ("choices.why_not", (Event("go", side="left"),))
    crosses = own_not(Event("cross", side="left"))
    assert crosses.by == "motions.motion"


def test_driving_on_is_what_a_stop_in_force_puts_off() -> None:
    stops = (plan(NOW, "stop", "continue"),)
    for action in ("go", "move"):
        found = own_not(Event(action, tense="present"), traces=stops)  # type: ignore[arg-type]
        assert (found.by, *rest(found)) == ("motions.motion", Event("stop", tense="present"))


def test_stopping_rather_than_driving_on_is_asked_of_the_stop() -> None:
    stop, on = Event("stop", tense="present"), Happens(Event("go", tense="present"))
    found: Any = reasons.why(Why(Happens(stop), instead=on), scene())
    assert (found.by, *rest(found)) == ("motions.motion", stop)
