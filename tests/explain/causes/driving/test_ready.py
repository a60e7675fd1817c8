"""What we slowed down for though we did not come to it."""

import math
from collections.abc import Sequence
from dataclasses import replace

import pytest
from msgspec import structs

from planner.record.events import Event as Told
from planner.record.places import PriorityFact, RoadFacts, RoadPlace, RouteStep
from planner.record.trace import HeldUp
from tests.explain.causes.decisions import Driven, in_the_way
from tests.explain.facts.scenes import Actor, straight
from tests.traces import Actions
from xavi_dialogue.domain.answers import MotionCause
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego
from xavi_dialogue.explain.causes.driving.driving import reasons_for
from xavi_dialogue.explain.causes.driving.ready import given_up, next_move, ready_for
from xavi_dialogue.explain.causes.driving.slowness import Slowness, slowness
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.ride import Ride

OURS = Actor(straight(0.0, 0.0, 10.0))


AHEAD = Actor(straight(30.0, 0.0, 10.0))


def road(limit: float = 14.0, *steps: RouteStep, first: Sequence[int] = ()) -> RoadFacts:
    rules = tuple(PriorityFact(v, "vehicle") for v in first)
    return RoadFacts({0: RoadPlace("a", 0, 1, limit, False, False)}, steps, priority=rules)


def slow(
    ours: float,
    *others: Actor,
    limit: float | None = 14.0,
    held: Sequence[HeldUp] = (),
    plan: Actions = ("continue",),
    time: float = 4.0,
) -> Slowness:
    driven = Driven(
        dict(enumerate((Actor(straight(0.0, 0.0, ours)), *others))),
        6.0,
        held=lambda _: held,
        plan=lambda _: plan,
        roads=lambda _: None if limit is None else road(limit),
    )
    whole = driven.ride()
    return slowness(whole, World(whole), time)


def told(found: Slowness) -> list[tuple[object, ...]]:
    return [(c.kind, c.vehicle, c.value, c.speed) for c in found.reasons.causes]


def deed(begin: float = 4.0, end: float | None = 6.0) -> Episode:
    return Episode(Ego(), "slow-down", begin, end, speed_from=10.0)


def readied(
    held: Sequence[HeldUp],
    first: Sequence[int],
    plan: Actions = ("continue",),
    cleared: Sequence[int] = (),
) -> MotionCause | None:
    others = (AHEAD, Actor(straight(60.0, 30.0, 5.0, -math.pi / 2.0)))
    whole = Driven(
        dict(enumerate((OURS, *others))),
        8.0,
        held=lambda _: held,
        plan=lambda _: plan,
        roads=lambda _: road(first=first),
    ).ride()
    return ready_for(whole, World(whole), deed(), cleared)


def test_who_might_have_come_first() -> None:
    some = (in_the_way(2, 4.0, 5.0, "right-of-way"),)
    assert readied(some, (2,)) == MotionCause("give-way-line", 2)
    assert readied(some, ()) is None
    assert readied(some, (2,), cleared=(2,)) is None
    assert readied((in_the_way(2, 6.1, 9.0),), (2,)) is None  # later
    assert readied((in_the_way(2, 0.0, 2.9),), (2,)) is None  # before
    both = (in_the_way(1, 4.0, 7.0), in_the_way(2, 4.0, 5.0))
    assert readied(both, (1, 2)) == MotionCause("give-way-line", 1)  # longest


@pytest.mark.parametrize("longer", [1, 2])
def test_less_than_a_second_counts_by_its_length_as_well(longer: int) -> None:
    some = tuple(in_the_way(v, 4.0, 4.8 if v == longer else 4.4) for v in (1, 2))
    assert readied(some, (1, 2)) == MotionCause("give-way-line", longer)


@pytest.mark.parametrize(
    ("kind", "since", "told"),
    [("pedestrian", 4.0, True), ("wheelchair", 5.9, True), ("car", 4.0, False),
     ("pedestrian", 6.5, False)],
)  # fmt: skip
def test_who_might_have_crossed_on_foot(kind: str, since: float, told: bool) -> None:
    walker = Actor(straight(60.0, 30.0, 1.2, -math.pi / 2.0))
    held = (in_the_way(1, since, since + 3.0, "right-of-way"),)
    driven = Driven({0: OURS, 1: walker}, 8.0, held=lambda _: held, roads=lambda _: road()).ride()
    seen = tuple(
        structs.replace(t, scene={**t.scene, 1: replace(t.scene[1], kind=kind)})
        for t in driven.traces
    )
    whole = Ride(replace(driven.record, traces=seen))
    found = ready_for(whole, World(whole), deed(), ())
    assert found == (MotionCause("may-go-first", 1) if told else None)


def test_whom_a_stop_stays_behind() -> None:
    held = (in_the_way(1, 9.0, 15.0), in_the_way(2, 9.0, 20.0))
    assert readied(held, (), ("stop", "continue")) == MotionCause("leader", 1)  # it leads us
    assert readied(held, (), ("continue",)) is None


def test_a_change_of_lanes_that_comes_next() -> None:
    def changing(
        begun: float | None, until: float = 12.0, plan: Actions = ("continue", "change-left")
    ) -> Ride:
        events = () if begun is None else (Told("action-started", begun, "change-left", 5),)
        return Driven({0: OURS}, until, plan=lambda _: plan, events=events).ride()

    found = MotionCause("next-move", actions=("change-left",))
    for begun, told in ((4.0, True), (8.5, True), (8.6, False), (3.9, False), (None, False)):
        whole = changing(begun)
        assert next_move(whole, whole.traces[5], deed()) == (found if told else None)
    soon = changing(None, 8.0)
    assert next_move(soon, soon.traces[5], deed()) == found  # it may still come
    late = changing(None)
    assert next_move(late, late.traces[-1], deed()) == found
    other = changing(5.0, plan=("continue", "stop"))
    assert next_move(other, other.traces[5], deed()) is None
    now = changing(5.0, plan=("change-left",))
    assert next_move(now, now.traces[5], deed()) is None


@pytest.mark.parametrize(("until", "told"), [(2.0, False), (3.0, True), (6.0, True), (7.0, False)])
def test_a_turn_that_was_given_up(until: float, told: bool) -> None:
    """It was decided up to some time, from a second before the episode to its end."""

    def plan(time: float) -> Actions:
        return ("exit-left", "continue") if time <= until else ("continue",)

    whole = Driven({0: OURS}, 9.0, plan=plan).ride()
    found = given_up(whole, deed())
    assert found == (MotionCause("given-up", actions=("exit-left",)) if told else None)
    other = Driven({0: OURS}, 9.0, plan=lambda t: ("stop",) if t <= until else ("continue",)).ride()
    assert given_up(other, deed()) is None


def test_those_are_reasons_where_nothing_else_is() -> None:
    whole = Driven({0: OURS}, 8.0, plan=lambda _: ("continue", "change-left")).ride()
    found = reasons_for(whole, World(whole), deed())
    assert found.causes == (MotionCause("next-move", actions=("change-left",)),)
    faster = Episode(Ego(), "speed-up", 4.0, 6.0, speed_from=10.0)
    assert reasons_for(whole, World(whole), faster).causes == (MotionCause("plan"),)
