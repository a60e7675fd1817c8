"""What was carried out, by plan traces alone: as the events of the same rides tell it."""

from dataclasses import replace
from pathlib import Path

import msgspec
import pytest

import xavi_dialogue as xavi
from planner.record.trace import PlanTrace, encode
from xavi_dialogue.explain.history.deeds import read_deeds
from xavi_dialogue.inspection.completeness import gaps
from xavi_dialogue.library.deeds import events_of
from xavi_dialogue.storage import ride_file

RIDES = sorted((Path(__file__).parents[2] / "transcripts" / "rides").glob("*.gz"))
S1 = next(path for path in RIDES if path.name == "s1-0.ride.jsonl.gz")
LACKING = "This record shows what was planned, not what was carried out, so I cannot say."


def traces_of(path: Path) -> list[PlanTrace]:
    return ride_file.load(path.read_bytes()).traces


def bare(trace: PlanTrace) -> PlanTrace:
    """A trace as a planner writes it that knows no roads, and no action under way."""
    return msgspec.structs.replace(trace, under_way=None, road=None)


def written(path: Path, traces: list[PlanTrace]) -> Path:
    path.write_bytes(b"\n".join(map(encode, traces)))
    return path


@pytest.mark.parametrize("path", RIDES, ids=lambda path: path.name)
def test_deeds_are_those_of_the_events_up_to_the_next_decision(path: Path) -> None:
    ride = ride_file.load(path.read_bytes())
    times = [trace.sim_time for trace in ride.traces]
    real = [one for one in read_deeds(ride.events) if one.action != "continue"]
    shown = [one for one in read_deeds(events_of(ride.traces)) if one.action != "continue"]
    for told, found in zip(real, shown, strict=True):
        same = replace(found, committed=told.committed)
        assert replace(told, ended=same.ended) == same
        if told.committed is None:
            assert found.committed is None
        else:
            assert found.committed == min(time for time in times if time >= told.committed)


def test_places_tell_a_lane_change_where_nothing_is_said_to_be_under_way() -> None:
    traces = [msgspec.structs.replace(one, under_way=None) for one in traces_of(S1)]
    (deed,) = [one for one in read_deeds(events_of(traces)) if one.action == "change-left"]
    assert (deed.started, deed.committed) == (3.0, 4.0)


def test_traces_alone_tell_what_was_done(tmp_path: Path) -> None:
    ride = xavi.open(written(tmp_path / "traces.jsonl", traces_of(S1)))
    assert ride.ask("Why did you change left?").text.startswith("I moved to the left lane, because")
    assert ride.ask("Did you turn right?").text.startswith("No, I did not turn right")


@pytest.mark.parametrize(
    "question",
    [
        "Why did you change left?",
        "Did you change left?",
        "When did you turn right?",
        "What would have happened if you had not changed left?",
    ],
)
def test_plans_alone_deny_nothing(tmp_path: Path, question: str) -> None:
    traces = [bare(one) for one in traces_of(S1)]
    ride = xavi.open(written(tmp_path / "traces.jsonl", traces))
    assert not ride.events
    answer = ride.ask(question, at=8.0)
    assert (answer.text, answer.reason) == (LACKING, "outside-record")


def test_a_check_of_traces_names_what_shows_no_deeds() -> None:
    lacking = {one.part: one for one in gaps([bare(one) for one in traces_of(S1)], ride=False)}
    assert lacking["under_way or road"].answers.startswith("which lane changes and turns were")
    assert lacking["events"].answers.startswith("whom we gave way to")
    assert [one.part for one in gaps(traces_of(S1), ride=False)] == ["events"]
    assert not gaps(traces_of(S1), ride=True)
