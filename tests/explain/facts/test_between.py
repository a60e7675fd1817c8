"""Measures between two vehicles, worked out by hand."""

import math

import pytest

from planner.record.places import RoadFacts, RoadPlace
from tests.explain.facts.scenes import Actor, Path_, made, straight
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import Destination, Ego, Thing, Vehicle, Vehicles
from xavi_dialogue.domain.vocabulary import Attribute
from xavi_dialogue.explain.facts.measures.between import leader, time_to_touch
from xavi_dialogue.explain.facts.measures.measuring import measure
from xavi_dialogue.explain.facts.states import States

US, ONE, TWO = Ego(), Vehicle(1), Vehicle(2)


def middle(x: float, y: float, speed: float, turn: float = 0.0) -> Path_:
    heading = math.radians(turn)
    return straight(x + 2.4 * math.cos(heading), y + 2.4 * math.sin(heading), speed, heading)


def states(*others: Path_, ours: Path_ | None = None, until: float = 4.0) -> States:
    own = middle(0.0, 0.0, 10.0) if ours is None else ours
    return States(made({k: Actor(p) for k, p in enumerate((own, *others))}, until))


def of(
    found: States,
    attribute: Attribute,
    thing: Thing = US,
    to: Thing | None = None,
    at: float = 4.0,
) -> Measure:
    return measure(found, attribute, thing, at, to)


def test_who_is_next_ahead_on_ones_line() -> None:
    found = states(
        middle(60.0, 0.0, 10.0),
        middle(25.0, 0.0, 10.0),
        middle(15.0, 3.5, 10.0),
        middle(-20.0, 0.0, 10.0),
        middle(95.0, 0.0, -10.0, 180.0),
    )
    assert leader(found, 0, 4.0) == 2
    assert leader(found, 2, 4.0) == 1
    assert leader(found, 1, 4.0) is None
    assert leader(found, 4, 4.0) == 0
    assert leader(found, 3, 4.0) is None
    assert leader(found, 9, 4.0) is None


def test_the_gap_to_the_one_ahead_or_to_somebody() -> None:
    found = states(middle(30.0, 0.0, 5.0), middle(-18.0, 0.0, 8.0), middle(0.0, 9.0, 8.0))
    gap = of(found, "gap")  # after 4 s, 30 - 20 - 4.8 m
    assert (gap.value, gap.to, gap.time) == (5.2, ONE, 4.0)
    assert of(found, "gap", to=ONE).value == 5.2
    assert of(found, "gap", ONE).value == 5.2  # to us, as nobody else is named
    assert of(found, "gap", TWO).value == 21.2
    assert of(found, "gap", ONE, TWO).value == 31.2
    assert of(found, "gap", to=Vehicles((2, 1))).value == 21.2
    assert of(found, "gap", to=Vehicle(3)).gap == "not-applicable"
    assert of(found, "gap", to=Destination()).gap == "not-applicable"
    assert of(states(), "gap").gap == "not-applicable"


def test_headway_is_that_of_the_one_behind() -> None:
    found = states(middle(30.0, 0.0, 5.0), middle(-18.0, 0.0, 8.0))
    headway = of(found, "headway")
    assert (headway.value, headway.reference, headway.to) == (0.52, 5.2, ONE)
    behind = of(found, "headway", TWO)
    assert (behind.value, behind.reference) == (2.65, 21.2)
    slow = states(middle(30.0, 0.0, 0.0), ours=middle(0.0, 0.0, 0.4))
    assert (of(slow, "headway").gap, of(slow, "headway").reference) == ("not-applicable", 23.6)
    crawl = states(middle(30.0, 0.0, 0.0), ours=middle(0.0, 0.0, 0.6))
    assert of(crawl, "headway").value == pytest.approx(22.8 / 0.6)
    assert of(states(), "headway").gap == "not-applicable"


def test_the_distance_of_two_bodies() -> None:
    found = states(middle(30.0, 3.0, 5.0), middle(-18.0, 0.0, 8.0))
    assert of(found, "distance", to=ONE).value == round(math.hypot(5.2, 1.2), 2)
    assert of(found, "distance", ONE).value == round(math.hypot(5.2, 1.2), 2)
    assert of(found, "distance").gap == "not-applicable"
    assert of(found, "distance", to=Ego()).gap == "not-applicable"


@pytest.mark.parametrize(
    ("x", "speed", "turn", "seconds"),
    [
        (30.0, 5.0, 0.0, 1.04),  # 5.2 m at 5 m/s
        (30.0, 9.0, 0.0, 21.2),  # at 1 m/s
        (40.0, 9.0, 0.0, None),  # 31.2 s are too long
        (30.0, 12.0, 0.0, None),
        (-30.0, 15.0, 0.0, 1.04),
        (120.0, 10.0, 180.0, 1.8),  # 40 - 4.8 m at 20 m/s, in tenths
    ],
)
def test_the_time_to_a_collision(
    x: float, speed: float, turn: float, seconds: float | None
) -> None:
    found = states(middle(x, 0.0, speed, turn))
    value = time_to_touch(found, 0, 1, 4.0)
    assert value == (None if seconds is None else pytest.approx(seconds))
    told = of(found, "time-to-collision", to=ONE)
    assert told.value == (None if seconds is None else pytest.approx(seconds))
    assert told.gap == ("not-applicable" if seconds is None else None)
    assert time_to_touch(found, 0, 5, 4.0) is None


def test_the_time_to_a_collision_with_the_one_ahead() -> None:
    assert of(states(middle(30.0, 0.0, 5.0)), "time-to-collision").value == pytest.approx(1.04)
    assert of(states(middle(30.0, 9.0, 5.0)), "time-to-collision").gap == "not-applicable"


def test_where_somebody_is() -> None:
    found = states(middle(50.0, 3.5, 10.0), middle(-30.0, 0.0, 10.0))
    place = of(found, "place", ONE)
    assert (place.word, place.value) == ("ahead-left", 45.2)
    assert of(found, "place", ONE, TWO).word == "ahead-left"
    assert of(found, "place", TWO, ONE).word == "behind-right"
    assert of(found, "place", Ego(), ONE).word == "behind-right"
    assert of(found, "place", Ego()).gap == "not-applicable"


def test_lanes_on_record_tell_where_somebody_is() -> None:
    places = {v: RoadPlace("main", 0, 2, 14.0, False, False) for v in (0, 1)}
    actors = {0: Actor(middle(0.0, 0.0, 0.0)), 1: Actor(middle(40.0, 3.0, 0.0))}
    found = States(made(actors, 2.0, roads=lambda _: RoadFacts(places)))
    assert of(found, "place", ONE, at=2.0).word == "ahead"
