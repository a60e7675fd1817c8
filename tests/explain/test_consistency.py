"""Answers to the same thing asked twice, or asked otherwise, fit one another."""

from collections.abc import Sequence

import pytest
from msgspec.structs import replace

from planner.events import Event
from planner.trace import Action, HeldUp, PlanTrace
from tests.explain.asking import told
from tests.traces import Aim, End, Way, World, s1_ride, s2_ride, straight_track, trace_of
from xavi_dialogue.explain.engine import settled
from xavi_dialogue.explain.explanation import Explanation, NoExplanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.record import Record
from xavi_dialogue.language.context import SpeechContext
from xavi_dialogue.language.realise import realise

FORTY = 40.0 / 3.6  # [m/s]
MOVE_LEFT = Query(type="why_not", counterfactual=("change-left",))


def say(query: Query, record: Record) -> str:
    found = told(query, record)
    assert isinstance(found, Explanation | NoExplanation)
    context = SpeechContext(now=record.now, turn=3)
    return realise(query, found, context).text.partition(" You could ask")[0]


# --- A foil that could be had several times ---


def lane(time: float, left: float, plan: Action = "continue", alone: bool = False) -> PlanTrace:
    """A decision: straight on takes 10 s, and the left lane `left` [s]."""
    aims = {1: (Aim("continue", 1.0, (Way(("continue",)),)),)}
    plans: tuple[tuple[Action, ...], ...] = (("continue",), ("change-left",))
    world = World(
        aims,
        plans[:1] if alone else plans,
        lambda actions, _: (End(time=left if actions[0] == "change-left" else 10.0), 1),
        plan=(plan,),
    )
    return trace_of(world, draws=20, time=time, decision=int(time))


ON = (Event("action-started", 0.0, "continue", 0),)


def test_why_not_and_what_if_rest_on_the_latest_decision_as_long_as_one_just_drives_on() -> None:
    record = Record(16.0, (lane(1.0, left=15.0), lane(16.0, left=7.0)), ON)
    why_not = say(MOVE_LEFT, record)
    what_if = Query(type="what_if", counterfactual=("change-left",), tense="future")
    assert "about 3 seconds sooner" in why_not
    assert "about 3 seconds sooner" in say(what_if, record)


def test_an_earlier_decision_is_named_by_its_time() -> None:
    record = Record(16.0, (lane(9.4, left=15.0), lane(16.0, 0.0, alone=True)), ON)
    assert say(MOVE_LEFT, record).startswith("At 0:09, I stayed in my lane to get us there sooner.")


@pytest.mark.parametrize("now", [10.0, 12.0])
def test_a_decision_of_just_now_is_not(now: float) -> None:
    record = Record(now, (lane(9.4, left=15.0),), ON)
    assert "At 0:" not in say(MOVE_LEFT, record)


def test_a_question_that_names_what_was_done_is_answered_without_a_time() -> None:
    ride = s2_ride()
    named = Query(type="why_not", factual=("exit-right",), counterfactual=("exit-left",))
    record = Record(9.0, tuple(ride.traces), tuple(ride.events))
    assert not say(named, record).startswith("At ")
    assert say(replace(named, factual=None), record).startswith("At 0:05, I turned right")


# --- Whether we stopped ---


def halting(speeds: Sequence[float], *, over: bool = True) -> Record:
    """Chosen at 4 s: to stop. Speeds [m/s] at 5 Hz up to 8 s; the stop ends at 7 s, if at all."""
    world = World(
        {1: (Aim("continue", 1.0, (Way(("continue",)),)),)},
        (("stop",), ("exit-right",)),
        lambda plan, _: (End() if plan[0] == "stop" else End("termination"), 1),
    )
    onward = replace_plan(world, "exit-right")
    track = {0: straight_track(8.0, 0, speeds)}
    chosen = trace_of(world, draws=20, time=4.0, history={0: straight_track(4.0, 0, FORTY)})
    last = trace_of(onward if over else world, draws=20, time=8.0, decision=8, history=track)
    events = [Event("action-started", 4.0, "stop", 4)]
    if over:
        events += [Event("action-ended", 7.0, "stop", 7)]
        events += [Event("action-started", 7.0, "exit-right", 7)]
    return Record(8.0, (chosen, last), tuple(events))


def replace_plan(world: World, action: Action) -> World:
    return World(world.aims, world.plans, world.simulate, world.not_applicable, (action,))


SLOWED = (FORTY,) * 5 + tuple(FORTY - 0.6 * k for k in range(8)) + (FORTY - 4.2,) * 8
STOOD = (FORTY,) * 2 + tuple(FORTY - 1.2 * k for k in range(9)) + (0.0,) * 5 + (2.0,) * 5
DID_YOU_STOP = Query(type="what", factual=("stop",))
WHY_STOP = Query(type="why", factual=("stop",))


def test_a_stop_that_was_given_up_was_none() -> None:
    record = halting(SLOWED)
    assert say(DID_YOU_STOP, record) == "I did not stop. I slowed down at 0:05."
    assert say(WHY_STOP, record).startswith("I did not stop, but slowed down: turning right would")


def test_a_stop_that_came_to_a_standstill_was_one() -> None:
    record = halting(STOOD)
    found = told(DID_YOU_STOP, record)
    assert isinstance(found, Explanation)
    assert found.moment == pytest.approx(6.2)
    assert found.activity is not None
    assert found.activity.speed is None
    assert say(WHY_STOP, record).startswith("I stopped. Turning right would")


def test_who_is_still_slowing_down_has_not_stopped_yet() -> None:
    record = halting(SLOWED, over=False)
    assert say(DID_YOU_STOP, record) == "I have not stopped yet, but I plan to."


def test_driving_on_after_a_turn_is_no_going_straight_on() -> None:
    ride = s2_ride()
    on = Event("action-started", 8.0, "continue", 8)
    record = Record(9.0, tuple(ride.traces), (*ride.events, on))
    query = Query(type="what", factual=("exit-straight",))
    assert say(query, record) == "I did not go straight on. I turned right at 0:06."


def test_what_is_compared_are_two_things() -> None:
    ride = s1_ride()
    record = Record(8.0, tuple(ride.traces), tuple(ride.events))
    found = told(Query(type="confidence", factual=("change-left",)), record)
    assert isinstance(found, Explanation)
    doubted = Query(type="confidence", factual=found.counterfactual)
    text = realise(doubted, found, SpeechContext()).text
    assert "changing" not in text
    assert "moving to the left lane did better than" in text


# --- What another does, which stands or may do this or that ---


def standing(turns: float, halts: float) -> Record:
    """Vehicle 1 stands since 2 s; it turns right, stays, or goes straight on."""
    still, off = (0.0, 0.0, 0.0), (0.0, 2.0, 4.0)
    aims = {
        1: (
            Aim("exit-right", turns, (Way(("exit-right",), 1.0, off),)),
            Aim("stop", halts, (Way(("stop",), 1.0, still),)),
            Aim("continue", 1.0 - turns - halts, (Way(("continue",), 1.0, off),)),
        )
    }
    world = World(aims, (("continue",),), lambda plan, chosen: (End(), 1))
    track = straight_track(4.0, 1, (8.0,) * 5 + (4.0, 2.0, 1.0) + (0.0,) * 8)
    return Record(4.0, (trace_of(world, draws=20, time=4.0, history={1: track}),))


def test_who_may_be_in_the_way_of_what_waits_is_named_as_such() -> None:
    (trace,) = standing(0.4, 0.2).traces
    held = HeldUp(0, 4.0, 9.0, "blocked", 0.0, 0.0)
    (known,) = trace.predictions
    goals = tuple(
        replace(g, trajectories=tuple(replace(w, held_up=(held,)) for w in g.trajectories))
        if g.kind == "continue"
        else g
        for g in known.goals
    )
    blocked = replace(trace, predictions=(replace(known, goals=goals),))
    assert say(about("why"), Record(4.0, (blocked,))) == (
        "Vehicle 1 may be waiting because I am standing ahead of it."
    )


def about(kind: str, *, asked: bool = False, tense: str = "present") -> Query:
    factual = ("stop",) if asked else None
    return Query(type=kind, actor="vehicle:1", factual=factual, tense=tense)  # type: ignore[arg-type]


@pytest.mark.parametrize("asked", [True, False])
def test_why_it_stands_is_asked_of_its_waiting(asked: bool) -> None:
    text = say(about("why", asked=asked), standing(0.7, 0.2))
    assert text == (
        "I cannot tell what vehicle 1 is waiting for: I see nobody who is likely to be in its way."
    )


def test_that_it_stands_is_seen() -> None:
    assert say(about("confidence", asked=True), standing(0.7, 0.2)) == (
        "Yes: I see vehicle 1 standing still."
    )


def test_what_stands_does_not_stop_but_stays() -> None:
    record = standing(0.2, 0.6)
    chance = "I put the chance that vehicle 1 will stay where it is at 60 %"
    assert chance in say(about("confidence"), record)
    assert chance in say(about("how", asked=True), record)
    assert "stay where it is" in say(about("what"), record)


def test_a_belief_that_never_was_is_told_as_it_is_now() -> None:
    early, late = standing(0.45, 0.3), standing(0.6, 0.1)
    record = Record(6.0, (*early.traces, replace(late.traces[0], sim_time=6.0)))
    assert "at 10 %" in say(about("how", asked=True), record)


def test_whether_what_stands_will_stop_is_whether_it_will_stay() -> None:
    assert say(about("what", asked=True, tense="future"), standing(0.4, 0.35)) == (
        "I cannot tell yet whether vehicle 1 will turn right or stay where it is."
    )


def driving(turns: float) -> Record:
    aims = {
        1: (
            Aim("exit-right", turns, (Way(("exit-right",)),)),
            Aim("continue", (1.0 - turns) * 0.6, (Way(("continue",)),)),
            Aim("exit-left", (1.0 - turns) * 0.4, (Way(("exit-left",)),)),
        )
    }
    world = World(aims, (("continue",),), lambda plan, chosen: (End(), 1))
    return Record(4.0, (trace_of(world, draws=20, time=4.0),))


def test_below_one_half_nothing_is_believed() -> None:
    more = replace(about("why"), detail="more")
    assert say(about("why"), driving(0.8)) == "I believe vehicle 1 is going to turn right."
    assert say(about("why"), driving(0.48)) == "I think vehicle 1 may turn right."
    assert say(more, driving(0.45)) == (
        "I cannot tell yet whether vehicle 1 will turn right or go straight on. "
        "Judging by its path, I put the chance that it will turn right at 45 %."
    )


def test_what_is_improbable_is_not_expected_and_its_chance_is_told() -> None:
    turns = Query(type="what", actor="vehicle:1", factual=("exit-left",), tense="future")
    assert say(turns, driving(0.5)) == (
        "I do not expect vehicle 1 to turn left: I put the chance of that at 20 %."
    )
    either = settled(replace(turns, underspecified="direction"), driving(0.5))
    assert "not expect" not in say(either, driving(0.5))
