"""What a decision compared, by its weights, beside what answers tell of it."""

from functools import cache
from pathlib import Path

import pytest
from msgspec.structs import replace

from tests.traces import s1_world, trace_of
from xavi_dialogue.causal.model import CausalModel
from xavi_dialogue.explain.causes.plans.chances import chances
from xavi_dialogue.inspection.comparison import comparison
from xavi_dialogue.inspection.decision_text import Extent, show
from xavi_dialogue.inspection.search_tree import compared
from xavi_dialogue.inspection.trace_files import read

RIDE = Path(__file__).parents[2] / "transcripts" / "rides" / "s1-0.ride.jsonl.gz"


@cache
def recorded():
    """The decision of s1 to move to the left lane."""
    traces = read(RIDE.read_bytes()).traces
    return next(trace for trace in traces if trace.plan[0].action == "change-left")


def test_rewards_are_those_by_which_the_decision_chose():
    trace = recorded()
    rows = comparison(trace)
    assert {row.action: row.value for row in rows} == pytest.approx(compared(trace))
    assert rows[0].chosen
    assert rows[0].action == trace.plan[0].action
    assert all(sum(row.chances.values()) == pytest.approx(1.0, abs=1e-5) for row in rows)


def test_outcomes_weigh_as_their_samples_do():
    """One of the rollouts compared collides: it counts its weight, not one of so many."""
    trace = recorded()
    k, hit = max(
        (pair for pair in enumerate(trace.rollouts) if pair[1].weight is not None),
        key=lambda pair: pair[1].weight,
    )
    crash = replace(hit, outcome="collision", collided_with=1)
    worse = replace(trace, rollouts=(*trace.rollouts[:k], crash, *trace.rollouts[k + 1 :]))
    row = next(r for r in comparison(worse) if r.action == hit.actions[0].action)
    assert row.chances["collision"] == pytest.approx(hit.weight)
    assert f"collision {hit.weight:.1%}" in show(worse, Extent())


def test_what_is_told_is_what_answers_rest_on():
    trace = recorded()
    model = CausalModel(trace)
    for row in comparison(trace):
        known = model.intervene((row.action,))
        assert row.told == known.value
        assert row.collision == chances(known).collision


def test_older_traces_compared_nothing():
    trace = trace_of(s1_world())
    assert comparison(trace) == ()
    assert "What was compared" not in show(trace, Extent())
