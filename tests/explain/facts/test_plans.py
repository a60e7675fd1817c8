"""When a plan is another one."""

from collections.abc import Callable, Sequence

import pytest
from msgspec.structs import replace

from planner.events import Event
from planner.road import RoadFacts, RoadPlace, RouteStep
from planner.trace import Action, PlannedAction, PlanTrace, TimedAction
from tests.explain.facts.scenes import Actor, made, straight
from tests.traces import End, trace_of
from tests.traces import World as Plain
from xavi_dialogue.explain.facts.own import changed
from xavi_dialogue.explain.facts.states import States


def place(edge: str, lane: int | None = 0, ring: bool = False, inside: bool = False) -> RoadPlace:
    return RoadPlace(edge, lane, 3, 14.0, inside, ring)


def ring(begin: float, end: float, numbers: dict[float, int]) -> Callable[[float], RoadFacts]:
    """On the ring at some decisions; which exit the route has at others."""

    def roads(time: float) -> RoadFacts:
        number = next((n for since, n in sorted(numbers.items(), reverse=True) if since <= time), 9)
        step = RouteStep(20.0, "roundabout", "exit-left", number, 4, 4, "give-way")
        first = RouteStep(10.0, "junction", "exit-left", None, None, 4, "give-way")
        return RoadFacts({0: place("a", ring=begin <= time <= end)}, (first, step))

    return roads


def plan(
    time: float,
    *actions: Action,
    road: RoadFacts | None = None,
    under_way: Action | None = None,
) -> PlanTrace:
    trace = trace_of(
        Plain({}, (("continue",),), lambda plan, _: (End(), 1)), time=time, decision=int(time)
    )
    steps = tuple(PlannedAction(action, 0.0, 1) for action in actions)
    doing = None if under_way is None else TimedAction(under_way, time)
    return replace(trace, plan=steps, road=road, under_way=doing)


def route(*steps: tuple[float, str, int], ring: bool = False, kind: str = "junction") -> RoadFacts:
    """Junctions ahead of us: how far [m], the turn, how many arms."""
    return RoadFacts(
        {0: place("a", ring=ring)},
        tuple(RouteStep(far, kind, turn, None, None, arms, "equal") for far, turn, arms in steps),  # type: ignore[arg-type]
    )


@pytest.mark.parametrize(
    ("before", "after", "differs"),
    [
        (("continue",), ("continue",), False),
        (("continue",), ("change-left", "continue"), True),
        (("continue",), ("exit-left",), False),  # it has come within reach
        (("change-left",), ("continue",), True),
        (("change-left",), ("change-right",), True),
        (("change-left",), ("continue", "change-left"), False),
        (("exit-left",), ("exit-right",), True),
        (("exit-left", "stop"), ("exit-left",), False),
        (("continue",), ("stop",), True),
    ],
)
def test_when_a_plan_is_another_one(
    before: Sequence[Action], after: Sequence[Action], differs: bool
) -> None:
    found = States(made({0: Actor(straight(0.0, 0.0, 10.0))}, 5.0))
    assert changed(found, plan(3.0, *before), plan(4.0, *after)) is differs


def test_what_was_begun_in_between_is_no_change_of_plan() -> None:
    for since, differs in ((2.5, True), (3.0, False), (3.6, False), (4.0, False), (4.5, True)):
        events = (Event("action-started", since, "change-left", 3),)
        found = States(made({0: Actor(straight(0.0, 0.0, 10.0))}, 5.0, events=events))
        assert changed(found, plan(3.0, "change-left"), plan(4.0, "continue")) is differs
        assert changed(found, plan(3.0, "change-left"), plan(4.0, "change-left")) is False
    assert changed(found, plan(3.0, "change-left", "stop"), plan(4.0, "stop")) is True
    events = (Event("action-started", 3.6, "change-left", 3),)
    found = States(made({0: Actor(straight(0.0, 0.0, 10.0))}, 5.0, events=events))
    assert changed(found, plan(3.0, "change-left", "stop"), plan(4.0, "stop")) is False
    assert changed(found, plan(3.0, "stop"), plan(4.0, "continue")) is True


def test_a_choice_after_what_had_to_be_finished_is_no_change() -> None:
    found = States(made({0: Actor(straight(0.0, 0.0, 10.0))}, 5.0))
    busy = plan(3.0, "change-left", under_way="change-left")
    assert changed(found, busy, plan(4.0, "stop")) is False
    still = plan(4.0, "stop", under_way="change-left")
    assert changed(found, busy, still) is True


@pytest.mark.parametrize(
    ("before", "after", "differs"),
    [
        (route((50.0, "exit-left", 4)), route((40.0, "exit-left", 4)), False),
        (route((50.0, "exit-left", 4)), route((40.0, "exit-right", 4)), True),
        (route((50.0, "exit-left", 4)), route((46.0, "exit-right", 4)), True),
        (route((50.0, "exit-left", 4)), route((46.1, "exit-right", 4)), False),  # another one
        (route((50.0, "exit-left", 4)), route((34.0, "exit-right", 4)), True),
        (route((50.0, "exit-left", 4)), route((33.9, "exit-right", 4)), False),
        (route((50.0, "exit-left", 4)), route((40.0, "exit-right", 3)), False),
        (
            route((50.0, "exit-left", 4)),
            route((40.0, "exit-right", 4), kind="roundabout"),
            False,
        ),
        (
            route((20.0, "exit-left", 4), (60.0, "exit-left", 4)),
            route((50.0, "exit-right", 4)),
            True,
        ),
        (
            route((50.0, "exit-left", 4), (90.0, "exit-left", 4)),
            route((40.0, "exit-left", 4), (80.0, "exit-right", 4)),
            False,  # the first that is on both counts
        ),
        (route((50.0, "exit-left", 4), ring=True), route((40.0, "exit-right", 4)), False),
        (route((50.0, "exit-left", 4)), route((40.0, "exit-right", 4), ring=True), False),
    ],
)
def test_another_turn_at_a_junction_is_another_plan(
    before: RoadFacts, after: RoadFacts, differs: bool
) -> None:
    """Ten metres are driven between the two decisions; six more or less are the same place."""
    found = States(made({0: Actor(straight(0.0, 0.0, 10.0))}, 5.0))
    one, other = plan(3.0, "exit-left", road=before), plan(4.0, "exit-right", road=after)
    assert changed(found, one, other) is differs
    unknown = plan(4.0, "exit-right")
    assert changed(found, one, unknown) is True  # by their actions, where one has no road
    lane = plan(4.0, "change-left", road=after)
    assert changed(found, one, lane) is True
