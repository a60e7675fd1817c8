"""Explaining, measured: made-up records, dense tables beside our network, and the report."""

from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from benchmarks.explain import explain
from benchmarks.explain.dense_tables import Uneven, tables
from benchmarks.explain.explain import ExplainReport, Growth, answer, growth, recorded, sizes
from benchmarks.explain.synthetic_traces import FACT, FOIL, complete, made_up
from benchmarks.figures import Watch
from planner.record.trace import OUTCOMES, encode
from planner.record.trace_reading import decode
from tests.causal import oracle
from tests.traces import s1_world, trace_of
from xavi_dialogue.__main__ import app
from xavi_dialogue.causal.model import CausalModel, plan_of
from xavi_dialogue.storage import ride_file

FOLDER = Path(__file__).parents[2] / "transcripts" / "rides"


def by_tables(trace, plan):
    """p(O | do(plan)) from the tables: the actions set, everything else summed out."""
    known = tables(trace)
    chosen = known.outcome[:, *(known.names.index(action) for action in plan)]
    for goals, choices in zip(known.goals[::-1], known.choices[::-1], strict=True):
        chosen = chosen @ (choices @ goals)
    return chosen


@pytest.mark.parametrize("vehicles", [1, 2, 3])
def test_tables_of_a_complete_record_agree_with_ours(vehicles):
    trace = complete(vehicles, 2)
    for plan in {plan_of(rollout) for rollout in trace.rollouts}:
        found = CausalModel(trace).intervene(plan)
        assert by_tables(trace, plan)[:-1] == pytest.approx([found.outcomes[o] for o in OUTCOMES])
        assert by_tables(trace, plan)[-1] == pytest.approx(0.0)


def test_what_was_not_tried_is_unknown_to_the_tables():
    trace = made_up(3, 2, 40)
    plan = plan_of(trace.rollouts[0])
    found = CausalModel(trace).intervene(plan)
    assert found.coverage < 1.0
    assert 1.0 - by_tables(trace, plan)[-1] == pytest.approx(found.coverage)


def test_tables_are_distributions():
    known = tables(made_up(2, 3, 50))
    for table in (*known.goals, *known.choices, *known.actions, known.outcome):
        assert np.sum(table, axis=0) == pytest.approx(np.ones(table.shape[1:]))
    assert known.entries == sum(
        t.size for t in (*known.goals, *known.choices, *known.actions, known.outcome)
    )


def test_plans_of_several_lengths_have_no_tables():
    with pytest.raises(Uneven, match="one length"):
        tables(trace_of(s1_world()))


def test_made_up_decisions_are_real_traces():
    trace = made_up(4, 3, 60)
    assert decode(encode(trace)) == trace
    assert trace == made_up(4, 3, 60) != made_up(4, 3, 60, seed=1)
    assert len(trace.rollouts) == 60
    assert {len(rollout.actions) for rollout in trace.rollouts} == {3}
    assert {rollout.actions[0].action for rollout in trace.rollouts} >= {FACT, FOIL}
    assert sum(oracle.prior_of(trace).values()) == pytest.approx(1.0)
    assert len({r.outcome for r in trace.rollouts}) > 1
    answer(CausalModel(trace))


def test_growth_is_measured_on_every_axis():
    assert {axis for axis, *_ in sizes()} == {"vehicles", "depth", "rollouts"}
    found = growth("depth", 2, 3, 40)
    assert (found.axis, found.vehicles, found.depth, found.rollouts) == ("depth", 2, 3, 40)
    assert found.answer > 0.0


def test_those_answered_are_timed():
    watch = Watch()
    ride = ride_file.load((FOLDER / "s1-0.ride.jsonl.gz").read_bytes())
    recorded("s1", ride, watch)
    assert {"all", "s1 why not stop", "s1 what if stopped"} <= set(watch.taken)
    assert len(watch.taken["all"]) == sum(
        len(taken) for name, taken in watch.taken.items() if name != "all"
    )


def test_the_report_without_pgmpy_and_rides_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr(explain, "available", lambda: False)
    monkeypatch.setattr(explain, "sizes", lambda: iter([("depth", 1, 1, 10)]))
    done = CliRunner().invoke(app, ["bench", "explain", "--rides", str(tmp_path)])
    assert done.exit_code == 0, done.output
    assert "pgmpy is not installed" in done.output
    assert "no recorded rides" in done.output
    notes = []
    found = explain.measure(tmp_path, notes.append)
    assert [row.axis for row in found.growth] == ["depth"]
    assert (found.figures, found.beside, found.paper) == ((), (), ())
    assert len(notes) == 2


def test_pgmpy_beside_ours_is_shown():
    row = explain.Beside(3, 2, 576, 3678, 2.5, 5.0, 2.5, 3.0, 2e-16)
    shown = ExplainReport("explain", (), (Growth("depth", 1, 1, 10, 0.5),), (row,), ()).table()
    assert "3678" in shown
    assert "2.0e-16" in shown
