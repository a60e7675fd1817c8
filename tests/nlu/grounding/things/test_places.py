"""Places: which junction, lane or exit is meant."""

import pytest

from tests.nlu.grounding.fakes import Car, FakeWorld, asked, did, question_of, road
from xavi_dialogue.domain.meaning import Where, Whether
from xavi_dialogue.domain.terms import (
    Between,
    Described,
    Ego,
    Event,
    Exit,
    Happens,
    Junction,
    Lane,
    Related,
    Thing,
    Vehicle,
)

CROSS, RING = Junction("junction", time=5.0), Junction("roundabout", time=12.0)
RIDE = FakeWorld(
    {1: Car(20.0, colour="red")},
    (
        did("exit-left", 5.0, 8.0, place=CROSS, side="left"),
        did("enter", 12.0, 12.0, place=RING),
        did("leave", 16.0, 16.0, place=RING),
    ),
    now=30.0,
    facts=road("junction", "roundabout", "junction"),
)


def entered(place: Thing, tense: str = "past") -> Thing | None:
    event = Event("enter", object=place, tense=tense)  # type: ignore[arg-type]
    found = question_of(asked(Whether(Happens(event)), RIDE))
    return found.that.event.object  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("place", "tense", "meant"),
    [
        (Junction("roundabout"), "past", RING),
        (Junction("junction"), "past", CROSS),
        (Junction("junction", rank=-1), "past", Junction("junction", -1, 5.0)),
        (Junction("junction"), "future", Junction("junction", 1)),
        (Junction("roundabout"), "future", Junction("roundabout", 1)),
        (Junction("junction", rank=2), "future", Junction("junction", 2)),
        (Exit(2), "future", Exit(2)),
        (Lane("left"), "past", Lane("left")),
    ],
)
def test_a_place_is_the_one_meant(place: Thing, tense: str, meant: Thing) -> None:
    assert entered(place, tense) == meant


def test_this_roundabout_is_the_one_we_are_on() -> None:
    world = FakeWorld({}, RIDE.happened[:2], now=14.0, facts=road(roundabout=True))
    found = question_of(asked(Where(Junction("roundabout", rank=1)), world))
    assert found.of.time == 12.0  # type: ignore[union-attr]


def test_a_roundabout_may_be_called_a_junction() -> None:
    world = FakeWorld(facts=road("roundabout"))
    found = question_of(asked(Where(Junction("junction")), world))
    assert found.of == Junction("roundabout", 1)  # type: ignore[union-attr]


def test_a_lane_may_be_somebody_s() -> None:
    on = Related("on", Ego(), Lane("own", of=Described(colour="red")))
    found = question_of(asked(Whether(on), RIDE))
    assert found.that.to == Lane("own", of=Vehicle(1))  # type: ignore[union-attr]


def counted(rank: int) -> object:
    """When we slowed down at a junction that is counted."""
    world = FakeWorld(
        happened=(
            did("slow-down", 3.0, 5.0),
            did("exit-left", 5.0, 8.0, place=CROSS, side="left"),
            did("slow-down", 18.0, 20.0),
            did("exit-right", 20.0, 22.0, place=Junction(time=20.0), side="right"),
        ),
        now=40.0,
        facts=road("junction", "junction"),
    )
    event = Event("slow-down", object=Junction(rank=rank), tense="past")
    found = asked(Whether(Happens(event)), world)
    return question_of(found).that.event.time  # type: ignore[union-attr]


def test_junctions_that_are_past_are_counted_from_the_beginning() -> None:
    assert counted(1) == Between(3.0, 5.0)
    assert counted(2) == Between(18.0, 20.0)
