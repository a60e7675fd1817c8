"""What docs/causal.md says: its examples run, and its figures are those of the recorded rides."""

import doctest
from pathlib import Path

import pytest

from benchmarks.explain.explain import stories
from benchmarks.explain.factorisations import BEGIN, END, summary, table, written
from xavi_dialogue.explain.history.ride import MIN_COVERAGE, MIN_DISTINCT
from xavi_dialogue.storage import ride_file


def rides(root: Path):
    found = {name: root / "transcripts/rides" / f"{name}-0.ride.jsonl.gz" for name in ("s1", "s2")}
    return {name: ride_file.load(path.read_bytes()) for name, path in found.items()}


def test_the_examples_run(root):
    failed, tried = doctest.testfile(str(root / "docs" / "causal.md"), module_relative=False)
    assert tried > 30
    assert failed == 0


def test_the_figures_are_those_of_the_recorded_rides(root):
    page = (root / "docs" / "causal.md").read_text(encoding="utf-8")
    again = written(page, stories(rides(root)))
    assert again == page, "xavi bench explain --write docs/causal.md writes them anew"


def test_the_thresholds_are_those_in_force(root):
    page = (root / "docs" / "causal.md").read_text(encoding="utf-8")
    assert f"| `MIN_COVERAGE` | {MIN_COVERAGE:g} |" in page
    assert f"| `MIN_DISTINCT` | {MIN_DISTINCT} |" in page


def test_the_two_are_told_apart_by_what_they_are(root):
    rows = stories(rides(root))
    found = summary(rows)
    assert found.foils == len(rows) > 10
    assert found.sums == sum(abs(row.paper_sum - 1.0) > 0.01 for row in rows) > 0
    assert found.done_most == pytest.approx(max(abs(r.done - r.paper_done) for r in rows), abs=0.01)
    assert table(rows).count("\n") == len(rows) + 2


def test_a_page_without_markers_is_refused():
    assert written(f"a\n{BEGIN}\nold\n{END}\nz", ()).startswith(f"a\n{BEGIN}\n```text\nride")
    with pytest.raises(ValueError, match="the page needs"):
        written("a page", ())
