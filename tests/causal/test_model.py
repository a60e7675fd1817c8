import doctest
import random
from dataclasses import replace
from pathlib import Path

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.record.trace import OUTCOMES, Sample
from tests.traces import (
    Aim,
    End,
    Way,
    World,
    joints,
    prior,
    random_world,
    recorded,
    trace_of,
)
from xavi_dialogue.causal.mixtures import Mixture, Result
from xavi_dialogue.causal.model import CausalModel, InconsistentTrace, shared_out

worlds = st.integers(0, 10_000).map(lambda seed: random_world(random.Random(seed)))


def ends(world: World, plan):
    """Brute force: (prior, end) of a plan under every joint sample."""
    found = []
    for joint in joints(world.aims):
        chosen = {v: (world.aims[v][g].kind, t) for v, g, t in joint}
        found.append((prior(world.aims, joint), world.simulate(plan, chosen)[0]))
    return found


def value(world: World, plan) -> float:
    return sum(p * end.reward for p, end in ends(world, plan))


def test_textbook():
    path = Path(__file__).with_name("textbook.txt")
    failed, tried = doctest.testfile(str(path), module_relative=False)
    assert tried > 10
    assert failed == 0


@given(worlds)
def test_complete_record_agrees_with_enumeration(world):
    model = CausalModel(trace_of(world))
    for first in {plan[0] for plan in world.plans}:
        rivals = [plan for plan in world.plans if plan[0] == first]
        best = max(rivals, key=lambda plan: value(world, plan))
        found = model.intervene((first,))
        assert found is not None
        assert found.value == pytest.approx(value(world, best))
        assert found.coverage == pytest.approx(1.0)
        rows = ends(world, found.plan) if len(found.plan) == 2 else ends(world, best)
        for outcome in OUTCOMES:
            expected = sum(p for p, end in rows if end.outcome == outcome)
            assert found.outcomes[outcome] == pytest.approx(expected)
        done = [(p, end.time) for p, end in rows if end.outcome == "done"]
        if done:
            mean = sum(p * t for p, t in done) / sum(p for p, _ in done)
            assert found.expectation("time") == pytest.approx(mean)
        else:
            assert found.expectation("time") is None


@given(worlds)
def test_any_subset_of_depths_can_be_fixed(world):
    model = CausalModel(trace_of(world))
    for second in {plan[1] for plan in world.plans}:
        rivals = [plan for plan in world.plans if plan[1] == second]
        found = model.intervene({2: second})
        assert found is not None
        assert found.value == pytest.approx(max(value(world, plan) for plan in rivals))


@given(worlds, st.integers(3, 12))
def test_outcomes_exclude_one_another_in_any_record(world, draws):
    model = CausalModel(trace_of(world, draws=draws))
    for plan in world.plans:
        found = model.intervene(plan)
        if found is not None:
            assert sum(found.outcomes.values()) == pytest.approx(1.0)
            assert sum(found.weights) == pytest.approx(1.0)
            assert len({result.joint for result in found.results}) == len(found.results)
            assert 0.0 < found.coverage <= 1.0 + 1e-9


def test_prior_weighs_and_not_the_number_of_draws():
    # 0.9 and 0.1, but each drawn once: the record is complete.
    aims = {1: (Aim("stop", 0.9, (Way(("stop",)),)), Aim("continue", 0.1, (Way(("continue",)),)))}

    def simulate(plan, chosen):
        return End(time=20.0 if chosen[1][0] == "stop" else 10.0), 1

    found = CausalModel(trace_of(World(aims, (("continue",),), simulate))).intervene(("continue",))
    assert found is not None
    assert found.expectation("time") == pytest.approx(19.0)


def test_few_draws_from_many_samples_do_not_lean_towards_the_likely_ones():
    # Vehicle 1 matters; vehicle 2 has forty ways that do not, so that samples are rarely repeated.
    ways = tuple(Way(("continue",), 1.0 / 40.0) for _ in range(40))
    aims = {
        1: (Aim("stop", 0.75, (Way(("stop",)),)), Aim("continue", 0.25, (Way(("continue",)),))),
        2: (Aim("continue", 1.0, ways),),
    }

    def simulate(plan, chosen):
        return End(time=20.0 if chosen[1][0] == "stop" else 10.0), 1

    world = World(aims, (("continue",),), simulate)
    estimates, coverages = [], []
    for seed in range(200):
        found = CausalModel(trace_of(world, draws=16, seed=seed)).intervene(("continue",))
        assert found is not None
        estimates.append(found.expectation("time"))
        coverages.append(found.coverage)
    assert max(coverages) < 0.5
    # 17.5 s; weighing each drawn sample by its prior alone would give more than 18.8 s.
    assert sum(estimates) / len(estimates) == pytest.approx(17.5, abs=0.3)


def test_samples_that_end_early_do_not_gain_weight():
    # Half of the prior mass collides at once; of the rest, only one of two samples was driven on.
    world = random_world(random.Random(1))
    aims = {1: tuple(replace(world.aims[1][0], probability=p, kind=k) for p, k in KINDS)}

    def simulate(plan, chosen):
        if chosen[1][0] == "stop":
            return End("collision", collided_with=1), 1
        return End(time=10.0), 2

    mixed = World(aims, (("continue", "continue"), ("continue", "stop")), simulate)
    full = trace_of(mixed)
    kept = [r for r in full.rollouts if (r.samples[0].goal, len(r.actions)) != (2, 2)]
    kept += [r for r in full.rollouts if r.samples[0].goal == 2 and r.actions[1].action == "stop"]
    model = CausalModel(msgspec.structs.replace(full, rollouts=tuple(kept)))
    found = model.intervene(("continue", "continue"))
    assert found is not None
    assert found.outcomes["collision"] == pytest.approx(0.5)


KINDS = ((0.5, "stop"), (0.25, "exit-left"), (0.25, "exit-right"))


def test_unrecorded_actions_are_told_apart():
    world = random_world(random.Random(3))
    model = CausalModel(trace_of(world))
    assert model.intervene(("exit-left",)) is None
    assert model.intervene((world.plans[0][0], "exit-left")) is None or all(
        len(r.rollout.actions) == 1
        for r in model.intervene((world.plans[0][0], "exit-left")).results
    )


def test_evidence_renormalises_the_prior():
    world = random_world(random.Random(5))
    vehicle = max(world.aims, key=lambda v: len(world.aims[v]))
    only = frozenset({(0, 0)})
    model = CausalModel(trace_of(world), {vehicle: only})
    assert model.choices(vehicle) == {(0, 0): pytest.approx(1.0)}
    found = model.intervene(world.plans[0][:1])
    assert found is not None
    assert found.coverage == pytest.approx(1.0)
    assert all((vehicle, 0, 0) in result.joint for result in found.results)


def test_inconsistent_traces_are_named():
    trace = trace_of(random_world(random.Random(2)))
    first = trace.rollouts[0]
    stray = msgspec.structs.replace(first, samples=(Sample(1, 9, 0),))
    with pytest.raises(InconsistentTrace, match="rollout 0 samples goal 9"):
        CausalModel(msgspec.structs.replace(trace, rollouts=(stray,))).intervene(("continue",))


def test_a_continuation_seen_once_in_a_lucky_sample_is_not_the_best():
    aims = {1: (Aim("stop", 0.8, (Way(("stop",)),)), Aim("continue", 0.2, (Way(("continue",)),)))}

    def simulate(plan, chosen):
        lucky = chosen[1][0] == "continue"
        return End(time=5.0 if lucky else 30.0 if plan[1] == "exit-right" else 10.0), 2

    world = World(aims, (("continue", "continue"), ("continue", "exit-right")), simulate)
    full = trace_of(world)
    rare = [r for r in full.rollouts if r.actions[1].action == "continue" or r.samples[0].goal == 1]
    model = CausalModel(msgspec.structs.replace(full, rollouts=tuple(rare)))
    found = model.intervene(("continue",))
    assert found is not None
    assert found.plan == ("continue", "continue")
    assert found.expectation("time") == pytest.approx(9.0)


def test_the_continuation_is_the_one_that_the_decision_compared():
    """Going on after the stop went well in the likely sample; compared was going right in both."""
    aims = {1: (Aim("continue", 1.0, (Way(("continue",), 0.9), Way(("continue",), 0.1))),)}
    on, right = ("stop", "continue"), ("stop", "exit-right")
    ends = {on: End(time=5.0), right: End(time=9.0)}
    world = World(aims, (on, right), lambda plan, chosen: (ends[plan], 2))
    rows = [(on, ((1, 0, 0),), 1, False), *((right, ((1, 0, k),), 1, True) for k in (0, 1))]
    known = recorded(world, rows)
    assert CausalModel(known).intervene(("stop",)).plan == on
    drives = tuple(
        msgspec.structs.replace(r, weight=(0.9, 0.1)[r.samples[0].trajectory] if r.forced else None)
        for r in known.rollouts
    )
    model = CausalModel(msgspec.structs.replace(known, rollouts=drives))
    assert model.intervene(("stop",)).plan == right
    assert model.intervene(("stop",)).coverage == pytest.approx(1.0)
    assert model.intervene(on).plan == on  # where it is asked for


def test_samples_stand_for_those_that_were_not_drawn_by_how_easily_they_are_missed():
    # Of three draws, 0.5 goes missing with 0.5^3 = 0.125, and 0.3 with 0.7^3 = 0.343.
    odds = {"a": 0.5 * 0.125 / 0.875, "b": 0.3 * 0.343 / 0.657}
    total = sum(odds.values())
    assert shared_out({"a": 0.5, "b": 0.3}, 3) == pytest.approx(
        {"a": 0.5 + 0.2 * odds["a"] / total, "b": 0.3 + 0.2 * odds["b"] / total}
    )


def test_what_cannot_happen_stands_for_nothing():
    assert shared_out({"never": 0.0, "often": 0.5}, 4) == {"never": 0.0, "often": 1.0}
    assert shared_out({"never": 0.0}, 4) == {"never": 0.0}


def test_only_a_collision_with_somebody_counts_as_one_with_a_vehicle():
    world = World({}, (("continue",),), lambda plan, chosen: (End("done"), 1))
    one = recorded(world, [(("continue",), (), 1, False)]).rollouts[0]
    known = (("collision", 2), ("collision", None), ("done", 3), ("collision", 2))
    rows = tuple(
        Result((), msgspec.structs.replace(one, outcome=outcome, collided_with=whom), 1, 1)
        for outcome, whom in known
    )
    assert Mixture(rows, (0.4, 0.3, 0.2, 0.1)).collisions() == {2: pytest.approx(0.5)}


def test_mass_is_shared_out_within_what_goes_on():
    # Half of the mass goes on, so that 0.3 of it is 0.6 of what goes on; after two draws.
    odds = {"a": 0.6 * 0.16 / 0.84, "b": 0.2 * 0.64 / 0.36}
    total = sum(odds.values())
    assert shared_out({"a": 0.3, "b": 0.1}, 2, 0.5) == pytest.approx(
        {"a": 0.3 + 0.1 * odds["a"] / total, "b": 0.1 + 0.1 * odds["b"] / total}
    )


def test_the_actions_at_a_node_are_those_recorded_there():
    aims = {1: (Aim("continue", 0.5, (Way(("continue",)),)), Aim("stop", 0.5, (Way(("stop",)),)))}
    plans = (("continue", "exit-right"), ("stop", "change-left"), ("continue", "stop"))
    world = World(aims, plans, lambda plan, _: (End(time=9.0), len(plan)))
    for given_ in ({}, {1: frozenset({(0, 0)})}):
        model = CausalModel(trace_of(world), given_)
        assert model.options() == ("continue", "stop")
        assert model.options(("continue",)) == ("exit-right", "stop")
        assert model.options(("stop",)) == ("change-left",)
        assert model.options(("continue", "stop")) == ()
        assert model.options(("exit-left",)) == ()


def test_of_continuations_that_nothing_covers_none_is_left_out():
    """The one sample that was drawn cannot be: both continuations are known all the same."""
    aims = {1: (Aim("continue", 1.0, (Way(("continue",)),)),)}
    world = World(aims, (("continue", "stop"), ("continue", "exit-right")),
                  lambda plan, _: (End(time=9.0 if plan[1] == "stop" else 5.0), 2))  # fmt: skip
    found = CausalModel(trace_of(world)).intervene(("continue",))
    assert found is not None
    assert found.plan == ("continue", "exit-right")
    assert CausalModel(trace_of(world)).intervene({2: "stop"}).plan == ("continue", "stop")
    assert CausalModel(trace_of(world)).intervene({2: "exit-left"}) is None
