"""Made-up moments, how decisions grow with them, memory, and the plot."""

import json
import math
import xml.etree.ElementTree as ET
from pathlib import Path

import msgspec
import pytest
from typer.testing import CliRunner

from benchmarks.figures import Figures, Watch, figure, in_columns, mean, quantile
from benchmarks.planning import plan
from benchmarks.planning.dense_scenes import SEEN, SPOTS, crowd
from benchmarks.planning.plan import (
    DEPTHS,
    ROLLOUTS,
    VEHICLES,
    Growth,
    PlanReport,
    bounded,
    crowded,
    growth,
    timed_yardstick,
)
from benchmarks.planning.process_cost import Memory, memory, resident, rides
from benchmarks.svg import Line, Panel, chart
from planner.record.trace import EgoGoal, Settings
from planner.search.decide import decide
from sim.boxes import overlap
from sim.roads.network import Network
from sim.scene import EGO
from sim.setup import scenario
from xavi_dialogue.__main__ import app
from xavi_dialogue.vehicle.episode import network_of

SVG = "{http://www.w3.org/2000/svg}"
SMALL = Settings(rollouts=6, min_rollouts=2, comparisons=2, depth=2)


@pytest.fixture(scope="module")
def motorway() -> Network:
    return network_of(scenario.load("motorway"))


def goal() -> EgoGoal:
    wanted = scenario.load("motorway").goal
    return EgoGoal(wanted.edge, wanted.position, wanted.lane)


@pytest.mark.parametrize("others", [0, 1, 12, 40])
def test_a_crowd_has_as_many_as_wanted_and_nobody_touches(motorway: Network, others: int) -> None:
    _, moment = crowd(motorway, goal(), SMALL, others)
    assert list(moment.scene) == list(range(others + 1))
    assert all(len(track.speed) == SEEN for track in moment.history.values())
    states = list(moment.scene.values())
    assert not any(overlap(a, b) for k, a in enumerate(states) for b in states[:k])
    for name, track in moment.history.items():
        moved = math.dist(track.position[-2], track.position[-1])
        assert moved == pytest.approx(0.2 * track.speed[-1], abs=0.02)
        assert moment.scene[name].position == track.position[-1]


def test_a_smaller_crowd_is_part_of_a_larger_one(motorway: Network) -> None:
    _, few = crowd(motorway, goal(), SMALL, 3)
    _, many = crowd(motorway, goal(), SMALL, 12)
    assert {name: many.scene[name] for name in few.scene} == few.scene


def test_a_crowd_needs_room(motorway: Network) -> None:
    with pytest.raises(ValueError, match="at most 42"):
        crowd(motorway, goal(), SMALL, len(SPOTS) + 1)
    with pytest.raises(ValueError, match="three lanes"):
        crowd(network_of(scenario.load("s2")), goal(), SMALL, 1)


@pytest.mark.slow
def test_a_decision_can_be_taken_in_a_crowd(motorway: Network) -> None:
    trace = decide(*crowd(motorway, goal(), SMALL, 4)).trace
    assert [known.vehicle for known in trace.predictions] == [1, 2, 3, 4]
    assert trace.plan
    assert trace.scene[EGO].speed > 0.0


@pytest.mark.slow
def test_decisions_in_crowds_are_timed_by_the_processor(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[int] = []
    monkeypatch.setattr(plan, "decide", lambda _, moment: seen.append(len(moment.scene) - 1))
    found = crowded((3, 40), (0.0, 1.0))
    assert [(one.name, one.unit, one.n) for one in found] == [
        ("3 others, processor time", "ms", 2),
        ("40 others, processor time", "ms", 2),
    ]
    assert seen == [3, 3, 40, 40]


def test_a_crowd_may_be_farther_ahead(motorway: Network) -> None:
    _, here = crowd(motorway, goal(), SMALL, 2)
    _, there = crowd(motorway, goal(), SMALL, 2, 5.0)
    assert there.scene[EGO] == here.scene[EGO]
    for name in (1, 2):
        moved = math.dist(here.scene[name].position, there.scene[name].position)
        assert moved == pytest.approx(5.0, abs=0.02)


def test_a_watch_takes_the_time_of_its_clock() -> None:
    ticks = iter((1.0, 3.5))
    watch = Watch(lambda: next(ticks))
    with watch.time("it"):
        pass
    assert watch.taken == {"it": [2.5]}


@pytest.mark.slow
def test_growth_has_a_row_for_each_size() -> None:
    rows = growth(0.01, (1, 2), (1,), (5,), 1)
    sizes = [(row.axis, row.vehicles, row.depth, row.rollouts) for row in rows]
    assert sizes == [
        ("vehicles", 1, 4, 100),
        ("vehicles", 2, 4, 100),
        ("depth", 3, 1, 100),
        ("rollouts", 3, 4, 5),
    ]
    for row in rows:
        assert row.decision >= row.recognition + row.search + row.record > 0.0
        assert row.yardsticks == pytest.approx(row.decision / 10.0, abs=0.01)
        assert row.vehicle_steps_per_s > row.rollouts_per_s > 0.0


def report() -> PlanReport:
    row = Growth("vehicles", 1, 4, 100, 50.0, 20.0, 25.0, 5.0, 5.0, 4000.0, 1e6)
    rows = [
        msgspec.structs.replace(row, axis=axis, vehicles=n, depth=n, rollouts=n)
        for axis in ("vehicles", "depth", "rollouts")
        for n in (1, 2, 3)
    ]
    figures = (figure("s1 decision", "ms", [50.0]),)
    return PlanReport(
        bench="plan",
        yardstick=10.0,
        figures=figures,
        growth=tuple(rows),
        memory=(Memory(0.1, 30, 200.0),),
    )


def test_the_report_is_one_object_and_a_table() -> None:
    read = json.loads(msgspec.json.encode(report()))
    assert (read["bench"], len(read["growth"]), len(read["memory"])) == ("plan", 9, 1)
    table = report().table()
    assert "vehicle steps/s" in table
    assert "200.0" in table
    assert "memory" not in msgspec.structs.replace(report(), memory=()).table()


def test_the_plot_is_svg_with_a_panel_for_each_axis() -> None:
    root = ET.fromstring(report().plot())
    assert root.tag == SVG + "svg"
    words = [text.text for text in root.iter(SVG + "text")]
    assert {"vehicles", "depth", "rollouts", "decision", "search", "ms"} <= set(words)
    lines = list(root.iter(SVG + "polyline"))
    assert len(lines) == 3 * 4
    assert all(len(line.attrib["points"].split()) == 3 for line in lines)
    wide, high = float(root.attrib["width"]), float(root.attrib["height"])
    for dot in root.iter(SVG + "circle"):
        assert 0.0 < float(dot.attrib["cx"]) < wide
        assert 0.0 < float(dot.attrib["cy"]) < high


def test_a_chart_is_to_scale_and_escapes_its_words() -> None:
    panel = Panel("a < b", "x", "y", (Line("&", ((1.0, 1.0), (2.0, 2.0))),))
    root = ET.fromstring(chart([panel]))
    zero = [float(text.attrib["x"]) for text in root.iter(SVG + "text") if text.text == "0"]
    near, far = (float(dot.attrib["cx"]) for dot in root.iter(SVG + "circle"))
    assert far - near == pytest.approx(near - max(zero), abs=0.2)
    assert {"a < b", "&"} <= {text.text for text in root.iter(SVG + "text")}
    assert ET.fromstring(chart([Panel("", "", "", ())])) is not None


def test_figures_sum_up_values() -> None:
    values = [float(k) for k in range(101)]
    found = figure("x", "ms", values)
    assert (found.n, found.p50, found.p99, found.most) == (101, 50.0, 99.0, 100.0)
    assert quantile([3.0], 90) == 3.0
    assert (mean([]), mean([1.0, 3.0])) == (None, 2.0)
    assert in_columns([["a", "b"], ["long", "1"]]) == "a     b\nlong  1"
    watch = Watch()
    with watch.time("nothing"):
        pass
    [taken] = watch.figures()
    assert (taken.name, taken.unit, taken.n) == ("nothing", "ms", 1)
    assert "nothing" in Figures("plan", (taken,)).table()


def test_the_sizes_that_are_measured() -> None:
    assert (VEHICLES[0], VEHICLES[-1]) == (1, 12)
    assert (DEPTHS[0], DEPTHS[-1]) == (1, 5)
    assert (ROLLOUTS[0], ROLLOUTS[-1]) == (25, 400)
    assert timed_yardstick() > 0.0
    assert resident() > 1.0


@pytest.mark.slow
def test_memory_is_read_after_every_ride() -> None:
    found = rides(4.0 / 3600.0, ("s2",))
    assert [(one.hours, one.decisions) for one in found] == [(0.0011, 5)]
    assert found[0].resident > 1.0
    [apart] = memory(0.0001)
    assert apart.decisions == 1


def test_the_command_prints_the_report_and_draws_the_plot(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(plan, "measure", lambda hours: report() if hours == 0.0 else None)
    path = tmp_path / "growth.svg"
    done = CliRunner().invoke(app, ["bench", "plan", "--plot", str(path), "--json"])
    assert (done.exit_code, json.loads(done.stdout)["bench"]) == (0, "plan")
    assert path.read_text(encoding="utf-8") == report().plot()
    assert CliRunner().invoke(app, ["bench", "plan"]).stdout == report().table() + "\n"


def test_decisions_in_dense_scenes_have_a_bound_each() -> None:
    dense = [figure(f"{n} others", "ms", [taken]) for n, taken in ((3, 100), (12, 301), (40, 500))]
    assert [target.met for target in bounded(dense)] == [True, False, True]
