"""Every causal query against brute force, on small random records of every kind."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from planner.record.trace import ACTIONS, OUTCOMES
from tests.causal import checks, oracle
from tests.traces import ragged_trace
from xavi_dialogue.causal.model import CausalModel

seeds = st.integers(0, 5000)  # of records, which are made in the tests: that takes its time
wishes = st.dictionaries(
    st.integers(1, 3),
    st.sampled_from(("continue", "change-left", "stop", "exit-right")),
    max_size=2,
)


@given(seeds, wishes)
def test_interventions_with_any_depths_fixed(seed, do):
    trace = ragged_trace(seed)
    checks.intervention(trace, do)


@given(seeds, wishes, st.randoms(use_true_random=False))
def test_interventions_given_what_others_do(seed, do, rng):
    trace = ragged_trace(seed)
    checks.intervention(trace, do, checks.some_choices(trace, rng))


@given(seeds)
def test_outcomes_expectations_presence_and_collisions(seed):
    trace = ragged_trace(seed)
    for plan in checks.plans(trace):
        checks.mixture(trace, plan)


@given(seeds)
def test_effects(seed):
    trace = ragged_trace(seed)
    for foil in checks.plans(trace):
        checks.effects(trace, foil, checks.plans(trace)[0])


@given(seeds, st.tuples(st.floats(3.0, 8.0), st.floats(0.0, 6.0)) | st.none())
def test_hold_ups(seed, span):
    trace = ragged_trace(seed)
    for plan in checks.plans(trace):
        checks.hold_ups(trace, plan, None if span is None else (span[0], span[0] + span[1]))


@given(seeds)
@settings(max_examples=40)
def test_influence_and_its_null(seed):
    trace = ragged_trace(seed)
    checks.influence(trace)


@given(seeds, wishes, st.sampled_from((None, *OUTCOMES)), st.randoms(use_true_random=False))
def test_what_is_seen(seed, actions, outcome, rng):
    trace = ragged_trace(seed)
    checks.seen(trace, actions, checks.some_choices(trace, rng), outcome)


@given(seeds)
def test_what_is_seen_without_evidence(seed):
    trace = ragged_trace(seed)
    checks.seen(trace, {}, {}, None)


@given(seeds)
def test_the_search_as_a_policy(seed):
    trace = ragged_trace(seed)
    checks.policy(trace)


@given(seeds)
def test_seeing_all_of_the_sample_and_the_plan_is_doing_so(seed):
    """p(R, O | Omega, S): once nothing is left to infer, seeing and doing are one."""
    trace = ragged_trace(seed)
    for plan, joint in {(r[0], r[1]) for r in oracle.rows_of(trace) if r[4] > 0}:
        only = {v: frozenset({(g, t)}) for v, g, t in joint}
        done = CausalModel(trace, only).intervene(plan)
        chance, rows = oracle.seen(trace, dict(enumerate(plan, 1)), only)
        assert chance > 0.0
        assert done is not None
        assert [r.rollout.index for r in done.results] == [row[2].index for _, row in rows]


@given(seeds)
def test_the_law_of_total_probability(seed):
    trace = ragged_trace(seed)
    checks.total(trace)


def test_the_records_are_of_every_kind():
    found = [ragged_trace(seed) for seed in range(150)]
    rollouts = [r for trace in found for r in trace.rollouts]
    assert {r.outcome for r in rollouts} == set(OUTCOMES)
    assert {len(trace.predictions) for trace in found} == {1, 2, 3}
    assert {len(r.actions) for r in rollouts} == {1, 2}
    assert any(r.outcome == "done" and None in r.components.values() for r in rollouts)
    assert any(row[3] > 1 for trace in found for row in oracle.rows_of(trace))
    drawn = [(len({r[1] for r in oracle.rows_of(t)}), len(oracle.prior_of(t))) for t in found]
    assert sum(some < every for some, every in drawn) > 50
    assert any(some == every for some, every in drawn)
    assert any(oracle.mixture(t, p) is None for t in found for p in checks.plans(t, every=True))
    assert set(ACTIONS) >= {a.action for r in rollouts for a in r.actions}


@given(seeds)
def test_errors_are_bounded_by_what_is_not_covered(seed):
    trace = ragged_trace(seed)
    for plan in checks.plans(trace):
        found = CausalModel(trace).intervene(plan)
        assume(found is not None)
        assert 0.0 <= found.error <= max(1.0 - found.coverage, 0.0)
        squares = float(np.sum(np.square(found.weights)))
        assert found.effective == pytest.approx(1.0 / squares)
        bound = math.sqrt(max(1.0 - found.coverage, 0.0) * math.log(40.0) * squares / 2.0)
        assert found.error <= bound + 1e-12
