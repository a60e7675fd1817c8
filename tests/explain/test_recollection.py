"""Explaining with a memory: the same results, and no more is remembered than there is room for."""

import pytest

from tests.traces import s1_ride
from xavi_dialogue.explain import recollection
from xavi_dialogue.explain.engine import explain, explain_ride
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.recollection import Recollection
from xavi_dialogue.explain.record import Record
from xavi_dialogue.explain.ride import Ride

QUERIES = (
    Query(type="why"),
    Query(type="why_not", counterfactual=("continue",)),
    Query(type="what", actor="vehicle:1", tense="present"),
    Query(type="why", factual=("exit-left",)),
)


def record(now: float) -> Record:
    ride = s1_ride()
    return Record(now, tuple(ride.traces), tuple(ride.events))


@pytest.mark.parametrize("now", [2.0, 7.0])
def test_it_explains_as_without_a_memory(now: float) -> None:
    memory, asked = Recollection(), record(now)
    for query in (*QUERIES, *QUERIES):
        assert memory.explain(query, asked) == explain(query, asked)


def test_another_record_is_another_matter() -> None:
    memory, asked = Recollection(), record(7.0)
    query = QUERIES[0]
    later = memory.explain(query, asked)
    earlier = Record(1.0, asked.traces[:2], asked.events[:0])
    assert memory.explain(query, earlier) == explain(query, earlier)
    assert memory.explain(query, asked) == later


def test_what_was_found_out_is_not_found_out_again(monkeypatch: pytest.MonkeyPatch) -> None:
    found: list[Query] = []

    def counted(query: Query, ride: Ride) -> recollection.Result:
        found.append(query)
        return explain_ride(query, ride)

    monkeypatch.setattr(recollection, "explain_ride", counted)
    memory, asked = Recollection(), record(7.0)
    for _ in range(3):
        memory.explain(QUERIES[0], asked)
    memory.explain(QUERIES[1], asked)
    assert found == [QUERIES[0], QUERIES[1]]


def test_no_more_is_remembered_than_there_is_room_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recollection, "MAX_RIDES", 3)
    memory, asked = Recollection(), record(7.0)
    for k in range(10):
        memory.explain(QUERIES[2], Record(1.0 + k, asked.traces, asked.events))
    assert len(memory._known) == 3
