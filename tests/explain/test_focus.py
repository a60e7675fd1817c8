"""What a question says about when, found in the ride; and what is told of that time."""

import math
import random
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import get_args

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.events import Event
from planner.trace import SAMPLE_PERIOD, Track
from tests.explain.asking import told
from tests.traces import random_world, s1_ride, s1_world, trace_of
from xavi_dialogue.explain.explanation import Explanation, NeedRollout, NoExplanation
from xavi_dialogue.explain.focus import resolve, tensed
from xavi_dialogue.explain.query import Query, QueryAction, QueryType, Tense
from xavi_dialogue.explain.record import Record
from xavi_dialogue.explain.when import Focus, Landmark, Relation, When, pick
from xavi_dialogue.language.context import SpeechContext
from xavi_dialogue.language.realise import realise
from xavi_dialogue.transports.ride_file import load

#: Times [s] and speeds [m/s] between which the ego and vehicle 1 change theirs evenly.
EGO = ((0.0, 10.0), (3.0, 10.0), (5.0, 5.0), (8.0, 10.0), (12.0, 10.0), (14.0, 4.0), (18.0, 10.0))
OTHER = ((0.0, 10.0), (6.0, 10.0), (8.0, 4.0), (20.0, 4.0))
NOW = 20.0


def speed(profile, time: float) -> float:
    for (start, low), (end, high) in pairwise(profile):
        if start <= time <= end:
            return low + (high - low) * (time - start) / (end - start)
    return profile[-1][1]


def track(profile, until: float) -> Track:
    start = max(until - 10.0, 0.0)
    count = round((until - start) / SAMPLE_PERIOD) + 1
    speeds = tuple(speed(profile, start + k * SAMPLE_PERIOD) for k in range(count))
    way = tuple((start * 10.0 + 2.0 * k, 0.0) for k in range(count))
    return Track(start, way, (0.0,) * count, speeds)


def ride() -> Record:
    """The ego brakes at 3 and 12 s, changes left from 8.5 to 11 s, turns right from 15 to 18 s."""
    world = s1_world()
    traces = tuple(
        trace_of(
            world,
            draws=40,
            time=float(time),
            decision=time,
            history={0: track(EGO, float(time)), 1: track(OTHER, float(time))},
        )
        for time in range(1, 21)
    )
    events = (
        Event("action-started", 0.0, "continue", 0),
        Event("action-ended", 8.0, "continue", 0),
        Event("action-started", 8.0, "change-left", 8),
        Event("action-committed", 8.5, "change-left", 8),
        Event("action-ended", 11.0, "change-left", 8),
        Event("action-started", 11.0, "exit-right", 11),
        Event("gave-way", 13.0, "exit-right", 11, vehicle=1),
        Event("action-committed", 15.0, "exit-right", 11),
        Event("action-ended", 18.0, "exit-right", 11),
        Event("action-started", 18.0, "continue", 18),
    )
    return Record(NOW, traces, events)


RIDE = ride()
DEED = {"landmark": "deed"}
WHAT = Query(type="what")


def found(query: Query = WHAT, record: Record = RIDE, **when) -> Focus:
    focus = resolve(When(**when), record, query)
    assert isinstance(focus, Focus), focus
    return focus


def refused(query: Query = WHAT, **when) -> NoExplanation:
    refusal = resolve(When(**when), RIDE, query)
    assert isinstance(refusal, NoExplanation), refusal
    return refusal


def ask(query: Query, record: Record = RIDE, **when):
    focus = found(query, record, **when)
    return told(tensed(query, focus), replace(record, focus=focus))


def say(query: Query, record: Record = RIDE, **when) -> str:
    focus = found(query, record, **when)
    query = tensed(query, focus)
    answer = told(query, replace(record, focus=focus))
    assert not isinstance(answer, NeedRollout)
    return realise(query, answer, SpeechContext(now=record.now)).text


# --- Which part of the ride it is ----------------------------------------------------------------


def test_so_many_seconds_ago_is_an_instant_with_what_lies_around_it() -> None:
    focus = found(relation="before", landmark="now", seconds=10.0)
    assert (focus.moment, focus.instant) == (10.0, True)
    assert (focus.start, focus.end) == (8.0, 12.0)


def test_the_further_back_the_less_exactly_it_is_meant() -> None:
    near = found(relation="before", landmark="now", seconds=2.0)
    far = found(relation="before", landmark="now", seconds=15.0)
    assert far.end - far.start > near.end - near.start


@pytest.mark.parametrize(
    ("when", "start", "end"),
    [
        ({"relation": "within", "landmark": "now", "seconds": 8.0}, 12.0, 20.0),
        ({"relation": "within", "landmark": "clock", "clock": 4.0, "until": 9.0}, 4.0, 9.0),
        ({"relation": "before", "landmark": "clock", "clock": 7.0}, 0.0, 7.0),
        ({"relation": "after", "landmark": "clock", "clock": 7.0}, 7.0, 20.0),
        ({"relation": "before", "landmark": "junction"}, 0.0, 15.0),
        ({"relation": "after", "landmark": "junction"}, 18.0, 20.0),
        ({"relation": "before", "deeds": ("change-left",), **DEED}, 0.0, 8.5),
        ({"relation": "after", "deeds": ("change-left", "change-right"), **DEED}, 11.0, 20.0),
        ({"landmark": "start"}, 0.0, 5.0),
        ({"nth": 2}, 0.0, 20.0),
    ],
)
def test_windows(when, start: float, end: float) -> None:
    focus = found(**when)
    assert (focus.start, focus.end) == (pytest.approx(start), pytest.approx(end))


def test_at_the_junction_begins_on_the_way_to_it() -> None:
    focus = found(landmark="junction")
    assert focus.start < 12.0 < 18.0 < focus.end


def test_seconds_before_and_after_a_deed() -> None:
    deed = {"deeds": ("change-left",), **DEED}
    assert found(relation="before", seconds=2.0, **deed).moment == pytest.approx(6.5)
    assert found(relation="after", seconds=2.0, **deed).moment == pytest.approx(13.0)


def test_the_deed_of_another_vehicle() -> None:
    focus = found(landmark="deed", deeds=("slow-down",), actor="vehicle:1")
    assert focus.start <= 6.0 <= focus.moment <= 8.2 <= focus.end


def test_a_vehicle_that_is_described_is_the_one_that_did_it() -> None:
    named = found(landmark="deed", deeds=("slow-down",), actor="vehicle:1")
    assert found(landmark="deed", deeds=("slow-down",), actor="vehicle:truck") == named


def test_a_deed_without_an_actor_is_of_whom_the_question_is_about() -> None:
    when = {"landmark": "deed", "deeds": ("slow-down",), "relation": "before"}
    other = found(Query(type="what", actor="vehicle:1"), **when)
    assert other.end == pytest.approx(6.0, abs=0.3)
    assert found(**when).end == pytest.approx(12.0, abs=0.3)


def test_which_of_several_deeds() -> None:
    first = found(landmark="deed", deeds=("slow-down",), which=1, relation="before")
    assert first.end == pytest.approx(3.0, abs=0.3)
    last = found(landmark="deed", deeds=("slow-down",), which=-1, relation="before")
    assert last.end == pytest.approx(12.0, abs=0.3)


# --- What there is not ---------------------------------------------------------------------------


def test_outside_the_record() -> None:
    refusal = refused(relation="before", landmark="now", seconds=60.0)
    assert refusal.reason == "outside-record"
    assert refusal.facts == {"time": -40.0, "since": 0.0, "until": 20.0}
    said = realise(Query(type="what"), refusal, SpeechContext(now=NOW)).text
    assert said.startswith("My record goes from 0:00 to 0:20, and that time lies outside it.")


def test_what_is_yet_to_come_has_not_happened() -> None:
    assert refused(landmark="clock", clock=50.0).reason == "outside-record"


def test_a_landmark_that_never_was() -> None:
    refusal = refused(relation="before", landmark="roundabout")
    assert refusal.reason == "did-not-happen"
    said = realise(Query(type="what"), refusal, SpeechContext(now=NOW)).text
    assert said.startswith("I know of no roundabout that we have come to so far.")


def test_a_deed_that_never_was() -> None:
    refusal = refused(relation="after", landmark="deed", deeds=("exit-left", "exit-right"), which=2)
    assert refusal.reason == "did-not-happen"
    said = realise(Query(type="what"), refusal, SpeechContext(now=NOW)).text
    assert said.startswith("I turned only once, at 0:15.")


def test_a_vehicle_that_never_was() -> None:
    refusal = refused(landmark="deed", deeds=("stop",), actor="vehicle:9")
    assert (refusal.reason, refusal.facts["vehicle"]) == ("unknown-vehicle", 9)


def test_a_place_that_only_belongs_to_what_is_asked_about_restricts_nothing() -> None:
    query = Query(type="why_not", counterfactual=("exit-left",))
    assert resolve(When(landmark="roundabout"), RIDE, query) is None


def test_a_record_without_a_decision_restricts_nothing() -> None:
    assert resolve(When(landmark="start"), Record(0.0)) is None


# --- What is told of it --------------------------------------------------------------------------


def test_what_was_under_way_is_told_with_the_speed_then() -> None:
    answer = ask(Query(type="what"), relation="before", landmark="now", seconds=16.0)
    assert isinstance(answer, Explanation)
    assert answer.activity is not None
    assert answer.activity.speed == pytest.approx(7.5)
    assert answer.activity.trend == "slowing"
    assert (answer.then, answer.instant) == (4.0, True)


@pytest.mark.parametrize(
    ("query", "when", "text"),
    [
        (
            Query(type="what", tense="present"),
            {"relation": "before", "landmark": "now", "seconds": 16.0},
            "At 0:04, I was going straight on at 27 km/h, slowing down.",
        ),
        (
            Query(type="what"),
            {"relation": "before", "landmark": "now", "seconds": 10.0},
            "At 0:10, I was moving to the left lane at 36 km/h.",
        ),
        (
            Query(type="what"),
            {"relation": "before", "landmark": "junction"},
            "At 0:08, I moved to the left lane at 36 km/h, speeding up.",
        ),
        (
            Query(type="what"),
            {"relation": "after", "deeds": ("change-left",), **DEED},
            "At 0:15, I turned right at 20 km/h, speeding up.",
        ),
        (
            Query(type="what", actor="vehicle:1"),
            {"landmark": "clock", "clock": 7.0},
            "At 0:07, vehicle 1 was slowing down, at 25 km/h.",
        ),
        (
            Query(type="when", factual=("slow-down",)),
            {"nth": 1},
            "I slowed down at 0:03, about 17 seconds ago.",
        ),
    ],
)
def test_what_is_said(query: Query, when, text: str) -> None:
    assert say(query, **when) == text


def test_the_first_time_is_not_the_last() -> None:
    query = Query(type="why", factual=("slow-down",))
    first, second = ask(query, nth=1), ask(query, nth=2)
    assert isinstance(first, Explanation)
    assert isinstance(second, Explanation)
    assert first.then == pytest.approx(3.0, abs=0.3)
    assert second.then == pytest.approx(12.0, abs=0.3)
    assert first.sim_time < second.sim_time
    unsaid = told(query, RIDE)
    assert isinstance(unsaid, Explanation)
    assert (unsaid.moment, unsaid.then) == (second.moment, None)


def test_the_third_time_of_two() -> None:
    said = say(Query(type="why", factual=("slow-down",)), nth=3)
    assert said.startswith("I slowed down only 2 times, the last of them at 0:12.")


def test_what_was_done_at_another_time_is_told() -> None:
    query = Query(type="why", factual=("change-left",))
    said = say(query, relation="before", landmark="now", seconds=2.0)
    assert said.startswith("I did not move to the left lane at that time. I moved to the left lane")
    answer = ask(query, relation="before", landmark="now", seconds=2.0)
    assert isinstance(answer, NoExplanation)
    assert (answer.facts["time"], answer.facts["elsewhere"]) == (8.5, True)


def test_the_nearest_other_time_is_told() -> None:
    query = Query(type="why", factual=("slow-down",))
    answer = ask(query, relation="before", landmark="now", seconds=12.0)
    assert isinstance(answer, NoExplanation)
    assert answer.facts["time"] == pytest.approx(3.0, abs=0.3)


def test_what_another_vehicle_did_at_another_time_is_told() -> None:
    query = Query(type="why", actor="vehicle:1", factual=("slow-down",))
    answer = ask(query, landmark="clock", clock=15.0)
    assert isinstance(answer, NoExplanation)
    assert answer.facts["time"] == pytest.approx(6.0, abs=0.3)


def test_just_now_is_what_was_done_last_if_nothing_was_done_since() -> None:
    query = Query(type="why", factual=("slow-down",))
    answer = ask(query, relation="within", landmark="now", seconds=2.0, rough=True)
    assert isinstance(answer, Explanation)
    assert answer.then == pytest.approx(12.0, abs=0.3)


def test_the_decision_is_the_one_of_that_time() -> None:
    query = Query(type="why_not", counterfactual=("continue",))
    focus = found(query, relation="before", landmark="now", seconds=16.0)
    answer = told(query, replace(RIDE, focus=focus))
    assert isinstance(answer, Explanation)
    assert focus.start <= answer.sim_time <= focus.end


@pytest.mark.parametrize(
    ("when", "text"),
    [
        ({"relation": "after", "landmark": "now", "seconds": 2.0, "ahead": True}, "be going"),
        ({"relation": "after", "landmark": "now", "seconds": 5.0, "ahead": True}, "be turning"),
        ({"landmark": "junction"}, "turn right"),
        ({"relation": "after", "landmark": "junction"}, "go straight on"),
        ({"relation": "before", "deeds": ("exit-right",), **DEED}, "go straight on"),
    ],
)
def test_what_the_plan_of_a_recorded_ride_leads_to(root: Path, when, text: str) -> None:
    driven = load((root / "transcripts/rides/s2-0.ride.jsonl.gz").read_bytes())
    record = Record(
        2.0,
        tuple(trace for trace in driven.traces if trace.sim_time <= 2.0),
        tuple(event for event in driven.events if event.sim_time <= 2.0),
    )
    said = say(Query(type="what", tense="future"), record, **when)
    assert said.startswith("At about 0:0")
    assert f"I expect to {text}" in said


def test_before_a_turn_that_is_yet_to_come_is_all_so_far(root: Path) -> None:
    driven = load((root / "transcripts/rides/s2-0.ride.jsonl.gz").read_bytes())
    traces = tuple(trace for trace in driven.traces if trace.sim_time <= 4.0)
    record = Record(4.0, traces, tuple(e for e in driven.events if e.sim_time <= 4.0))
    query = Query(type="why", factual=("slow-down",))
    focus = found(query, record, relation="before", deeds=("exit-right",), **DEED)
    assert (focus.start, focus.end, focus.ahead) == (0.0, 4.0, False)


def test_what_is_to_come_is_read_off_the_plan() -> None:
    s1 = s1_ride()
    record = Record(4.0, s1.traces, s1.events)
    query = Query(type="what", tense="future")
    focus = found(query, record, relation="after", landmark="now", seconds=3.0, ahead=True)
    assert (focus.moment, focus.ahead) == (7.0, True)
    far = told(query, replace(record, focus=Focus(start=900, end=900, moment=900, ahead=True)))
    assert isinstance(far, NoExplanation)
    assert far.reason == "outside-record"


def test_braking_that_was_no_stop_is_called_what_it_was() -> None:
    query = Query(type="what", factual=("stop",))
    assert say(query, relation="within", landmark="clock", clock=2.0, until=6.0) == (
        "At 0:03, I slowed down."
    )
    elsewhere = ask(query, landmark="clock", clock=9.0)
    assert isinstance(elsewhere, NoExplanation)
    assert elsewhere.facts["happened"] == ("slow-down",)


def test_a_time_that_is_a_decision_s_is_called_so() -> None:
    query = Query(type="why", counterfactual=("continue",))
    said = say(query, relation="before", landmark="now", seconds=16.0)
    assert said.startswith("By my decision of 0:")


def test_our_own_deed_is_denied_as_ours() -> None:
    query = Query(type="what", actor="vehicle:1")
    refusal = refused(query, landmark="deed", deeds=("exit-left",), actor="ego")
    said = realise(query, refusal, SpeechContext(now=NOW)).text
    assert said.startswith("I did not turn left.")


# --- Whatever is asked ---------------------------------------------------------------------------

number = st.none() | st.floats(0.0, 90.0)
count = st.none() | st.sampled_from([-3, -2, -1, 1, 2, 3, 9])
whens = st.builds(
    When,
    relation=st.sampled_from(get_args(Relation)),
    landmark=st.none() | st.sampled_from(get_args(Landmark)),
    seconds=number,
    rough=st.booleans(),
    ahead=st.booleans(),
    clock=number,
    until=number,
    deeds=st.lists(st.sampled_from(get_args(QueryAction)), max_size=2).map(tuple),
    actor=st.sampled_from([None, "ego", "vehicle:0", "vehicle:1", "vehicle:8", "vehicle:it"]),
    which=count,
    nth=count,
)
actions = st.none() | st.lists(st.sampled_from(get_args(QueryAction)), max_size=2).map(tuple)
queries = st.builds(
    Query,
    type=st.sampled_from(get_args(QueryType)),
    actor=st.sampled_from(["ego", "vehicle:1", "vehicle:2", "vehicle:7"]),
    factual=actions,
    counterfactual=actions,
    tense=st.sampled_from(get_args(Tense)),
)


def some_ride(seed: int, now: float) -> Record:
    world = random_world(random.Random(seed))
    traces = tuple(
        trace_of(world, draws=4, time=float(time), decision=time, seed=seed) for time in (2, 4, 5)
    )
    first = world.plans[0][0]
    events = (
        Event("action-started", 2.0, first, 2),
        Event("action-committed", 3.0, first, 2),
        Event("action-ended", 4.5, first, 2),
        Event("gave-way", 4.6, first, 2, vehicle=1),
        Event("arrived", 5.5),
    )
    return Record(now, traces, events)


@given(whens, queries, st.integers(0, 200), st.sampled_from([0.0, 2.0, 4.2, 5.0, 30.0]))
def test_any_time_in_any_ride_is_found_or_refused(when, query, seed, now) -> None:
    record = some_ride(seed, now)
    focus = resolve(when, record, query)
    assert focus == resolve(when, record, query)
    if not isinstance(focus, Focus):
        assert focus is None or focus.reason in get_args(type(focus).__annotations__["reason"])
        return
    assert math.isfinite(focus.start)
    assert math.isfinite(focus.end)
    assert focus.start <= focus.moment <= focus.end or focus.ahead
    if focus.ahead:
        assert focus.start >= now
    else:
        assert min(0.0, now) <= focus.start <= focus.end <= now
    query = tensed(query, focus)
    answer = told(query, replace(record, focus=focus))
    if not isinstance(answer, NeedRollout):
        assert realise(query, answer, SpeechContext(now=now)).text


@given(
    st.floats(0.0, 20.0),
    st.floats(0.0, 20.0),
    st.lists(st.tuples(st.floats(0.0, 20.0), st.floats(0.0, 5.0)), max_size=6),
    count,
)
def test_what_is_picked_lies_within(start, length, spans, nth) -> None:
    items = sorted((begin, begin + lasting) for begin, lasting in spans)
    focus = Focus(start=start, end=start + length, moment=start, nth=nth)
    picked = pick(focus, items, lambda span: span)
    assert picked is None or focus.meets(*picked)
    inside = [item for item in items if focus.meets(*item)]
    if nth is None:
        assert picked == (inside[-1] if inside else None)
    else:
        assert (picked is None) == (len(inside) < abs(nth))
