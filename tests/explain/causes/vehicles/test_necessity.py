"""A cause is tried by planning again without the vehicle; what is refuted is no cause."""

from collections.abc import Mapping

import pytest
from msgspec.structs import replace

from planner.record.trace import Action, PlanTrace, WhatIf
from tests.traces import Aim, World, s1_ride, s1_world, trace_of
from xavi_dialogue.causal.model import Actions
from xavi_dialogue.domain.answers import Cause, ChoiceReason, NeedRollout
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.evidence import Causation
from xavi_dialogue.domain.meaning import Ask, Why
from xavi_dialogue.domain.terms import Event, Happens, Vehicle
from xavi_dialogue.explain.answers.engine import Result, explain
from xavi_dialogue.explain.causes.vehicles import necessity
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride

RIDE = s1_ride()
DECISION = RIDE.traces[1]
WHY = Why(Happens(Event("change-lane", side="left")))
NEED = NeedRollout(trace_id=DECISION.trace_id, removed=1)


def asked(question: Why, *extra: PlanTrace, refused: tuple[NeedRollout, ...] = ()) -> Result:
    record = Record(RIDE.now, RIDE.traces, RIDE.events, extra=extra, refused=refused)
    return explain(GroundedAct(Ask(question)), record)


def without_vehicle_1(best: str, *, others_are_slow: bool) -> PlanTrace:
    """The decision taken again; where the others are slow, the way ahead is as slow as with it."""
    world = s1_world()
    aims: Mapping[int, tuple[Aim, ...]] = {2: world.aims[2]}
    plans: tuple[Actions, ...] = (("change-left", "continue"), ("continue",))
    ahead: tuple[Action, int] = ("exit-right", 0) if others_are_slow else ("continue", 0)
    alone = World(
        aims,
        plans if best == "change-left" else plans[::-1],
        lambda plan, chosen: world.simulate(plan, {**chosen, 1: ahead}),
    )
    return replace(trace_of(alone, draws=24), what_if=WhatIf(removed=1))


def cleared() -> tuple[PlanTrace, ...]:
    """The decision taken again without each of the two, and without both: always the same."""
    alone = without_vehicle_1("change-left", others_are_slow=True)
    gone = (WhatIf(removed=1), WhatIf(removed=2), WhatIf(removed=(1, 2)))
    scenes = ({0, 2}, {0, 1}, {0})
    return tuple(
        replace(alone, what_if=one, scene={v: DECISION.scene[v] for v in sorted(scene)})
        for one, scene in zip(gone, scenes, strict=True)
    )


def test_the_planner_is_asked_first_and_only_for_the_vehicle_that_is_blamed() -> None:
    assert asked(WHY) == NEED


def test_what_makes_the_choice_is_necessary() -> None:
    found = asked(WHY, without_vehicle_1("continue", others_are_slow=False))
    assert isinstance(found, ChoiceReason)
    (cause,) = found.contrast.causes
    assert (cause.vehicle, cause.decision_changes, cause.necessary) == (1, True, True)


def test_what_another_would_do_as_well_is_no_cause_and_is_cleared() -> None:
    found = asked(WHY, *cleared())
    assert isinstance(found, ChoiceReason)
    assert found.contrast.causes == ()
    assert found.contrast.cleared == (1, 2)
    assert found.contrast.causation is not None
    assert found.contrast.causation.kind == "none"


def test_a_suspect_that_is_cleared_is_no_part_of_it() -> None:
    question = replace(WHY, suspect=Vehicle(1))
    found = asked(question, *cleared())
    assert isinstance(found, ChoiceReason)
    assert (found.suspect, found.suspected) == (1, "none")
    found = asked(question, without_vehicle_1("continue", others_are_slow=False))
    assert isinstance(found, ChoiceReason)
    assert found.suspected == "main"


def test_where_the_planner_cannot_be_asked_the_record_speaks() -> None:
    found = asked(WHY, refused=(NEED,))
    assert isinstance(found, ChoiceReason)
    assert found.contrast.causes[0].vehicle == 1
    assert found.contrast.causes[0].necessary is None


@pytest.mark.parametrize(("minimal", "stated"), [(True, [2]), (False, [])])
def test_of_several_that_were_not_tried_alone_those_that_are_needed_are_stated(
    minimal: bool, stated: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    found = Causation("several", (2,), minimal=minimal)
    monkeypatch.setattr(necessity, "actual_causes", lambda *_: found)
    gone = (NEED, replace(NEED, removed=2))
    ride = Ride(Record(RIDE.now, RIDE.traces, RIDE.events, refused=gone))
    model = ride.model(DECISION)
    fact, foil = (model.intervene((action,)) for action in ("change-left", "continue"))
    assert fact is not None
    told = necessity.proven(ride, model, (Cause(1, ("continue",), 0.5),), fact, foil)
    assert [cause.vehicle for cause in told.causes] == stated
    assert told.causation is not None
    assert told.causation.kind == "several"
