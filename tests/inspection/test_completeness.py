"""What plan traces lack, and what cannot be answered for want of it."""

from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest
from msgspec.structs import replace

from planner.record.trace import PlanTrace, encode
from sim.scene import EGO
from xavi_dialogue.inspection.completeness import gaps, report
from xavi_dialogue.inspection.trace_files import TraceFileError, read

RIDE = Path(__file__).parents[2] / "transcripts" / "rides" / "s1-0.ride.jsonl.gz"


@cache
def traces() -> tuple[PlanTrace, ...]:
    return read(RIDE.read_bytes()).traces


def decided() -> PlanTrace:
    """The decision of s1 to move to the left lane, which lacks nothing."""
    return next(trace for trace in traces() if trace.plan[0].action == "change-left")


def of_one_action(trace: PlanTrace) -> PlanTrace:
    first = trace.rollouts[0].actions[0].action
    kept = tuple(one for one in trace.rollouts if one.actions[0].action == first)
    return replace(trace, rollouts=kept, not_applicable=())


def colourless(trace: PlanTrace) -> PlanTrace:
    scene = {n: state for n, state in trace.scene.items() if n == EGO}
    others = {n: type(s)(**{f: getattr(s, f) for f in s.__dataclass_fields__} | {"colour": None})
              for n, s in trace.scene.items() if n != EGO}  # fmt: skip
    return replace(trace, scene=scene | others)


def nameless(trace: PlanTrace) -> PlanTrace:
    one = replace(trace.rollouts[0], outcome="collision", collided_with=None)
    return replace(trace, rollouts=(one, *trace.rollouts[1:]))


def test_a_trace_of_our_planner_lacks_nothing() -> None:
    assert gaps((decided(),)) == ()
    assert report((decided(),)).endswith("complete: no kind of answer is lost")


@pytest.mark.parametrize(
    ("without", "part", "lost"),
    [
        (lambda t: replace(t, rollouts=()), "rollouts", "why not"),
        (lambda t: replace(t, plan=()), "plan", "what comes next"),
        (of_one_action, "rollouts", "another action"),
        (lambda t: replace(t, predictions=()), "predictions", "where others are going"),
        (
            lambda t: replace(t, rollouts=tuple(replace(r, samples=()) for r in t.rollouts)),
            "rollouts.samples",
            "hangs on",
        ),
        (nameless, "rollouts.collided_with", "collide"),
        (lambda t: replace(t, costs=None), "costs", "comfort"),
        (
            lambda t: replace(t, rollouts=tuple(replace(r, weight=None) for r in t.rollouts)),
            "rollouts.weight",
            "how close",
        ),
        (lambda t: replace(t, history={}), "history", "braked"),
        (lambda t: replace(t, road=None), "road", "right of way"),
        (colourless, "scene.colour", "the blue car"),
    ],
)
def test_what_a_trace_lacks_is_named_with_what_it_costs(
    without: Callable[[PlanTrace], PlanTrace], part: str, lost: str
) -> None:
    found = {gap.part: gap for gap in gaps((without(decided()),))}
    assert part in found
    assert lost in found[part].answers
    assert f"{part}: {found[part].lacks}" in report((without(decided()),))


def test_nobody_has_to_be_foreseen_on_an_empty_road() -> None:
    trace = decided()
    alone = replace(trace, scene={EGO: trace.scene[EGO]}, predictions=())
    assert "predictions" not in {gap.part for gap in gaps((alone,))}


def test_of_several_decisions_it_is_told_how_many_lack_something() -> None:
    trace = decided()
    two = (trace, replace(trace, road=None))
    assert [(gap.part, gap.decisions) for gap in gaps(two)] == [("road", 1)]
    assert "(1 of 2 decisions)" in report(two)


def test_lines_of_traces_are_read_in_order_of_time() -> None:
    first, second = traces()[:2]
    lines = encode(second) + b"\n" + encode(first) + b"\n"
    assert [t.decision for t in read(lines).traces] == [first.decision, second.decision]
    other = replace(second, vehicle="other")
    with pytest.raises(TraceFileError, match="traces of car and other"):
        read(encode(first) + b"\n" + encode(other))
    with pytest.raises(TraceFileError, match="not a plan trace"):
        read(b"{}\n{}")
    with pytest.raises(TraceFileError, match="the file is empty"):
        read(b"")
