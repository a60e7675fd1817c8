"""What speaks for a choice, taken from the planner's own reckoning."""

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.record.trace import COMPONENTS, FORMER, PlanTrace, encode
from planner.record.trace_reading import decode
from planner.rollouts.reward import COSTS
from tests.explain.causes.rides import recorded, single, told
from tests.stories import even, squeezed
from xavi_dialogue.causal.effects import effects
from xavi_dialogue.causal.model import Actions, CausalModel, Intervention, plan_of
from xavi_dialogue.domain.answers import ChoiceReason
from xavi_dialogue.domain.meaning import Why
from xavi_dialogue.domain.terms import Event, Happens, Not
from xavi_dialogue.explain.causes.plans import terms
from xavi_dialogue.explain.causes.plans.contrast import evidence
from xavi_dialogue.explain.causes.plans.terms import Difference, costs_of, differences
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride

RIDES = ("bend-0", "motorway-0", "s1-4", "s2-0", "s3-0", "s4-0", "town-0")


def decided(name: str) -> list[PlanTrace]:
    return [t for t in recorded(name).traces if t.under_way is None and t.plan]


DECISIONS = [trace for name in RIDES for trace in decided(name)[::5]]


def pairs(trace: PlanTrace) -> list[tuple[Intervention, Intervention]]:
    """Every two options of a decision."""
    model = CausalModel(trace)
    plans = [plan for action in model.options() if (plan := model.intervene((action,)))]
    return [(one, other) for one in plans for other in plans if one is not other]


def test_the_terms_of_a_rollout_sum_to_its_reward() -> None:
    for trace in DECISIONS:
        assert trace.costs == COSTS
        for rollout in trace.rollouts:
            assert sum(rollout.terms.values()) == pytest.approx(-rollout.reward, abs=1.2e-3)


def test_the_terms_of_what_was_chosen_sum_to_its_value() -> None:
    """The value of a first action is its mean over the samples that all were compared with."""
    compared = 0
    for trace in DECISIONS:
        first = trace.plan[0]
        costs = [
            (r.weight, sum(r.terms.values()))
            for r in trace.rollouts
            if r.weight is not None and plan_of(r)[:1] == (first.action,)
        ]
        if costs:
            compared += 1
            assert sum(w for w, _ in costs) == pytest.approx(1.0, abs=1e-4)
            assert -sum(w * c for w, c in costs) == pytest.approx(first.value, abs=2e-3)
    assert compared > len(DECISIONS) / 2


@pytest.mark.parametrize("ride", RIDES)
def test_the_terms_of_a_difference_sum_to_that_of_the_values(ride: str) -> None:
    for trace in decided(ride):
        model = CausalModel(trace)
        for foil, fact in pairs(trace):
            found = differences(model, foil, fact)
            for plan in (foil, fact):
                assert sum(costs_of(model, plan).values()) == pytest.approx(-plan.value, abs=0.02)
            assert found.value == pytest.approx(by_value(model, foil, fact), abs=0.03)


def by_value(model: CausalModel, foil: Intervention, fact: Intervention) -> float:
    """By how much the fact is better, from rewards alone: by sample, else by expected reward."""
    there = {r.joint: r.rollout for r in foil.results}
    here = {r.joint: r.rollout for r in fact.results}
    common = {joint: model.prior(joint) for joint in there if joint in here}
    for side, other in ((there, here), (here, there)):
        alone = [r for joint, r in side.items() if joint not in other]
        if any(r.outcome in ("collision", "dead") for r in alone):
            return fact.value - foil.value
    for plan in (foil, fact):
        weights = zip(plan.results, plan.weights, strict=True)
        if sum(w for r, w in weights if r.joint in common) < 0.5:
            return fact.value - foil.value
    total = sum(common.values())
    return sum(p * (here[j].reward - there[j].reward) for j, p in common.items()) / total


@pytest.mark.parametrize("ride", RIDES)
def test_what_is_told_bears_the_verdict_out(ride: str) -> None:
    for trace in decided(ride):
        model = CausalModel(trace)
        for foil, fact in pairs(trace):
            found = differences(model, foil, fact)
            weight = sum(share.cost for share in terms.told(found))
            if found.verdict != "close":
                assert (weight > 0.0) == (found.verdict == "better") == (found.value > 0.0)
                assert abs(found.value) >= found.error


def test_a_trace_without_costs_is_read_by_those_of_its_time() -> None:
    trace = next(t for t in DECISIONS if len(t.plan) and "change-left" in CausalModel(t).options())
    rollouts = tuple(msgspec.structs.replace(r, terms={}) for r in trace.rollouts)
    old = decode(encode(msgspec.structs.replace(trace, costs=None, rollouts=rollouts)))
    assert old.reckoned == FORMER
    assert b"terms" not in encode(old)
    for (foil, fact), (late, soon) in zip(pairs(trace), pairs(old), strict=True):
        known = differences(CausalModel(trace), foil, fact)
        found = differences(CausalModel(old), late, soon)
        assert found.value == pytest.approx(known.value, abs=0.03)
        for term in (*COMPONENTS, "effort", "collision"):
            assert found.terms.get(term, 0.0) == pytest.approx(known.terms.get(term, 0.0), abs=0.02)


def test_other_costs_in_the_trace_give_other_terms() -> None:
    """The weights are read from the trace and from nowhere else."""
    trace = next(t for t in DECISIONS if "change-left" in CausalModel(t).options())
    dear = msgspec.structs.replace(COSTS, effort={**COSTS.effort, "change-left": 7.0})
    rollouts = tuple(
        msgspec.structs.replace(r, terms={}, reward=r.reward - 6.0 * changes(plan_of(r)))
        for r in trace.rollouts
    )
    model = CausalModel(msgspec.structs.replace(trace, costs=dear, rollouts=rollouts))
    for action in model.options():
        plan = model.intervene((action,))
        if plan is not None and plan.outcomes["done"] > 0.99:
            stops = 2.0 * plan.plan.count("stop") + plan.plan.count("change-right")
            effort = costs_of(model, plan).get("effort", 0.0)
            wanted = 7.0 * changes(plan.plan) + stops
            assert effort == pytest.approx(wanted * plan.outcomes["done"])


def changes(plan: Actions) -> int:
    return plan.count("change-left")


def test_equal_options_are_close_and_nothing_is_invented() -> None:
    ride = single(even(10.0))
    why_not = Why(Not(Happens(Event("change-lane", side="left", tense="present"))))
    found = told(ride, why_not, 10.0)
    assert isinstance(found, ChoiceReason)
    assert found.contrast.close
    assert found.contrast.causes == ()
    assert found.contrast.decisive is None


def test_the_risk_of_the_foil_is_kept_and_decides() -> None:
    ride = single(squeezed(10.0), (2,))
    why_not = Why(Not(Happens(Event("change-lane", side="left", tense="present"))))
    found = told(ride, why_not, 10.0)
    assert isinstance(found, ChoiceReason)
    assert found.contrast.collision == pytest.approx(0.7, abs=0.05)
    assert found.contrast.collided_with == 2
    assert found.contrast.decisive == "collision"
    assert not found.contrast.close


costs = st.dictionaries(
    st.sampled_from((*COMPONENTS, "collision", "dead", "late", "effort")),
    st.floats(-50.0, 50.0),
    min_size=1,
)


@given(costs, st.floats(0.0, 4.0))
def test_told_terms_outweigh_what_is_told_against_them(
    costs: dict[terms.Term, float], error: float
) -> None:
    found = Difference(costs, error, {"collision": (0.02, 0.0)})
    said = terms.told(found)
    weight = sum(share.cost for share in said)
    if found.verdict == "better":
        assert weight > 0.0
        assert said[0].cost > 0.0 or said[0].term in terms.STEERING
    if found.verdict == "worse":
        assert weight < 0.0
    if found.verdict == "better" and costs.get("collision", 0.0) > 0.0:
        assert any(share.term == "collision" for share in said)


def test_the_largest_gain_is_told_with_the_reason_that_outweighs_it() -> None:
    found = Difference({"effort": 1.0, "jerk": 0.9, "time": -1.5}, 0.0)
    assert [share.term for share in terms.told(found)] == ["effort", "jerk", "time"]


def test_within_the_error_it_is_close() -> None:
    assert Difference({"time": 2.0}, 2.5).verdict == "close"
    assert Difference({"time": 2.0}, 1.5).verdict == "better"
    assert Difference({"time": -2.0}, 0.9).verdict == "worse"
    assert Difference({"time": 0.2}, 0.0).verdict == "close"


def test_the_error_is_that_of_the_part_that_was_not_tried() -> None:
    weights, values = [0.5, 0.25, 0.25], [1.0, 3.0, 5.0]
    assert terms._error(weights, values, 1.0) == 0.0
    # mean 2.5; sum of squares of w (v - mean): 0.5625 + 0.015625 + 0.390625, times 3/2 and 0.4
    assert terms._error(weights, values, 0.6) == pytest.approx((0.96875 * 1.5 * 0.4) ** 0.5)


def test_evidence_counts_each_simulation_once() -> None:
    ride = single(squeezed(10.0), (2,))
    why_not = Why(Not(Happens(Event("change-lane", side="left", tense="present"))))
    once = told(ride, why_not, 10.0).contrast
    (trace,) = ride.traces
    assert once.evidence.rollouts == 8  # four joint samples of either side
    doubled = msgspec.structs.replace(trace, rollouts=trace.rollouts * 2)
    model = CausalModel(doubled)
    here, there = model.intervene(once.fact), model.intervene((*once.foil, *once.continued))
    assert here is not None
    assert there is not None
    assert here.draws + there.draws == 16
    assert evidence(Ride(Record(10.0, (doubled,))), model, here, there).rollouts == 8
    assert {effect.n for effect in effects(there, here)} <= set(range(1, 9))
