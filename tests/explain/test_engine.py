import msgspec
import pytest

from planner.events import Event
from planner.trace import EgoGoal, WhatIf
from tests.explain.asking import told
from tests.traces import Ride, s1_ride, s1_world, s2_ride, s2_world, straight_track, trace_of
from xavi_dialogue.explain.engine import explain, settled
from xavi_dialogue.explain.explanation import Explanation, NeedRollout, NoExplanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.record import Record
from xavi_dialogue.explain.ride import ROUNDS

S1, S2 = s1_ride(), s2_ride()  # with enough draws to meet every sample


def record(ride: Ride, now: float | None = None, extra=()) -> Record:
    return Record(ride.now if now is None else now, ride.traces, ride.events, extra=tuple(extra))


def ask(ride: Ride, now: float | None = None, extra=(), **query):
    return told(Query(**query), record(ride, now, extra))


def refusal(ride: Ride, **query) -> NoExplanation:
    found = ask(ride, **query)
    assert isinstance(found, NoExplanation)
    return found


# Why, why not, what if, about the ego ------------------------------------------------------


@pytest.mark.parametrize(
    "query",
    [
        {"type": "why", "factual": ("change-left",), "counterfactual": ("continue",)},
        {"type": "why", "factual": ("overtake",), "counterfactual": ("exit-straight",)},
        {"type": "why_not", "counterfactual": ("continue",)},
        {"type": "what_if", "counterfactual": ("exit-straight",)},
        {"type": "compare", "counterfactual": ("continue",)},
    ],
)
def test_s1_the_lane_change_is_explained_by_the_slowing_vehicle(query):
    found = ask(S1, **query)
    assert isinstance(found, Explanation)
    assert found.factual == ("change-left", "continue")
    assert found.counterfactual == ("continue",)
    assert found.outcome.name == "done"
    time = next(e for e in found.effects if e.component == "time")
    assert time.delta == pytest.approx(0.8 * 16.0 + 0.2 * 11.5 - 12.0)
    assert time.low < time.delta < time.high
    assert [cause.vehicle for cause in found.causes] == [1]
    cause = found.causes[0]
    assert cause.actions == ("exit-right",)
    assert cause.probability == pytest.approx(0.8)
    assert cause.mechanism.how == "leader"
    assert cause.mechanism.speed_from == pytest.approx(9.4)
    assert cause.mechanism.speed_to == pytest.approx(4.2)
    assert cause.influence > 0.2
    assert found.sim_time == 4.0
    assert found.evidence.traces == (S1.traces[1].trace_id,)


def test_why_without_a_foil_takes_the_best_alternative():
    found = ask(S1, type="why", factual=("change-left",))
    assert found.counterfactual == ("continue",)
    assert ask(S1, type="why") == found
    undone = ask(S1, type="what_if", counterfactual=("change-left",), negated=True)
    assert undone == found


def test_a_collision_is_laid_at_the_door_of_the_vehicle_collided_with():
    found = ask(s1_ride(cut_in_collides=True), type="why_not", counterfactual=("continue",))
    assert (found.outcome.name, found.outcome.collided_with) == ("collision", 1)
    assert found.outcome.probability == pytest.approx(0.8)
    assert [c.vehicle for c in found.causes] == [1]
    assert found.causes[0].mechanism.how == "collision"
    assert found.causes[0].mechanism.share == pytest.approx(0.8)


def test_leaving_the_way_to_the_goal_is_nobodys_doing():
    for ride, foil in ((S1, "exit-right"), (S2, "exit-straight"), (S2, "exit-left")):
        found = ask(ride, type="what_if", counterfactual=(foil,))
        assert found.outcome.name == "dead"
        assert found.outcome.probability == pytest.approx(1.0)
        assert found.effects == ()
        assert found.causes == ()


def test_s2_straight_means_across_the_junction():
    found = ask(S2, type="what_if", counterfactual=("continue",))
    assert found.counterfactual == ("exit-straight",)
    assert found.outcome.name == "dead"


def test_s2_turning_at_once_is_explained_by_the_waiting_vehicle():
    found = ask(S2, type="why", factual=("exit-right",), counterfactual=("stop",))
    assert found.effects[0].component == "time"
    assert found.effects[0].delta == pytest.approx(13.5 - (0.85 * 9.0 + 0.15 * 14.0))
    assert [(c.vehicle, c.actions) for c in found.causes] == [(1, ("exit-left",))]
    assert found.causes[0].probability == pytest.approx(0.85)
    assert found.causes[0].mechanism is None
    assert found.causes[0].influence > 0.01


def test_the_factual_plan_is_never_its_own_foil():
    for ride, deed in ((S1, "change-left"), (S2, "exit-right")):
        for kind in ("why_not", "what_if"):
            found = refusal(ride, type=kind, counterfactual=(deed,))
            assert found.reason == "did-not-happen"
            assert found.facts["did"] is True
            assert found.facts["happened"] == (deed,)


def test_what_before_why():
    found = refusal(S1, type="why", factual=("exit-left",))
    assert found.reason == "did-not-happen"
    assert found.facts == {
        "vehicle": 0,
        "asked": ("exit-left",),
        "did": False,
        "happened": ("change-left",),
        "time": 4.1,
    }


def test_a_foil_that_does_not_apply_is_declined_with_the_planners_reason():
    found = refusal(S1, type="why_not", counterfactual=("change-right",))
    assert found.reason == "not-applicable"
    assert found.facts["reason"] == "there is no lane to the right"
    speed = refusal(S1, type="what_if", counterfactual=("speed-up",))
    assert speed.reason == "not-applicable"
    assert "speed" in speed.facts["reason"]


def test_traces_of_the_future_are_not_used():
    found = ask(S1, 2.5, type="why", factual=("change-left",))
    assert found.reason == "did-not-happen"
    later = Record(4.0, S1.traces, S1.events)
    assert told(Query(type="why", factual=("change-left",)), later).sim_time == 4.0


def test_future_questions_are_about_the_latest_plan():
    found = ask(S1, 4.0, type="why", factual=("change-left",), tense="future")
    assert found.counterfactual == ("continue",)
    ahead = ask(S1, 2.5, type="why", factual=("continue",), tense="future")
    assert ahead.sim_time == 2.0
    assert ahead.factual[0] == "continue"
    what = ask(S1, 4.0, type="what_if", counterfactual=("exit-right",), tense="future")
    assert what.outcome.name == "dead"


def test_no_record_no_answer():
    assert explain(Query(type="why"), Record(0.0)).reason == "trace-gap"


# Evidence ----------------------------------------------------------------------------------


def thin_ride(extra=0) -> Ride:
    """S1 whose search tried going on only once, in the unlikely case, and `extra` times more."""
    world = s1_world()
    full = trace_of(world, draws=24)
    first = next(
        r for r in full.rollouts if r.actions[0].action == "continue" and r.samples[0].goal == 1
    )
    kept = [r for r in full.rollouts if r.actions[0].action != "continue"] + [first]
    more = trace_of(world, draws=0, extra=[(("continue",), extra)]).rollouts
    trace = msgspec.structs.replace(full, rollouts=(*kept, *more))
    return Ride(7.0, (trace,), S1.events)


def test_thin_evidence_asks_for_rollouts_then_uses_them():
    ride = thin_ride()
    query = Query(type="why_not", counterfactual=("continue",))
    found = explain(query, record(ride))
    assert found == NeedRollout(trace_id=ride.traces[0].trace_id, actions=("continue",))
    again = thin_ride(40).traces[0]
    answer = told(query, record(ride, extra=[again]))
    assert isinstance(answer, Explanation)
    assert answer.evidence.method == "rollouts"
    assert answer.evidence.traces == (again.trace_id,)
    assert [cause.vehicle for cause in answer.causes] == [1]


def test_evidence_that_stays_thin_is_declined_with_numbers():
    ride = thin_ride()
    once = thin_ride().traces[0]
    rare = [r for r in once.rollouts if r.actions[0].action == "continue"]
    rows = (*once.rollouts, *rare)
    twice = [
        msgspec.structs.replace(once, rollouts=rows, what_if=WhatIf(("continue",), rollouts=n))
        for n in ROUNDS
    ]
    query = Query(type="why_not", counterfactual=("continue",))
    more = explain(query, record(ride, extra=twice[:1]))
    assert isinstance(more, NeedRollout)
    assert more.rollouts == ROUNDS[1]
    found = explain(query, record(ride, extra=twice))
    assert found.reason == "too-little-evidence"
    assert (found.facts["rollouts"], found.facts["distinct"]) == (2, 1)
    assert found.facts["coverage"] < 0.5


def test_plans_made_with_another_vehicles_doings_supposed_are_no_evidence():
    ride, again = thin_ride(), thin_ride(40).traces[0]
    query = Query(type="why_not", counterfactual=("continue",))
    supposed = msgspec.structs.replace(again, what_if=WhatIf(vehicle=1, goal="continue"))
    assert isinstance(explain(query, record(ride, extra=[supposed])), NeedRollout)
    forced = msgspec.structs.replace(again, what_if=WhatIf(("continue",)))
    assert isinstance(told(query, record(ride, extra=[supposed, forced])), Explanation)


def test_a_sequence_that_the_search_did_not_try_is_asked_for():
    found = ask(S1, type="what_if", counterfactual=("change-left", "exit-right"))
    assert found == NeedRollout(
        trace_id=S1.traces[1].trace_id, actions=("change-left", "exit-right")
    )


def test_equal_plans_make_no_difference():
    world = s1_world()
    flat = type(world)(
        world.aims, world.plans, lambda plan, chosen: world.simulate(("stop",), chosen)
    )
    ride = Ride(7.0, (trace_of(flat),), S1.events)
    found = ask(ride, type="why_not", counterfactual=("continue",))
    assert found.reason == "effect-too-small"


# Other vehicles ----------------------------------------------------------------------------


def test_unknown_vehicles_are_declined_with_those_known():
    found = refusal(S1, type="why", actor="vehicle:9", factual=("stop",))
    assert found.reason == "unknown-vehicle"
    assert found.facts == {"vehicle": 9, "known": ("1", "2")}


def test_why_a_vehicle_did_it_is_answered_by_its_goal():
    found = ask(S1, type="why", actor="vehicle:1", factual=("change-right",))
    assert found.activity.vehicle == 1
    assert found.activity.actions == ("exit-right",)
    assert found.activity.probability == pytest.approx(0.8)
    assert found.destination.kind == "exit-right"
    assert 0.5 < found.moment < 2.5


def test_what_a_vehicle_did_not_do_is_not_explained():
    found = refusal(S1, type="why", actor="vehicle:1", factual=("stop",))
    assert found.reason == "did-not-happen"
    assert found.facts["happened"] == ("change-right",)
    turned = refusal(S1, type="why_not", actor="vehicle:1", counterfactual=("change-right",))
    assert turned.facts["did"] is True


def test_what_a_vehicle_is_doing():
    slowing = ask(S2, 5.0, type="what", actor="vehicle:1", tense="present")
    assert slowing.activity.trend in ("slowing", "standing")
    assert slowing.activity.actions == ("exit-left",)
    done = ask(S1, 4.0, type="what", actor="vehicle:1")
    assert done.activity.actions == ("change-right",)
    assert done.activity.probability is None
    sure = ask(S2, type="confidence", actor="vehicle:1", factual=("exit-left",), tense="future")
    assert sure.activity.probability == pytest.approx(0.85)
    where = ask(S1, type="where_goal", actor="vehicle:1", tense="present")
    assert where.destination.place == "the road to the right"
    assert where.destination.probability == pytest.approx(0.8)


def test_what_if_a_vehicle_does_otherwise():
    on = ask(S1, type="what_if", actor="vehicle:1", counterfactual=("continue",))
    assert on.factual[0] == "change-left"
    assert on.counterfactual == ("continue",)
    assert on.causes[0].decision_changes is True
    assert on.causes[0].probability == pytest.approx(0.2)
    other = ask(S1, type="what_if", actor="vehicle:2", counterfactual=("exit-left",))
    assert other.causes[0].decision_changes is False
    assert other.counterfactual == other.factual


def test_what_if_a_vehicle_were_not_there_is_planned_again():
    query = Query(type="what_if", actor="vehicle:1", negated=True, tense="past")
    found = explain(query, record(S1))
    assert found == NeedRollout(trace_id=S1.traces[1].trace_id, removed=1)
    world = s1_world()
    alone = type(world)(
        {2: world.aims[2]},
        (("continue",), ("change-left", "continue")),
        lambda plan, chosen: world.simulate(plan, {1: ("continue", 0)}),
    )
    again = trace_of(alone, draws=24)
    answer = told(query, record(S1, extra=[again]))
    assert answer.factual[0] == "change-left"
    assert answer.counterfactual == ("continue",)
    assert answer.causes[0].vehicle == 1
    assert answer.causes[0].decision_changes is True


# The ego's driving, plan and way -----------------------------------------------------------


def waiting_ride() -> Ride:
    """The ego brakes to let vehicle 1 pass."""
    world = s2_world()
    blocked = type(world)(
        {
            1: tuple(
                type(a)(a.kind, p, a.ways) for a, p in zip(world.aims[1], (0.1, 0.9), strict=True)
            )
        },
        (("exit-right", "continue"),),
        lambda plan, chosen: world.simulate(plan, {**chosen, 2: ("continue", 0)}),
    )
    speeds = [10.0 - 0.4 * k for k in range(25)] + [0.0] * 3
    ego = straight_track(9.0, 0, speeds)
    traces = (
        trace_of(blocked, time=5.0, decision=5),
        trace_of(blocked, time=9.0, decision=9, history={0: ego}),
    )
    events = (
        Event("action-started", 0.0, "exit-right", 0),
        Event("gave-way", 8.4, "exit-right", 5, vehicle=1),
    )
    return Ride(9.0, traces, events)


@pytest.mark.parametrize("deed", ["give-way", "stop", "slow-down"])
def test_braking_is_explained_by_who_is_in_the_way(deed):
    found = ask(waiting_ride(), type="why", factual=(deed,))
    assert found.counterfactual == ()
    assert [cause.vehicle for cause in found.causes] == [1]
    assert found.causes[0].mechanism.how == "right-of-way"
    assert found.causes[0].mechanism.share == pytest.approx(0.9)


def test_driving_that_did_not_happen():
    for deed in ("slow-down", "give-way", "stop", "speed-up"):
        found = refusal(S1, type="why", factual=(deed,))
        assert found.reason == "did-not-happen"


def test_what_the_ego_does_and_where_it_goes():
    now = ask(S1, 4.0, type="what", tense="present")
    assert now.activity.actions == ("change-left", "continue")
    assert (now.activity.speed, now.activity.trend) == (10.0, "steady")
    assert ask(S1, type="what").activity.actions == ("change-left",)
    assert ask(S1, type="where_goal", tense="present").destination.edge == "out"
    assert ask(S1, 4.0, type="when", tense="future").arrival == pytest.approx(12.0)
    assert ask(S1, type="when", factual=("change-left",)).moment == 4.1
    assert ask(S1, 4.0, type="confidence").outcome.probability == pytest.approx(1.0)


def test_of_a_goal_that_is_far_the_time_to_a_place_before_it_says_nothing():
    before = EgoGoal("main_in", 80.0, None)
    traces = tuple(msgspec.structs.replace(trace, waypoint=before) for trace in S1.traces)
    far = Ride(S1.now, traces, S1.events)
    assert ask(S1, 4.0, type="when", tense="future").arrival is not None
    assert ask(far, 4.0, type="when", tense="future").arrival is None
    assert ask(far, 4.0, type="where_goal", tense="future").arrival is None
    assert ask(far, 4.0, type="confidence").arrival is None


def test_a_turn_is_done_only_once_it_has_begun():
    before = ask(S2, 5.5, type="what", tense="present")
    assert before.activity.actions[:2] == ("continue", "exit-right")
    assert ask(S2, 5.5, type="what", tense="future").activity.actions[0] == "exit-right"
    early = ask(S2, 5.5, type="why", factual=("exit-right",))
    assert (early.reason, early.facts["planned"]) == ("did-not-happen", True)
    assert ask(S2, type="when", factual=("exit-right",)).moment == 6.0


@pytest.mark.parametrize(
    ("actor", "said", "meant"),
    [
        ("vehicle:1", "change-left", "change-right"),
        ("vehicle:1", "change-right", "change-right"),
        ("ego", "change-right", "change-left"),
    ],
)
def test_a_side_that_was_not_named_is_that_on_which_it_happened(actor, said, meant):
    asked = Query(type="why", actor=actor, factual=(said,), underspecified="direction")
    assert settled(asked, record(S1)).factual == (meant,)
    named = Query(type="why", actor=actor, factual=(said,))
    assert settled(named, record(S1)).factual == (said,)


def test_what_is_beyond_it_is_declined():
    compared = refusal(S1, type="compare", actor="vehicle:1", tense="present")
    assert compared.facts == {"what": "compare"}
    assert refusal(S1, type="out_of_scope", reason="off-topic").reason == "out-of-scope"
    assert refusal(S1, type="out_of_scope", reason="not-an-action").reason == "not-an-action"
    assert refusal(S1, type="what", actor="vehicle:front").reason == "ambiguous"


def test_same_question_same_answer():
    query = Query(type="why", factual=("change-left",))
    fresh = s1_ride()
    assert explain(query, record(S1)) == explain(query, record(fresh))
