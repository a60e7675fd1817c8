"""Mediated causes: whose waiting or pulling out another brought about, as was predicted."""

import msgspec

from planner.record.trace import HeldUp, PlanTrace
from tests.traces import s1_world, trace_of
from xavi_dialogue.explain.causes.vehicles.mediated import holders
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride


def waiting(time: float, *holding: int) -> PlanTrace:
    """A decision that expects vehicle 1 to be held up by others whatever it does."""
    found = trace_of(s1_world(), time=time, decision=round(time))
    held = tuple(HeldUp(v, time, time + 2.0, "right-of-way", 8.0, 8.0) for v in holding)
    first = found.predictions[0]
    assert first.vehicle == 1
    goals = tuple(
        msgspec.structs.replace(
            goal,
            trajectories=tuple(
                msgspec.structs.replace(way, held_up=held) for way in goal.trajectories
            ),
        )
        for goal in first.goals
    )
    first = msgspec.structs.replace(first, goals=goals)
    return msgspec.structs.replace(found, predictions=(first, *found.predictions[1:]))


def since(*traces: PlanTrace) -> dict[int, float]:
    """Who has held vehicle 1 up before the last decision, and since when [s]."""
    last = traces[-1]
    found = holders(Ride(Record(last.sim_time, traces, ())), last, 1)
    return {vehicle: trace.sim_time for vehicle, trace in found.items()}


def test_one_that_holds_another_up_is_found_at_the_first_sign() -> None:
    assert since(waiting(4.0), waiting(5.0, 2), waiting(6.0, 2), waiting(7.0)) == {2: 5.0}


def test_the_ego_and_those_of_long_ago_are_left_out() -> None:
    assert since(waiting(4.0, 0), waiting(5.0, 0)) == {}
    assert since(waiting(4.0, 2), waiting(5.0), waiting(6.0), waiting(7.0)) == {}


def test_what_was_foreseen_now_and_then_alone_is_no_sign() -> None:
    traces = [waiting(float(t), *((2,) if t in (4, 8) else ())) for t in range(4, 9)]
    assert since(*traces) == {}
