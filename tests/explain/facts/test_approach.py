"""Which of two is behind the other, the gap along their way, and when bodies were closest."""

import math

import pytest

from planner.record.places import RoadFacts, RoadPlace
from tests.explain.facts.scenes import Actor, Path_, Pose, made, straight
from xavi_dialogue.explain.facts.approach import Closest, Following, closest, following
from xavi_dialogue.explain.facts.states import States


def middle(x: float, y: float, speed: float, turn: float = 0.0) -> Path_:
    heading = math.radians(turn)
    return straight(x + 2.4 * math.cos(heading), y + 2.4 * math.sin(heading), speed, heading)


def pair(theirs: Path_, ours: Path_ | None = None, until: float = 2.0) -> States:
    own = middle(0.0, 0.0, 0.0) if ours is None else ours
    return States(made({0: Actor(own), 1: Actor(theirs)}, until))


@pytest.mark.parametrize(
    ("x", "y", "turn", "told"),
    [
        (20.0, 0.0, 0.0, (0, 1, 15.2)),
        (-20.0, 0.0, 0.0, (1, 0, 15.2)),
        (20.0, 1.9, 0.0, (0, 1, 15.2)),
        (20.0, -1.9, 0.0, (0, 1, 15.2)),
        (20.0, 2.1, 0.0, None),
        (20.0, -2.1, 0.0, None),
        (59.0, 2.1, 0.0, None),
        (4.0, 0.0, 0.0, (0, 1, 0.0)),
        (20.0, 0.0, 19.0, (0, 1, 15.2)),
        (20.0, 0.0, 21.0, None),
        (20.0, 0.0, -21.0, None),
        (20.0, 0.0, 180.0, None),
        (70.0, 3.0, 0.0, None),
    ],
)
def test_who_is_behind_whom_where_nobody_moves(
    x: float, y: float, turn: float, told: tuple[int, int, float] | None
) -> None:
    found = pair(middle(x, y, 0.0, turn))
    for one, other in ((0, 1), (1, 0)):
        seen = following(found, one, other, 2.0)
        assert (None if seen is None else (seen.behind, seen.ahead)) == (told and told[:2])
        assert seen is None or told is None or seen.gap == pytest.approx(told[2], abs=0.01)
    assert following(found, 0, 7, 2.0) is None


def test_lanes_on_record_tell_two_lines_apart() -> None:
    def states(mine: int | None, theirs: int | None, edge: str = "a") -> States:
        places = {
            0: RoadPlace("a", mine, 2, 14.0, False, False),
            1: RoadPlace(edge, theirs, 2, 14.0, False, False),
        }
        actors = {0: Actor(middle(0.0, 0.0, 0.0)), 1: Actor(middle(20.0, 0.0, 0.0))}
        return States(made(actors, 2.0, roads=lambda _: RoadFacts(places)))

    behind = Following(0, 1, pytest.approx(15.2))  # type: ignore[arg-type]
    assert following(states(0, 1), 0, 1, 2.0) is None
    assert following(states(0, 0), 0, 1, 2.0) == behind
    assert following(states(0, 1, "b"), 0, 1, 2.0) == behind
    assert following(states(None, 1), 0, 1, 2.0) == behind
    assert following(states(0, None), 0, 1, 2.0) == behind


def corner(way: float) -> Pose:
    """So far east, at most 40 m, round a quarter of a circle of 10 m to the left, and north."""
    if way <= 40.0:
        return way, 0.0, 0.0, 10.0
    angle = min((way - 40.0) / 10.0, math.pi / 2.0)
    rest = way - 40.0 - 10.0 * angle
    return 40.0 + 10.0 * math.sin(angle), 10.0 - 10.0 * math.cos(angle) + rest, angle, 10.0


@pytest.mark.parametrize(("lead", "gap"), [(20.0, 15.2), (30.0, 25.2)])
def test_the_gap_goes_round_the_corner(lead: float, gap: float) -> None:
    """The leader came past where the other is; both drive 10 m/s."""
    found = pair(lambda t: corner(10.0 * t + lead), lambda t: corner(10.0 * t), 4.0)
    seen = following(found, 0, 1, 4.0)
    assert seen is not None
    assert (seen.behind, seen.ahead) == (0, 1)
    assert seen.gap == pytest.approx(gap, abs=0.15)


@pytest.mark.parametrize(("y", "gap"), [(1.5, 63.3), (-1.5, 65.7), (2.4, None), (-2.4, None)])
def test_far_ahead_a_road_may_wind(y: float, gap: float | None) -> None:
    """The leader drove past so far aside; 40 m on it moved to 3 m aside, as the road does."""

    def theirs(t: float) -> Pose:
        return 10.0 * t - 10.0, y if t < 5.0 else 3.0, 0.0, 10.0

    seen = following(pair(theirs, None, 8.0), 0, 1, 8.0)
    assert (None if seen is None else seen.gap) == (gap and pytest.approx(gap, abs=0.3))


@pytest.mark.parametrize(
    ("begin", "end", "time", "distance"),
    [
        (0.0, 9.0, 5.0, 3.0 - 1.8),
        (0.0, 4.0, 4.0, math.hypot(10.0 - 4.8, 1.2)),
        (6.0, 9.0, 6.0, math.hypot(10.0 - 4.8, 1.2)),
        (0.0, 3.9, 3.9, math.hypot(11.0 - 4.8, 1.2)),
    ],
)
def test_closest_approach_in_an_interval(
    begin: float, end: float, time: float, distance: float
) -> None:
    """It comes from behind, 3 m aside and 10 m/s faster; its middle is beside ours at 5 s."""
    found = closest(pair(middle(-50.0, 3.0, 10.0), None, 9.0), 0, 1, begin, end)
    assert found is not None
    assert found.distance == pytest.approx(distance, abs=0.02)
    assert found.time == pytest.approx(time, abs=0.5)


def test_closest_approach_between_samples() -> None:
    """Head on at 20 m/s each past a corner: nearest for an instant only."""
    found = pair(middle(43.0, 30.7, 10.0, -90.0), middle(0.0, 0.0, 10.0), 8.0)
    near = closest(found, 0, 1, 0.0, 8.0)
    assert near is not None
    sampled = [closest(found, 0, 1, 0.2 * k, 0.2 * k) for k in range(41)]
    least = min(s.distance for s in sampled if s is not None)
    assert near.distance <= least
    assert any(
        near.time == pytest.approx(0.2 * k + s, abs=1e-6)
        for k in range(41)
        for s in (-0.15, -0.1, -0.05, 0.0, 0.05, 0.1, 0.15)
    )


def test_who_was_not_in_view_was_not_close() -> None:
    hidden = Actor(middle(-50.0, 3.0, 10.0), hidden=(3.0, 7.0))
    states = States(made({0: Actor(middle(0.0, 0.0, 0.0)), 1: hidden}, 9.0))
    found = closest(states, 0, 1, 0.0, 9.0)
    assert found is not None
    assert found.time == pytest.approx(3.0, abs=0.21)
    assert closest(states, 0, 1, 4.0, 5.0) is None
    other = closest(states, 1, 0, 4.0, 5.0)  # of us it is known always
    assert other == Closest(pytest.approx(5.0, abs=0.5), pytest.approx(1.2))  # type: ignore[arg-type]
    assert closest(states, 0, 5, 0.0, 9.0) is None
