"""Why we did one thing and not another: the decision, the foil, and who was in the way."""

from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.trace import WhatIf
from tests.explain.answers.chosen import (
    EVENTS,
    LEFT,
    RIGHT,
    STAY,
    TRACES,
    TURN,
    beside,
    chosen,
)
from tests.explain.answers.stated import aim, decision, did, look, result
from tests.traces import End
from xavi_dialogue.domain.answers import (
    CannotSay,
    ChoiceReason,
    DidNotHappen,
    MotionCause,
    NeedRollout,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.terms import Event, Happens, Junction, Vehicle
from xavi_dialogue.explain.answers.reasons.choices import (
    why,
    why_not,
)

ONE = Vehicle(1)
CHANGE = Event("change-lane", side="left")


def told(explainer: Any, *args: Any, span: Any = None, **facts: Any) -> Any:
    return result(explainer, *args, chosen(span, **facts))


def reason(found: Any) -> tuple[Any, ...]:
    """Which decision, what was done, and instead of what."""
    assert isinstance(found, ChoiceReason), found
    return found.contrast.decided, found.contrast.fact, found.contrast.foil


# --- why ----------------------------------------------------------------------------------------


def test_a_deed_is_explained_by_its_decision_against_what_comes_first_to_mind() -> None:
    for event in (CHANGE, None, Event("change-left"), Event("overtake", object=ONE)):
        found = told(why, event, looks={1: look(1)})
        assert reason(found) == (6.0, LEFT, STAY)
        assert (found.form, found.past, found.ahead) == ("why", True, None)
        assert (found.deed.action, found.deed.begin, found.deed.end) == ("change-left", 6.5, 9.0)
        assert found.contrast.value == 5.0


def test_the_foil_that_is_named_is_compared() -> None:
    against = Happens(Event("stop"))
    found = result(why, CHANGE, chosen(), against)
    assert reason(found) == (6.0, LEFT, ("stop",))
    assert found.contrast.value == 10.0
    same = result(why, CHANGE, chosen(), Happens(Event("change-left")))
    assert reason(same) == (6.0, LEFT, STAY)  # that is what was done


def test_what_is_going_on_is_no_past() -> None:
    events = EVENTS[:4]  # the change of lanes has not ended
    now = Event("change-left", tense="present")
    found = told(why, now, events=events, traces=TRACES[:3], now=8.0)
    assert (found.past, found.deed.end) == (False, None)
    for event in (CHANGE, None):
        found = told(why, event, events=events, traces=TRACES[:3], now=8.0)
        assert found.past is False
    ended = told(why, Event("change-left", tense="present"))
    assert ended.past is True
    said = Span(6.0, 8.0, said=True)
    coming = Event("change-left", tense="future")
    found = told(why, coming, events=events, traces=TRACES[:3], now=8.0)
    assert found.past is False
    assert told(why, CHANGE, span=said).past is True


def test_what_is_only_planned_is_no_past_either() -> None:
    traces = [*TRACES, decision(18.0, RIGHT, ends={STAY: End(time=15.0)})]
    found = told(why, Event("change-right", tense="future"), traces=traces)
    assert (reason(found), found.deed, found.past) == ((18.0, RIGHT, STAY), None, False)
    past = told(why, Event("go", tense="past"), span=Span(2.5, 3.0, said=True))
    assert past.contrast.decided == 2.0


def test_what_cannot_be_done_or_was_not_done_is_refused() -> None:
    assert told(why, Event("honk")) == CannotSay("capability", "honk", "not-an-action")
    missing = told(why, Event("exit-left"))
    assert isinstance(missing, DidNotHappen)
    assert missing.asked == Event("exit-left")


def test_a_deed_has_the_place_that_is_recorded() -> None:
    ring = Junction("roundabout", time=6.0)
    placed = did("change-left", 6.5, 9.0, place=ring, exit=2)
    found = told(why, CHANGE, episodes=(placed,))
    assert (found.deed.place, found.deed.exit) == (ring, 2)
    for other in (
        did("change-left", 10.0, 12.0, place=ring),
        did("change-right", 6.5, 9.0, place=ring),
        did("change-left", 6.5, 9.0),
    ):
        assert told(why, CHANGE, episodes=(other,)).deed.place is None


# --- who was in the way -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("facts", "ahead"),
    [
        (beside(0, 30.0, 5.0), MotionCause("leader", vehicle=1, speed=5.0)),
        (beside(0, 30.0, 13.0), None),
        (beside(1, 30.0, 5.0), None),
        (beside(0, -30.0, 5.0), None),
    ],
)
def test_who_crept_in_the_lane_that_we_left(facts: Any, ahead: Any) -> None:
    assert told(why, CHANGE, **facts).ahead == ahead


@pytest.mark.parametrize(
    ("facts", "ahead"),
    [
        (beside(1, 3.0), MotionCause("lane-beside", vehicle=1)),
        (beside(1, 30.0, 5.0), MotionCause("lane-ahead", 1, speed=5.0, value=30.0)),
        (beside(1, 30.0, 13.0), None),
        (beside(0, 3.0), None),
    ],
)
def test_who_was_in_the_lane_that_we_left_alone(facts: Any, ahead: Any) -> None:
    not_left = Event("change-left", tense="present")
    found = told(why_not, not_left, **facts)
    assert reason(found) == (12.0, STAY, ("change-left",))
    assert (found.form, found.ahead, found.past) == ("why-not", ahead, False)


def test_of_staying_it_is_who_was_ahead() -> None:
    stayed = Event("keep-lane")
    found = result(why_not, stayed, chosen(**beside(0, 30.0, 5.0)), CHANGE)
    assert reason(found) == (6.0, LEFT, STAY)
    assert found.ahead == MotionCause("leader", vehicle=1, speed=5.0)


# --- why not ------------------------------------------------------------------------------------


def test_what_was_not_done_is_compared_at_the_last_decision_for_it() -> None:
    found = told(why_not, Event("stop"))
    assert reason(found) == (12.0, STAY, ("stop",))
    assert (found.past, found.deed, found.open_at) == (True, None, None)
    now = told(why_not, Event("change-right", tense="present"))
    assert reason(now) == (12.0, STAY, ("change-right",))
    then = told(why_not, Event("stop"), span=Span(2.0, 3.0, said=True))
    assert then.contrast.decided == 2.0


def test_what_was_done_is_not_explained_as_undone() -> None:
    found = told(why_not, Event("change-left"))
    assert isinstance(found, DidNotHappen)
    assert [e.action for e in found.instead] == ["change-left"]
    planned = told(why_not, Event("continue", tense="present"))
    assert isinstance(planned, DidNotHappen)
    assert [(e.action, e.begin, e.end) for e in planned.instead] == [("continue", 12.0, None)]
    past = told(why_not, Event("continue"), span=Span(3.0, 3.0, said=True))
    assert isinstance(past, DidNotHappen)


def test_what_has_just_been_decided_is_not_explained_as_undone() -> None:
    found = result(why_not, Event("change-left", tense="present"), chosen(traces=TRACES[:2],
                   events=EVENTS[:1], now=6.0))  # fmt: skip
    assert isinstance(found, DidNotHappen)


def thin(road: Any) -> tuple[Any, tuple[Any, ...]]:
    """A decision with a lane change that was tried in 3 of 16 situations, and again in those."""
    four = tuple(aim(kind, 0.25) for kind in ("exit-left", "exit-right", "continue", "stop"))
    trace = decision(12.0, STAY, aims={1: four, 2: four}, ends={LEFT: End(time=11.0)}, road=road)
    left = [r for r in trace.rollouts if r.actions[0].action == "change-left"]
    rest = tuple(r for r in trace.rollouts if r not in left)
    again = tuple(
        replace(trace, rollouts=tuple(left[:3]), what_if=WhatIf(actions=LEFT[:1], rollouts=n))
        for n in (40, 160)
    )
    return replace(trace, rollouts=(*rest, *left[:3])), again


def test_where_too_little_was_tried_who_is_beside_us_tells_enough() -> None:
    event = Event("change-left", tense="present")
    facts = beside(1, 3.0)
    trace, again = thin(facts["road"])
    facts["traces"] = [*TRACES[:3], trace]
    need = NeedRollout(trace_id=trace.trace_id, actions=("change-left",), rollouts=40)
    assert told(why_not, event, **facts) == need
    found = told(why_not, event, extra=again, **facts)
    assert isinstance(found, ChoiceReason)
    assert (found.contrast.foil, found.contrast.verdict) == (("change-left",), "alone")
    assert found.ahead == MotionCause("lane-beside", vehicle=1)
    trace, again = thin(None)
    missing = told(why_not, event, extra=again, traces=[*TRACES[:3], trace])
    assert missing.reason == "too-little-evidence"


def test_what_we_did_before_is_asked_of_the_latest_decision() -> None:
    event = Event("change-lane", side="left", tense="present")
    found = result(why_not, event, chosen(), CHANGE)
    assert reason(found) == (12.0, STAY, ("change-left",))
    assert (found.form, found.past) == ("why-not", False)


def test_straight_on_is_asked_of_the_junction_where_we_are_to_turn() -> None:
    turning = decision(18.0, ("continue", *TURN), ends={("continue", "exit-straight"): End("dead")})
    event = Event("exit-straight", tense="present")
    found = told(why_not, event, traces=[*TRACES, turning])
    assert reason(found) == (18.0, ("continue", *TURN), ("continue", "exit-straight"))
    assert isinstance(told(why_not, event), DidNotHappen)  # that is what we do
