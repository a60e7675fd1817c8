"""Whether factual answers reply to what was asked: which of two, at once, in one sentence."""

from typing import Any

from planner.record.places import RoadFacts, RouteStep
from tests.explain.answers.asked_facts import told
from tests.explain.answers.test_factual import HALT, STOPS, place
from tests.explain.facts.scenes import Actor, made, speeds, straight
from xavi_dialogue.domain.answers import (
    Counted,
    Course,
    Declined,
    Identified,
    Located,
    Measures,
    Priority,
    Verdict,
)
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.meaning import Fault, HowMany, HowMuch, Request, When, Whether, Which
from xavi_dialogue.domain.terms import (
    At,
    Both,
    Described,
    Ego,
    Event,
    Exit,
    Happens,
    Has,
    Is,
    Measured,
    Nobody,
    Related,
    Vehicle,
    Wanted,
    WholeRide,
)
from xavi_dialogue.explain.facts.world import world_of
from xavi_dialogue.explain.history.ride import Ride
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.say import say

BESIDE = {
    0: Actor(straight(0.0, 0.0, 10.0)),
    1: Actor(straight(20.0, 3.5, 14.0), colour="red"),
    2: Actor(straight(60.0, 3.5, 14.0), colour="blue"),
}


def ring(time: float) -> RoadFacts:
    """A roundabout ahead, of which the second exit is taken."""
    far = 100.0 - 10.0 * time
    step = RouteStep(far, "roundabout", "exit-straight", 2, 4, 4, "give-way")
    return RoadFacts(
        places={0: place(), 1: place("other")}, route=(step,), distance=far + 100.0, free_time=20.0
    )


def said(ride: Ride, question: Any) -> str:
    """The answer in words."""
    world = world_of(ride.record)
    return say(told(ride, question), SpeechContext(now=ride.now, looks=world.look)).text


def test_an_event_named_for_its_speed_is_allowed_by_the_limit() -> None:
    ride = made(BESIDE, 4.0, roads=ring)
    fast = told(ride, Whether(Is("allowed", event=Event("go", manner=("fast",), tense="present"))))
    assert isinstance(fast, Verdict)
    assert fast.holds
    first = told(ride, Whether(Is("allowed", event=Event("go", manner=("first",)))))
    assert isinstance(first, Priority)
    assert first.rule == "give-way"
    assert said(ride, Whether(Is("allowed"))) == (
        "The law is not for me to judge, but we are doing 36 km/h, within the limit of 50 km/h."
    )


def test_an_either_or_question_is_answered_by_the_one_that_holds() -> None:
    ride = made(BESIDE, 4.0)
    red = Vehicle(1)
    asked = Both((Related("behind", red), Related("ahead-of", red)), join="or")
    where = told(ride, Whether(asked))
    assert isinstance(where, Located)
    assert where.looks[0].bearing.startswith("ahead")
    lights = Both((Has("indicator", "left", red), Has("indicator", "right", red)), join="or")
    assert isinstance(told(ride, Whether(lights)), Measures)
    assert not said(ride, Whether(asked)).startswith(("Yes", "No"))


def test_another_exit_than_ours_is_not_taken() -> None:
    ride = made(BESIDE, 4.0, roads=ring)
    leave = Event("leave", object=Exit(1), tense="future")
    found = told(ride, Whether(Happens(leave)))
    assert isinstance(found, Course)
    assert found.holds is False
    assert found.steps[0].exit == 2
    assert said(ride, Whether(Happens(leave))) == (
        "No, we go straight over the roundabout, by the second exit, in about 60 metres."
    )


def test_a_gap_that_there_is_none_of_is_told_as_distance() -> None:
    ride = made(BESIDE, 4.0, roads=ring)
    now = told(ride, HowMuch(Measured("gap", to=Vehicle(1))))
    assert [m.attribute for m in now.measures] == ["distance"]
    past = Measured("gap", to=Vehicle(1), time=WholeRide(), tense="past")
    least = told(ride, HowMuch(past, extreme="lowest"))
    assert [m.attribute for m in least.measures] == ["distance"]
    assert "gap" not in said(ride, HowMuch(Measured("headway", to=Vehicle(1))))


def test_who_asks_for_more_or_less_room_is_told_how_much_there_is() -> None:
    ride = made(BESIDE, 4.0, roads=ring)
    for action in ("keep-distance", "approach"):
        wish = told(ride, Request(Event(action, object=Vehicle(1), tense="present")))
        assert [m.attribute for m in wish.facts] == ["distance"]  # it is not in our lane


def test_a_wish_about_our_manner_is_met_with_our_speed() -> None:
    ride = made(BESIDE, 4.0, roads=ring)
    for event in (
        Event("move", manner=("gently",), tense="present"),
        Event("turn", manner=("slowly",), tense="present"),
    ):
        wish = told(ride, Request(event))
        assert [m.attribute for m in wish.facts] == ["speed"]


def test_braking_a_little_is_to_brake_where_we_have_not_braked() -> None:
    ride = made(BESIDE, 4.0, roads=ring)
    wish = told(ride, Request(Event("brake", manner=("gently",), tense="present")))
    assert wish.request.event == Event("brake", tense="present")


def test_the_arrival_is_told_once() -> None:
    ride = made(BESIDE, 4.0, roads=ring)
    found = told(ride, When(Happens(Event("arrive", tense="future"))))
    assert len(found.measures) == 1
    assert said(ride, When(Happens(Event("arrive", tense="future")))).count(" at 0:") == 1


def test_the_exit_is_told_instead_of_a_straight_turn() -> None:
    ride = made(BESIDE, 4.0, roads=ring)
    text = said(ride, HowMuch(Measured("turn")))
    assert "straight over the roundabout, by the second exit" in text


def test_yields_to_nobody_in_particular_are_counted_for_all() -> None:
    ride = made(HALT, 6.0)
    found = told(ride, HowMany(Event("give-way", object=Nobody(Described()))))
    assert isinstance(found, Counted)
    assert found.of == Event("give-way")
    assert "nobody" not in said(ride, HowMany(Event("give-way", object=Nobody())))


def test_going_first_is_asked_as_right_of_way() -> None:
    ride = made(BESIDE, 4.0, roads=ring)
    going = Event("go", Wanted(), manner=("first",), tense="present")
    found = told(ride, Which(Wanted(), Happens(going)))
    assert isinstance(found, Priority)
    assert (found.time, found.rule, found.vehicle) == (4.0, "give-way", None)
    assert found.ring
    assert not found.blame


def test_the_farthest_is_one_vehicle() -> None:
    ride = made(BESIDE, 4.0)
    wanted = Described(extreme="farthest")
    found = told(ride, Which(wanted, Related("left-of", Wanted())))
    assert isinstance(found, Identified)
    assert [look.vehicle for look in found.looks] == [2]


def test_who_drives_ahead_on_our_road_is_not_asked_for_right_of_way() -> None:
    same = {0: Actor(straight(0.0, 0.0, 10.0)), 1: Actor(straight(20.0, 0.0, 10.0))}
    ride = made(same, 4.0, roads=lambda t: RoadFacts(places={0: place(), 1: place()}))
    found = told(ride, Fault(suspect=Vehicle(1)))
    assert isinstance(found, Priority)
    assert found.rule == "none"
    assert found.first is None
    assert said(ride, Fault(suspect=Vehicle(1))).startswith("It is not for me to say")


def test_a_request_is_met_with_what_bears_on_it() -> None:
    ride = made(BESIDE, 4.0, roads=ring)
    faster = told(ride, Request(Event("speed-up", tense="present")))
    assert isinstance(faster, Declined)
    assert [m.attribute for m in faster.facts] == ["speed"]
    ending = told(ride, Request(Event("stop", tense="present")))
    assert [m.attribute for m in ending.facts] == ["arrival-time"]


def test_to_go_is_answered_by_why_we_slow_down() -> None:
    actors = {0: Actor(speeds(0.0, 0.0, STOPS)), 1: Actor(straight(20.0, 3.5, 14.0))}
    ride = made(actors, 6.0, roads=ring)
    going = told(ride, Request(Event("go", tense="present")))
    assert going.cause is not None
    assert said(ride, Request(Event("go", tense="present"))).startswith("I mean to keep going")
    assert not told(ride, Request(Event("speed-up", tense="present"))).already


def test_what_is_said_of_us_at_another_time_says_when() -> None:
    ride = made(BESIDE, 8.0, roads=ring)
    for attribute in ("distance-to-go", "time-to-go", "distance-driven", "turn", "place"):
        text = said(ride, HowMuch(Measured(attribute, Ego(), time=At(2.0), tense="past")))  # type: ignore[arg-type]
        assert text.startswith("About 6 seconds ago"), text


def test_one_stop_for_several_counts_once() -> None:
    """Way that is given to two vehicles at one time is given once, and both are named."""
    whom = (Episode(Ego(), "give-way", 2.0, 5.0, Vehicle(1)),
            Episode(Ego(), "give-way", 2.0, 5.0, Vehicle(2)))  # fmt: skip
    ride = made(BESIDE, 8.0)
    world = world_of(ride.record)
    context = SpeechContext(now=8.0, looks=world.look)
    text = say(Counted(Event("give-way"), 1, whom, since=0.0, until=8.0), context).text
    assert text.startswith("I have given way once so far, at 0:02 to the red car")
    assert "and the blue car" in text
