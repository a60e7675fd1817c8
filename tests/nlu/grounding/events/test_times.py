"""Times: the part of the ride that is meant, said or not."""

import pytest
from msgspec.structs import replace

from tests.nlu.grounding.fakes import Car, FakeWorld, act, asked, did, question_of, road, talk
from xavi_dialogue.domain.discourse import Discourse, Span
from xavi_dialogue.domain.meaning import (
    Doing,
    Feel,
    HowMany,
    HowMuch,
    Listing,
    Summarise,
    Where,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    Ago,
    At,
    Back,
    Between,
    Described,
    Event,
    Happens,
    Junction,
    Measured,
    Next,
    Not,
    Now,
    Rank,
    Relative,
    Start,
    Time,
    Vehicle,
    Wanted,
    WholeRide,
    Within,
)

RING = Junction("roundabout", time=20.0)
RIDE = FakeWorld(
    {1: Car(20.0, colour="black"), 2: Car(-10.0, colour="red")},
    (
        did("slow-down", 2.0, 4.0),
        did("slow-down", 12.0, 14.0),
        did("give-way", 12.0, 15.0, whom=1),
        did("enter", 20.0, 20.0, place=RING),
        did("slow-down", 18.0, 19.0),
        did("change-left", 22.0, 24.0, side="left"),
        did("exit-right", 20.0, 26.0, side="right", place=RING),
        did("leave", 26.0, 26.0, place=RING),
        did("slow-down", 30.0, 33.0),
        did("pass", 35.0, 36.0, who=1, whom=0),
    ),
    now=40.0,
)
SLOW = Event("slow-down")


def when(time: Time, world: FakeWorld = RIDE, discourse: Discourse | None = None) -> Time:
    """Ask why we slowed down at a time."""
    found = question_of(asked(Why(Happens(replace(SLOW, time=time))), world, discourse))
    return found.of.event.time  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("time", "meant"),
    [
        (At(3.0), Between(2.0, 4.0)),
        (At(15.0), Between(12.0, 14.0)),
        (Ago(27.0), Between(12.0, 14.0)),
        (Rank(1), Between(2.0, 4.0)),
        (Rank(2), Between(12.0, 14.0)),
        (Rank(-1), Between(30.0, 33.0)),
        (Start(), Between(2.0, 4.0)),
        (Between(10.0, 15.0), Between(10.0, 15.0)),
        (Relative("during", Junction("roundabout")), Between(18.0, 19.0)),
        (Relative("before", Junction("roundabout")), Between(18.0, 19.0)),
        (Relative("after", Junction("roundabout")), Between(30.0, 33.0)),
        (Relative("before", Event("give-way")), Between(2.0, 4.0)),
        (Relative("during", Event("give-way")), Between(12.0, 14.0)),
        (Relative("after", Event("change-left")), Between(30.0, 33.0)),
        (Relative("during", Vehicle(1)), Between(30.0, 33.0)),
        (WholeRide(), WholeRide()),
    ],
)
def test_a_time_finds_its_episode(time: Time, meant: Time) -> None:
    assert when(time) == meant


def test_the_last_time_is_meant_where_none_is_said() -> None:
    found = asked(Why(Happens(SLOW)), RIDE)
    assert found.acts[0].span == Span(begin=30.0, end=33.0)
    assert question_of(found).of.event.time == Between(30.0, 33.0)  # type: ignore[union-attr]


def test_a_time_that_was_said_is_marked_so() -> None:
    found = asked(Why(Happens(replace(SLOW, time=At(3.0)))), RIDE)
    assert found.acts[0].span == Span(begin=2.0, end=4.0, said=True)


def test_the_episode_in_focus_is_meant_in_a_conversation() -> None:
    focus = Discourse(turn=2, episode=(12.0, 15.0), asked_at=38.0)
    assert when(SLOW.time, discourse=focus) == Between(12.0, 14.0)


def test_what_has_happened_since_the_last_question_is_meant() -> None:
    focus = Discourse(turn=2, episode=(12.0, 15.0), asked_at=25.0)
    assert when(SLOW.time, discourse=focus) == Between(30.0, 33.0)


def test_then_and_before_that_go_by_the_focus() -> None:
    focus = Discourse(turn=2, episode=(12.0, 15.0))
    assert when(Back(), discourse=focus) == Between(12.0, 14.0)
    assert when(Back("before"), discourse=focus) == Between(2.0, 4.0)
    assert when(Back("after"), discourse=focus) == Between(18.0, 19.0)


def test_the_present_is_what_is_going_on() -> None:
    world = FakeWorld({}, (did("slow-down", 17.0, going_on=True),), now=20.0)
    found = asked(Why(Happens(replace(SLOW, tense="present"))), world)
    assert found.acts[0].span == Span(begin=17.0, end=20.0)
    assert question_of(found).of.event.time == Now()  # type: ignore[union-attr]


def test_the_present_may_be_just_over() -> None:
    world = FakeWorld({}, (did("slow-down", 10.0, 13.0),), now=20.0)
    found = asked(Why(Happens(replace(SLOW, tense="present"))), world)
    assert found.acts[0].presupposed
    assert question_of(found).of.event.time == Between(10.0, 13.0)  # type: ignore[union-attr]


def test_the_perfect_of_a_reason_is_the_last_time() -> None:
    assert when(SLOW.time) == Between(30.0, 33.0)
    found = asked(Why(Happens(replace(SLOW, tense="perfect"))), RIDE)
    assert found.acts[0].span == Span(begin=30.0, end=33.0)


def test_what_never_happened_is_noted_and_what_is_like_it_found() -> None:
    found = asked(Why(Happens(Event("stop"))), RIDE)
    assert not found.acts[0].presupposed
    assert found.acts[0].span is not None
    assert not asked(Why(Happens(Event("collide"))), RIDE).acts[0].presupposed


def test_what_happened_at_another_time_is_noted() -> None:
    found = asked(Why(Happens(Event("change-left", time=At(5.0)))), RIDE)
    assert not found.acts[0].presupposed
    assert found.acts[0].span == Span(begin=5.0, end=5.0, said=True)


def test_why_not_takes_for_granted_that_it_did_not_happen() -> None:
    assert asked(Why(Not(Happens(Event("overtake")))), RIDE).acts[0].presupposed
    just_now = FakeWorld({}, (did("stop", 18.0, going_on=True),))
    assert not asked(Why(Not(Happens(Event("stop")))), just_now).acts[0].presupposed


@pytest.mark.parametrize(
    ("time", "span"),
    [
        (Within(5.0), Span(begin=40.0, end=45.0, said=True, ahead=True)),
        (Next(), Span(begin=40.0, end=55.0, said=True, ahead=True)),
        (At(60.0), Span(begin=60.0, end=60.0, said=True, ahead=True)),
    ],
)
def test_the_future_lies_ahead(time: Time, span: Span) -> None:
    turning = Event("turn", time=time, tense="future")
    assert asked(Whether(Happens(turning)), RIDE).acts[0].span == span


def test_after_something_to_come_lies_ahead() -> None:
    passing = Relative("after", Event("pass", Described(colour="red"), tense="perfect"))
    found = asked(Doing(time=passing, tense="future"), RIDE)
    assert found.acts[0].span is not None
    assert found.acts[0].span.ahead
    assert question_of(found).time == Next()  # type: ignore[union-attr]


def test_a_junction_to_come_lies_ahead() -> None:
    world = FakeWorld(now=10.0, facts=road("roundabout"))
    there = Relative("during", Junction("roundabout"))
    found = asked(Doing(time=there, tense="future"), world)
    assert question_of(found).time == Next()  # type: ignore[union-attr]


def test_counts_and_extremes_are_of_the_whole_ride() -> None:
    many = question_of(asked(HowMany(SLOW), RIDE))
    assert many.of.time == WholeRide()  # type: ignore[union-attr]
    most = HowMuch(Measured("speed", tense="past"), extreme="highest")
    assert question_of(asked(most, RIDE)).of.time == WholeRide()  # type: ignore[union-attr]


def test_accounts_are_of_the_whole_ride_unless_said() -> None:
    assert question_of(asked(Summarise(), RIDE)).time == WholeRide()  # type: ignore[union-attr]
    at = question_of(asked(Listing("events", time=Between(3.0, 9.0)), RIDE))
    assert at.time == Between(3.0, 9.0)  # type: ignore[union-attr]


def test_back_there_without_a_focus_is_what_happened_last() -> None:
    found = question_of(asked(Doing(None, Back(), tense="past"), RIDE))
    assert found.time == Between(30.0, 33.0)  # type: ignore[union-attr]


def test_a_past_value_is_of_the_episode_in_focus() -> None:
    speed = HowMuch(Measured("speed", tense="past"))
    found = asked(speed, RIDE, talk(episode=(12.0, 14.0)))
    assert question_of(found).of.time == Between(12.0, 14.0)  # type: ignore[union-attr]


def test_a_value_during_an_event_is_of_its_beginning() -> None:
    turning = Relative("during", Event("change-left"))
    found = asked(HowMuch(Measured("speed", time=turning, tense="past")), RIDE)
    assert question_of(found).of.time == At(22.0)  # type: ignore[union-attr]


def test_an_extreme_during_an_event_is_of_all_of_it() -> None:
    turning = Relative("during", Event("change-left"))
    found = asked(HowMuch(Measured("speed", time=turning, tense="past"), "highest"), RIDE)
    assert question_of(found).of.time == Between(22.0, 24.0)  # type: ignore[union-attr]


def test_a_feeling_is_about_the_last_seconds() -> None:
    assert act(Feel("startled"), RIDE).acts[0].span == Span(begin=34.0, end=40.0)


def test_whom_an_event_concerned_may_be_asked() -> None:
    found = asked(Which(Wanted(), Happens(Event("give-way", object=Wanted()))), RIDE)
    assert found.acts[0].span == Span(begin=12.0, end=15.0)
    assert question_of(found).such.event.object == Wanted()  # type: ignore[union-attr]


def test_where_something_happened_at_a_time() -> None:
    found = question_of(asked(Where(SLOW, time=At(3.0)), RIDE))
    assert found == Where(replace(SLOW, time=Between(2.0, 4.0)))
