"""When things happen in the drives imagined, how fast the car is where, and who is believed."""

import math

import numpy as np
import pytest
from msgspec.structs import replace

from planner.record.places import RoadFacts, RoadPlace
from planner.record.trace import Action, TimedAction
from tests.explain.causes.decisions import decided, ride, steady
from tests.explain.facts.scenes import Actor, made
from tests.explain.facts.scenes import speeds as at_speeds
from tests.traces import Aim, Chosen, End, Way
from xavi_dialogue.causal.model import Actions, CausalModel
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.vehicles.course import (
    begins,
    brakes,
    expected,
    hard_braking,
    lines,
    moves_on,
    stands,
)
from xavi_dialogue.explain.causes.vehicles.hindsight import in_hindsight
from xavi_dialogue.explain.causes.vehicles.profile import driven, speeds
from xavi_dialogue.explain.history.motion import Motion


def motion(*values: float) -> Motion:
    count = len(values)
    times = tuple(round(4.0 + 0.2 * k, 3) for k in range(count))
    return Motion(times, ((0.0, 0.0),) * count, (0.0,) * count, values)


def test_lines_have_times_and_headings() -> None:
    """East for a metre, then north; the first half metre has the heading that comes after it."""
    path = ((0.0, 0.0), (0.3, 0.0), (0.6, 0.0), (1.0, 0.0), (1.0, 0.6), (1.0, 0.9))
    trace = decided(
        {"continue": End()}, plans=[("continue",)], lines={"continue": (path, (5.0,) * 7)}
    )
    (found,) = lines(trace).values()
    assert found.time == pytest.approx((4.0, 4.2, 4.4, 4.6, 4.8, 5.0))
    assert found.speed == (5.0,) * 6
    assert found.heading[:4] == (0.0,) * 4
    assert found.heading[4] == pytest.approx(math.atan2(0.6, 0.4))  # from where it last strode
    slow = replace(
        trace, rollouts=(replace(trace.rollouts[0], path=((0.0, 0.0), (0.0, 0.4), (0.0, 0.8))),)
    )
    assert lines(slow)[0].heading == pytest.approx((math.pi / 2.0,) * 3)


def test_lines_are_shared() -> None:
    trace = decided(
        {"continue": End()}, plans=[("continue",)], lines={"continue": steady(5.0, 5.0)}
    )
    row = trace.rollouts[0]
    rows = (
        row,
        replace(row, index=1, path=None, speed=None, same_as=0),
        replace(row, index=2, path=None, speed=None),
        replace(row, index=3, path=None, speed=None, same_as=2),
        replace(row, index=4, speed=()),
    )
    found = lines(replace(trace, rollouts=rows))
    assert set(found) == {0, 1}
    assert found[0] is found[1]


CHANCES = (0.04, 0.46, 0.46, 0.04)


def test_when_it_is_expected_is_a_median_over_the_drives_that_have_it() -> None:
    """Of drives with 4 %, 46 %, 46 % and 4 %, the last never does it."""
    aims = {
        1: tuple(Aim("continue", p, (Way(("continue",)),), str(k)) for k, p in enumerate(CHANCES))
    }
    trace = decided(
        {"continue": End()}, aims, [("continue",)], lines={"continue": steady(5.0, 5.0)}
    )
    plan = CausalModel(trace).intervene(("continue",))
    assert plan is not None
    found = expected(trace, plan, lambda r, _: None if r.index == 3 else float(r.index))
    assert found is not None
    assert found.share == pytest.approx(0.96)
    assert (found.low, found.moment, found.high) == (1.0, 1.0, 2.0)
    assert expected(trace, plan, lambda *_: None) is None
    bare = replace(trace, rollouts=tuple(replace(r, path=None) for r in trace.rollouts))
    assert expected(bare, plan, lambda *_: 1.0) is None
    part = replace(
        trace, rollouts=tuple(replace(r, path=None) if r.index < 2 else r for r in trace.rollouts)
    )
    found = expected(part, plan, lambda r, _: 7.0 if r.index == 2 else None)
    assert found is not None
    assert found.share == pytest.approx(0.92)  # of the half whose lines are known


def test_changes_of_speed_begin_as_they_are_seen() -> None:
    line = motion(8.0, 8.0, 7.0, 5.0, 3.0, 1.0, 0.0, 0.0, 2.0, 4.0)
    rollout = decided({"continue": End()}, plans=[("continue",)]).rollouts[0]

    def when(action: ActionName, names: tuple[Action, ...] = ()) -> float | None:
        return begins(action, names)(rollout, line)

    assert when("slow-down") == pytest.approx(4.2)
    assert when("stop") == when("give-way") == pytest.approx(5.2)
    assert when("speed-up") == pytest.approx(5.4)
    assert when("continue", ("continue",)) == 4.0
    assert when("continue", ("stop",)) is None
    assert moves_on(rollout, motion(0.0, 0.5, 0.9, 1.0, 2.0)) == 4.6
    assert moves_on(rollout, motion(0.0, 0.5)) is None


@pytest.mark.parametrize(("angle", "begun"), [(90.0, 5.0), (-90.0, 5.0), (19.0, 4.4), (30.0, 5.0)])
def test_a_turn_begins_as_the_car_turns(angle: float, begun: float) -> None:
    """It is begun at 4.4 s; from 4.8 to 5.8 s it turns evenly, a fifth of it in each sample."""
    turned = [0.0] * 5 + [0.2 * k for k in range(1, 6)] + [1.0] * 3
    headings = tuple(math.radians(angle * part) for part in turned)
    times = tuple(round(4.0 + 0.2 * k, 3) for k in range(len(turned)))
    line = Motion(times, ((0.0, 0.0),) * len(turned), headings, (5.0,) * len(turned))
    rollout = decided({"continue": End()}, plans=[("continue",)]).rollouts[0]
    turn: Action = "exit-left" if angle > 0.0 else "exit-right"
    steps = (TimedAction("continue", 4.0), TimedAction(turn, 4.4), TimedAction("continue", 6.0))
    found = begins("turn", ("exit-left", "exit-right"))(replace(rollout, actions=steps), line)
    assert found == begun
    lane = (TimedAction("continue", 4.0), TimedAction("change-left", 4.4))
    assert begins("change-lane", ("change-left",))(replace(rollout, actions=lane), line) == 4.4
    short = (TimedAction(turn, 4.4), TimedAction("continue", 4.5))
    assert begins("turn", (turn,))(replace(rollout, actions=short), line) == 4.4


@pytest.mark.parametrize(
    ("values", "hardest", "hard"),
    [
        ((8.0, 8.0, 8.0), 0.0, None),
        ((8.0, 7.8, 7.6, 7.6), 1.0, None),
        ((8.0, 7.2, 6.4, 6.4), 4.0, 4.0),
        ((8.0, 8.0, 7.2, 6.4, 5.6, 5.6), 4.0, 4.2),
        ((9.0, 8.0, 7.0, 7.0, 7.0, 6.0, 5.0, 5.0), 5.0, 4.8),  # the last time
        ((8.0,), 0.0, None),
    ],
)
def test_how_hard_it_brakes(values: tuple[float, ...], hardest: float, hard: float | None) -> None:
    assert brakes(motion(*values)) == pytest.approx(hardest)
    assert hard_braking(motion(*values)) == hard


def test_who_comes_to_stand() -> None:
    assert stands(motion(5.0, 0.1, 5.0))
    assert not stands(motion(5.0, 0.2))
    assert not stands(motion())


# How fast the car is where -----------------------------------------------------------------


def test_speeds_are_expected_by_place() -> None:
    """One drive at 10 m/s, and one that slows to 4 m/s within 8 m and goes no farther."""
    aims = {1: (Aim("continue", 0.75, (Way(("continue",)),)), Aim("stop", 0.25, (Way(("stop",)),)))}
    trace = decided({"continue": End()}, aims, [("continue",)])
    fast, slow = steady(*[10.0] * 50), steady(10.0, 10.0, 10.0, 10.0, 4.0)
    rows = tuple(
        replace(r, path=p, speed=v) for r, (p, v) in zip(trace.rollouts, (fast, slow), strict=True)
    )
    trace = replace(trace, rollouts=rows)
    plan = CausalModel(trace).intervene(("continue",))
    assert plan is not None
    found = speeds(trace, plan)
    assert found is not None
    assert len(found) == 40  # every two metres up to 80
    assert found[0] == pytest.approx(10.0)
    assert found[-1] == pytest.approx(0.75 * 10.0 + 0.25 * 4.0)
    # 6 m at 10 m/s in 0.6 s, then 1.4 m while slowing down: at 6 m still as fast
    assert found[2] == pytest.approx(10.0)
    assert found[3] == pytest.approx(8.5)
    only = replace(trace, rollouts=(rows[0], replace(rows[1], path=None)))
    alone = speeds(only, plan)
    assert alone is not None
    assert alone[-1] == pytest.approx(10.0)
    none = replace(trace, rollouts=tuple(replace(r, speed=None) for r in rows))
    assert speeds(none, plan) is None


def test_how_fast_it_has_driven_where() -> None:
    """From 4 s on at 10 m/s for two seconds, and then at 5 m/s: 20 m, and 5 m for each second."""
    path = at_speeds(0.0, 0.0, ((0.0, 10.0), (6.0, 10.0), (6.2, 5.0), (20.0, 5.0)))
    whole = made({0: Actor(path)}, 9.0)
    trace = next(t for t in whole.traces if t.sim_time == 4.0)
    found = driven(whole, trace)
    assert found is not None
    assert found[4] == pytest.approx(10.0)  # at 10 m
    assert found[11] == pytest.approx(5.0)  # at 24 m
    assert not math.isnan(found[16])  # 34 m
    assert math.isnan(found[18])  # 38 m; it has come 35.5 m
    assert driven(whole.back(6.4), trace) is None
    assert driven(whole.back(6.5), trace) is not None
    still = made({0: Actor(at_speeds(0.0, 0.0, ((0.0, 0.0),)))}, 9.0)
    assert driven(still, still.traces[4]) is None
    assert isinstance(found, np.ndarray)


# What the others turned out to do ----------------------------------------------------------

SPLIT = {
    1: (
        Aim("exit-left", 0.2, (Way(("exit-left",)),)),
        Aim("continue", 0.8, (Way(("continue",)),)),
    )
}


def ends(plan: Actions, chosen: Chosen) -> End:
    return End(time=20.0 if 1 in chosen and chosen[1][0] == "exit-left" else 10.0)


@pytest.mark.parametrize(
    ("left", "later", "weight"),
    [
        (0.6, 5.0, 0.6),
        (0.6, 4.0, 0.2),  # no later than the decision itself
        (1.0, 5.0, 1.0),
        (0.0, 5.0, 0.0),
    ],
)
def test_drives_are_weighed_by_the_last_belief(left: float, later: float, weight: float) -> None:
    known = {1: (replace_chance(SPLIT[1][0], left), replace_chance(SPLIT[1][1], 1.0 - left))}
    first = decided(ends, SPLIT, [("continue",)])
    then = replace(decided(ends, known, [("continue",)]), sim_time=later)
    model = CausalModel(first)
    plan = model.intervene(("continue",))
    assert plan is not None
    found = in_hindsight(ride(first, then), model, plan)
    shares = {r.joint[0][1]: w for r, w in zip(found.results, found.weights, strict=True)}
    assert shares == {0: pytest.approx(weight), 1: pytest.approx(1.0 - weight)}


def replace_chance(aim: Aim, chance: float) -> Aim:
    return Aim(aim.kind, chance, aim.ways, aim.place)


def test_the_road_that_was_taken_counts_more_than_any_belief() -> None:
    first = decided(ends, SPLIT, [("continue",)])
    place = RoadPlace("exit-left", 0, 1, 10.0, False, False)  # the edge of the goal to the left
    taken = replace(decided(ends, SPLIT, [("continue",)], time=6.0), road=RoadFacts({1: place}))
    later = decided(
        ends, {1: (SPLIT[1][1], replace_chance(SPLIT[1][0], 0.2))}, [("continue",)], time=7.0
    )
    model = CausalModel(first)
    plan = model.intervene(("continue",))
    assert plan is not None
    found = in_hindsight(ride(first, taken, later), model, plan)
    assert found.value == pytest.approx(-20.5)
    elsewhere = replace(taken, road=RoadFacts({1: replace(place, edge="unknown")}))
    assert in_hindsight(ride(first, elsewhere), model, plan).value == pytest.approx(plan.value)


def test_where_nothing_fits_the_plan_is_as_it_was() -> None:
    only_on = {1: (Aim("continue", 1.0, (Way(("continue",)),)),)}
    rare = {
        1: (
            Aim("exit-left", 0.985, (Way(("exit-left",)),)),
            Aim("continue", 0.015, (Way(("continue",)),)),
        )
    }
    first = decided(ends, rare, [("continue",)])
    model = CausalModel(first)
    plan = model.intervene(("continue",))
    assert plan is not None
    found = in_hindsight(
        ride(first, decided(ends, only_on, [("continue",)], time=5.0)), model, plan
    )
    assert found.weights == pytest.approx((0.0, 1.0))
    lost = replace(first, rollouts=first.rollouts[:1])  # of the left way alone
    alone = CausalModel(lost).intervene(("continue",))
    assert alone is not None
    same = in_hindsight(ride(lost, decided(ends, only_on, [("continue",)], time=5.0)), model, alone)
    assert same is alone
    gone = in_hindsight(ride(first, decided(ends, {}, [("continue",)], time=5.0)), model, plan)
    assert gone.weights == pytest.approx(plan.weights)
