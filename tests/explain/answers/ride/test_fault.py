"""What a question of fault or law turns on: the crossing, the speed, who braked and what was done.

We come into a junction at 10 s, as the record shows from its decisions.
"""

from typing import Any

import pytest

from planner.record.places import PriorityFact, RoadFacts
from tests.explain.answers.given import NOW, Given, deed, look, place, plan, their
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import Fault
from xavi_dialogue.domain.terms import Ego, Event, Exists, Happens, Vehicle
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.ride import priority

ONE = Vehicle(1)
PRESENT, WHOLE = Window(NOW, NOW), Window(0.0, NOW)
LIMIT = {("limit", Ego()): 13.89, ("limit", ONE): 8.0}


def road(inside: bool, who: Any = "vehicle") -> RoadFacts:
    return RoadFacts({0: place(in_junction=inside)}, priority=(PriorityFact(1, who),))


def crossed(*entered: float) -> tuple[Any, ...]:
    """A decision each second; we are inside a junction from these times [s] on, for 2 s."""
    times = [float(t) for t in range(21)]
    return tuple(plan(t, road=road(any(e <= t < e + 2.0 for e in entered))) for t in times)


def given(**more: Any) -> Given:
    return Given(**({"looks": {1: look(1)}, "traces": crossed(10.0)} | more))


# --- which crossing -----------------------------------------------------------------------------


def test_a_question_of_the_whole_ride_is_about_the_last_crossing() -> None:
    twice = given(traces=crossed(5.0, 12.0)).asked()
    assert priority.where_rule_holds(twice, WHOLE) == Window(12.0, 12.0)
    assert priority.where_rule_holds(twice, Window(-1.0, 19.9)) == Window(12.0, 12.0)
    part = Window(3.0, NOW)
    assert priority.where_rule_holds(twice, part) == part
    early = Window(0.0, 19.0)
    assert priority.where_rule_holds(twice, early) == early


def test_without_a_junction_it_is_about_the_last_turn_or_now() -> None:
    turns = (deed("exit-left", 3.0, 5.0), deed("exit-right", 14.0, 16.0))
    asked = given(traces=(), deeds=turns).asked()
    assert priority.where_rule_holds(asked, WHOLE) == Window(14.0, 16.0)
    going = given(traces=(), deeds=(deed("enter", 18.0),)).asked()
    assert priority.where_rule_holds(going, WHOLE) == Window(18.0, NOW)
    assert priority.where_rule_holds(given(traces=()).asked(), WHOLE) == PRESENT


@pytest.mark.parametrize(
    ("about", "time"),
    [
        (PRESENT, NOW),
        (Window(19.95, 19.95), NOW),
        (Window(10.0, 10.0), 7.0),  # 3 s before we came in
        (Window(16.0, 17.0), 7.0),  # up to 6 s after it
        (Window(16.5, 17.0), 16.5),
        (Window(2.0, 4.0), 7.0),
        (Window(2.0, 3.5), 2.0),
        (Window(0.0, NOW), 7.0),
    ],
)
def test_a_rule_is_read_off_shortly_before_the_junction(about: Window, time: float) -> None:
    assert priority._rule_time(given().asked(), about) == time


def test_of_two_junctions_the_one_closest_to_the_stretch_counts() -> None:
    asked = given(traces=crossed(5.0, 10.0)).asked()
    assert priority._rule_time(asked, Window(6.0, 6.5)) == 2.0
    assert priority._rule_time(asked, Window(9.0, 9.5)) == 7.0
    assert priority._rule_time(given(traces=crossed(2.0)).asked(), Window(2.0, 2.5)) == 0.0


def test_where_no_junction_was_seen_a_turn_tells_the_time() -> None:
    turn = deed("exit-left", 8.0, 10.0)
    asked = given(traces=(), deeds=(turn,)).asked()
    assert priority._rule_time(asked, Window(9.0, 12.0)) == 8.0
    assert priority._rule_time(asked, Window(11.0, 12.0)) == 11.0
    late = given(traces=(), deeds=(turn,), begin=9.0).asked()
    assert priority._rule_time(late, Window(9.5, 12.0)) == 9.0


# --- what is told beside it ---------------------------------------------------------------------


@pytest.mark.parametrize(
    ("ours", "theirs", "conflict"),
    [
        (1.0, 4.0, True),
        (4.0, 1.0, True),
        (3.9, 3.9, False),
        (None, 5.0, True),
        (None, 1.0, False),
        (None, None, None),
    ],
)
def test_braking_hard_is_a_conflict(ours: Any, theirs: Any, conflict: Any) -> None:
    peaks = {("deceleration", Ego(), "highest"): ours, ("deceleration", ONE, "highest"): theirs}
    asked = given(extremes=peaks).asked()
    assert priority._conflict(asked, 1, Window(8.0, 12.0)) is conflict
    alone = priority._conflict(asked, None, Window(8.0, 12.0))
    assert alone is (None if ours is None else ours >= 4.0)


def test_braking_is_looked_for_within_the_ride() -> None:
    spans: list[tuple[float, float]] = []
    peaks = {("deceleration", Ego(), "highest"): lambda begin, end: spans.append((begin, end))}
    asked = given(extremes=peaks).asked()
    priority._conflict(asked, None, Window(8.0, 12.0))
    priority._conflict(asked, None, Window(-5.0, 26.0))
    assert spans == [(8.0, 12.0), (0.0, NOW)]


def test_our_speed_is_told_beside_the_limit() -> None:
    now = {("speed", Ego()): 12.0} | LIMIT
    found = priority._limit(given(measures=now).asked(), PRESENT, Ego())
    assert found is not None
    assert (found.value, found.reference, found.extreme) == (12.0, 13.89, "highest")
    theirs = {("speed", ONE): 9.0} | LIMIT
    other = priority._limit(given(measures=theirs).asked(), PRESENT, ONE)
    assert other is not None
    assert (other.thing, other.value, other.reference) == (ONE, 9.0, 8.0)
    known = Measure("speed", Ego(), NOW, value=12.0, reference=13.0)
    at_once = given(measures={("speed", Ego()): known}).asked()
    assert priority._limit(at_once, PRESENT, Ego()) == known
    lost = Measure("speed", Ego(), NOW, gap="hidden", reference=13.0)
    assert priority._limit(given(measures={("speed", Ego()): lost}).asked(), PRESENT, Ego()) is None
    no_limit = {("speed", Ego()): 12.0}
    assert priority._limit(given(measures=no_limit).asked(), PRESENT, Ego()) is None
    assert priority._limit(given(measures=LIMIT).asked(), PRESENT, Ego()) is None


def test_the_highest_speed_of_a_stretch_is_told_with_the_limit_then() -> None:
    spans: list[tuple[float, float]] = []

    def highest(begin: float, end: float) -> Measure:
        spans.append((begin, end))
        return Measure("speed", Ego(), 9.0, value=15.0)

    limit = {("limit", Ego()): lambda t: 8.33 if t == 9.0 else 13.89}
    asked = given(extremes={("speed", Ego(), "highest"): highest}, measures=limit).asked()
    for about in (Window(8.0, 12.0), Window(10.0, 10.0), Window(-3.0, 30.0)):
        found = priority._limit(asked, about, Ego())
        assert found is not None
        assert (found.time, found.value, found.reference) == (9.0, 15.0, 8.33)
    assert spans == [(8.0, 12.0), (8.5, 11.5), (0.0, NOW)]


def test_what_both_did_then_bears_on_it() -> None:
    ours = (deed("stop", 9.0, 11.0), deed("change-left", 12.0, 14.0))
    theirs = (their(1, "pull-out", 8.0, 9.0, to=Ego()), their(2, "pull-out", 8.0, 9.0, to=Ego()))
    asked = given(deeds=(*ours, *theirs)).asked()
    found = priority._deeds(asked, 1, Window(9.0, 12.0))
    assert found == (theirs[0], *ours)
    assert priority._deeds(asked, None, Window(9.0, 12.0)) == ours
    assert priority._deeds(asked, 1, Window(14.1, 15.0)) == ours[1:]  # 3 s more on both sides
    assert priority._deeds(asked, 1, Window(17.1, 18.0)) == ()
    many = tuple(deed("change-left", t, t + 0.5) for t in (6.0, 7.0, 8.0, 9.0, 10.0))
    assert priority._deeds(given(deeds=many).asked(), 1, Window(5.0, 12.0)) == many[:4]


def test_what_is_minor_does_not_bear_on_it() -> None:
    minor = tuple(deed(a, 9.0, 10.0) for a in ("leave", "continue", "speed-up", "change-plan"))
    assert priority._deeds(given(deeds=minor).asked(), 1, Window(8.0, 12.0)) == ()


# --- fault --------------------------------------------------------------------------------------


def fault(question: Fault, span: Span | None = None, **more: Any) -> Any:
    return priority.fault(question, given(**more).asked(span))


def test_a_question_of_fault_is_about_the_last_crossing_or_its_event() -> None:
    found = fault(Fault())
    assert (found.time, found.vehicle, found.blame, found.legal) == (10.0, 1, True, False)
    assert found.rule == "give-way"
    braked = deed("brake", 4.0, 5.0)
    of_event = fault(Fault(Happens(Event("brake"))), deeds=(braked,))
    assert of_event.time == 5.0
    other = fault(Fault(Exists(ONE)), deeds=(braked,))
    assert other.time == 10.0
    said = fault(Fault(), Span(3.0, 5.0, said=True))
    assert said.time == 5.0


@pytest.mark.parametrize(
    ("question", "vehicle"),
    [
        (Fault(suspect=Vehicle(2)), 2),
        (Fault(Happens(Event("brake", Vehicle(2)))), 2),
        (Fault(Happens(Event("follow", object=Vehicle(2)))), 2),
        (Fault(Happens(Event("cut-in", Vehicle(2), ONE))), 2),
        (Fault(Happens(Event("cut-in", Vehicle(2), Ego())), suspect=ONE), 1),
        (Fault(), 1),
    ],
)
def test_it_is_of_whom_the_question_names(question: Fault, vehicle: int) -> None:
    assert fault(question, looks={1: look(1), 2: look(2)}).vehicle == vehicle


def test_a_question_of_law_has_the_speed_of_whom_is_suspected() -> None:
    highest = {("speed", Ego(), "highest"): 15.0, ("speed", ONE, "highest"): 9.0}
    of_us = fault(Fault(legal=True), extremes=highest, measures=LIMIT)
    assert (of_us.legal, of_us.limit.thing, of_us.limit.value) == (True, Ego(), 15.0)
    of_it = fault(Fault(legal=True, suspect=ONE), extremes=highest, measures=LIMIT)
    assert (of_it.limit.thing, of_it.limit.value, of_it.limit.reference) == (ONE, 9.0, 8.0)
    assert fault(Fault(), extremes=highest, measures=LIMIT).limit is None


def test_what_we_may_do_is_told_by_the_limit_and_the_rule() -> None:
    braked = deed("stop", 9.0, 11.0)
    highest = {("speed", Ego(), "highest"): 15.0}
    now = {("speed", Ego()): 12.0} | LIMIT
    asked = given(extremes=highest, measures=now, deeds=(braked,)).asked()
    present = priority.lawful(asked, None)
    assert (present.legal, present.blame, present.deeds) == (True, True, ())
    assert (present.time, present.limit and present.limit.value) == (NOW, 12.0)
    whole = priority.lawful(asked, WHOLE)
    assert (whole.time, whole.limit and whole.limit.value) == (10.0, 15.0)
    part = priority.lawful(asked, Window(3.0, 5.0))
    assert part.time == 5.0
