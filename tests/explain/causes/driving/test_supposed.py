"""Planning again with what is supposed of another; what the route has next."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pytest
from msgspec.structs import replace

from planner.record.places import RoadFacts, RouteStep
from planner.record.trace import Action, PlanTrace, WhatIf
from tests.explain.causes.decisions import decided, in_the_way, ride
from tests.traces import Actions, Aim, End, Way
from xavi_dialogue.causal.model import CausalModel
from xavi_dialogue.domain.answers import (
    Evidence,
    MotionCause,
    NeedRollout,
    NotRecorded,
    TooLittle,
)
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.explain.causes.driving import suppositions
from xavi_dialogue.explain.causes.driving.stated_reasons import Reasons
from xavi_dialogue.explain.causes.driving.suppositions import (
    compared,
    decision_for,
    known_to,
    otherwise,
    slows_still,
    together,
    without,
)
from xavi_dialogue.explain.causes.plans.natural import on_route
from xavi_dialogue.explain.causes.vehicles.actual import Trial
from xavi_dialogue.explain.causes.vehicles.involved import against
from xavi_dialogue.explain.history.ride import Unanswered

TWO: tuple[Actions, ...] = (("continue",), ("change-left",))


def others(*vehicles: int) -> Mapping[int, tuple[Aim, ...]]:
    return {v: (Aim("continue", 1.0, (Way(("continue",)),)),) for v in vehicles}


def needed(work: object) -> object:
    with pytest.raises(Unanswered) as refused:
        work()  # type: ignore[operator]
    return refused.value.result


def choice(
    going: float, left: float, *vehicles: int, plan: Actions = ("continue",), by: Sequence[int] = ()
) -> PlanTrace:
    """Seconds that going on and moving left take, with who is in the way on the left."""
    held = tuple(in_the_way(v, 4.0, 9.0) for v in by)
    ends = {
        "continue": End(time=going, jerk=0.0),
        "change-left": End(time=left, jerk=0.0, held_up=held),
    }
    return decided(ends, others(*vehicles), TWO, plan=plan)


def again(trace: PlanTrace, *gone: int) -> PlanTrace:
    return replace(trace, what_if=WhatIf(removed=gone[0] if len(gone) == 1 else gone))


def test_a_decision_that_reckons_with_somebody() -> None:
    first, second, third = (
        replace(choice(10.0, 14.0, *v), sim_time=t)
        for t, v in ((4.0, ()), (5.0, (1,)), (6.0, (1,)))
    )
    busy = replace(third, sim_time=7.0, under_way=third.rollouts[0].actions[0])
    whole = ride(first, second, third, busy)
    assert [t.sim_time for t in known_to(whole, 1, 9.0)] == [5.0, 6.0]
    assert [t.sim_time for t in known_to(whole, 1, 5.0)] == [5.0]
    assert decision_for(whole, 1, 6.5).sim_time == 6.0
    assert decision_for(whole, 1, 5.5).sim_time == 5.0
    assert decision_for(whole, 1, 4.0).sim_time == 5.0  # the first after that
    found = needed(lambda: decision_for(whole, 7, 6.0))
    assert found == NotRecorded("out-of-view", thing=Vehicle(7), since=6.0)


def test_without_somebody_it_would_do_so() -> None:
    trace = choice(10.0, 14.0, 1, by=(1,))
    alone = again(choice(10.0, 9.0, plan=("change-left",)), 1)
    found = without(ride(trace, extra=(alone,)), (1,), 4.0)
    assert (found.trace, found.again, found.prior, found.same) == (trace, alone, None, False)
    assert found.here.plan == ("continue",)
    assert found.there.plan == ("change-left",)
    rests_on = found.contrast.evidence
    assert (rests_on.rollouts, rests_on.distinct_samples, rests_on.method) == (2, 2, "rollouts")
    assert rests_on.traces == (trace.trace_id, alone.trace_id)
    assert found.contrast.likely is None
    need = NeedRollout(trace_id=trace.trace_id, removed=1)
    assert needed(lambda: without(ride(trace), (1,), 4.0)) == need
    assert needed(lambda: without(ride(trace, refused=(need,)), (1,), 4.0)) == need
    same = compared(ride(trace), trace, trace, 0.4)
    assert (same.prior, same.same) == (0.4, True)


def test_a_vehicle_that_is_faster_is_planned_again() -> None:
    trace = choice(10.0, 14.0, 1)
    need = NeedRollout(trace_id=trace.trace_id, vehicle=1, faster=5.0)
    assert needed(lambda: otherwise(ride(trace), 1, ("speed-up",), 4.0, negated=False)) == need
    fast = replace(
        choice(10.0, 9.0, 1, plan=("change-left",)), what_if=WhatIf(vehicle=1, faster=5.0)
    )
    found = otherwise(ride(trace, extra=(fast,)), 1, ("speed-up",), 4.0, negated=False)
    assert (found.again, found.same, found.prior, found.proxy) == (fast, False, 0.0, None)


@pytest.mark.parametrize(
    ("name", "goal", "proxy"),
    [
        ("slow-down", "stop", "stop"),
        ("exit-left", "exit-left", None),
        ("leave", "exit-right", "exit-right"),
    ],
)
def test_what_no_sample_has_is_planned_again(name: str, goal: Action, proxy: str | None) -> None:
    trace = choice(10.0, 14.0, 1)
    need = NeedRollout(trace_id=trace.trace_id, vehicle=1, goal=goal)
    assert needed(lambda: otherwise(ride(trace), 1, (name,), 4.0, negated=False)) == need  # type: ignore[arg-type]
    acted = replace(choice(10.0, 14.0, 1), what_if=WhatIf(vehicle=1, goal=goal))
    found = otherwise(ride(trace, extra=(acted,)), 1, (name,), 4.0, negated=False)  # type: ignore[arg-type]
    assert (found.again, found.prior, found.proxy) == (acted, 0.0, proxy)
    refused = needed(
        lambda: otherwise(ride(trace, refused=(need,)), 1, (name,), 4.0, negated=False)  # type: ignore[arg-type]
    )
    assert not isinstance(refused, NeedRollout)


def test_who_is_not_to_leave_stays_on_the_ring() -> None:
    trace = choice(10.0, 14.0, 1)
    need = NeedRollout(trace_id=trace.trace_id, vehicle=1, vehicle_actions=("continue-next-exit",))
    assert needed(lambda: otherwise(ride(trace), 1, ("leave",), 4.0, negated=True)) == need
    stays = replace(
        choice(10.0, 14.0, 1), what_if=WhatIf(vehicle=1, vehicle_actions=("continue-next-exit",))
    )
    found = otherwise(ride(trace, extra=(stays,)), 1, ("leave",), 4.0, negated=True)
    assert (found.again, found.prior) == (stays, 1.0)


def at(turn: str) -> RouteStep:
    return step("junction", turn)


def step(kind: str, turn: str, number: int | None = None) -> RouteStep:
    return RouteStep(20.0, kind, turn, number, None if number is None else 4, 4, "equal")  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("steps", "node", "action", "on_it"),
    [
        ([at("exit-left")], (), "exit-left", True),
        ([at("exit-left")], (), "exit-right", False),
        ([at("exit-straight"), at("exit-left")], (), "exit-left", False),
        ([at("exit-straight"), at("exit-left")], ("continue",), "exit-left", True),
        ([at("exit-right"), at("exit-left")], ("continue",), "exit-left", False),
        ([at("exit-right"), at("exit-left")], ("exit-right",), "exit-left", True),
        ([at("exit-right")], ("exit-right",), "exit-left", False),
        ([step("roundabout", "exit-left", 1)], (), "exit-right", True),
        ([step("roundabout", "exit-left", 1)], (), "exit-left", True),
        ([step("roundabout", "exit-left", 1)], (), "continue-next-exit", False),
        ([step("roundabout", "exit-left", 3)], ("continue-next-exit",), "continue-next-exit", True),
        ([step("roundabout", "exit-left", 3)], ("continue-next-exit",) * 2, "exit-right", True),
        (
            [step("roundabout", "exit-left", 2), step("roundabout", "exit-left", 1)],
            ("continue-next-exit", "exit-right"),
            "exit-right",
            True,
        ),
        ([step("roundabout", "exit-straight", 2)], ("continue",), "continue-next-exit", True),
        ([], (), "exit-right", False),
    ],
)  # fmt: skip
def test_what_the_route_has_next(
    steps: list[RouteStep], node: Actions, action: Action, on_it: bool
) -> None:
    trace = replace(choice(10.0, 14.0), road=RoadFacts({}, tuple(steps)))
    assert on_route(trace, action, node) is on_it


def test_who_is_in_the_way_of_a_foil_is_told_by_what_it_most_probably_does() -> None:
    aims = {
        1: (
            Aim("exit-left", 0.4, (Way(("exit-left",)),)),
            Aim("continue", 0.6, (Way(("continue",)),)),
        )
    }
    model = CausalModel(decided({"continue": End()}, aims, [("continue",)]))
    cause = against(model, 1)
    assert (cause.vehicle, cause.actions, cause.probability) == (1, ("continue",), 0.6)
    assert cause.mechanism is not None
    assert (cause.mechanism.how, cause.mechanism.share) == ("collision", 0.0)


def test_without_several_it_is_planned_again_without_all_of_them() -> None:
    trace = choice(10.0, 14.0, 1, 2, by=(1,))
    alone = again(choice(10.0, 9.0, plan=("change-left",)), 1, 2)
    found = without(ride(trace, extra=(alone,)), (1, 2), 4.0)
    assert (found.again, found.there.plan) == (alone, ("change-left",))
    need = NeedRollout(trace_id=trace.trace_id, removed=(1, 2))
    assert needed(lambda: without(ride(trace), (2, 1), 4.0)) == need
    assert needed(lambda: without(ride(trace, refused=(need,)), (2, 1), 4.0)) == need
    one = again(choice(10.0, 9.0, 2, plan=("change-left",)), 1)
    known = without(ride(trace, extra=(one,)), (7, 1), 4.0)  # 7 is not there anyway
    assert known.again is one


def test_the_conduct_of_several_is_told_from_samples_that_have_it() -> None:
    trace = choice(10.0, 14.0, 1, 2)
    found = together(ride(trace), (1, 2), ("continue",), 4.0, negated=False)
    assert found is not None
    assert (found.again, found.same, found.prior) == (trace, True, 1.0)
    assert together(ride(trace), (1, 2), ("exit-left",), 4.0, negated=False) is None
    assert together(ride(trace), (1, 2), ("continue",), 4.0, negated=True) is None
    assert together(ride(trace), (1, 7), ("continue",), 4.0, negated=False) is None


@pytest.mark.parametrize(
    ("gone", "necessary", "happens"),
    [(True, True, False), (False, False, True), (None, None, None), (True, None, False)],
)
def test_a_way_of_driving_without_one_is_told_by_the_trial_of_its_reason(
    gone: bool | None, necessary: bool | None, happens: bool | None, monkeypatch: Any
) -> None:
    assert _happens(gone, necessary, monkeypatch) is happens


def test_who_is_told_as_a_reason_untried_is_not_said_to_make_no_difference(
    monkeypatch: Any,
) -> None:
    with pytest.raises(Unanswered) as refused:
        _happens(False, None, monkeypatch)
    assert refused.value.result == TooLittle("too-little-evidence")


def _happens(gone: bool | None, necessary: bool | None, monkeypatch: Any) -> bool | None:
    """Whether we brake without vehicle 1, by what the trial shows and what is told of it."""
    monkeypatch.setattr(suppositions, "trial_of", lambda *args: Trial(gone))
    for name in ("factual", "in_hindsight"):
        monkeypatch.setattr(suppositions, name, lambda *args: None)
    whole: Any = type("Made", (), {"model": lambda self, trace: None})()
    trace: Any = None
    causes = (MotionCause("blocked", vehicle=1, necessary=necessary),)
    return suppositions.happens_without(whole, Reasons(causes, None, Evidence(), trace), (1,))


@pytest.mark.parametrize(
    ("as_was", "without", "still"),
    [
        ((11.0, 8.0, 4.0, 5.0), (11.0, 9.0, 6.0, 6.0), True),  # less, and for the bend
        ((11.0, 8.0, 4.0, 5.0), (11.0, 8.0, 4.0, 5.0), True),
        ((11.0, 8.0, 4.0, 5.0), (11.0, 11.0, 10.0, 11.0), False),
        ((11.0, 10.5, 10.0, 10.5), (11.0, 10.6, 10.3, 10.5), False),  # too little to tell
    ],
)
def test_what_slows_us_all_the_same(
    as_was: tuple[float, ...], without: tuple[float, ...], still: bool, monkeypatch: Any
) -> None:
    profiles = iter((np.array(as_was), np.array(without)))
    monkeypatch.setattr(suppositions, "speeds", lambda *_: next(profiles))
    trace = choice(10.0, 14.0, 1)
    assert slows_still(compared(ride(trace), trace, trace, None)) == still
