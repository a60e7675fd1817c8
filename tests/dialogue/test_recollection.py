"""What was found out of a record is kept, and found out anew where the record is another."""

import copy
import pickle
from dataclasses import replace
from typing import Any

import pytest

from tests.traces import s1_ride
from xavi_dialogue.dialogue import recollection
from xavi_dialogue.dialogue.recollection import MAX_RESULTS, MAX_RIDES, Recollection
from xavi_dialogue.domain.discourse import Discourse, GroundedAct
from xavi_dialogue.domain.meaning import Ask, HowMuch, Identify, Reading
from xavi_dialogue.domain.terms import Described, Measured, Vehicle
from xavi_dialogue.explain.history.record import Record

RIDE = s1_ride(draws=20)
RECORD = Record(RIDE.now, tuple(RIDE.traces), tuple(RIDE.events))


def speed(vehicle: int) -> GroundedAct:
    return GroundedAct(Ask(HowMuch(Measured("speed", Vehicle(vehicle)))))


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """The acts that were explained from a record, rather than recalled."""
    found: list[Any] = []

    def explain(act: GroundedAct, ride: object, world: object) -> object:
        found.append(act)
        return len(found)

    monkeypatch.setattr(recollection, "explain_in", explain)
    return found


def test_bounds() -> None:
    assert (MAX_RIDES, MAX_RESULTS) == (256, 256)


def test_a_copy_begins_empty(asked: list[Any]) -> None:
    memory = Recollection()
    memory.explain(speed(1), RECORD)
    for copied in (copy.deepcopy(memory), pickle.loads(pickle.dumps(memory))):
        assert copied == Recollection()


def test_the_same_is_not_explained_twice(asked: list[Any]) -> None:
    memory = Recollection()
    found: list[Any] = [memory.explain(speed(v), RECORD) for v in (1, 2, 1, 2)]
    assert found == [1, 2, 1, 2]
    again: Any = memory.explain(speed(1), replace(RECORD))
    assert again == 1


@pytest.mark.parametrize(
    "other",
    [
        replace(RECORD, now=6.0),
        replace(RECORD, ended=True),
        replace(RECORD, gaps=((1.0, 2.0),)),
        replace(RECORD, traces=RECORD.traces[:-1]),
        replace(RECORD, events=RECORD.events[:-1]),
        replace(RECORD, extra=RECORD.traces[:1]),
    ],
)
def test_another_record_is_explained_anew(asked: list[Any], other: Record) -> None:
    memory = Recollection()
    found: list[Any] = [memory.explain(speed(1), one) for one in (RECORD, other, RECORD, other)]
    assert found == [1, 2, 1, 2]


def test_no_more_than_some_results_of_a_record_are_kept(
    asked: list[Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(recollection, "MAX_RESULTS", 2)
    memory = Recollection()
    for vehicle in (1, 2, 1, 3, 1):  # the third one drives all out
        memory.explain(speed(vehicle), RECORD)
    assert asked == [speed(1), speed(2), speed(3), speed(1)]


def test_the_record_that_was_used_longest_ago_is_forgotten(
    asked: list[Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(recollection, "MAX_RIDES", 2)
    memory = Recollection()
    records = [replace(RECORD, now=float(k)) for k in (5, 6, 7)]
    for k in (0, 1, 0, 2, 0, 1):  # the second is dropped for the third
        memory.explain(speed(1), records[k])
    assert len(asked) == 4


def test_a_record_is_seen_and_grounded_in() -> None:
    memory = Recollection()
    look = memory.see(RECORD)(1, 4.0)  # type: ignore[operator]
    assert look is not None
    assert (look.vehicle, look.time) == (1, 4.0)
    reading = Reading(acts=(Ask(Identify(Described("vehicle"))),), shares=())
    found = memory.ground((reading,), RECORD, Discourse())
    assert [act.act for act in found.acts] == [Ask(Identify(Vehicle(1)))]
