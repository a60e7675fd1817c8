"""Suppositions about a vehicle that came into view only after the last deed."""

from tests.explain.asking import told
from tests.traces import Aim, End, HeldUp, Ride, Way, World, s1_ride, trace_of
from xavi_dialogue.explain.engine import explain
from xavi_dialogue.explain.explanation import Explanation, NeedRollout
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.record import Record

S1 = s1_ride()
REMOVED = Query(
    type="what_if", actor="vehicle:4", negated=True, tense="past", intervention="remove"
)


def newcomer() -> Ride:
    """Vehicle 4 comes into view at 8 s, when the lane change is done."""
    aims = {
        4: (
            Aim("continue", 0.6, (Way(("continue",)),)),
            Aim("exit-left", 0.4, (Way(("exit-left",)),)),
        )
    }
    slow = HeldUp(4, 8.0, 10.0, "leader", 5.0, 5.0)
    world = World(
        aims,
        (("continue",), ("stop", "continue")),
        lambda plan, chosen: (
            End(time=10.0 if chosen[4][0] == "continue" else 8.0, held_up=(slow,)),
            1,
        ),
    )
    return Ride(8.0, (*S1.traces, trace_of(world, draws=24, time=8.0, decision=8)), S1.events)


def record(*extra) -> Record:
    ride = newcomer()
    return Record(ride.now, ride.traces, ride.events, extra=tuple(extra))


def test_without_it_the_decision_that_knows_it_is_planned_again() -> None:
    ride = newcomer()
    assert explain(REMOVED, record()) == NeedRollout(trace_id=ride.traces[-1].trace_id, removed=4)
    alone = World({}, (("continue",),), lambda plan, chosen: (End(time=8.0), 1))
    found = told(REMOVED, record(trace_of(alone, time=8.0, decision=8)))
    assert isinstance(found, Explanation)
    assert found.sim_time == 8.0
    assert found.causes[0].decision_changes is False


def test_what_it_might_have_done_is_about_that_decision_and_not_the_deed_before() -> None:
    query = Query(type="what_if", actor="vehicle:4", counterfactual=("exit-left",), tense="past")
    found = told(query, record())
    assert isinstance(found, Explanation)
    assert found.sim_time == 8.0
    assert (found.factual[0], found.counterfactual[0]) == ("continue", "continue")
    (later,) = [e for e in found.effects if e.component == "time"]
    assert later.delta < 0.0


def test_of_a_vehicle_known_before_it_is_still_the_decision_for_the_deed() -> None:
    query = Query(type="what_if", actor="vehicle:1", negated=True, tense="past")
    need = explain(query, record())
    assert need == NeedRollout(trace_id=S1.traces[1].trace_id, removed=1)
