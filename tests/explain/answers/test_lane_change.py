"""What is said of a lane change between a slow truck and a car that has to brake for us.

We drive at 12 m/s in the right one of two lanes, 40 m behind a truck at 8 m/s, and move over to
the left from 4 s to 6 s, ahead of a car at 12.5 m/s that brakes to 9 m/s from 5 s to 6 s.
"""

import math
from typing import Any

import pytest

from planner.record.events import Event as Told
from planner.record.places import RoadFacts, RoadPlace, RouteStep
from tests.explain.answers.asked_facts import told
from tests.explain.facts.scenes import Actor, made, shifted, speeds, straight
from xavi_dialogue.domain.answers import (
    Activity,
    Counted,
    DidNotHappen,
    Happenings,
    Identified,
    Lasted,
    Verdict,
)
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.journeys import Course
from xavi_dialogue.domain.meaning import (
    Doing,
    HowLong,
    HowMany,
    HowMuch,
    Listing,
    Summarise,
    When,
    Where,
    Whether,
    Which,
)
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Both,
    Compares,
    Ego,
    Event,
    Exists,
    Happens,
    Has,
    Is,
    Measured,
    Quantity,
    Related,
    Vehicle,
    Wanted,
    WholeRide,
)
from xavi_dialogue.explain.history.ride import Ride

TRUCK, CAR = Vehicle(1), Vehicle(2)
ACTORS = {
    0: Actor(shifted(straight(0.0, 0.0, 12.0), 4.0, 6.0, 3.5)),
    1: Actor(straight(40.0, 0.0, 8.0), kind="truck", colour="red"),
    2: Actor(speeds(-12.0, 3.5, ((0.0, 12.5), (5.0, 12.5), (6.0, 9.0)))),
}
MOVED = (
    Told("action-started", 4.0, "change-left", 4),
    Told("action-committed", 4.0, "change-left", 4),
    Told("action-ended", 6.0, "change-left", 4),
)


def roads(time: float) -> RoadFacts:
    """Two lanes to a junction 300 m from the start, at which we turn right."""

    def lane(number: int) -> RoadPlace:
        return RoadPlace("main", number, 2, 13.89, False, False)

    step = RouteStep(300.0 - 12.0 * time, "junction", "exit-right", None, None, 4, "give-way")
    places = {0: lane(0 if time < 5.0 else 1), 1: lane(0), 2: lane(1)}
    left = 400.0 - 12.0 * time
    return RoadFacts(places, (step,), left, left / 12.0, ())


def ride(now: float = 8.0) -> Ride:
    events = tuple(event for event in MOVED if event.sim_time <= now)
    return made(ACTORS, now, events=events, roads=roads)


def does(action: Any, actor: Any = None, to: Any = None, **more: Any) -> Happens:
    more.setdefault("tense", "past")
    return Happens(Event(action, actor or Ego(), to, **more))


def verdict(that: Any, now: float = 8.0) -> Verdict:
    found = told(ride(now), Whether(that))
    assert isinstance(found, Verdict), found
    return found


def deeds(facts: Any) -> list[tuple[Any, str]]:
    return [(fact.actor, fact.action) for fact in facts if isinstance(fact, Episode)]


@pytest.mark.parametrize(
    ("that", "holds", "now"),
    [
        (does("change-left"), True, 8.0),
        (does("change-left", tense="present"), True, 5.0),
        (does("change-left", tense="present"), False, 8.0),
        (does("change-left"), False, 3.0),
        (does("change-right"), False, 8.0),
        (does("change-lane"), True, 8.0),
        (does("change-left", time=At(5.0)), True, 8.0),
        (does("change-left", time=Between(0.0, 2.0)), False, 8.0),
        (does("brake", CAR), True, 8.0),
        (does("brake", CAR), False, 4.0),
        (does("brake", CAR, time=Between(5.0, 6.0)), True, 8.0),
        (does("brake", CAR, time=Between(0.0, 3.0)), False, 8.0),
        (does("brake", TRUCK), False, 8.0),
        (does("brake"), False, 8.0),
        (does("stop"), False, 8.0),
        (does("follow", to=TRUCK), True, 8.0),
        (does("follow", to=TRUCK, tense="present"), True, 3.0),
        (does("follow", to=TRUCK, tense="present"), False, 8.0),
        (does("follow", CAR, Ego(), tense="present"), True, 8.0),
        (does("overtake", to=TRUCK, tense="present"), True, 5.0),
        (does("approach", TRUCK, Ego(), tense="present"), True, 3.0),
        (does("approach", CAR, Ego(), tense="present"), True, 3.0),
        (does("approach", CAR, Ego(), tense="present"), False, 8.0),
        (Related("ahead-of", TRUCK, Ego()), True, 8.0),
        (Related("ahead-of", CAR, Ego()), False, 8.0),
        (Related("behind", CAR, Ego()), True, 8.0),
        (Related("behind", TRUCK, Ego()), False, 8.0),
        (Related("behind", TRUCK, CAR), False, 8.0),
        (Related("behind", CAR, TRUCK), True, 8.0),
        (Related("right-of", TRUCK, Ego()), True, 8.0),
        (Related("left-of", TRUCK, Ego()), False, 8.0),
        (Related("left-of", CAR, Ego(), time=At(2.0), tense="past"), True, 8.0),
        (Related("left-of", CAR, Ego()), False, 8.0),
        (Compares(Measured("speed"), "more", Measured("speed", TRUCK)), True, 8.0),
        (Compares(Measured("speed"), "less", Measured("speed", TRUCK)), False, 8.0),
        (Compares(Measured("speed"), "more", Measured("speed", CAR)), True, 8.0),
        (Compares(Measured("speed"), "more", Measured("speed", CAR)), False, 4.0),
        (Compares(Measured("speed"), "at-most", Measured("limit")), True, 8.0),
        (Compares(Measured("speed"), "more", Measured("limit")), False, 8.0),
        (Compares(Measured("speed"), "more", Quantity(11.0, "m/s")), True, 8.0),
        (Compares(Measured("speed"), "more", Quantity(12.5, "m/s")), False, 8.0),
        (Compares(Measured("speed"), "less", Quantity(12.5, "m/s")), True, 8.0),
        (Compares(Measured("distance", TRUCK), "less", Measured("distance", CAR)), True, 8.0),
        (Has("colour", "red", TRUCK), True, 8.0),
        (Has("colour", "blue", TRUCK), False, 8.0),
        (Has("kind", "truck", TRUCK), True, 8.0),
        (Has("kind", "truck", CAR), False, 8.0),
        (Has("lane", "left", Ego()), True, 8.0),
        (Has("lane", "left", Ego()), False, 3.0),
        (Has("lane", "right", Ego()), True, 3.0),
        (Exists(TRUCK), True, 8.0),
        (Is("stationary", TRUCK), False, 8.0),
        (Is("moving", TRUCK), True, 8.0),
        (Is("visible", TRUCK), True, 8.0),
        (Both((does("change-left"), does("brake", CAR)), "and"), True, 8.0),
        (Both((does("change-left"), does("brake")), "and"), False, 8.0),
    ],
)
def test_a_question_for_yes_or_no_is_answered_by_what_went_on(
    that: Any, holds: bool, now: float
) -> None:
    assert verdict(that, now).holds is holds


@pytest.mark.parametrize(
    ("of", "value", "now"),
    [
        (Measured("speed"), 12.0, 8.0),
        (Measured("speed", TRUCK), 8.0, 8.0),
        (Measured("speed", CAR), 9.0, 8.0),
        (Measured("speed", CAR, time=At(4.0), tense="past"), 12.5, 8.0),
        (Measured("limit"), 13.89, 8.0),
        (Measured("excess"), 12.0 - 13.89, 8.0),
        (Measured("lane-count"), 2.0, 8.0),
        (Measured("lane"), 2.0, 8.0),
        (Measured("lane"), 1.0, 3.0),
        (Measured("distance-to-go"), 304.0, 8.0),
        (Measured("distance-driven"), 96.3, 8.0),  # the lane change is a little longer
        # Between bodies of 4.8 m, 1.8 m and 2.5 m wide: 8 m ahead and 3.5 m aside.
        (Measured("distance", TRUCK), math.hypot(8.0 - 4.8, 3.5 - 2.15), 8.0),
        (Measured("distance", TRUCK, time=At(2.0), tense="past"), 32.0 - 4.8, 8.0),
        (Measured("distance", CAR), 96.0 - (-12.0 + 62.5 + 10.75 + 18.0) - 4.8, 8.0),
        (Measured("gap", TRUCK), 28.0 - 4.8, 3.0),
        (Measured("headway", to=TRUCK), (28.0 - 4.8) / 12.0, 3.0),
        (Measured("time-to-collision", to=TRUCK), (28.0 - 4.8) / 4.0, 3.0),
    ],
)
def test_a_measure_is_what_geometry_makes_of_it(of: Measured, value: float, now: float) -> None:
    found = told(ride(now), HowMuch(of)).measures[0]
    assert found.gap is None
    assert found.value == pytest.approx(value, abs=0.02)


@pytest.mark.parametrize(
    ("of", "which", "value", "time"),
    [
        (Measured("speed", CAR), "highest", 12.5, None),
        (Measured("speed", CAR), "lowest", 9.0, 6.0),
        (Measured("distance", to=TRUCK), "lowest", math.hypot(3.2, 1.35), 8.0),
        (Measured("distance", to=TRUCK), "highest", 35.2, 0.0),
        (Measured("deceleration", CAR), "highest", 3.5, None),
    ],
)
def test_an_extreme_has_a_value_and_a_time(
    of: Measured, which: Any, value: float, time: float | None
) -> None:
    from msgspec.structs import replace

    whole = replace(of, tense="past", time=WholeRide())
    found = told(ride(), HowMuch(whole, which)).measures[0]
    assert found.value == pytest.approx(value, abs=0.05)
    assert found.extreme == which
    if time is not None:
        assert found.time == pytest.approx(time, abs=0.3)


@pytest.mark.parametrize(
    ("asked", "vehicles"),
    [
        (Which(Wanted(), does("brake", Wanted())), [2]),
        (Which(Wanted(), Related("behind", Wanted(), Ego())), [2]),
        (Which(Wanted(), Related("ahead-of", Wanted(), Ego())), [1]),
        (Which(Wanted(), Related("right-of", Wanted(), Ego())), [1]),
        (Which(Wanted(), Has("colour", "red", Wanted())), [1]),
        (Which(Wanted(), Is("visible", Wanted())), [1, 2]),
        (
            Which(Wanted(), Compares(Measured("speed", Wanted()), "less", Measured("speed"))),
            [1, 2],
        ),
        (
            Which(Wanted(), Compares(Measured("speed", Wanted()), "more", Quantity(8.5, "m/s"))),
            [2],
        ),
        (Which(Wanted("truck"), Is("visible", Wanted("truck"))), [1]),
        (Which(Wanted("bus"), Is("visible", Wanted("bus"))), []),
        (Which(Wanted(), does("stop", Wanted())), []),
        (Listing("vehicles"), [1, 2]),
    ],
)  # fmt: skip
def test_those_of_whom_it_holds_are_named(asked: Any, vehicles: list[int]) -> None:
    found = told(ride(), asked)
    assert isinstance(found, Identified), found
    assert sorted(look.vehicle for look in found.looks) == vehicles
    assert found.none is (not vehicles)


def test_when_where_and_how_long_we_changed_lanes() -> None:
    when = told(ride(), When(does("change-left")))
    assert isinstance(when, Happenings)
    assert [(e.action, e.begin, e.end, e.side) for e in when.episodes] == [
        ("change-left", 4.0, 6.0, "left")
    ]
    long = told(ride(), HowLong(Event("change-left", tense="past")))
    assert long.measures[0].value == pytest.approx(2.0, abs=0.2)
    count = told(ride(), HowMany(Event("change-lane", tense="past", time=WholeRide())))
    assert isinstance(count, Counted)
    assert count.count == 1
    assert told(ride(), HowMany(Event("stop", tense="past", time=WholeRide()))).count == 0
    never = told(ride(), When(does("change-right")))
    assert isinstance(never, DidNotHappen)
    assert never.asked.action == "change-right"
    where = told(ride(), Where(Event("change-left", tense="past")))
    assert [m.time for m in where.measures] == [4.0] * len(where.measures)


def test_how_long_we_were_behind_the_truck_and_saw_it() -> None:
    seen = told(ride(), HowLong(Is("visible", TRUCK)))
    assert seen == Lasted(Is("visible", TRUCK), 0.0, None, 8.0, True)
    followed = told(ride(), HowLong(Event("follow", Ego(), CAR, tense="past")))
    assert not isinstance(followed, Lasted)
    right = told(ride(), HowLong(Has("lane", "right", Ego(), tense="past")))
    assert isinstance(right, Lasted)
    assert right.begin == 0.0
    assert right.end == pytest.approx(4.5, abs=0.6)


def test_what_everybody_is_doing() -> None:
    ours = told(ride(5.0), Doing(Ego()))
    assert isinstance(ours, Activity)
    assert (Ego(), "change-left") in deeds(ours.doing)
    assert (ours.speed, ours.trend, ours.time) == (12.0, "steady", 5.0)
    theirs = told(ride(), Doing(CAR, At(6.0), "past"))
    assert (CAR, "brake") in deeds(theirs.doing)
    assert theirs.trend == "slowing"
    assert theirs.look is not None
    assert (theirs.look.vehicle, theirs.look.time) == (2, 6.0)
    assert told(ride(), Doing(TRUCK)).trend == "steady"


def test_the_list_of_what_happened_has_the_change_and_the_braking() -> None:
    listed = told(ride(), Listing("events", None, WholeRide()))
    assert isinstance(listed, Happenings)
    assert (listed.since, listed.until) == (0.0, 8.0)
    assert (Ego(), "change-left") in deeds(listed.episodes)
    begins = [e.begin for e in listed.episodes]
    assert begins == sorted(begins)
    whole = told(ride(), Summarise(Ego(), WholeRide()))
    measures = {m.attribute: m.value for m in whole.measures}
    assert measures["duration"] == pytest.approx(8.0)
    assert measures["distance-driven"] == pytest.approx(96.3, abs=0.1)


def test_the_way_ahead_is_not_straight_on() -> None:
    for now in (5.0, 8.0):
        found = told(ride(now), Whether(does("continue", tense="present")))
        assert isinstance(found, Course)
        assert not found.holds
        (step,) = found.steps
        assert (step.turn, step.distance) == ("exit-right", pytest.approx(300.0 - 12.0 * now))
        assert found.left == pytest.approx(400.0 - 12.0 * now)
