"""What of the road explains how we drive, by hand-made roads."""

import math
from collections.abc import Sequence
from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.events import Event as Told
from planner.record.places import RoadFacts, RoadPlace, RouteStep
from planner.record.trace import PlannedAction, PlanTrace, TimedAction
from tests.explain.facts.scenes import Actor, Path_, Pose, made, speeds, straight
from xavi_dialogue.domain.answers import MotionCause
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.driving import roadside
from xavi_dialogue.explain.causes.driving.roadside import (
    is_turning,
    limit_at,
    road_causes,
    setting_off,
    speeding_up,
)
from xavi_dialogue.explain.history.ride import Ride

PLAN = (MotionCause("plan"),)


def place(
    limit: float = 14.0, lane: int | None = 0, edge: str = "a", ring: bool = False
) -> RoadPlace:
    return RoadPlace(edge, lane, 3, limit, lane is None, ring)


def step(
    distance: float, turn: str = "exit-straight", rule: str = "priority", kind: str = "junction"
) -> RouteStep:
    return RouteStep(distance, kind, turn, None, None, 4, rule)  # type: ignore[arg-type]


def with_road(
    road: RoadFacts | None, until: float = 8.0, speed: float = 10.0, **other: object
) -> Ride:
    """At a steady speed; each decision has the same road."""
    path = other.pop("path", straight(0.0, 0.0, speed))
    return made({0: Actor(path)}, until, roads=lambda _: road, **other)  # type: ignore[arg-type]


def reasons(
    road: RoadFacts | None,
    action: ActionName = "slow-down",
    end: float | None = 6.0,
    **other: Any,
) -> list[tuple[str, float | None]]:
    """Why we slowed down from 10 m/s at 4 s, with the decision of then."""
    whole = with_road(road, **other)
    deed = Episode(Ego(), action, 4.0, end, speed_from=10.0)
    return [(c.kind, c.value) for c in road_causes(whole, whole.traces[4], deed)]


def ahead(*steps: RouteStep, distance: float | None = None, limit: float = 14.0) -> RoadFacts:
    return RoadFacts({0: place(limit)}, steps, distance)


@pytest.mark.parametrize(
    ("road", "told"),
    [
        (None, ["plan"]),
        (ahead(), ["plan"]),
        (ahead(step(40.0)), ["plan"]),
        (ahead(step(40.0, "exit-left")), ["turn"]),
        (ahead(step(45.0, "exit-left")), ["turn"]),  # 10^2 / 3 + 12 m are 45.3
        (ahead(step(46.0, "exit-left")), ["plan"]),
        (ahead(step(40.0, rule="equal")), ["give-way-line"]),
        (ahead(step(40.0, "exit-left", "equal")), ["turn", "give-way-line"]),
        (ahead(step(40.0, "exit-left", "give-way")), ["give-way-line", "turn"]),
        (ahead(step(40.0, kind="roundabout")), ["roundabout"]),
        (ahead(step(40.0, "exit-left", kind="roundabout")), ["roundabout"]),
        (ahead(step(80.0), step(90.0, "exit-left")), ["plan"]),
        (RoadFacts({0: place(ring=True)}, (step(9.0, "exit-left"),)), ["roundabout"]),
        (RoadFacts({0: place(lane=None)}, (step(9.0, "exit-left"),)), ["plan"]),
        (ahead(distance=45.0), ["destination"]),
        (ahead(distance=46.0), ["plan"]),
        (ahead(step(40.0, "exit-left", "equal"), distance=45.0), ["destination", "turn"]),
    ],
)
def test_what_of_the_road_makes_one_slow_down(road: RoadFacts | None, told: list[str]) -> None:
    assert [kind for kind, _ in reasons(road)] == told


def test_one_stands_for_what_is_no_pace() -> None:
    both = ahead(step(40.0, "exit-left", "equal"))
    assert [k for k, _ in reasons(both, "stop")] == ["give-way-line"]
    assert [k for k, _ in reasons(ahead(step(40.0, "exit-left")), "stand")] == ["plan"]
    assert [k for k, _ in reasons(ahead(step(40.0, kind="roundabout")), "wait")] == ["plan"]


def test_how_far_it_is_now() -> None:
    """The decision of 8 s has the junction 40 m ahead, and so has that of 4 s."""
    assert reasons(ahead(step(40.0, "exit-left")), end=None) == [("turn", 40.0)]
    assert reasons(ahead(step(40.0, "exit-left"))) == [("turn", None)]  # it is over
    assert reasons(ahead(step(4.0, "exit-left")), end=None) == [("turn", None)]  # it is here
    assert reasons(ahead(distance=40.0), end=None) == [("destination", 40.0)]
    assert reasons(ahead(distance=40.0), end=6.0) == [("destination", 40.0)]

    def roads(time: float) -> RoadFacts:
        return ahead(step(40.0 if time <= 4.0 else 45.1, "exit-left"))

    whole = made({0: Actor(straight(0.0, 0.0, 10.0))}, 8.0, roads=roads)
    deed = Episode(Ego(), "slow-down", 4.0, None, speed_from=10.0)
    (found,) = road_causes(whole, whole.traces[4], deed)
    assert found == MotionCause("turn")  # the one ahead now is another


def test_the_end_of_the_trip() -> None:
    arrived = (Told("arrived", 7.0),)
    assert reasons(ahead(), events=arrived) == [("destination", None)]
    assert reasons(ahead(), end=5.9, events=arrived) == [("plan", None)]


@pytest.mark.parametrize(
    ("before", "after", "told"),
    [
        (14.0, 9.0, [("limit", 9.0)]),
        (14.0, 9.4, [("limit", 9.4)]),
        (14.0, 9.6, [("plan", None)]),
        (9.0, 9.0, [("plan", None)]),
        (8.0, 9.0, [("plan", None)]),
    ],
)
def test_a_lower_limit(before: float, after: float, told: list[tuple[str, float | None]]) -> None:
    """One second before 4 s against one after 6 s."""

    def roads(time: float) -> RoadFacts:
        limit = before if time <= 3.0 else after if time >= 7.0 else 30.0
        return ahead(limit=limit)

    whole = made({0: Actor(straight(0.0, 0.0, 10.0))}, 8.0, roads=roads)
    deed = Episode(Ego(), "slow-down", 4.0, 6.0, speed_from=10.0)
    assert [(c.kind, c.value) for c in road_causes(whole, whole.traces[4], deed)] == told
    unknown = Episode(Ego(), "slow-down", 4.0, 6.0)
    assert road_causes(whole, whole.traces[4], unknown) == PLAN


def bending(begin: float, angle: float) -> Path_:
    def pose(t: float) -> Pose:
        return 10.0 * t, 0.0, math.radians(angle) if t > begin else 0.0, 10.0

    return pose


@pytest.mark.parametrize(
    ("begin", "angle", "bends"),
    [
        (5.0, 11.0, True),
        (5.0, -11.0, True),
        (5.0, 9.0, False),
        (8.1, 11.0, True),
        (8.7, 11.0, False),
    ],
)
def test_a_bend_of_the_road(begin: float, angle: float, bends: bool) -> None:
    """Up to 2.5 s after 6 s."""
    told = reasons(ahead(), path=bending(begin, angle), until=9.0)
    assert told == ([("bend", None)] if bends else [("plan", None)])
    assert reasons(ahead(), "stop", path=bending(begin, angle), until=9.0) == [("plan", None)]


def test_a_bend_that_is_planned() -> None:
    whole = with_road(ahead())
    trace = whole.traces[4]
    path = tuple((2.0 * k, 0.0 if k < 3 else 2.0 * (k - 2)) for k in range(8))
    rows = tuple(replace(r, path=path, speed=(10.0,) * 8) for r in trace.rollouts)
    deed = Episode(Ego(), "slow-down", 4.0, 6.0, speed_from=10.0)
    assert road_causes(whole, replace(trace, rollouts=rows), deed) == (MotionCause("bend"),)


@pytest.mark.parametrize(
    ("slowest", "again", "told"),
    [
        (5, 10.0, "bend"),  # 25 m before the junction
        (5, 6.0, "turn"),  # it goes on slowly
        (16, 10.0, "turn"),
    ],
)
def test_what_lies_beyond_the_slowest_place_is_no_reason(
    slowest: int, again: float, told: str
) -> None:
    """The road bends 10 m ahead; the drive planned is slowest after some steps of 2 m."""
    whole = with_road(ahead(step(40.0, "exit-left")))
    trace = whole.traces[4]
    path = tuple((2.0 * k, 0.0 if k < 5 else 0.8 * (k - 4)) for k in range(24))
    speed = tuple(5.0 if k == slowest else again if k > slowest else 9.0 for k in range(24))
    rows = tuple(replace(r, path=path, speed=speed) for r in trace.rollouts)
    deed = Episode(Ego(), "slow-down", 4.0, None, speed_from=10.0)
    found = road_causes(whole, replace(trace, rollouts=rows), deed)
    assert [cause.kind for cause in found] == [told]


@pytest.mark.parametrize(
    ("plan", "under_way", "turning"),
    [
        (("exit-left",), None, True),
        (("continue-next-exit",), None, True),
        (("continue", "exit-left"), None, False),
        ((), None, False),
        (("exit-left",), "change-left", False),
        (("continue",), "exit-right", True),
    ],
)
def test_whether_a_turn_comes_next(
    plan: Sequence[str], under_way: str | None, turning: bool
) -> None:
    def turned(trace: PlanTrace) -> PlanTrace:
        steps = tuple(PlannedAction(a, 0.0, 1) for a in plan)  # type: ignore[arg-type]
        doing = None if under_way is None else TimedAction(under_way, 3.0)  # type: ignore[arg-type]
        return replace(trace, plan=steps, under_way=doing)

    trace = turned(with_road(None).traces[4])
    assert is_turning(trace) is turning
    deed = Episode(Ego(), "slow-down", 4.0, 6.0, speed_from=10.0)
    told = (MotionCause("turn"),) if turning else PLAN
    assert road_causes(with_road(None), trace, deed) == told
    inside = replace(trace, road=RoadFacts({0: place(lane=None)}, (step(9.0),)))
    assert road_causes(with_road(None), inside, deed) == told


@pytest.mark.parametrize(
    ("stood", "begin", "speed", "told"),
    [
        (3.0, 4.0, 0.0, [("starting", None), ("limit", 14.0)]),
        (3.0, 8.9, 5.0, [("starting", None), ("limit", 14.0)]),
        (3.0, 9.4, 5.0, [("limit", 14.0)]),
        (3.0, 9.4, 14.0, [("plan", None)]),
        (3.0, 9.4, None, [("plan", None)]),
    ],
)
def test_why_one_speeds_up(
    stood: float, begin: float, speed: float | None, told: list[tuple[str, float | None]]
) -> None:
    """It stands up to 3 s, and its speed grows by 1 m/s in a second from then on."""
    path = speeds(0.0, 0.0, ((0.0, 0.0), (stood, 0.0), (15.0, 12.0)))
    whole = with_road(ahead(), until=12.0, path=path)
    deed = Episode(Ego(), "speed-up", begin, begin + 1.0, speed_from=speed)
    assert [(c.kind, c.value) for c in speeding_up(whole, deed)] == told
    assert road_causes(whole, whole.traces[4], deed) == speeding_up(whole, deed)
    bare = with_road(None, until=12.0, path=path)
    assert [c.kind for c in speeding_up(bare, deed)] == (
        [told[0][0]] if told[0][0] == "starting" else ["plan"]
    )


def test_a_limit_that_rises_counts() -> None:
    def roads(time: float) -> RoadFacts:
        return ahead(limit=8.0 if time < 6.0 else 14.0)

    whole = made({0: Actor(straight(0.0, 0.0, 8.0))}, 8.0, roads=roads)
    deed = Episode(Ego(), "speed-up", 4.0, 7.0, speed_from=8.0)
    assert speeding_up(whole, deed) == (MotionCause("limit", value=14.0),)
    assert speeding_up(whole, Episode(Ego(), "speed-up", 4.0, 5.0, speed_from=8.0)) == PLAN
    assert speeding_up(whole, Episode(Ego(), "speed-up", 4.0, None, speed_from=8.0)) == (
        MotionCause("limit", value=14.0),
    )
    assert (limit_at(whole, 5.9), limit_at(whole, 6.0), limit_at(whole, -1.0)) == (8.0, 14.0, None)
    assert limit_at(with_road(RoadFacts({})), 4.0) is None


@pytest.mark.parametrize(("time", "told"), [(3.0, False), (3.8, True), (8.8, True), (9.6, False)])
def test_who_sets_off(time: float, told: bool) -> None:
    path = speeds(0.0, 9.0, ((0.0, 0.0), (3.0, 0.0), (15.0, 12.0)))
    whole = made({0: Actor(straight(0.0, 0.0, 5.0)), 1: Actor(path)}, 12.0)
    assert setting_off(whole, time, 1) is told
    assert not setting_off(whole, time)


class Line:
    """A planned line that turns by an angle [rad] after 20 m, where it is driven at a speed."""

    def __init__(self, angle: float, slow: float, length: int = 60) -> None:
        bent = [k >= 20 for k in range(length)]
        self.heading = [angle if after else 0.0 for after in bent]
        self.speed = [slow if after else 10.0 for after in bent]
        self.position = [(float(k), 0.0) for k in range(length)]


@pytest.mark.parametrize(
    ("angle", "slow", "far", "first"),
    [
        (0.5, 5.0, 50.0, True),
        (0.5, 5.0, 30.0, False),  # that is the turn at the junction
        (0.1, 5.0, 50.0, False),  # hardly a bend
        (0.5, 9.5, 50.0, False),  # hardly slower
    ],
)
def test_a_bend_before_the_junction_comes_first(
    monkeypatch: pytest.MonkeyPatch, angle: float, slow: float, far: float, first: bool
) -> None:
    monkeypatch.setattr(roadside, "lines", lambda _: {0: Line(angle, slow)})
    whole = with_road(ahead(step(far, "exit-right")))
    assert roadside.bends_first(whole, 4.0) is first
