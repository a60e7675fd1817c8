"""Planning again while a manoeuvre is under way: the trace of a driven manoeuvre restores it."""

import math

import msgspec
import pytest

from planner.counterfactuals.resume import resume
from planner.counterfactuals.whatif import WhatIf, WhatIfError, replan
from planner.driving.driver import Driver
from planner.manoeuvres.actions import SIDES
from planner.record.trace import Action, EgoGoal, PlanTrace
from planner.roads.routes import Refusal
from planner.roads.trajectory import Roads
from planner.search.decide import decide
from planner.search.inputs import Frame, Moment, Root, root_at
from sim.scene import EGO, Scene, VehicleState
from tests.planner.worlds import LENGTH, QUICK, WIDTH, before_end, driven, goal, roads, row

DT = 0.1  # [s]


def under_way(
    name: str, aim: EgoGoal, others: dict[int, VehicleState], ego: VehicleState
) -> list[PlanTrace]:
    """Drive among standing vehicles, and keep the decisions taken within a manoeuvre."""
    driver = Driver(roads(name).network, aim, QUICK, seed=1)
    found, time = [], 0.0
    while time < 12.0 and not driver.finished:
        step = driver.step(Scene(round(time, 3), {EGO: ego, **others}), DT)
        command = step.command
        ego = VehicleState(command.position, command.heading, command.speed, 0.0, LENGTH, WIDTH)
        time += DT
        if step.trace is not None and step.trace.under_way is not None:
            found.append(step.trace)
    return found


def standing(name: str, lane: str, to_end: float) -> VehicleState:
    return driven(roads(name).line((lane,)), before_end(name, lane, to_end), (0.0,)).state


@pytest.fixture(scope="module")
def changing() -> list[PlanTrace]:
    """The ego of s1 changes lanes, because it has to turn left."""
    line = roads("s1").line(("main_in_0",))
    ego = driven(line, before_end("s1", "main_in_0", 120.0), (8.0,)).state
    left = EgoGoal("exit_n", 30.0, None)
    traces = under_way("s1", left, {1: standing("s1", "main_in_0", 20.0)}, ego)
    return [trace for trace in traces if trace.under_way and trace.under_way.action in SIDES]


@pytest.fixture(scope="module")
def turning() -> list[PlanTrace]:
    """The ego of s2 turns right."""
    line = roads("s2").line(row("s2", "south_in_0", "right"))
    ego = driven(line, before_end("s2", "south_in_0", 20.0), (8.0,)).state
    return under_way("s2", goal("s2"), {1: standing("s2", "north_in_0", 60.0)}, ego)


def decided_again(trace: PlanTrace, roads: Roads) -> PlanTrace:
    """The same decision, from its trace alone."""
    here = root_at(roads, trace.scene[EGO], trace.sim_time)
    rest = resume(roads, trace)
    assert here is not None
    assert not isinstance(rest, Refusal)
    moment = Moment(trace.decision, trace.sim_time, trace.scene, trace.history, Root(here, rest))
    frame = Frame(roads, trace.goal, trace.settings, trace.seed, trace.vehicle)
    return decide(frame, moment).trace


@pytest.mark.parametrize(
    ("name", "fixture", "action"),
    [("s1", "changing", "change-left"), ("s2", "turning", "exit-right")],
)
def test_a_manoeuvre_under_way_is_restored(
    name: str, fixture: str, action: Action, request: pytest.FixtureRequest
) -> None:
    traces: list[PlanTrace] = request.getfixturevalue(fixture)
    assert len(traces) >= 2
    for trace in traces:
        again = decided_again(trace, roads(name))
        assert again.under_way == trace.under_way
        assert trace.under_way is not None
        assert again.plan[0].action == trace.plan[0].action == action
        assert again.predictions == trace.predictions
        one, other = trace.rollouts[0], again.rollouts[0]
        assert one.outcome == other.outcome
        assert one.components["time"] == pytest.approx(other.components["time"], abs=0.4)
        assert one.path
        assert other.path
        for point in other.path:  # the same line; along it, by a fraction of a second
            assert min(math.dist(point, driven) for driven in one.path) < 2.0


def test_it_is_finished_before_anything_else(changing: list[PlanTrace]) -> None:
    trace, network = changing[0], roads("s1").network
    without = replan(trace, network, WhatIf(removed=1))
    assert without.under_way == trace.under_way
    for rollout in without.rollouts:
        assert rollout.actions[0].action == "change-left"
        assert rollout.outcome != "collision"
    refused = replan(trace, network, WhatIf(("stop",), rollouts=5))
    assert refused.rollouts == trace.rollouts
    reasons = {entry.reason for entry in refused.not_applicable if entry.action == "stop"}
    assert "another manoeuvre is under way" in reasons
    more = replan(trace, network, WhatIf(("change-left", "stop"), rollouts=5))
    fresh = more.rollouts[len(trace.rollouts) :]
    assert [step.action for step in fresh[0].actions][:2] == ["change-left", "stop"]


def test_what_the_record_does_not_hold_is_not_made_up(changing: list[PlanTrace]) -> None:
    last = changing[-1]
    history = last.history[EGO]
    short = msgspec.structs.replace(
        history,
        start=last.sim_time,
        position=history.position[-1:],
        heading=history.heading[-1:],
        speed=history.speed[-1:],
    )
    cut = msgspec.structs.replace(last, history={**last.history, EGO: short})
    with pytest.raises(WhatIfError, match=r"change-left was under way at .* not in the record"):
        replan(cut, roads("s1").network, WhatIf())
