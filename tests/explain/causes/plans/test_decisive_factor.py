"""What a decision hangs on: the conduct of another, or its absence."""

from collections.abc import Mapping
from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.places import RoadFacts, RoadPlace, RouteStep
from planner.record.trace import HeldUp, NotApplicable, PlanTrace, WhatIf
from tests.explain.causes.decisions import decided, ride, steady
from tests.explain.trust import trusted
from tests.traces import Actions, Aim, Chosen, End, Way
from xavi_dialogue.domain import answers
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.explain.causes.plans.contrast import (
    contrast,
)
from xavi_dialogue.explain.causes.plans.decisive_factor import towards
from xavi_dialogue.explain.causes.plans.options import weighed
from xavi_dialogue.explain.causes.plans.premise import Premise
from xavi_dialogue.explain.history.ride import Ride, Unanswered

approx: Any = pytest.approx  # that compares within tuples, too

SPLIT = {
    1: (
        Aim("exit-left", 0.3, (Way(("exit-left",)),)),
        Aim("continue", 0.7, (Way(("continue",)),)),
    )
}


THREE: tuple[Actions, ...] = (("continue",), ("change-left", "continue"), ("stop", "continue"))


def chance(*parts: float) -> Mapping[int, tuple[Aim, ...]]:
    """What the first vehicle may do, so probable each."""
    return {
        1: tuple(Aim("continue", p, (Way(("continue",)),), str(k)) for k, p in enumerate(parts))
    }


def refusal(work: object) -> object:
    with pytest.raises(Unanswered) as refused:
        work()  # type: ignore[operator]
    return refused.value.result


def plain(plan: Actions = (), **fields: object) -> PlanTrace:
    """Going on takes 12 s, moving left 10 s, stopping 15 s."""
    ends = {"continue": End(time=12.0), "change-left": End(time=10.0), "stop": End(time=15.0)}
    return decided(ends, plan=plan, **fields)  # type: ignore[arg-type]


def road(turn: str, kind: str = "junction") -> RoadFacts:
    step = RouteStep(40.0, kind, turn, 2 if kind == "roundabout" else None, None, 4, "equal")  # type: ignore[arg-type]
    return RoadFacts({0: RoadPlace("a", 0, 2, 14.0, False, False)}, (step,))


def left_if(wins: str) -> PlanTrace:
    """Moving left is quicker only if the other one does so (30 %) or else (70 %)."""

    def ends(plan: Actions, chosen: Chosen) -> End:
        quick = chosen[1][0] == wins
        return End(time=(8.0 if quick else 20.0) if plan[0] == "change-left" else 12.0)

    return decided(ends, SPLIT, THREE[:2], plan=("continue",))


@pytest.mark.parametrize(
    ("wins", "actions", "chance"),
    [("exit-left", ("exit-left",), 0.3), ("continue", ("continue",), 0.7)],
)
def test_the_conduct_of_another_that_would_change_it(
    wins: str, actions: Actions, chance: float
) -> None:
    trace = left_if(wins)
    found = towards(refusing(trace), Premise(trace, None), ("change-left",))
    assert (found.kind, found.vehicle, found.actions) == ("conduct", 1, actions)
    assert found.probability == approx(chance)


def refusing(trace: PlanTrace, *extra: PlanTrace) -> Ride:
    """A ride in which nothing more can be planned."""
    need = NeedRollout(trace_id=trace.trace_id, removed=1)
    return ride(trace, extra=extra, refused=() if extra else (need,))


def test_what_would_never_be_better_hangs_on_nothing() -> None:
    ends = {"continue": End(time=12.0), "change-left": End(time=20.0), "stop": End("dead")}
    trace = decided(ends, SPLIT)
    assert towards(refusing(trace), Premise(trace, None), ("change-left",)).kind == "none"
    dead = towards(refusing(trace), Premise(trace, None), ("stop",))
    assert dead.kind == "none"
    assert dead.contrast is not None


def test_what_does_not_apply_hangs_on_nobody() -> None:
    barred = (NotApplicable((), "exit-left", "there is no road"),)
    trace = plain(not_applicable=barred)
    found = refusal(lambda: towards(refusing(trace), Premise(trace, None), ("exit-left",)))
    assert found == answers.NotApplicable(("exit-left",), "there is no road", 4.0)


def test_an_absence_that_cannot_be_planned_is_not_told() -> None:
    held = HeldUp(1, 4.0, 9.0, "leader", 5.0, 2.0)
    ends = {"continue": End(), "change-left": End(time=20.0, held_up=(held,)), "stop": End()}
    trace = decided(ends, plan=("continue",))
    found = towards(refusing(trace), Premise(trace, None), ("change-left",))
    assert (found.kind, found.vehicle) == ("none", None)


@pytest.mark.parametrize(("stops", "struck"), [(0.05, 2), (0.3, None)])
def test_only_who_is_hit_in_nearly_all_collisions_is_named(
    stops: float, struck: int | None
) -> None:
    going = 1.0 - stops
    aims = {
        1: (Aim("stop", stops, (Way(("stop",)),)), Aim("continue", going, (Way(("continue",)),))),
        2: (Aim("continue", 1.0, (Way(("continue",)),)),),
    }

    def ends(plan: Actions, chosen: Chosen) -> End:
        if plan[0] == "change-left":
            return End("collision", collided_with=1 if chosen[1][0] == "stop" else 2)
        return End()

    trace = decided(ends, aims, THREE[:2])
    needs = tuple(NeedRollout(trace_id=trace.trace_id, removed=gone) for gone in (1, 2, (1, 2)))
    found = contrast(ride(trace, refused=needs), trace, ("change-left",))
    assert (found.collision, found.collided_with) == (approx(trusted(1.0)), struck)
    assert found.outcome is not None
    assert (found.outcome.name, found.outcome.probability) == ("collision", approx(trusted(1.0)))
    assert found.outcome.collided_with == struck
    rows = {r.action: r for r in weighed(ride(trace), Premise(trace, None))}
    assert rows["change-left"].collided_with == struck
    assert [c.vehicle for c in found.causes] == [2, 1]


def test_the_absence_of_another_may_change_it() -> None:
    held = HeldUp(1, 4.0, 9.0, "leader", 5.0, 2.0)
    ends = {
        "continue": End(time=12.0),
        "change-left": End(time=20.0, held_up=(held,)),
        "stop": End(),
    }
    trace = decided(ends, plan=("continue",))
    alone = decided(ends, {}, plan=("change-left", "continue"), what_if=WhatIf(removed=1))
    found = towards(refusing(trace, alone), Premise(trace, None), ("change-left",))
    assert (found.kind, found.vehicle) == ("removal", 1)
    same = decided(ends, {}, plan=("continue",), what_if=WhatIf(removed=1))
    assert towards(refusing(trace, same), Premise(trace, None), ("change-left",)).kind == "none"


GENTLE = steady(*[10.0 - 0.3 * k for k in range(20)])


@pytest.mark.parametrize(("chance", "kind"), [(0.03, "conduct"), (0.01, "none")])
def test_conduct_that_is_hardly_thought_of_is_not_worth_telling(chance: float, kind: str) -> None:
    aims = {
        1: (
            Aim("exit-left", chance, (Way(("exit-left",)),)),
            Aim("continue", 1.0 - chance, (Way(("continue",)),)),
        )
    }

    def ends(plan: Actions, chosen: Chosen) -> End:
        quick = chosen[1][0] == "exit-left"
        return End(time=(8.0 if quick else 20.0) if plan[0] == "change-left" else 12.0)

    trace = decided(ends, aims, THREE[:2], plan=("continue",))
    assert towards(refusing(trace), Premise(trace, None), ("change-left",)).kind == kind


def test_conduct_counts_where_what_was_chosen_was_tried_with_it() -> None:
    """Going on was never tried where the other one turns left."""
    trace = left_if("exit-left")
    rows = tuple(
        r for r in trace.rollouts if r.actions[0].action != "continue" or r.samples[0].goal == 1
    )
    part = replace(trace, rollouts=rows)
    assert towards(refusing(part), Premise(part, None), ("change-left",)).kind == "none"
