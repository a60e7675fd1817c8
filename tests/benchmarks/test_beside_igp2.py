"""Our planner beside IGP2: a checkout that is made up, which takes a known time for a decision."""

import shutil
import sys
from pathlib import Path

import msgspec
import pytest

from benchmarks.errors import Igp2Unusable
from benchmarks.igp2 import beside
from benchmarks.igp2.beside import BesideIgp2, beside_igp2, table
from planner.record.trace import PlanTrace
from sim.scene import EGO
from sim.setup import scenario
from xavi_dialogue.vehicle.episode import network_of, start

MAP = Path(scenario.__file__).parents[1] / "scenarios" / "bend" / "bend.xodr"
BUSY = """
import time

def spend(seconds):
    until = time.process_time() + seconds
    while time.process_time() < until:
        pass
"""
MCTS = "from busy import spend\nclass MCTS:\n    def search(self):\n        spend(0.6)\n"
RECOGNITION = """
from busy import spend

class GoalRecognition:
    def update_goals_probabilities(self, vehicle):
        spend(0.1 * vehicle)
"""
TRACES = """
import json

def run(checkout, scenario, seed, steps):
    from igp2.planning.mcts import MCTS
    from igp2.recognition.goalrecognition import GoalRecognition

    print("IGP2 says something")
    for line in (checkout / "traces.jsonl").read_text().splitlines():
        for vehicle in (1, 3):
            GoalRecognition().update_goals_probabilities(vehicle)
        MCTS().search()
        yield json.loads(line)
"""


@pytest.fixture(scope="module")
def recorded() -> list[PlanTrace]:
    bend = scenario.load("bend", seed=0)
    with start(bend, network_of(bend), duration=8.0) as moments:
        traces = [moment.trace for moment in moments if moment.trace is not None]
    return [one for one in traces if len(one.scene) > 1 and one.under_way is None][:2]


@pytest.fixture
def checkout(tmp_path: Path, recorded: list[PlanTrace], monkeypatch: pytest.MonkeyPatch) -> Path:
    """A checkout whose scenario is on the map of `bend`, and which decides twice."""
    folder, examples = tmp_path / "checkout", tmp_path / "examples"
    files = {
        "busy.py": BUSY,
        "igp2/__init__.py": "",
        "igp2/planning/__init__.py": "",
        "igp2/planning/mcts.py": MCTS,
        "igp2/recognition/__init__.py": "",
        "igp2/recognition/goalrecognition.py": RECOGNITION,
        "traces.jsonl": "\n".join(msgspec.json.encode(one).decode() for one in recorded),
    }
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    shutil.copy(MAP, folder)
    end = recorded[-1].scene[EGO].position
    ego = {"type": "MCTSAgent", "goal": {"box": {"center": end}}}
    configs = folder / "scenarios" / "configs"
    configs.mkdir(parents=True)
    config = {"scenario": {"map_path": "bend.xodr"}, "agents": [{"type": "TrafficAgent"}, ego]}
    (configs / "one.json").write_bytes(msgspec.json.encode(config))
    examples.mkdir()
    (examples / "igp2_traces.py").write_text(TRACES)
    monkeypatch.setattr(beside, "EXAMPLES", examples)
    return folder


@pytest.fixture
def rows(checkout: Path) -> tuple[BesideIgp2, ...]:
    return beside_igp2(checkout, Path(sys.executable), lambda _: None, ("one",))


def test_both_decide_in_the_same_scenes(
    rows: tuple[BesideIgp2, ...], recorded: list[PlanTrace]
) -> None:
    assert [(one.time, one.others) for one in rows] == [
        (trace.sim_time, len(trace.scene) - 1) for trace in recorded
    ]
    for row, trace in zip(rows, recorded, strict=True):
        wanted = trace.settings.rollouts
        assert row.igp2.rollouts == wanted
        assert row.ours.rollouts >= wanted  # the comparison of first actions comes on top


def test_times_are_those_of_the_parts(rows: tuple[BesideIgp2, ...]) -> None:
    for row in rows:
        assert 200.0 <= row.igp2.recognition < row.igp2.search  # 0.1 s and 0.3 s: 0.2 s each
        assert row.igp2.search >= 600.0
        both = 2.0 * row.igp2.recognition + row.igp2.search
        assert row.igp2.decision == pytest.approx(both, abs=0.01)
        shown = row.igp2.rollouts / row.igp2.search * 1000.0
        assert row.igp2.rollouts_per_s == pytest.approx(shown, abs=0.1)
        assert row.faster == pytest.approx(row.igp2.decision / row.ours.decision, abs=0.1)


def test_the_table_has_a_row_for_each_scene(rows: tuple[BesideIgp2, ...]) -> None:
    lines = table(rows).splitlines()
    assert len(lines) == 2 + len(rows)
    assert all(f"one {row.time:.1f} s" in lines[2 + k] for k, row in enumerate(rows))


def test_a_folder_that_is_no_checkout_is_named(tmp_path: Path) -> None:
    with pytest.raises(Igp2Unusable, match=r"no checkout of IGP2.*one\.json"):
        beside_igp2(tmp_path, Path(sys.executable), lambda _: None, ("one",))


def test_what_igp2_lacks_is_named_with_the_option_that_mends_it(checkout: Path) -> None:
    (checkout / "busy.py").unlink()
    with pytest.raises(Igp2Unusable, match=r"No module named 'busy'.*--igp2-python"):
        beside_igp2(checkout, Path(sys.executable), lambda _: None, ("one",))


def test_a_missing_python_is_named(checkout: Path, tmp_path: Path) -> None:
    with pytest.raises(Igp2Unusable, match="no-python"):
        beside_igp2(checkout, tmp_path / "no-python", lambda _: None, ("one",))


def test_a_destination_off_the_road_is_named(checkout: Path) -> None:
    config = checkout / "scenarios" / "configs" / "one.json"
    known = msgspec.json.decode(config.read_bytes())
    known["agents"][1]["goal"]["box"]["center"] = [1e5, 1e5]
    config.write_bytes(msgspec.json.encode(known))
    with pytest.raises(Igp2Unusable, match="on no lane"):
        beside_igp2(checkout, Path(sys.executable), lambda _: None, ("one",))
