"""Which decision a question is about."""

from collections.abc import Sequence
from functools import cache

import pytest
from msgspec.structs import replace

from planner.record.events import Event as Told
from planner.record.trace import PlannedAction, PlanTrace, TimedAction
from tests.explain.causes.decisions import decided, ride, steady
from tests.explain.facts.scenes import Actor, made, speeds
from tests.traces import Actions, End
from xavi_dialogue.domain.answers import DidNotHappen, NotRecorded
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.terms import Event
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.plans.premise import (
    Premise,
    Subject,
    about_foil,
    deeds_called,
    did_not_happen,
    episode_of,
    happened,
    is_open,
    manoeuvre,
    options_known,
    premise,
)
from xavi_dialogue.explain.history.ride import Ride, Unanswered

EAST = tuple((2.0 * k, 0.0) for k in range(20))


EVENTS = (
    Told("action-started", 0.0, "continue", 0),
    Told("action-ended", 4.0, "continue", 3),
    Told("action-started", 4.0, "change-left", 4),
    Told("action-committed", 4.5, "change-left", 4),
    Told("action-ended", 7.0, "change-left", 4),
    Told("action-started", 7.0, "continue", 7),
    Told("action-started", 12.0, "exit-right", 10),
    Told("action-committed", 13.0, "exit-right", 12),
    Told("action-ended", 15.0, "exit-right", 12),
    Told("action-started", 15.0, "continue", 15),
)


def plan_at(time: float) -> Actions:
    if time < 4.0:
        return ("continue", "exit-right")
    if time < 5.0:
        return ("change-left", "continue")
    return ("exit-right", "continue") if 10.0 <= time < 14.0 else ("continue", "stop")


@cache
def decisions() -> tuple[PlanTrace, ...]:
    """While changing lanes there is no choice."""
    traces = []
    for k in range(21):
        ends = {"continue": End(), "change-left": End(), "stop": End(), "exit-right": End()}
        plans: list[Actions] = [
            ("continue",),
            ("change-left", "continue"),
            ("stop",),
            ("exit-right",),
        ]
        trace = decided(ends, plans=plans, time=float(k))
        steps = tuple(PlannedAction(a, 0.0, 1) for a in plan_at(float(k)))
        busy = TimedAction("change-left", 4.0) if 5 <= k < 7 else None
        traces.append(replace(trace, plan=steps, under_way=busy))
    return tuple(traces)


def journey(until: float = 20.0, events: Sequence[Told] = EVENTS) -> Ride:
    """Left from 4.5 to 7 s, right from 13 to 15 s."""
    known = tuple(e for e in events if e.sim_time <= until)
    return ride(*(t for t in decisions() if t.sim_time <= until), events=known)


def subject(
    *names: ActionName, span: Span | None = None, is_past: bool = True, coming: bool = False
) -> Subject:
    event = Event(names[0]) if names else None
    return Subject(event, tuple(names), is_past, span, coming)


def said(begin: float, end: float) -> Span:
    return Span(begin, end, said=True)


@pytest.mark.parametrize(
    ("asked", "time", "deed"),
    [
        (subject("change-left"), 4.0, "change-left"),
        (subject("exit-right"), 12.0, "exit-right"),
        (subject("turn"), 12.0, "exit-right"),
        (subject("change-left", span=said(4.0, 6.0)), 4.0, "change-left"),
        (subject("continue", span=said(8.0, 9.0)), 7.0, "continue"),
        (subject("continue"), 15.0, "continue"),
        (subject(), 12.0, "exit-right"),
        (subject("do"), 12.0, "exit-right"),
        (subject(span=said(4.0, 6.0)), 4.0, "change-left"),
        (subject(span=said(9.0, 9.5)), 9.0, "continue"),
        (subject(is_past=False), 20.0, None),
        (subject("stop", is_past=False), 20.0, None),
    ],
)
def test_the_decision_that_a_question_is_about(
    asked: Subject, time: float, deed: str | None
) -> None:
    found = premise(journey(), asked)
    assert found.trace.sim_time == time
    assert (None if found.deed is None else found.deed.action) == deed


def test_what_is_planned_later_has_its_place_in_the_plan() -> None:
    found = premise(journey(), subject("stop", is_past=False))
    assert found.node == ("continue",)
    early = premise(journey(3.0, ()), subject("exit-right", is_past=False))
    assert (early.trace.sim_time, early.node) == (3.0, ("continue",))
    busy = missing(subject("stop", is_past=False), journey(6.0))  # before it that was not planned
    assert isinstance(busy, DidNotHappen)
    assert busy.planned is None


def missing(asked: Subject, whole: Ride | None = None) -> object:
    with pytest.raises(Unanswered) as refused:
        premise(journey() if whole is None else whole, asked)
    return refused.value.result


def test_what_did_not_happen_is_declined_with_what_did() -> None:
    never = missing(subject("exit-left"))
    assert isinstance(never, DidNotHappen)
    assert [e.action for e in never.instead] == ["exit-right"]
    assert (never.planned, never.elsewhen) == (None, None)
    other_time = missing(subject("change-left", span=said(16.0, 17.0)))
    assert isinstance(other_time, DidNotHappen)
    assert other_time.elsewhen == 4.5
    assert [e.action for e in other_time.instead] == ["change-left"]
    over = missing(subject("exit-right", coming=True))
    assert isinstance(over, DidNotHappen)
    to_come = did_not_happen(journey(), subject("stop")).result
    assert isinstance(to_come, DidNotHappen)
    assert to_come.planned == 20.0
    unnamed = did_not_happen(journey(), Subject(None, ("stop", "exit-left"), True, None)).result
    assert isinstance(unnamed, DidNotHappen)
    assert unnamed.asked.action == "stop"
    nothing = did_not_happen(Ride(journey(0.0, ()).record), subject()).result
    assert isinstance(nothing, DidNotHappen)
    assert (nothing.asked.action, nothing.instead) == ("do", ())


def test_a_time_before_the_record_is_not_recorded() -> None:
    late = ride(*journey().traces[5:], events=EVENTS)
    assert missing(subject(span=said(2.0, 2.5)), late) == NotRecorded("before-record", since=2.25)
    inferred = premise(late, subject(span=Span(2.0, 2.5)))
    assert inferred.trace.sim_time in (5.0, 20.0)


def test_overtaking_may_have_begun_before() -> None:
    found = premise(
        journey(), replace_event(subject("change-left", span=said(9.0, 9.5)), "overtake")
    )
    assert found.deed is not None
    assert found.deed.action == "change-left"
    assert isinstance(missing(subject("change-left", span=said(9.0, 9.5))), DidNotHappen)


def replace_event(asked: Subject, action: ActionName) -> Subject:
    return Subject(Event(action), asked.names, asked.is_past, asked.span, asked.coming)


def test_deeds_by_their_names() -> None:
    whole = journey()
    assert [d.action for d in deeds_called(whole, ("exit-right",))] == ["exit-right"]
    assert [d.action for d in deeds_called(whole, ("turn",))] == ["exit-right"]
    assert [d.action for d in deeds_called(whole, ("turn", "stop"))] == ["exit-right"]
    assert [d.action for d in deeds_called(whole, ("exit-straight",))] == ["continue"] * 3
    assert deeds_called(whole, ("exit-left",)) == []
    deed = happened(whole, ("continue",), said(8.0, 9.0))
    assert deed is not None
    episode = episode_of(deed)
    assert (episode.action, episode.begin, episode.end) == ("continue", 7.0, 12.0)


@pytest.mark.parametrize(
    ("span", "action"),
    [
        (None, "exit-right"),
        (said(3.0, 6.0), "change-left"),
        (said(3.0, 14.0), "exit-right"),
        (said(8.0, 9.5), "continue"),
        (Span(8.0, 9.5), "continue"),
    ],
)
def test_a_manoeuvre_is_more_than_driving_on(span: Span | None, action: str) -> None:
    found = manoeuvre(journey(), span)
    assert found is not None
    assert found.action == action
    assert manoeuvre(journey(3.0, ()), span) is None
    only = manoeuvre(journey(3.0), None)
    assert only is not None
    assert only.action == "continue"


def test_what_could_be_chosen_when() -> None:
    whole = journey()
    free, busy = whole.traces[4], whole.traces[5]
    assert is_open(whole, free, ("stop",))
    assert is_open(whole, free, ("turn",))
    assert not is_open(whole, free, ("exit-left",))
    assert not is_open(whole, busy, ("stop",))
    assert not is_open(whole, free, ("speed-up",))
    assert options_known(whole, ("stop", "exit-left", "continue")) == ("stop", "continue")
    assert options_known(ride(busy), ("stop",)) == ()


@pytest.mark.parametrize(
    ("asked", "foil", "time"),
    [
        (subject(), ("stop",), 20.0),  # in force, and it could
        (subject(span=said(12.0, 14.0)), ("stop",), 12.0),  # the manoeuvre then had that choice
        (subject(), (), 12.0),
        (subject("change-left"), ("stop",), 4.0),
        (subject(), ("continue",), 12.0),
        (subject(), ("exit-left",), 12.0),
        (subject(span=said(5.5, 6.5)), ("continue",), 4.0),
        (subject(is_past=False), ("stop",), 20.0),
        (subject(span=said(16.0, 18.0)), ("stop",), 17.0),
        (subject(span=Span(16.0, 20.0)), ("stop",), 20.0),
        (subject(span=said(8.0, 11.5)), ("stop",), 12.0),  # before the turn: the decision for it
    ],
)
def test_what_might_have_been_is_asked_of_a_decision_that_could(
    asked: Subject, foil: tuple[ActionName, ...], time: float
) -> None:
    assert about_foil(journey(), asked, foil).trace.sim_time == time


def test_within_a_manoeuvre_the_decision_for_it_is_meant() -> None:
    found = about_foil(journey(6.0), subject(is_past=False), ("stop",))
    assert (found.trace.sim_time, found.deed and found.deed.action) == (4.0, "change-left")
    none = about_foil(journey(6.0), subject(is_past=False), ())
    assert none.trace.sim_time == 6.0
    lost = ride(*journey(6.0).traces[5:], events=EVENTS[:4])
    assert about_foil(lost, subject(is_past=False), ("stop",)).trace.sim_time == 6.0
    assert isinstance(none, Premise)


def test_of_the_past_the_last_decision_that_could_and_did_not_is_meant() -> None:
    """Just now we drove on; what else could have been chosen then is asked of the last one."""
    whole = journey(18.0)

    def barred(trace: PlanTrace) -> PlanTrace:
        rows = tuple(r for r in trace.rollouts if r.actions[0].action != "change-left")
        return replace(trace, rollouts=rows) if trace.sim_time > 9.0 else trace

    part = ride(*(barred(t) for t in whole.traces), events=EVENTS)
    assert about_foil(part, subject(), ("change-lane",)).trace.sim_time == 9.0
    assert about_foil(part, subject(span=said(8.6, 11.6)), ("change-lane",)).trace.sim_time == 9.0
    assert about_foil(part, subject(span=said(9.5, 11.6)), ("change-lane",)).trace.sim_time == 10.0
    assert about_foil(part, subject(), ("exit-left",)).trace.sim_time == 12.0


def test_a_ride_that_only_drove_on() -> None:
    whole = made({0: Actor(speeds(0.0, 0.0, ((0.0, 5.0), (9.0, 9.0))))}, 5.0)
    found = premise(whole, subject())
    assert (found.trace.sim_time, found.deed) == (5.0, None)
    plain = ride(
        decided({"continue": End()}, plans=[("continue",)], lines={"continue": steady(5.0)})
    )
    assert premise(plain, subject(is_past=False)).trace is plain.latest


def test_what_is_over_is_what_a_question_is_about_unless_that_is_yet_to_come() -> None:
    plain = Subject(Event("change-left"), ("change-left",), True, None)
    assert premise(journey(), plain) == premise(journey(), subject("change-left"))
    with pytest.raises(Unanswered):
        premise(journey(), subject("change-left", coming=True))
