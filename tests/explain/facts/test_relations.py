"""Relations of two vehicles at a time, each as it follows from where they are."""

import math
from collections.abc import Mapping

import pytest

from planner.record.places import PriorityFact, RoadFacts, RoadPlace
from planner.record.trace import HeldUp
from tests.explain.facts.scenes import Actor, made, straight
from tests.traces import Aim, Way
from xavi_dialogue.domain.terms import (
    Ego,
    Exit,
    Junction,
    Lane,
    Nobody,
    Road,
    Thing,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.domain.vocabulary import Relation
from xavi_dialogue.explain.facts.relations import holds
from xavi_dialogue.explain.facts.states import States

ONE, TWO = Vehicle(1), Vehicle(2)


def there(ahead: float, left: float, turn: float = 0.0, speed: float = 0.0) -> Actor:
    """Somebody whose middle is there, seen from the middle of our car; the turn in degrees."""
    heading = math.radians(turn)
    x, y = ahead + 2.4 * math.cos(heading), left + 2.4 * math.sin(heading)
    return Actor(straight(x, y, speed, heading))


def states(*others: Actor, speed: float = 0.0, until: float = 0.0) -> States:
    ours = Actor(straight(2.4, 0.0, speed))
    return States(made(dict(enumerate((ours, *others))), until))


@pytest.mark.parametrize(
    ("relation", "ahead", "left", "turn", "told"),
    [
        ("ahead-of", 10.0, 12.0, 0.0, True),
        ("ahead-of", 10.0, -12.0, 0.0, True),
        ("ahead-of", 10.0, 12.1, 0.0, False),
        ("ahead-of", 40.0, 19.9, 0.0, True),  # the road may bend
        ("ahead-of", 40.0, 20.1, 0.0, False),
        ("ahead-of", -10.0, 0.0, 0.0, False),
        ("ahead-of", 0.5, 0.0, 0.0, True),
        ("ahead-of", 4.7, 3.0, 0.0, False),  # in a lane beside us
        ("ahead-of", 4.9, 3.0, 0.0, True),
        ("ahead-of", 4.7, 1.9, 0.0, True),
        ("ahead-of", 4.7, 3.0, 180.0, True),
        ("behind", -10.0, 12.0, 0.0, True),
        ("behind", -10.0, -12.1, 0.0, False),
        ("behind", -40.0, 19.9, 0.0, True),
        ("behind", -40.0, 20.1, 0.0, False),
        ("behind", 10.0, 0.0, 0.0, False),
        ("behind", -0.5, 0.0, 0.0, True),
        ("behind", -4.7, -3.0, 0.0, False),
        ("behind", -4.9, -3.0, 0.0, True),
        ("behind", -4.7, -1.9, 0.0, True),
        ("left-of", 0.0, 2.1, 0.0, True),
        ("left-of", 0.0, 1.9, 0.0, False),
        ("left-of", 0.0, -2.1, 0.0, False),
        ("right-of", 0.0, -2.1, 0.0, True),
        ("right-of", 0.0, -1.9, 0.0, False),
        ("right-of", 0.0, 2.1, 0.0, False),
        ("beside", 4.7, 3.0, 0.0, True),
        ("beside", -4.7, -3.0, 0.0, True),
        ("beside", 4.9, 3.0, 0.0, False),
        ("beside", 0.0, 1.9, 0.0, False),
        ("beside", 0.0, 12.0, 0.0, True),
        ("beside", 0.0, 12.1, 0.0, False),
        ("near", 19.7, 0.0, 0.0, True),
        ("near", 19.9, 0.0, 0.0, False),
        ("closer-than", -19.7, 0.0, 0.0, True),
        ("oncoming-to", 30.0, 3.0, 180.0, True),
        ("oncoming-to", 30.0, 3.0, 0.0, False),
        ("oncoming-to", -30.0, 3.0, 180.0, False),
    ],
)
def test_where_the_first_is_seen_from_the_second(
    relation: Relation, ahead: float, left: float, turn: float, told: bool
) -> None:
    found = states(there(ahead, left, turn))
    assert holds(found, relation, ONE, Ego(), 0.0) is told
    assert holds(found, relation, Vehicles((1,)), Ego(), 0.0) is told
    assert holds(found, relation, ONE, TWO, 0.0) is None


@pytest.mark.parametrize(
    ("ours", "theirs", "faster", "slower"),
    [(10.0, 10.1, False, False), (10.0, 10.2, True, False), (10.2, 10.0, False, True)],
)
def test_who_is_faster_as_speeds_are_told(
    ours: float, theirs: float, faster: bool, slower: bool
) -> None:
    """36 km/h both, or 36 and 37."""
    found = states(there(30.0, 0.0, speed=theirs), speed=ours)
    assert holds(found, "faster-than", ONE, Ego(), 0.0) is faster
    assert holds(found, "slower-than", ONE, Ego(), 0.0) is slower
    assert holds(found, "slower-than", Ego(), ONE, 0.0) is faster
    assert holds(found, "faster-than", ONE, TWO, 0.0) is None
    assert holds(found, "faster-than", TWO, ONE, 0.0) is None
    assert holds(found, "near", TWO, ONE, 0.0) is None


def test_who_is_who() -> None:
    found = states(there(30.0, 0.0), there(60.0, 0.0))
    assert holds(found, "same-as", ONE, Vehicles((1,)), 0.0) is True
    assert holds(found, "same-as", ONE, TWO, 0.0) is False
    assert holds(found, "same-as", Ego(), Ego(), 0.0) is True
    assert holds(found, "same-as", ONE, Nobody(), 0.0) is None
    assert holds(found, "ahead-of", Vehicles((1, 2)), Ego(), 0.0) is None
    assert holds(found, "ahead-of", Ego(), Vehicles((1, 2)), 0.0) is None
    assert holds(found, "ahead-of", TWO, ONE, 0.0) is True


PRIORITY = (PriorityFact(1, "ego"), PriorityFact(2, "vehicle"), PriorityFact(3, "depends"))


@pytest.mark.parametrize(
    ("one", "other", "told"),
    [
        (Ego(), Vehicle(1), True),
        (Vehicle(1), Ego(), False),
        (Ego(), Vehicle(2), False),
        (Vehicle(2), Ego(), True),
        (Ego(), Vehicle(3), None),
        (Vehicle(4), Ego(), None),
        (Vehicle(1), Vehicle(2), None),
        (Ego(), Ego(), None),
    ],
)
def test_who_goes_first(one: Thing, other: Thing, told: bool | None) -> None:
    actors = {v: there(10.0 * v, 0.0) for v in range(5)}
    found = States(made(actors, 0.0, roads=lambda _: RoadFacts({}, priority=PRIORITY)))
    assert holds(found, "has-priority-over", one, other, 0.0) is told
    assert holds(found, "must-yield-to", other, one, 0.0) is told
    assert holds(States(made(actors, 0.0)), "has-priority-over", one, other, 0.0) is None


def test_who_is_seen() -> None:
    found = states(there(30.0, 0.0), Actor(straight(50.0, 0.0, 0.0), hidden=(1.0, 3.0)), until=3.0)
    assert holds(found, "can-see", Ego(), ONE, 2.0) is True
    assert holds(found, "can-see", Ego(), TWO, 2.0) is False
    assert holds(found, "can-see", ONE, Ego(), 2.0) is None


def test_who_waits_for_whom() -> None:
    """The second stands and is predicted to wait for us; the third stands, nobody knows why."""
    for_us = HeldUp(0, 0.0, 30.0, "right-of-way", 9.0, 9.0)
    waits = (Aim("exit-left", 1.0, (Way(("exit-left",), held_up=(for_us,)),)),)
    found = states(
        there(30.0, 60.0, speed=5.0),
        Actor(straight(90.0, 20.0, 0.0, -math.pi / 2.0), aims=waits),
        there(60.0, -30.0, 90.0),
        speed=8.0,
        until=4.0,
    )
    assert holds(found, "waiting-for", TWO, Ego(), 3.0) is True
    assert holds(found, "waiting-for", TWO, ONE, 3.0) is False
    assert holds(found, "waiting-for", ONE, Ego(), 3.0) is False
    assert holds(found, "waiting-for", Vehicle(3), Ego(), 3.0) is None
    assert holds(found, "waiting-for", Ego(), ONE, 3.0) is False
    assert holds(found, "waiting-for", Vehicle(7), Ego(), 3.0) is None
    assert holds(found, "in-the-way-of", Ego(), TWO, 3.0) is True
    assert holds(found, "in-the-way-of", ONE, TWO, 3.0) is False
    assert holds(found, "in-the-way-of", TWO, Ego(), 3.0) is False
    assert holds(found, "in-the-way-of", Ego(), TWO, -1.0) is None


def place(edge: str, lane: int | None, lanes: int = 3, ring: bool = False) -> RoadPlace:
    return RoadPlace(edge, lane, lanes, 14.0, lane is None, ring)


def on(places: Mapping[int, RoadPlace], until: float = 0.0) -> States:
    actors = {v: there(40.0 * v, 40.0 * v) for v in range(4)}
    return States(made(actors, until, roads=lambda _: RoadFacts(dict(places))))


@pytest.mark.parametrize(
    ("mine", "theirs", "lane", "told"),
    [
        (place("a", 1), place("a", 1), Lane(), True),
        (place("a", 1), place("a", 2), Lane(), False),
        (place("a", 1), place("b", 1), Lane(), False),
        (place("a", 1), place("a", 2), Lane("left"), True),
        (place("a", 1), place("a", 1), Lane("left"), False),
        (place("a", 1), place("b", 2), Lane("left"), False),
        (place("a", 1), place("a", 0), Lane("right"), True),
        (place("a", 1), place("a", 1), Lane("right"), False),
        (place("a", 1), place("b", 0), Lane("right"), False),
        (place("a", 1), place("a", 0), Lane("rightmost"), True),
        (place("a", 1), place("a", 1), Lane("rightmost"), False),
        (place("a", 1), place("b", 2), Lane("leftmost"), True),
        (place("a", 1), place("a", 1), Lane("leftmost"), False),
        (place("a", 1), place("a", 2), Lane("other"), True),
        (place("a", 1), place("b", 1), Lane("other"), True),
        (place("a", 1), place("a", 1), Lane("other"), False),
        (place("a", 1), place("a", 1), Lane("any"), None),
        (place("a", 1), place("a", None), Lane(), None),
        (place("a", None), place("a", 1), Lane(), None),
        (place("a", 1), place("a", 1), Exit(), None),
        (place("a", 1), place("a", 2), Road(), True),
        (place("a", 1), place("b", 2), Road(), False),
        (place("a", 1), place("a", 2), Road("side"), None),
        (place("a", 1), place("a", None), Junction(), True),
        (place("a", 1), place("a", 1), Junction(), False),
        (place("a", 1), place("a", 1, ring=True), Junction("roundabout"), True),
        (place("a", 1), place("a", None), Junction("roundabout"), False),
    ],
)
def test_what_somebody_is_on(
    mine: RoadPlace, theirs: RoadPlace, lane: Thing, told: bool | None
) -> None:
    assert holds(on({0: mine, 1: theirs}), "on", ONE, lane, 0.0) is told


def test_what_we_are_on() -> None:
    for lane, left, right in ((0, False, True), (1, False, False), (2, True, False)):
        found = on({0: place("a", lane)})
        assert holds(found, "on", Ego(), Lane("left"), 0.0) is left
        assert holds(found, "on", Ego(), Lane("right"), 0.0) is right
    assert holds(on({0: place("a", 1)}), "on", ONE, Lane(), 0.0) is None
    assert holds(on({1: place("a", 1)}), "on", ONE, Lane(), 0.0) is None
    assert holds(on({1: place("a", 1)}), "on", ONE, Road(), 0.0) is None
    assert holds(on({0: place("a", 1)}), "on", Nobody(), Lane(), 0.0) is None


def test_a_lane_may_be_that_of_somebody_else() -> None:
    found = on({0: place("a", 0), 1: place("a", 2), 2: place("a", 2), 3: place("a", None)})
    assert holds(found, "on", ONE, Lane("own", TWO), 0.0) is True
    assert holds(found, "on", Ego(), Lane("own", TWO), 0.0) is False
    assert holds(found, "on", ONE, Lane("own", Ego()), 0.0) is False
    assert holds(found, "on", ONE, Lane("own", Vehicle(3)), 0.0) is None


@pytest.mark.parametrize(
    ("mine", "theirs", "told"),
    [
        (place("a", 0), place("a", 2), True),
        (place("a", 0), place("b", 0), False),
        (place("a", 0, ring=True), place("b", 0, ring=True), True),
        (place("a", 0, ring=True), place("b", 0), False),
    ],
)
def test_who_drives_along_with_us(mine: RoadPlace, theirs: RoadPlace, told: bool) -> None:
    found = on({0: mine, 1: theirs})
    assert holds(found, "with", ONE, Ego(), 0.0) is told
    assert holds(found, "with", Ego(), ONE, 0.0) is told


def test_who_drives_behind_us_drives_with_us() -> None:
    """The first follows at 10 m; the second is not on our line, and the third has left."""
    found = states(
        there(-15.0, 0.0, speed=8.0),
        there(30.0, 30.0, speed=8.0),
        Actor(straight(20.0, 0.0, 8.0), until=4.0),
        speed=8.0,
        until=8.0,
    )
    assert holds(found, "with", ONE, Ego(), 7.0) is True
    assert holds(found, "with", Ego(), ONE, 7.0) is True
    assert holds(found, "with", TWO, Ego(), 7.0) is False
    assert holds(found, "with", Vehicle(3), Ego(), 3.0) is True
    assert holds(found, "with", Vehicle(3), Ego(), 7.0) is False
    assert holds(found, "with", ONE, TWO, 7.0) is None
    assert holds(on({1: place("a", 0), 2: place("a", 1)}), "with", ONE, TWO, 0.0) is True
