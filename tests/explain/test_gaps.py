"""What is not in a record that has gaps may have happened: it is not denied."""

import pytest

from tests.traces import s1_ride
from xavi_dialogue.explain.engine import explain
from xavi_dialogue.explain.explanation import NoExplanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.record import Record
from xavi_dialogue.language.context import SpeechContext
from xavi_dialogue.language.refusals import refuse

DENIED = Query(type="why", factual=("exit-left",))


def record(*gaps: tuple[float, float]) -> Record:
    ride = s1_ride()
    return Record(7.0, tuple(ride.traces), tuple(ride.events), gaps=gaps)


def reason(query: Query, asked: Record) -> str | None:
    found = explain(query, asked)
    return found.reason if isinstance(found, NoExplanation) else None


def test_a_whole_record_denies_what_is_not_in_it() -> None:
    assert reason(DENIED, record()) == "did-not-happen"


def test_one_with_gaps_does_not() -> None:
    found = explain(DENIED, record((2.0, 3.0), (5.0, 6.0)))
    assert found == NoExplanation(reason="trace-gap", facts={"since": 2.0, "until": 6.0})
    said = refuse(DENIED, found, SpeechContext()).text
    assert "between 0:02 and 0:06 was lost" in said


@pytest.mark.parametrize("query", [Query(type="why"), Query(type="where_goal")])
def test_what_is_in_the_record_is_told_all_the_same(query: Query) -> None:
    gap = (2.0, 3.0)
    assert reason(query, record(gap)) == reason(query, record())
