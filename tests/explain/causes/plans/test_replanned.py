"""A decision planned again with something supposed: found, better, or leading further."""

from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.light_record import LightSupposed
from planner.record.trace import PlanTrace, WhatIf
from tests.explain.answers.given import refused
from tests.explain.answers.imagined import Drive, decided
from tests.traces import End
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.explain.causes.plans.replanned import gets_further, replanned, saves_time
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride

GREEN = (LightSupposed("J", 0, "G"),)


def made(reward: float = -10.0, steps: int = 11, end: str = "done") -> PlanTrace:
    """A decision of which the plan earns a reward, on a drive of some steps of 2 m."""
    found = decided(("continue",), Drive(1.0, (10.0,) * steps, End(end)))  # type: ignore[arg-type]
    rows = tuple(replace(row, reward=reward) for row in found.rollouts)
    return replace(found, rollouts=rows)


TRACE = made()
NEED = NeedRollout(trace_id=TRACE.trace_id, lights=GREEN)


def ride(*extra: PlanTrace, cannot: Any = ()) -> Ride:
    return Ride(Record(TRACE.sim_time, (TRACE,), extra=extra, refused=cannot))


def test_the_plan_made_again_is_that_of_the_decision_and_of_what_is_supposed() -> None:
    again = replace(TRACE, what_if=WhatIf(lights=GREEN))
    others = (
        replace(again, sim_time=5.0),
        replace(again, decision=99),
        replace(TRACE, what_if=WhatIf(removed=1)),
        replace(TRACE, what_if=WhatIf(lights=GREEN, seen_past=(0,))),
        replace(TRACE, what_if=None),
    )
    assert replanned(ride(*others, again), TRACE, NEED) is again
    assert refused(replanned, ride(*others), TRACE, NEED) == NEED
    assert replanned(ride(*others, cannot=(NEED,)), TRACE, NEED) is None
    past = NeedRollout(trace_id=TRACE.trace_id, lights=GREEN, seen_past=(0,))
    assert replanned(ride(*others, again), TRACE, past) is others[3]


@pytest.mark.parametrize(
    ("reward", "saves"), [(-9.5, True), (-9.51, False), (-10.0, False), (-5.0, True)]
)
def test_a_plan_saves_time_from_half_a_second_on(reward: float, saves: bool) -> None:
    assert saves_time(ride(), TRACE, made(reward)) is saves
    assert saves_time(ride(), TRACE, None) is None
    assert saves_time(ride(), TRACE, replace(made(reward), rollouts=())) is None


@pytest.mark.parametrize(("steps", "further"), [(13, False), (14, True), (16, True), (5, False)])
def test_a_plan_leads_further_from_five_metres_on(steps: int, further: bool) -> None:
    """Drives that run out of time are compared: ours is 20 m long."""
    here = made(end="termination")
    there = made(steps=steps, end="termination")
    assert gets_further(ride(), here, there) is further
    assert not gets_further(ride(), TRACE, there)  # ours arrives
    assert not gets_further(ride(), here, made(steps=steps))
    assert not gets_further(ride(), here, replace(there, rollouts=()))
