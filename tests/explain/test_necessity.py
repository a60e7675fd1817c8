"""A cause is tried by planning again without the vehicle."""

from collections.abc import Mapping

from msgspec.structs import replace

from planner.trace import PlanTrace, WhatIf
from tests.explain.asking import told
from tests.traces import Aim, World, s1_ride, s1_world, trace_of
from xavi_dialogue.explain.engine import explain
from xavi_dialogue.explain.explanation import Explanation, NeedRollout
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.record import Record

RIDE = s1_ride()
DECISION = RIDE.traces[1]
QUERY = Query(type="why", factual=("change-left",))
NEED = NeedRollout(trace_id=DECISION.trace_id, removed=1)


def record(*extra: PlanTrace, refused: tuple[NeedRollout, ...] = ()) -> Record:
    return Record(RIDE.now, RIDE.traces, RIDE.events, extra=extra, refused=refused)


def without_vehicle_1(best: str, *, others_are_slow: bool) -> PlanTrace:
    """The decision taken again; where the others are slow, the way ahead is as slow as with it."""
    world = s1_world()
    aims: Mapping[int, tuple[Aim, ...]] = {2: world.aims[2]}
    plans = (("change-left", "continue"), ("continue",))
    ahead = ("exit-right", 0) if others_are_slow else ("continue", 0)
    alone = World(
        aims,
        plans if best == "change-left" else plans[::-1],
        lambda plan, chosen: world.simulate(plan, {**chosen, 1: ahead}),
    )
    return replace(trace_of(alone, draws=24), what_if=WhatIf(removed=1))


def test_the_planner_is_asked_first_and_only_for_the_vehicle_that_is_blamed() -> None:
    assert explain(QUERY, record()) == NEED


def test_what_makes_the_choice_is_necessary() -> None:
    found = explain(QUERY, record(without_vehicle_1("continue", others_are_slow=False)))
    assert isinstance(found, Explanation)
    (cause,) = found.causes
    assert (cause.vehicle, cause.decision_changes, cause.necessary) == (1, True, True)


def test_what_another_would_do_as_well_is_doubted() -> None:
    found = explain(QUERY, record(without_vehicle_1("change-left", others_are_slow=True)))
    assert isinstance(found, Explanation)
    (cause,) = found.causes
    assert (cause.vehicle, cause.decision_changes, cause.necessary) == (1, False, False)


def test_where_the_planner_cannot_be_asked_the_record_speaks() -> None:
    found = explain(QUERY, record(refused=(NEED,)))
    assert isinstance(found, Explanation)
    assert found.causes[0].vehicle == 1
    assert found.causes[0].decision_changes is None
    assert found.causes[0].necessary is None
    assert told(QUERY, record()) == found


def test_where_the_answer_is_all_about_it_there_is_none_without() -> None:
    query = Query(type="what_if", actor="vehicle:1", negated=True)
    assert told(query, record(refused=(NEED,))) == NEED
