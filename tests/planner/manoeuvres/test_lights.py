import pytest

from planner.manoeuvres.actions import expand
from planner.manoeuvres.indicators import AHEAD, EARLY, lights
from planner.manoeuvres.plans import ActionPlan
from planner.record.trace import Action
from planner.roads.roundabouts import Roundabout, roundabout_ahead
from planner.roads.trajectory import Roads
from tests.planner.nets import on_lane, shipped
from tests.planner.worlds import before_end, plan_of, roads, row, situation

SPEED = 8.0  # [m/s]


def shown(
    known: Roads, plan: ActionPlan, arc: float, speed: float = SPEED, then: tuple[Action, ...] = ()
) -> tuple[str, ...]:
    return lights(known, plan, arc, speed, 0.0, then)


@pytest.mark.parametrize(("braking", "lit"), [(0.0, ()), (-0.4, ()), (-0.6, ("brake",))])
def test_the_brake_light_is_for_more_than_letting_it_roll(
    braking: float, lit: tuple[str, ...]
) -> None:
    plan = plan_of("s1", situation("s1", "main_in_0", 20.0), "continue")
    assert lights(roads("s1"), plan, 0.0, SPEED, braking) == lit


def test_who_stands_holds_the_brake() -> None:
    plan = plan_of("s1", situation("s1", "main_in_0", 20.0), "continue")
    assert shown(roads("s1"), plan, 0.0, 0.0) == ("brake",)


def test_a_lane_change_is_indicated_until_it_is_over() -> None:
    plan = plan_of("s1", situation("s1", "main_in_0", 20.0), "change-left")
    assert shown(roads("s1"), plan, 0.0) == ("left",)
    assert shown(roads("s1"), plan, plan.end - 0.1) == ("left",)
    assert shown(roads("s1"), plan, plan.end + 0.1) == ()


@pytest.mark.parametrize("speed", [5.0, 12.0])
def test_a_turn_is_indicated_ahead_of_it(speed: float) -> None:
    here = situation("s1", "main_in_0", before_end("s1", "main_in_0", 90.0), speed)
    plan = plan_of("s1", here, "exit-right")
    begin = 90.0
    lead = max(AHEAD, EARLY * speed)
    assert shown(roads("s1"), plan, begin - lead - 2.0, speed) == ()
    assert shown(roads("s1"), plan, begin - lead + 2.0, speed) == ("right",)
    inside = sum(roads("s1").network.lanes[x].length for x in row("s1", "main_in_0", "right")[1:-1])
    assert shown(roads("s1"), plan, begin + 0.5 * inside, speed) == ("right",)


def test_going_straight_on_shows_nothing() -> None:
    here = situation("s1", "main_in_0", 60.0)
    plan = plan_of("s1", here, "continue")
    assert {shown(roads("s1"), plan, arc) for arc in range(0, 80, 5)} == {()}


def test_what_is_meant_next_is_indicated_when_it_comes_soon() -> None:
    plan = plan_of("s1", situation("s1", "main_in_0", 20.0), "continue")
    for early, lit in ((EARLY - 0.1, ("left",)), (EARLY + 0.1, ())):
        assert shown(roads("s1"), plan, plan.end - early * SPEED, then=("change-left",)) == lit
    assert shown(roads("s1"), plan, plan.end - 1.0, then=("exit-right",)) == ()


def test_on_a_roundabout_only_the_exit_is_indicated() -> None:
    known = shipped("s3")
    here = on_lane(known, "south_in_0", -30.0)
    ring = roundabout_ahead(known, here.location, 100.0)
    assert isinstance(ring, Roundabout)
    past = expand(known, here, "continue-next-exit", None, 100.0)
    assert isinstance(past, ActionPlan)
    seen = [shown(known, past, float(a), then=("exit-right",)) for a in range(int(past.end))]
    assert set(seen[: int(past.end) - 30]) == {()}
    assert seen[-1] == ("right",)
    first = expand(known, here, "exit-right", None, 100.0)
    assert isinstance(first, ActionPlan)
    entered = next(start for name, start in first.path.lanes if name.startswith("ring_"))
    for arc in range(int(first.end)):
        lit = shown(known, first, float(arc))
        assert lit == (() if arc < entered else lit)
    assert shown(known, first, entered + 1.0) == ("right",)
