"""A record that lacks what an answer would need: that is said, and nothing breaks."""

import msgspec
import pytest

from planner.trace import PlanTrace
from tests.traces import s1_ride
from xavi_dialogue.explain.engine import explain
from xavi_dialogue.explain.explanation import NoExplanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.record import Record

RIDE = s1_ride(draws=20)
ASKED = (
    Query(type="what", actor="vehicle:1", tense="present"),
    Query(type="what", actor="vehicle:1", tense="future"),
)


def without_goals(trace: PlanTrace) -> PlanTrace:
    predictions = tuple(msgspec.structs.replace(p, goals=()) for p in trace.predictions)
    return msgspec.structs.replace(trace, predictions=predictions)


def earlier(trace: PlanTrace) -> PlanTrace:
    """As if from another ride: its vehicles are seen only after it."""
    return msgspec.structs.replace(trace, sim_time=trace.history[1].start - 1.0)


@pytest.mark.parametrize("query", ASKED, ids=lambda query: f"{query.type}-{query.tense}")
@pytest.mark.parametrize("gap", [without_goals, earlier])
def test_a_vehicle_whose_goals_or_motion_are_not_known_then(query: Query, gap: object) -> None:
    trace = gap(RIDE.traces[-1])  # type: ignore[operator]
    told = explain(query, Record(RIDE.now, (trace,)))
    assert isinstance(told, NoExplanation)
    assert (told.reason, told.facts["vehicle"]) == ("trace-gap", 1)
