"""What the factual explainers say of made rides of which it is known what happens."""

import math
from dataclasses import replace

import pytest
from msgspec import structs

from planner.record.events import Event as Told
from planner.record.places import LightChange, PriorityFact, RoadFacts, RoadPlace, RouteStep
from planner.record.trace import HeldUp
from tests.explain.answers.asked_facts import told
from tests.explain.facts.scenes import Actor, made, recorded, shifted, speeds, straight
from tests.explain.trust import trusted
from tests.traces import Aim, Way
from xavi_dialogue.domain.answers import (
    Beliefs,
    Closeness,
    Counted,
    Declined,
    DidNotHappen,
    Happenings,
    Identified,
    Measures,
    NoSuchVehicle,
    Priority,
    Verdict,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Episode, Look, Measure
from xavi_dialogue.domain.meaning import (
    Claim,
    Doing,
    Feel,
    HowLong,
    HowMany,
    HowMuch,
    HowSure,
    Listing,
    Request,
    Summarise,
    When,
    Where,
    Whether,
    Which,
)
from xavi_dialogue.domain.terms import (
    At,
    Believed,
    Compares,
    Ego,
    Event,
    Everyone,
    Exists,
    Happens,
    Has,
    Is,
    Measured,
    Nobody,
    Not,
    Quantity,
    Related,
    Vehicle,
    Wanted,
    WholeRide,
)
from xavi_dialogue.explain.history.ride import Ride

STOPS = ((0.0, 14.0), (4.0, 14.0), (8.0, 0.0), (12.0, 0.0), (16.0, 8.0))
HALT = {0: Actor(speeds(0.0, 0.0, STOPS)), 1: Actor(straight(20.0, 3.5, 14.0), colour="red")}
TURNING = (Aim("exit-right", 0.9, (Way(("exit-right",)),)), Aim("continue", 0.1, (Way(("continue",)),)))  # fmt: skip  # noqa: E501


def corner(t: float) -> tuple[float, float, float, float]:
    """A left turn at 10 m/s between 3 and 5 s."""
    if t <= 3.0:
        return 30.0 + 10.0 * t, 3.5, 0.0, 10.0
    angle = min((t - 3.0) / 2.0, 1.0) * math.pi / 2.0
    x, y = 60.0 + 12.7 * math.sin(angle), 3.5 + 12.7 * (1.0 - math.cos(angle))
    return x, y + 10.0 * max(t - 5.0, 0.0), angle, 10.0


def place(edge: str = "main", *, inside: bool = False, lane: int | None = 0) -> RoadPlace:
    return RoadPlace(edge, None if inside else lane, 2, 13.89, inside, False)


def road(who: str, inside: bool = False) -> RoadFacts:
    step = RouteStep(40.0, "junction", "exit-right", None, None, 4, "give-way")
    fact = PriorityFact(1, who)  # type: ignore[arg-type]
    return RoadFacts({0: place(inside=inside), 1: place(lane=1)}, (step,), 200.0, 18.0, (fact,))


def test_a_speed_now_and_the_highest_there_was() -> None:
    ride = made(HALT, 10.0, roads=lambda _: road("ego"))
    now = told(ride, HowMuch(Measured("speed")))
    assert [m.value for m in now.measures] == [0.0]
    most = told(ride, HowMuch(Measured("speed", tense="past", time=WholeRide()), "highest"))
    assert (most.measures[0].value, most.measures[0].reference) == (14.0, 13.89)
    assert most.measures[0].time <= 4.2


def test_a_measure_is_of_the_time_asked_about() -> None:
    ride = made(HALT, 16.0)
    found = told(ride, HowMuch(Measured("speed", tense="past")), Span(6.0, 6.0, said=True))
    assert found.measures[0].value == pytest.approx(7.0, abs=0.1)
    of_event = told(ride, HowMuch(Measured("deceleration", event=Event("brake"), tense="past")))
    assert of_event.measures[0].value == pytest.approx(3.5, abs=0.1)


def test_a_stretch_has_a_range() -> None:
    found = told(made(HALT, 16.0), HowMuch(Measured("speed", tense="past")), Span(5.0, 7.0))
    assert found.measures[0].low == pytest.approx(3.5, abs=0.3)
    assert found.measures[0].high == pytest.approx(10.5, abs=0.3)


def test_who_is_out_of_view_is_told_as_seen_last() -> None:
    actors = HALT | {2: Actor(straight(40.0, 0.0, 9.0), until=5.0)}
    found = told(made(actors, 10.0), HowMuch(Measured("speed", Vehicle(2))))
    gone, before = found.measures
    assert gone.gap == "out-of-view"
    assert (before.value, before.time) == (9.0, pytest.approx(5.0, abs=1.0))


def test_a_vehicle_that_was_never_seen_is_refused() -> None:
    found = told(made(HALT, 5.0), HowMuch(Measured("speed", Vehicle(7))))
    assert isinstance(found, NoSuchVehicle)
    assert (found.thing, found.time) == (Vehicle(7), 5.0)
    assert [look.vehicle for look in found.known] == [1]


def test_how_long_it_stood_and_when() -> None:
    ride = made(HALT, 18.0)
    assert told(ride, HowLong(Event("stand"))).measures[0].value == pytest.approx(4.0, abs=0.5)
    assert told(ride, When(Happens(Event("stop")))).episodes[0].begin == pytest.approx(8.0, abs=0.4)
    waited = told(ride, HowMuch(Measured("waiting-time", tense="past")))
    assert waited.measures[0].value == pytest.approx(4.0, abs=0.5)
    assert told(ride, HowMany(Event("stop", time=WholeRide()))).count == 1


def test_what_did_not_happen_is_denied_with_what_did() -> None:
    found = told(made(HALT, 18.0), When(Happens(Event("change-left"))))
    assert isinstance(found, DidNotHappen)
    assert found.instead
    assert all(e.actor == Ego() for e in found.instead)
    elsewhen = told(made(HALT, 18.0), HowLong(Event("stop", time=At(2.0))))
    assert isinstance(elsewhen, DidNotHappen)
    assert elsewhen.elsewhen == pytest.approx(8.0, abs=0.4)


def test_a_hole_in_the_record_is_not_taken_for_nothing() -> None:
    ride = made(HALT, 18.0, gaps=((2.0, 3.0),))
    found = told(ride, Whether(Happens(Event("change-lane", Vehicle(1)))))
    assert (found.holds, found.gap) == (None, "gap-in-record")
    assert told(ride, HowMany(Event("stop", time=WholeRide()))).at_least


def test_yes_and_no_are_of_the_same_thing() -> None:
    ride = made(HALT, 18.0)
    did = told(ride, Whether(Happens(Event("stop"))))
    assert did.holds is True
    assert did.facts[0].action == "stop"
    assert told(ride, Whether(Not(Happens(Event("stop"))))).holds is True  # "yes, it did stop"
    assert told(ride, Whether(Happens(Event("stop", tense="present")))).holds is False
    assert told(made(HALT, 10.0), Whether(Happens(Event("stop", tense="present")))).holds is True


def test_a_prediction_that_came_otherwise_is_owned_up_to() -> None:
    actors = {0: Actor(straight(0.0, 0.0, 10.0)), 1: Actor(corner, aims=TURNING)}
    ride = made(actors, 9.0)
    claim = told(ride, Claim(Happens(Event("exit-left", Vehicle(1))), challenge=True))
    assert (claim.holds, claim.claim, claim.challenge, claim.mistaken) == (True, True, True, True)
    assert claim.believed[0].expectations[0].actions == ("exit-right",)
    wrong = told(ride, Listing("wrong-predictions"))
    assert wrong.mistaken
    assert wrong.facts[0].action == "exit-left"
    denied = told(ride, Claim(Happens(Event("exit-right", Vehicle(1)))))
    assert denied.holds is False
    assert any(isinstance(f, Episode) and f.action == "exit-left" for f in denied.facts)


def test_what_was_believed_is_of_that_time() -> None:
    actors = {0: Actor(straight(0.0, 0.0, 10.0)), 1: Actor(corner, aims=TURNING)}
    ride = made(actors, 9.0)
    believed = told(ride, Whether(Believed(Happens(Event("exit-left", Vehicle(1))))))
    assert isinstance(believed, Beliefs)
    assert (believed.knew, believed.probability) == (True, pytest.approx(0.0))
    assert believed.besides[0].actions == ("exit-right",)
    assert believed.besides[0].probability == pytest.approx(0.9)
    assert believed.came is not None
    assert believed.came.action == "exit-left"
    assert believed.time is not None
    assert believed.time < believed.came.begin
    sure = told(ride, HowSure(Happens(Event("exit-right", Vehicle(1), time=At(2.0)))))
    assert (sure.probability, sure.time) == (pytest.approx(0.9), 2.0)
    assert sure.came is not None
    assert sure.came.action == "exit-left"


def test_what_is_to_come_is_a_probability() -> None:
    actors = {0: Actor(straight(0.0, 0.0, 10.0)), 1: Actor(corner, aims=TURNING)}
    ride = made(actors, 2.0)
    found = told(ride, Whether(Happens(Event("exit-right", Vehicle(1), tense="future"))))
    assert (found.holds, found.probability) == (True, pytest.approx(0.9))
    assert found.believed[0].vehicle == 1


def test_who_waits_behind_us_does_not_pull_out_before_us() -> None:
    yields = HeldUp(0, 0.0, 4.0, "right-of-way", 10.0, 10.0)
    ways = (Way(("exit-right",), 1.0, (0.0, 0.0, 5.0), (yields,)),)
    actors = {
        0: Actor(straight(0.0, 0.0, 10.0)),
        1: Actor(straight(60.0, -12.0, 0.0, 1.57), aims=(Aim("exit-right", 1.0, ways),)),
    }
    found = told(
        made(actors, 3.0), Whether(Happens(Event("pull-out", Vehicle(1), Ego(), tense="future")))
    )
    assert (found.holds, found.probability) == (False, 0.0)


def test_others_thoughts_are_not_known_but_what_they_did_is() -> None:
    found = told(made(HALT, 10.0), Whether(Happens(Event("see", Vehicle(1), Ego()))))
    assert (found.holds, found.gap) == (None, "others-thoughts")
    assert any(isinstance(fact, Look) for fact in found.facts)


def test_comparing_with_another_with_a_number_and_with_the_limit() -> None:
    ride = made(HALT, 3.0, roads=lambda _: road("ego"))
    mine, his = Measured("speed"), Measured("speed", Vehicle(1))
    assert told(ride, Whether(Compares(mine, "same", his))).holds is True
    assert told(ride, Whether(Compares(mine, "more", his))).holds is False
    over = told(ride, Whether(Compares(mine, "more", Quantity(10.0, "m/s"))))
    assert (over.holds, over.facts[0].reference) == (True, 10.0)
    assert told(ride, Whether(Is("fast", Ego()))).holds is False
    assert told(ride, Whether(Is("allowed", Ego()))).holds is True


def test_lights_are_told_as_shown() -> None:
    blinking = (LightChange(0.0, ()), LightChange(2.0, ("right",)), LightChange(5.0, ()))
    actors = {
        0: Actor(straight(0.0, 0.0, 10.0)),
        1: Actor(straight(30.0, 3.5, 10.0), lights=blinking),
    }
    ride = made(actors, 8.0)
    now = told(ride, Whether(Has("indicator", "right", Vehicle(1))))
    assert now.holds is False
    then = told(ride, Claim(Has("indicator", "right", Vehicle(1), tense="past")))
    assert (then.holds, then.claim) == (True, True)
    gone = made(actors | {2: Actor(straight(60.0, 0.0, 10.0), until=2.0)}, 8.0)
    lost = told(gone, Whether(Has("indicator", "left", Vehicle(2))))
    assert (lost.holds, lost.gap) == (None, "out-of-view")


def test_right_of_way_is_told_by_the_road_and_who_went_first_by_the_record() -> None:
    ride = made(HALT, 6.0, roads=lambda t: road("vehicle"))
    found = told(ride, Whether(Related("has-priority-over", Vehicle(1), Ego())))
    assert isinstance(found, Priority)
    assert (found.rule, found.vehicle) == ("give-way", 1)
    assert told(ride, HowMuch(Measured("right-of-way", Ego(), Vehicle(1)))).rule == "give-way"
    old = told(made(HALT, 6.0), HowMuch(Measured("right-of-way", Ego(), Vehicle(1))))
    assert old.gap == "not-recorded"


def test_who_cut_in_and_who_is_behind() -> None:
    actors = {
        0: Actor(straight(0.0, 0.0, 12.0)),
        1: Actor(shifted(straight(9.0, 3.5, 13.0), 2.0, 5.0, -3.5), colour="red"),
        2: Actor(straight(-20.0, 0.0, 12.0), kind="truck"),
    }
    ride = made(actors, 7.0)
    found = told(ride, Which(Wanted(), Happens(Event("cut-in", Wanted(), Ego()))))
    assert isinstance(found, Identified)
    assert [look.vehicle for look in found.looks] == [1]
    behind = told(ride, Which(Wanted(), Related("behind", Wanted(), Ego())))
    assert [look.vehicle for look in behind.looks] == [2]
    nobody = told(ride, Which(Wanted(), Happens(Event("cut-in", Wanted("truck"), Ego()))))
    assert nobody.none or [look.vehicle for look in nobody.looks] == [1]
    cars = told(ride, HowMany(Everyone("car")))
    assert (cars.count, cars.of) == (2, Everyone())
    assert told(ride, HowMany(Everyone("truck"))).count == 1


def test_how_close_it_was_and_whether_it_was_safe() -> None:
    ride = made(HALT, 6.0)
    close = told(ride, HowMuch(Measured("distance", Ego(), Vehicle(1), tense="past"), "lowest"))
    assert close.measures[0].extreme == "lowest"
    safe = told(ride, Whether(Is("safe", Ego(), tense="future")))
    assert isinstance(safe, Closeness)
    assert (safe.risk, safe.past, safe.asked) == (trusted(0.0), False, "safe")
    hit = told(ride, Whether(Happens(Event("collide", Vehicle(1), Ego(), tense="future"))))
    assert (hit.asked, hit.vehicle) == ("hit", 1)


def test_a_ride_that_ended_in_a_collision_says_so() -> None:
    ride = made(HALT, 10.0, events=(Told("collided", 8.0, vehicle=1),), ended=True)
    assert told(ride, Whether(Happens(Event("collide")))).holds is True
    assert told(made(HALT, 10.0), Whether(Happens(Event("collide")))).holds is False


def test_are_we_there_yet() -> None:
    ride = made(HALT, 6.0, roads=lambda _: road("ego"))
    found = told(ride, Whether(Happens(Event("arrive", tense="perfect"))))
    assert found.holds is False
    assert {m.attribute for m in found.facts} == {"distance-to-go", "time-to-go"}
    there = made(HALT, 6.0, events=(Told("arrived", 5.5),))
    assert told(there, Whether(Happens(Event("arrive", tense="perfect")))).holds is True


def test_we_do_not_arrive_where_no_road_leads() -> None:
    arrives = Whether(Happens(Event("arrive", tense="future")))
    ride = made(HALT, 6.0, roads=lambda _: RoadFacts({}))
    bare = tuple(structs.replace(t, rollouts=()) for t in ride.record.traces)
    found = told(Ride(replace(ride.record, traces=bare)), arrives)
    assert (found.holds, [m.gap for m in found.facts]) == (False, ["no-way"])
    assert told(made(HALT, 6.0, roads=lambda _: road("ego")), arrives).holds is True


def test_nobody_there_is_told_with_who_is() -> None:
    found = told(made(HALT, 6.0), Whether(Exists(Nobody())))
    assert found.holds is False
    assert [look.vehicle for look in found.facts] == [1]
    assert told(made(HALT, 6.0), Whether(Exists(Vehicle(1)))).holds is True


def test_a_summary_tells_what_matters_in_order() -> None:
    found = told(made(HALT, 18.0), Summarise(time=WholeRide()))
    assert isinstance(found, Happenings)
    assert 1 <= len(found.episodes) <= 6
    begins = [e.begin for e in found.episodes]
    assert begins == sorted(begins)
    assert {m.attribute for m in found.measures} >= {"duration", "speed"}


def test_a_list_of_stops_and_of_events() -> None:
    ride = made(HALT, 18.0)
    assert [e.action for e in told(ride, Listing("stops")).episodes] == ["stop"]
    assert told(ride, Listing("events", time=WholeRide())).episodes


def test_what_somebody_does_and_did() -> None:
    ride = made(HALT, 18.0)
    now = told(ride, Doing())
    assert (now.speed, now.trend) == (pytest.approx(8.0), "steady")
    then = told(ride, Doing(tense="past"), Span(9.5, 9.5, said=True))
    assert (then.speed, then.trend) == (0.0, "standing")
    assert then.time == 9.5


def test_where_an_event_took_place() -> None:
    found = told(made(HALT, 18.0, roads=lambda _: road("ego")), Where(Event("stop")))
    assert any(m.attribute == "distance-to-go" for m in found.measures)


def test_a_request_is_declined_with_what_is_done_anyway() -> None:
    slowing = told(made(HALT, 6.0), Request(Event("slow-down", tense="future")))
    assert isinstance(slowing, Declined)
    assert (slowing.already, slowing.able) == (True, True)
    assert not told(made(HALT, 3.0), Request(Event("honk"))).able


def test_a_feeling_gets_a_fact_that_bears_on_it() -> None:
    ride = made(HALT, 3.0, roads=lambda _: road("ego"))
    quick = told(ride, Feel("disliking", Is("fast", Ego())))
    assert isinstance(quick.fact, Measures)
    assert quick.fact.measures[0] == Measure(
        "speed", Ego(), quick.fact.measures[0].time, value=14.0, reference=13.89
    )
    near = told(ride, Feel("startled", Vehicle(1)))
    assert isinstance(near.fact, Closeness)
    assert near.fact.vehicle == 1
    waiting = told(made(HALT, 10.0), Feel("impatient"))
    assert waiting.fact is not None


@pytest.mark.parametrize("name", ["s1-0", "s2-0", "s3-0", "s4-0", "town-0"])
def test_counts_agree_with_lists_on_recorded_rides(name: str) -> None:
    ride = recorded(name)
    for action in ("stop", "give-way", "change-lane", "turn"):
        counted = told(ride, HowMany(Event(action, time=WholeRide())))
        assert isinstance(counted, Counted)
        assert counted.count == len(counted.facts)
        whether = told(ride, Whether(Happens(Event(action, time=WholeRide()))))
        assert isinstance(whether, Verdict)
        assert whether.holds is (counted.count > 0)
