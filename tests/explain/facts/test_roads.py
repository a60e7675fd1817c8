"""How far places are, and what the road is like."""

import math

import pytest

from planner.record.places import PriorityFact, RoadFacts, RoadPlace, RouteStep
from tests.explain.facts.scenes import Actor, Path_, made, straight
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import Destination, Ego, Exit, Junction, Thing, Vehicle
from xavi_dialogue.domain.vocabulary import Attribute
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


def roads(time: float) -> RoadFacts:
    """A junction at 100 m and a roundabout at 200 m from where we are at 0 s."""
    way = 10.0 * time
    return RoadFacts(
        {0: RoadPlace("main", 1, 3, 14.0, False, False)},
        (
            RouteStep(100.0 - way, "junction", "exit-right", None, None, 4, "equal"),
            RouteStep(200.0 - way, "roundabout", "exit-left", 2, 4, 4, "give-way"),
        ),
        300.0 - way,
        30.0 - time,
        (PriorityFact(1, "ego"), PriorityFact(2, "vehicle"), PriorityFact(3, "depends")),
    )


AHEAD = States(made({0: Actor(straight(0.0, 0.0, 10.0))}, 4.0, roads=roads, now=4.0))


@pytest.mark.parametrize(
    ("to", "at", "metres"),
    [
        (Destination(), 4.0, 260.0),
        (Destination(), 3.5, 265.0),  # half a second since the decision
        (Junction(), 4.0, 60.0),
        (Junction(rank=1), 4.0, 60.0),
        (Junction(rank=2), 4.0, 160.0),
        (Junction(rank=3), 4.0, None),
        (Junction(rank=-1), 4.0, None),
        (Junction("roundabout"), 4.0, 160.0),
        (Junction("roundabout", 2), 4.0, None),
        (Exit(), 4.0, 60.0),
    ],
)
def test_how_far_a_place_is(to: Thing, at: float, metres: float | None) -> None:
    assert of(AHEAD, "distance", to=to, at=at).value == metres
    assert of(AHEAD, "distance", to, at=at).value == metres


def test_why_a_distance_to_a_place_is_not_known() -> None:
    assert of(AHEAD, "distance", to=Junction(rank=3)).gap == "not-applicable"
    assert of(AHEAD, "distance", to=Junction(rank=-1)).gap == "not-recorded"
    assert of(states(), "distance", to=Destination()).gap == "not-recorded"
    bare = States(made({0: Actor(straight(0.0, 0.0, 10.0))}, 4.0, roads=lambda _: RoadFacts({})))
    assert of(bare, "distance", to=Destination()).gap == "no-way"
    assert of(bare, "distance", to=Exit()).gap == "not-recorded"
    late = made(
        {0: Actor(straight(0.0, 0.0, 10.0))}, 9.0, roads=lambda t: roads(t) if t <= 4 else None
    )
    assert of(States(late), "distance", to=Destination(), at=9.0).gap == "not-recorded"


def test_what_was_passed_is_no_way_off() -> None:
    near = RoadFacts({}, (RouteStep(3.0, "junction", "exit-right", None, None, 4, "equal"),))
    found = States(made({0: Actor(straight(0.0, 0.0, 10.0))}, 4.0, roads=lambda _: near))
    assert of(found, "distance", to=Junction(), at=3.9).value == 0.0
    assert of(found, "right-of-way", at=3.9).value == 0.0
    assert of(found, "turn", at=3.9).value == 0.0


def test_the_road() -> None:
    lane = of(AHEAD, "lane")
    assert (lane.value, lane.word, lane.count, lane.side) == (2.0, "middle", 3, None)
    assert of(AHEAD, "lane-count").value == 3.0
    assert of(AHEAD, "route").value == 2.0
    assert of(AHEAD, "limit").value == 14.0
    exit_ = of(AHEAD, "exit-number")
    assert (exit_.value, exit_.count) == (2.0, 4)
    turn = of(AHEAD, "turn")
    assert (turn.word, turn.side, turn.rule, turn.value, turn.count) == (
        "exit-right",
        "right",
        "equal",
        60.0,
        None,
    )
    none = states()
    for attribute in ("lane", "lane-count", "route", "limit", "exit-number", "turn"):
        assert of(none, attribute).gap == "not-recorded"


@pytest.mark.parametrize(
    ("lane", "lanes", "word", "side"),
    [
        (0, 1, "only", None),
        (0, 3, "right", "right"),
        (1, 3, "middle", None),
        (1, 4, None, None),
        (2, 4, None, None),
        (2, 3, "left", "left"),
    ],
)
def test_a_lane_has_a_word(lane: int, lanes: int, word: str, side: str | None) -> None:
    place = RoadPlace("main", lane, lanes, 14.0, False, False)
    actors = {0: Actor(straight(0.0, 0.0, 10.0))}
    found = of(States(made(actors, 4.0, roads=lambda _: RoadFacts({0: place}))), "lane")
    assert (found.value, found.word, found.side) == (lane + 1.0, word, side)
    inside = RoadPlace("main", None, lanes, 14.0, True, False)
    found = of(States(made(actors, 4.0, roads=lambda _: RoadFacts({0: inside}))), "lane")
    assert (found.gap, found.count) == ("not-applicable", lanes)


@pytest.mark.parametrize(
    ("thing", "to", "word", "rule"),
    [
        (Ego(), Vehicle(1), "ego", "priority"),
        (Vehicle(1), None, "ego", "give-way"),
        (Ego(), Vehicle(2), "vehicle", "give-way"),
        (Vehicle(2), None, "vehicle", "priority"),
        (Vehicle(3), None, "depends", "depends"),
        (Vehicle(4), None, None, None),
        (Ego(), None, "equal", "equal"),
        (Ego(), Junction(rank=2), "give-way", "give-way"),
        (Ego(), Junction("roundabout"), "give-way", "give-way"),
        (Ego(), Junction(rank=3), None, None),
        (Ego(), Junction(rank=0), None, None),
    ],
)
def test_who_goes_first(thing: Thing, to: Thing | None, word: str | None, rule: str | None) -> None:
    actors = {v: Actor(straight(0.0, 9.0 * v, 10.0)) for v in range(5)}
    found = of(States(made(actors, 4.0, roads=roads)), "right-of-way", thing, to)
    assert (found.word, found.rule) == (word, rule)
    assert found.gap == ("not-applicable" if word is None else None)
    assert of(States(made(actors, 4.0)), "right-of-way", thing, to).gap == "not-recorded"
