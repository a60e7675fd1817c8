"""Whether we could stop in time, by the speeds, the reaction time and the hardest braking."""

import math

import pytest

from planner.kernels.limits import EMERGENCY, REACTION
from tests.explain.facts.scenes import Actor, Path_, made, straight
from xavi_dialogue.explain.causes.driving.stopping import (
    HALF_LANE,
    SETTING_OFF,
    Stopping,
    stopping,
    stopping_distance,
)
from xavi_dialogue.explain.facts.states import States

LONG, WIDE = 4.8, 1.8  # [m] of every vehicle here


def needed(speed: float) -> float:
    return REACTION * speed + speed**2 / (2.0 * EMERGENCY)


def found(
    other: Path_, speed: float = 10.0, time: float = 2.0, *, in_lane: bool = True
) -> Stopping | None:
    ride = made({0: Actor(straight(0.0, 0.0, speed)), 1: Actor(other)}, 4.0)
    return stopping(States(ride), 1, time, in_lane=in_lane)


def test_the_distance_is_that_of_the_reaction_and_of_the_braking() -> None:
    assert stopping_distance(0.0) == 0.0
    assert stopping_distance(14.0) == pytest.approx(0.9 * 14.0 + 14.0)  # at 7 m/s2
    assert stopping_distance(7.0) == pytest.approx(0.9 * 7.0 + 3.5)


@pytest.mark.parametrize(("gap", "kind"), [(10.0, "room"), (8.9, "short"), (30.0, "room")])
def test_behind_a_leader_as_fast_as_we_the_reaction_has_to_fit_into_the_gap(
    gap: float, kind: str
) -> None:
    stop = found(straight(gap + LONG, 0.0, 10.0))
    assert stop is not None
    assert (stop.kind, stop.speed) == (kind, 10.0)
    assert stop.needed == pytest.approx(needed(10.0))
    assert stop.room == pytest.approx(gap, abs=0.02)
    assert stop.left == pytest.approx(gap - REACTION * 10.0, abs=0.02)


def test_behind_a_slower_leader_less_is_left() -> None:
    stop = found(straight(20.0 + LONG + 4.0, 0.0, 8.0))
    assert stop is not None
    gap = 20.0
    assert stop.room == pytest.approx(gap, abs=0.02)
    assert stop.left == pytest.approx(gap + 64.0 / 14.0 - needed(10.0), abs=0.02)


@pytest.mark.parametrize(
    ("other", "kind"),
    [
        (straight(-30.0, 0.0, 10.0), "behind"),
        (straight(-30.0, 3.5, 10.0), "behind"),
        (straight(30.0, 3.5, 10.0), "apart"),
        (straight(2.0, 3.5, 10.0), "apart"),
        (straight(60.0, 3.5, 10.0, heading=math.pi), "apart"),
        (straight(60.0, 0.5, 10.0, heading=math.pi), "apart"),
    ],
)
def test_who_is_behind_or_keeps_to_another_lane_is_not_in_our_way(other: Path_, kind: str) -> None:
    stop = found(other)
    assert stop is not None
    assert (stop.kind, stop.speed, stop.needed, stop.left) == (kind, 10.0, None, None)


def test_who_is_beside_us_moves_into_our_side() -> None:
    assert found(straight(2.0, 3.5, 10.0), in_lane=False) == Stopping("beside", 10.0)


@pytest.mark.parametrize(
    ("gap", "pace", "kind"),
    [
        (10.0, 10.0, "joins"),  # as fast as we
        (10.0, 14.0, "joins"),  # faster
        (10.0, 4.0, "joins"),  # 6 m/s slower: 8.0 m are needed
        (7.5, 4.0, "short"),
    ],
)
def test_who_moves_in_ahead_may_not_be_much_slower(gap: float, pace: float, kind: str) -> None:
    ahead = gap + LONG + (10.0 - pace) * 2.0
    stop = found(straight(ahead, 3.5, pace), in_lane=False)
    assert stop is not None
    assert stop.kind == kind
    assert stop.room == pytest.approx(gap, abs=0.02)
    assert stop.needed == pytest.approx(needed(10.0))


def test_standing_we_need_no_room() -> None:
    stop = found(straight(20.0, 3.5, 0.0), speed=0.0)
    assert stop is not None
    assert (stop.kind, stop.speed) == ("standing", 0.0)
    assert stop.room == pytest.approx(20.0 - LONG, abs=0.02)


def crossing(ahead: float, aside: float, speed: float) -> Stopping:
    """Somebody who comes from the right, across our way."""
    stop = found(straight(ahead + 20.0, -aside - 2.0 * speed, speed, math.pi / 2.0))
    assert stop is not None
    return stop


def test_who_crosses_leaves_room_or_comes_too_late_or_hits() -> None:
    room = crossing(40.0, 12.0, 0.0)
    assert room.kind == "room"
    assert room.room == pytest.approx(40.0 - WIDE / 2.0, abs=0.05)  # from our front to its side
    assert room.needed == pytest.approx(needed(10.0))
    # Too near to stop: we are by before it has come as far as our way, or not.
    near = needed(10.0) - 3.0
    aside = 30.0
    comes = math.sqrt(2.0 * (aside - HALF_LANE) / SETTING_OFF)
    assert comes > (near + LONG) / 10.0
    assert crossing(near, aside, 0.0).kind == "first"
    assert crossing(near, 5.0, 0.0).kind == "short"
    assert crossing(near, aside, 20.0).kind == "short"


def test_it_is_not_known_of_who_was_not_there() -> None:
    ride = made({0: Actor(straight(0.0, 0.0, 10.0))}, 4.0)
    assert stopping(States(ride), 1, 2.0, in_lane=True) is None


def test_a_long_one_from_the_side_has_its_front_to_us() -> None:
    """What is long about it lies beside our way: we are by once past its width."""
    near = needed(10.0) - 3.0
    comes = 0.5 * (near + WIDE / 2.0 + LONG / 2.0) / 10.0 + 0.5 * (near + 6.0 + LONG / 2.0) / 10.0
    aside = HALF_LANE + 6.0 + SETTING_OFF * comes**2 / 2.0
    path = straight(near, -aside, 0.0, math.pi / 2.0)
    ride = made({0: Actor(straight(-20.0, 0.0, 10.0)), 1: Actor(path, "truck", length=12.0)}, 4.0)
    stop = stopping(States(ride), 1, 2.0, in_lane=True)
    assert stop is not None
    assert stop.kind == "first"


def test_one_behind_us_in_our_lane_has_its_distance_and_how_much_faster_it_is() -> None:
    behind = found(straight(-20.0 - LONG - 4.0, 0.0, 12.0))
    assert behind is not None
    assert behind.kind == "behind"
    assert behind.room == pytest.approx(20.0, abs=0.02)
    assert behind.closing == pytest.approx(2.0)
    aside = found(straight(-20.0 - LONG - 4.0, 4.0, 12.0))
    assert aside is not None
    assert (aside.kind, aside.closing) == ("behind", None)


def test_one_beside_our_lane_that_stops_in_our_way_does_not_drive_on() -> None:
    ride = made({0: Actor(straight(0.0, 0.0, 10.0)), 1: Actor(straight(28.0, 4.0, 5.0))}, 4.0)
    joins = stopping(States(ride), 1, 2.0, in_lane=False)
    lies = stopping(States(ride), 1, 2.0, in_lane=False, halts=True)
    assert joins is not None
    assert lies is not None
    assert (joins.kind, lies.kind) == ("joins", "short")
