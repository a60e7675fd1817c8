"""The highest, lowest, first, last, mean and total over an interval."""

import math

import pytest

from planner.record.places import RoadFacts, RoadPlace
from tests.explain.facts.scenes import Actor, made, speeds, straight
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import Ego, Thing, Vehicle
from xavi_dialogue.domain.vocabulary import Attribute, Extreme
from xavi_dialogue.explain.facts.measures.extremes import extreme
from xavi_dialogue.explain.facts.measures.measuring import measure
from xavi_dialogue.explain.facts.states import States

US, ONE, TWO = Ego(), Vehicle(1), Vehicle(2)


def of(
    found: States, attribute: Attribute, thing: Thing = US, at: float = 8.0, to: Thing | None = None
) -> Measure:
    return measure(found, attribute, thing, at, to)


STOPS = ((0.0, 8.0), (2.0, 0.0), (4.0, 0.0), (5.0, 8.0), (6.0, 8.0), (8.0, 0.0), (12.0, 0.0))


HILLS = ((0.0, 10.0), (4.0, 14.0), (8.0, 6.0), (10.0, 6.0))


def over(
    which: Extreme,
    attribute: Attribute = "speed",
    begin: float = 0.0,
    end: float = 10.0,
    thing: Thing = US,
    to: Thing | None = None,
) -> Measure:
    """Of us behind the first, and of the second, which is there from 3 to 6 s, beside us."""
    place = RoadPlace("a", 0, 1, 14.0, False, False)
    actors = {
        0: Actor(speeds(0.0, 0.0, HILLS)),
        1: Actor(straight(60.0, 0.0, 10.0)),
        2: Actor(straight(5.0, 9.0, 10.0), since=3.0, until=6.0),
    }
    states = States(made(actors, 10.0, roads=lambda _: RoadFacts({0: place}), gaps=((2.0, 2.5),)))
    return extreme(states, attribute, thing, which, (begin, end), to)


def test_highest_and_lowest() -> None:
    high, low = over("highest"), over("lowest")
    assert (high.value, high.time, high.extreme, high.until) == (14.0, 4.0, "highest", 10.0)
    assert (low.value, low.time, low.extreme, low.reference) == (6.0, 8.0, "lowest", 14.0)
    assert over("highest", end=2.0).value == 12.0
    assert over("lowest", begin=5.0, end=6.0).value == 10.0
    assert over("highest", "acceleration").value == 1.0
    assert over("lowest", "acceleration").value == -2.0
    assert over("highest", "deceleration").value == 2.0
    assert over("lowest", "deceleration").value == 0.0
    jerk = over("highest", "jerk")
    assert jerk.value == pytest.approx(3.0 / 0.6, abs=0.2)
    assert jerk.time == pytest.approx(4.0, abs=0.31)
    assert over("lowest", "excess", begin=4.0).value == -8.0
    assert over("highest", "excess", begin=-5.0, end=30.0).until == 10.0


def test_the_smallest_gap_names_the_one_ahead() -> None:
    """At 4 s the two drive alike at 60 - 8 - 4.8 m, and it grows again from 6 s on."""
    found = over("lowest", "gap")
    assert found.to == ONE
    assert found.time == pytest.approx(6.0, abs=0.25)
    assert found.value == pytest.approx(60.0 + 60.0 - 4.8 - (12.0 * 4 + 12.0 * 2), abs=0.2)


def test_the_mean() -> None:
    found = over("mean", begin=0.0, end=4.0)
    assert (found.value, found.extreme, found.time) == (12.0, "mean", 0.0)


@pytest.mark.parametrize(("which", "value", "time"), [("first", 11.0, 1.0), ("last", 13.0, 3.0)])
def test_the_first_and_the_last_value(which: Extreme, value: float, time: float) -> None:
    found = over(which, begin=1.0, end=3.0)
    assert (found.value, found.time, found.until) == (value, time, 3.0)


@pytest.mark.parametrize(
    ("attribute", "begin", "end", "value", "lost"),
    [
        ("distance-driven", 0.0, 4.0, 48.0, True),
        ("distance", 3.0, 4.0, 13.5, False),
        ("time", 3.0, 8.5, 5.5, False),
        ("duration", 2.6, 8.5, 5.9, False),
        ("count", 0.0, 2.0, 1.0, True),
        ("count", 4.0, 5.0, 2.0, False),
        ("count", 6.2, 9.0, 1.0, False),
        ("waiting-time", 3.0, 8.0, 0.0, False),
        ("speed", 3.0, 8.0, None, False),
    ],
)
def test_totals(
    attribute: Attribute, begin: float, end: float, value: float | None, lost: bool
) -> None:
    found = over("total", attribute, begin, end)
    assert found.value == value
    assert found.at_least is lost
    if value is None:
        assert found.gap == "not-applicable"
    else:
        assert (found.extreme, found.time, found.until) == ("total", begin, end)


def test_the_time_waited_in_an_interval() -> None:
    found = States(
        made({0: Actor(speeds(0.0, 0.0, STOPS)), 1: Actor(straight(13.5, 0.0, 0.0))}, 11.0)
    )
    waited = extreme(found, "waiting-time", US, "total", (3.0, 10.0), None)
    assert waited.value == pytest.approx(1.2 + 2.2, abs=0.25)
    for_it = extreme(found, "waiting-time", US, "total", (3.0, 6.0), ONE)
    assert for_it.value == pytest.approx(1.2, abs=0.25)
    assert extreme(found, "waiting-time", US, "total", (3.0, 6.0), TWO).value == 0.0


def test_the_closest_approach_to_somebody_or_to_anybody() -> None:
    beside = over("lowest", "distance")
    assert (beside.to, beside.value, beside.extreme, beside.until) == (TWO, 7.2, "lowest", 10.0)
    assert over("lowest", "distance", to=TWO).value == 7.2
    ahead = over("lowest", "distance", to=ONE)
    assert ahead.value == pytest.approx(43.2, abs=0.2)
    assert over("lowest", "distance", 7.0, 8.0, to=TWO).gap == "out-of-view"
    mutual = over("lowest", "distance", thing=ONE, to=TWO)
    assert mutual.value == pytest.approx(math.hypot(50.2, 7.2), abs=0.01)
    assert over("lowest", "distance", thing=TWO).value == 7.2


@pytest.mark.parametrize(
    ("attribute", "begin", "end", "thing", "gap"),
    [
        ("speed", 11.0, 12.0, US, "in-future"),
        ("speed", -4.0, -2.0, US, "before-record"),
        ("speed", 7.0, 8.0, TWO, "out-of-view"),
        ("excess", 7.0, 8.0, ONE, "not-recorded"),
        ("time-to-collision", 7.0, 8.0, US, "not-applicable"),
        ("gap", 4.0, 8.0, TWO, "not-applicable"),
    ],
)
def test_why_there_is_no_extreme(
    attribute: Attribute, begin: float, end: float, thing: Thing, gap: str
) -> None:
    assert over("highest", attribute, begin, end, thing).gap == gap


def test_the_first_value_of_what_is_gone_has_a_reason() -> None:
    assert over("first", "gap", 7.0, 8.0, Vehicle(2)).gap == "out-of-view"
    assert over("last", "lane", 7.0, 8.0, ONE).gap == "not-applicable"


def test_why_there_is_no_value_is_looked_for_in_the_middle_too() -> None:
    """The second is in view from 3 to 6 s alone, and beside us then: it has no gap to us."""
    assert over("highest", "gap", to=TWO).gap == "not-applicable"
    assert over("highest", "gap", begin=0.0, end=1.0, to=TWO).gap == "out-of-view"
