"""Whether others than the vehicles told as causes mattered for what we did."""

import pytest
from msgspec.structs import replace

from planner.record.trace import PlanTrace, WhatIf
from sim.scene import EGO
from tests.explain.answers.given import NOW, Given
from tests.explain.answers.imagined import Drive, decided
from xavi_dialogue.domain.answers import (
    Cause,
    ChoiceReason,
    Contrast,
    Evidence,
    Measures,
    NeedRollout,
    NobodyElse,
)
from xavi_dialogue.domain.evidence import Causation
from xavi_dialogue.explain.answers.reasons.nobody_else import mattered
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride


def seen(*vehicles: int) -> PlanTrace:
    """The decision to drive on, with vehicles in view."""
    trace = decided(("continue",), Drive(1.0))
    other = trace.scene[1]
    return replace(trace, scene={EGO: trace.scene[EGO], **dict.fromkeys(vehicles, other)})


def without(trace: PlanTrace, *vehicles: int, plan: str = "continue") -> PlanTrace:
    """The same decision made again without vehicles."""
    first = replace(trace.plan[0], action=plan)
    gone = vehicles[0] if len(vehicles) == 1 else vehicles
    rollouts = decided((plan,), Drive(1.0)).rollouts  # type: ignore[arg-type]
    scene = {v: state for v, state in trace.scene.items() if v not in vehicles}
    tried = WhatIf(removed=gone)
    return replace(trace, scene=scene, plan=(first,), rollouts=rollouts, what_if=tried)


def told(trace: PlanTrace, *extra: PlanTrace, causation: Causation | None = None) -> object:
    """Return the answer about others, where vehicle 1 is the cause of that decision."""
    ride = Ride(Record(NOW + 9.0, (trace, replace(trace, sim_time=NOW + 9.0)), extra=extra))
    contrast = Contrast(
        fact=("continue",), foil=("stop",), outcome=None, effects=(),
        causes=(Cause(1, ("continue",), 1.0),), decided=trace.sim_time,
        evidence=Evidence(traces=(trace.trace_id,)), causation=causation,
    )  # fmt: skip
    given = Given().asked()
    scene = Asked(ride, given.world, given.span, given.act)
    return mattered(scene, ChoiceReason("why", None, contrast))


def test_nobody_else_was_there() -> None:
    assert told(seen(1)) == NobodyElse((1,), (), False, NOW)


def test_the_decision_is_made_again_without_all_others() -> None:
    with pytest.raises(Unanswered) as raised:
        told(seen(1, 2, 3))
    assert isinstance(raised.value.result, NeedRollout)
    assert raised.value.result.removed == (2, 3)


def test_they_do_not_matter_where_the_same_is_done_without_them() -> None:
    trace = seen(1, 2, 3)
    assert told(trace, without(trace, 2, 3)) == NobodyElse((1,), (2, 3), False, NOW)


@pytest.mark.parametrize(
    ("plans", "matter"),
    [(("continue", "stop"), (3,)), (("stop", "stop"), (2, 3)), (("continue", "continue"), (2, 3))],
)
def test_those_who_matter_alone_are_told(plans: tuple[str, str], matter: object) -> None:
    trace = seen(1, 2, 3)
    singly = [without(trace, v, plan=plan) for v, plan in zip((2, 3), plans, strict=True)]
    found = told(trace, without(trace, 2, 3, plan="stop"), *singly)
    assert found == NobodyElse((1,), matter, True, NOW)  # type: ignore[arg-type]


def test_who_would_have_come_in_its_place_is_a_cause() -> None:
    found = told(seen(1, 2), causation=Causation("pre-empted", (1, 2)))
    assert found == NobodyElse((1, 2), (), False, NOW)


def test_a_reply_without_a_reason_stays() -> None:
    answer = Measures(())
    assert mattered(Given().asked(), answer) == answer
