"""How, how to avoid, what it hangs on, how sure, when: each answer against its own reckoning."""

import math
from itertools import pairwise

import msgspec
import pytest
from scipy.special import betaincinv

from planner.events import Event
from planner.trace import EgoGoal, PlanTrace, WhatIf
from tests.explain.asking import told
from tests.traces import (
    Aim,
    End,
    Ride,
    Way,
    World,
    s1_ride,
    s1_world,
    s2_ride,
    straight_track,
    trace_of,
)
from xavi_dialogue.explain.certainty import UTMOST, at_least
from xavi_dialogue.explain.conditions import Condition, condition
from xavi_dialogue.explain.engine import explain
from xavi_dialogue.explain.explanation import Explanation, NeedRollout, NoExplanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.record import Record

S1, S2 = s1_ride(), s2_ride()


def record(ride: Ride, now: float | None = None, extra=()) -> Record:
    return Record(ride.now if now is None else now, ride.traces, ride.events, extra=tuple(extra))


def ask(ride: Ride, now: float | None = None, extra=(), **query):
    return told(Query(**query), record(ride, now, extra))


def driven(trace: PlanTrace, line) -> PlanTrace:
    """The trace with the lines of its rollouts: `line(rollout)` gives path and speed."""
    rollouts = []
    for rollout in trace.rollouts:
        path, speed = line(rollout)
        rollouts.append(msgspec.structs.replace(rollout, path=tuple(path), speed=tuple(speed)))
    return msgspec.structs.replace(trace, rollouts=tuple(rollouts))


def straight(speeds):
    """A line to the east at given speeds [m/s], 5 Hz."""
    x, path = 0.0, []
    for speed in speeds:
        path.append((round(x, 1), 0.0))
        x += 0.2 * speed
    return path, speeds


# How sure ------------------------------------------------------------------------------------


@pytest.mark.parametrize(("share", "n"), [(1.0, 12), (1.0, 1), (0.8, 30), (0.5, 7), (0.0, 9)])
def test_the_bound_is_the_5_percent_point_of_jeffreys_posterior(share, n):
    good = share * n
    exact = betaincinv(good + 0.5, n - good + 0.5, 0.05)
    assert at_least(share, n) == pytest.approx(exact, abs=2e-3)


def test_a_choice_is_as_sure_as_the_situations_in_which_it_did_better():
    found = ask(S1, type="confidence", factual=("change-left",))
    sure = found.certainty
    # Staying takes 16 s where vehicle 1 turns right (0.8), else 11.5 s; changing lanes 12 s.
    assert (sure.about, found.counterfactual) == ("choice", ("continue",))
    assert sure.share == pytest.approx(0.8)
    assert (sure.good, sure.situations) == (2, 4)
    assert sure.low == pytest.approx(0.8)  # every situation was tried
    again = ask(S1, type="confidence", factual=("change-left",), tense="present")
    assert again.certainty == sure


def test_a_plan_that_always_worked_is_not_certain():
    sure = ask(S1, 4.0, type="confidence").certainty
    assert (sure.about, sure.share) == ("plan", pytest.approx(1.0))
    assert sure.good == sure.situations
    assert sure.low == UTMOST
    one = msgspec.structs.replace(S1.traces[1], rollouts=S1.traces[1].rollouts[:16])
    few = ask(Ride(4.0, (one,), S1.events), 4.0, type="confidence")
    if isinstance(few, Explanation):
        assert few.certainty.low < UTMOST


def late_ride() -> Ride:
    """Where vehicle 1 goes on (0.7), the ego is not there in time; where it turns (0.3), it is."""
    aims = {
        1: (
            Aim("continue", 0.7, (Way(("continue",)),)),
            Aim("exit-right", 0.3, (Way(("exit-right",)),)),
        )
    }

    def simulate(plan, chosen):
        return (End("termination") if chosen[1][0] == "continue" else End(time=9.0)), 1

    world = World(aims, (("continue",),), simulate)
    return Ride(5.0, (trace_of(world, time=4.0),), ())


def test_who_is_late_is_still_on_the_way():
    found = ask(late_ride(), type="confidence", tense="present")
    assert found.certainty.share == pytest.approx(1.0)
    assert (found.certainty.good, found.certainty.late) == (2, 1)
    assert found.outcome.probability == pytest.approx(0.3)
    when = ask(late_ride(), type="when", tense="future")
    assert when.arrival is None
    assert when.least == pytest.approx(30.0 - 1.0)  # the horizon, seen from 1 s later


# How we knew ---------------------------------------------------------------------------------


def watched(*chances: float, speeds=(10.0, 10.0, 4.0)) -> Ride:
    """Decisions at 4, 5, 6 s with growing belief that vehicle 1 turns right; it drives so."""
    traces = []
    for k, chance in enumerate(chances):
        aims = {
            1: (
                Aim("exit-right", chance, (Way(("exit-right",), 1.0, (9.0, 5.0, 3.0)),)),
                Aim("continue", 1.0 - chance, (Way(("continue",)),)),
            )
        }
        world = World(aims, (("continue",),), lambda plan, chosen: (End(), 1))
        ramp = [speeds[0]] * 5
        for one, other in pairwise(speeds):
            ramp += [one + (other - one) * step / 5.0 for step in range(1, 6)]
        track = straight_track(4.0 + k, 1, ramp[: 5 + 5 * k])
        trace = trace_of(world, time=4.0 + k, decision=k, history={1: track})
        goals = trace.predictions[0].goals
        goals = (
            msgspec.structs.replace(goals[0], likelihood=0.9),
            msgspec.structs.replace(goals[1], likelihood=0.1),
        )
        predicted = msgspec.structs.replace(trace.predictions[0], goals=goals)
        traces.append(msgspec.structs.replace(trace, predictions=(predicted,)))
    return Ride(3.0 + len(chances), tuple(traces), ())


def test_how_we_knew_is_told_by_what_it_did_when_the_belief_grew():
    found = ask(watched(0.4, 0.45, 0.9), type="how", actor="vehicle:1", factual=("exit-right",))
    grounds = found.grounds
    assert grounds.probability == pytest.approx(0.9)
    assert (grounds.start, grounds.end) == (5.0, 6.0)
    assert (grounds.before, grounds.after) == (pytest.approx(0.45), pytest.approx(0.9))
    assert grounds.since == 6.0
    assert (grounds.speed_from, grounds.speed_to) == (pytest.approx(10.0), pytest.approx(4.0))
    assert grounds.deed == "slow-down"
    assert grounds.rival == ("continue",)
    assert grounds.fit == pytest.approx(9.0)
    assert not grounds.done


def test_what_was_never_believed_was_not_known():
    found = ask(watched(0.4, 0.3, 0.2), type="how", actor="vehicle:1", factual=("exit-right",))
    assert found.grounds.since is None
    assert found.grounds.latest == pytest.approx(0.2)
    bare = ask(watched(0.2, 0.7), type="how", actor="vehicle:1")
    assert bare.grounds.actions == ("exit-right",)
    unknown = ask(S1, type="how", actor="vehicle:9", factual=("stop",))
    assert unknown.reason == "unknown-vehicle"


@pytest.mark.parametrize(
    ("kinds", "actions", "rival"),
    [
        (("exit-right", "continue"), ("exit-right",), ("continue",)),
        (("exit-right", "continue", "exit-left", "stop"), (), ()),
    ],
)
def test_of_many_things_as_likely_none_is_expected(kinds, actions, rival):
    aims = tuple(Aim(kind, 1.0 / len(kinds), (Way((kind,)),)) for kind in kinds)
    world = World({1: aims}, (("continue",),), lambda plan, chosen: (End(), 1))
    trace = trace_of(world, time=4.0, history={1: straight_track(4.0, 1, [5.0] * 6)})
    found = ask(Ride(4.0, (trace,), ()), type="what", actor="vehicle:1", tense="present")
    assert (found.activity.actions, found.rival) == (actions, rival)
    assert (found.destination is None) == (not actions)
    asked = {"type": "confidence", "actor": "vehicle:1", "factual": ("exit-right",)}
    chance = ask(Ride(4.0, (trace,), ()), **asked).activity.probability
    assert chance == pytest.approx(1.0 / len(kinds))


# How we decided, and how we will go about it -----------------------------------------------------


def test_how_a_decision_was_found():
    for query in ({"tense": "past"}, {"tense": "present"}):
        found = ask(S1, type="how", factual=("change-left",), **query)
        assert found.options[0] == "change-left"
        assert set(found.options) == {r.actions[0].action for r in S1.traces[1].rollouts}
        assert found.counterfactual == ("continue",)
        assert found.evidence.rollouts == len(S1.traces[1].rollouts)
        time = next(e.delta for e in found.effects if e.component == "time")
        assert time == pytest.approx(0.8 * 16.0 + 0.2 * 11.5 - 12.0)
    never = ask(S1, type="how", factual=("exit-left",))
    assert never.reason == "did-not-happen"
    general = ask(S1, type="how", factual=("exit-left",), tense="present")
    assert isinstance(general, Explanation)


def test_how_we_will_go_about_it_is_the_plan_with_its_times():
    found = ask(S1, 4.0, type="how", tense="future")
    assert [(step.action, step.moment) for step in found.steps] == [
        ("change-left", 4.0),
        ("continue", 6.0),
    ]
    assert found.arrival == pytest.approx(12.0)


# How to avoid ----------------------------------------------------------------------------------


def crash_ride(other_collides: float = 0.0) -> Ride:
    """The ego stays in its lane and runs into vehicle 1, as it does with 0.8 in its rollouts."""
    base = s1_world(cut_in_collides=True)

    def simulate(plan, chosen):
        if plan[0] == "change-left" and chosen[2][0] == "exit-right" and other_collides:
            return End("collision", collided_with=2), 1
        return base.simulate(plan, chosen)

    plans = tuple(plan for plan in base.plans if plan[0] in ("continue", "change-left"))
    world = World(base.aims, plans, simulate, base.not_applicable, ("continue",))
    traces = (trace_of(world, time=4.0, decision=4),)
    events = (
        Event("action-started", 0.0, "continue", 0),
        Event("collided", 8.0, vehicle=1),
    )
    return Ride(8.0, traces, events)


def test_a_collision_could_have_been_avoided():
    for event in ("crash", None):
        found = ask(crash_ride(), type="how_avoid", event=event)
        assert found.counterfactual[0] == "change-left"
        avoidance = found.avoidance
        assert (avoidance.mishap, avoidance.possible) == ("collision", True)
        assert (avoidance.risk, avoidance.other) == (pytest.approx(0.8), 0.0)
        assert (found.sim_time, found.moment) == (4.0, 8.0)


def test_a_way_out_that_collides_as_well_is_none():
    found = ask(crash_ride(other_collides=0.6), type="how_avoid", event="crash")
    assert found.avoidance.possible is False
    assert found.avoidance.other == pytest.approx(0.6)


def test_why_we_collided_is_what_was_expected_and_what_would_have_avoided_it():
    found = ask(crash_ride(), type="why", event="crash")
    impact = found.impact
    assert (impact.vehicle, impact.decided, found.moment) == (1, 4.0, 8.0)
    assert impact.chance == pytest.approx(0.8)
    assert (found.counterfactual[0], found.avoidance.possible) == ("change-left", True)
    when = ask(crash_ride(), type="when", event="crash")
    assert (when.moment, when.impact, when.avoidance) == (8.0, impact, None)


def test_a_collision_before_anything_was_planned_has_no_known_reason():
    early = crash_ride()
    events = (Event("collided", 2.0, vehicle=1),)
    found = ask(Ride(8.0, early.traces, events), type="why", event="crash")
    assert (found.impact.vehicle, found.impact.chance, found.avoidance) == (1, None, None)


def test_what_did_not_happen_needs_no_avoiding():
    assert ask(S1, type="how_avoid", event="crash").facts["what"] == "crash"
    assert ask(S1, type="how_avoid", factual=("stop",)).reason == "did-not-happen"
    assert ask(S1, type="how_avoid").reason == "did-not-happen"


def test_a_stop_could_have_been_avoided_by_the_option_whose_speeds_have_none():
    world = s1_world()
    world = World(world.aims, world.plans, world.simulate, world.not_applicable, ("continue",))
    halting = [10.0 - 0.5 * k for k in range(20)] + [0.0] * 20

    def line(rollout):
        stays = rollout.actions[0].action == "continue"
        return straight(halting if stays else [10.0] * 40)

    speeds = [10.0 - 0.5 * k for k in range(21)]
    ego = straight_track(8.0, 0, speeds)
    first = driven(trace_of(world, time=4.0, decision=4), line)
    last = trace_of(world, time=8.0, decision=8, history={0: ego})
    ride = Ride(8.0, (first, last), (Event("action-started", 0.0, "continue", 0),))
    found = ask(ride, type="how_avoid", factual=("stop",))
    assert found.avoidance.mishap == "stop"
    assert found.avoidance.possible
    assert (found.avoidance.risk, found.avoidance.other) == (pytest.approx(1.0), 0.0)
    assert found.counterfactual[0] == "change-left"
    # It brakes by 0.5 m/s in 0.2 s, which is 2.5 m/s2: not hard.
    assert ask(ride, type="how_avoid").avoidance.mishap == "stop"


# What it hangs on ------------------------------------------------------------------------------


def test_what_would_have_to_change_is_a_vehicles_conduct():
    found = ask(S1, type="sensitivity", counterfactual=("continue",))
    assert found.pivot.kind == "conduct"
    assert (found.pivot.vehicle, found.pivot.actions) == (1, ("continue",))
    assert found.pivot.probability == pytest.approx(0.2)


def test_nothing_changes_a_way_that_leads_elsewhere():
    found = ask(S1, type="sensitivity", counterfactual=("exit-right",))
    assert (found.pivot.kind, found.outcome.name) == ("none", "dead")


def test_what_mattered_most_is_the_first_cause():
    for query in ({}, {"factual": ("change-left",)}):
        found = ask(S1, type="sensitivity", **query)
        assert (found.pivot.kind, found.pivot.vehicle) == ("factor", 1)
        assert found.causes[0].vehicle == 1


def alone_in(world: World) -> PlanTrace:
    """The decision without vehicle 1: staying in the lane is best."""
    alone = World(
        {2: world.aims[2]},
        (("continue",), ("change-left", "continue")),
        lambda plan, chosen: world.simulate(plan, {1: ("continue", 0)}),
    )
    return trace_of(alone, draws=24)


def test_whether_it_stands_without_a_vehicle_is_planned_again():
    query = Query(
        type="sensitivity",
        factual=("change-left",),
        condition="if vehicle 1 had not been there",
    )
    found = explain(query, record(S1))
    assert found == NeedRollout(trace_id=S1.traces[1].trace_id, removed=1)
    answer = explain(query, record(S1, extra=[alone_in(s1_world())]))
    assert answer.counterfactual[0] == "continue"
    assert [(c.vehicle, c.decision_changes) for c in answer.causes] == [(1, True)]


@pytest.mark.parametrize(
    ("words", "changes"),
    [("if vehicle 1 had gone straight", True), ("if vehicle 1 had turned right", False)],
)
def test_whether_it_stands_were_a_vehicle_to_do_otherwise(words, changes):
    found = ask(S1, type="sensitivity", factual=("change-left",), condition=words)
    assert found.causes[0].decision_changes is changes


def test_conditions_that_are_none_of_ours_are_declined():
    for words in ("if it had rained", "if we had been late"):
        found = ask(S1, type="sensitivity", factual=("change-left",), condition=words)
        assert found.facts == {"what": "unsupported-condition"}
    unknown = ask(S1, type="sensitivity", condition="without vehicle 8")
    assert unknown.reason == "unknown-vehicle"


@pytest.mark.parametrize(
    ("words", "meant"),
    [
        ("if vehicle 1 had not been there", Condition(1, (), True)),
        ("without vehicle 12", Condition(12, (), True)),
        ("if there was no vehicle 2", Condition(2, (), True)),
        ("if vehicle 3 had not stopped", Condition(3, ("stop",), True)),
        ("if vehicle 3 had turned left", Condition(3, ("exit-left",), False)),
        ("if vehicle 3 changed to the right lane", Condition(3, ("change-right",), False)),
        ("if vehicle 3 had gone straight on", Condition(3, ("continue",), False)),
        ("if vehicle 3 were blue", None),
        ("if it had not been there", None),
    ],
)
def test_conditions(words, meant):
    assert condition(words) == meant


# When ------------------------------------------------------------------------------------------


def turning(rollout):
    """3 s straight to the east, then a left turn over 2 s, then north."""
    x, y, heading, path = 0.0, 0.0, 0.0, []
    for k in range(40):
        path.append((round(x, 1), round(y, 1)))
        heading = min(max((0.2 * (k + 1) - 3.0) / 2.0, 0.0), 1.0) * math.pi / 2.0
        x, y = x + math.cos(heading), y + math.sin(heading)
    return path, [5.0] * 40


def test_when_a_planned_turn_begins_is_read_off_the_rollouts():
    world = World({}, (("exit-left",),), lambda plan, chosen: (End(), 1))
    ride = Ride(4.5, (driven(trace_of(world, time=4.0), turning),), ())
    found = ask(ride, type="when", factual=("exit-left",), tense="future")
    assert found.moment == pytest.approx(7.4, abs=0.4)
    assert found.span[0] <= found.moment <= found.span[1]
    other = ask(ride, type="when", factual=("exit-right",), tense="future")
    assert other.reason == "did-not-happen"


def test_how_long_we_stand():
    aims = {1: (Aim("continue", 1.0, (Way(("continue",)),)),)}
    world = World(aims, (("exit-right",),), lambda plan, chosen: (End(), 1))
    standing = straight_track(9.0, 0, [8.0, 4.0, 0.0, 0.0, 0.0])
    waiting = [0.0] * 20 + [0.5 * k for k in range(20)]
    trace = trace_of(world, time=9.0, history={0: standing})
    ride = Ride(9.0, (driven(trace, lambda rollout: straight(waiting)),), ())
    found = ask(ride, type="when", factual=("stop",), tense="present")
    assert found.moment == pytest.approx(9.0 + 0.2 * 22)  # 1 m/s is reached at sample 22
    assert found.activity.trend == "standing"
    for_ever = Ride(9.0, (driven(trace, lambda rollout: straight([0.0] * 30)),), ())
    stuck = ask(for_ever, type="when", factual=("stop",), tense="future")
    assert (stuck.moment, stuck.least) == (None, pytest.approx(5.8))


def test_a_goal_beyond_the_horizon_takes_longer_than_the_way_to_where_we_plan():
    traces = tuple(
        msgspec.structs.replace(trace, waypoint=EgoGoal("main_in", 80.0, None))
        for trace in S1.traces
    )
    far = Ride(S1.now, traces, S1.events)
    found = ask(far, 4.0, type="when", tense="future")
    assert (found.arrival, found.least) == (None, pytest.approx(12.0))


def test_when_another_vehicle_did_it():
    found = ask(S1, type="when", actor="vehicle:1", factual=("change-right",))
    assert 0.5 < found.moment < 2.5
    assert ask(S1, type="when", actor="vehicle:1", factual=("stop",)).reason == "did-not-happen"


# Suspects, and vehicles that are gone -----------------------------------------------------------


def test_a_suspect_is_confirmed_or_cleared():
    blamed = {"type": "why", "factual": ("change-left",), "counterfactual": ("continue",)}
    yes = ask(S1, **blamed, hypothesised_cause="vehicle:1")
    assert (yes.suspect.vehicle, yes.suspect.part) == (1, "main")
    no = ask(S1, **blamed, hypothesised_cause="vehicle:2")
    assert (no.suspect.vehicle, no.suspect.part) == (2, "none")
    assert [cause.vehicle for cause in no.causes] == [1]
    unknown = ask(S1, **blamed, hypothesised_cause="vehicle:9")
    assert isinstance(unknown, NoExplanation)
    assert unknown.reason == "unknown-vehicle"


def test_a_vehicle_that_left_is_told_with_when_it_was_seen_last():
    gone = trace_of(World({}, (("continue",),), lambda plan, chosen: (End(), 1)), time=9.0)
    ride = Ride(9.0, (*S1.traces, gone), S1.events)
    for query in ("what", "where_goal", "confidence"):
        found = ask(ride, type=query, actor="vehicle:1", tense="present")
        assert found.seen == 7.0
        assert ask(S1, type=query, actor="vehicle:1", tense="present").seen is None
    hidden = msgspec.structs.replace(S1.traces[-1], unseen={1: 6.2})
    ride = Ride(7.0, (*S1.traces[:-1], hidden), S1.events)
    assert ask(ride, type="where_goal", actor="vehicle:1", tense="present").seen == 6.2


def test_what_no_record_provides_for_is_planned_again_with_the_vehicle_acting_so():
    query = Query(type="what_if", actor="vehicle:1", counterfactual=("change-left",))
    found = explain(query, record(S1))
    assert isinstance(found, NeedRollout)
    assert (found.vehicle, found.vehicle_actions) == (1, ("change-left",))
    trace = next(t for t in S1.traces if t.trace_id == found.trace_id)
    supposed = WhatIf(vehicle=1, vehicle_actions=("change-left",))
    again = msgspec.structs.replace(trace, plan=trace.plan[1:], what_if=supposed)
    answer = explain(query, Record(S1.now, S1.traces, S1.events, extra=(again,)))
    assert isinstance(answer, Explanation)
    assert answer.causes[0].vehicle == 1
    assert answer.causes[0].decision_changes is True
    refused = explain(query, Record(S1.now, S1.traces, S1.events, refused=(found,)))
    assert isinstance(refused, NoExplanation)
    assert refused.reason == "too-little-evidence"
