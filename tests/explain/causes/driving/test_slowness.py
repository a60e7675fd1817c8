"""Why we drive slowly: the limit, a leader, the road."""

from collections.abc import Sequence

import pytest

from planner.record.places import PriorityFact, RoadFacts, RoadPlace, RouteStep
from planner.record.trace import HeldUp
from tests.explain.causes.decisions import Driven, in_the_way
from tests.explain.facts.scenes import Actor, made, speeds, straight
from tests.traces import Actions
from xavi_dialogue.domain.answers import Evidence, MotionCause, NotRecorded
from xavi_dialogue.domain.evidence import Causation
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.explain.causes.driving.slowness import Slowness, slowness, with_nearest
from xavi_dialogue.explain.causes.driving.stated_reasons import Reasons
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.ride import Unanswered

OURS = Actor(straight(0.0, 0.0, 10.0))


def road(limit: float = 14.0, *steps: RouteStep, first: Sequence[int] = ()) -> RoadFacts:
    rules = tuple(PriorityFact(v, "vehicle") for v in first)
    return RoadFacts({0: RoadPlace("a", 0, 1, limit, False, False)}, steps, priority=rules)


def step(distance: float, turn: str = "exit-straight", rule: str = "give-way") -> RouteStep:
    return RouteStep(distance, "junction", turn, None, None, 4, rule)  # type: ignore[arg-type]


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


@pytest.mark.parametrize(
    ("speed", "is_slow", "kind"),
    [(13.1, False, "limit"), (12.9, False, "plan"), (12.0, False, "plan"), (11.8, True, "plan")],
)
def test_driving_is_slow_against_the_limit(speed: float, is_slow: bool, kind: str) -> None:
    found = slow(speed)
    assert (found.limit, found.is_slow) == (14.0, is_slow)
    assert [c.kind for c in found.reasons.causes] == [kind]
    assert len(found.reasons.evidence.traces) == 1
    assert (found.deed.action, found.deed.object) == ("move", None)
    assert found.deed.speed_from == found.deed.speed_to == speed
    assert slow(speed, limit=None).is_slow is None


@pytest.mark.parametrize(("time", "end"), [(4.0, 4.0), (5.4, 5.4), (5.5, None), (6.0, None)])
def test_what_is_asked_of_now_goes_on(time: float, end: float | None) -> None:
    assert slow(9.0, time=time).deed.end == end


def test_before_the_record_nothing_is_known() -> None:
    with pytest.raises(Unanswered) as refused:
        slow(9.0, time=-1.0)
    assert refused.value.result == NotRecorded("before-record", since=-1.0)


def test_who_holds_us_up_now_is_the_reason() -> None:
    leader = Actor(straight(30.0, 0.0, 9.0))
    found = slow(9.0, leader, held=(in_the_way(1, 4.0, 8.0),))
    assert told(found) == [("leader", 1, None, 9.0)]
    assert (found.deed.action, found.deed.object) == ("follow", Vehicle(1))
    late = slow(9.0, held=(in_the_way(1, 7.1, 9.0),))
    assert [c.kind for c in late.reasons.causes] == ["plan"]
    early = slow(9.0, held=(in_the_way(1, 0.0, 2.9),))
    assert [c.kind for c in early.reasons.causes] == ["plan"]


@pytest.mark.parametrize(
    ("speed", "kinds"), [(9.0, ["leader"]), (10.9, ["leader"]), (11.1, ["plan"])]
)
def test_who_sets_the_pace_is_the_reason(speed: float, kinds: list[str]) -> None:
    """Nobody holds us up in the drives imagined; who is ahead drives hardly faster."""
    found = slow(9.0, Actor(straight(30.0, 0.0, speed)))
    assert [c.kind for c in found.reasons.causes] == kinds
    if kinds == ["leader"]:
        (cause,) = found.reasons.causes
        assert (cause.vehicle, cause.actions, cause.probability) == (1, ("continue",), 1.0)


def test_at_the_limit_a_leader_counts_that_is_slower() -> None:
    fast = slow(13.5, Actor(straight(30.0, 0.0, 12.1)))
    assert told(fast) == [("limit", None, 14.0, None)]
    behind = slow(13.5, Actor(straight(30.0, 0.0, 11.9)))
    assert told(behind) == [("leader", 1, None, 11.9)]


def test_without_drives_imagined_who_is_ahead_is_told() -> None:
    found = slow(9.0, Actor(straight(30.0, 0.0, 9.0)), plan=("exit-left",))
    assert told(found) == [("leader", 1, None, 9.0)]
    assert found.reasons.causation is None
    assert [c.kind for c in slow(9.0, plan=("exit-left",), limit=None).reasons.causes] == ["turn"]


def test_setting_off_is_slow() -> None:
    ours = Actor(speeds(0.0, 0.0, ((0.0, 0.0), (2.0, 0.0), (8.0, 9.0))))
    whole = Driven({0: ours}, 6.0, roads=lambda _: road()).ride()
    found = slowness(whole, World(whole), 5.0)
    assert [c.kind for c in found.reasons.causes] == ["starting"]
    held = Driven({0: ours, 1: Actor(straight(20.0, 0.0, 1.0))}, 6.0, roads=lambda _: road()).ride()
    found = slowness(held, World(held), 5.0)
    assert [c.kind for c in found.reasons.causes] == ["leader", "starting"]


def test_the_road_makes_us_slow() -> None:
    driven = Driven({0: OURS}, 6.0, roads=lambda _: road(14.0, step(30.0, "exit-left", "priority")))
    found = slowness(driven.ride(), World(driven.ride()), 4.0)
    assert [c.kind for c in found.reasons.causes] == ["turn"]


def counting(causes: tuple[MotionCause, ...], *vehicles: int) -> Reasons:
    causation = Causation("several", vehicles) if vehicles else None
    return Reasons(causes, causation, Evidence(), Driven({0: OURS}, 1.0).ride().latest)


def test_who_is_nearer_than_the_leader_that_is_the_reason_is_named_too() -> None:
    ride = made(
        {
            0: Actor(straight(0.0, 0.0, 9.0)),
            1: Actor(straight(40.0, 0.0, 9.0)),
            2: Actor(straight(20.0, 0.0, 9.0)),
            3: Actor(straight(20.0, 3.5, 9.0)),
        },
        4.0,
    )
    causes = (MotionCause("leader", 1), MotionCause("right-of-way", 1), MotionCause("limit"))
    world = World(ride)
    found = with_nearest(ride, world, counting(causes), 4.0)
    assert [(c.kind, c.vehicle, c.between) for c in found] == [
        ("leader", 1, 2),
        ("right-of-way", 1, None),
        ("limit", None, None),
    ]
    both = (MotionCause("leader", 2), MotionCause("leader", 1))
    assert with_nearest(ride, world, counting(both), 4.0) == both  # it is named already
    near = (MotionCause("leader", 2, speed=9.0),)
    assert with_nearest(ride, world, counting(near), 4.0) == near
    (told,) = with_nearest(ride, world, counting(near, 1, 2), 4.0)
    assert (told.vehicle, told.between) == (1, 2)  # who holds up the nearest, and counts as well
    (told,) = with_nearest(ride, world, counting((MotionCause("blocked", 1),)), 4.0)
    assert told.between is None  # it is too far off to be in sight behind the nearest
