"""How much something was at most, at least, or in an event; asked at 20 s."""

from typing import Any

import pytest

from tests.explain.answers.propositions.test_measures_told import (
    IT,
    NO_VALUE,
    OTHER,
    US,
    brief,
    much,
    setting,
)
from tests.explain.answers.stated import did, roads, step, they
from xavi_dialogue.domain.answers import DidNotHappen
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import HowMuch
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Event,
    Everyone,
    Junction,
    Lane,
    Measured,
    WholeRide,
)
from xavi_dialogue.explain.answers.propositions import measures as room
from xavi_dialogue.explain.answers.reference.moments import Window


@pytest.mark.parametrize(
    ("of", "which", "found"),
    [
        (Measured("speed"), "highest", ("speed", US, None, 20.0, 20.0)),
        (Measured("speed"), "lowest", ("speed", US, None, 0.0, 0.0)),
        (Measured("speed"), "mean", ("speed", US, None, 20.0, 10.0)),
        (Measured("speed", time=Between(4.0, 8.0)), "highest", ("speed", US, None, 8.0, 8.0)),
        (Measured("speed", time=At(8.0)), "highest", ("speed", US, None, 20.0, 20.0)),
        (Measured("jerk"), "lowest", ("jerk", US, None, 20.0, 20.0)),
        (Measured("distance", IT), "lowest", ("distance", US, IT, 20.0, 30.0)),
        (Measured("distance", IT), "highest", ("distance", US, IT, 0.0, 50.0)),
        (Measured("distance"), "lowest", ("distance", US, OTHER, 12.0, 5.0)),
        (Measured("distance"), "highest", ("distance", US, IT, 0.0, 50.0)),
        (Measured("distance", US, IT), "lowest", ("distance", US, IT, 20.0, 30.0)),
        (Measured("gap", US, IT), "lowest", ("distance", US, IT, 20.0, 30.0)),
        (Measured("gap", US, IT), "highest", ("distance", US, IT, 0.0, 50.0)),
        (Measured("gap", US, OTHER), "highest", ("gap", US, OTHER, 20.0, 20.0)),
        (Measured("gap", US, OTHER), "lowest", ("distance", US, OTHER, 12.0, 5.0)),
        (Measured("headway", US, OTHER), "lowest", ("headway", US, OTHER, 0.0, 2.0)),
        (Measured("gap", US, Lane()), "lowest", ("gap", US, Lane(), 0.0, None)),
    ],
)
def test_an_extreme_is_of_the_stretch(of: Measured, which: Any, found: Any) -> None:
    values = {
        ("speed", 0): lambda t: t,
        ("jerk", 0): lambda t: t,
        ("distance", 0, 1): lambda t: 50.0 - t,
        ("distance", 0, 2): lambda t: 5.0 + abs(12.0 - t),
        ("headway", 0, 2): lambda t: 2.0 + t,
        ("gap", 0, 1): NO_VALUE,
        ("gap", 0, 2): lambda t: t,
    }
    assert brief(much(of, which, values=values)) == [found]


def test_nothing_is_nearest_where_nobody_is() -> None:
    (found,) = much(Measured("distance"), "lowest", looks={}).measures
    assert found == Measure("distance", US, 20.0, gap="not-applicable")
    (alone,) = much(Measured("gap"), "lowest", on_our_way=()).measures
    assert alone == Measure("gap", US, 20.0, gap="not-applicable")


def test_of_several_only_those_with_a_value_are_told() -> None:
    speeds = {("speed", 2): lambda t: t}
    assert brief(much(Measured("speed", Everyone()), "highest", values=speeds)) == [
        ("speed", OTHER, None, 20.0, 20.0)
    ]
    none = much(Measured("speed", Everyone()), "highest")
    assert [(m.thing, m.gap) for m in none.measures] == [
        (IT, "not-recorded"),
        (OTHER, "not-recorded"),
    ]


@pytest.mark.parametrize(
    ("stretch", "until"),
    [
        (Between(4.0, 20.0), 20.0),
        (Between(0.7, 20.0), 20.0),
        (Between(0.0, 19.3), 19.3),
        (Between(0.4, 19.6), None),
        (WholeRide(), None),
    ],
)
def test_of_a_part_of_the_ride_it_is_told_up_to_when(stretch: Any, until: Any) -> None:
    asked, of = setting(), Measured("speed", IT, time=stretch)
    asked.world.extreme = lambda name, thing, which, *_: Measure(name, thing, 9.0, value=3.0)
    (found,) = room.how_much(HowMuch(of, "highest"), asked).measures  # type: ignore[union-attr]
    assert found.until == until
    asked.world.extreme = lambda name, thing, *_: Measure(name, thing, 9.0, value=3.0, until=11.0)
    (kept,) = room.how_much(HowMuch(of, "highest"), asked).measures  # type: ignore[union-attr]
    assert kept.until == 11.0


@pytest.mark.parametrize(
    ("of", "which", "place"),
    [
        (Measured("speed"), "highest", True),
        (Measured("speed"), "lowest", True),
        (Measured("deceleration"), "highest", True),
        (Measured("speed"), "mean", False),
        (Measured("speed", IT), "highest", False),
        (Measured("jerk"), "highest", False),
    ],
)
def test_where_we_were_fastest_is_told_by_the_junction(
    of: Measured, which: Any, place: bool
) -> None:
    values: dict[Any, Any] = {
        (name, n): lambda t: 5.0 - abs(t - 8.0)
        for name in ("speed", "deceleration", "jerk")
        for n in (0, 1)
    }
    values[("distance", 0)] = 60.0
    route = roads(route=(step(kind="roundabout"), step(90.0)))
    found = much(of, which, values=values, road=route).measures
    assert len(found) == (2 if place else 1)
    if place:
        then = found[0].time
        assert found[1] == Measure(
            "distance", US, then, value=60.0, to=Junction("roundabout", 1, then)
        )
    assert len(much(of, which, values=values, road=roads()).measures) == 1
    assert len(much(of, which, values=values).measures) == 1


# Of an event ------------------------------------------------------------------------------------

BRAKES, BRIEF = did("brake", 5.0, 9.0, peak=3.5), did("stop", 12.0, 13.0)


@pytest.mark.parametrize(
    ("of", "which", "found"),
    [
        (Measured("deceleration", event=Event("brake")), None, (5.0, 3.5)),
        (Measured("deceleration", event=Event("stop")), None, (12.0, 0.5)),
        (Measured("speed", event=Event("brake")), "highest", (9.0, 9.0)),
        (Measured("speed", event=Event("brake")), None, (5.0, 7.0)),
        (Measured("speed", event=Event("stop")), None, (12.0, 12.0)),
        (Measured("limit", event=Event("brake")), None, (5.0, 13.0)),
    ],
)
def test_a_measure_of_an_event_is_of_its_stretch(of: Measured, which: Any, found: Any) -> None:
    values = {("speed", 0): lambda t: t, ("limit", 0): 13.0, ("deceleration", 0): 0.5}
    told = much(of, which, episodes=(BRAKES, BRIEF), values=values)
    assert [(m.time, m.value) for m in told.measures] == [found]
    assert all(m.thing == US for m in told.measures)


def test_a_measure_of_an_event_is_of_its_actor_or_who_is_named() -> None:
    theirs = they(1, "brake", 5.0, 9.0)
    values: dict[Any, Any] = {("speed", n): lambda t, n=n: t + n for n in (0, 1, 2)}
    event = Event("brake", IT)
    for thing, who in ((US, IT), (OTHER, OTHER)):
        of = Measured("speed", thing, event=event)
        (found,) = much(of, "highest", episodes=(theirs,), values=values).measures
        assert (found.thing, found.value) == (who, 9.0 + who.number)
    assert isinstance(much(Measured("speed", event=Event("stop"))), DidNotHappen)
    hard = much(Measured("deceleration", event=Event("brake")), episodes=(BRAKES,)).measures
    assert (hard[0].until, hard[0].extreme) == (9.0, "highest")


def test_one_value_is_enough_to_compare() -> None:
    asked = setting(values={("speed", 1): 4.0, ("speed", 2): 5.0})
    best = room.best_of(asked, Measured("speed", Everyone()), 20.0)
    assert best == Measure("speed", IT, 20.0, value=4.0)
    assert room._nearest(asked, "speed", IT, "highest", Window(4.0, 8.0), None).value == 4.0
