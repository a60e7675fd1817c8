"""What an indicator announces, and what brought somebody behind us."""

import pytest
from msgspec.structs import replace

from planner.record.places import RoadFacts, RoadPlace, RouteStep
from tests.explain.facts.scenes import Actor, made, shifted, straight
from tests.traces import Aim, Way
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.domain.vocabulary import Side
from xavi_dialogue.explain.causes.vehicles.announced import announced, meeting
from xavi_dialogue.explain.facts.world import World


def roads(lanes: int, distance: float, edge: str = "a", ring: bool = False) -> RoadFacts:
    there = RoadPlace(edge, 0, lanes, 14.0, False, ring)
    mine = RoadPlace("a", 0, lanes, 14.0, False, False)
    step = RouteStep(distance, "junction", "exit-left", None, None, 4, "equal")
    return RoadFacts({0: mine, 1: there}, (step,))


SIGNAL = Episode(Vehicle(1), "signal", 3.0, None, side="left")


@pytest.mark.parametrize(
    ("road", "side", "aims"),
    [
        (roads(2, 100.0), "left", ("change-left", "exit-left")),
        (roads(2, 100.1), "left", ("change-left",)),
        (roads(1, 100.1), "left", ("exit-left",)),
        (roads(2, 300.0, "other"), "left", ("change-left", "exit-left")),
        (roads(2, 90.0), "right", ("change-right", "exit-right")),
        (roads(2, 90.0, ring=True), "right", ("leave",)),
        (roads(2, 90.0, ring=True), "left", ("change-left", "exit-left")),
        (None, "left", ("change-left", "exit-left")),
    ],
)
def test_what_an_indicator_may_announce(
    road: RoadFacts | None, side: Side, aims: tuple[str, ...]
) -> None:
    actors = {0: Actor(straight(0.0, 0.0, 5.0)), 1: Actor(straight(30.0, 0.0, 5.0))}
    whole = made(actors, 6.0, roads=lambda _: road)
    found = announced(whole, World(whole), 1, replace(SIGNAL, side=side), 6.0)
    assert found is not None
    assert (found.vehicle, found.aims, found.probability, found.came) == (1, aims, 0.0, None)
    assert announced(whole, World(whole), 1, replace(SIGNAL, side=None), 6.0) is None
    assert announced(whole, World(whole), 1, replace(SIGNAL, side="straight"), 6.0) is None


@pytest.mark.parametrize(("chance", "aims"), [(0.1, ("exit-left",)), (0.09, ())])
def test_what_is_thought_possible_is_announced(chance: float, aims: tuple[str, ...]) -> None:
    """One lane and no junction near: what is left is what it was thought to do."""
    known = (
        Aim("exit-left", chance, (Way(("exit-left",)),)),
        Aim("continue", 1.0 - chance, (Way(("continue",)),)),
    )
    actors = {0: Actor(straight(0.0, 0.0, 5.0)), 1: Actor(straight(30.0, 0.0, 5.0), aims=known)}
    whole = made(actors, 6.0, roads=lambda _: roads(2, 300.0))
    found = announced(whole, World(whole), 1, SIGNAL, 6.0)
    assert found is not None
    assert found.aims == ("change-left", *aims)
    assert found.probability == pytest.approx(chance)


@pytest.mark.parametrize(
    ("begin", "came"), [(3.0, True), (0.5, True), (5.0, False), (-14.0, True), (-16.0, False)]
)
def test_what_came_of_an_indicator(begin: float, came: bool) -> None:
    """The lane change begins some time after 3.5 s; one second early and 15 s late still count."""
    actors = {
        0: Actor(straight(0.0, 9.0, 5.0)),
        1: Actor(shifted(straight(30.0, 0.0, 10.0), 3.0, 5.0, 3.5)),
    }
    whole = made(actors, 8.0)
    (change,) = World(whole).episodes(1, "change-left")
    signal = replace(SIGNAL, begin=begin + change.begin if begin < 0.0 else begin)
    found = announced(whole, World(whole), 1, signal, 8.0)
    assert found is not None
    assert found.came == (change if came else None)


def test_what_brought_somebody_behind_us() -> None:
    actors = {
        0: Actor(straight(0.0, 0.0, 12.0)),
        1: Actor(straight(20.0, 3.5, 8.0)),
        2: Actor(straight(-30.0, 3.5, 18.0)),
    }
    whole = made(actors, 9.0)
    world = World(whole)
    (ours,) = world.episodes(Ego(), "overtake")
    (theirs,) = world.episodes(2, "overtake")
    assert meeting(world, 1, "behind", 9.0) == ours
    assert meeting(world, 1, "ahead-of", 9.0) is None
    assert meeting(world, 2, "ahead-of", 9.0) == theirs
    assert meeting(world, 2, "behind", 9.0) is None
    assert meeting(world, 2, "ahead-of", 1.0) is None
    assert meeting(world, 1, "near", 9.0) is None
