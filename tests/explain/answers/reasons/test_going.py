"""Why we went when we did, what if we had not slowed down, and what others announce."""

from planner.record.places import LightChange, PriorityFact, RoadFacts
from tests.explain.causes.rides import recorded, story, told
from tests.explain.facts.scenes import Actor, made, speeds, straight
from xavi_dialogue.domain.answers import Closeness, GoReason, PlaceReason, SignalReason, Unslowed
from xavi_dialogue.domain.discourse import GroundedAct, Span
from xavi_dialogue.domain.meaning import Ask, Doing, WhatIf, Why
from xavi_dialogue.domain.terms import Ego, Event, Happens, Now, Related, Vehicle
from xavi_dialogue.explain.answers.engine import explain
from xavi_dialogue.explain.answers.suppositions.supposed_when import _asks_now
from xavi_dialogue.explain.causes.driving.crossing import crossing
from xavi_dialogue.explain.causes.driving.going import bystanders
from xavi_dialogue.explain.facts.world import World


def test_who_had_right_of_way_and_what_it_did_is_told():
    facts = RoadFacts(places={}, priority=(PriorityFact(1, "vehicle"), PriorityFact(2, "ego")))
    actors = {
        0: Actor(straight(0.0, 0.0, 10.0)),
        1: Actor(straight(60.0, 20.0, 0.0)),
        2: Actor(straight(60.0, -20.0, 10.0)),
    }
    ride = made(actors, 4.0, roads=lambda _: facts)
    first, second = bystanders(ride, World(ride), 4.0)
    assert (first.vehicle, first.first, first.trend) == (1, "vehicle", "standing")
    assert (second.vehicle, second.first, second.trend) == (2, "ego", "steady")
    assert not first.gone


def test_entering_is_told_by_right_of_way_and_what_waiting_would_have_cost():
    found = told(recorded("s3-0"), Why(Happens(Event("go", tense="past"))), 14.0)
    assert isinstance(found, GoReason)
    assert found.others
    assert found.contrast is not None
    assert found.contrast.foil == ("stop",)


def test_where_both_would_have_met_is_worked_out_from_the_recorded_ways():
    actors = {
        0: Actor(speeds(0.0, 0.0, ((2.0, 10.0), (4.0, 5.0), (6.0, 10.0)))),
        1: Actor(straight(50.0, -40.0, 8.0, heading=1.5708)),
    }
    ride = made(actors, 9.0)
    found = crossing(ride, 1, 2.0, 10.0)
    assert found is not None
    assert abs(found.ours - 5.0) < 0.5  # 50 m at 10 m/s
    assert abs(found.theirs - 5.0) < 0.5  # 40 m at 8 m/s


def test_ways_that_do_not_meet_tell_nothing():
    actors = {
        0: Actor(speeds(0.0, 0.0, ((2.0, 10.0), (4.0, 5.0)))),
        1: Actor(straight(0.0, 30.0, 8.0)),
    }
    assert crossing(made(actors, 9.0), 1, 2.0, 10.0) is None


def test_another_speed_is_answered_by_who_was_in_the_way():
    found = told(recorded("s2-2"), WhatIf(Happens(Event("enter", manner=("fast",)))), 8.0)
    assert isinstance(found, Unslowed)
    assert found.cause is not None
    assert found.cause.kind == "right-of-way"
    assert not found.going


def test_a_crash_that_is_supposed_is_answered_by_its_risk():
    crash = WhatIf(Happens(Event("collide", Vehicle(1), Ego(), tense="past")))
    found = told(story("braking"), crash, 8.0)
    assert isinstance(found, Closeness)
    assert found.asked == "hit"


def asked(ride, question, span=None):
    return explain(GroundedAct(Ask(question), span), ride.record)


def test_an_indicator_announces_and_is_not_because_of_a_leader():
    lit = (LightChange(1.0, ("right",)),)
    actors = {0: Actor(straight(0.0, 0.0, 10.0)), 1: Actor(straight(30.0, 3.5, 10.0), lights=lit)}
    ride = made(actors, 5.0)
    found = asked(ride, Why(Happens(Event("signal", Vehicle(1), tense="present"))))
    assert isinstance(found, SignalReason)
    assert found.deed.side == "right"
    assert set(found.aims) <= {"change-right", "exit-right"}
    assert found.came is None


def test_where_somebody_is_has_no_made_up_reason():
    actors = {0: Actor(straight(0.0, 0.0, 10.0)), 1: Actor(straight(-20.0, 0.0, 10.0))}
    found = asked(made(actors, 5.0), Why(Related("behind", Vehicle(1))))
    assert isinstance(found, PlaceReason)
    assert found.deed is None


def test_what_is_supposed_of_now_is_no_matter_of_the_past():
    assert _asks_now(Doing(tense="present"))
    assert not _asks_now(Doing(tense="past"))
    event = Event("brake", Vehicle(1), tense="past", time=Now())
    found = told(story("braking"), WhatIf(Happens(event)), 1.0, Span(1.0, 1.0, said=True))
    assert getattr(found, "past", False) is False
