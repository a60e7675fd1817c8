"""The ride: what was carried out, what was decided, and what is refused."""

import pytest

from planner.record.events import Event
from tests.explain.facts.scenes import Actor, made, recorded, speeds, straight
from xavi_dialogue.domain.answers import NeedRollout, NotRecorded, TooLittle
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride, Unanswered, meets, thin

EGO = {0: Actor(straight(0.0, 0.0, 10.0))}


def test_deeds_have_their_times() -> None:
    events = (
        Event("action-started", 0.0, "continue", 0),
        Event("action-started", 3.0, "change-left", 3),
        Event("action-committed", 3.4, "change-left"),
        Event("action-ended", 6.0, "change-left"),
        Event("action-started", 6.0, "exit-right", 6),
    )
    ride = made(EGO, 9.0, events=events)
    assert [(d.action, d.time, d.ended) for d in ride.deeds] == [
        ("continue", 0.0, 3.0),
        ("change-left", 3.4, 6.0),
    ]
    assert ride.under_way is not None
    assert ride.under_way.action == "exit-right"
    done = ride.manoeuvre(Span(4.0, 5.0))
    assert done is not None
    assert done.action == "change-left"
    assert ride.meant(ride.deeds, Span(0.5, 1.0)) == ride.deeds[0]


def test_a_stop_without_a_standstill_is_none() -> None:
    events = (Event("action-started", 1.0, "stop", 1), Event("action-started", 4.0, "continue", 4))
    assert [d.action for d in made(EGO, 6.0, events=events).deeds] == ["continue"]
    halts = {0: Actor(speeds(0.0, 0.0, ((0.0, 6.0), (3.0, 0.0), (4.0, 0.0), (6.0, 4.0))))}
    ride = made(halts, 6.0, events=events)
    assert [d.action for d in ride.deeds] == ["stop", "continue"]
    assert ride.stood(ride.deeds[0]) == pytest.approx(3.0, abs=0.21)


def test_without_a_decision_there_is_nothing_to_say() -> None:
    with pytest.raises(Unanswered) as refused:
        _ = Ride(Record(3.0)).latest
    assert isinstance(refused.value.result, NotRecorded)


def test_what_was_not_tried_is_asked_for() -> None:
    ride = made(EGO, 4.0)
    with pytest.raises(Unanswered) as asked:
        ride.evidence(ride.latest, ("change-left",))
    need = asked.value.result
    assert need == NeedRollout(trace_id=ride.latest.trace_id, actions=("change-left",), rollouts=40)
    assert thin(("stop",), None).result == TooLittle(
        "too-little-evidence", asked=("stop",), needed=11
    )


def test_planning_without_a_vehicle_is_asked_for_once() -> None:
    ride = made(EGO | {1: Actor(straight(20.0, 0.0, 10.0))}, 4.0)
    with pytest.raises(Unanswered) as asked:
        ride.without(ride.latest, 1)
    need = asked.value.result
    assert isinstance(need, NeedRollout)
    again = Ride(Record(4.0, ride.traces, refused=(need,)))
    assert again.cannot_have(need)
    assert again.without(ride.latest, 1) is None


def test_spans_meet_where_they_share_more_than_an_end() -> None:
    assert meets((1.0, 3.0), Span(2.0, 4.0))
    assert not meets((1.0, 2.0), Span(2.0, 4.0))
    assert meets((2.0, 2.0), Span(2.0, 4.0))


@pytest.mark.parametrize("name", ["s1-0", "town-0"])
def test_the_last_decision_up_to_a_time(name: str) -> None:
    ride = recorded(name)
    for time in (0.0, 3.3, 7.0):
        known = [t for t in ride.traces if t.sim_time <= time + 1e-6]
        assert ride.at(time) is (known[-1] if known else None)
