"""What a choice is compared with, and what both sides come to."""

from collections.abc import Sequence
from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.events import Event as Told
from planner.record.places import RoadFacts, RoadPlace, RouteStep
from planner.record.trace import NotApplicable, Outcome, PlanTrace, TimedAction
from tests.explain.causes.decisions import decided, ride
from tests.explain.trust import trusted
from tests.traces import Actions, Aim, Chosen, End, Way
from xavi_dialogue.causal.model import CausalModel
from xavi_dialogue.domain import answers
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.explain.causes.plans.contrast import (
    SameAsPlan,
    against_best,
    alternatives,
    check_applicable,
    contrast,
    factual,
    missed,
)
from xavi_dialogue.explain.causes.plans.natural import natural, on_way, other_way, stopping
from xavi_dialogue.explain.history.ride import Unanswered

approx: Any = pytest.approx  # that compares within tuples, too

SPLIT = {
    1: (
        Aim("exit-left", 0.3, (Way(("exit-left",)),)),
        Aim("continue", 0.7, (Way(("continue",)),)),
    )
}


THREE: tuple[Actions, ...] = (("continue",), ("change-left", "continue"), ("stop", "continue"))


def refusal(work: object) -> object:
    with pytest.raises(Unanswered) as refused:
        work()  # type: ignore[operator]
    return refused.value.result


def plain(plan: Actions = (), **fields: object) -> PlanTrace:
    """Going on takes 12 s, moving left 10 s, stopping 15 s."""
    ends = {"continue": End(time=12.0), "change-left": End(time=10.0), "stop": End(time=15.0)}
    return decided(ends, plan=plan, **fields)  # type: ignore[arg-type]


def test_alternatives_are_other_actions_best_first() -> None:
    model = CausalModel(plain())
    assert [a for a, _ in alternatives(model, "continue")] == [
        ("change-left",),
        ("stop",),
    ]
    assert [a for a, _ in alternatives(model, "change-left")] == [("continue",), ("stop",)]
    assert [a for a, _ in alternatives(model, "exit-straight")] == [("change-left",), ("stop",)]
    assert alternatives(model, "continue", ("stop",)) == []


def test_a_foil_that_was_planned_is_no_foil() -> None:
    trace = plain(("change-left", "continue"))
    events = (
        Told("action-started", 3.5, "change-left", 4),
        Told("action-committed", 4.5, "change-left", 4),
    )
    with pytest.raises(SameAsPlan) as refused:
        contrast(ride(trace, events=events, now=5.0), trace, ("change-left",))
    assert refused.value.foil == ("change-left",)
    assert refused.value.deed is not None
    assert (refused.value.deed.action, refused.value.deed.begin) == ("change-left", 4.5)
    with pytest.raises(SameAsPlan) as refused:
        contrast(ride(trace), trace, ("continue",), ("change-left",))
    assert refused.value.deed is None
    early = (
        Told("action-started", 2.0, "change-left", 1),
        Told("action-committed", 2.9, "change-left"),
    )
    with pytest.raises(SameAsPlan) as refused:
        contrast(ride(trace, events=early, now=5.0), trace, ("change-left",))
    assert refused.value.deed is None  # that was before


def test_what_cannot_be_done_is_declined_with_the_planners_reason() -> None:
    barred = (
        NotApplicable((), "change-right", "there is no lane to the right"),
        NotApplicable(("stop",), "exit-left", "there is no road"),
    )
    model = CausalModel(plain(not_applicable=barred))
    found = refusal(lambda: check_applicable(model, ("change-right",)))
    assert found == answers.NotApplicable(("change-right",), "there is no lane to the right", 4.0)
    found = refusal(lambda: check_applicable(model, ("stop", "exit-left")))
    assert found == answers.NotApplicable(("exit-left",), "there is no road", 4.0)
    found = refusal(lambda: check_applicable(model, ("exit-left",), ("stop",)))
    assert found == answers.NotApplicable(("exit-left",), "there is no road", 4.0)
    check_applicable(model, ("exit-left", "change-right"))  # nobody knows why not
    check_applicable(model, ("change-left", "continue"))
    busy = CausalModel(plain(under_way=TimedAction("change-left", 3.0)))
    found = refusal(lambda: check_applicable(busy, ("exit-left",)))
    assert found == answers.NotApplicable(("exit-left",), "another manoeuvre is under way", 4.0)
    check_applicable(busy, ("exit-left",), ("stop",))


def test_a_plan_is_told_as_far_as_there_is_evidence() -> None:
    trace = plain(("change-left", "exit-left"))
    assert factual(CausalModel(trace), trace).plan == ("change-left", "continue")
    odd = plain(("exit-left",))
    found = refusal(lambda: factual(CausalModel(odd), odd))
    assert isinstance(found, answers.TooLittle)
    assert found.asked == ("exit-left",)


@pytest.mark.parametrize(
    ("plan", "plans", "foil"),
    [
        (("continue",), THREE, ("change-left",)),
        (("change-left", "continue"), THREE, ("continue",)),  # it might have stayed
        (("stop", "continue"), THREE, ("change-left",)),
        (("continue", "change-left"), (*THREE, ("continue", "change-left")), ("stop",)),
        (("continue",), (("continue",),), ()),
    ],
)
def test_the_best_alternative(plan: Actions, plans: Sequence[Actions], foil: Actions) -> None:
    """To drive on up to a change of lanes is no choice against it."""
    found = against_best(ride(plain(plan, plans=plans)), plain(plan, plans=plans))
    assert found.foil == foil
    assert found.fact[0] == plan[0]
    if foil:
        assert found.outcome is not None
        assert found.outcome.name == "done"


def test_a_contrast_tells_both_sides() -> None:
    def ends(plan: Actions, chosen: Chosen) -> End:
        if plan[0] == "change-left" and chosen[1][0] == "exit-left":
            return End("collision", collided_with=1)
        return End(time=10.0 if plan[0] == "change-left" else 12.0, jerk=0.0)

    trace = decided(ends, SPLIT)
    need = refusal(lambda: contrast(ride(trace), trace, ("change-left",)))
    assert need == NeedRollout(trace_id=trace.trace_id, removed=1)
    found = contrast(ride(trace, refused=(need,)), trace, ("change-left",))
    assert (found.fact, found.foil, found.continued) == (
        ("continue",),
        ("change-left",),
        ("continue",),
    )
    assert found.collision == approx(trusted(0.3))
    assert (found.fact_collision, found.collided_with) == (trusted(0.0), 1)
    assert [c.vehicle for c in found.causes] == [1]
    assert (found.verdict, found.decided) == ("better", 4.0)
    assert found.aim is not None
    assert (found.aim.edge, found.aim.destination, found.aim.time) == (
        "out",
        True,
        approx(12.0),
    )
    assert found.evidence.rollouts == 4
    assert found.evidence.distinct_samples == 2
    assert found.evidence.method == "tree"
    (time,) = (e for e in found.effects if e.component == "time")
    assert (time.delta, time.unit) == (approx(-2.0), "s")


def road(turn: str, kind: str = "junction") -> RoadFacts:
    step = RouteStep(40.0, kind, turn, 2 if kind == "roundabout" else None, None, 4, "equal")  # type: ignore[arg-type]
    return RoadFacts({0: RoadPlace("a", 0, 2, 14.0, False, False)}, (step,))


@pytest.mark.parametrize(
    ("foil", "fact", "ends", "facts", "told"),
    [
        (("change-left",), ("continue", "exit-right"), "dead", road("exit-right"), "exit-right"),
        (("change-left",), ("continue", "exit-right"), "done", road("exit-right"), None),
        (("change-left",), ("continue", "exit-right"), "collision", road("exit-right"), None),
        (("change-left",), ("continue",), "dead", road("exit-straight"), None),
        (("continue",), ("exit-right",), "dead", road("exit-right"), None),
        (("exit-left",), ("exit-right",), "dead", road("exit-right"), "exit-right"),
        (("exit-right",), ("exit-left",), "dead", road("exit-right"), None),
        (("change-left",), ("change-right",), "dead", road("exit-straight"), "change-right"),
        (("change-left",), ("continue",), "dead", road("exit-right", "roundabout"), None),
        (("change-left",), ("continue",), "dead", None, None),
        (("stop", "change-left"), ("continue",), "termination", road("exit-right"), None),
    ],
)
def test_what_a_foil_misses_of_our_way(
    foil: Actions, fact: Actions, ends: Outcome, facts: RoadFacts | None, told: str | None
) -> None:
    trace = decided(
        lambda plan, _: End(ends) if plan == foil else End(), plans=[fact, foil], road=facts
    )
    model = CausalModel(trace)
    there, here = model.intervene(foil), model.intervene(fact)
    assert there is not None
    assert here is not None
    assert missed(trace, there, here) == told


@pytest.mark.parametrize(
    ("plan", "foil"),
    [
        (("change-left", "continue"), ("continue",)),
        (("stop", "continue"), ("continue",)),
        (("continue",), ("change-left",)),
    ],
)
def test_what_one_thinks_of_first(plan: Actions, foil: Actions) -> None:
    trace = plain(plan)
    assert natural(ride(trace), trace).foil == foil


WAYS: tuple[Actions, ...] = (
    ("exit-left", "continue"),
    ("exit-right", "continue"),
    ("stop", "exit-left"),
)


@pytest.mark.parametrize(
    ("right", "facts", "foil", "way"),
    [
        (End("dead"), None, ("exit-right",), True),
        (End(time=30.0), None, ("exit-right",), False),
        (End("termination"), road("exit-left"), (), True),
        (End("termination"), None, ("exit-right",), False),
        (End(time=30.0), road("exit-left"), ("exit-right",), False),
    ],
)
def test_against_a_turn_another_way_is_told(
    right: End, facts: RoadFacts | None, foil: Actions, way: bool
) -> None:
    trace = decided(
        {"exit-left": End(), "exit-right": right, "stop": End()}, plans=WAYS, road=facts
    )
    found = other_way(ride(trace), trace)
    assert found is not None
    assert (found.foil, found.way) == (foil, way)
    alone = decided({"exit-left": End(), "stop": End()}, plans=(WAYS[0], WAYS[2]))
    assert other_way(ride(alone), alone) is None
    assert natural(ride(alone), alone).foil == ("stop",)


def test_the_map_has_the_way() -> None:
    trace = decided(
        {"exit-left": End(), "exit-right": End("termination"), "stop": End()}, plans=WAYS
    )
    found = contrast(ride(trace), trace, ("exit-right",))
    there = replace(trace, road=road("exit-left"))
    assert on_way(there, found).way
    assert not on_way(trace, found).way
    assert not on_way(replace(trace, road=road("exit-right")), found).way
    slow = contrast(ride(trace), trace, ("stop",))
    assert not on_way(there, slow).way
    assert not on_way(there, replace(found, outcome=None)).way


def test_a_stop_that_goes_on_is_compared_as_it_is_now() -> None:
    stop = plain(("stop", "continue"))
    ends = {"continue": End(time=12.0), "change-left": End(time=30.0), "stop": End(time=9.0)}
    now = decided(ends, plan=("stop", "continue"), time=6.0)
    whole = ride(stop, now)
    assert stopping(whole, stop, going_on=True).decided == 6.0
    assert stopping(whole, stop, going_on=False).decided == 4.0
    worse = replace(stop, sim_time=6.0)
    assert stopping(ride(stop, worse), stop, going_on=True).decided == 4.0
