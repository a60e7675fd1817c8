"""How two vehicles meet, on made rides of which every moment can be worked out by hand."""

import math

import pytest

from planner.record.events import Event
from planner.record.places import RoadFacts, RoadPlace
from planner.record.trace import Action
from tests.explain.facts.scenes import Actor, Path_, Pose, glimpsed, made, shifted, speeds, straight
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.facts.world import World

ONE = Vehicle(1)


def middle(x: float, y: float, speed: float, turn: float = 0.0) -> Path_:
    """Steady driving of a car whose middle is at a place first; the turn in degrees."""
    heading = math.radians(turn)
    return straight(x + 2.4 * math.cos(heading), y + 2.4 * math.sin(heading), speed, heading)


def met(ours: Path_, theirs: Path_, actions: ActionName, until: float = 9.0) -> tuple[Episode, ...]:
    """The meetings of such a kind of us and one other."""
    return World(made({0: Actor(ours), 1: Actor(theirs)}, until)).episodes(actions=actions)


@pytest.mark.parametrize(
    ("x", "y", "speed", "turn", "ours", "told"),
    [
        # nearer than 4.8 m from 4.37 to 5.97 s
        (-31.0, 3.5, 16.0, 0.0, 10.0, (ONE, "overtake", "left", 4.4, 5.8)),
        (-31.0, -3.5, 16.0, 0.0, 10.0, (ONE, "overtake", "right", 4.4, 5.8)),
        (31.0, 3.5, 4.0, 0.0, 10.0, (Ego(), "overtake", "right", 4.4, 5.8)),
        (31.0, -3.5, 4.0, 0.0, 10.0, (Ego(), "overtake", "left", 4.4, 5.8)),
        (31.0, -11.9, 4.0, 0.0, 10.0, (Ego(), "overtake", "left", 4.4, 5.8)),
        (31.0, -12.1, 4.0, 0.0, 10.0, None),
        # from 3.24 to 4.42 s, by one who hardly moves
        (31.0, 3.5, 1.9, 0.0, 10.0, (Ego(), "pass", "right", 3.4, 4.4)),
        (31.0, 3.5, 2.1, 0.0, 10.0, (Ego(), "overtake", "right", 3.4, 4.4)),
        (-31.0, 3.5, 10.0, 0.0, 1.9, (ONE, "pass", "left", 3.4, 4.4)),
        (-31.0, 3.5, 10.0, 0.0, 2.1, (ONE, "overtake", "left", 3.4, 4.4)),
        # towards us, from 2.86 to 3.34 s
        (62.0, 3.5, 10.0, 180.0, 10.0, (ONE, "pass", "left", 3.0, 3.2)),
        (62.0, -3.5, 10.0, 180.0, 10.0, (ONE, "pass", "right", 3.0, 3.2)),
        (62.0, 3.5, 10.0, 135.0, 10.0, None),  # it drives off to the left
        (-3.0, 3.5, 16.0, 0.0, 10.0, (ONE, "overtake", "left", 0.0, 1.2)),
        (-51.0, 3.5, 16.0, 0.0, 10.0, (ONE, "overtake", "left", 7.8, 9.0)),  # past by 3 m
        (-31.0, 3.5, 10.0, 0.0, 10.0, None),
    ],
)
def test_who_goes_past_whom(
    x: float, y: float, speed: float, turn: float, ours: float, told: tuple[object, ...] | None
) -> None:
    found = met(middle(0.0, 0.0, ours), middle(x, y, speed, turn), "pass")
    assert [(e.actor, e.action, e.side, e.begin, e.end) for e in found] == ([told] if told else [])
    assert {e.object for e in found} <= {Ego(), ONE} - {e.actor for e in found}


def test_who_falls_back_again_has_not_gone_past() -> None:
    """It comes up to 2 m behind our middle, and falls back by 2 m in each second."""
    theirs = speeds(-7.6, 3.5, ((0.0, 12.0), (4.0, 12.0), (4.2, 8.0), (20.0, 8.0)))
    assert met(middle(0.0, 0.0, 10.0), theirs, "pass") == ()


@pytest.mark.parametrize(
    ("x", "y", "speed", "turn", "side"),
    [
        (20.0, -30.5, 5.0, 90.0, "right"),
        (20.0, 30.5, 5.0, -90.0, "left"),
        (39.9, -30.5, 5.0, 90.0, "right"),
        (40.1, -30.5, 5.0, 90.0, None),
        (0.5, -30.5, 5.0, 90.0, "right"),
        (-0.5, -30.5, 5.0, 90.0, None),
        (20.0, -6.5, 1.1, 90.0, "right"),
        (20.0, -5.5, 0.9, 90.0, None),
        (40.0, -30.5, 5.0, 130.5, None),
        (20.0, -12.5, 5.0, 45.0, None),
        (20.0, 30.5, 5.0, 90.0, None),  # it drives away
    ],
)
def test_who_crosses_our_line(
    x: float, y: float, speed: float, turn: float, side: str | None
) -> None:
    found = met(middle(0.0, 0.0, 0.0), middle(x, y, speed, turn), "cross")
    assert [(e.actor, e.object, e.side) for e in found] == ([(ONE, Ego(), side)] if side else [])


def test_a_crossing_lasts_as_long_as_it_is_in_the_way() -> None:
    """Its middle is within 4.8 m of our line from 5.14 to 7.06 s, at 5 m/s."""
    (found,) = met(middle(0.0, 0.0, 0.0), middle(20.0, -30.5, 5.0, 90.0), "cross")
    assert (found.begin, found.end) == (5.2, 7.0)
    (early,) = met(middle(0.0, 0.0, 0.0), middle(20.0, -2.5, 5.0, 90.0), "cross")
    assert (early.begin, early.end) == (0.0, 1.4)
    (late,) = met(middle(0.0, 0.0, 0.0), middle(20.0, -43.5, 5.0, 90.0), "cross")
    assert (late.begin, late.end) == (7.8, 9.0)


@pytest.mark.parametrize(
    ("x", "y", "theirs", "ours", "actor"),
    [
        (44.7, 0.0, 10.0, 10.0, Ego()),  # 39.9 m is 3.99 s
        (44.9, 0.0, 10.0, 10.0, None),
        (-44.7, 0.0, 10.0, 10.0, ONE),
        (-44.9, 0.0, 10.0, 10.0, None),
        (16.7, 0.0, 1.0, 1.0, Ego()),  # 11.9 m, at a crawl
        (16.9, 0.0, 1.0, 1.0, None),
        (44.7, 0.0, 8.0, 10.0, Ego()),  # the one behind counts
        (-44.7, 0.0, 10.0, 8.0, ONE),
        (44.7, 0.0, 9.9, 9.0, None),
        (-44.7, 0.0, 9.0, 9.9, None),
        (30.0, 1.9, 10.0, 10.0, Ego()),
        (30.0, -2.1, 10.0, 10.0, None),
        (30.0, 2.1, 10.0, 10.0, None),
    ],
)
def test_who_follows_whom(
    x: float, y: float, theirs: float, ours: float, actor: Ego | Vehicle | None
) -> None:
    found = met(middle(0.0, 0.0, ours), middle(x, y, theirs), "follow", 6.0)
    assert [e.actor for e in found] == ([actor] if actor else [])
    assert all((e.begin, e.end) == (0.0, None) for e in found)
    assert all(e.object == (ONE if actor == Ego() else Ego()) for e in found)


@pytest.mark.parametrize(
    ("left", "until", "ended", "end"),
    [(2.0, 8.0, False, 2.0), (2.0, 3.0, False, None), (2.0, 3.0, True, 2.0), (1.0, 8.0, False, 0)],
)
def test_how_long_somebody_is_followed(
    left: float, until: float, ended: bool, end: float | None
) -> None:
    """It turns off after so many seconds; less than two are no following (0)."""
    actors = {0: Actor(middle(0.0, 0.0, 9.0)), 1: Actor(middle(30.0, 0.0, 9.0), until=left)}
    found = World(made(actors, until, ended=ended)).episodes(actions="follow")
    assert [e.end for e in found] == ([] if end == 0 else [end])


@pytest.mark.parametrize(("time", "end"), [(3.4, None), (3.8, 3.0)])
def test_with_a_glimpse_it_is_known_sooner_that_following_is_over(
    time: float, end: float | None
) -> None:
    ride = made({0: Actor(middle(0.0, 0.0, 9.0)), 1: Actor(middle(30.0, 0.0, 9.0))}, 3.0)
    here = {0: ride.latest.scene[0]}
    found = World(glimpsed(ride, time, here)).episodes(actions="follow")
    assert [e.end for e in found] == [end]


def test_an_end_of_the_road_does_not_end_following() -> None:
    """For 0.6 s it is seen aside, as where a road winds; for 1.6 s it is another lane."""

    def winding(until: float) -> Path_:
        def pose(t: float) -> Pose:
            return 30.0 + 10.0 * t, 3.0 if 3.9 < t < until else 0.0, 0.0, 10.0

        return pose

    (once,) = met(straight(0.0, 0.0, 10.0), winding(4.5), "follow")
    assert (once.begin, once.end) == (0.0, None)
    first, second = met(straight(0.0, 0.0, 10.0), winding(5.5), "follow")
    assert (first.begin, first.end, second.begin) == (0.0, 3.8, 5.6)


@pytest.mark.parametrize(
    ("x", "y", "turn", "followed"),
    [
        (15.0, 0.0, 0.0, False),
        (15.0, 1.9, 0.0, False),
        (15.0, 2.1, 0.0, True),
        (15.0, 1.0, 180.0, True),  # it stands there the other way round
        (45.0, 0.0, 0.0, True),
        (-15.0, 0.0, 0.0, True),
    ],
)
def test_nobody_follows_past_somebody_else(x: float, y: float, turn: float, followed: bool) -> None:
    """We at 10 m/s behind the first at 30 m; the second somewhere, as fast."""
    speed = -10.0 if turn else 10.0
    actors = {
        0: Actor(middle(0.0, 0.0, 10.0)),
        1: Actor(middle(30.0, 0.0, 10.0)),
        2: Actor(middle(x, y, speed, turn)),
    }
    found = World(made(actors, 6.0)).episodes(0, "follow", object=1)
    assert bool(found) is followed


def test_nobody_is_followed_past_us() -> None:
    """The first is behind us; the second between, or ahead of us."""
    for x, followed in ((-15.0, False), (15.0, True), (-45.0, True)):
        actors = {
            0: Actor(middle(0.0, 0.0, 10.0)),
            1: Actor(middle(-30.0, 0.0, 10.0)),
            2: Actor(middle(x, 0.0, 10.0)),
        }
        assert bool(World(made(actors, 6.0)).episodes(1, "follow", object=0)) is followed


@pytest.mark.parametrize(
    ("x", "y", "speed", "ours", "cuts"),
    [
        (34.5, 3.5, 12.0, 12.0, True),  # 29.7 m, 2.5 s are 30
        (35.1, 3.5, 12.0, 12.0, False),
        (44.8, 3.5, 10.0, 12.0, True),  # 28 m in the end; our speed counts
        (34.5, -3.5, 12.0, 12.0, True),
        (19.5, 3.5, 4.0, 4.0, True),  # 14.7 m
        (20.1, 3.5, 4.0, 4.0, False),
        (3.9, 3.5, 12.0, 12.0, False),  # alongside
        (-20.0, 3.5, 12.0, 12.0, False),
        (20.0, 7.0, 12.0, 12.0, False),  # not into our lane
        (20.0, 1.5, 12.0, 12.0, False),  # it was on our line before
    ],
)
def test_who_cuts_in(x: float, y: float, speed: float, ours: float, cuts: bool) -> None:
    theirs = shifted(middle(x, y, speed), 3.0, 6.0, -3.5 if y > 0.0 else 3.5)
    found = met(middle(0.0, 0.0, ours), theirs, "cut-in", 10.0)
    assert [(e.actor, e.action, e.object) for e in found] == (
        [(ONE, "cut-in", Ego())] if cuts else []
    )


def changing(action: Action, begin: float, end: float) -> tuple[Event, ...]:
    """The events of a lane change of ours."""
    return (
        Event("action-started", begin - 1.0, action, 1),
        Event("action-committed", begin, action, 1),
        Event("action-ended", end, action, 1),
    )


@pytest.mark.parametrize(
    ("x", "speed", "cuts"),
    [
        (-20.0, 12.0, True),
        (-34.5, 12.0, True),
        (-35.1, 12.0, False),
        (20.0, 12.0, False),
    ],
)
def test_whom_we_cut_off(x: float, speed: float, cuts: bool) -> None:
    ours = shifted(middle(0.0, 0.0, 12.0), 3.0, 6.0, 3.5)
    actors = {0: Actor(ours), 1: Actor(middle(x, 3.5, speed))}
    ride = made(actors, 10.0, events=changing("change-left", 3.0, 6.0))
    found = World(ride).episodes(actions="cut-in")
    assert [(e.actor, e.object, e.begin, e.end) for e in found] == (
        [(Ego(), ONE, 3.0, 6.0)] if cuts else []
    )


def test_who_moves_into_our_lane_while_we_leave_it_cuts_in() -> None:
    """By the lanes on record: both move one lane to the right, and are never on one line."""

    def roads(time: float) -> RoadFacts:
        ours = RoadPlace("main", 1 if time < 4.0 else 0, 3, 14.0, False, False)
        theirs = RoadPlace("main", 2 if time < 4.0 else 1, 3, 14.0, False, False)
        return RoadFacts({0: ours, 1: theirs})

    actors = {
        0: Actor(shifted(middle(0.0, 0.0, 12.0), 4.0, 5.0, -3.5)),
        1: Actor(shifted(middle(15.0, 3.5, 12.0), 3.0, 6.0, -3.5)),
    }
    (found,) = World(made(actors, 10.0, roads=roads)).episodes(1, "cut-in")
    assert found.object == Ego()
    assert World(made(actors, 10.0)).episodes(1, "cut-in") == ()


def emerging(t: float) -> Pose:
    """North for 4 s at 6 m/s, to the right within 2 s, and on to the east 7.64 m further up."""
    radius = 12.0 / (math.pi / 2.0)
    if t <= 4.0:
        return 0.0, 6.0 * t, math.pi / 2.0, 6.0
    turned = math.pi / 2.0 * min((t - 4.0) / 2.0, 1.0)
    x, y = radius * (1.0 - math.cos(turned)), 24.0 + radius * math.sin(turned)
    return x + max(t - 6.0, 0.0) * 6.0, y, math.pi / 2.0 - turned, 6.0


@pytest.mark.parametrize(
    ("x", "y", "pulls"),
    [
        (-70.0, 31.64, True),  # at 7 s we are at 0, and it is 13.6 m ahead
        (-116.0, 31.64, True),
        (-117.0, 31.64, False),  # 60.6 m
        (-55.0, 31.64, False),  # beside it
        (-70.0, 27.7, True),
        (-70.0, 27.5, False),
        (-70.0, 35.7, False),
    ],
)
def test_who_pulls_out_ahead_of_us(x: float, y: float, pulls: bool) -> None:
    found = met(straight(x, y, 10.0), emerging, "pull-out", 10.0)
    assert [(e.actor, e.object, e.side, e.sure) for e in found] == (
        [(ONE, Ego(), "right", False)] if pulls else []
    )


def test_who_comes_against_us_does_not_pull_out() -> None:
    assert met(straight(90.0, 31.64, 10.0, math.pi), emerging, "pull-out", 10.0) == ()


@pytest.mark.parametrize(
    ("x", "y", "speed", "turn", "ours", "near"),
    [
        (4.2, -20.0, 5.0, 90.0, 0.0, True),  # 0.9 m before our nose
        (4.4, -20.0, 5.0, 90.0, 0.0, False),
        (4.2, -6.5, 0.9, 90.0, 0.0, False),  # nobody moves much
        (4.2, -7.5, 1.1, 90.0, 0.0, True),
        (-12.0, 2.6, 12.0, 0.0, 8.0, False),  # beside us in its own lane
        (-12.0, -2.6, 12.0, 180.0, 0.0, False),
        (5.5, 0.0, 8.0, 0.0, 8.0, True),  # 0.7 m behind it at speed
        (5.5, 0.0, 0.0, 0.0, 0.0, False),
        (15.4, 0.0, 0.0, 0.0, 1.1, True),  # 0.7 m in the end
        (13.6, 0.0, 0.0, 0.0, 0.9, False),
    ],
)
def test_who_nearly_touches_us(
    x: float, y: float, speed: float, turn: float, ours: float, near: bool
) -> None:
    found = met(middle(0.0, 0.0, ours), middle(x, y, speed, turn), "nearly-collide")
    assert [(e.actor, e.object) for e in found] == ([(Ego(), ONE)] if near else [])


def test_a_near_miss_is_when_it_was_closest() -> None:
    """The other stands with its middle 4.7 m to our left; we swerve up to it at 4 s and back."""

    def pose(t: float) -> Pose:
        return 10.0 * t, 2.2 - 2.0 * abs(t - 4.0), 0.0, 10.0

    other = Actor(straight(42.4, 4.7, 0.0, math.pi / 2.0))
    (found,) = World(made({0: Actor(pose), 1: other}, 8.0)).episodes(actions="nearly-collide")
    assert found.begin == found.end
    assert found.begin == pytest.approx(4.2, abs=0.25)


def test_somebody_on_foot_crosses_our_way_from_stepping_out_on() -> None:
    """From 6 m on our right at 1 m/s: nearer than 4 m from 2 to 10 s."""
    walker = Actor(straight(30.0, -6.0, 1.0, math.pi / 2.0), "pedestrian", None, 0.2)
    stands = {0: Actor(straight(0.0, 0.0, 0.0)), 1: walker}
    (going,) = World(made(stands, 6.0)).episodes(actions="cross")
    assert (going.actor, going.end, going.side) == (ONE, None, "right")
    assert going.begin == pytest.approx(2.0, abs=0.3)
    (over,) = World(made(stands, 14.0)).episodes(actions="cross")
    assert over.end == pytest.approx(10.0, abs=0.3)
    assert World(made(stands, 1.0)).episodes(actions="cross") == ()
    aside = {**stands, 1: Actor(straight(30.0, -6.0, 1.0), "pedestrian", None, 0.2)}
    assert World(made(aside, 6.0)).episodes(actions="cross") == ()
