"""When two would have been where their ways meet."""

import math

import pytest
from msgspec.structs import replace

from planner.record.places import RoadFacts, RoadPlace
from tests.explain.causes.decisions import ride
from tests.explain.facts.scenes import Actor, made, straight
from xavi_dialogue.explain.causes.driving.crossing import Crossing, crossing
from xavi_dialogue.explain.history.ride import Ride


def met(
    speed: float = 10.0,
    *,
    x: float = 60.0,
    theirs: float = 10.0,
    setting_off: bool = False,
    limit: float | None = 14.0,
    until: float = 8.0,
    begin: float = 0.0,
) -> Crossing | None:
    """We drive east at 10 m/s; the other comes north along x, and is at y = 0 after 4 s."""
    other = straight(x, -4.0 * theirs, theirs, math.pi / 2.0)
    place = None if limit is None else RoadPlace("a", 0, 1, limit, False, False)
    facts = None if place is None else RoadFacts({0: place})
    actors = {0: Actor(straight(0.0, 0.0, 10.0)), 1: Actor(other)}
    plain = made(actors, until, roads=lambda _: facts)
    whole = ride(*(replace(t, predictions=()) for t in plain.traces), now=until)
    return crossing(whole, 1, begin, speed, setting_off=setting_off)


def test_both_would_have_been_there() -> None:
    """Where it comes within 2.5 m of our way first is 57.5 m on, or 58 m, as it was sampled."""
    found = met()
    assert found is not None
    assert found.vehicle == 1
    assert found.theirs == pytest.approx(4.0, abs=0.21)
    assert found.ours == pytest.approx(5.8, abs=0.06)
    assert found.ahead == pytest.approx(found.theirs - found.ours)
    slow = met(5.0)
    assert slow is not None
    assert slow.ours == pytest.approx(11.6, abs=0.11)
    later = met(begin=2.0)
    assert later is not None
    assert later.ours == pytest.approx(2.0 + 3.8, abs=0.06)


def test_ways_that_do_not_meet() -> None:
    assert met(x=90.0) is None  # we have not come so far, and plan no farther
    assert met(x=-20.0) is None
    assert met(theirs=0.4) is None  # it hardly moves
    assert met(0.4) is None
    assert met(0.6) is not None
    assert met(0.4, setting_off=True) is not None


@pytest.mark.parametrize(("begin", "known"), [(5.4, True), (6.0, False)])
def test_who_had_crossed_before_counts_for_a_moment(begin: float, known: bool) -> None:
    """It is at our way at 4 s; a second and a half later that still counts."""
    assert (met(begin=begin) is not None) is known


def test_setting_off_takes_a_run_up() -> None:
    """Speeding up by 2.3 m/s2 for 58 m: up to 14 m/s or to 6 m/s, and then so on."""
    found = met(0.0, setting_off=True)
    assert found is not None
    assert found.ours == pytest.approx(14.0 / 2.3 + (58.0 - 98.0 / 2.3) / 14.0, abs=0.05)
    bounded = met(0.0, setting_off=True, limit=6.0)
    assert bounded is not None
    assert bounded.ours == pytest.approx(6.0 / 2.3 + (58.0 - 18.0 / 2.3) / 6.0, abs=0.05)
    rolling = met(6.0, setting_off=True, limit=20.0)  # it does not come to drive so fast
    assert rolling is not None
    assert rolling.ours == pytest.approx((math.sqrt(36.0 + 4.6 * 58.0) - 6.0) / 2.3, abs=0.05)
    fast = met(10.0, setting_off=True, limit=8.0)
    assert fast is not None
    assert fast.ours == pytest.approx(5.8, abs=0.01)
    unknown = met(0.0, setting_off=True, limit=None)
    assert unknown is not None
    assert unknown.ours == pytest.approx(
        13.9 / 2.3 + (58.0 - 13.9**2 / 4.6) / 13.9, abs=0.01
    )  # up to 13.9 m/s


def planning(path: tuple[tuple[float, float], ...], *chances: float) -> Ride:
    """We stand at the origin, about to drive along a path; the other may go on north so."""
    actors = {
        0: Actor(straight(0.0, 0.0, 0.0)),
        1: Actor(straight(20.0, -30.0, 5.0, math.pi / 2.0)),
    }
    whole = made(actors, 4.0)
    last = whole.traces[-1]
    rows = tuple(replace(r, path=path, speed=(5.0,) * len(path)) for r in last.rollouts)
    (known,) = last.predictions
    goal = known.goals[0]
    on = tuple((20.0, -10.0 + 2.0 * k) for k in range(15))
    goals = tuple(
        replace(
            goal,
            probability=p,
            trajectories=(
                replace(goal.trajectories[0], path=on if k == 0 else on[:3], speed=(10.0,) * 15),
            ),
        )
        for k, p in enumerate(chances)
    )
    final = replace(last, rollouts=rows, predictions=(replace(known, goals=goals),))
    return ride(*whole.traces[:-1], final)


EAST = tuple((2.0 * k, 0.0) for k in range(20))


def test_where_both_go_on_from_now_is_foreseen() -> None:
    """The other is at y = -2, near enough to 20 m east of us, four samples after 4 s."""
    found = crossing(planning(EAST, 1.0), 1, 4.0, 5.0)
    assert found is not None
    assert found.theirs == pytest.approx(5.0, abs=0.21)
    assert found.ours == pytest.approx(4.0 + 18.0 / 5.0, abs=0.41)
    assert crossing(planning(EAST, 0.2, 0.8), 1, 4.0, 5.0) is not None
    assert crossing(planning(EAST, 0.19, 0.81), 1, 4.0, 5.0) is None  # hardly possible
    assert crossing(planning(EAST), 1, 4.0, 5.0) is None
    apart = tuple((x + 8.1, y) for x, y in EAST)
    assert crossing(planning(apart, 1.0), 1, 4.0, 5.0) is None  # it does not begin where we are


def test_our_way_is_the_farthest_of_those_that_drive_as_planned() -> None:
    whole = planning(EAST, 1.0)
    last = whole.latest
    on, stop = last.rollouts
    north = tuple((0.0, 3.0 * k) for k in range(30))
    rows = (
        replace(on, path=EAST[:3], speed=(5.0,) * 3),
        replace(on, index=7),
        replace(stop, path=north, speed=(5.0,) * 30),
    )
    known = ride(*whole.traces[:-1], replace(last, rollouts=rows))
    assert crossing(known, 1, 4.0, 5.0) == crossing(whole, 1, 4.0, 5.0)
    other = replace(last, rollouts=rows, plan=(replace(last.plan[0], action="stop"),))
    assert crossing(ride(*whole.traces[:-1], other), 1, 4.0, 5.0) is None
