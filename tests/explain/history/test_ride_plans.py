"""The decisions of a ride, and the plans that were made again from them."""

from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.events import Event
from planner.record.trace import NotApplicable as Refused
from planner.record.trace import TimedAction, WhatIf
from tests.explain.answers.given import plan, refused
from tests.explain.answers.imagined import Drive, decided
from tests.explain.facts.scenes import Actor, made, straight
from xavi_dialogue.domain.answers import NeedRollout, NotApplicable, NotRecorded, TooLittle
from xavi_dialogue.explain.history.deeds import Deed
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import (
    Ride,
    chose,
    enough,
    planned,
    prediction,
    thin,
)


def ride(*traces: Any, now: float = 20.0, **more: Any) -> Ride:
    return Ride(Record(now, traces, **more))


# --- what is known ------------------------------------------------------------------------------


def test_only_what_was_up_to_now_is_known() -> None:
    events = (Event("action-started", 3.0, "stop"), Event("arrived", 5.0))
    traces = (plan(3.0), plan(5.0), plan(5.1))
    early, late = ride(*traces, now=4.9, events=events), ride(*traces, now=5.0, events=events)
    assert (len(early.traces), len(early.events), early.arrived) == (1, 1, False)
    assert (len(late.traces), len(late.events), late.arrived) == (2, 2, True)
    assert late.times == [3.0, 5.0]
    assert [late.index(t) for t in (2.9, 3.0, 4.9, 5.0, 9.0)] == [None, 0, 0, 1, 1]
    assert late.latest.sim_time == 5.0
    assert refused(lambda: ride(now=7.0).latest) == NotRecorded(gap="gap-in-record", until=7.0)


def test_looking_back_forgets_the_end() -> None:
    whole = ride(plan(3.0), plan(5.0), ended=True)
    assert whole.back(20.0) is whole
    assert whole.back(25.0) is whole
    back = whole.back(4.0)
    assert (back.now, back.ended, len(back.traces)) == (4.0, False, 1)


def test_a_decision_that_knows_a_vehicle_is_looked_for() -> None:
    known = plan(3.0)
    known = replace(known, scene=known.scene | {1: known.scene[0]})
    both = ride(known, plan(5.0))
    assert both.at(6.0) is both.traces[1]
    assert both.at(6.0, 1) is known
    assert both.at(2.9) is None
    assert both.at(6.0, 2) is None


def test_vehicles_are_all_but_ours_and_models_are_kept() -> None:
    actors = {v: Actor(straight(20.0 * v, 0.0, 10.0)) for v in (0, 3, 1)}
    found = made(actors, 3.0)
    assert found.vehicles == (1, 3)
    assert found.model(found.latest) is found.model(found.latest)
    assert found.motion(7).time == ()


# --- the choice of a deed ---


def choice(*traces: Any, ended: float | None = 9.0) -> Any:
    return ride(*traces).choice_of(Deed("stop", 5, 5.0, 6.0, ended))


def test_a_deed_was_chosen_at_the_decision_that_it_names() -> None:
    before, named, late = plan(4.0, "stop"), plan(5.0, "stop"), plan(6.0, "stop")
    assert choice(before, named, late) is named
    assert choice(before, late) is late
    after = plan(7.0, "stop")
    assert choice(before, after) is before
    assert choice(after, plan(8.0, "stop")) is after
    assert choice(plan(9.0, "stop")).sim_time == 9.0
    assert choice(plan(19.0, "stop"), ended=None).sim_time == 19.0
    for other in (plan(4.0, "continue"), plan(4.0, "stop", under_way="stop"), plan(4.0),
                  plan(9.1, "stop")):  # fmt: skip
        assert refused(choice, other) == NotRecorded(gap="gap-in-record", since=6.0)


def test_only_a_free_decision_chooses() -> None:
    assert chose(plan(4.0, "stop", "continue"), "stop")
    assert not chose(plan(4.0, "stop", "continue"), "continue")
    assert not chose(replace(plan(4.0, "stop"), under_way=TimedAction("stop", 3.0)), "stop")
    assert planned(plan(4.0, "stop", "continue")) == ("stop", "continue")
    assert prediction(decided(("stop",), Drive(1.0)), 1).vehicle == 1  # type: ignore[union-attr]
    assert prediction(plan(4.0), 1) is None


# --- plans made again ---------------------------------------------------------------------------

MANY = decided(("continue",), Drive(0.6), Drive(0.4))
RARE = replace(MANY, rollouts=MANY.rollouts[1:])  # 40 % of what may come


def again(trace: Any = RARE, gone: Any = (), **what_if: Any) -> Any:
    scene = {v: s for v, s in trace.scene.items() if v not in gone}
    return replace(trace, what_if=WhatIf(**what_if), scene=scene)


def test_plans_without_vehicles_are_told_from_those_with_all() -> None:
    plain: Any = again(rollouts=40)
    without: Any = again(gone=(1,), removed=1)
    other = again(vehicle=1, goal="stop")
    elsewhere = replace(plain, sim_time=19.0)
    later = replace(plain, decision=99)
    bare = replace(plain, what_if=None)
    seen = again(seen_past=(0,))
    found = ride(RARE, extra=(plain, without, other, elsewhere, later, bare, seen))
    assert found.variants(RARE) == (plain, bare)
    assert found.variants(RARE, (1,)) == (without,)
    assert found.without(RARE, 1) == without
    assert found.original(again(gone=(1,), removed=1)) is RARE
    assert found.original(elsewhere) is elsewhere
    two = ride(RARE, extra=(without, replace(again(gone=(1,), removed=1), seed=1)))
    assert two.without(RARE, 1).seed == 1  # type: ignore[union-attr]


def test_a_plan_without_vehicles_is_asked_for_once() -> None:
    one = refused(ride(RARE).without, RARE, 1)
    assert one == NeedRollout(trace_id=RARE.trace_id, removed=1)
    two = refused(ride(RARE).without, RARE, 3, 1)
    assert two == NeedRollout(trace_id=RARE.trace_id, removed=(1, 3))
    denied = ride(RARE, refused=(one,))
    assert denied.without(RARE, 1) is None
    assert denied.cannot_have(one)
    assert not denied.cannot_have(two)
    assert refused(denied.without, RARE, 2).removed == 2


def test_a_plan_with_another_s_conduct_is_found_by_it() -> None:
    turns = again(vehicle=1, goal="exit-left")
    halts = again(vehicle=1, vehicle_actions=("stop",))
    quick = again(vehicle=1, faster=5.0)
    found = ride(RARE, extra=(again(), halts, quick, turns))
    need = NeedRollout(trace_id=RARE.trace_id, vehicle=1)
    assert found.supposed(RARE, replace(need, goal="exit-left")) is turns
    assert found.supposed(RARE, replace(need, vehicle_actions=("stop",))) is halts
    assert found.supposed(RARE, replace(need, faster=5.0)) is quick
    assert found.supposed(RARE, replace(need, goal="stop")) is None
    assert found.supposed(RARE, replace(need, vehicle=2, goal="exit-left")) is None
    assert found.supposed(replace(RARE, decision=9), replace(need, goal="exit-left")) is None


# --- evidence -----------------------------------------------------------------------------------

STEPS: Any = ("continue",)


def test_evidence_is_enough_for_half_of_what_may_come() -> None:
    model, found = ride(MANY).evidence(MANY, STEPS)
    assert model.trace is MANY
    assert enough(found)
    half = decided(STEPS, Drive(0.5), Drive(0.5))
    half = replace(half, rollouts=half.rollouts[1:])
    assert ride(half).evidence(half, STEPS)[1].coverage == pytest.approx(0.5)
    model, _ = ride(RARE, extra=(replace(MANY, what_if=WhatIf(actions=STEPS)),)).evidence(
        RARE, STEPS
    )
    assert model.trace is not RARE


def needs(*extra: Any, refusals: Any = (), trace: Any = RARE, actions: Any = STEPS) -> Any:
    return refused(ride(trace, extra=extra, refused=refusals).evidence, trace, actions)


def test_more_is_asked_for_in_two_rounds_and_then_refused() -> None:
    first = NeedRollout(trace_id=RARE.trace_id, actions=STEPS, rollouts=40)
    second = replace(first, rollouts=160)
    once, twice = again(actions=STEPS, rollouts=40), again(actions=STEPS, rollouts=160)
    assert needs() == first
    assert needs(once) == second
    assert needs(again(actions=("stop",), rollouts=40)) == first
    thin_ = TooLittle("too-little-evidence", asked=STEPS, distinct=1, needed=11)
    assert needs(once, twice) == thin_
    assert needs(once, refusals=(second,)) == thin_
    assert needs(twice) == first
    busy = replace(RARE, under_way=TimedAction("stop", 19.0))
    assert needs(trace=busy) == thin_
    never = refused(ride(busy).evidence, busy, ("exit-left",))
    assert never == TooLittle("too-little-evidence", asked=("exit-left",), needed=11)


def test_what_turned_out_not_to_apply_is_declined() -> None:
    none = replace(again(actions=("stop", "exit-left")), not_applicable=(
        Refused(("stop",), "exit-left", "there is no road"),))  # fmt: skip
    found = needs(none, actions=("stop", "exit-left"))
    assert found == NotApplicable(("exit-left",), "there is no road", RARE.sim_time)
    assert isinstance(needs(none, actions=("exit-left",)), NeedRollout)
    assert isinstance(needs(none, actions=("stop",)), NeedRollout)


def test_little_evidence_tells_how_little() -> None:
    found = ride(MANY).model(MANY).intervene(STEPS)
    told = thin(("continue",), found).result
    assert told == TooLittle("too-little-evidence", asked=STEPS, distinct=2, needed=11)
