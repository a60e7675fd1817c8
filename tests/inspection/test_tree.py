"""The search tree rebuilt from a trace, and its text."""

import gzip
import json
from collections.abc import Iterator
from pathlib import Path

import msgspec
import pytest
from typer.testing import CliRunner, Result

from planner.record.trace import HeldUp, PlanTrace, TimedAction, encode
from tests.traces import s1_ride, s1_world, trace_of
from xavi_dialogue.__main__ import app
from xavi_dialogue.inspection.decision_text import Extent, listing, show
from xavi_dialogue.inspection.search_tree import (
    Branch,
    TreeError,
    compared,
    grow,
    hindrances,
    replayed,
)
from xavi_dialogue.inspection.trace_files import TraceFileError, choose, read
from xavi_dialogue.storage.ride_file import RecordedRide, dump

GOLDEN = Path(__file__).parent / "golden"
TRACE = GOLDEN / "s1_lane_change.json.gz"


@pytest.fixture(scope="module")
def recorded() -> PlanTrace:
    """A decision that was taken in s1: the ego begins to change to the left lane."""
    return read(TRACE.read_bytes()).traces[0]


def ride_of(*traces: PlanTrace) -> bytes:
    return dump(RecordedRide("s1", 0, 4.0, list(traces)))


def every(branch: Branch) -> Iterator[Branch]:
    yield branch
    for child in branch.children:
        yield from every(child)


def xavi(*arguments: str, stdin: bytes = b"") -> Result:
    return CliRunner().invoke(app, ["trace", "show", *arguments], input=stdin)


def test_a_recorded_decision_is_shown_as_it_was(recorded: PlanTrace) -> None:
    golden = (GOLDEN / "s1_lane_change.txt").read_text(encoding="utf-8")
    assert show(recorded, Extent()) + "\n" == golden


def test_replayed_back_ups_give_the_values_that_the_search_had(recorded: PlanTrace) -> None:
    edges = replayed(recorded).edges
    first, *later = recorded.plan
    assert later
    node = (first.action,)
    for planned in later:
        edge = edges[node][planned.action]
        assert (round(edge.value, 3), edge.visits) == (planned.value, planned.visits)
        node = (*node, planned.action)


def test_the_chosen_action_did_best_where_all_were_tried_alike(recorded: PlanTrace) -> None:
    alike = compared(recorded)
    assert len(alike) > 1
    assert max(alike, key=lambda action: alike[action]) == recorded.plan[0].action
    assert round(max(alike.values()), 3) == recorded.plan[0].value


def test_no_comparison_is_made_up_where_none_is_recorded() -> None:
    assert compared(trace_of(s1_world())) == {}
    assert compared(trace_of(s1_world(), draws=2, extra=[(("continue",), 3)])) == {}


def test_every_rollout_is_counted_once_at_every_depth(recorded: PlanTrace) -> None:
    root = grow(recorded)
    assert root.visits + root.forced == len(recorded.rollouts)
    for branch in every(root):
        total = branch.visits + branch.forced
        assert sum(branch.outcomes.values()) == total
        beneath = sum(child.visits + child.forced for child in branch.children)
        longer = sum(
            tuple(step.action for step in rollout.actions[: len(branch.actions)]) == branch.actions
            and len(rollout.actions) > len(branch.actions)
            for rollout in recorded.rollouts
        )
        assert beneath == longer


def test_the_plan_is_marked_and_comes_first(recorded: PlanTrace) -> None:
    here, marked = grow(recorded), []
    while here.children and here.children[0].chosen:
        here = here.children[0]
        marked.append(here.actions[-1])
    assert marked == [planned.action for planned in recorded.plan]
    assert sum(branch.chosen for branch in every(grow(recorded))) == len(marked)


def test_several_stretches_of_one_rollout_count_as_one_hold_up() -> None:
    plain = trace_of(s1_world()).rollouts[0]
    stretches = (
        HeldUp(1, 1.0, 2.0, "leader", 5.0, 4.0),
        HeldUp(1, 4.0, 7.0, "leader", 5.0, 4.0),
        HeldUp(2, 4.0, 5.0, "cut-in", 5.0, 4.0),
    )
    held = msgspec.structs.replace(plain, held_up=stretches)
    free = msgspec.structs.replace(plain, held_up=())
    found = [(one.vehicle, one.how, one.share, one.seconds) for one in hindrances((held, free))]
    assert found == [(1, "leader", 0.5, 4.0), (2, "cut-in", 0.5, 1.0)]


def test_depth_and_all_say_how_much_is_shown(recorded: PlanTrace) -> None:
    short, usual = show(recorded, Extent(depth=1)), show(recorded, Extent())
    full = show(recorded, Extent(all=True))
    assert len(short.splitlines()) < len(usual.splitlines()) < len(full.splitlines())
    assert "└─ continue ◀" in short or "├─ continue ◀" in short  # the plan is shown whole
    reasons = {entry.reason for entry in recorded.not_applicable}
    assert all(reason in full for reason in reasons)
    assert sum("◀" in line for line in full.splitlines()) == len(recorded.plan) + 1  # and legend


def test_nothing_in_a_trace_can_steer_a_terminal() -> None:
    trace = trace_of(s1_world())
    evil = "\x1b]0;title\x07\x1b[31mred\nnext"
    [first, *rest] = trace.not_applicable
    trace = msgspec.structs.replace(
        trace,
        vehicle=evil,
        goal=msgspec.structs.replace(trace.goal, edge=evil),
        not_applicable=(msgspec.structs.replace(first, reason=evil), *rest),
    )
    shown = show(trace, Extent(all=True))
    assert "\x1b" not in shown
    assert "red next: decision" in shown


def test_a_decision_without_anything_can_be_shown() -> None:
    trace = msgspec.structs.replace(
        trace_of(s1_world()), predictions=(), rollouts=(), plan=(), scene={}, not_applicable=()
    )
    shown = show(trace, Extent())
    assert "nobody was in view" in shown
    assert "nothing; the car stops" in shown
    assert listing([trace]).splitlines()[1].split() == ["4", "4.0", "s"]


def test_endless_rollouts_are_no_search() -> None:
    trace = trace_of(s1_world())
    steps = (TimedAction("continue", 0.0),) * 100
    endless = msgspec.structs.replace(trace.rollouts[0], actions=steps)
    with pytest.raises(TreeError, match="100 actions"):
        grow(msgspec.structs.replace(trace, rollouts=(endless,)))


def test_a_decision_of_a_ride_is_chosen_by_number_or_time() -> None:
    traces = [
        msgspec.structs.replace(trace_of(s1_world()), sim_time=float(k), decision=k)
        for k in range(3)
    ]
    held = read(ride_of(*traces))
    assert held.ride
    assert choose(held, None, None) is None
    assert choose(held, 1, None) == traces[1]
    assert choose(held, None, 1.9) == traces[1]
    assert read(gzip.decompress(ride_of(*traces))) == held
    with pytest.raises(TraceFileError, match="it holds 0, 1, 2"):
        choose(held, 9, None)


@pytest.mark.parametrize("packed", [False, True])
def test_a_trace_is_read_packed_or_not(packed: bool) -> None:
    trace = trace_of(s1_world())
    data = encode(trace)
    assert read(gzip.compress(data, mtime=0) if packed else data).traces == (trace,)


def broken() -> dict[str, bytes]:
    data = encode(trace_of(s1_world()))
    other = json.loads(data) | {"schema": "xavi.plan_trace/9"}
    return {
        "nothing": b"",
        "prose": b"Why?\n",
        "half": data[: len(data) // 2],
        "other schema": json.dumps(other).encode(),
        "wrong type": data.replace(b'"decision":4', b'"decision":"four"'),
        "unknown action": data.replace(b'"change-left"', b'"fly"'),
        "half packed": gzip.compress(data, mtime=0)[:100],
        "badly packed": b"\x1f\x8b" + data,
        "ride without decisions": ride_of(),
        "half a ride": gzip.decompress(ride_of(*s1_ride().traces))[:-100],
    }


@pytest.mark.parametrize("name", broken())
def test_a_malformed_file_is_one_clear_error(name: str, tmp_path: Path) -> None:
    path = tmp_path / "trace"
    path.write_bytes(broken()[name])
    for done in (xavi(str(path)), xavi("-", stdin=broken()[name])):
        assert (done.exit_code, done.stdout) == (2, "")
        assert len(done.stderr.splitlines()) == 1
        assert done.stderr.startswith("xavi: ")


def test_the_command_shows_what_it_is_given(tmp_path: Path, recorded: PlanTrace) -> None:
    golden = (GOLDEN / "s1_lane_change.txt").read_text(encoding="utf-8")
    assert xavi(str(TRACE)).stdout == golden
    ride = tmp_path / "s1.ride.jsonl.gz"
    ride.write_bytes(ride_of(recorded, trace_of(s1_world())))
    assert xavi(str(ride)).stdout.splitlines()[0].split() == ["decision", "time", "speed", "plan"]
    assert xavi(str(ride), "--decision", "3").stdout == golden
    assert xavi(str(ride), "--decision", "77").exit_code == 2
    assert xavi(str(tmp_path / "nowhere")).exit_code == 2
    assert xavi(str(ride), "--depth", "0").exit_code == 2
